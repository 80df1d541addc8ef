//! Candidate pairs of long triangles and smooth features, anew in each substep.
//!
//! Smooth features of a shape with flat faces are not among the candidates of the mid phase, as
//! particles keep a margin to them. That margin is not enough for the triangles of
//! `long_triangles`, so these query the BVH of features themselves.
//!
//! Reads local particles, long triangles and features; writes its lists.
//! Invariant: every edge of the cloth is listed once per feature.

use crate::geometry::aabb::Aabb;
use crate::geometry::bends::SurfaceBend;
use crate::geometry::features::{Feature, ShapeFeatures};
use crate::math::reserve::ReserveTotal;
use crate::mesh::{Mesh, NONE};
use crate::solver::collide::local_particles::LocalParticles;
use crate::solver::collide::long_triangles::longest_edge_squared;
use crate::solver::collide::mid_phase::{EdgeEdgePair, PairSearch, VertexTrianglePair};

/// The pairs of one collider.
#[derive(Clone, Debug, Default)]
pub(super) struct LongPairs {
    pub edges: Vec<EdgeEdgePair>,
    pub vertices: Vec<VertexTrianglePair>,
    /// The slack of each pair [m].
    pub slacks: Vec<f32>,
}

impl LongPairs {
    /// Allocates for the usual number of pairs; more allocate when they are first found.
    pub fn reserve(&mut self, triangles: usize) {
        self.edges.reserve_total(4 * triangles);
        self.vertices.reserve_total(triangles);
        self.slacks.reserve_total(5 * triangles);
    }

    pub fn clear(&mut self) {
        self.edges.clear();
        self.vertices.clear();
    }

    /// Lists the pairs of the triangles whose longest edge is above the longest free edge.
    /// `search.distance` [m] is added to the bounds of their motion.
    pub fn collect(
        &mut self,
        own: &ShapeFeatures,
        search: PairSearch,
        particles: &LocalParticles<'_>,
        mesh: &Mesh,
        (long_triangles, longest_free_edge): (&[u32], f32),
    ) {
        self.clear();
        let is_long = |triangle: u32| is_long(particles, mesh, triangle, longest_free_edge);
        for triangle in long_triangles {
            if !is_long(*triangle) {
                continue;
            }
            let corners = mesh.triangles[*triangle as usize];
            let across = mesh.across[*triangle as usize];
            let all = own.overlapping(motion_bounds(particles, corners, search.distance));
            let is_bent = |bend: &SurfaceBend| bend.angle > 0.0 && search.is_smooth(bend);
            for id in all.filter(|id| is_bent(&own.features.bend(*id))) {
                match own.features.get(id) {
                    Feature::Edge(_) => {
                        for k in 0..3 {
                            let is_own =
                                across[k] == NONE || across[k] > *triangle || !is_long(across[k]);
                            if is_own {
                                let particles = [corners[k], corners[(k + 1) % 3]];
                                self.edges.push(EdgeEdgePair { edge: id, particles });
                            }
                        }
                    }
                    Feature::Vertex(vertex, _) => {
                        self.vertices.push(VertexTrianglePair { vertex, particles: corners });
                    }
                }
            }
        }
    }
}

/// Returns the boxes of the motion of the triangles that [`LongPairs::collect`] counts, each with
/// `distance` [m] around it.
pub(super) fn boxes<'a>(
    particles: &'a LocalParticles<'_>,
    mesh: &'a Mesh,
    (long_triangles, longest_free_edge): (&'a [u32], f32),
    distance: f32,
) -> impl Iterator<Item = Aabb> + 'a {
    let long = long_triangles
        .iter()
        .filter(move |triangle| is_long(particles, mesh, **triangle, longest_free_edge));
    long.map(move |at| motion_bounds(particles, mesh.triangles[*at as usize], distance))
}

/// Returns whether a triangle counts as long at the shape of `particles`.
fn is_long(
    particles: &LocalParticles<'_>,
    mesh: &Mesh,
    triangle: u32,
    longest_free_edge: f32,
) -> bool {
    let corners = mesh.triangles[triangle as usize].map(|i| i as usize);
    let longest2 = longest_edge_squared(corners.map(|i| particles.end_position(i)));
    longest2 > longest_free_edge * longest_free_edge
        || particles.contact_scales.room(&corners) < 1.0
}

/// Returns the box of the motion of a triangle in the substep, with `distance` [m] around it.
fn motion_bounds(particles: &LocalParticles<'_>, corners: [u32; 3], distance: f32) -> Aabb {
    let path = |i: u32| [particles.start_position(i as usize), particles.end_position(i as usize)];
    Aabb::from_points(corners.into_iter().flat_map(path)).expanded(distance)
}
