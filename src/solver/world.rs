//! Everything that a tick reads and writes.

use crate::geometry::triangle::corner_areas;
use crate::math::columns::Columns;
use crate::math::simd::Level;
use crate::math::threads::Threads;
use crate::mesh::grid::GridFrame;
use crate::mesh::seams::Seams;
use crate::mesh::split_edge::Crossing;
use crate::mesh::split_vertex::Opening;
use crate::mesh::{Corner, Fan, Mesh, triangle_of};
use crate::model::constraints::Constraints;
use crate::model::crack_tips;
use crate::model::folds::Folds;
use crate::model::grid_cells::GridCells;
use crate::model::material::Material;
use crate::model::pin_order::PinOrder;
use crate::model::plate_elements::PlateElements;
use crate::model::tethers::Tethers;
use crate::solver::integrate::sleep::Sleep;
use crate::solver::profile::Profile;
use crate::state::anchors::AnchorConstraints;
use crate::state::attachments::Attachments;
use crate::state::colliders::Colliders;
use crate::state::events::Events;
use crate::state::grabs::Grabs;
use crate::state::mass_scales::MassScales;
use crate::state::particles::Particles;
use crate::state::pins::Pins;
use crate::state::pose::Pose;
use crate::state::settings::Settings;
use crate::state::wind::Wind;
use glam::Vec3;

/// Particles that one thread does at least, where there is little to do for each.
pub(crate) const PARTICLES: usize = 16_384;

/// Everything that a tick reads and writes.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub mesh: Mesh,
    /// The vertices, if particles are not vertices.
    pub seams: Option<Seams>,
    pub constraints: Constraints,
    pub tethers: Tethers,
    /// The order of the stretch bound; current only while there is one.
    pub pin_order: PinOrder,
    /// See `tethers::measure_slack`; infinite before the first tick and after pins or places changed.
    pub tether_slack: f32,
    /// How far pins hold the cloth apart, see `tethers::held_apart`, and whether that is still so.
    pub pin_stretch: f32,
    pub is_pin_stretch_current: bool,
    /// Rest position of each site [m].
    pub rest: Vec<Vec3>,
    /// The sites that cuts made, after those of the original vertices.
    pub crossings: Vec<Crossing>,
    /// The share of its triangle's rest area that belongs to each corner [m²].
    pub corner_area: Vec<[f32; 3]>,
    /// Where a grid is at rest.
    pub frame: Option<GridFrame>,
    /// Where the triangles of a grid lie in cells.
    pub cells: Option<GridCells>,
    /// What resists bending on a grid.
    pub plates: Option<PlateElements>,
    /// Folds that stay.
    pub folds: Folds,
    /// Whether each vertex is the tip of a slit.
    pub crack_tips: Vec<bool>,
    /// Mean length of the edges at rest [m].
    pub mean_edge: f32,
    pub particles: Particles,
    pub mass_scales: MassScales,
    pub pins: Pins,
    pub attachments: Attachments,
    pub grabs: Grabs,
    pub anchors: AnchorConstraints,
    /// Where the body is that the cloth goes along with when that jumps.
    pub reference_pose: Pose,
    pub colliders: Colliders,
    pub settings: Settings,
    pub material: Material,
    pub wind: Wind,
    /// Time since creation or reset [s].
    pub time: f64,
    /// Ticks since creation or reset.
    pub tick: u32,
    pub pieces: u32,
    /// How many triangles there may be in all.
    pub triangle_capacity: usize,
    /// Whether the host knows that the reserve for tears is used up.
    pub reserve_told: bool,
    /// Links past the stretch bound after the last tick.
    pub over_stretched: u32,
    /// Whether the host knows of them.
    pub over_stretch_reported: bool,
    pub events: Events,
    /// The instructions that kernels may use.
    pub level: Level,
    /// The threads that its ticks may use.
    pub threads: Threads,
    pub profile: Profile,
    pub scratch: TickScratch,
    pub sleep: Sleep,
    /// The particles that keep apart, while settings say so.
    pub particle_collision:
        Option<Box<crate::solver::self_collide::particle_pairs::ParticleCollision>>,
    /// What layers bore on each other with in the last substep, while they keep apart.
    pub warm_start: crate::solver::self_collide::surface::warm_start::WarmStart,
    /// Whether its surface may go through itself, as far as is known.
    pub is_tangled: bool,
    /// The layers that keep apart, while settings say so.
    pub surface_collision: Option<Box<crate::solver::self_collide::surface::SurfaceCollision>>,
}

/// Room to work in, made once so that no tick allocates.
#[derive(Clone, Debug)]
pub(crate) struct TickScratch {
    /// Acceleration [m/s²].
    pub acceleration: Columns,
    /// Velocity of the air against each particle [m/s].
    pub air: Columns,
    /// The way that prediction gave each particle in this substep [m].
    pub displacement: Columns,
    /// Where prediction took it [m].
    pub predicted: Columns,
    /// The velocity that each particle began the tick with, while there is a stretch bound [m/s].
    pub initial_velocity: Columns,
    /// Where the pin is that each particle is tethered to [m], if it is one of many.
    pub tether_anchor: Columns,
    /// What resists a push at each particle while there are soft pins [kg].
    pub inertia: Vec<f32>,
    /// What leashes pulled in this substep.
    pub pulled: Vec<u32>,
    pub end_weights: crate::solver::stretch::inverse_masses::Weights,
    pub interleaved: crate::solver::stretch::mesh_kernel::Packed,
    pub lines: crate::solver::stretch::line_solver::LineScratch,
    pub bend: crate::solver::bend::BendScratch,
    pub damping: crate::solver::stretch::damping::DampingScratch,
    pub contacts: crate::solver::collide::ContactScratch,
    pub tear: crate::solver::topology::tear::TearScratch,
    pub rollback: crate::solver::stretch::rollback::Home,
    pub opened: Vec<Opening>,
    pub pieces: crate::solver::topology::tear::Pieces,
    pub stack: Vec<u32>,
}

impl TickScratch {
    /// Room for `capacity` particles and `triangles` triangles.
    pub fn new(count: usize, capacity: usize, triangles: usize, max_tears: usize) -> Self {
        let zero = |list: &mut Columns| (0..count).for_each(|_| list.push(Vec3::ZERO));
        let mut scratch = Self {
            acceleration: Columns::with_capacity(capacity),
            air: Columns::with_capacity(capacity),
            displacement: Columns::with_capacity(capacity),
            predicted: Columns::with_capacity(capacity),
            initial_velocity: Columns::with_capacity(capacity),
            tether_anchor: Columns::with_capacity(capacity),
            inertia: Vec::new(),
            pulled: Vec::new(),
            end_weights: crate::solver::stretch::inverse_masses::Weights::default(),
            interleaved: crate::solver::stretch::mesh_kernel::Packed::default(),
            lines: crate::solver::stretch::line_solver::LineScratch::default(),
            bend: crate::solver::bend::BendScratch::default(),
            damping: crate::solver::stretch::damping::DampingScratch::default(),
            contacts: crate::solver::collide::ContactScratch::default(),
            tear: crate::solver::topology::tear::TearScratch::with_capacity(max_tears),
            rollback: crate::solver::stretch::rollback::Home::with_capacity(capacity, triangles),
            opened: Vec::with_capacity(2),
            pieces: crate::solver::topology::tear::Pieces::new(triangles),
            stack: Vec::with_capacity(triangles),
        };
        zero(&mut scratch.acceleration);
        zero(&mut scratch.air);
        zero(&mut scratch.displacement);
        zero(&mut scratch.predicted);
        scratch
    }

    /// A particle more.
    pub fn grow(&mut self) {
        self.acceleration.push(Vec3::ZERO);
        self.air.push(Vec3::ZERO);
        self.displacement.push(Vec3::ZERO);
        self.predicted.push(Vec3::ZERO);
    }
}

impl World {
    /// How many particles there may be in all.
    pub fn capacity(&self) -> usize {
        self.mesh.source.capacity().min(self.particles.mass.capacity())
    }

    /// How many vertices there may be in all.
    pub fn vertex_capacity(&self) -> usize {
        self.seams.as_ref().map_or(self.capacity(), Seams::capacity)
    }

    /// The triangles over vertices, as a renderer has them.
    pub fn faces(&self) -> &[[u32; 3]] {
        self.seams.as_ref().map_or(&self.mesh.triangles, |seams| &seams.triangles)
    }

    /// The vertex at a corner.
    pub fn vertex(&self, corner: Corner) -> u32 {
        self.faces()[triangle_of(corner)][corner as usize % 3]
    }

    /// Whether the reserve cannot take the most that one tear may need: the vertex that splits, and
    /// one at the far end of each of two opened edges.
    pub fn is_reserve_used_up(&self) -> bool {
        self.mesh.vertex_count() + 3 > self.capacity()
    }

    /// Brings links and cells around a site in line with the mesh.
    pub fn follow(&mut self, site: u32) {
        self.constraints.follow(&self.mesh, site);
        if let Some(cells) = &mut self.cells {
            cells.follow(&self.mesh, site);
        }
        if let Some(plates) = &mut self.plates {
            plates.follow_cells(&self.mesh, site);
            let of_site = self.constraints.of_vertex(site);
            of_site.for_each(|(links, link)| plates.follow_link(&self.mesh, links, link));
        }
    }

    /// Gathers what sweeps and sums find apart from the rest, after links and cells changed.
    pub fn gather(&mut self) {
        self.constraints.gather(self.particles.len());
        if let Some(cells) = &mut self.cells {
            cells.gather(&self.mesh);
        }
        if let Some(plates) = &mut self.plates {
            plates.gather(&self.mesh, &self.constraints.links);
        }
    }

    /// The inverse mass that the solver is to see: 0 while something holds the particle.
    pub fn refresh_weight(&mut self, particle: u32) {
        self.wake();
        let at = particle as usize;
        let pin = self.pins.find(particle);
        let held = pin.is_some_and(|pin| !pin.is_soft())
            || self.grabs.iter().any(|held| held.particle == particle);
        let mass = self.particles.mass[at];
        self.particles.w[at] = if held || mass <= 0.0 {
            0.0
        } else if let Some(pin) = pin {
            pin.weigh(mass, self.settings.scheme().step)
        } else {
            1.0 / mass
        };
    }

    /// All masses from areas, density and scales, and the inverse masses from them.
    pub fn weigh(&mut self) {
        self.particles.mass.fill(0.0);
        for (triangle, areas) in self.mesh.triangles.iter().zip(&self.corner_area) {
            for (vertex, area) in triangle.iter().zip(areas) {
                self.particles.mass[*vertex as usize] += area * self.material.density;
            }
        }
        self.mass_scales.apply(&mut self.particles.mass);
        (0..self.particles.len() as u32).for_each(|particle| self.refresh_weight(particle));
    }

    /// The areas of triangles that are not those of the `fresh` mesh any more.
    pub fn measure_divided(&mut self, fresh: &Mesh) {
        let (mesh, rest) = (&self.mesh, &self.rest);
        let sites = |triangle: &[u32; 3]| triangle.map(|v| mesh.source[v as usize]);
        self.corner_area.resize(mesh.triangles.len(), [0.0; 3]);
        for (at, (triangle, areas)) in mesh.triangles.iter().zip(&mut self.corner_area).enumerate()
        {
            let sites = sites(triangle);
            if fresh.triangles.get(at) != Some(&sites) {
                *areas = corner_areas(sites.map(|site| rest[site as usize]));
            }
        }
    }

    /// Finds the tips of all slits.
    pub fn find_tips(&mut self) {
        let mut fan = Fan::default();
        let is_tip = |vertex| crack_tips::is_tip(&self.mesh, &self.rest, vertex, &mut fan);
        self.crack_tips.clear();
        self.crack_tips.extend((0..self.mesh.vertex_count() as u32).map(is_tip));
    }

    /// Puts a particle somewhere with a velocity.
    pub fn place(&mut self, particle: usize, x: Vec3, v: Vec3) {
        self.wake();
        let (h, gravity) = (self.settings.scheme().h, self.settings.gravity);
        self.particles.place(particle, x, v, gravity, h);
        self.is_pin_stretch_current = false;
        self.tether_slack = f32::INFINITY;
    }

    /// Begins every history anew, after the kind of substep changed.
    pub fn restart_history(&mut self) {
        let (h, gravity) = (self.settings.scheme().h, self.settings.gravity);
        self.particles.restart_history(gravity, h);
    }

    /// The farthest a particle may move in a substep against the cloth's own motion [m].
    pub fn reach(&self) -> f32 {
        self.settings.max_displacement * self.mean_edge
    }

    /// Measures the tethers anew, after pins or pieces changed.
    pub fn tether(&mut self) {
        self.tethers.measure(&self.mesh, &self.rest, self.pins.hard());
        self.tethers_changed();
    }

    /// Measures anew which tethers tears changed: around the particles that were touched.
    pub fn tether_around(&mut self, touched: &[u32]) {
        if self.tethers.pin_count() != self.pins.hard().count() {
            return self.tether();
        }
        self.tethers.follow(&self.mesh, &self.rest, touched);
        self.tethers_changed();
    }

    fn tethers_changed(&mut self) {
        self.is_pin_stretch_current = false;
        self.tether_slack = f32::INFINITY;
        self.sort_outward();
    }

    /// Sorts links outward anew, after ways to pins or links changed.
    pub fn sort_outward(&mut self) {
        if self.settings.max_stretch > 0.0 {
            self.pin_order.sort(&self.tethers, self.particles.len(), &self.constraints.links);
        }
    }
}
