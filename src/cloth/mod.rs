//! The public [`Cloth`]: validates arguments, edits the state, runs the pipeline, owns the output
//! lists.
//!
//! ```text
//! descriptor ──build──▶ World ──pipeline::tick──▶ World ──outputs──▶ lists that a renderer reads
//!                         ▲
//!     pins, grabs, colliders, settings, cuts: one file each in this folder
//! ```
//!
//! Reads the descriptors and the caller's arguments; writes `World` between ticks, and `Outputs`
//! after every change of positions or triangles. Invariant: every public call checks all of its
//! arguments before it changes anything, and runs its floating-point work inside `with_float_env`,
//! so that a host's rounding mode cannot change the result.

mod anchors;
mod attachments;
mod batch;
mod build;
mod change_history;
pub(crate) mod changes;
mod colliders;
mod crease;
#[cfg(feature = "cut")]
mod cut;
#[cfg(feature = "facet-colliders")]
mod deform_collider;
pub(crate) mod desc;
mod grabs;
mod interpolated_surface;
#[cfg(feature = "facet-colliders")]
mod layers;
mod maps;
pub(crate) mod mass_properties;
mod mass_scales;
mod outputs;
mod parameters;
mod particle_state;
mod pins;
#[cfg(feature = "save")]
mod postcard;
pub(crate) mod query;
mod ray_tree;
mod reserve;
#[cfg(feature = "save")]
mod save;
mod sew;
#[cfg(feature = "skins")]
pub(crate) mod skin;
mod state_hash;
mod tear;
mod teleport;
#[cfg(feature = "parallel")]
mod threads;
mod tracked_world;
pub(crate) mod vertex_stream;
pub(crate) mod view;
pub(crate) mod write_vertices;

#[cfg(test)]
mod kernel_equivalence_tests;

use crate::cloth::build::ClothDesc;
use crate::cloth::change_history::ChangeHistory;
use crate::cloth::desc::{GridDesc, MeshDesc};
use crate::cloth::outputs::Outputs;
use crate::cloth::ray_tree::RayTree;
use crate::cloth::tracked_world::TrackedWorld;
use crate::error::{Result, check};
use crate::math::float_env::with_float_env;
use crate::math::shared::Shared;
use crate::mesh::report::MeshReport;
use crate::solver::pipeline;
use crate::solver::profile::Clock;
use crate::solver::scratch_pool;
use crate::solver::world::World;
use crate::state::colliders::Impulse;
use crate::state::events::Event;

/// A simulated piece of cloth: particles joined by constraints, with the triangle mesh that is
/// drawn.
///
/// A cloth is made from a regular grid ([`Cloth::grid`]) or from any triangle mesh
/// ([`Cloth::mesh`]). There is no world to set up and there are no callbacks: pins, grabs,
/// colliders, wind and settings belong to the cloth.
///
/// - **Time** moves in fixed ticks of [`Settings::tick`] seconds. [`Cloth::advance`] runs the ticks
///   that are due for a frame; [`Cloth::step`] runs an exact number.
/// - **Determinism**: the same sequence of calls gives the same bits on every platform and for any
///   number of threads. [`Cloth::state_hash`] shows it.
/// - **Errors**: a call that returns an error changes nothing.
/// - **Units**: metres, kilograms, seconds, radians; right-handed axes. Gravity is a setting; y is
///   up by default.
/// - **Memory** for tears (`extra_particles`) is reserved with [`Settings::tearing`], so a tick
///   allocates nothing.
/// - **Threads**: a cloth is `Send` and `Sync`. Calls that change nothing may run on several threads
///   at once.
///
/// ```
/// use muslin::glam::Vec3;
/// use muslin::{Cloth, ColliderDesc, GridDesc, Shape};
///
/// // A sheet of 40 x 40 particles, pinned along its top edge, in front of a ball.
/// let mut cloth = Cloth::grid(&GridDesc::default())?;
/// let ball = ColliderDesc {
///     shape: Shape::Sphere,
///     position: Vec3::new(1.0, -1.2, 0.3),
///     radius: 0.4,
///     ..ColliderDesc::default()
/// };
/// cloth.add_collider(&ball)?;
///
/// for _frame in 0..60 {
///     cloth.advance(1.0 / 60.0)?;
///     let view = cloth.view();
///     // Upload `view.positions` and `view.normals`; upload `view.indices` again only when
///     // `view.topology_revision` changes.
///     assert_eq!(view.positions.len(), view.normals.len());
/// }
/// # Ok::<(), muslin::Error>(())
/// ```
///
/// [`Settings::tearing`]: crate::Settings::tearing
/// [`Settings::tick`]: crate::Settings::tick
#[derive(Debug)]
pub struct Cloth {
    /// The descriptor that the cloth was made from; [`Cloth::reset`] builds the rest state from it
    /// again.
    desc: Shared<ClothDesc>,
    world: TrackedWorld,
    outputs: Outputs,
    report: MeshReport,
    /// Whether pins changed after the tethers were last measured.
    pins_changed: bool,
    topology_revision: u32,
    state_revision: u32,
    history: ChangeHistory,
    /// Built by the first ray; a cloned cloth builds its own.
    ray_tree: RayTree,
}

impl Clone for Cloth {
    /// Returns an independent cloth in the same state. Handles of grabs, attachments and colliders
    /// are valid for both.
    fn clone(&self) -> Self {
        let mut world = self.world.clone();
        // A cloned `Vec` has no spare capacity: reserve again what tears may need.
        world.reserve();
        Self {
            desc: self.desc.clone(),
            outputs: self.outputs.of_clone(&world),
            world,
            report: self.report,
            pins_changed: self.pins_changed,
            topology_revision: self.topology_revision,
            state_revision: self.state_revision,
            history: self.history.clone(),
            ray_tree: RayTree::default(),
        }
    }
}

impl Cloth {
    /// Makes a cloth from a regular grid of particles.
    ///
    /// ```
    /// use muslin::{Cloth, GridDesc, Material, PinMode, Preset};
    ///
    /// let cloth = Cloth::grid(&GridDesc {
    ///     columns: 30,
    ///     rows: 20,
    ///     spacing: 0.05,
    ///     pin_mode: PinMode::TopCorners,
    ///     material: Material::preset(Preset::Denim),
    ///     ..GridDesc::default()
    /// })?;
    /// assert_eq!(cloth.particle_count(), 600);
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the invalid field of `desc` and its rule.
    pub fn grid(desc: &GridDesc) -> Result<Self> {
        desc.check()?;
        Self::from_desc(ClothDesc::Grid(desc.clone()))
    }

    /// Makes a cloth from any triangle mesh.
    ///
    /// Defects of the mesh are repaired, see [`MeshDesc`]; [`Cloth::mesh_report`] returns what was
    /// repaired.
    ///
    /// ```
    /// use muslin::glam::Vec3;
    /// use muslin::{Cloth, MeshDesc};
    ///
    /// let cloth = Cloth::mesh(&MeshDesc {
    ///     positions: vec![Vec3::ZERO, Vec3::X, Vec3::NEG_Y, Vec3::new(1.0, -1.0, 0.0)],
    ///     indices: vec![0, 2, 1, 1, 2, 3],
    ///     pinned: vec![0, 1],
    ///     ..MeshDesc::default()
    /// })?;
    /// assert!(cloth.mesh_report().is_clean());
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// - [`Error::BadValue`](crate::Error::BadValue) or [`Error::BadIndex`](crate::Error::BadIndex)
    ///   names the invalid field of `desc` and its rule.
    /// - [`Error::BadMesh`](crate::Error::BadMesh) if the mesh cannot be repaired: a triangle has
    ///   an area that is not finite, or no triangle has an area.
    pub fn mesh(desc: &MeshDesc) -> Result<Self> {
        desc.check()?;
        Self::from_desc(ClothDesc::Mesh(desc.clone()))
    }

    fn from_desc(desc: ClothDesc) -> Result<Self> {
        let (mut world, report) = with_float_env(|| desc.build_world())?;
        world.check_self_distance(&world.settings)?;
        with_float_env(|| {
            world.rebuild_particle_collision();
            world.rebuild_surface_collision();
        });
        let outputs = Outputs::new(&world, &desc);
        let history = ChangeHistory::new(world.has_tear_reserve);
        Ok(Self {
            desc: Shared::new(desc),
            world: TrackedWorld::new(world),
            outputs,
            report,
            pins_changed: false,
            topology_revision: 1,
            state_revision: 1,
            history,
            ray_tree: RayTree::default(),
        })
    }

    /// Restores the initial state: rest shape, no tears or cuts, zero velocities, the pins of the
    /// descriptor, time zero, all mass scales 1. Removes all grabs, attachments, anchors, creases
    /// and events.
    ///
    /// Sewn pairs stay, open again, and are drawn together from the rest shape; so do torn ones.
    /// Settings, material, painted maps, wind and colliders stay as they are now; the impulses of
    /// colliders are zero again. Handles of grabs and attachments become stale; handles of colliders
    /// stay valid.
    pub fn reset(&mut self) {
        // Building succeeded for this descriptor before, so it succeeds again.
        let Ok((mut fresh, _)) = with_float_env(|| self.desc.build_world()) else {
            return;
        };
        self.world.set_origin(fresh.origin);
        core::mem::swap(&mut fresh.colliders, &mut self.world.colliders);
        fresh.colliders.iter_mut().for_each(|body| {
            (body.impulse, body.pending) = (Impulse::default(), Impulse::default());
        });
        fresh.settings = self.world.settings.clone();
        fresh.substeps = fresh.settings.substeps;
        fresh.material = self.world.material.clone();
        core::mem::swap(&mut fresh.maps, &mut self.world.maps);
        fresh.maps.truncate(fresh.particles.len());
        fresh.wind = self.world.wind.clone();
        fresh.profile.set_clock(self.world.profile.clock());
        fresh.threads = self.world.threads;
        // Keep the arenas and clear them, so that old handles stay stale.
        core::mem::swap(&mut fresh.grabs, &mut self.world.grabs);
        fresh.grabs.clear();
        core::mem::swap(&mut fresh.attachments, &mut self.world.attachments);
        fresh.attachments.clear();
        core::mem::swap(&mut fresh.sewing, &mut self.world.sewing);
        if self.world.has_tear_reserve && !fresh.has_tear_reserve {
            fresh.add_tear_reserve();
        }
        fresh.scratch.tear.reserve(fresh.settings.max_tears(fresh.triangle_capacity));
        fresh.reserve_for_parameters();
        let world = &mut *self.world;
        *world = fresh;
        world.reserve_contacts();
        with_float_env(|| {
            world.restart_sewing();
            world.compute_masses();
            world.constraints.update_compliances(&world.material, &world.maps);
            world.rebuild_tethers();
            world.reset_history();
            world.rebuild_particle_collision();
            world.rebuild_surface_collision();
        });
        self.pins_changed = false;
        self.update_topology();
        self.update_state();
    }

    /// Runs the ticks that are due after `seconds` [s] of frame time, and returns how many ran.
    ///
    /// The remainder, less than one tick, is kept for the next call; [`Cloth::blend`] returns it as
    /// a share of a tick. At most `max_ticks_per_advance` ticks run; the rest of the backlog is
    /// dropped, so a slow machine shows slow motion instead of falling further behind. Zero seconds
    /// change nothing.
    ///
    /// Poses that were given since the last tick (targets of pins and grabs, attachments, anchors,
    /// colliders, the frame of [`Cloth::move_frame`]) are reached evenly over the ticks of this
    /// call, and exactly at the end of the last one. If no tick runs, they wait for the next call.
    ///
    /// ```
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc::default())?; // ticks of 1/60 s
    /// assert_eq!(cloth.advance(0.04)?, 2);
    /// assert!(cloth.blend() > 0.39 && cloth.blend() < 0.41);
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `seconds` is negative or not finite. The
    /// cloth is unchanged.
    pub fn advance(&mut self, seconds: f32) -> Result<u32> {
        Self::check_seconds(seconds)?;
        Ok(self.run_due_ticks(seconds))
    }

    /// Checks an amount of frame time [s].
    fn check_seconds(seconds: f32) -> Result<()> {
        check(seconds.is_finite() && seconds >= 0.0, "seconds", "be at least 0 and finite")
    }

    /// Runs the ticks that are due after `seconds` [s], which were checked, and returns how many.
    fn run_due_ticks(&mut self, seconds: f32) -> u32 {
        if self.world.clock.is_idle {
            return with_float_env(|| self.world.advance_idle(seconds));
        }
        let world = &mut *self.world;
        let (tick, max_ticks) = (world.settings.tick, world.settings.max_ticks_per_advance);
        let ticks = with_float_env(|| world.clock.take_due_ticks(seconds, tick, max_ticks));
        self.run(ticks, pipeline::ticks_of_frame);
        ticks
    }

    /// Runs exactly `ticks` ticks. The time that [`Cloth::advance`] keeps for the next frame does
    /// not change. Poses that were given before the call are reached in the first of these ticks.
    pub fn step(&mut self, ticks: u32) {
        if self.world.clock.is_idle {
            return with_float_env(|| self.world.step_idle(ticks));
        }
        self.run(ticks, pipeline::ticks);
    }

    /// Runs `ticks` ticks by `run_ticks`, which returns whether the cloth was awake.
    fn run(&mut self, ticks: u32, run_ticks: fn(&mut World, u32) -> bool) {
        self.world.profile.reset();
        if ticks == 0 {
            return;
        }
        let vertices = self.world.mesh.vertex_count();
        let (pins_changed, world) = (core::mem::take(&mut self.pins_changed), &mut *self.world);
        let has_moved = world.threads.run_in_pool(world.particles.len(), || {
            with_float_env(|| {
                if pins_changed {
                    world.rebuild_tethers();
                }
                scratch_pool::with_lent(world, |world| run_ticks(world, ticks))
            })
        });
        if self.world.mesh.vertex_count() != vertices {
            self.update_topology();
        }
        if has_moved {
            self.update_state();
        } else {
            self.world.begin_idle();
        }
    }

    /// Returns the part of a tick that [`Cloth::advance`] has not simulated yet, from 0 to 1.
    ///
    /// Draw positions blended by this factor from the last tick's to the current ones, so that
    /// motion is smooth at any frame rate; [`Cloth::write_vertices`] does so with
    /// [`WriteDesc::blend`](crate::WriteDesc).
    pub fn blend(&self) -> f32 {
        with_float_env(|| (self.world.clock.backlog / f64::from(self.world.settings.tick)) as f32)
    }

    /// Returns the simulated time since the cloth was made or reset [s].
    pub fn time(&self) -> f64 {
        self.world.clock.time
    }

    /// Returns the number of ticks since the cloth was made or reset.
    pub fn ticks(&self) -> u32 {
        self.world.clock.tick
    }

    /// Returns whether the cloth sleeps, see [`Settings::sleep_speed`](crate::Settings): ticks then
    /// move nothing until something wakes it.
    pub fn is_asleep(&self) -> bool {
        self.world.is_asleep()
    }

    /// Removes and returns the oldest unread event; `None` if there is none. The newest 1024 are
    /// kept.
    ///
    /// Events are ordered by tick, and within a tick:
    ///
    /// - recoveries ([`EventKind::Recovered`](crate::EventKind));
    /// - tears, the most stretched edge first: for each, its split vertices, then the torn edge;
    /// - the exhausted reserve, if it cannot hold another tear;
    /// - detached pieces, ordered by their first triangle;
    /// - torn stitches, in the order in which they were sewn;
    /// - links that pins or grabs hold past `max_stretch`;
    /// - particles inside colliders, held ones first;
    /// - layers that cross.
    ///
    /// A cut adds the edges that it divided, in its order, then the edges that it opened, the
    /// vertices that it split, and the detached pieces.
    ///
    /// ```
    /// use muslin::{Cloth, EventKind, GridDesc};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc::default())?;
    /// cloth.tear_edge(820, 821)?;
    /// while let Some(event) = cloth.next_event() {
    ///     if event.kind == EventKind::EdgeTorn {
    ///         println!("tick {}: {} - {}", event.tick, event.particle_a, event.particle_b);
    ///     }
    /// }
    /// # Ok::<(), muslin::Error>(())
    /// ```
    pub fn next_event(&mut self) -> Option<Event> {
        self.world.events.pop()
    }

    /// Measures the time of each stage of every tick with `clock`, a function that returns seconds;
    /// `None` stops measuring. [`Stats::seconds`](crate::Stats) returns the times.
    pub fn set_clock(&mut self, clock: Option<Clock>) {
        self.world.profile.set_clock(clock);
    }

    /// Updates all that depends on the triangles, and records which output ranges changed.
    fn update_topology(&mut self) {
        self.world.wake();
        self.topology_revision = self.topology_revision.wrapping_add(1);
        let change = self.outputs.update_topology(&self.world);
        self.history.push(change);
    }

    /// Updates the output positions after a change of positions.
    fn update_state(&mut self) {
        self.state_revision = self.state_revision.wrapping_add(1);
        self.outputs.update_positions(&self.world);
    }
}
