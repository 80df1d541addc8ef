//! The motion of particles as a search for pairs sees it.
//!
//! ```text
//! start ── now ─ ─ ─ ─ end of the tick     this substep, then as the velocity predicts it
//! ```
//! Beside rigid colliders a ball around start and now bounds the motion, and pairs are searched again
//! once a particle leaves it. Beside a surface that deforms, particles are predicted to the end of the
//! tick, and their motion counts relative to that of the surface.
//!
//! Reads positions, velocities and colliders; writes predicted displacements.
//! Invariant: a bound contains every position between the start of the substep and where the particle
//! is predicted.

use crate::geometry::aabb::Aabb;
use crate::geometry::relative_motion::PointMotion;
use crate::geometry::swept_box::SweptBox;
use crate::math::columns::Columns;
use crate::math::max;
use crate::state::colliders::ColliderBody;
use glam::Vec3;

/// A ball that contains all local positions of a particle, and the box of everything that it may
/// touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct MotionBound {
    pub center: Vec3,
    /// [m]
    pub radius: f32,
    /// Everything that the particle may touch [m].
    pub bounds: Aabb,
    /// The motion beyond the ball, which counts relative to a moving surface.
    pub motion: PointMotion,
}

impl MotionBound {
    /// The bound of a particle that is not searched for.
    pub const NONE: Self =
        Self { center: Vec3::ZERO, radius: 0.0, bounds: Aabb::EMPTY, motion: PointMotion::NONE };

    /// Bounds four positions; `distance` [m] is added to the box.
    pub fn new(positions: [Vec3; 4], distance: f32) -> Self {
        let center = (positions[0] + positions[1] + positions[2] + positions[3]) * 0.25;
        let mut radius2 = 0.0;
        for position in positions {
            radius2 = max((position - center).length_squared(), radius2);
        }
        let radius = radius2.sqrt();
        let half = Vec3::splat(radius + distance);
        let bounds = Aabb { low: center - half, high: center + half };
        Self { center, radius, bounds, motion: PointMotion::default() }
    }

    /// Grows the ball until it also contains all positions moved by `displacement` [m].
    pub fn grown(self, displacement: Vec3) -> Self {
        let (half, length) = (displacement * 0.5, displacement.length() * 0.5);
        let low = self.bounds.low + half - Vec3::splat(length);
        let bounds = Aabb { low, high: self.bounds.high + half + Vec3::splat(length) };
        Self { center: self.center + half, radius: self.radius + length, bounds, ..self }
    }

    /// Returns the box with `distance` [m] around it that moves as predicted.
    pub fn swept_box(&self, distance: f32) -> SweptBox {
        let half = Vec3::splat(self.radius + distance);
        let now = Aabb { low: self.center - half, high: self.center + half };
        SweptBox::new(now, self.motion.displacements, [0.0; 2])
    }

    /// Adds a motion to the box.
    pub fn with_motion(self, motion: PointMotion) -> Self {
        let [forward, backward] = motion.displacements;
        let low = forward.min(-backward).min(Vec3::ZERO);
        let high = forward.max(-backward).max(Vec3::ZERO);
        let bounds = Aabb { low: self.bounds.low + low, high: self.bounds.high + high };
        Self { bounds, motion, ..self }
    }
}

/// The motion of all particles as a search for pairs sees it.
pub(super) struct ParticleMotions<'a> {
    pub x: &'a Columns,
    /// The predicted positions of this substep and the displacements that lead to them.
    pub predicted: &'a Columns,
    pub displacement: &'a Columns,
    /// Displacements in a tick, empty if no collider deforms, see `nearby_blocks` [m].
    pub displacements: &'a [Vec3],
    /// What is left of the tick, and the length of the part of it that leads to now, in ticks: 0 after
    /// the last substep, when colliders rest.
    pub shares: [f32; 2],
}

impl ParticleMotions<'_> {
    /// Returns the position now and at the start of the substep: a fast particle is already far from
    /// there.
    fn both(&self, i: usize) -> [Vec3; 2] {
        [self.x.get(i), self.predicted.get(i) - self.displacement.get(i)]
    }

    /// Returns the displacement until the end of the tick; zero if no collider deforms.
    pub fn forward(&self, i: usize) -> Vec3 {
        self.displacements.get(i).map_or(Vec3::ZERO, |one| *one * self.shares[0])
    }

    /// Returns positions whose box contains the motion.
    pub fn path(&self, i: usize) -> [Vec3; 3] {
        let [now, start] = self.both(i);
        [now, start, now + self.forward(i)]
    }

    /// Bounds the motion relative to a collider with flat faces, with `distance` [m] around it.
    #[inline(never)]
    pub fn bound(&self, i: usize, body: &ColliderBody, distance: f32) -> MotionBound {
        let frames = [body.last.to_transform(), body.next.to_transform()];
        let [now, start] = self.both(i);
        let local = |x: Vec3| frames.each_ref().map(|frame| frame.point_to_local(x));
        let [last, next] = local(now);
        let forward = self.forward(i);
        if body.is_deforming() {
            let displacements = [forward, now - start].map(|one| frames[1].vector_to_local(one));
            let motion = PointMotion { displacements, shares: self.shares };
            return MotionBound::new([last, last, next, next], distance).with_motion(motion);
        }
        let [from_last, from_next] = local(start);
        let bound = MotionBound::new([last, from_last, next, from_next], distance);
        if self.displacements.is_empty() {
            return bound;
        }
        bound.grown(frames[1].vector_to_local(forward))
    }
}

/// Limits predicted displacements of particles near a collider that deforms to those of its surface
/// there: particles in contact are carried along, also where the surface is about to change its
/// velocity.
pub(super) fn carry_along(
    body: &ColliderBody,
    x: &Columns,
    margin: f32,
    displacements: &mut [Vec3],
) {
    let Some(deformation) = body.deformation().filter(|_| body.last.rotation == body.next.rotation)
    else {
        return;
    };
    let (frame, translation) = (body.next.to_transform(), body.next.position - body.last.position);
    for (block, displacements) in displacements.chunks_mut(CARRIED).enumerate() {
        let first = block * CARRIED;
        let local = |i: usize| frame.point_to_local(x.get(i));
        let bounds = Aabb::from_points((first..first + displacements.len()).map(local));
        let Some(motions) = deformation.motions_near(bounds.expanded(margin)) else { continue };
        for displacement in displacements {
            let own = frame.vector_to_local(*displacement - translation);
            let limited = own.max(motions.low).min(motions.high);
            *displacement = frame.vector_to_world(limited) + translation;
        }
    }
}

/// Particles whose displacement is limited together.
const CARRIED: usize = 16;
