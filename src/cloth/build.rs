//! From a descriptor to a world at rest.

use crate::arena::Arena;
use crate::cloth::desc::{GridDesc, MeshDesc};
use crate::error::Result;
use crate::geometry::triangle::corner_areas;
use crate::math::simd::Level;
use crate::math::threads::Threads;
use crate::mesh::grid;
use crate::model::chains::Chains;
use crate::model::constraints::Constraints;
use crate::model::folds::Folds;
use crate::model::grid_cells::GridCells;
use crate::model::hinges::Hinges;
use crate::model::material::Material;
use crate::model::pin_order::PinOrder;
use crate::model::plate_elements::PlateElements;
use crate::model::tethers::Tethers;

use crate::mesh::grid::GridFrame;
use crate::mesh::intake;

use crate::mesh::grid_detection::DetectedGrid;
use crate::mesh::intake::RepairedMesh;
use crate::mesh::report::MeshReport;
use crate::mesh::{Mesh, NONE, next_corner};
use crate::solver::bend;
use crate::solver::integrate::sleep_timer::SleepTimer;
use crate::solver::profile::Profile;
use crate::solver::self_collide::surface::warm_start::WarmStart;
use crate::solver::world::{TickScratch, World};

use crate::solver::stretch::{damping_scratch, line_scratch};
use crate::state::anchors::AnchorConstraints;
use crate::state::attachments::MAX_ATTACHMENTS;
use crate::state::colliders::MAX_COLLIDERS;
use crate::state::events::Events;
use crate::state::grabs::MAX_GRABS;
use crate::state::mass_scales::MassScales;
use crate::state::particles::Particles;
use crate::state::pins::Pins;
use crate::state::pose::Pose;
use crate::state::settings::Settings;
use crate::state::wind::Wind;
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// What a cloth was made from; it can be made anew.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Origin {
    Grid(GridDesc),
    Mesh(MeshDesc),
}

impl Origin {
    /// The cloth as it was when it was new, and what had to be repaired. The descriptor has been checked.
    pub fn world(&self) -> Result<(World, MeshReport)> {
        match self {
            Self::Grid(desc) => Ok(grid_world(desc)),
            Self::Mesh(desc) => mesh_world(desc),
        }
    }

    /// The descriptor checked again; for bytes from outside.
    pub fn check(&self) -> Result<()> {
        match self {
            Self::Grid(desc) => desc.check(),
            Self::Mesh(desc) => desc.check(),
        }
    }

    /// Texture coordinates of the vertices that were given.
    pub fn uvs(&self) -> Vec<Vec2> {
        match self {
            Self::Grid(desc) => grid::uvs(desc.columns, desc.rows),
            Self::Mesh(desc) if desc.uvs.is_empty() => vec![Vec2::ZERO; desc.positions.len()],
            Self::Mesh(desc) => desc.uvs.clone(),
        }
    }
}

fn grid_world(desc: &GridDesc) -> (World, MeshReport) {
    let unit = |v: Vec3| v * (1.0 / v.length());
    let frame = GridFrame {
        origin: desc.origin,
        right: unit(desc.right),
        down: unit(desc.down),
        spacing: desc.spacing,
    };
    let lattice = DetectedGrid { columns: desc.columns, rows: desc.rows, frame };
    let rest = grid::positions(desc.columns, desc.rows, &frame);
    let capacity = desc.capacity();
    let mesh = Mesh::new(grid::triangles(desc.columns, desc.rows), rest.len(), capacity);
    let (count, triangles) = (rest.len() as u32, mesh.triangles.len() as u32);
    let report = MeshReport {
        vertices: count,
        triangles,
        particles: count,
        kept_triangles: triangles,
        pieces: 1,
        is_grid: true,
        ..MeshReport::default()
    };
    let fabric = Fabric::sheet(&lattice, mesh, rest, capacity);
    (build(fabric, desc.pinned(), capacity, &desc.material, &desc.settings), report)
}

fn mesh_world(desc: &MeshDesc) -> Result<(World, MeshReport)> {
    let (positions, indices) = (&desc.positions, &desc.indices);
    let most = |particles: usize| desc.capacity(particles);
    let RepairedMesh { mesh, source_vertices: places, seams, mut report } =
        intake::repair(positions, indices, desc.weld_distance, most)?;
    let rest: Vec<Vec3> = places.iter().map(|vertex| positions[*vertex as usize]).collect();
    let capacity = desc.capacity(rest.len())?;
    let fabric = match DetectedGrid::detect(&mesh.triangles, &rest) {
        Some(lattice) => {
            report.is_grid = true;
            Fabric::sheet(&lattice, mesh, rest, capacity)
        }
        None => Fabric::any(mesh, rest, capacity),
    };
    let pinned = match &seams {
        Some(seams) => seams.particles_of(&desc.pinned),
        None => desc.pinned.clone(),
    };
    let mut world = build(fabric, pinned, capacity, &desc.material, &desc.settings);
    world.seams = seams;
    let extra = capacity - world.particles.len();
    if let Some(seams) = &mut world.seams {
        seams.set_capacity(extra, world.triangle_capacity);
    }
    Ok((world, report))
}

/// What a world is made of that does not move.
struct Fabric {
    mesh: Mesh,
    constraints: Constraints,
    rest: Vec<Vec3>,
    frame: Option<GridFrame>,
    areas: Vec<[f32; 3]>,
    cells: Option<GridCells>,
    plates: Option<PlateElements>,
}

impl Fabric {
    /// A regular grid.
    fn sheet(lattice: &DetectedGrid, mesh: Mesh, rest: Vec<Vec3>, capacity: usize) -> Self {
        let DetectedGrid { columns, rows, frame } = *lattice;
        let openings = opening_capacity(&mesh, capacity);
        let mut constraints = Constraints::from_grid(columns, rows, frame.spacing, &mesh, openings);
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

    /// Any sound mesh.
    fn any(mesh: Mesh, rest: Vec<Vec3>, capacity: usize) -> Self {
        let mut constraints =
            Constraints::from_mesh(&mesh, &rest, opening_capacity(&mesh, capacity));
        constraints.hinges = Hinges::new(&mesh, &constraints.links, &rest);
        let corners = |triangle: &[u32; 3]| triangle.map(|v| rest[v as usize]);
        let areas = mesh.triangles.iter().map(|triangle| corner_areas(corners(triangle))).collect();
        Self { mesh, constraints, rest, frame: None, areas, cells: None, plates: None }
    }
}

fn build(
    fabric: Fabric,
    pinned: Vec<u32>,
    capacity: usize,
    material: &Material,
    settings: &Settings,
) -> World {
    let Fabric { mesh, mut constraints, rest, frame, areas, cells, plates } = fabric;
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
        reference_pose: Pose::ORIGIN,
        colliders: Arena::with_capacity(MAX_COLLIDERS),
        settings: settings.clone(),
        material: material.clone(),
        wind: Wind::default(),
        time: 0.0,
        tick: 0,
        pieces: 0,
        triangle_capacity,
        reserve_reported: false,
        over_stretched: 0,
        over_stretch_reported: false,
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
        crossings: Vec::new(),
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
    world.reserve_packed(capacity);
    world.pin_order.reserve(capacity, world.constraints.links.len());
    for particle in pinned {
        let x = world.rest[particle as usize];
        world.pins.insert(particle, x, x);
    }
    world.pieces =
        world.mesh.label_pieces(&mut world.scratch.pieces.label, &mut world.scratch.piece_stack);
    world.rebuild_crack_tips();
    world.compute_masses();
    world.constraints.update_compliances(material);
    world.rebuild_tethers();
    world.reset_history();
    world
}

/// How many edges tears can open: each new vertex opens at most two, and only inner edges can.
fn opening_capacity(mesh: &Mesh, capacity: usize) -> usize {
    let inner = mesh.edges().filter(|edge| mesh.across(*edge) != NONE).count();
    inner.min(2 * (capacity - mesh.vertex_count()))
}

fn mean_edge(mesh: &Mesh, rest: &[Vec3]) -> f32 {
    let at = |corner: u32| rest[mesh.vertex(corner) as usize];
    let (mut sum, mut count) = (0.0, 0.0);
    // The shorter two edges of each triangle: on a grid that is the spacing, not the diagonal.
    for triangle in 0..mesh.triangles.len() as u32 {
        let length = |corner: u32| (at(next_corner(corner)) - at(corner)).length();
        let [a, b, c] = [0, 1, 2].map(|k| length(3 * triangle + k));
        let longest = if a > b { a } else { b };
        let longest = if longest > c { longest } else { c };
        sum += f64::from(a + b + c - longest) * 0.5;
        count += 1.0;
    }
    (sum / count) as f32
}

impl World {
    /// Sees to room for `capacity` particles in every list that tears make longer.
    pub(crate) fn reserve(&mut self, capacity: usize) {
        let reserve = |list: &mut Vec<u32>| list.reserve_exact(capacity.saturating_sub(list.len()));
        reserve(&mut self.mesh.source);
        reserve(&mut self.mesh.corner_of);
        if let Some(seams) = &mut self.seams {
            seams.reserve();
        }
        self.particles.reserve(capacity);
        self.mass_scales.reserve(capacity);
        self.crack_tips.reserve_exact(capacity.saturating_sub(self.crack_tips.len()));
        self.pins.reserve(capacity);
        self.events.reserve();
        let openings = opening_capacity(&self.mesh, capacity.max(self.mesh.vertex_count()));
        self.constraints.reserve(openings, capacity);
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
        self.reserve_packed(capacity);
        self.reserve_effective_mass();
        self.reserve_anchor_scratch();
        self.reserve_contacts();
        self.see_to_crowd();
        self.see_to_layers();
        self.mesh.label_pieces(&mut self.scratch.pieces.label, &mut self.scratch.piece_stack);
    }

    /// Sees to room for all that tears may still need, after a cut made more triangles.
    pub(crate) fn reserve_for_tears(&mut self) {
        let openings = opening_capacity(&self.mesh, self.capacity());
        self.constraints.reserve(openings, self.capacity());
        self.tethers.reserve(self.capacity(), self.mesh.triangles.len());
        let (triangles, scratch) = (self.mesh.triangles.len(), &mut self.scratch);
        scratch.piece_stack.reserve_exact(triangles.saturating_sub(scratch.piece_stack.len()));
        scratch.pieces.reserve();
        scratch.rollback.reserve(triangles);
    }

    fn reserve_packed(&mut self, capacity: usize) {
        self.scratch.end_weights.reserve(capacity, self.constraints.links.len());
        if self.constraints.rows.is_none() {
            self.scratch.interleaved.reserve(capacity);
        }
        let has_strips = self.constraints.rows.is_some();
        let steps = self.constraints.chains.blocks.max_steps();
        self.scratch.lines = line_scratch::LineScratch::new(steps, capacity, has_strips);
        self.scratch.bend = bend::bend_scratch::BendScratch::new(
            self.plate_elements.as_ref(),
            self.mesh.triangles.len(),
            self.constraints.hinges.all.len(),
            capacity,
        );
        let extra = opening_capacity(&self.mesh, capacity.max(self.mesh.vertex_count()));
        self.scratch.damping =
            damping_scratch::DampingScratch::new(self.constraints.links.len(), extra);
    }
}
