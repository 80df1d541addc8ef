//! Sewn pairs and the non-crossing pass, until both hold.
//!
//! Method: both alternate, as colliders and the non-crossing pass do. The non-crossing pass moves the
//! two sides of a pair apart, and joining them again may put them through other layers.
//!
//! Reads sewn pairs and where the substep began; writes positions and `motion.now`.
//! Invariant: closed pairs are joined afterwards, and `motion.now` holds the positions.

use crate::solver::particle_stage::interleaved;
use crate::solver::self_collide::surface::surface_collision::SurfaceCollision;
use crate::solver::stretch::sewn_pairs;
use crate::solver::world::World;

/// Rounds in which sewn pairs and the non-crossing pass alternate.
const SEWN_ROUNDS: u32 = 12;

/// Alternates between sewn pairs and the non-crossing pass until both hold. Pairs that this does not
/// join go back to where the substep began, and so does what they cross there. What still separates a
/// pair after that is joined: sewn pairs take precedence over non-crossing.
#[inline(never)]
pub(super) fn enforce_joined(surface: &mut SurfaceCollision, world: &mut World) {
    for round in 0..SEWN_ROUNDS {
        interleaved::scatter(&surface.motion.now, &mut world.particles.x);
        let has_moved = if round < SEWN_ROUNDS / 2 {
            sewn_pairs::join(world)
        } else {
            sewn_pairs::roll_back_open(world, &surface.motion.start)
        };
        if !has_moved {
            return;
        }
        interleaved::gather(&mut surface.motion.now, &world.particles.x, &world.particles.w);
        if !surface.enforce_non_crossing(world) {
            return;
        }
    }
    interleaved::scatter(&surface.motion.now, &mut world.particles.x);
    sewn_pairs::join(world);
    interleaved::gather(&mut surface.motion.now, &world.particles.x, &world.particles.w);
}
