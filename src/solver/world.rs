//! The data of one cloth: rest mesh, constraints, state and scratch buffers.
//!
//! `World` is the one argument of every stage in `pipeline`. It groups into
//!
//! ```text
//! rest data   mesh, seams, constraints, tethers, rest, corner_area, plate_elements, ...
//! state       particles, pins, grabs, anchors, colliders, settings, wind, folds, time, ...
//! caches      scratch, particle_collision, surface_collision, pin_order, profile, ...
//! ```
//! Method: plain data, plus the updates that keep the derived data consistent with the mesh, the
//! pins and the masses. No stage lives here.
//!
//! Reads nothing from outside; the stages, `cloth` and the restore code write it. Invariant: each
//! list with one entry per particle has `particles.len()` entries, and no list reallocates during a
//! tick, because `reserve` sets its capacity beforehand. The files that this file imports do not
//! import it.

use crate::geometry::triangle::corner_areas;
use crate::math::heap_bytes::heap_bytes;
use crate::math::shared::Shared;
use crate::math::simd::Level;
use crate::math::threads::Threads;
use crate::mesh::grid::GridFrame;
use crate::mesh::seams::Seams;
use crate::mesh::split_edge::CutSite;
use crate::mesh::{Corner, Mesh, triangle_of};
use crate::model::constraints::Constraints;
use crate::model::folds::Folds;
use crate::model::grid_cells::GridCells;
use crate::model::maps::Maps;
use crate::model::material::Material;
use crate::model::pin_order::PinOrder;
use crate::model::plate_elements::PlateElements;
use crate::model::tethers::Tethers;
use crate::solver::integrate::sleep_timer::SleepTimer;
use crate::solver::profile::Profile;
use crate::solver::self_collide::contact_forces::WarmStart;
use crate::solver::tick_scratch::TickScratch;
use crate::state::anchors::AnchorConstraints;
use crate::state::attachments::Attachments;
use crate::state::colliders::Colliders;
use crate::state::events::Events;
use crate::state::frame_clock::FrameClock;
use crate::state::grabs::Grabs;
use crate::state::mass_scales::MassScales;
use crate::state::particles::Particles;
use crate::state::pins::Pins;
use crate::state::pose::Pose;
use crate::state::settings::Settings;
use crate::state::sewing::Sewing;
use crate::state::violations::Violations;
use crate::state::wind::Wind;
use glam::Vec3;

/// Smallest number of particles that a thread gets in a loop with little work per particle.
pub(crate) const MIN_PARTICLES_PER_THREAD: usize = 16_384;

/// The complete data of one cloth.
///
/// `cloth::build` makes all fields and `cloth::save` restores them. The doc of a field names its
/// other writers.
#[derive(Clone, Debug)]
pub(crate) struct World {
    /// Triangles over particles and their adjacency. Written by tears and cuts.
    pub mesh: Shared<Mesh>,
    /// Maps render vertices to particles; `None` if each particle is one vertex. Written by tears
    /// and cuts.
    pub seams: Option<Seams>,
    /// Distance constraints (stretch, shear and bend links), their batches by colour, and their
    /// chains. Tears and cuts open links, stage `Stretch` updates the multipliers, and a new
    /// material changes the compliances.
    pub constraints: Constraints,
    /// Long-range attachments: the geodesic distance [m] of each particle from its pin. Written
    /// when hard pins change, and by tears and cuts.
    pub tethers: Tethers,
    /// Links sorted by distance from the pins; valid only while `max_stretch > 0`. Rebuilt with the
    /// tethers.
    pub pin_order: PinOrder,
    /// Factor by which tethers may exceed their rest length, at least 1; see
    /// `tether_slack::update`, which writes it once per tick. Infinite before the first tick, after
    /// pins or positions changed, and while tethers are off.
    pub tether_slack: f32,
    /// Largest ratio of the distance between two pins to their distance along the rest cloth; at
    /// least 1. Above 1 the pins stretch the cloth by themselves. Written by `tether_slack`.
    pub pin_stretch: f32,
    /// Whether `pin_stretch` is up to date: no pin moves and no grab is held. Set by
    /// `tether_slack`; cleared when pins or positions change.
    pub is_pin_stretch_current: bool,
    /// Rest position of each site, relative to `rest_origin` [m]. Cuts append sites.
    pub rest: Shared<Vec<Vec3>>,
    /// The origin that the cloth was made with, see `solver::rebase` [m].
    pub rest_origin: Vec3,
    /// Edge points where cuts made sites; these sites follow those of the original vertices.
    /// Written by cuts.
    pub cut_sites: Vec<CutSite>,
    /// Share of its triangle's rest area that belongs to each corner [m²]. Written by cuts.
    pub corner_area: Shared<Vec<[f32; 3]>>,
    /// Origin, axes and spacing [m] of the rest grid; `None` for other meshes.
    pub grid_frame: Option<GridFrame>,
    /// Two triangles per grid cell, for sums over triangles in SIMD lanes; `None` for other meshes.
    /// Written by tears and cuts.
    pub grid_cells: Option<GridCells>,
    /// Bending elements of a grid; `None` for other meshes, which bend at hinges. Written by tears
    /// and cuts.
    pub plate_elements: Option<Shared<PlateElements>>,
    /// Plastic rest angles [rad] of the bending elements, and their hardening. Written by
    /// `bend::update_folds` at the end of the tick, and by creases that the host sets.
    pub folds: Folds,
    /// Whether each vertex is a crack tip: the end of a tear or of a cut. Written by tears and
    /// cuts.
    pub crack_tips: Vec<bool>,
    /// Mean rest length of the edges [m].
    pub mean_edge: f32,
    /// Absolute position of the point that all positions are relative to [m], see `solver::rebase`.
    pub origin: Vec3,
    /// Position [m], velocity [m/s], history, mass [kg] and inverse mass [1/kg] of each particle.
    /// Written by most stages.
    pub particles: Particles,
    /// Factor of the mass of each particle that the host set. Tears and cuts append entries.
    pub mass_scales: MassScales,
    /// Pinned particles and their targets [m]. Written by the host, by `tick_targets`, at the end of
    /// the tick by `pipeline`, and by tears and cuts, which copy the pin of a split vertex.
    pub pins: Pins,
    /// Moving bodies that carry pins: last and next pose [m]. Written by the host, by
    /// `kinematic::targets` and by `tick_targets`.
    pub attachments: Attachments,
    /// Particles that the host holds at a target [m]. Written by the host and by `tick_targets`.
    pub grabs: Grabs,
    /// Animated targets [m] with a max distance and a backstop. Written by the host, by
    /// `kinematic::targets`, by `tick_targets`, and by tears and cuts.
    pub anchors: AnchorConstraints,
    /// Particles that are sewn together. Written by the host and by `stretch::sewn_pairs`.
    pub sewing: Sewing,
    /// Absolute pose [m] of the body that the cloth follows when that body teleports. Written by
    /// `cloth::teleport`.
    pub reference_pose: Pose,
    /// Collider bodies: shapes, poses [m] and impulses [N s]. Written by the host, by stage
    /// `Colliders` and by `tick_targets`.
    pub colliders: Colliders,
    /// Parameters of the simulation. Written by the host.
    pub settings: Settings,
    /// Parameters of the fabric. Written by the host.
    pub material: Material,
    /// Painted scales of the material. Written by the host; tears and cuts append entries.
    pub maps: Maps,
    /// Parameters of the air. Written by the host.
    pub wind: Wind,
    /// Simulated time, ticks, and frame time to simulate. `pipeline` and `cloth` advance it.
    pub clock: FrameClock,
    /// Number of pieces: connected sets of triangles. Written by tears and cuts.
    pub pieces: u32,
    /// Largest number of particles and of triangles that the cloth may ever have.
    pub particle_capacity: usize,
    pub triangle_capacity: usize,
    /// Whether the lists have memory for all particles that tears and cuts may add. Written by
    /// `cloth::reserve`; always set with `settings.tearing`.
    pub has_tear_reserve: bool,
    /// Whether an event has reported that the vertex reserve for tears is used up. Set by tears.
    pub reserve_reported: bool,
    /// Guarantees that did not hold after the last tick. Written by the stages that check them.
    pub violations: Violations,
    /// Number of substeps of the last tick, or of the current one while it runs; at first that of
    /// the settings. The history has the length of such a substep. Written by `time_step`.
    pub substeps: u32,
    /// Substep length whose effective stiffness the links have [s], see
    /// [`World::correction_share`]; 0 before the first tick, then at least the substep length.
    pub stiffness_step: f32,
    /// Whether the next substep has no history, so that it is one of BDF1.
    pub has_no_history: bool,
    /// Events since the host last read them. Stages append.
    pub events: Events,
    /// Instruction set that the kernels may use.
    pub level: Level,
    /// Threads that a tick may use. Written by the host.
    pub threads: Threads,
    /// Time in each stage [s]. Written by `pipeline`.
    pub profile: Profile,
    /// Scratch buffers of the stages.
    pub scratch: TickScratch,
    /// Number of ticks at rest. Written by `integrate::sleep`; a change by the host sets it to
    /// zero.
    pub sleep: SleepTimer,
    /// Contact forces [N] of the last substep, used to warm-start the next; empty without surface
    /// collision. Written by `surface_stages`.
    pub warm_start: WarmStart,
    /// Whether the surface may intersect itself: each substep then tests all of it. Written by
    /// `surface_stages`; set when the host moves particles or turns surface collision on.
    pub is_tangled: bool,
}

heap_bytes!(
    World {
        mesh, seams, constraints, tethers, pin_order, rest, cut_sites, corner_area, grid_cells,
        plate_elements, folds, crack_tips, particles, mass_scales, pins, attachments, grabs,
        anchors, sewing, colliders, maps, events, scratch, warm_start,
    } plain {
        tether_slack, pin_stretch, is_pin_stretch_current, rest_origin, grid_frame, mean_edge,
        origin, reference_pose, settings, material, wind, clock, pieces, particle_capacity,
        triangle_capacity, has_tear_reserve, reserve_reported, violations, substeps,
        stiffness_step, has_no_history, level, threads, profile, sleep, is_tangled,
    }
);

impl World {
    /// Largest number of particles that the cloth may ever have.
    pub fn capacity(&self) -> usize {
        self.particle_capacity
    }

    /// Largest number of render vertices that the cloth may ever have.
    pub fn vertex_capacity(&self) -> usize {
        self.seams.as_ref().map_or(self.capacity(), Seams::capacity)
    }

    /// Number of particles that the lists have memory for.
    pub fn allocated_particles(&self) -> usize {
        if self.has_tear_reserve { self.capacity() } else { self.particles.len() }
    }

    /// Number of render vertices that the lists have memory for.
    pub fn allocated_vertices(&self) -> usize {
        match &self.seams {
            Some(seams) if !self.has_tear_reserve => seams.particles.len(),
            Some(seams) => seams.capacity(),
            None => self.allocated_particles(),
        }
    }

    /// Number of triangles that the lists have memory for.
    pub fn allocated_triangles(&self) -> usize {
        if self.has_tear_reserve { self.triangle_capacity } else { self.mesh.triangles.len() }
    }

    /// Triangles as indices of render vertices.
    pub fn render_triangles(&self) -> &[[u32; 3]] {
        self.seams.as_ref().map_or(&self.mesh.triangles, |seams| &seams.triangles)
    }

    /// Render vertex at a corner.
    pub fn render_vertex(&self, corner: Corner) -> u32 {
        self.render_triangles()[triangle_of(corner)][corner as usize % 3]
    }

    /// Whether the reserve is too small for the next tear, which makes up to three vertices: the
    /// split vertex and one at the far end of each of the two opened edges.
    pub fn is_reserve_used_up(&self) -> bool {
        self.mesh.vertex_count() + 3 > self.capacity()
    }

    /// Updates links, grid cells and plate elements at `site` after the mesh changed there.
    ///
    /// Call `rebuild_irregular_lists` after the last site.
    pub fn refresh_constraints_at(&mut self, site: u32) {
        self.constraints.update_site(&self.mesh, site);
        if let Some(cells) = &mut self.grid_cells {
            cells.update_site(&self.mesh, site);
        }
        if let Some(plates) = &mut self.plate_elements {
            plates.update_cells(&self.mesh, site);
            let of_site = self.constraints.links_of_site(site);
            of_site.for_each(|(links, link)| plates.update_link(&self.mesh, links, link));
        }
    }

    /// Rebuilds the lists of links, cells and plate elements that left the regular grid layout.
    pub fn rebuild_irregular_lists(&mut self) {
        self.constraints.rebuild_sparse(self.particles.len());
        if let Some(cells) = &mut self.grid_cells {
            cells.rebuild_torn(&self.mesh);
        }
        if let Some(plates) = &mut self.plate_elements {
            plates.rebuild_irregular(&self.mesh, &self.constraints.links);
        }
    }

    /// Updates the inverse mass `w` of a particle [1/kg] and wakes the cloth.
    ///
    /// `w` is 0 while a grab or a hard pin holds the particle or it has no mass. A soft pin of
    /// stiffness k adds k · step² to the mass.
    pub fn refresh_inverse_mass(&mut self, particle: u32) {
        self.wake();
        let at = particle as usize;
        let pin = self.pins.get(particle);
        let held = pin.is_some_and(|pin| !pin.is_soft())
            || self.grabs.iter().any(|held| held.particle == particle);
        let mass = self.particles.mass[at];
        self.particles.w[at] = if held || mass <= 0.0 {
            0.0
        } else if let Some(pin) = pin {
            pin.effective_inverse_mass(mass, self.regular_scheme().velocity_step)
        } else {
            1.0 / mass
        };
    }

    /// Computes all masses [kg] from rest areas, density and mass scales, then all inverse masses.
    pub fn compute_masses(&mut self) {
        self.particles.mass.fill(0.0);
        for (triangle, areas) in self.mesh.triangles.iter().zip(self.corner_area.iter()) {
            for (vertex, area) in triangle.iter().zip(areas) {
                self.particles.mass[*vertex as usize] += area * self.material.density;
            }
        }
        self.mass_scales.apply(&mut self.particles.mass);
        (0..self.particles.len() as u32).for_each(|particle| self.refresh_inverse_mass(particle));
    }

    /// Recomputes the corner areas of the triangles that differ from those of the `uncut` mesh.
    pub fn refresh_corner_areas(&mut self, uncut: &Mesh) {
        let (mesh, rest) = (&self.mesh, &self.rest);
        let sites = |triangle: &[u32; 3]| triangle.map(|v| mesh.source[v as usize]);
        let corner_area = &mut *self.corner_area;
        corner_area.resize(mesh.triangles.len(), [0.0; 3]);
        for (at, (triangle, areas)) in mesh.triangles.iter().zip(corner_area).enumerate() {
            let sites = sites(triangle);
            if uncut.triangles.get(at) != Some(&sites) {
                *areas = corner_areas(sites.map(|site| rest[site as usize]));
            }
        }
    }

    /// Sets the position `x` [m] and the velocity `v` [m/s] of a particle, and wakes the cloth.
    ///
    /// The history of the particle becomes that of free fall, if there is a history.
    pub fn set_particle_state(&mut self, particle: usize, x: Vec3, v: Vec3) {
        self.wake();
        let (h, gravity) = (self.regular_scheme().h, self.gravity_of_history());
        self.particles.set_motion(particle, x, v, gravity, h);
        if self.has_no_history {
            self.particles.drop_history_of(particle);
        }
        self.is_pin_stretch_current = false;
        self.tether_slack = f32::INFINITY;
    }

    /// Resets the history of every particle to free fall, after the length or the order of the
    /// substep changed. Positions and velocities stay.
    pub fn reset_history(&mut self) {
        let (h, gravity) = (self.regular_scheme().h, self.gravity_of_history());
        self.particles.reset_history(gravity, h);
        self.drop_pending_impulses();
        self.has_no_history = false;
    }

    /// The acceleration that a new history contains [m/s²]: gravity for BDF2. BDF1 extrapolates
    /// nothing, so that any acceleration in its history would be a jump of velocity.
    fn gravity_of_history(&self) -> Vec3 {
        let is_extrapolated = self.regular_scheme().extrapolation > 0.0;
        if is_extrapolated { self.settings.gravity } else { Vec3::ZERO }
    }

    /// Largest displacement of a particle per substep relative to the rigid motion of the
    /// cloth [m].
    pub fn max_displacement(&self) -> f32 {
        self.settings.max_displacement * self.mean_edge
    }

    /// Labels the pieces of the mesh, counts them, and sorts the particles by piece.
    pub fn label_pieces(&mut self) {
        let (mesh, TickScratch { pieces, piece_stack, .. }) = (&self.mesh, &mut self.scratch);
        pieces.label.resize(mesh.triangles.len(), 0);
        self.pieces = mesh.label_pieces(&mut pieces.label, piece_stack);
        pieces.outward.clear();
        pieces.members.sort(mesh, &pieces.label, self.pieces as usize, |piece| piece);
    }

    /// Rebuilds all tethers, after pins or pieces changed.
    pub fn rebuild_tethers(&mut self) {
        self.reserve_tethers();
        self.tethers.rebuild(&self.mesh, &self.rest, self.pins.hard_particles());
        self.refresh_after_tether_change();
    }

    /// Updates the tethers that tears changed, searching from the `touched` particles.
    pub fn update_tethers(&mut self, touched: &[u32]) {
        if self.tethers.pin_count() != self.pins.hard_particles().count() {
            return self.rebuild_tethers();
        }
        self.tethers.update_after_tear(&self.mesh, &self.rest, touched);
        self.refresh_after_tether_change();
    }

    fn refresh_after_tether_change(&mut self) {
        self.is_pin_stretch_current = false;
        self.tether_slack = f32::INFINITY;
        self.rebuild_pin_order();
    }

    /// Sorts the links by distance from the pins, after these distances or the links changed.
    /// Does nothing while there is no strain limit.
    pub fn rebuild_pin_order(&mut self) {
        if self.settings.max_stretch > 0.0 {
            self.pin_order.rebuild(&self.tethers, self.particles.len(), &self.constraints.links);
        }
    }
}
