//! From the triangles that artists export to a mesh that can be cloth: one repair after the other.
//!
//! ```text
//! weld ─▶ sift ─▶ part ─▶ turn
//! ```
//! Each is told in `MeshReport`. What is left is sound: an edge has at most two triangles, the triangles
//! of a particle form one fan, every triangle has an area.

mod orient;
mod remove_degenerate;
mod split_non_manifold;
mod weld;

use crate::error::{Error, Result};
use crate::mesh::report::MeshReport;
use crate::mesh::seams::Seams;
use crate::mesh::{Corner, Mesh};
use glam::Vec3;

/// A mesh that can be cloth.
#[derive(Clone, Debug)]
pub(crate) struct Intake {
    /// Triangles over particles.
    pub mesh: Mesh,
    /// The given vertex at which each particle lies.
    pub places: Vec<u32>,
    /// The vertices, unless each is the particle of its number.
    pub seams: Option<Seams>,
    pub report: MeshReport,
}

/// Repairs a mesh. `positions` are finite, `indices` are of whole triangles; `capacity` says how many
/// particles there may ever be, if there are so many.
///
/// Particles are numbered as the lowest of their vertices; those that splits made follow.
///
/// # Errors
/// `BadIndex` for an index out of range, `BadMesh` for a triangle without bounds or if none is left,
/// `BadValue` if more particles than there may be came of it.
pub(crate) fn repair(
    positions: &[Vec3],
    indices: &[u32],
    weld_distance: f32,
    capacity: impl Fn(usize) -> Result<usize>,
) -> Result<Intake> {
    let (given, _) = indices.as_chunks::<3>();
    let count = positions.len() as u32;
    if let Some(index) = indices.iter().find(|index| **index >= count) {
        return Err(Error::BadIndex { field: "indices", index: *index, count });
    }
    let welded = weld::weld(positions, given, weld_distance);
    let sifted = remove_degenerate::sift(positions, given, &welded)?;
    let (mut places, particles) = number(&welded);
    let woven = places.len();
    let mut vertices: Vec<[u32; 3]> = sifted.kept.iter().map(|at| given[*at as usize]).collect();
    let mut triangles: Vec<[u32; 3]> =
        vertices.iter().map(|corners| corners.map(|v| particles[v as usize])).collect();
    let place = |particle: u32| positions[places[particle as usize] as usize];
    let parted = split_non_manifold::part(&mut triangles, woven, place);
    let copied: Vec<u32> = parted.copies.iter().map(|(old, _)| places[*old as usize]).collect();
    places.extend(copied);
    let mut mesh = Mesh::new(triangles, places.len(), capacity(places.len())?);
    let facing = orient::orient(&mesh);
    mesh.turn(&facing.turned);
    let report = MeshReport {
        vertices: count,
        triangles: given.len() as u32,
        particles: places.len() as u32,
        kept_triangles: sifted.kept.len() as u32,
        welded_vertices: count - woven as u32,
        dropped_degenerate: sifted.degenerate,
        dropped_duplicates: sifted.duplicates,
        turned_triangles: facing.turned.iter().filter(|turned| **turned).count() as u32,
        split_edges: parted.split_edges,
        split_vertices: parted.copies.len() as u32,
        unused_vertices: unused(&vertices, positions.len()),
        pieces: facing.pieces,
        one_sided_pieces: facing.one_sided,
        is_grid: false,
    };
    let is_plain = places.len() == positions.len() && parted.copies.is_empty();
    let seams = (!is_plain).then(|| {
        for (corners, _) in vertices.iter_mut().zip(&facing.turned).filter(|(_, turned)| **turned) {
            corners.swap(1, 2);
        }
        let mut seams = Seams::new(vertices, particles);
        for (at, (_, corners)) in parted.copies.iter().enumerate() {
            let corners: Vec<Corner> =
                corners.iter().map(|corner| after_turning(*corner, &facing.turned)).collect();
            seams.part((woven + at) as u32, &corners, |_, _| {});
        }
        seams
    });
    Ok(Intake { mesh, places, seams, report })
}

/// Where a corner is after its triangle was turned, if it was.
fn after_turning(corner: Corner, turned: &[bool]) -> Corner {
    match (turned[corner as usize / 3], corner % 3) {
        (true, 1) => corner + 1,
        (true, 2) => corner - 1,
        _ => corner,
    }
}

/// Numbers the vertices that others were welded to: the vertex of each, and the number for each vertex.
fn number(welded: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let (mut places, mut particles) = (Vec::with_capacity(welded.len()), Vec::new());
    particles.resize(welded.len(), 0);
    for (vertex, to) in welded.iter().enumerate() {
        // The vertex that stayed is never a later one.
        if *to == vertex as u32 {
            particles[vertex] = places.len() as u32;
            places.push(*to);
        } else {
            particles[vertex] = particles[*to as usize];
        }
    }
    (places, particles)
}

fn unused(triangles: &[[u32; 3]], count: usize) -> u32 {
    let mut is_used = vec![false; count];
    triangles.iter().flatten().for_each(|v| is_used[*v as usize] = true);
    is_used.iter().filter(|used| !**used).count() as u32
}
