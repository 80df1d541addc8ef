//! Memory of a cloth: allocates every list as large as ticks may make it.
//!
//! ```text
//! cannot tear        lists for the particles, triangles and pieces that exist
//! can tear           lists for all particles that tears and cuts may add (`extra_particles`)
//!   with `settings.tearing`, and from the first `tear_edge` or `cut` on
//! ```
//! Reads the sizes of `World`; changes capacities and scratch buffers only.
//! Invariant: after each call that changes a cloth no tick allocates, so a tick never makes a list
//! longer than it is allocated here.

use crate::cloth::Cloth;
use crate::math::reserve::ReserveTotal;
use crate::math::simd::Level;
use crate::model::tethers::Tethers;
use crate::solver::bend::bend_scratch::BendScratch;
use crate::solver::scratch_pool;
use crate::solver::stretch::line_scratch::LineLengths;
use crate::solver::tick_scratch::TickScratch;
use crate::solver::topology::tear_scratch::TearScratch;
use crate::solver::world::World;
use crate::state::colliders::ColliderBody;

impl Cloth {
    /// Allocates the memory for tears and cuts, unless the cloth has it.
    #[inline(never)]
    pub(super) fn reserve_for_tears(&mut self) {
        if !self.world.has_tear_reserve {
            self.world.add_tear_reserve();
            self.outputs.reserve(&self.world);
            self.history.reserve();
        }
    }
}

impl World {
    /// Allocates what a world that was just built does not have yet.
    pub(crate) fn reserve_fresh(&mut self) {
        if self.has_tear_reserve {
            self.reserve_lists();
        } else {
            self.reserve_tethers();
        }
        self.reserve_scratch();
    }

    /// Allocates the memory for tears and cuts, which the cloth does not have. The state stays.
    #[inline(never)]
    pub(crate) fn add_tear_reserve(&mut self) {
        self.has_tear_reserve = true;
        self.constraints.index_links_by_site(&self.mesh);
        self.reserve_lists();
        self.reserve_scratch();
        self.reserve_effective_mass();
        self.reserve_anchor_scratch();
        self.reserve_contacts();
    }

    /// Allocates every list again, after the world was cloned or read from a save: such lists have
    /// no spare capacity.
    pub(crate) fn reserve(&mut self) {
        self.scratch = TickScratch::empty();
        self.reserve_lists();
        self.label_pieces();
        self.reserve_scratch();
        self.reserve_effective_mass();
        self.reserve_anchor_scratch();
        self.reserve_contacts();
        self.rebuild_particle_collision();
        self.rebuild_surface_collision();
    }

    /// Allocates what tears may still need, after a cut added triangles.
    pub(crate) fn reserve_after_cut(&mut self) {
        self.reserve_constraints();
        self.scratch.piece_stack.reserve_total(self.mesh.triangles.len());
        self.reserve_pieces();
    }

    /// Makes all rest data unique that tears in a tick change.
    fn make_unique(&mut self) {
        self.mesh.make_unique();
        self.corner_area.make_unique();
        self.constraints.make_unique();
        if let Some(plates) = &mut self.plate_elements {
            plates.make_unique();
        }
    }

    /// Allocates the lists outside of the scratch buffers.
    #[inline(never)]
    fn reserve_lists(&mut self) {
        let particles = self.allocated_particles();
        if self.has_tear_reserve {
            self.make_unique();
        }
        let reserve = |list: &mut Vec<u32>| list.reserve_total(particles);
        if self.has_tear_reserve {
            reserve(&mut self.mesh.source);
            reserve(&mut self.mesh.corner_of);
        }
        self.particles.reserve(particles);
        self.mass_scales.reserve(particles);
        self.maps.reserve(particles);
        self.crack_tips.reserve_total(particles);
        if self.has_tear_reserve {
            self.reserve_pins_and_events();
            if let Some(seams) = &mut self.seams {
                seams.reserve();
            }
            if let Some(cells) = &mut self.grid_cells {
                cells.reserve();
            }
            if let Some(plates) = &mut self.plate_elements {
                plates.reserve(particles);
            }
        }
        self.reserve_constraints();
    }

    /// Allocates for the pins and events of tears, if the cloth can tear: a tear through a pinned
    /// vertex adds a pin.
    #[inline(never)]
    pub(crate) fn reserve_pins_and_events(&mut self) {
        if self.has_tear_reserve {
            self.pins.reserve(self.capacity());
            self.events.reserve();
        }
    }

    /// Allocates links and tethers for all edges that tears may open.
    #[inline(never)]
    fn reserve_constraints(&mut self) {
        let (particles, triangles) = (self.allocated_particles(), self.mesh.triangles.len());
        if self.has_tear_reserve {
            let opened_edges = self.mesh.max_opened_edges(particles);
            self.constraints.reserve(opened_edges, particles);
            self.tethers.reserve_for_tears(particles, triangles);
        }
        self.reserve_tethers();
        let hinges = self.constraints.dynamic.capacity();
        self.scratch.bend.hinge_lambda.reserve_total(hinges);
    }

    /// Allocates the scratch buffers of the solver stages.
    #[inline(never)]
    fn reserve_scratch(&mut self) {
        let (particles, triangles) = (self.allocated_particles(), self.mesh.triangles.len());
        let links = self.constraints.links.len();
        let has_grid_rows = self.constraints.rows.is_some();
        let scratch = &mut self.scratch;
        scratch.end_weights.reserve(particles, links);
        let chains = &self.constraints.chains.blocks;
        // A whole grid has strided chains only, which are solved in columns where there is SIMD.
        let stays_strided =
            has_grid_rows && chains.are_all_strided() && self.level != Level::Scalar;
        let gathers = self.has_tear_reserve || !stays_strided;
        scratch.line_lengths =
            LineLengths::new(chains.max_steps(), particles, [gathers, has_grid_rows]);
        let hinges = self.constraints.hinges.all.len();
        scratch.bend =
            BendScratch::new(self.plate_elements.as_deref(), triangles, hinges, particles);
        scratch.bend.hinge_lambda.reserve_total(self.constraints.dynamic.capacity());
        if self.has_tear_reserve {
            scratch.tear =
                TearScratch::with_capacity(self.settings.max_tears(self.triangle_capacity));
            scratch.opened_edges.reserve_exact(2);
            scratch.piece_stack.reserve_total(triangles);
        }
        self.reserve_pieces();
        self.reserve_for_parameters();
    }

    /// Allocates what only some settings and materials need: the strain limit, damping of stretch,
    /// and folds.
    #[inline(never)]
    pub(crate) fn reserve_for_parameters(&mut self) {
        let (particles, links) = (self.allocated_particles(), self.constraints.links.len());
        if self.settings.max_stretch > 0.0 {
            self.pin_order.reserve(particles, links);
        }
        if self.material.stretch_damping > 0.0 {
            let opened_edges = self.mesh.max_opened_edges(particles);
            self.constraints.make_lengths_unique();
            self.scratch.damping.reserve(links, self.constraints.dynamic.len() + opened_edges);
        }
        if self.material.yield_angle > 0.0 || self.folds.is_allocated() {
            self.reserve_folds();
        }
        self.folds.reserve_hardening(&self.material);
        scratch_pool::reserve(self);
    }

    /// Allocates rest angles of all bending elements, and what bending needs with them.
    #[inline(never)]
    pub(crate) fn reserve_folds(&mut self) {
        self.folds.reserve();
        if let Some(plates) = &self.plate_elements {
            self.scratch.bend.reserve_folds(plates.count());
        }
    }

    /// Allocates tethers to the pins that there are, and to those that tears may add.
    #[inline(never)]
    pub(crate) fn reserve_tethers(&mut self) {
        let pins = self.pins.hard_particles().count();
        let sets = if self.has_tear_reserve { None } else { Some(pins) };
        self.tethers.reserve(sets, self.allocated_particles());
        if sets.is_none_or(Tethers::has_common_set) {
            self.scratch.tether_pins.reserve(self.allocated_particles());
        }
    }

    /// Returns the memory of the colliders [bytes], without the shapes.
    pub(crate) fn collider_bytes(&self) -> usize {
        self.colliders.iter().count() * size_of::<ColliderBody>()
    }

    /// Allocates the lists of pieces. If the cloth can tear, each triangle may become one.
    #[inline(never)]
    fn reserve_pieces(&mut self) {
        let (particles, triangles) = (self.allocated_particles(), self.mesh.triangles.len());
        let pieces = if self.has_tear_reserve { triangles } else { self.pieces as usize };
        let scratch = &mut self.scratch;
        scratch.pieces.reserve(particles, pieces);
        scratch.piece_groups.reserve(particles, pieces);
        if self.has_tear_reserve {
            scratch.pieces.reserve_for_tears();
        } else {
            scratch.piece_stack = Vec::new();
        }
    }
}
