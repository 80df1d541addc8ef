//! Stage `Velocities`: what the substep made of each particle's motion.
//!
//! The other half of `Scheme`. Damping scales the velocity and its whole history alike, which makes a
//! free particle slow down by exactly exp(-damping h).

use crate::solver::collide::response::resolve_velocities;
use crate::solver::kinematic::anchors;

use crate::math::simd::leveled;
use crate::math::trig::exp_decay;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::settings::Scheme;

/// Derives velocities and moves the history on.
pub(crate) fn derive(world: &mut World) {
    let scheme = world.settings.scheme();
    let keep = exp_decay(f64::from(-world.settings.damping) * f64::from(scheme.h));
    let p = &mut world.particles;
    let (way, predicted) = (&world.scratch.displacement, &world.scratch.predicted);
    let level = world.level;
    let read = (p.x.all(), predicted.all(), way.all());
    let write = (p.moved.all_mut(), p.v.all_mut(), p.v_ahead.all_mut());
    world.threads.parallel_for(
        (read, write),
        MIN_PARTICLES_PER_THREAD,
        |((x, predicted, way), write)| {
            let (moved, v, v_ahead) = write;
            let read = x.into_iter().zip(predicted).zip(way);
            let write = moved.into_iter().zip(v).zip(v_ahead);
            for (((x, predicted), way), ((moved, v), v_ahead)) in read.zip(write) {
                renew(level, [x, predicted, way], [moved, v, v_ahead], scheme, keep);
            }
        },
    );
    resolve_velocities(world, keep);
    anchors::settle(world, keep);
}

leveled! {
    /// Velocity and history in one direction.
    fn renew(read: [&[f32]; 3], write: [&mut [f32]; 3], scheme: Scheme, keep: f32) = renew_column
}

#[inline(always)]
fn renew_column(
    [x, predicted, way]: [&[f32]; 3],
    [moved, v, v_ahead]: [&mut [f32]; 3],
    scheme: Scheme,
    keep: f32,
) {
    let (lead, trail) = (scheme.lead / scheme.h, scheme.trail / scheme.h);
    let read = x.iter().zip(predicted).zip(way);
    let write = moved.iter_mut().zip(v).zip(v_ahead);
    for (((x, predicted), way), ((moved, v), v_ahead)) in read.zip(write) {
        // What the solver corrected is small, so that this difference is exact.
        let step = way + (x - predicted);
        let v_new = step * lead - *moved * trail;
        *v_ahead = (v_new + (v_new - *v) * scheme.carry) * keep;
        *v = v_new * keep;
        *moved = step * keep;
    }
}
