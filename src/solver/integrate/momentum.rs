//! Removes the net rigid motion that internal stages add to a free cloth of one piece.
//!
//! ```text
//! Δ = x − x before the stage        Σ m Δ = 0,   Σ m (r − c) × Δ = 0
//! r: the position that velocities count from          c: the centre of mass of all r
//! ```
//! Internal forces change neither linear nor angular momentum. Position-based stages change angular
//! momentum slightly: they move particles along lines between current positions, but velocities
//! count from earlier positions r (see `BdfScheme`). So each move has a small torque about r. Most
//! of these torques cancel. In cloth that presses against itself, such as crumpled paper, they do
//! not, and the cloth would turn without end. Therefore the rigid motion with the momenta of Δ is
//! subtracted from all positions.
//!
//! Two stages use it: bending and particle collision ([`remove_rigid_motion`]), and contacts of
//! surface collision ([`remove_rigid_motion_since`]). In the latter, particles on a collider count
//! as heavy, because the collider takes up their impulse. A floor takes up no impulse along its
//! surface, and crumpled paper would turn on it without end. So on a floor the motion along the
//! surface is removed as well; the motion towards the floor stays.
//!
//! Reads predicted positions and the displacement history; writes positions, and the scratch lists
//! `relative_wind` and `tether_pins`, which are free at that time.
//!
//! Invariant: no particle moves if the cloth has several pieces, if a pin or a grab holds it, or if
//! its collider contacts have several directions.

use crate::math::wide4::Float4;
use crate::solver::bend;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::integrate::rigid_motion::{FreeParticles, RigidMotion};
use crate::solver::particle_stage::interleaved;
use crate::solver::world::World;
use glam::Vec3;

/// Least cosine between contact normals of one floor.
const MIN_FLOOR_COSINE: f32 = 0.999;

/// What a free cloth lies on.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Support {
    /// It touches no collider.
    Free,
    /// All its collider contacts have this normal.
    Floor(Vec3),
}

/// Removes the rigid motion that bending and particle collision added since prediction.
pub(crate) fn remove_rigid_motion(world: &mut World) {
    let may_add_spin = world.particle_collision.is_some() || bend::may_add_spin(world);
    if !may_add_spin || world.pieces != 1 || is_held(world) {
        return;
    }
    compute_velocity_origins(world);
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let displacements = &mut scratch.tether_pins;
    displacements.resize(p.len());
    let all =
        p.x.slices().into_iter().zip(scratch.predicted.slices()).zip(displacements.slices_mut());
    for ((x, predicted), displacements) in all {
        for ((x, predicted), displacement) in x.iter().zip(predicted).zip(displacements) {
            *displacement = x - predicted;
        }
    }
    let free = FreeParticles {
        x: scratch.relative_wind.slices(),
        displacement: displacements.slices(),
        mass: &p.mass,
        w: &p.w,
    };
    let rigid = RigidMotion::of_free(world.level, free);
    for i in 0..p.len() {
        p.x.add(i, -rigid.displacement_at(p.x.get(i)));
    }
}

/// Removes the rigid motion between the positions `before` and `now` from `now`. On a floor this is
/// only the rotation about its normal and the translation along it. `before` is scratch afterwards.
pub(crate) fn remove_rigid_motion_since(
    world: &mut World,
    support: Support,
    before: &mut Vec<Float4>,
    now: &mut Vec<Float4>,
) {
    compute_velocity_origins(world);
    let (p, scratch) = (&world.particles, &mut world.scratch);
    interleaved::compute_displacements(before, now, &mut scratch.tether_pins);
    let free = FreeParticles {
        x: scratch.relative_wind.slices(),
        displacement: scratch.tether_pins.slices(),
        mass: &p.mass,
        w: &p.w,
    };
    let rigid = RigidMotion::of_free(world.level, free);
    let rigid = match support {
        Support::Free => rigid,
        Support::Floor(normal) => rigid.project_on_floor(normal),
    };
    interleaved::subtract_rigid_motion(now, &rigid, before);
    core::mem::swap(now, before);
}

/// The support of a cloth of one piece that pins and grabs do not hold; `None` for other cloth, and
/// for cloth whose collider contacts have several directions.
pub(crate) fn find_support(world: &World) -> Option<Support> {
    if world.pieces != 1 || is_held(world) {
        return None;
    }
    let contacts = &world.scratch.contacts.collider_contacts;
    let Some(first) = contacts.first() else { return Some(Support::Free) };
    let is_on_floor =
        |contact: &ColliderContact| contact.normal.dot(first.normal) > MIN_FLOOR_COSINE;
    contacts.iter().all(is_on_floor).then_some(Support::Floor(first.normal))
}

/// Whether a pin or a grab holds a particle.
fn is_held(world: &World) -> bool {
    world.pins.has_soft() || world.particles.w.iter().any(|w| *w <= 0.0)
}

/// Fills `relative_wind` with the positions that velocities count from: predicted − displacement +
/// last displacement · (old weight / new weight) [m].
fn compute_velocity_origins(world: &mut World) {
    let scheme = world.settings.scheme();
    let ratio = scheme.old_weight / scheme.new_weight;
    let (p, scratch) = (&world.particles, &mut world.scratch);
    let displacements = scratch.displacement.slices().into_iter().zip(p.displacement.slices());
    let columns = scratch.predicted.slices().into_iter().zip(displacements);
    for ((predicted, (displacement, last)), origin) in
        columns.zip(scratch.relative_wind.slices_mut())
    {
        let read = predicted.iter().zip(displacement).zip(last);
        for (((predicted, displacement), last), origin) in read.zip(origin.iter_mut()) {
            *origin = predicted - displacement + last * ratio;
        }
    }
}
