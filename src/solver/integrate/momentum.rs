//! Momentum conservation: removes the rigid motion that internal stages add.
//!
//! ```text
//! linear     Σ m d = 0                          d = x − x before the stage
//! angular    Σ m r × e = 0                      r = (x₀ + x) / 2 − c, e = (v' − v − h a) · h
//! ```
//! x₀, v: position and velocity at the start of the substep; x, v': at its end; a: acceleration by
//! gravity and air; c: the centre of mass of all r. Internal forces change neither the linear nor
//! the angular momentum of a cloth that nothing holds. A cloth with one fixed particle keeps its
//! angular momentum about that particle, a cloth with two its angular momentum about the line
//! through both. Position-based stages break this by a little in every substep: rounding, solvers
//! that stop early, and multistep time integration, which extrapolates velocities along straight
//! lines. So the rigid motion with the momenta of these errors is subtracted from the positions.
//! The angular momentum is compared with that at the start of the substep, since the corrections
//! that turn velocities along a circle are no error. Velocities count the exact difference, so
//! rounding of positions adds no momentum either.
//!
//! Two stages use it: all internal stages before contacts ([`remove_internal_momentum`]), and
//! contacts of surface collision ([`remove_rigid_motion_since`]).
//!
//! Reads predicted positions and the displacement history; writes positions, predicted
//! displacements, and the scratch lists `relative_wind` and `correction`, which are free at that
//! time.
//!
//! While the cloth touches colliders, [`remove_internal_momentum`] compares with the start of the
//! corrections only, and only where folds, damping or particle collision exert a torque.
//!
//! `piece_momentum` does the same for cloth in several pieces.
//!
//! Invariant: no particle of a piece moves that has three or more fixed particles or soft pins;
//! `remove_rigid_motion_since` moves free cloth only.

use crate::math::columns::Columns;
use crate::math::simd::leveled;
use crate::math::wide4::Float4;
use crate::solver::bend;
use crate::solver::integrate::momentum_sums::FreeParticles;
use crate::solver::integrate::rigid_motion::{Component, Pivot, RigidMotion};
use crate::solver::particle_stage::interleaved;
use crate::solver::world::World;
use crate::state::colliders::Impulse;
use crate::state::particles::Particles;
use crate::state::settings::BdfScheme;
use glam::Vec3;

/// Fixed particles of a piece: with more than two, their reactions may change every momentum.
pub(super) const MAX_FIXED: usize = 2;

/// The first fixed ones of some particles and their number, of which one more than [`MAX_FIXED`]
/// are counted.
pub(super) fn fixed_particles(
    particles: impl Iterator<Item = usize>,
    w: &[f32],
) -> ([usize; MAX_FIXED + 1], usize) {
    let (mut fixed, mut count) = ([0; MAX_FIXED + 1], 0);
    for i in particles.filter(|i| w[*i] <= 0.0).take(MAX_FIXED + 1) {
        fixed[count] = i;
        count += 1;
    }
    (fixed, count)
}

/// What the first `count` of some fixed particles hold a piece with.
pub(super) fn pivot(p: &Particles, fixed: [usize; 3], count: usize) -> Pivot {
    let [a, b] = [fixed[0], fixed[1]].map(|i| p.x.get(i));
    match count {
        0 => Pivot::Nothing,
        1 => Pivot::Point(a),
        _ => Pivot::Axis(a, b - a),
    }
}

/// Removes the momentum that internal stages added since prediction to cloth of one piece.
pub(super) fn remove_internal_momentum(world: &mut World) {
    if world.pins.has_soft() {
        return;
    }
    let w = &world.particles.w;
    let (fixed, count) = fixed_particles(0..w.len(), w);
    if count > MAX_FIXED || !has_corrections(world) {
        return;
    }
    if has_collider_impulse(world) {
        if count == 0 && may_add_spin(world) {
            compute_corrections(world);
            remove_correction_momentum(world);
        }
        return;
    }
    let pivot = pivot(&world.particles, fixed, count);
    let translation = match pivot {
        Pivot::Nothing => {
            compute_corrections(world);
            mean_correction(world)
        }
        Pivot::Point(_) | Pivot::Axis(..) => Vec3::ZERO,
    };
    compute_angular_errors(world);
    let (p, scratch) = (&world.particles, &world.scratch);
    let free = FreeParticles {
        x: scratch.relative_wind.slices(),
        displacement: scratch.correction.slices(),
        mass: &p.mass,
        w: &p.w,
    };
    let rigid = RigidMotion::about(world.level, free, pivot).with_translation(translation);
    subtract(world, &rigid);
}

/// Whether the cloth pushed a collider in this tick or in the last one.
///
/// The second-order scheme spreads an impulse over the following substeps, so the angular momentum
/// changes in substeps without contact too, and must.
pub(super) fn has_collider_impulse(world: &World) -> bool {
    let last = world.colliders.iter().map(|body| &body.impulse);
    let mut all = last.chain(&world.scratch.contacts.impulses);
    all.any(|impulse| *impulse != Impulse::default())
}

/// Whether particle collision, folds or damping of bending may exert a large torque on free cloth.
pub(super) fn may_add_spin(world: &World) -> bool {
    world.scratch.particle_collision.is_some() || world.has_pressure() || bend::may_add_spin(world)
}

/// Subtracts the rigid motion with the momenta of `correction` about the positions that velocities
/// count from. It also removes the part of the corrections that turns velocities along a circle.
fn remove_correction_momentum(world: &mut World) {
    compute_velocity_origins(world);
    let (p, scratch) = (&world.particles, &world.scratch);
    let free = FreeParticles {
        x: scratch.relative_wind.slices(),
        displacement: scratch.correction.slices(),
        mass: &p.mass,
        w: &p.w,
    };
    let rigid = RigidMotion::of_free(world.level, free);
    world.scratch.relative_wind.copy_from(&world.particles.x);
    subtract(world, &rigid);
}

/// The mean of `correction` by mass [m].
fn mean_correction(world: &World) -> Vec3 {
    let (p, correction) = (&world.particles, world.scratch.correction.slices());
    let free = FreeParticles { x: correction, displacement: correction, mass: &p.mass, w: &p.w };
    RigidMotion::translation_of_free(world.level, free).translation()
}

/// Fills `relative_wind` with the positions in the middle of the substep, and `correction` with the
/// displacements [m] whose angular momentum about these positions is the error of the substep:
/// what changes the angular momentum besides the acceleration.
///
/// ```text
/// v' = (new_weight · d − old_weight · d₋) / h       d = displacement + share · (x − predicted)
/// Σ m x × v' − Σ m x₀ × v = Σ m (x₀ + x) / 2 × (v' − v)      if x − x₀ = h (v + v') / 2
/// error = (v' − v − h a) · h / (new_weight · share)
/// ```
pub(super) fn compute_angular_errors(world: &mut World) {
    let (scheme, share, level) = (world.scheme(), world.correction_share(), world.level);
    let (p, scratch) = (&world.particles, &mut world.scratch);
    let [x, predicted, displacement] =
        [&p.x, &scratch.predicted, &scratch.displacement].map(Columns::slices);
    let [last, v, a] = [&p.displacement, &p.v, &scratch.acceleration].map(Columns::slices);
    scratch.correction.resize(p.len());
    let middles = scratch.relative_wind.slices_mut();
    for (axis, (middle, error)) in
        middles.into_iter().zip(scratch.correction.slices_mut()).enumerate()
    {
        let from = [x[axis], predicted[axis], displacement[axis], last[axis], v[axis], a[axis]];
        compute_error(level, middle, error, from, scheme, share);
    }
}

leveled! {
    /// Computes one component of the positions and errors of [`compute_angular_errors`].
    fn compute_error(
        middle: &mut [f32],
        error: &mut [f32],
        from: [&[f32]; 6],
        scheme: BdfScheme,
        share: f32,
    ) = compute_error_column
}

#[inline(always)]
fn compute_error_column(
    middle: &mut [f32],
    error: &mut [f32],
    [x, predicted, displacement, last, v, a]: [&[f32]; 6],
    BdfScheme { h, new_weight, old_weight, .. }: BdfScheme,
    share: f32,
) {
    let to_position = 1.0 / (new_weight * share);
    let current = x.iter().zip(predicted).zip(displacement);
    let before = last.iter().zip(v).zip(a);
    for ((middle, error), (((x, predicted), displacement), ((last, v), a))) in
        middle.iter_mut().zip(error).zip(current.zip(before))
    {
        let start = predicted - displacement;
        let moved = displacement + (x - predicted) * share;
        let step = moved * new_weight - last * old_weight;
        let expected = (v + a * h) * h;
        *middle = (start + x) * 0.5;
        *error = (step - expected) * to_position;
    }
}

/// Whether stages moved any particle since prediction.
pub(super) fn has_corrections(world: &World) -> bool {
    let predicted = world.scratch.predicted.slices();
    world.particles.x.slices() != predicted
}

/// Fills `correction` with what stages moved each particle by since prediction [m].
fn compute_corrections(world: &mut World) {
    let (p, scratch) = (&world.particles, &mut world.scratch);
    scratch.correction.resize(p.len());
    combine(&mut scratch.correction, [&p.x, &scratch.predicted, &p.x], [-1.0, 0.0]);
}

/// Fills `out` with `a + factors[0] · b + factors[1] · c`. A factor of 0 leaves c out: one loop for all
/// sums takes less code than a loop for each.
#[inline(never)]
pub(super) fn combine(out: &mut Columns, from: [&Columns; 3], factors: [f32; 2]) {
    let [a, b, c] = from.map(Columns::slices);
    for (axis, out) in out.slices_mut().into_iter().enumerate() {
        let read = a[axis].iter().zip(b[axis]).zip(c[axis]);
        for (out, ((a, b), c)) in out.iter_mut().zip(read) {
            *out = a + b * factors[0] + c * factors[1];
        }
    }
}

/// Subtracts a rigid motion at the points `relative_wind` from all free particles. The predicted
/// displacement takes the rounding error of that, so that velocities count the exact difference.
fn subtract(world: &mut World, rigid: &RigidMotion) {
    let (share, level) = (world.correction_share(), world.level);
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let at = scratch.relative_wind.slices();
    let [dx, dy, dz] = scratch.displacement.slices_mut();
    for (axis, (x, displacement)) in p.x.slices_mut().into_iter().zip([dx, dy, dz]).enumerate() {
        let motion = rigid.component(axis, at);
        subtract_component(level, x, displacement, motion, &p.w, share);
    }
}

leveled! {
    /// Subtracts one component of a rigid motion.
    fn subtract_component(
        x: &mut [f32],
        displacement: &mut [f32],
        motion: Component<'_>,
        w: &[f32],
        share: f32,
    ) = subtract_column
}

#[inline(always)]
fn subtract_column(
    x: &mut [f32],
    displacement: &mut [f32],
    motion: Component<'_>,
    w: &[f32],
    share: f32,
) {
    let points = motion.at[0].iter().zip(motion.at[1]).zip(w);
    for ((x, displacement), ((a, b), w)) in x.iter_mut().zip(displacement).zip(points) {
        let by = if *w > 0.0 { motion.displacement(*a, *b) } else { 0.0 };
        let before = *x;
        *x = before - by;
        *displacement += ((*x - before) + by) * -share;
    }
}

/// Removes the rigid motion between the positions `before` and `now` from `now`. `before` is scratch
/// afterwards.
pub(crate) fn remove_rigid_motion_since(
    world: &mut World,
    before: &mut Vec<Float4>,
    now: &mut Vec<Float4>,
) {
    compute_velocity_origins(world);
    let (p, scratch) = (&world.particles, &mut world.scratch);
    interleaved::compute_displacements(before, now, &mut scratch.correction);
    let free = FreeParticles {
        x: scratch.relative_wind.slices(),
        displacement: scratch.correction.slices(),
        mass: &p.mass,
        w: &p.w,
    };
    let rigid = RigidMotion::of_free(world.level, free);
    interleaved::subtract_rigid_motion(now, &rigid, before);
    core::mem::swap(now, before);
}

/// Whether the cloth is one piece that pins and grabs do not hold.
pub(crate) fn is_one_free_piece(world: &World) -> bool {
    world.pieces == 1 && !world.is_held()
}

impl World {
    /// Whether a pin or a grab holds a particle.
    pub(super) fn is_held(&self) -> bool {
        self.pins.has_soft() || self.particles.w.iter().any(|w| *w <= 0.0)
    }
}

/// Fills `relative_wind` with the positions that velocities count from: predicted − displacement +
/// last displacement · (old weight / new weight) [m].
fn compute_velocity_origins(world: &mut World) {
    let scheme = world.scheme();
    let ratio = scheme.old_weight / scheme.new_weight;
    let (p, scratch) = (&world.particles, &mut world.scratch);
    let from = [&scratch.predicted, &scratch.displacement, &p.displacement];
    combine(&mut scratch.relative_wind, from, [-1.0, ratio]);
}
