//! Velocities of self-contacts, after positions were solved: impacts, damping, intersections.
//!
//! Method: see `contact_solver`. Damping acts on velocities relative to the rigid motion of the cloth,
//! so that a cloth that turns is not slowed down. Against a side that a collider supports it damps
//! against the collider.
//!
//! Reads contacts, masses and positions; writes velocities and history.
//! Invariant: positions stay as they are.

use crate::solver::integrate::momentum_sums::FreeParticles;
use crate::solver::integrate::rigid_motion::RigidMotion;
use crate::solver::particle_stage::interleaved;
use crate::solver::self_collide::surface::contact_solver;
use crate::solver::self_collide::surface::surface_collision::SurfaceCollision;
use crate::solver::world::World;

/// Corrects derived velocities: impacts become inelastic, relative motion at contacts is damped,
/// and intersections do not deepen.
pub(crate) fn damp_velocities(world: &mut World) {
    let h = world.regular_scheme().h;
    let Some(mut surface) = world.scratch.surface_collision.take() else {
        return;
    };
    let SurfaceCollision {
        contacts, active, open, mobility, motion, vectors, intersections, ..
    } = &mut *surface;
    contact_solver::count_support(contacts, active, mobility, &world.particles.w);
    let is_supported = !world.scratch.contacts.collider_contacts.is_empty();
    let is_free = !is_supported && !interleaved::has_fixed_particle(&motion.start);
    let p = &mut world.particles;
    let velocities = [&mut p.v, &mut p.v_extrapolated];
    let displacement = (!is_supported).then_some(&p.displacement);
    contact_solver::remove_rebound(contacts, active, displacement, velocities, h);
    contact_solver::detect_impacts(active, open);
    for columns in [&mut p.v, &mut p.v_extrapolated, &mut p.displacement] {
        contact_solver::remove_impact_velocities(contacts, active, open, columns);
        intersections.remove_deepening_velocities(&p.w, columns);
        if !active.is_empty() {
            let particles = FreeParticles {
                x: p.x.slices(),
                displacement: columns.slices(),
                mass: &p.mass,
                w: &p.w,
            };
            let rigid = RigidMotion::of_free(world.level, particles);
            interleaved::gather_relative(&rigid, &p.x, columns, vectors);
            contact_solver::damp_contacts(contacts, active, &p.w, vectors, h, !is_free);
            interleaved::scatter_relative(&rigid, &p.x, vectors, columns);
        }
    }
    world.scratch.surface_collision = Some(surface);
}
