//! The public noun: takes edits, runs ticks, hands out what a renderer reads.

mod anchors;
mod attachments;
mod blended_surface;
mod build;
pub(crate) mod changes;
mod colliders;
mod crease;
mod cut;
pub(crate) mod desc;
#[cfg(test)]
mod equal_bits;
mod mass_scales;
mod pins;
mod postcard;
pub(crate) mod query;
mod save;
mod state_hash;
mod tear;
mod teleport;
#[cfg(feature = "parallel")]
mod threads;
pub(crate) mod vertex_stream;
pub(crate) mod view;
pub(crate) mod write_vertices;

use crate::error::{Result, check, check_finite, check_index};
use crate::math::float_env::with_float_env;
use crate::mesh::report::MeshReport;
use crate::model::material::Material;
use crate::solver::pipeline;
use crate::solver::profile::Clock;
use crate::solver::self_collide::surface::split_separation;

use crate::cloth::build::Origin;
use crate::cloth::changes::History;
use crate::cloth::desc::{GridDesc, MeshDesc};
use crate::cloth::view::Outputs;
use crate::solver::world::World;
use crate::state::events::Event;
use crate::state::grabs::{Grab, GrabbedParticle};
use crate::state::settings::Settings;
use crate::state::wind::Wind;
use glam::Vec3;

/// A piece of cloth.
///
/// It moves in fixed ticks: [`Cloth::advance`] runs those that a frame owes, [`Cloth::step`] a given
/// number. The same calls give the same bits on every platform. A refused call changes nothing.
#[derive(Debug)]
pub struct Cloth {
    origin: Origin,
    world: World,
    outputs: Outputs,
    report: MeshReport,
    /// Time that `advance` was given and has not run yet [s].
    owed: f64,
    /// Whether pins changed since the tethers were measured.
    pins_changed: bool,
    topology_revision: u32,
    state_revision: u32,
    history: History,
}

impl Clone for Cloth {
    /// Another cloth in the same state; handles of grabs, attachments and colliders hold for both.
    fn clone(&self) -> Self {
        let mut copy = Self {
            origin: self.origin.clone(),
            world: self.world.clone(),
            outputs: Outputs::new(&self.world),
            report: self.report,
            owed: self.owed,
            pins_changed: self.pins_changed,
            topology_revision: self.topology_revision,
            state_revision: self.state_revision,
            history: self.history.clone(),
        };
        // A cloned list has no spare room; what tears need is reserved anew.
        copy.world.reserve(self.world.capacity());
        copy.outputs = Outputs::new(&copy.world);
        copy.outputs.set_uvs(&copy.origin);
        copy.outputs.follow_topology(&copy.world);
        copy.outputs.follow(&copy.world);
        copy
    }
}

impl Cloth {
    /// Makes a cloth from a regular grid.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the field of `desc` that cannot be, and the rule;
    /// [`Error::Unsupported`](crate::Error::Unsupported) what this version does not do yet.
    pub fn grid(desc: &GridDesc) -> Result<Self> {
        desc.check()?;
        Self::from_origin(Origin::Grid(desc.clone()))
    }

    /// Makes a cloth from any triangle mesh. What cannot be cloth in it is repaired, and
    /// [`Cloth::mesh_report`] tells what was.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) or [`Error::BadIndex`](crate::Error::BadIndex) names
    /// the field of `desc` that cannot be; [`Error::BadMesh`](crate::Error::BadMesh) what is beyond repair: a
    /// triangle whose area is not finite, or that none has an area;
    /// [`Error::Unsupported`](crate::Error::Unsupported) what this version does not do yet.
    pub fn mesh(desc: &MeshDesc) -> Result<Self> {
        desc.check()?;
        Self::from_origin(Origin::Mesh(desc.clone()))
    }

    fn from_origin(origin: Origin) -> Result<Self> {
        let (mut world, report) = with_float_env(|| origin.world())?;
        world.check_self_distance(&world.settings)?;
        with_float_env(|| {
            world.see_to_crowd();
            world.see_to_layers();
        });
        let mut outputs = Outputs::new(&world);
        outputs.set_uvs(&origin);
        outputs.follow_topology(&world);
        outputs.follow(&world);
        Ok(Self {
            origin,
            world,
            outputs,
            report,
            owed: 0.0,
            pins_changed: false,
            topology_revision: 1,
            state_revision: 1,
            history: History::new(),
        })
    }

    /// Back to the start: rest shape, untorn, at rest, pinned as it was made, at time zero, as heavy as its
    /// material says, no grabs, no attachments, no leashes and no events. Settings, material, wind and colliders stay as they are.
    pub fn reset(&mut self) {
        // The descriptor was good enough once, so it is again.
        let Ok((mut fresh, _)) = with_float_env(|| self.origin.world()) else {
            return;
        };
        core::mem::swap(&mut fresh.colliders, &mut self.world.colliders);
        fresh.settings = self.world.settings.clone();
        fresh.material = self.world.material.clone();
        fresh.folds.reserve_hardening(&fresh.material);
        fresh.wind = self.world.wind.clone();
        fresh.profile.set_clock(self.world.profile.clock());
        fresh.threads = self.world.threads;
        // Grabs and attachments are let go, and their handles stay stale.
        core::mem::swap(&mut fresh.grabs, &mut self.world.grabs);
        fresh.grabs.clear();
        core::mem::swap(&mut fresh.attachments, &mut self.world.attachments);
        fresh.attachments.clear();
        fresh.scratch.tear.reserve(fresh.settings.max_tears(fresh.triangle_capacity));
        self.world = fresh;
        self.world.reserve_contacts();
        with_float_env(|| {
            self.world.compute_masses();
            self.world.constraints.update_compliances(&self.world.material);
            self.world.rebuild_tethers();
            self.world.reset_history();
            self.world.see_to_crowd();
            self.world.see_to_layers();
        });
        self.owed = 0.0;
        self.pins_changed = false;
        self.changed_topology();
        self.changed_state();
    }

    /// How time runs.
    pub fn settings(&self) -> &Settings {
        &self.world.settings
    }

    /// Changes how time runs, from the next tick on. Velocities stay as they are.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the field and the rule;
    /// [`Error::Unsupported`](crate::Error::Unsupported) what this version does not do yet.
    pub fn set_settings(&mut self, settings: Settings) -> Result<()> {
        settings.check()?;
        let world = &mut self.world;
        world.check_self_distance(&settings)?;
        let restarts = settings.scheme() != world.settings.scheme();
        let touches = |settings: &Settings| (settings.self_collision, settings.self_distance);
        let touches_otherwise = touches(&settings) != touches(&world.settings);
        let is_new = world.surface_collision.is_none();
        world.scratch.tear.reserve(settings.max_tears(world.triangle_capacity));
        let is_unsorted = world.settings.max_stretch == 0.0;
        if settings != world.settings {
            world.wake();
        }
        world.settings = settings;
        if is_unsorted {
            world.rebuild_pin_order();
        }
        if touches_otherwise {
            with_float_env(|| {
                world.see_to_crowd();
                world.see_to_layers();
                if is_new {
                    world.is_tangled = true;
                    let count = world.particles.len() as u32;
                    split_separation::part(world, 0..count);
                }
            });
        }
        if restarts {
            with_float_env(|| {
                world.reset_history();
                world.refresh_soft_pin_masses();
            });
        }
        if is_new && self.world.surface_collision.is_some() {
            self.changed_state();
        }
        Ok(())
    }

    /// What it is made of.
    pub fn material(&self) -> &Material {
        &self.world.material
    }

    /// Changes what it is made of, from the next tick on. Velocities stay as they are.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the field and the rule.
    pub fn set_material(&mut self, material: Material) -> Result<()> {
        material.check()?;
        let world = &mut self.world;
        if material != world.material {
            world.wake();
        }
        let reweigh = material.density != world.material.density;
        world.scratch.contacts.nearby.invalidate();
        world.material = material;
        world.folds.reserve_hardening(&world.material);
        with_float_env(|| {
            world.constraints.update_compliances(&world.material);
            if reweigh {
                world.compute_masses();
            }
        });
        Ok(())
    }

    /// The air around it.
    pub fn wind(&self) -> &Wind {
        &self.world.wind
    }

    /// Changes the air around it, from the next tick on.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the field and the rule.
    pub fn set_wind(&mut self, wind: Wind) -> Result<()> {
        wind.check()?;
        if wind != self.world.wind {
            self.world.wake();
        }
        self.world.wind = wind;
        Ok(())
    }

    /// Runs the ticks that a frame of `seconds` [s] owes, and says how many ran.
    ///
    /// What is left over waits for the next frame, see [`Cloth::blend`]. A late frame owes at most
    /// `max_ticks_per_advance`; the rest is dropped. Zero changes nothing.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `seconds` is negative or not finite.
    pub fn advance(&mut self, seconds: f32) -> Result<u32> {
        check(seconds.is_finite() && seconds >= 0.0, "seconds", "be at least 0 and finite")?;
        let (ticks, owed) = with_float_env(|| {
            let tick = f64::from(self.world.settings.tick);
            let owed = self.owed + f64::from(seconds);
            let whole = (owed / tick).floor();
            let most = self.world.settings.max_ticks_per_advance;
            let ticks = if whole < f64::from(most) { whole as u32 } else { most };
            (ticks, owed - whole * tick)
        });
        self.owed = if owed > 0.0 { owed } else { 0.0 };
        self.step(ticks);
        Ok(ticks)
    }

    /// Runs exactly `ticks` ticks.
    pub fn step(&mut self, ticks: u32) {
        self.world.profile.reset();
        if ticks == 0 {
            return;
        }
        let vertices = self.world.mesh.vertex_count();
        let (pins_changed, world) = (core::mem::take(&mut self.pins_changed), &mut self.world);
        let has_moved = world.threads.run_in_pool(world.particles.len(), || {
            with_float_env(|| {
                if pins_changed {
                    world.rebuild_tethers();
                }
                (0..ticks).fold(false, |has_moved, _| pipeline::tick(world) || has_moved)
            })
        });
        if self.world.mesh.vertex_count() != vertices {
            self.changed_topology();
        }
        if has_moved {
            self.changed_state();
        }
    }

    /// The share of a tick that `advance` still owes, 0 to 1: how far to blend from the last tick's
    /// positions to this one's when drawing.
    pub fn blend(&self) -> f32 {
        with_float_env(|| (self.owed / f64::from(self.world.settings.tick)) as f32)
    }

    /// Time since it was made or reset [s].
    pub fn time(&self) -> f64 {
        self.world.time
    }

    /// Puts a particle somewhere [m], at once; it keeps its velocity. A pin goes with it.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not,
    /// [`Error::BadValue`](crate::Error::BadValue) for a position that is not finite.
    pub fn set_position(&mut self, particle: u32, position: Vec3) -> Result<()> {
        check_index(particle, self.world.particles.len(), "particle")?;
        check_finite(position, "position")?;
        let (at, world) = (particle as usize, &mut self.world);
        with_float_env(|| {
            let v = world.particles.v.at(at);
            world.set_particle_state(at, position, v);
            world.particles.x_prev_tick.set(at, position);
            world.bring_pin(particle, position);
            world.is_tangled = true;
        });
        self.changed_state();
        Ok(())
    }

    /// Gives a particle a velocity [m/s].
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not,
    /// [`Error::BadValue`](crate::Error::BadValue) for a velocity that is not finite.
    pub fn set_velocity(&mut self, particle: u32, velocity: Vec3) -> Result<()> {
        check_index(particle, self.world.particles.len(), "particle")?;
        check_finite(velocity, "velocity")?;
        let (at, world) = (particle as usize, &mut self.world);
        with_float_env(|| {
            let x = world.particles.x.at(at);
            world.set_particle_state(at, x, velocity);
        });
        self.changed_state();
        Ok(())
    }

    /// Takes hold of a particle where it is. It follows [`Cloth::move_grab`] exactly, but for a limit
    /// of `max_displacement` a substep, and carries the cloth along.
    ///
    /// # Errors
    /// [`Error::BadIndex`](crate::Error::BadIndex) for a particle that is not,
    /// [`Error::Full`](crate::Error::Full) if 64 grabs are held already.
    pub fn grab_particle(&mut self, particle: u32) -> Result<Grab> {
        check_index(particle, self.world.particles.len(), "particle")?;
        let target = self.world.particles.x.at(particle as usize);
        let handle =
            self.world.grabs.insert(GrabbedParticle { particle, target }, "another grab")?;
        with_float_env(|| self.world.refresh_inverse_mass(particle));
        Ok(Grab(handle))
    }

    /// Gives a grab a new target [m].
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if the grab was released,
    /// [`Error::BadValue`](crate::Error::BadValue) for a target that is not finite.
    pub fn move_grab(&mut self, grab: Grab, target: Vec3) -> Result<()> {
        check_finite(target, "target")?;
        self.world.grabs.get_mut(grab.0, "grab")?.target = target;
        Ok(())
    }

    /// Lets a grabbed particle go, with the velocity it has. One that is pinned stays pinned, and
    /// returns to its pin over the next tick.
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if the grab was released before.
    pub fn release(&mut self, grab: Grab) -> Result<()> {
        let held = self.world.grabs.remove(grab.0, "grab")?;
        let (at, world) = (held.particle, &mut self.world);
        if let Some(pin) = world.pins.get_mut(at) {
            pin.from = world.particles.x.at(at as usize);
        }
        with_float_env(|| world.refresh_inverse_mass(at));
        Ok(())
    }

    /// The oldest event that was not read yet. The 1024 newest are kept.
    ///
    /// They come by tick; in a tick recoveries first, then tears, the worst first, and of each the
    /// vertices that it split before the torn edge; then, if there was no room for another, that; then the
    /// pieces that came off, in the order of their first triangles; then what is held apart. A cut tells
    /// the edges that it divided, in its order; those that it opened; the vertices that it split; and the
    /// pieces.
    pub fn next_event(&mut self) -> Option<Event> {
        self.world.events.pop()
    }

    /// Times the stages of every tick by a clock that counts seconds, or stops timing.
    pub fn set_clock(&mut self, clock: Option<Clock>) {
        self.world.profile.set_clock(clock);
    }

    fn changed_topology(&mut self) {
        self.world.wake();
        self.topology_revision = self.topology_revision.wrapping_add(1);
        let change = self.outputs.follow_topology(&self.world);
        self.history.push(change);
    }

    fn changed_state(&mut self) {
        self.state_revision = self.state_revision.wrapping_add(1);
        self.outputs.follow(&self.world);
    }
}
