//! Sides of tears and cuts: which copy of a vertex each skin triangle uses.
//!
//! ```text
//!   ╲  ╱╲  ╱        ╲  ╱╲          A skin triangle across a tear goes with the side of its
//!   ─╲╱──╲╱──  ─▶   ─╲╱──╲   ╱     center. A corner on the other side gets a copy, bound to this
//!   ═╱╲══╱╲══        ╱╲══ ╲ ╱      side at the same distance from the tear.
//! ```
//! Method: breadth-first search over neighbouring cloth triangles, from the center of a skin
//! triangle to each corner, through edges that are close to the straight line between them in the
//! rest shape. A corner that is not reached is on the other side of a tear. A way around the end of
//! a tear counts only if it is close to that line, so a tear cannot stretch the triangle much.
//!
//! Reads the mesh, the rest shape and the bindings; writes nothing but scratch lists.
//! Invariant: the result depends on the present mesh alone, not on the order of tears, so that a
//! reset restores the given triangles.

use crate::cloth::skin::root_points::{Location, RootPoint};
use crate::geometry::closest_points::{interpolate, segment_to_segment, triangle_to_origin};
use crate::math::{lerp, min};
use crate::mesh::{Mesh, NONE};
use crate::solver::world::World;
use glam::Vec3;

/// Largest distance of a crossed edge from the line to a corner, as a share of the line's length.
const CORRIDOR: f32 = 0.25;

/// That for short lines, as a share of the mean edge: rounding.
const MIN_CORRIDOR: f32 = 1.0e-4;

/// A vertex that exists once more, on another side of a tear.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexCopy {
    /// The given vertex.
    pub source: u32,
    pub location: Location,
    /// To add to the offset of the given vertex, in the frame [m].
    pub offset: Vec3,
    /// The copy of the same vertex that was made before; `NONE` if it is the first.
    next: u32,
}

/// Breadth-first search over the triangles of the cloth along a line of the rest shape.
struct CorridorSearch<'a> {
    world: &'a World,
    stamps: Vec<u32>,
    stamp: u32,
    queue: Vec<u32>,
}

impl<'a> CorridorSearch<'a> {
    fn new(world: &'a World) -> Self {
        Self { world, stamps: vec![0; world.mesh.triangles.len()], stamp: 0, queue: Vec::new() }
    }

    /// Searches along the line from a point of the triangle `from` to a point of the triangle `to`.
    /// Returns `to` if it is reached, else the reached triangle that is nearest to the end of the
    /// line.
    fn nearest(&mut self, from: u32, to: u32, line: [Vec3; 2]) -> u32 {
        let mesh = &self.world.mesh;
        let radius = CORRIDOR * (line[1] - line[0]).length() + MIN_CORRIDOR * self.world.mean_edge;
        self.stamp += 1;
        self.stamps[from as usize] = self.stamp;
        self.queue.clear();
        self.queue.push(from);
        let mut at = 0;
        let mut best = (f32::INFINITY, from);
        while let Some(triangle) = self.queue.get(at).copied() {
            if triangle == to {
                return to;
            }
            at += 1;
            let corners = rest_corners(self.world, triangle);
            let toward = corners.map(|corner| corner - line[1]);
            let found =
                (interpolate(toward, triangle_to_origin(toward)).length_squared(), triangle);
            if found < best {
                best = found;
            }
            for (edge, beyond) in mesh.across[triangle as usize].into_iter().enumerate() {
                if beyond == NONE || self.stamps[beyond as usize] == self.stamp {
                    continue;
                }
                let ends = [corners[edge], corners[(edge + 1) % 3]];
                let (s, t) = segment_to_segment(line, ends);
                let gap = lerp(line[0], line[1], s) - lerp(ends[0], ends[1], t);
                if gap.length() <= radius {
                    self.stamps[beyond as usize] = self.stamp;
                    self.queue.push(beyond);
                }
            }
        }
        best.1
    }
}

/// Whether two triangles are the same or have a common vertex for which `is_usable` is true.
fn are_near(mesh: &Mesh, a: u32, b: u32, is_usable: impl Fn(u32) -> bool) -> bool {
    let [a_corners, b_corners] = [a, b].map(|triangle| mesh.triangles[triangle as usize]);
    a == b || a_corners.iter().any(|v| b_corners.contains(v) && is_usable(*v))
}

/// Binds vertices at the same position to the same point, so that they have the same bits, unless
/// they are on different sides of an open seam of the cloth. `first` is the lowest vertex at the
/// position of each.
pub(super) fn share_bindings(world: &World, first: &[u32], bound: &mut [(RootPoint, Location)]) {
    for (v, first) in first.iter().enumerate() {
        let [from, to] = [*first as usize, v].map(|v| bound[v].1.triangle);
        if are_near(&world.mesh, from, to, |_| true) {
            bound[v] = bound[*first as usize];
        }
    }
}

/// A skin whose triangles are to be assigned to the sides of tears.
pub(super) struct SideInput<'a> {
    pub world: &'a World,
    pub triangles: &'a [[u32; 3]],
    /// Where the center of each skin triangle is.
    pub centers: &'a [Location],
    /// Where each given vertex is bound.
    pub locations: &'a [Location],
}

impl SideInput<'_> {
    /// Writes the vertices of all skin triangles, and the copies that they need. Copies have the
    /// numbers after those of the given vertices.
    pub fn assign(&self, indices: &mut Vec<u32>, copies: &mut Vec<VertexCopy>) {
        let mesh = &self.world.mesh;
        let mut torn = Vec::new();
        mesh.mark_torn_borders(&mut torn);
        let mut search = CorridorSearch::new(self.world);
        let mut last_copy = vec![NONE; self.locations.len()];
        indices.clear();
        copies.clear();
        for (corners, center) in self.triangles.iter().zip(self.centers) {
            for v in corners {
                let (from, to) = (center.triangle, self.locations[*v as usize].triangle);
                // The triangles around a vertex off all tears are connected.
                let is_whole = are_near(mesh, from, to, |v| !torn[v as usize])
                    || mesh.across[from as usize].contains(&to);
                if is_whole {
                    indices.push(*v);
                    continue;
                }
                let line = [*center, self.locations[*v as usize]].map(|at| self.rest_point(&at));
                let side = search.nearest(from, to, line);
                if side == to {
                    indices.push(*v);
                    continue;
                }
                let mut copy = last_copy[*v as usize];
                while let Some(VertexCopy { location, next, .. }) = copies.get(copy as usize) {
                    if are_near(mesh, side, location.triangle, |_| true) {
                        break;
                    }
                    copy = *next;
                }
                if copy == NONE {
                    copy = copies.len() as u32;
                    let next = core::mem::replace(&mut last_copy[*v as usize], copy);
                    copies.push(self.copy_of(*v, side, next));
                }
                indices.push(self.locations.len() as u32 + copy);
            }
        }
    }

    /// Where a point is in the rest shape [m].
    fn rest_point(&self, at: &Location) -> Vec3 {
        interpolate(rest_corners(self.world, at.triangle), at.weights)
    }

    /// Binds a copy of vertex `v` to `triangle`, at the place where the vertex is in the rest
    /// shape, but at most one mean edge beyond the triangle.
    fn copy_of(&self, v: u32, triangle: u32, next: u32) -> VertexCopy {
        let bound = &self.locations[v as usize];
        let (from, point) = (rest_corners(self.world, bound.triangle), self.rest_point(bound));
        let to = rest_corners(self.world, triangle);
        let weights = triangle_to_origin(to.map(|corner| corner - point));
        let beyond = point - interpolate(to, weights);
        let beyond = beyond * min(1.0, self.world.mean_edge / beyond.length());
        // The direction t of the vertex, as multiples of the edges of the new triangle.
        let [first, second] = bound.direction;
        let along = (from[1] - from[0]) * first + (from[2] - from[0]) * second;
        let (p, q) = (to[1] - to[0], to[2] - to[0]);
        let face = p.cross(q);
        let inverse = 1.0 / face.length_squared();
        let direction = [along.cross(q).dot(face) * inverse, p.cross(along).dot(face) * inverse];
        let n = face * (1.0 / face.length());
        let t = p * direction[0] + q * direction[1];
        let t = t * (1.0 / t.length());
        let offset = Vec3::new(beyond.dot(t), beyond.dot(n.cross(t)), beyond.dot(n));
        let is_usable = offset.is_finite();
        let direction = if is_usable { direction } else { [1.0, 0.0] };
        VertexCopy {
            source: v,
            location: Location { triangle, weights, direction },
            offset: if is_usable { offset } else { Vec3::ZERO },
            next,
        }
    }
}

/// The corners of a triangle in the rest shape [m].
fn rest_corners(world: &World, triangle: u32) -> [Vec3; 3] {
    let site = |v: u32| world.mesh.source[v as usize] as usize;
    world.mesh.triangles[triangle as usize].map(|v| world.rest[site(v)])
}
