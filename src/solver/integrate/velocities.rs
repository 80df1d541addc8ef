//! Stage `Velocities`: velocities and history from the corrected positions.
//!
//! ```text
//! d = displacement + share · (x − predicted)     v = (new_weight · d − old_weight · d₋) / h     d₋ ← d
//! ```
//! Method: the corrector of `state::settings::BdfScheme`. Damping scales the velocity and its whole
//! history alike, so a free particle slows down by exactly exp(−damping · h). Particles in contact
//! with a collider or moved by an anchor get their velocities afterwards.
//!
//! Reads positions, `scratch.displacement` and `scratch.predicted`; writes the particles'
//! `displacement` (d₋), `v` and `v_extrapolated`.
//! Invariant: positions stay as they are.

use crate::math::simd::leveled;
use crate::math::trig::exp_decay;
use crate::solver::collide::response::resolve_velocities;
use crate::solver::integrate::impact_momentum;
use crate::solver::kinematic::anchors;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::settings::BdfScheme;

/// Updates velocities and history at the end of a substep.
pub(crate) fn update(world: &mut World) {
    let (scheme, share) = (world.scheme(), world.correction_share());
    let decay = exp_decay(f64::from(-world.settings.damping) * f64::from(scheme.h));
    impact_momentum::begin(world, decay);
    let p = &mut world.particles;
    let (displacement, predicted) = (&world.scratch.displacement, &world.scratch.predicted);
    let level = world.level;
    let read = (p.x.slices(), predicted.slices(), displacement.slices());
    let write = (p.displacement.slices_mut(), p.v.slices_mut(), p.v_extrapolated.slices_mut());
    world.threads.parallel_for(
        (read, write),
        MIN_PARTICLES_PER_THREAD,
        |((x, predicted, displacement), write)| {
            let (previous, v, v_extrapolated) = write;
            let read = x.into_iter().zip(predicted).zip(displacement);
            let write = previous.into_iter().zip(v).zip(v_extrapolated);
            for (((x, predicted), displacement), ((previous, v), v_extrapolated)) in read.zip(write)
            {
                update_column(
                    level,
                    [x, predicted, displacement],
                    [previous, v, v_extrapolated],
                    scheme,
                    [decay, share],
                );
            }
        },
    );
    resolve_velocities(world, decay);
    anchors::reset_history(world, decay);
    world.has_no_history = false;
}

leveled! {
    /// Updates one component of velocity and history. `factors`: the decay by damping, and the
    /// share of corrections that counts as velocity ([`World::correction_share`]).
    fn update_column(read: [&[f32]; 3], write: [&mut [f32]; 3], scheme: BdfScheme, factors: [f32; 2])
        = update_column_lanes
}

#[inline(always)]
fn update_column_lanes(
    [x, predicted, displacement]: [&[f32]; 3],
    [previous, v, v_extrapolated]: [&mut [f32]; 3],
    scheme: BdfScheme,
    [decay, share]: [f32; 2],
) {
    let (new_weight, old_weight) = (scheme.new_weight / scheme.h, scheme.old_weight / scheme.h);
    let read = x.iter().zip(predicted).zip(displacement);
    let write = previous.iter_mut().zip(v).zip(v_extrapolated);
    for (((x, predicted), displacement), ((previous, v), v_extrapolated)) in read.zip(write) {
        // The correction is small, so this difference is exact in f32.
        let step = displacement + (x - predicted) * share;
        let v_new = step * new_weight - *previous * old_weight;
        *v_extrapolated = (v_new + (v_new - *v) * scheme.extrapolation) * decay;
        *v = v_new * decay;
        *previous = step * decay;
    }
}
