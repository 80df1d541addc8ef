//! State hash: one number over everything that the next tick depends on.
//!
//! Two machines that received the same calls have the same hash; this is how determinism is tested.
//! Reads `World`; writes nothing.
//! Invariant: the order of the hashed fields is fixed, since golden tests compare the values.

use crate::cloth::Cloth;
use crate::math::float_env::with_float_env;
use crate::math::hasher::StateHasher;
use crate::state::colliders::Impulse;
use glam::Vec3;

impl Cloth {
    /// Returns a hash of all state that the next tick depends on. Equal calls give equal hashes on
    /// every platform and for any number of threads.
    ///
    /// The hash covers positions, history, velocities, masses, triangles, folds with their
    /// accumulated yield, painted maps, pins, attachments, anchors, sewn pairs, grabs, colliders with
    /// their impulses, tethers, warm-start impulses of self-collision, the flag for unresolved
    /// intersections, origin, substeps that the last tick added, and time.
    pub fn state_hash(&self) -> u64 {
        let (world, mut hasher) = (&self.world, StateHasher::new(0));
        let p = &world.particles;
        for columns in [&p.x, &p.displacement, &p.v, &p.v_extrapolated] {
            for column in [&columns.x, &columns.y, &columns.z] {
                hasher.write_f32s(column);
            }
        }
        hasher.write_f32s(&p.mass);
        hasher.write_f32s(&p.w);
        hasher.write_u32s(world.mesh.triangles.as_flattened());
        hasher.write_u32s(&world.mesh.source);
        for crossing in &world.cut_sites {
            hasher.write_u32s(&crossing.ends);
            hasher.write_f32s(&[crossing.fraction]);
        }
        if world.folds.has_any {
            world.folds.angle.iter().for_each(|angle| hasher.write_f32s(angle));
        }
        hasher.write_f32s(world.folds.hardening.saved());
        for (map, scales) in world.maps.iter() {
            hasher.write_u32(map);
            hasher.write_f32s(scales);
        }
        for pin in world.pins.iter() {
            hasher.write_u32(pin.particle);
            hasher.write_f32s(&pin.from.to_array());
            hasher.write_f32s(&pin.target.to_array());
            if pin.is_soft() {
                hasher.write_f32s(&[pin.stiffness]);
            }
            if pin.attachment != 0 {
                hasher.write_u32(pin.attachment);
                hasher.write_f32s(&pin.local.to_array());
            }
        }
        for motion in world.attachments.iter() {
            for pose in [&motion.last, &motion.next] {
                hasher.write_f32s(&pose.position.to_array());
                hasher.write_f32s(&pose.rotation.to_array());
            }
        }
        for anchor in world.anchors.iter() {
            hasher.write_u32(anchor.particle);
            for v in [anchor.from, anchor.anchor, anchor.normal_from, anchor.normal] {
                hasher.write_f32s(&v.to_array());
            }
            hasher.write_f32s(&[
                anchor.max_distance,
                anchor.backstop_distance,
                anchor.backstop_radius,
            ]);
        }
        for pair in world.sewing.pairs() {
            hasher.write_u32s(&pair.particles);
            hasher.write_u32s(&[pair.kind as u32, pair.state as u32]);
            hasher.write_f32s(&[pair.length, pair.speed, pair.tear_force]);
        }
        for grab in world.grabs.iter() {
            hasher.write_u32(grab.particle);
            hasher.write_f32s(&grab.target.to_array());
        }
        for body in world.colliders.iter() {
            body.desc.hash(&mut hasher);
            if let Some(deformation) = body.deformation() {
                deformation.hash(&mut hasher);
            }
            for pose in [&body.last, &body.next] {
                hasher.write_f32s(&pose.position.to_array());
                hasher.write_f32s(&pose.rotation.to_array());
            }
            for Impulse { linear, angular } in [body.impulse, body.pending] {
                hasher.write_f32s(&linear.to_array());
                hasher.write_f32s(&angular.to_array());
            }
        }
        for contact in world.warm_start.iter() {
            hasher.write_u32s(&contact.ids);
            hasher.write_u32(contact.kind);
            hasher.write_f32s(&[contact.normal]);
            hasher.write_f32s(&contact.tangent.to_array());
        }
        if world.scratch.surface_collision.is_some() && world.is_tangled {
            hasher.write_u32(1);
        }
        let share = with_float_env(|| world.correction_share());
        if share != 1.0 || world.has_no_history {
            hasher.write_f32s(&[world.stiffness_step]);
            hasher.write_u32(u32::from(world.has_no_history));
        }
        if world.substeps != world.settings.substeps {
            hasher.write_u32(world.substeps);
        }
        if world.origin != Vec3::ZERO {
            hasher.write_f32s(&world.origin.to_array());
        }
        hasher.write_f32s(&[world.tether_slack]);
        hasher.write_u32(world.clock.tick);
        hasher.finish()
    }
}
