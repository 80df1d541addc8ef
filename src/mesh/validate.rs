//! Validation of a mesh that must be sound already: the triangles of a saved cloth.
//!
//! Meshes given by a host are repaired instead, see `intake`.

use crate::error::{Error, Result};
use crate::math::sort::sort;
use crate::mesh::{Fan, Mesh, NONE};
use glam::Vec3;

/// Builds a mesh, or refuses triangles that a cloth cannot have.
///
/// # Errors
/// `BadIndex` for an index out of range. `BadMesh` for a triangle without area, an edge with more
/// than two triangles, or a vertex whose triangles form more than one fan.
pub(crate) fn validated_mesh(
    triangles: Vec<[u32; 3]>,
    positions: &[Vec3],
    capacity: usize,
) -> Result<Mesh> {
    for (at, triangle) in triangles.iter().enumerate() {
        let refuse = |must| Err(Error::BadMesh { at: at as u32, must });
        if let Some(index) = triangle.iter().find(|v| **v as usize >= positions.len()) {
            let count = positions.len() as u32;
            return Err(Error::BadIndex { field: "indices", index: *index, count });
        }
        let [a, b, c] = *triangle;
        if a == b || b == c || c == a {
            return refuse("name three different vertices in every triangle");
        }
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let area = (b - a).cross(c - a).length();
        if !(area.is_finite() && area > 0.0) {
            return refuse("give every triangle an area");
        }
    }
    check_edges_manifold(&triangles)?;
    let mesh = Mesh::new(triangles, positions.len(), capacity);
    check_vertices_manifold(&mesh)?;
    Ok(mesh)
}

/// Refuses an edge with more than two triangles.
fn check_edges_manifold(triangles: &[[u32; 3]]) -> Result<()> {
    let mut edges: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * triangles.len());
    for (at, [a, b, c]) in triangles.iter().enumerate() {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            edges.push(([*a.min(b), *a.max(b)], at as u32));
        }
    }
    sort(&mut edges);
    match edges.windows(3).find(|three| three[0].0 == three[2].0) {
        Some(three) => {
            Err(Error::BadMesh { at: three[2].1, must: "give no edge more than two triangles" })
        }
        None => Ok(()),
    }
}

/// Refuses a vertex whose triangles form more than one fan.
fn check_vertices_manifold(mesh: &Mesh) -> Result<()> {
    let mut uses = vec![0usize; mesh.vertex_count()];
    mesh.triangles.iter().flatten().for_each(|v| uses[*v as usize] += 1);
    let mut fan = Fan::default();
    for (vertex, corner) in mesh.corner_of.iter().enumerate() {
        if *corner == NONE {
            continue;
        }
        mesh.gather_fan(*corner, &mut fan);
        if fan.corners.len() != uses[vertex] {
            let at = vertex as u32;
            return Err(Error::BadMesh { at, must: "join triangles by edges, not by one vertex" });
        }
    }
    Ok(())
}
