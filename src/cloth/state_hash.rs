//! The state of a cloth as one number: equal on every machine that was told the same.

use crate::cloth::Cloth;
use crate::math::mixer::Mixer;

impl Cloth {
    /// A hash over all that the next tick depends on: positions, history, velocities, masses,
    /// triangles, folds and how much they gave way, pins, grabs, colliders, tethers, what layers bear on each other with and whether they cross, and time.
    pub fn state_hash(&self) -> u64 {
        let (world, mut mixer) = (&self.world, Mixer::new(0));
        let p = &world.particles;
        for columns in [&p.x, &p.moved, &p.v, &p.v_ahead] {
            for column in [&columns.x, &columns.y, &columns.z] {
                mixer.floats(column);
            }
        }
        mixer.floats(&p.mass);
        mixer.floats(&p.w);
        mixer.words(world.mesh.triangles.as_flattened());
        mixer.words(&world.mesh.source);
        for crossing in &world.crossings {
            mixer.words(&crossing.ends);
            mixer.floats(&[crossing.share]);
        }
        if world.folds.are_any {
            world.folds.angle.iter().for_each(|angle| mixer.floats(angle));
        }
        mixer.floats(world.folds.wear.kept());
        for pin in world.pins.iter() {
            mixer.word(pin.particle);
            mixer.floats(&pin.from.to_array());
            mixer.floats(&pin.target.to_array());
            if pin.is_soft() {
                mixer.floats(&[pin.stiffness]);
            }
            if pin.carrier != 0 {
                mixer.word(pin.carrier);
                mixer.floats(&pin.local.to_array());
            }
        }
        for carrier in world.attachments.iter() {
            for pose in [&carrier.last, &carrier.next] {
                mixer.floats(&pose.position.to_array());
                mixer.floats(&pose.rotation.to_array());
            }
        }
        for leash in world.anchors.iter() {
            mixer.word(leash.particle);
            for v in [leash.from, leash.anchor, leash.normal_from, leash.normal] {
                mixer.floats(&v.to_array());
            }
            mixer.floats(&[leash.max_distance, leash.backstop_distance, leash.backstop_radius]);
        }
        for held in world.grabs.iter() {
            mixer.word(held.particle);
            mixer.floats(&held.target.to_array());
        }
        for body in world.colliders.iter() {
            body.desc.hash(&mut mixer);
            for pose in [&body.last, &body.next] {
                mixer.floats(&pose.position.to_array());
                mixer.floats(&pose.rotation.to_array());
            }
        }
        for load in world.warm_start.iter() {
            mixer.words(&load.ids);
            mixer.word(load.first);
            mixer.floats(&[load.push]);
            mixer.floats(&load.rub.to_array());
        }
        if world.surface_collision.is_some() && world.is_tangled {
            mixer.word(1);
        }
        mixer.floats(&[world.tether_slack]);
        mixer.word(world.tick);
        mixer.finish()
    }
}
