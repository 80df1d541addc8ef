//! What scripts call.
//!
//! Positions are in the world [m]. A refused call prints an error, changes nothing and returns what
//! its documentation says.

use crate::convert::{to_godot, to_muslin};
use crate::node::MuslinCloth3D;
use crate::refusal::{Refusal, Result};
use godot::builtin::{
    GString, PackedByteArray, PackedInt32Array, PackedVector3Array, VarDictionary, Vector3, vdict,
};
use godot::classes::ArrayMesh;
use godot::obj::{Gd, WithBaseField};
use godot::register::godot_api;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, Error, Grab};

#[godot_api(secondary)]
impl MuslinCloth3D {
    /// Makes the cloth anew from the properties, at rest and untorn. Returns whether it could; if
    /// not, the node keeps the cloth that it has, and [method get_last_error] tells why.
    #[func]
    pub fn rebuild(&mut self) -> bool {
        let made = self.make();
        let is_made = made.is_ok();
        match made {
            Ok((cloth, parameters, made_at)) => {
                self.cloth = Some(cloth);
                self.applied = Some(parameters);
                self.made_at = made_at.pose();
                self.grabs.clear();
                self.colliders.forget();
                self.surface.forget();
                self.last_error.clear();
                self.hide_source();
                self.draw(1.0);
            }
            Err(refusal) => self.report("rebuild", &refusal),
        }
        self.base_mut().update_configuration_warnings();
        is_made
    }

    /// Returns the last refusal: a sentence that names the property or argument and its rule. Empty
    /// after a successful [method rebuild].
    #[func]
    fn get_last_error(&self) -> GString {
        GString::from(&self.last_error)
    }

    /// Returns to the rest shape: untorn, without motion, with the pins that the cloth was made
    /// with, at the place of the node. Grabs are released.
    #[func]
    fn reset(&mut self) {
        let to = match self.placement() {
            Ok(placement) => placement.pose(),
            Err(refusal) => return self.report("reset", &refusal),
        };
        let made_at = self.made_at;
        self.call("reset", |cloth| {
            cloth.reset();
            // The rest shape is at the place where the cloth was made.
            cloth.set_frame(made_at.0, made_at.1)?;
            if to == made_at { Ok(()) } else { cloth.teleport(to.0, to.1) }
        });
        self.grabs.clear();
    }

    /// Runs physics ticks at once, besides those of the game; colliders and the node stay where
    /// they are.
    #[func]
    fn step(&mut self, ticks: i64) {
        let ticks = u32::try_from(ticks);
        let must = "`ticks` must be from 0 to 4294967295";
        match ticks {
            Err(_) => self.report("step", &Refusal::new(must)),
            Ok(ticks) => {
                self.call("step", |cloth| {
                    cloth.step(ticks);
                    Ok(())
                });
            }
        }
    }

    /// Moves the cloth to the place of the node at once, without inertia. Call it after the node
    /// was teleported.
    #[func]
    fn teleport(&mut self) {
        match self.placement() {
            Err(refusal) => self.report("teleport", &refusal),
            Ok(to) => {
                self.call("teleport", |cloth| cloth.teleport(to.position, to.rotation));
            }
        }
    }

    /// Grabs the particle that a ray points at: the nearest corner of the first triangle that it
    /// hits, or the particle nearest to it within [param radius]. Returns a dictionary with
    /// [code]grab[/code], a number for [method move_grab] and [method release_grab], and
    /// [code]position[/code]; it is empty if there is no such particle or the call is refused. Up
    /// to 64 grabs may exist at once.
    #[func]
    fn grab_ray(
        &mut self,
        origin: Vector3,
        direction: Vector3,
        #[opt(default = 0.1)] radius: f32,
    ) -> VarDictionary {
        let (origin, direction) = (to_muslin(origin), to_muslin(direction));
        let found = self.call("grab_ray", |cloth| cloth.grab_ray(origin, direction, radius));
        let Some((grab, at)) = found.flatten() else { return VarDictionary::new() };
        self.grabs.push(grab);
        vdict! { "grab" => i64::from(grab.to_bits()), "position" => to_godot(at) }
    }

    /// Sets the position that a grabbed particle moves to. Returns whether there is such a grab and
    /// the position is finite.
    #[func]
    fn move_grab(&mut self, grab: i64, position: Vector3) -> bool {
        let target = to_muslin(position);
        self.call("move_grab", |cloth| cloth.move_grab(handle(grab), target)).is_some()
    }

    /// Releases a grabbed particle, which keeps its velocity. Returns whether there is such a grab.
    #[func]
    fn release_grab(&mut self, grab: i64) -> bool {
        let grab = handle(grab);
        let released = self.call("release_grab", |cloth| cloth.release(grab));
        self.grabs.retain(|held| *held != grab);
        released.is_some()
    }

    /// Returns what a ray hits first within [param max_distance]: a dictionary with
    /// [code]position[/code], [code]normal[/code], [code]distance[/code], [code]triangle[/code] and
    /// [code]particle[/code], the nearest corner; it is empty if the ray hits nothing or the call is
    /// refused.
    #[func]
    fn raycast(
        &mut self,
        origin: Vector3,
        direction: Vector3,
        #[opt(default = 1000.0)] max_distance: f32,
    ) -> VarDictionary {
        let (origin, direction) = (to_muslin(origin), to_muslin(direction));
        let found = self.call("raycast", |cloth| cloth.raycast(origin, direction, max_distance));
        let Some(hit) = found.flatten() else { return VarDictionary::new() };
        vdict! {
            "position" => to_godot(hit.position),
            "normal" => to_godot(hit.normal),
            "distance" => hit.distance,
            "triangle" => i64::from(hit.triangle),
            "particle" => i64::from(hit.particle),
        }
    }

    /// Cuts along the surface that the segment between two points sweeps. Returns the number of
    /// edges that were cut, and -1 if the call is refused.
    #[func]
    fn cut(&mut self, from: Vector3, to: Vector3, sweep: Vector3) -> i64 {
        let [from, to, sweep] = [from, to, sweep].map(to_muslin);
        self.call("cut", |cloth| cloth.cut(from, to, sweep)).map_or(-1, i64::from)
    }

    /// Pins a particle, or moves its pin: it reaches [param position] in the next physics tick, and
    /// then follows the node as other pins do. Returns whether the particle exists and the position
    /// is finite.
    #[func]
    fn pin(&mut self, particle: i64, position: Vector3) -> bool {
        let target = to_muslin(position);
        self.call("pin", |cloth| cloth.pin(index(particle)?, Some(target))).is_some()
    }

    /// Releases a pinned particle. Returns whether the particle exists.
    #[func]
    fn unpin(&mut self, particle: i64) -> bool {
        self.call("unpin", |cloth| cloth.unpin(index(particle)?)).is_some()
    }

    /// Returns the pinned particles.
    #[func]
    fn get_pinned(&self) -> PackedInt32Array {
        self.cloth.iter().flat_map(Cloth::pinned).map(|particle| particle as i32).collect()
    }

    /// Returns the positions of all vertices in the world.
    #[func]
    fn get_positions(&self) -> PackedVector3Array {
        self.cloth.iter().flat_map(Cloth::positions).map(|x| to_godot(*x)).collect()
    }

    /// Returns the mesh that is drawn, in the space of the node. It changes in each frame.
    #[func]
    fn get_drawn_mesh(&self) -> Option<Gd<ArrayMesh>> {
        self.surface.mesh()
    }

    /// Returns numbers about the cloth: [code]particles[/code], [code]triangles[/code],
    /// [code]pieces[/code], [code]ticks[/code], [code]colliders[/code], [code]max_stretch[/code],
    /// [code]over_stretched[/code], [code]held_inside[/code], [code]free_inside[/code],
    /// [code]crossings[/code], [code]max_speed[/code] (m/s), [code]asleep[/code]. It is empty if
    /// there is no cloth.
    #[func]
    fn get_stats(&self) -> VarDictionary {
        let Some(cloth) = &self.cloth else { return VarDictionary::new() };
        let stats = cloth.stats();
        vdict! {
            "particles" => i64::from(stats.particles),
            "triangles" => i64::from(stats.triangles),
            "pieces" => i64::from(stats.pieces),
            "ticks" => i64::from(stats.ticks),
            "colliders" => self.colliders.handles().count() as i64,
            "max_stretch" => stats.max_stretch,
            "over_stretched" => i64::from(stats.over_stretched),
            "held_inside" => i64::from(stats.held_inside),
            "free_inside" => i64::from(stats.free_inside),
            "crossings" => i64::from(stats.crossings),
            "max_speed" => stats.max_speed,
            "asleep" => stats.asleep,
        }
    }

    /// Returns the material that the cloth has: the values of the preset and of the properties that
    /// are not -1.
    #[func]
    fn get_material_values(&self) -> VarDictionary {
        let Some(cloth) = &self.cloth else { return VarDictionary::new() };
        let m = cloth.material();
        vdict! {
            "density" => m.density,
            "thickness" => m.thickness,
            "stretch_stiffness_warp" => m.stretch_stiffness_warp,
            "stretch_stiffness_weft" => m.stretch_stiffness_weft,
            "shear_stiffness" => m.shear_stiffness,
            "bend_stiffness" => m.bend_stiffness,
            "bend_damping" => m.bend_damping,
            "stretch_damping" => m.stretch_damping,
            "friction" => m.friction,
            "restitution" => m.restitution,
            "drag" => m.drag,
            "lift" => m.lift,
            "tear_stretch" => m.tear_stretch,
            "tear_variation" => m.tear_variation,
            "yield_angle" => m.yield_angle,
            "yield_creep" => m.yield_creep,
            "fold_length" => m.fold_length,
            "yield_hardening" => m.yield_hardening,
            "yield_weakening" => m.yield_weakening,
        }
    }

    /// Returns a number that is equal for equal states of the cloth, on every platform.
    #[func]
    fn state_hash(&self) -> i64 {
        self.cloth.as_ref().map_or(0, |cloth| cloth.state_hash().cast_signed())
    }

    /// Searches the colliders again, and reads their shapes again, in the next physics tick. Call it
    /// after a node joined or left [member collider_group]; other changes of the scene are noticed.
    #[func]
    fn refresh_colliders(&mut self) {
        self.colliders.read_again();
    }

    /// Returns the state of the cloth, torn as it is, for [method restore]. Colliders and grabs are
    /// not in it; they belong to the scene.
    #[func]
    fn save(&self) -> PackedByteArray {
        let Some(cloth) = &self.cloth else { return PackedByteArray::new() };
        let mut copy = cloth.clone();
        for collider in self.colliders.handles() {
            copy.remove_collider(collider).ok();
        }
        for grab in &self.grabs {
            copy.release(*grab).ok();
        }
        let (position, rotation) = self.made_at;
        let numbers = position.to_array().into_iter().chain(rotation.to_array());
        copy.save().into_iter().chain(numbers.flat_map(f32::to_le_bytes)).collect()
    }

    /// Brings back a state of [method save], at the place in the world where it was; pins follow the
    /// node from where it is now. The properties stay those of the node. Returns whether the bytes
    /// are a state; if not, nothing changes.
    #[func]
    fn restore(&mut self, bytes: PackedByteArray) -> bool {
        match self.restored(bytes.as_slice()) {
            Ok(()) => true,
            Err(refusal) => {
                self.report("restore", &refusal);
                false
            }
        }
    }
}

/// Size of the pose at the end of saved bytes: position and rotation.
const POSE_BYTES: usize = 28;

impl MuslinCloth3D {
    /// Calls the library, and reports what it refuses; none then.
    fn call<T>(
        &mut self,
        name: &str,
        run: impl FnOnce(&mut Cloth) -> muslin::Result<T>,
    ) -> Option<T> {
        let Some(cloth) = &mut self.cloth else {
            let why =
                if self.last_error.is_empty() { "the node is not ready" } else { &self.last_error };
            godot::global::godot_error!("MuslinCloth3D, {name}: there is no cloth: {why}");
            return None;
        };
        match run(cloth) {
            Ok(value) => Some(value),
            Err(error) => {
                self.report(name, &Refusal::from_node(&error));
                None
            }
        }
    }

    fn restored(&mut self, bytes: &[u8]) -> Result<()> {
        let bad = |why: &str| {
            let why = why.trim_start_matches("`buffer` must hold a saved cloth: ");
            Refusal::new(format!("`bytes` must hold a state of `save`: {why}"))
        };
        let size = bytes.len().checked_sub(POSE_BYTES).ok_or_else(|| bad("they are too short"))?;
        let (state, pose) = bytes.split_at(size);
        let mut cloth = Cloth::restore(state).map_err(|error| bad(&error.to_string()))?;
        let mut numbers = [0.0; POSE_BYTES / 4];
        for (number, bytes) in numbers.iter_mut().zip(pose.chunks_exact(4)) {
            *number = f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        }
        let [x, y, z, i, j, k, w] = numbers;
        let made_at = (Vec3::new(x, y, z), Quat::from_xyzw(i, j, k, w));
        // Refuses a pose that is none.
        cloth.set_frame(made_at.0, made_at.1).map_err(|error| bad(&error.to_string()))?;
        let now = self.placement()?.pose();
        cloth.set_frame(now.0, now.1).map_err(|error| bad(&error.to_string()))?;
        self.made_at = made_at;
        self.cloth = Some(cloth);
        self.applied = None;
        self.grabs.clear();
        self.colliders.forget();
        self.surface.forget();
        Ok(())
    }
}

fn handle(grab: i64) -> Grab {
    // No grab has the number 0.
    Grab::from_bits(u32::try_from(grab).unwrap_or(0))
}

fn index(particle: i64) -> muslin::Result<u32> {
    let bad = Error::BadValue { field: "particle", must: "be from 0 to 4294967295" };
    u32::try_from(particle).map_err(|_| bad)
}
