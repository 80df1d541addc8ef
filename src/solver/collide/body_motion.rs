//! The motion of one collider over a tick, relative to which particles are measured.
//!
//! ```text
//!  ● particle          Seen from the body at rest at its pose at the start of the tick, a particle
//!   ╲  path            moves from x to x + v T − d(x), where d is the displacement that the body
//!  ┌─╲──┐              gives a point at x and T the length of the tick.
//!  │body│
//!  └────┘
//! ```
//! Rotation is measured over the first half of the tick and doubled, so that the chord of a half
//! turn is nearly as long as its arc.
//!
//! Reads a collider; writes nothing.
//! Invariant: a body at rest has the displacement zero, to the bit.

use crate::geometry::aabb::Aabb;
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::transform::Transform;
use crate::math::{max, min};
use crate::solver::collide::nearby_blocks::world_bounds;
use crate::state::colliders::ColliderBody;
use glam::Vec3;

/// What a tick needs to know about one collider to count its substeps.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyMotion {
    /// Frame at the start of the tick.
    start: Transform,
    /// Displacement of the origin of the body [m].
    translation: Vec3,
    /// Frame in the middle of the tick, if the body rotates.
    turn: Option<Transform>,
    /// Distance from the surface that counts as near [m].
    margin: f32,
    extent: Extent,
    /// Largest distance that a point of the body moves [m].
    pub longest: f32,
    /// Whether its surface moves in its frame.
    deforms: bool,
    /// Displacement relative to the body that one substep resolves [m].
    pub step: f32,
}

/// The space that a body fills at the start of a tick.
#[derive(Clone, Copy, Debug)]
enum Extent {
    Box(Aabb),
    /// Everything below a plane: a point and a normal.
    HalfSpace(Vec3, Vec3),
}

impl BodyMotion {
    /// Measures the motion of a collider, whose bounds grow by `margin` [m]. One substep resolves
    /// `step` [m], or the radius of a smaller round shape.
    pub fn new(body: &ColliderBody, shape: &CollisionShape, margin: f32, step: f32) -> Self {
        let rotates = body.last.rotation != body.next.rotation;
        let start = body.last.to_transform();
        let turn = rotates.then(|| body.last.interpolate(&body.next, 0.5).to_transform());
        let translation = body.next.position - body.last.position;
        let (extent, lever) = match shape {
            CollisionShape::HalfSpace(_) => {
                let normal = start.axes[1];
                (Extent::HalfSpace(start.origin + normal * margin, normal), f32::INFINITY)
            }
            _ => {
                let local = shape.bounds();
                let farthest = local.low.abs().max(local.high.abs()).length() + margin;
                let bounds = world_bounds(&local, &body.last, body).expanded(margin);
                (Extent::Box(bounds), farthest)
            }
        };
        let radius = match shape {
            CollisionShape::Sphere(sphere) => sphere.radius,
            CollisionShape::Capsule(capsule) => capsule.min_radius(),
            _ => f32::INFINITY,
        };
        // No chord is longer than the diameter of its circle.
        let longest = translation.length() + if rotates { 2.0 * lever } else { 0.0 };
        let deformation = body.deformation().filter(|deformation| deformation.is_moving());
        let longest = longest + deformation.map_or(0.0, |deformation| deformation.longest());
        let (deforms, step) = (deformation.is_some(), min(step, radius));
        Self { start, translation, turn, margin, extent, longest, deforms, step }
    }

    /// Displacement that the body gives a point [m].
    fn displacement_at(&self, x: Vec3) -> Vec3 {
        match &self.turn {
            None => self.translation,
            Some(middle) => (middle.point_to_world(self.start.point_to_local(x)) - x) * 2.0,
        }
    }

    /// Returns how far a point at `x` that moves by `moved` in the tick moves relative to the body, or
    /// `least` if that is not more [m]; 0 if it does not come near its shape. Motion along a plane does
    /// not count.
    pub fn relative_path(&self, body: &ColliderBody, x: Vec3, moved: Vec3, least: f32) -> f32 {
        let path = moved - self.displacement_at(x);
        match self.extent {
            Extent::Box(bounds) => {
                if !meets_box(&bounds, x, path) {
                    return 0.0;
                }
                if let Some(deformation) = body.deformation().filter(|_| self.deforms) {
                    let [from, to] = self.local_path(x, path);
                    let path = [from, to - from];
                    return deformation.longest_relative_path(path, self.margin, least);
                }
                let shape = body.collision_shape();
                let is_near = shape.is_some_and(|shape| self.comes_near(shape, x, path));
                if is_near { path.length() } else { 0.0 }
            }
            Extent::HalfSpace(point, normal) => {
                let (height, approach) = ((x - point).dot(normal), -path.dot(normal));
                if height <= approach { max(approach, 0.0) } else { 0.0 }
            }
        }
    }

    /// The box, in the frame of the body, around a box.
    fn box_in_frame(&self, bounds: &Aabb) -> Aabb {
        let (center, half) = (self.start.point_to_local(bounds.center()), bounds.half_extents());
        let size = self.start.axes.map(|axis| axis.abs().dot(half));
        let half = Vec3::from_array(size);
        Aabb { low: center - half, high: center + half }
    }

    /// The ends of a path in the frame of the body.
    fn local_path(&self, x: Vec3, path: Vec3) -> [Vec3; 2] {
        [x, x + path].map(|end| self.start.point_to_local(end))
    }

    /// Whether a path comes near the surface of a shape whose bounds are mostly empty; true for
    /// other shapes.
    fn comes_near(&self, shape: &CollisionShape, x: Vec3, path: Vec3) -> bool {
        let ends = || self.local_path(x, path);
        match shape {
            CollisionShape::TriangleSurface(surface, _) => {
                surface.has_triangle_near(Aabb::from_points(ends()).expanded(self.margin))
            }
            CollisionShape::Heightfield(terrain) => {
                let [from, to] = ends();
                [from, (from + to) * 0.5, to].into_iter().any(|at| {
                    let height = terrain.signed_distance(at);
                    height.is_some_and(|(distance, _)| distance <= self.margin)
                })
            }
            _ => true,
        }
    }

    /// Returns an upper bound of [`Self::relative_path`] for points in `bounds` that move by a vector
    /// in `moves` [m]: 0 if none comes near, infinity if the body rotates.
    pub fn longest_path(&self, body: &ColliderBody, bounds: &Aabb, moves: &Aabb) -> f32 {
        if self.turn.is_some() {
            return f32::INFINITY;
        }
        if let Some(deformation) = body.deformation().filter(|_| self.deforms) {
            let [low, high] = [moves.low, moves.high].map(|way| way - self.translation);
            let space = Aabb {
                low: bounds.low + low.min(Vec3::ZERO),
                high: bounds.high + high.max(Vec3::ZERO),
            };
            let near = deformation.motions_near(self.box_in_frame(&space).expanded(self.margin));
            let ways = self.box_in_frame(&Aabb {
                low: low + self.start.origin,
                high: high + self.start.origin,
            });
            return near.map_or(0.0, |own| {
                (ways.low - own.high).abs().max((ways.high - own.low).abs()).length()
            });
        }
        let (low, high) = (moves.low - self.translation, moves.high - self.translation);
        let is_near = match &self.extent {
            Extent::Box(own) => own.overlaps(&Aabb {
                low: bounds.low + low.min(Vec3::ZERO),
                high: bounds.high + high.max(Vec3::ZERO),
            }),
            Extent::HalfSpace(point, normal) => {
                let lowest = |bounds: Aabb| {
                    bounds.center().dot(*normal) - bounds.half_extents().dot(normal.abs())
                };
                lowest(*bounds) - point.dot(*normal) + min(lowest(Aabb { low, high }), 0.0) <= 0.0
            }
        };
        if is_near { low.abs().max(high.abs()).length() } else { 0.0 }
    }
}

/// Whether the segment from `start` along `path` meets a box (slab test).
fn meets_box(bounds: &Aabb, start: Vec3, path: Vec3) -> bool {
    let (mut enter, mut leave) = (0.0, 1.0);
    for axis in 0..3 {
        let (low, high) = (bounds.low[axis] - start[axis], bounds.high[axis] - start[axis]);
        if path[axis] == 0.0 {
            if low > 0.0 || high < 0.0 {
                return false;
            }
            continue;
        }
        let inverse = 1.0 / path[axis];
        let (a, b) = (low * inverse, high * inverse);
        enter = max(min(a, b), enter);
        leave = min(max(a, b), leave);
    }
    enter <= leave
}
