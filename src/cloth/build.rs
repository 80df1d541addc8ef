//! Builds a `World` at rest from a descriptor.
//!
//! ```text
//! GridDesc ──▶ grid positions, triangles ─┐
//!                                         ├─▶ RestModel ──▶ World (all buffers at full capacity)
//! MeshDesc ──▶ intake::repair ────────────┘
//! ```
//!
//! A mesh that turns out to be a regular grid takes the grid path, so that it gets the grid kernels
//! and the same bits.
//!
//! Reads a checked descriptor; writes a new `World`.
//! Invariant: every buffer that tears and cuts may extend is reserved here, so that no tick
//! allocates.

use crate::arena::Arena;
use crate::cloth::desc::{GridDesc, MeshDesc};
use crate::error::Result;
use crate::geometry::triangle::corner_areas;
use crate::math::reserve::ReserveTotal;
use crate::math::simd::Level;
use crate::math::threads::Threads;
use crate::mesh::grid;
use crate::mesh::grid::GridFrame;
use crate::mesh::grid_detection::DetectedGrid;
use crate::mesh::intake;
use crate::mesh::intake::{RepairedMesh, Simplify};
use crate::mesh::report::MeshReport;
use crate::mesh::{Mesh, NONE, next_corner};
use crate::model::chains::Chains;
use crate::model::constraints::Constraints;
use crate::model::folds::Folds;
use crate::model::grid_cells::GridCells;
use crate::model::hinges::Hinges;
use crate::model::maps::Maps;
use crate::model::material::Material;
use crate::model::pin_order::PinOrder;
use crate::model::plate_elements::PlateElements;
use crate::model::tethers::Tethers;
use crate::solver::bend;
use crate::solver::integrate::sleep_timer::SleepTimer;
use crate::solver::profile::Profile;
use crate::solver::self_collide::contact_forces::WarmStart;
use crate::solver::stretch::{damping_scratch, line_scratch};
use crate::solver::world::{TickScratch, World};
use crate::state::anchors::AnchorConstraints;
use crate::state::attachments::MAX_ATTACHMENTS;
use crate::state::colliders::MAX_COLLIDERS;
use crate::state::events::Events;
use crate::state::frame_clock::FrameClock;
use crate::state::grabs::MAX_GRABS;
use crate::state::mass_scales::MassScales;
use crate::state::origin::{Samples, shift_to_cloth};
use crate::state::particles::Particles;
use crate::state::pins::Pins;
use crate::state::pose::Pose;
use crate::state::settings::Settings;
use crate::state::sewing::Sewing;
use crate::state::violations::Violations;
use crate::state::wind::Wind;
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// The descriptor that a cloth was made from. `Cloth::reset` and `Cloth::restore` build from it
/// again.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum ClothDesc {
    Grid(GridDesc),
    Mesh(MeshDesc),
}

impl ClothDesc {
    /// Builds the world at rest, and the report of the mesh repair. The descriptor must be checked.
    pub fn build_world(&self) -> Result<(World, MeshReport)> {
        match self {
            Self::Grid(desc) => Ok(world_from_grid(desc)),
            Self::Mesh(desc) => world_from_mesh(desc),
        }
    }

    /// Checks the descriptor, e.g. after it was read from saved bytes.
    pub fn check(&self) -> Result<()> {
        match self {
            Self::Grid(desc) => desc.check(),
            Self::Mesh(desc) => desc.check(),
        }
    }

    /// Returns the texture coordinates of the descriptor's vertices; zeros if it has none.
    pub fn uvs(&self) -> Vec<Vec2> {
        match self {
            Self::Grid(desc) => grid::uvs(desc.columns, desc.rows),
            Self::Mesh(desc) if desc.uvs.is_empty() => vec![Vec2::ZERO; desc.positions.len()],
            Self::Mesh(desc) => desc.uvs.clone(),
        }
    }
}

/// Builds the world of a grid.
fn world_from_grid(desc: &GridDesc) -> (World, MeshReport) {
    let unit = |v: Vec3| v * (1.0 / v.length());
    let mut frame = GridFrame {
        origin: desc.origin,
        right: unit(desc.right),
        down: unit(desc.down),
        spacing: desc.spacing,
    };
    let mut rest = grid::positions(desc.columns, desc.rows, &frame);
    let origin = initial_origin(&rest);
    if origin != Vec3::ZERO {
        frame.origin -= origin;
        rest = grid::positions(desc.columns, desc.rows, &frame);
    }
    let grid = DetectedGrid { columns: desc.columns, rows: desc.rows, frame };
    let capacity = desc.capacity();
    let mesh = Mesh::new(grid::triangles(desc.columns, desc.rows), rest.len(), capacity);
    let (count, triangles) = (rest.len() as u32, mesh.triangles.len() as u32);
    let mut report = MeshReport {
        vertices: count,
        triangles,
        particles: count,
        kept_triangles: triangles,
        pieces: 1,
        is_grid: true,
        ..MeshReport::default()
    };
    report.measure_quality(&mesh, |particle| rest[particle as usize], |triangle| triangle);
    let rest_model = RestModel::from_grid(&grid, mesh, rest, capacity);
    let (material, settings) = (&desc.material, &desc.settings);
    (build_world(rest_model, origin, desc.pinned(), capacity, material, settings), report)
}

/// Repairs the mesh, detects a regular grid, and builds the world.
fn world_from_mesh(desc: &MeshDesc) -> Result<(World, MeshReport)> {
    let (positions, indices) = (&desc.positions, &desc.indices);
    let capacity_for = |particles: usize| desc.capacity(particles);
    let simplify = Simplify { below: desc.simplify_below, uvs: &desc.uvs, pinned: &desc.pinned };
    let RepairedMesh { mesh, source_vertices, seams, mut report } =
        intake::repair(positions, indices, desc.weld_distance, &simplify, capacity_for)?;
    let mut rest: Vec<Vec3> =
        source_vertices.iter().map(|vertex| positions[*vertex as usize]).collect();
    let origin = initial_origin(&rest);
    rest.iter_mut().for_each(|x| *x -= origin);
    let capacity = desc.capacity(rest.len())?;
    let rest_model = match DetectedGrid::detect(&mesh.triangles, &rest) {
        Some(grid) => {
            report.is_grid = true;
            RestModel::from_grid(&grid, mesh, rest, capacity)
        }
        None => RestModel::from_mesh(mesh, rest, capacity),
    };
    let pinned = match &seams {
        Some(seams) => seams.particles_of(&desc.pinned),
        None => desc.pinned.clone(),
    };
    let mut world =
        build_world(rest_model, origin, pinned, capacity, &desc.material, &desc.settings);
    world.seams = seams;
    let extra = capacity - world.particles.len();
    if let Some(seams) = &mut world.seams {
        seams.set_capacity(extra, world.triangle_capacity);
    }
    Ok((world, report))
}

/// The parts of a world that describe the rest state.
struct RestModel {
    mesh: Mesh,
    constraints: Constraints,
    rest: Vec<Vec3>,
    frame: Option<GridFrame>,
    areas: Vec<[f32; 3]>,
    cells: Option<GridCells>,
    plates: Option<PlateElements>,
}

impl RestModel {
    /// The rest model of a regular grid: grid links, grid cells and plate elements.
    fn from_grid(grid: &DetectedGrid, mesh: Mesh, rest: Vec<Vec3>, capacity: usize) -> Self {
        let DetectedGrid { columns, rows, frame } = *grid;
        let opened_edges = max_opened_edges(&mesh, capacity);
        let mut constraints =
            Constraints::from_grid(columns, rows, frame.spacing, &mesh, opened_edges);
        constraints.set_thread_directions([frame.right, frame.down]);
        let areas = grid::corner_areas(columns, rows, frame.spacing);
        let mut cells = GridCells::new(columns, rows, frame.spacing);
        let mut plates =
            PlateElements::new(columns, rows, frame.spacing, &mesh, &constraints.links);
        if capacity > rest.len() {
            cells.reserve();
            plates.reserve(capacity);
        }
        let (frame, cells, plates) = (Some(frame), Some(cells), Some(plates));
        Self { mesh, constraints, rest, frame, areas, cells, plates }
    }

    /// The rest model of any repaired mesh: links along edges, and hinges.
    fn from_mesh(mesh: Mesh, rest: Vec<Vec3>, capacity: usize) -> Self {
        let mut constraints =
            Constraints::from_mesh(&mesh, &rest, max_opened_edges(&mesh, capacity));
        constraints.hinges = Hinges::new(&mesh, &constraints.links, &rest);
        let corners = |triangle: &[u32; 3]| triangle.map(|v| rest[v as usize]);
        let areas = mesh.triangles.iter().map(|triangle| corner_areas(corners(triangle))).collect();
        Self { mesh, constraints, rest, frame: None, areas, cells: None, plates: None }
    }
}

/// The origin of a cloth with these absolute positions [m].
fn initial_origin(positions: &[Vec3]) -> Vec3 {
    shift_to_cloth(Vec3::ZERO, &Samples::of(positions.len(), &|i| positions[i]), &|| 0.0)
}

/// Builds the world around a rest model and prepares its first tick.
fn build_world(
    rest_model: RestModel,
    origin: Vec3,
    pinned: Vec<u32>,
    capacity: usize,
    material: &Material,
    settings: &Settings,
) -> World {
    let RestModel { mesh, mut constraints, rest, frame, areas, cells, plates } = rest_model;
    constraints.chains = Chains::new(&constraints.links, &rest, capacity > rest.len());
    let triangle_capacity = mesh.triangles.len() + capacity - rest.len();
    let max_tears = settings.max_tears(triangle_capacity);
    let mut folds = match &plates {
        Some(plates) => Folds::of_plates(plates),
        None => Folds::of_hinges(&constraints.hinges),
    };
    folds.reserve_hardening(material);
    let mut world = World {
        mean_edge: mean_edge(&mesh, &rest),
        particles: Particles::at_rest(&rest, capacity),
        mass_scales: MassScales::default(),
        tethers: Tethers::with_capacity(capacity),
        scratch: TickScratch::new(rest.len(), capacity, mesh.triangles.len(), max_tears),
        pins: Pins::default(),
        attachments: Arena::with_capacity(MAX_ATTACHMENTS),
        grabs: Arena::with_capacity(MAX_GRABS),
        anchors: AnchorConstraints::default(),
        sewing: Sewing::default(),
        reference_pose: Pose::ORIGIN,
        colliders: Arena::with_capacity(MAX_COLLIDERS),
        settings: settings.clone(),
        material: material.clone(),
        maps: Maps::default(),
        wind: Wind::default(),
        clock: FrameClock::default(),
        pieces: 0,
        triangle_capacity,
        reserve_reported: false,
        violations: Violations::default(),
        substeps: settings.substeps,
        stiffness_step: 0.0,
        has_no_history: false,
        pin_order: PinOrder::default(),
        tether_slack: f32::INFINITY,
        pin_stretch: 1.0,
        is_pin_stretch_current: false,
        events: Events::new(),
        level: Level::best(),
        threads: Threads::ONE,
        profile: Profile::default(),
        sleep: SleepTimer::default(),
        mesh,
        seams: None,
        constraints,
        rest,
        rest_origin: origin,
        origin,
        cut_sites: Vec::new(),
        crack_tips: Vec::with_capacity(capacity),
        corner_area: areas,
        grid_frame: frame,
        grid_cells: cells,
        plate_elements: plates,
        folds,
        particle_collision: None,
        warm_start: WarmStart::default(),
        is_tangled: true,
        surface_collision: None,
    };
    world.pins.reserve(capacity);
    world.tethers.reserve(capacity, world.mesh.triangles.len());
    world.reserve_scratch(capacity);
    world.pin_order.reserve(capacity, world.constraints.links.len());
    for particle in pinned {
        let x = world.rest[particle as usize];
        world.pins.insert(particle, x, x);
    }
    world.label_pieces();
    world.rebuild_crack_tips();
    world.compute_masses();
    world.constraints.update_compliances(material, &world.maps);
    world.rebuild_tethers();
    world.reset_history();
    world
}

/// Returns the number of edges that tears can open at most: each new vertex opens up to two, and
/// only inner edges can open.
fn max_opened_edges(mesh: &Mesh, capacity: usize) -> usize {
    let inner_edges = mesh.edges().filter(|edge| mesh.across(*edge) != NONE).count();
    inner_edges.min(2 * (capacity - mesh.vertex_count()))
}

/// Returns the mean of the two shorter edges of all triangles [m]; on a grid, the spacing.
fn mean_edge(mesh: &Mesh, rest: &[Vec3]) -> f32 {
    let position = |corner: u32| rest[mesh.vertex(corner) as usize];
    let (mut sum, mut count) = (0.0, 0.0);
    // The two shorter edges of each triangle: on a grid, those of length `spacing`.
    for triangle in 0..mesh.triangles.len() as u32 {
        let length = |corner: u32| (position(next_corner(corner)) - position(corner)).length();
        let [a, b, c] = [0, 1, 2].map(|k| length(3 * triangle + k));
        let longest = if a > b { a } else { b };
        let longest = if longest > c { longest } else { c };
        sum += f64::from(a + b + c - longest) * 0.5;
        count += 1.0;
    }
    (sum / count) as f32
}

impl World {
    /// Reserves every list that tears may extend for `capacity` particles.
    pub(crate) fn reserve(&mut self, capacity: usize) {
        let reserve = |list: &mut Vec<u32>| list.reserve_total(capacity);
        reserve(&mut self.mesh.source);
        reserve(&mut self.mesh.corner_of);
        if let Some(seams) = &mut self.seams {
            seams.reserve();
        }
        self.particles.reserve(capacity);
        self.mass_scales.reserve(capacity);
        self.maps.reserve(capacity);
        self.crack_tips.reserve_total(capacity);
        self.pins.reserve(capacity);
        self.events.reserve();
        let opened_edges = max_opened_edges(&self.mesh, capacity.max(self.mesh.vertex_count()));
        self.constraints.reserve(opened_edges, capacity);
        if let Some(cells) = &mut self.grid_cells {
            cells.reserve();
        }
        if let Some(plates) = &mut self.plate_elements {
            plates.reserve(capacity);
        }
        self.tethers.reserve(capacity, self.mesh.triangles.len());
        self.pin_order.reserve(capacity, self.constraints.links.len());
        self.scratch = TickScratch::new(
            self.particles.len(),
            capacity,
            self.mesh.triangles.len(),
            self.settings.max_tears(self.triangle_capacity),
        );
        self.reserve_scratch(capacity);
        self.reserve_effective_mass();
        self.reserve_anchor_scratch();
        self.reserve_contacts();
        self.rebuild_particle_collision();
        self.rebuild_surface_collision();
        self.label_pieces();
    }

    /// Reserves what tears may still need, after a cut added triangles.
    pub(crate) fn reserve_for_tears(&mut self) {
        let opened_edges = max_opened_edges(&self.mesh, self.capacity());
        self.constraints.reserve(opened_edges, self.capacity());
        self.tethers.reserve(self.capacity(), self.mesh.triangles.len());
        let (triangles, scratch) = (self.mesh.triangles.len(), &mut self.scratch);
        scratch.bend.hinge_lambda.reserve_total(self.constraints.dynamic.capacity());
        scratch.piece_stack.reserve_total(triangles);
        scratch.pieces.reserve();
        scratch.piece_groups.reserve(triangles);
    }

    /// Allocates the scratch buffers of the solver stages for `capacity` particles.
    fn reserve_scratch(&mut self, capacity: usize) {
        self.scratch.end_weights.reserve(capacity, self.constraints.links.len());
        if self.constraints.rows.is_none() {
            self.scratch.interleaved.reserve(capacity);
        }
        let has_grid_rows = self.constraints.rows.is_some();
        let steps = self.constraints.chains.blocks.max_steps();
        self.scratch.lines = line_scratch::LineScratch::new(steps, capacity, has_grid_rows);
        self.scratch.bend = bend::bend_scratch::BendScratch::new(
            self.plate_elements.as_ref(),
            self.mesh.triangles.len(),
            self.constraints.hinges.all.len(),
            capacity,
        );
        self.scratch.bend.hinge_lambda.reserve_total(self.constraints.dynamic.capacity());
        let extra = max_opened_edges(&self.mesh, capacity.max(self.mesh.vertex_count()));
        self.scratch.damping =
            damping_scratch::DampingScratch::new(self.constraints.links.len(), extra);
    }
}
