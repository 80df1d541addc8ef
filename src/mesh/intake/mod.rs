//! Mesh repair: from any triangle soup to a mesh that can be simulated as cloth.
//!
//! ```text
//! weld ─▶ remove degenerate ─▶ split non-manifold ─▶ orient ─▶ simplify
//! ```
//! Reads positions and indices of a host; writes a `RepairedMesh` and a `MeshReport` that counts
//! each repair.
//!
//! Invariant of the result: an edge has at most two triangles, the triangles of a particle form one
//! fan, and every triangle has an area.

mod orient;
mod remove_degenerate;
mod simplify;
mod split_non_manifold;
mod weld;

use crate::error::{Error, Result, check};
use crate::mesh::report::MeshReport;
use crate::mesh::seams::Seams;
use crate::mesh::{Corner, Mesh};
use glam::Vec3;
pub(crate) use simplify::Simplify;

/// Result of a repair.
#[derive(Clone, Debug)]
pub(crate) struct RepairedMesh {
    /// Triangles over particles.
    pub mesh: Mesh,
    /// The given vertex at the position of each particle.
    pub source_vertices: Vec<u32>,
    /// The render vertices; `None` if each vertex is the particle of the same number.
    pub seams: Option<Seams>,
    pub report: MeshReport,
}

/// Repairs a mesh. `positions` [m] are finite, `indices` are whole triangles; `capacity(n)` returns
/// the maximum number of particles for a cloth that starts with n, or an error.
///
/// Particles are numbered in the order of the lowest vertex of each; those added by splits follow.
///
/// # Errors
/// `BadIndex` for an index out of range. `BadMesh` for a triangle whose area is not finite, or if
/// no triangle remains. `BadValue` if `simplify.below` exceeds the mean length of the edges. The
/// errors of `capacity`.
pub(crate) fn repair(
    positions: &[Vec3],
    indices: &[u32],
    weld_distance: f32,
    simplify: &Simplify<'_>,
    capacity: impl Fn(usize) -> Result<usize>,
) -> Result<RepairedMesh> {
    let (given, _) = indices.as_chunks::<3>();
    let count = positions.len() as u32;
    if let Some(index) = indices.iter().find(|index| **index >= count) {
        return Err(Error::BadIndex { field: "indices", index: *index, count });
    }
    let welded = weld::weld(positions, given, weld_distance);
    let mut kept = remove_degenerate::remove_degenerate(positions, given, &welded)?;
    let (mut source_vertices, particles) = number_particles(&welded);
    let welded_count = source_vertices.len();
    let mut vertices: Vec<[u32; 3]> = kept.triangles.iter().map(|at| given[*at as usize]).collect();
    let mut triangles: Vec<[u32; 3]> =
        vertices.iter().map(|corners| corners.map(|v| particles[v as usize])).collect();
    let position = |particle: u32| positions[source_vertices[particle as usize] as usize];
    let manifold = split_non_manifold::split_non_manifold(&mut triangles, welded_count, position);
    let copied: Vec<u32> =
        manifold.copies.iter().map(|(old, _)| source_vertices[*old as usize]).collect();
    source_vertices.extend(copied);
    let mut mesh = Mesh::new(triangles, source_vertices.len(), capacity(source_vertices.len())?);
    let orientation = orient::orient(&mesh);
    mesh.flip_triangles(&orientation.flipped);
    let mut report = MeshReport {
        vertices: count,
        triangles: given.len() as u32,
        particles: source_vertices.len() as u32,
        kept_triangles: kept.triangles.len() as u32,
        welded_vertices: count - welded_count as u32,
        dropped_degenerate: kept.degenerate,
        dropped_duplicates: kept.duplicates,
        turned_triangles: orientation.flipped.iter().filter(|flipped| **flipped).count() as u32,
        split_edges: manifold.split_edges,
        split_vertices: manifold.copies.len() as u32,
        unused_vertices: count_unused(&vertices, positions.len()),
        pieces: orientation.pieces,
        one_sided_pieces: orientation.non_orientable,
        ..MeshReport::default()
    };
    let is_plain = source_vertices.len() == positions.len() && manifold.copies.is_empty();
    let mut seams = (!is_plain).then(|| {
        for (corners, _) in
            vertices.iter_mut().zip(&orientation.flipped).filter(|(_, flipped)| **flipped)
        {
            corners.swap(1, 2);
        }
        let mut seams = Seams::new(vertices, particles);
        for (at, (_, corners)) in manifold.copies.iter().enumerate() {
            let corners: Vec<Corner> = corners
                .iter()
                .map(|corner| corner_after_flip(*corner, &orientation.flipped))
                .collect();
            seams.split_particle((welded_count + at) as u32, &corners, |_, _| {});
        }
        seams
    });
    measure(&mut report, &mesh, positions, &source_vertices, &kept.triangles);
    let may_simplify = simplify.below <= report.mean_edge;
    check(may_simplify, "simplify_below", "be at most the mean length of the edges")?;
    if simplify.below > 0.0 {
        let mut all = seams.clone().unwrap_or_else(|| {
            Seams::new(mesh.triangles.clone(), (0..mesh.vertex_count() as u32).collect())
        });
        let x = source_vertices.iter().map(|vertex| positions[*vertex as usize]).collect();
        let mut surface = simplify::Surface::new(&mesh, x, &all, simplify);
        if surface.simplify(&mut report) {
            let (triangles, vertices, particles) =
                surface.finish(&mut source_vertices, &mut kept.triangles);
            let count = source_vertices.len();
            let removed = report.kept_triangles - triangles.len() as u32;
            report.collapsed_triangles = removed - report.trimmed_triangles;
            (report.particles, report.kept_triangles) = (count as u32, triangles.len() as u32);
            mesh = Mesh::new(triangles, count, capacity(count)?);
            all.replace(vertices, particles);
            seams = Some(all);
            measure(&mut report, &mesh, positions, &source_vertices, &kept.triangles);
        }
    }
    Ok(RepairedMesh { mesh, source_vertices, seams, report })
}

/// Measures the quality of a mesh. `given[t]` is the number of triangle t in the given list.
#[inline(never)]
fn measure(
    report: &mut MeshReport,
    mesh: &Mesh,
    positions: &[Vec3],
    source_vertices: &[u32],
    given: &[u32],
) {
    let position = |p: u32| positions[source_vertices[p as usize] as usize];
    report.measure_quality(mesh, position, |triangle| given[triangle as usize]);
}

/// Returns the new number of a corner: flipping its triangle swaps the second and the third.
fn corner_after_flip(corner: Corner, flipped: &[bool]) -> Corner {
    match (flipped[corner as usize / 3], corner % 3) {
        (true, 1) => corner + 1,
        (true, 2) => corner - 1,
        _ => corner,
    }
}

/// Numbers the vertices that others were welded to. Returns the vertex of each particle and the
/// particle of each vertex.
fn number_particles(welded: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let (mut source_vertices, mut particles) = (Vec::with_capacity(welded.len()), Vec::new());
    particles.resize(welded.len(), 0);
    for (vertex, to) in welded.iter().enumerate() {
        // A vertex is welded to an earlier one or to itself.
        if *to == vertex as u32 {
            particles[vertex] = source_vertices.len() as u32;
            source_vertices.push(*to);
        } else {
            particles[vertex] = particles[*to as usize];
        }
    }
    (source_vertices, particles)
}

/// Number of vertices that no triangle uses.
fn count_unused(triangles: &[[u32; 3]], count: usize) -> u32 {
    let mut is_used = vec![false; count];
    triangles.iter().flatten().for_each(|v| is_used[*v as usize] = true);
    is_used.iter().filter(|used| !**used).count() as u32
}
