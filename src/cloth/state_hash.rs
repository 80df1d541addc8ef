//! The state of a cloth as one number: equal on every machine that was told the same.

use crate::cloth::Cloth;
use crate::math::hasher::StateHasher;

impl Cloth {
    /// A hash over all that the next tick depends on: positions, history, velocities, masses,
    /// triangles, folds and how much they gave way, pins, grabs, colliders, tethers, what layers bear on each other with and whether they cross, and time.
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
        for crossing in &world.crossings {
            hasher.write_u32s(&crossing.ends);
            hasher.write_f32s(&[crossing.fraction]);
        }
        if world.folds.has_any {
            world.folds.angle.iter().for_each(|angle| hasher.write_f32s(angle));
        }
        hasher.write_f32s(world.folds.hardening.saved());
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
        for carrier in world.attachments.iter() {
            for pose in [&carrier.last, &carrier.next] {
                hasher.write_f32s(&pose.position.to_array());
                hasher.write_f32s(&pose.rotation.to_array());
            }
        }
        for leash in world.anchors.iter() {
            hasher.write_u32(leash.particle);
            for v in [leash.from, leash.anchor, leash.normal_from, leash.normal] {
                hasher.write_f32s(&v.to_array());
            }
            hasher.write_f32s(&[
                leash.max_distance,
                leash.backstop_distance,
                leash.backstop_radius,
            ]);
        }
        for held in world.grabs.iter() {
            hasher.write_u32(held.particle);
            hasher.write_f32s(&held.target.to_array());
        }
        for body in world.colliders.iter() {
            body.desc.hash(&mut hasher);
            for pose in [&body.last, &body.next] {
                hasher.write_f32s(&pose.position.to_array());
                hasher.write_f32s(&pose.rotation.to_array());
            }
        }
        for load in world.warm_start.iter() {
            hasher.write_u32s(&load.ids);
            hasher.write_u32(load.first);
            hasher.write_f32s(&[load.push]);
            hasher.write_f32s(&load.rub.to_array());
        }
        if world.surface_collision.is_some() && world.is_tangled {
            hasher.write_u32(1);
        }
        hasher.write_f32s(&[world.tether_slack]);
        hasher.write_u32(world.tick);
        hasher.finish()
    }
}
