//! Output lists that a renderer reads through [`View`](crate::View): positions, normals, uvs,
//! indices.
//!
//! Solver data is per particle; output lists are per vertex. Seams (welded or split vertices) map
//! one to the other.
//!
//! Reads `World`; writes its own lists.
//! Invariant: ticks, tears and cuts keep the addresses of the lists, so these are reserved for all
//! that the world has memory for, and new content is copied into them.

use crate::cloth::build::ClothDesc;
use crate::cloth::change_history::{ChangedRanges, changed_range};
use crate::cloth::interpolated_surface::InterpolatedSurface;
use crate::math::float_env::with_float_env;
use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::math::shared::Shared;
use crate::mesh::split_edge::CutSite;
use crate::solver::output::normals;
use crate::solver::world::World;
use glam::{Vec2, Vec3};

/// The lists behind a [`View`](crate::View).
#[derive(Debug)]
pub(crate) struct Outputs {
    /// One entry per vertex [m].
    pub positions: Vec<Vec3>,
    /// `positions` relative to the origin; allocated at the first request, valid if
    /// `are_relative_positions_current`.
    relative_positions: Vec<Vec3>,
    are_relative_positions_current: bool,
    /// One unit normal per vertex; valid if `are_normals_current`. Allocated at the first request,
    /// or with the memory for tears.
    pub normals: Vec<Vec3>,
    /// Whether `normals` belong to the current positions.
    pub are_normals_current: bool,
    /// Normals and tangents per particle, at the blend of the last request.
    pub surface: InterpolatedSurface,
    /// What only tears and cuts change.
    pub attributes: Shared<VertexAttributes>,
    /// Scratch lists for the next topology, compared with the current ones to find what changed.
    pending: PendingAttributes,
}

heap_bytes!(
    Outputs { positions, relative_positions, normals, surface, attributes, pending } plain { are_relative_positions_current, are_normals_current }
);

/// Attributes of the vertices and triangles that clones share.
#[derive(Clone, Debug, Default)]
pub(crate) struct VertexAttributes {
    /// Texture coordinates per vertex.
    pub uvs: Vec<Vec2>,
    /// Texture coordinates of each rest vertex (vertices before any split; cuts append some).
    rest_uvs: Vec<Vec2>,
    /// The vertex of the descriptor that each rest vertex came from.
    rest_sources: Vec<u32>,
    /// The vertex of the descriptor that each vertex came from.
    pub sources: Vec<u32>,
    /// Whether each vertex is on a border that a tear or cut made.
    pub frayed: Vec<bool>,
    /// The particle of each vertex.
    pub particles: Vec<u32>,
    /// Three vertices per triangle.
    pub indices: Vec<u32>,
}

heap_bytes!(
    VertexAttributes { uvs, rest_uvs, rest_sources, sources, frayed, particles, indices } plain {}
);

/// Per-vertex attributes of a new topology, before they replace the current ones. Empty between
/// changes of a cloth that cannot tear.
#[derive(Debug, Default)]
struct PendingAttributes {
    uvs: Vec<Vec2>,
    sources: Vec<u32>,
    frayed: Vec<bool>,
    particles: Vec<u32>,
    /// Whether each particle is on a border that a tear or cut made.
    frayed_particles: Vec<bool>,
}

heap_bytes!(PendingAttributes { uvs, sources, frayed, particles, frayed_particles } plain {});

impl PendingAttributes {
    /// Allocates for `particles` particles and `vertices` vertices.
    fn reserve(&mut self, particles: usize, vertices: usize) {
        self.uvs.reserve_total(vertices);
        self.sources.reserve_total(vertices);
        self.frayed.reserve_total(vertices);
        self.particles.reserve_total(vertices);
        self.frayed_particles.reserve_total(particles);
    }
}

impl Outputs {
    /// Makes the lists of a world, with the texture coordinates of its descriptor.
    pub fn new(world: &World, desc: &ClothDesc) -> Self {
        let mut outputs = Self {
            positions: Vec::new(),
            relative_positions: Vec::new(),
            are_relative_positions_current: false,
            normals: Vec::new(),
            are_normals_current: false,
            surface: InterpolatedSurface::with_capacity(world.allocated_particles()),
            attributes: Shared::default(),
            pending: PendingAttributes::default(),
        };
        outputs.reserve(world);
        outputs.set_uvs(desc);
        outputs.update_topology(world);
        outputs.update_positions(world);
        outputs
    }

    /// Makes the lists of a clone. Those that only tears and cuts change are shared, unless the cloth
    /// has memory for tears.
    pub fn of_clone(&self, world: &World) -> Self {
        let mut outputs = Self {
            positions: self.positions.clone(),
            relative_positions: Vec::new(),
            are_relative_positions_current: false,
            normals: Vec::new(),
            are_normals_current: false,
            surface: self.surface.with_same_capacity(),
            attributes: self.attributes.clone(),
            pending: PendingAttributes::default(),
        };
        if world.has_tear_reserve {
            outputs.reserve(world);
        }
        outputs
    }

    /// Allocates every list for as many vertices and triangles as the world has memory for.
    pub fn reserve(&mut self, world: &World) {
        let (particles, vertices) = (world.allocated_particles(), world.allocated_vertices());
        self.positions.reserve_total(vertices);
        if world.has_tear_reserve {
            self.normals.reserve_total(vertices);
            self.surface.reserve(particles, vertices);
        }
        let attributes = &mut *self.attributes;
        attributes.uvs.reserve_total(vertices);
        attributes.sources.reserve_total(vertices);
        attributes.frayed.reserve_total(vertices);
        attributes.particles.reserve_total(vertices);
        attributes.indices.reserve_total(3 * world.allocated_triangles());
        if world.has_tear_reserve {
            self.pending.reserve(particles, vertices);
        }
        if self.relative_positions.capacity() > 0 {
            self.relative_positions.reserve_total(vertices);
        }
    }

    /// Sets the texture coordinates and sources of the descriptor's vertices.
    fn set_uvs(&mut self, desc: &ClothDesc) {
        let attributes = &mut *self.attributes;
        attributes.rest_uvs = with_float_env(|| desc.uvs());
        attributes.rest_sources = (0..attributes.rest_uvs.len() as u32).collect();
    }

    /// Copies the current positions and marks the normals as out of date.
    pub fn update_positions(&mut self, world: &World) {
        normals::positions(world, &mut self.positions);
        self.are_relative_positions_current = false;
        self.are_normals_current = false;
        self.surface.invalidate_positions();
    }

    /// Returns the positions relative to the origin [m], one per vertex.
    pub fn relative_positions(&mut self, world: &World) -> &[Vec3] {
        if !self.are_relative_positions_current {
            self.relative_positions.reserve_exact(self.positions.capacity());
            normals::scatter_to_vertices(world, &world.particles.x, &mut self.relative_positions);
            self.are_relative_positions_current = true;
        }
        &self.relative_positions
    }

    /// Returns all lists of positions and normals.
    pub fn vector_lists(&self) -> [&Vec<Vec3>; 3] {
        [&self.positions, &self.relative_positions, &self.normals]
    }

    /// Rebuilds indices and per-vertex attributes, and returns the ranges that changed.
    pub fn update_topology(&mut self, world: &World) -> ChangedRanges {
        let attributes = &mut *self.attributes;
        with_float_env(|| attributes.update_rest_vertices(world));
        let rest_vertices = RestVertices::of(world);
        let pending = &mut self.pending;
        pending.uvs.clear();
        pending.uvs.extend(
            rest_vertices.of_vertices.iter().map(|rest| attributes.rest_uvs[*rest as usize]),
        );
        pending.sources.clear();
        pending.sources.extend(
            rest_vertices.of_vertices.iter().map(|rest| attributes.rest_sources[*rest as usize]),
        );
        pending.particles.clear();
        pending.frayed.clear();
        world.mesh.mark_torn_borders(&mut pending.frayed_particles);
        let frayed = &pending.frayed_particles;
        match &world.seams {
            Some(seams) => {
                pending.particles.extend_from_slice(&seams.particles);
                pending.frayed.extend(seams.particles.iter().map(|at| frayed[*at as usize]));
            }
            None => {
                pending.particles.extend(0..frayed.len() as u32);
                pending.frayed.extend_from_slice(frayed);
            }
        }
        let indices = world.render_triangles().as_flattened();
        let change = ChangedRanges {
            indices: changed_range(&attributes.indices, indices),
            ..ChangedRanges::default()
        }
        .include_vertices(changed_range(&attributes.uvs, &pending.uvs))
        .include_vertices(changed_range(&attributes.sources, &pending.sources))
        .include_vertices(changed_range(&attributes.frayed, &pending.frayed))
        .include_vertices(changed_range(&attributes.particles, &pending.particles));
        self.surface.invalidate_topology();
        // Copy instead of swap: hosts hold pointers to these lists.
        attributes.uvs.clone_from(&pending.uvs);
        attributes.sources.clone_from(&pending.sources);
        attributes.frayed.clone_from(&pending.frayed);
        attributes.particles.clone_from(&pending.particles);
        attributes.indices.clear();
        attributes.indices.extend_from_slice(indices);
        if !world.has_tear_reserve {
            self.pending = PendingAttributes::default();
        }
        change
    }

    /// Computes the surface at `blend` (0: last tick, 1: current tick), with tangents on request.
    pub fn update_surface(&mut self, world: &World, blend: f32, with_tangents: bool) {
        self.surface.update(world, blend, with_tangents.then_some(&self.attributes.uvs[..]));
    }

    /// Returns the number of vertices.
    pub fn vertex_count(&self) -> u32 {
        self.positions.len() as u32
    }

    /// Computes the normals of the current positions, if they are out of date.
    pub fn refresh_normals(&mut self, world: &World) {
        if !self.are_normals_current {
            self.surface.update(world, 1.0, None);
            self.normals.reserve_total(self.positions.capacity());
            normals::scatter_to_vertices(world, &self.surface.normals, &mut self.normals);
            self.are_normals_current = true;
        }
    }
}

impl VertexAttributes {
    /// Appends texture coordinates and sources of the rest vertices that cuts added, by linear
    /// interpolation along the cut edge.
    fn update_rest_vertices(&mut self, world: &World) {
        let RestVertices { original, crossings, .. } = RestVertices::of(world);
        let known = original + crossings.len();
        self.rest_uvs.truncate(known);
        self.rest_sources.truncate(known);
        for crossing in &crossings[self.rest_uvs.len() - original..] {
            self.rest_uvs.push(crossing.interpolate(|end| self.rest_uvs[end as usize]));
            self.rest_sources.push(self.rest_sources[crossing.nearest_end() as usize]);
        }
    }
}

/// Rest vertices, and which of them each vertex came from.
struct RestVertices<'a> {
    /// Number of vertices in the descriptor: the first rest vertices.
    original: usize,
    /// Rest vertices that cuts added, each on an edge between two earlier ones.
    crossings: &'a [CutSite],
    /// The rest vertex of each vertex.
    of_vertices: &'a [u32],
}

impl<'a> RestVertices<'a> {
    fn of(world: &'a World) -> Self {
        match &world.seams {
            Some(seams) => Self {
                original: seams.original_count as usize,
                crossings: &seams.cut_sites,
                of_vertices: &seams.sites,
            },
            None => Self {
                original: world.mesh.original_count as usize,
                crossings: &world.cut_sites,
                of_vertices: &world.mesh.source,
            },
        }
    }
}
