//! Velocities of elastic corrections where the settings change the substep length.
//!
//! ```text
//! counted = displacement + share · (x − predicted)         share: World::correction_share
//! ```
//! Method: after such a change only a share of each correction counts as velocity,
//! because the stiffness of rigid links grows with 1 / h². The stiffness of a soft sheet does not
//! grow, so a larger share of its corrections counts: the predicted position and displacement take
//! that part. The position at the start of the substep, their difference, stays.
//!
//! Reads and writes positions in the current layout, `scratch.predicted` and
//! `scratch.displacement`; `scratch.relative_wind` is a buffer.
//! Invariant: while ticks have one length, nothing changes but by the stage itself, also where a
//! fast motion adds substeps.

use crate::math::columns::Columns;
use crate::math::{TINY, max};
use crate::solver::particle_stage::access::ParticleAccess;
use crate::solver::tick_scratch::TickScratch;
use crate::solver::world::World;
use glam::Vec3;

/// Runs bending, of whose corrections at least `World::bending_share` counts as velocity.
#[inline(always)]
pub(crate) fn run(world: &mut World, mut bend: impl FnMut(&mut World)) {
    if world.has_regular_stiffness() {
        bend(world);
    } else {
        run_counted(world, &mut bend);
    }
}

/// Runs bending after the settings changed the substep length. Never inlined, since it is rare.
#[inline(never)]
fn run_counted(world: &mut World, bend: &mut dyn FnMut(&mut World)) {
    let (share, least) = (world.bending_share(), world.correction_share());
    if share <= least {
        return bend(world);
    }
    let part = (share - least) / (1.0 - least);
    let mut moved = core::mem::take(&mut world.scratch.relative_wind);
    (0..world.particles.len()).for_each(|i| moved.set(i, position(world, i)));
    bend(world);
    for i in 0..world.particles.len() {
        moved.set(i, (position(world, i) - moved.get(i)) * part);
        world.scratch.predicted.add(i, moved.get(i));
        world.scratch.displacement.add(i, moved.get(i));
    }
    remove_momentum(world, &moved);
    world.scratch.relative_wind = moved;
}

/// Subtracts the mean of `moved` [m], which is rounding, from the displacements of each free piece.
fn remove_momentum(world: &mut World, moved: &Columns) {
    let TickScratch { pieces, displacement, .. } = &mut world.scratch;
    let p = &world.particles;
    for piece in pieces.members.iter() {
        let all = || piece.iter().map(|i| *i as usize);
        if all().any(|i| p.w[i] <= 0.0) {
            continue;
        }
        let (sum, mass) = all().fold((Vec3::ZERO, 0.0), |(sum, mass), i| {
            (sum + moved.get(i) * p.mass[i], mass + p.mass[i])
        });
        let mean = sum * (1.0 / max(mass, TINY));
        all().for_each(|i| displacement.add(i, -mean));
    }
}

/// Position of a particle in the layout that is current [m].
fn position(world: &World, i: usize) -> Vec3 {
    let interleaved = &world.scratch.interleaved;
    if interleaved.is_current { interleaved.particle(i).0 } else { world.particles.x.get(i) }
}
