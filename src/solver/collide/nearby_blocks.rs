//! The result of the broad phase: for each collider, the blocks of particles and triangles near it,
//! and the candidate pairs of the mid phase.
//!
//! A block is 64 consecutive particles or triangles, which on a grid are mostly neighbours. A block
//! is near a collider if its AABB, extended by `margin`, overlaps the swept bounds of the collider:
//! its bounds over the whole tick, or the half spaces of a plane at both ends of the tick.
//!
//! Reads colliders, positions and rest lengths through `broad_phase`, which fills it; narrow phases
//! read it.
//! Invariant: until a particle has moved by `margin` or a collider leaves its searched bounds,
//! nothing outside the listed blocks can touch that collider.

use crate::geometry::aabb::Aabb;
use crate::geometry::bends::SurfaceBend;
use crate::geometry::collision_shape::CollisionShape;
use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::max;
use crate::math::reserve::ReserveTotal;
use crate::math::swap::swap;
use crate::solver::collide::mid_phase::{CandidateRange, Candidates, ColliderPairs};
use crate::solver::collide::particle_motions::MotionBound;
use crate::state::colliders::ColliderBody;
use crate::state::pose::Pose;
use glam::Vec3;

/// Particles or triangles in a block.
pub(super) const BLOCK: usize = 64;

/// The blocks near each collider.
#[derive(Clone, Debug, Default)]
pub(crate) struct NearbyBlocks {
    pub(super) entries: Vec<ColliderEntry>,
    /// The ranges of all entries, one after the other.
    pub(super) blocks: Vec<u32>,
    /// The positions of all particles at the last rebuild [m].
    pub(super) positions_at_rebuild: Columns,
    /// The time of the last rebuild within the tick, in ticks.
    pub(super) moment_of_rebuild: f32,
    /// The displacement of each particle in one tick at the velocity that it had then [m]; empty if no
    /// collider deforms.
    pub(super) displacements: Vec<Vec3>,
    /// Scratch: the positions that this predicts [m].
    pub(super) predicted: Columns,
    /// The number of triangles at the last rebuild.
    pub(super) triangles_at_rebuild: usize,
    pub(super) particle_bounds: Vec<Aabb>,
    pub(super) triangle_bounds: Vec<Aabb>,
    /// Upper bound of the edge lengths until the next rebuild [m]; 0 while it is not needed.
    pub(super) longest_edge: f32,
    /// Whether the next refresh must rebuild.
    pub(super) is_stale: bool,
    pub(super) candidates: ColliderPairs,
    /// Scratch: the candidates before the last partial rebuild.
    pub(super) earlier: ColliderPairs,
    /// Scratch: the particles that left their predicted motion, and those with the other corners of
    /// their triangles.
    pub(super) moved: Vec<bool>,
    pub(super) searched: Vec<bool>,
    /// Scratch: the motion of particles relative to a collider.
    pub(super) motion_bounds: Vec<MotionBound>,
}

/// The state of one collider in the broad phase.
#[derive(Clone, Copy, Debug)]
pub(super) struct ColliderEntry {
    /// The swept bounds of this tick, and those of the last rebuild.
    pub now: SweptBounds,
    pub searched: SweptBounds,
    /// Features that bend no more than this count as smooth, and the margin that particles keep for
    /// that [m].
    pub smooth: SurfaceBend,
    pub sagitta_margin: f32,
    /// Triangles with a longer edge may dip into the shape between their corners [m].
    pub longest_free_edge: f32,
    pub candidates: CandidateRange,
    /// Its entries of `blocks`: particle blocks from `first_particles` to `first_triangles`,
    /// triangle blocks from there to `end`.
    pub first_particles: u32,
    pub first_triangles: u32,
    pub end: u32,
}

/// The space that a collider passes through in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SweptBounds {
    Box(Aabb),
    /// The union of two half spaces, each below a plane (a point and a normal): one half space at
    /// the start and at the end of the tick.
    HalfSpaces([(Vec3, Vec3); 2]),
}

/// The blocks and candidate pairs near one collider, for the narrow phases.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neighbours<'a> {
    pub particle_blocks: &'a [u32],
    pub triangle_blocks: &'a [u32],
    /// Triangles with a longer edge may dip into the shape between their corners [m].
    pub longest_free_edge: f32,
    /// Upper bound of the edge lengths [m].
    pub longest_edge: f32,
    /// The margin on top of the gap that particles keep [m].
    pub sagitta_margin: f32,
    /// Features that bend no more than this count as smooth.
    pub smooth: SurfaceBend,
    pub candidates: Candidates<'a>,
}

/// Returns a list that is filled only beside colliders that deform; without the feature
/// `facet-colliders` an empty constant, so that the compiler removes what handles it.
#[inline]
pub(super) fn of_deforming<T>(list: &[T]) -> &[T] {
    if cfg!(feature = "facet-colliders") { list } else { &[] }
}

heap_bytes!(
    NearbyBlocks {
        entries, blocks, positions_at_rebuild, displacements, particle_bounds, triangle_bounds,
    } plain {
        moment_of_rebuild, predicted, triangles_at_rebuild, longest_edge, is_stale, candidates,
        earlier, moved, searched, motion_bounds,
    }
);

impl NearbyBlocks {
    /// Allocates for `bodies` colliders, `particles` particles and `triangles` triangles, and
    /// invalidates the current blocks.
    pub fn reserve(&mut self, bodies: usize, particles: usize, triangles: usize) {
        let particle_blocks = particles.div_ceil(BLOCK);
        let triangle_blocks = triangles.div_ceil(BLOCK);
        let all = bodies * (particle_blocks + triangle_blocks);
        self.entries.reserve_total(bodies);
        self.blocks.reserve_total(all);
        self.positions_at_rebuild.reserve(particles);
        self.particle_bounds.reserve_total(particle_blocks);
        self.triangle_bounds.reserve_total(triangle_blocks);
        self.is_stale = true;
    }

    /// Exchanges the candidate pairs and what belongs to their search with those of `other`.
    pub fn swap_lent(&mut self, other: &mut Self) {
        swap(&mut self.candidates, &mut other.candidates);
        swap(&mut self.earlier, &mut other.earlier);
        swap(&mut self.predicted, &mut other.predicted);
        swap(&mut self.moved, &mut other.moved);
        swap(&mut self.searched, &mut other.searched);
        swap(&mut self.motion_bounds, &mut other.motion_bounds);
    }

    /// Empties the same lists. The next search refills them: near shapes with flat faces one runs at
    /// the start of every tick, and other shapes have no candidate pairs.
    pub fn clear_lent(&mut self) {
        self.candidates.clear();
        self.earlier.clear();
        self.predicted.resize(0);
        self.moved.clear();
        self.searched.clear();
        self.motion_bounds.clear();
    }

    /// Allocates the lent lists that colliders that deform need, of any number of colliders.
    pub fn reserve_for_deforming(&mut self, bodies: usize, particles: usize, triangles: usize) {
        self.predicted.reserve(particles);
        self.earlier.reserve(bodies, particles, triangles);
        self.earlier.reserve_for_deforming(bodies, triangles);
        self.candidates.reserve_for_deforming(bodies, triangles);
        self.moved.reserve_total(particles);
        self.searched.reserve_total(particles);
        self.motion_bounds.reserve_total(particles);
    }

    /// Makes the next refresh rebuild everything: for colliders that were added, removed or
    /// teleported.
    pub fn invalidate(&mut self) {
        self.is_stale = true;
    }

    /// Returns what is near the live collider with this index.
    pub(super) fn of_collider(&self, body: usize) -> Neighbours<'_> {
        let entry = &self.entries[body];
        let ColliderEntry { first_particles, first_triangles, end, .. } = *entry;
        let range = |from: u32, end: u32| &self.blocks[from as usize..end as usize];
        Neighbours {
            particle_blocks: range(first_particles, first_triangles),
            triangle_blocks: range(first_triangles, end),
            longest_free_edge: entry.longest_free_edge,
            longest_edge: self.longest_edge,
            sagitta_margin: entry.sagitta_margin,
            smooth: entry.smooth,
            candidates: self.candidates.of_range(&entry.candidates),
        }
    }

    /// Returns whether particles are near more than one collider.
    pub(super) fn are_several_near(&self) -> bool {
        let near = self.entries.iter().filter(|one| one.first_particles < one.first_triangles);
        near.take(2).count() == 2
    }
}

impl SweptBounds {
    /// The empty box.
    pub const EMPTY: Self = Self::Box(Aabb::EMPTY);

    /// Returns the bounds of a collider over this tick, extended by `gap` [m].
    pub fn of_body(body: &ColliderBody, shape: &CollisionShape, gap: f32) -> Self {
        let poses = [&body.last, &body.next];
        if let CollisionShape::HalfSpace(_) = shape {
            let plane = |pose: &Pose| (pose.position, pose.to_transform().axes[1]);
            return Self::HalfSpaces(poses.map(plane));
        }
        let local = shape.bounds();
        let mut bounds = Aabb::EMPTY;
        poses.into_iter().for_each(|pose| bounds.merge(&world_bounds(&local, pose, body)));
        Self::Box(bounds.expanded(gap))
    }

    /// Returns a box extended by `margin` [m]; half spaces stay as they are.
    pub fn expanded(self, margin: f32) -> Self {
        match self {
            Self::Box(bounds) => Self::Box(bounds.expanded(margin)),
            Self::HalfSpaces(_) => self,
        }
    }

    /// Returns whether the whole of `other` lies in these bounds.
    pub fn contains(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Box(own), Self::Box(other)) => own.contains(other),
            _ => self == other,
        }
    }

    /// Returns whether `bounds` comes within `distance` [m] of these bounds; true if a coordinate
    /// is NaN. Half spaces that rotate overlap everything.
    pub fn overlaps(&self, bounds: &Aabb, distance: f32) -> bool {
        let planes = match self {
            Self::Box(own) => return own.expanded(distance).overlaps(bounds),
            Self::HalfSpaces(planes) => planes,
        };
        let rotates = planes[0].1 != planes[1].1;
        rotates
            || planes.iter().any(|(point, normal)| {
                let (center, half) = (bounds.center() - *point, bounds.half_extents());
                let size = Vec3::new(normal.x.abs(), normal.y.abs(), normal.z.abs());
                // NaN counts as near.
                let lowest = center.dot(*normal) - half.dot(size);
                lowest.is_nan() || lowest <= distance
            })
    }
}

/// Returns the world bounds of local bounds in a pose of a body; of all orientations if the body
/// rotates in this tick.
pub(super) fn world_bounds(local: &Aabb, pose: &Pose, body: &ColliderBody) -> Aabb {
    let frame = pose.to_transform();
    if body.last.rotation == body.next.rotation {
        let (center, half) = (frame.point_to_world(local.center()), local.half_extents());
        let size = |v: Vec3| Vec3::new(v.x.abs(), v.y.abs(), v.z.abs());
        let [u, v, w] = frame.axes.map(size);
        let half = u * half.x + v * half.y + w * half.z;
        return Aabb { low: center - half, high: center + half };
    }
    let farthest = |low: f32, high: f32| max(low.abs(), high.abs());
    let (low, high) = (local.low, local.high);
    let corner =
        Vec3::new(farthest(low.x, high.x), farthest(low.y, high.y), farthest(low.z, high.z));
    Aabb::from_points([pose.position]).expanded(corner.length())
}
