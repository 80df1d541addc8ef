//! Builds a `World` at rest from a descriptor.
//!
//! ```text
//! GridDesc ──▶ grid positions, triangles ─┐
//!                                         ├─▶ RestModel ──▶ World
//! MeshDesc ──▶ intake::repair ────────────┘
//! ```
//!
//! A mesh that turns out to be a regular grid takes the grid path, so that it gets the grid kernels
//! and the same bits.
//!
//! Reads a checked descriptor; writes a new `World`.
//! Invariant: every list that a tick fills is allocated here and by `reserve`, so that no tick
//! allocates: for a cloth that can tear, as large as tears can make it.

use crate::arena::Arena;
use crate::cloth::desc::{GridDesc, MeshDesc};
use crate::error::Result;
use crate::geometry::triangle::corner_areas;
use crate::math::heap_bytes::HeapBytes;
use crate::math::shared::Shared;
use crate::math::simd::Level;
use crate::math::threads::Threads;
use crate::mesh::grid;
use crate::mesh::grid::GridFrame;
use crate::mesh::grid_detection::DetectedGrid;
use crate::mesh::intake;
use crate::mesh::intake::{RepairedMesh, Simplify};
use crate::mesh::report::MeshReport;
use crate::mesh::{Mesh, next_corner};
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
use crate::solver::integrate::sleep_timer::SleepTimer;
use crate::solver::profile::Profile;
use crate::solver::self_collide::contact_forces::WarmStart;
use crate::solver::tick_scratch::TickScratch;
use crate::solver::world::World;
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

impl HeapBytes for ClothDesc {
    fn heap_bytes(&self) -> usize {
        match self {
            Self::Grid(_) => 0,
            Self::Mesh(MeshDesc { positions, indices, uvs, pinned, .. }) => {
                let lists = indices.heap_bytes() + pinned.heap_bytes();
                positions.heap_bytes() + uvs.heap_bytes() + lists
            }
        }
    }
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
    let allocated = if desc.settings.tearing { capacity } else { rest.len() };
    let mesh = Mesh::new(grid::triangles(desc.columns, desc.rows), rest.len(), allocated);
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
    let rest_model = RestModel::from_grid(&grid, mesh, rest, allocated);
    let (material, settings) = (&desc.material, &desc.settings);
    (build_world(rest_model, origin, desc.pinned(), capacity, material, settings), report)
}

/// Repairs the mesh, detects a regular grid, and builds the world.
fn world_from_mesh(desc: &MeshDesc) -> Result<(World, MeshReport)> {
    let (positions, indices) = (&desc.positions, &desc.indices);
    let is_tearing = desc.settings.tearing;
    let allocated_for =
        |particles| desc.capacity(particles).map(|all| if is_tearing { all } else { particles });
    let simplify = Simplify { below: desc.simplify_below, uvs: &desc.uvs, pinned: &desc.pinned };
    let RepairedMesh { mesh, source_vertices, seams, mut report } =
        intake::repair(positions, indices, desc.weld_distance, &simplify, allocated_for)?;
    let mut rest: Vec<Vec3> =
        source_vertices.iter().map(|vertex| positions[*vertex as usize]).collect();
    let origin = initial_origin(&rest);
    rest.iter_mut().for_each(|x| *x -= origin);
    let (capacity, allocated) = (desc.capacity(rest.len())?, allocated_for(rest.len())?);
    let rest_model = match DetectedGrid::detect(&mesh.triangles, &rest) {
        Some(grid) => {
            report.is_grid = true;
            RestModel::from_grid(&grid, mesh, rest, allocated)
        }
        None => RestModel::from_mesh(mesh, rest, allocated),
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
        if world.has_tear_reserve {
            seams.reserve();
        }
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
        let opened_edges = mesh.max_opened_edges(capacity);
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
        let mut constraints = Constraints::from_mesh(&mesh, &rest, mesh.max_opened_edges(capacity));
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
    let triangle_capacity = mesh.triangles.len() + capacity - rest.len();
    let has_tear_reserve = settings.tearing;
    if has_tear_reserve {
        constraints.index_links_by_site(&mesh);
    }
    constraints.chains = Chains::new(&constraints.links, &rest, has_tear_reserve);
    let allocated = if has_tear_reserve { capacity } else { rest.len() };
    let folds = match &plates {
        Some(plates) => Folds::of_plates(plates),
        None => Folds::of_hinges(&constraints.hinges),
    };
    let mut world = World {
        mean_edge: mean_edge(&mesh, &rest),
        particles: Particles::at_rest(&rest, allocated),
        mass_scales: MassScales::default(),
        tethers: Tethers::default(),
        scratch: TickScratch::empty(),
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
        particle_capacity: capacity,
        triangle_capacity,
        has_tear_reserve,
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
        mesh: Shared::new(mesh),
        seams: None,
        constraints,
        rest: Shared::new(rest),
        rest_origin: origin,
        origin,
        cut_sites: Vec::new(),
        crack_tips: Vec::with_capacity(allocated),
        corner_area: Shared::new(areas),
        grid_frame: frame,
        grid_cells: cells,
        plate_elements: plates.map(Shared::new),
        folds,
        warm_start: WarmStart::default(),
        is_tangled: true,
    };
    world.label_pieces();
    for particle in pinned {
        let x = world.rest[particle as usize];
        world.pins.insert(particle, x, x);
    }
    world.reserve_fresh();
    world.rebuild_crack_tips();
    world.compute_masses();
    world.constraints.update_compliances(material, &world.maps);
    world.rebuild_tethers();
    world.reset_history();
    world
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
