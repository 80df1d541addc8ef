//! What a renderer reads: positions, normals, uvs, triangles, numbers about the cloth.

use crate::cloth::Cloth;
use crate::cloth::blended_surface::BlendedSurface;
use crate::cloth::build::Origin;
use crate::cloth::changes::{Change, differing};
use crate::math::float_env::with_float_env;
use crate::mesh::report::MeshReport;
use crate::mesh::split_edge::CutSite;
use crate::model::grid_cells::GridCells;
use crate::solver::output::{normals, stats};
use crate::solver::stage::Stage;

use crate::solver::world::World;
use core::ops::Range;
use glam::{Vec2, Vec3};

/// A cloth as its renderer sees it. All lists have one entry a vertex, but for the indices.
///
/// Vertices are what is drawn, particles what moves. Each vertex is the particle of its number, unless the
/// cloth was made of a mesh of which vertices were welded or split, see [`Cloth::vertex_particles`]. The
/// triangles of both are the same, in the same order.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Positions [m].
    pub positions: &'a [Vec3],
    /// Unit normals, area-weighted; zero for a vertex that no triangle uses. Vertices that share a particle
    /// share its normal.
    pub normals: &'a [Vec3],
    /// Texture coordinates.
    pub uvs: &'a [Vec2],
    /// Three vertices a triangle.
    pub indices: &'a [u32],
    /// Which original vertex each vertex came from; for one that a cut made on an edge, the nearer end's.
    pub source_vertices: &'a [u32],
    /// Whether a vertex is at a border that a tear or a cut made; at a hem it is not.
    pub frayed: &'a [bool],
    /// How many vertices there may ever be.
    pub vertex_capacity: u32,
    /// How many indices there may ever be.
    pub index_capacity: u32,
    /// Changes when indices do.
    pub topology_revision: u32,
    /// Changes when positions do.
    pub state_revision: u32,
    /// The particle of each vertex.
    pub particles: &'a [u32],
}

/// FloatBlock about a cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stats {
    /// How many particles there are.
    pub particles: u32,
    /// How many triangles there are.
    pub triangles: u32,
    /// How many links it was woven with.
    pub constraints: u32,
    /// How many links hold now.
    pub active_constraints: u32,
    /// How many pieces hang together by edges.
    pub pieces: u32,
    /// Ticks since it was made or reset.
    pub ticks: u32,
    /// How far to blend from the last tick to this one, see [`Cloth::blend`].
    pub blend: f32,
    /// The greatest stretch of a stretch link: 0.01 is 1 % over its rest length.
    pub max_stretch: f32,
    /// The mean stretch of the stretch links.
    pub mean_stretch: f32,
    /// How many links are past `max_stretch`, if there is such a bound: pins or grabs hold them apart.
    pub over_stretched: u32,
    /// Energy of motion [J].
    pub kinetic_energy: f32,
    /// The speed of its fastest particle [m/s].
    pub max_speed: f32,
    /// Whether it sleeps, see [`Settings::sleep_speed`](crate::Settings).
    pub asleep: bool,
    /// Memory that it holds [B], about.
    pub bytes: u64,
    /// Time that each stage took in the last call that ran ticks [s]; zeros without a clock.
    pub seconds: [f32; Stage::COUNT],
}

/// The lists behind a [`View`]; they never move while the cloth lives.
#[derive(Debug)]
pub(crate) struct Outputs {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    normals_current: bool,
    pub drawn: BlendedSurface,
    uvs: Vec<Vec2>,
    /// Texture coordinates of each site, and the original vertex it came from.
    site_uvs: Vec<Vec2>,
    site_sources: Vec<u32>,
    sources: Vec<u32>,
    frayed: Vec<bool>,
    particles: Vec<u32>,
    /// Room to find the next ones in.
    next: Next,
    indices: Vec<u32>,
}

/// What follows a change of triangles, as it is found.
#[derive(Debug)]
struct Next {
    uvs: Vec<Vec2>,
    sources: Vec<u32>,
    frayed: Vec<bool>,
    particles: Vec<u32>,
    /// Whether each particle is frayed.
    frayed_particles: Vec<bool>,
}

impl Outputs {
    /// Room for all that the cloth may become.
    pub fn new(world: &World) -> Self {
        let (particles, capacity) = (world.capacity(), world.vertex_capacity());
        Self {
            positions: Vec::with_capacity(capacity),
            normals: Vec::with_capacity(capacity),
            normals_current: false,
            drawn: BlendedSurface::with_capacity(particles),
            uvs: Vec::with_capacity(capacity),
            site_uvs: Vec::new(),
            site_sources: Vec::new(),
            sources: Vec::with_capacity(capacity),
            frayed: Vec::with_capacity(capacity),
            particles: Vec::with_capacity(capacity),
            next: Next {
                uvs: Vec::with_capacity(capacity),
                sources: Vec::with_capacity(capacity),
                frayed: Vec::with_capacity(capacity),
                particles: Vec::with_capacity(capacity),
                frayed_particles: Vec::with_capacity(particles),
            },
            indices: Vec::with_capacity(3 * world.triangle_capacity),
        }
    }

    /// Takes on the texture coordinates that the cloth was made with.
    pub fn set_uvs(&mut self, origin: &Origin) {
        self.site_uvs = with_float_env(|| origin.uvs());
        self.site_sources = (0..self.site_uvs.len() as u32).collect();
    }

    /// Follows a change of positions.
    pub fn follow(&mut self, world: &World) {
        normals::positions(world, &mut self.positions);
        self.normals_current = false;
        self.drawn.moved();
    }

    /// Follows a change of triangles, and says which entries are not as they were.
    pub fn follow_topology(&mut self, world: &World) -> Change {
        with_float_env(|| self.follow_sites(world));
        let sites = Sites::of(world);
        let next = &mut self.next;
        next.uvs.clear();
        next.uvs.extend(sites.of_vertices.iter().map(|site| self.site_uvs[*site as usize]));
        next.sources.clear();
        next.sources.extend(sites.of_vertices.iter().map(|site| self.site_sources[*site as usize]));
        next.particles.clear();
        next.frayed.clear();
        world.mesh.mark_torn_borders(&mut next.frayed_particles);
        let frayed = &next.frayed_particles;
        match &world.seams {
            Some(seams) => {
                next.particles.extend_from_slice(&seams.particles);
                next.frayed.extend(seams.particles.iter().map(|at| frayed[*at as usize]));
            }
            None => {
                next.particles.extend(0..frayed.len() as u32);
                next.frayed.extend_from_slice(frayed);
            }
        }
        let indices = world.render_triangles().as_flattened();
        let change = Change { indices: differing(&self.indices, indices), ..Change::default() }
            .and_vertices(differing(&self.uvs, &next.uvs))
            .and_vertices(differing(&self.sources, &next.sources))
            .and_vertices(differing(&self.frayed, &next.frayed))
            .and_vertices(differing(&self.particles, &next.particles));
        self.drawn.retied();
        // Copied, since lists that were handed out stay where they are.
        self.uvs.clone_from(&next.uvs);
        self.sources.clone_from(&next.sources);
        self.frayed.clone_from(&next.frayed);
        self.particles.clone_from(&next.particles);
        self.indices.clear();
        self.indices.extend_from_slice(indices);
        change
    }

    /// Finds the surface as it is at a share of the way between two ticks.
    pub fn follow_drawn(&mut self, world: &World, share: f32, with_tangents: bool) {
        self.drawn.follow(world, share, with_tangents.then_some(&self.uvs[..]));
    }

    pub fn vertex_count(&self) -> u32 {
        self.positions.len() as u32
    }

    fn follow_sites(&mut self, world: &World) {
        let Sites { original, crossings, .. } = Sites::of(world);
        let known = original + crossings.len();
        self.site_uvs.truncate(known);
        self.site_sources.truncate(known);
        for crossing in &crossings[self.site_uvs.len() - original..] {
            self.site_uvs.push(crossing.interpolate(|end| self.site_uvs[end as usize]));
            self.site_sources.push(self.site_sources[crossing.nearest_end() as usize]);
        }
    }

    fn follow_normals(&mut self, world: &World) {
        if !self.normals_current {
            self.drawn.follow(world, 1.0, None);
            normals::scatter_to_vertices(world, &self.drawn.normals, &mut self.normals);
            self.normals_current = true;
        }
    }
}

/// Where vertices come from.
struct Sites<'a> {
    /// Vertices that were given: the first sites.
    original: usize,
    crossings: &'a [CutSite],
    of_vertices: &'a [u32],
}

impl<'a> Sites<'a> {
    fn of(world: &'a World) -> Self {
        match &world.seams {
            Some(seams) => Self {
                original: seams.original_count as usize,
                crossings: &seams.cut_sites,
                of_vertices: &seams.sites,
            },
            None => Self {
                original: world.mesh.original_count as usize,
                crossings: &world.crossings,
                of_vertices: &world.mesh.source,
            },
        }
    }
}

impl Cloth {
    /// All that a renderer reads. Normals are computed when first asked for after a change.
    pub fn view(&mut self) -> View<'_> {
        self.refresh_normals();
        View {
            positions: &self.outputs.positions,
            normals: &self.outputs.normals,
            uvs: &self.outputs.uvs,
            indices: &self.outputs.indices,
            source_vertices: &self.outputs.sources,
            frayed: &self.outputs.frayed,
            vertex_capacity: self.world.vertex_capacity() as u32,
            index_capacity: 3 * self.world.triangle_capacity as u32,
            topology_revision: self.topology_revision,
            state_revision: self.state_revision,
            particles: &self.outputs.particles,
        }
    }

    /// The particle of each vertex. A mesh that was welded or had sheets to be parted has several vertices to
    /// a particle; else each vertex is the particle of its number.
    ///
    /// Positions, normals, texture coordinates, source vertices, frayed borders and indices are those of
    /// vertices. Calls that touch the cloth (pins, grabs, tears by hand, positions and velocities) take
    /// particles, and what a ray hits tells one. Of an event, `particle_a` and `particle_b` are particles,
    /// `vertex` and `source` are vertices. Triangles have the same numbers in both.
    pub fn vertex_particles(&self) -> &[u32] {
        &self.outputs.particles
    }

    /// What had to be repaired of the mesh that it was made of; nothing of a grid.
    pub fn mesh_report(&self) -> &MeshReport {
        &self.report
    }

    /// Positions of the vertices [m].
    pub fn positions(&self) -> &[Vec3] {
        &self.outputs.positions
    }

    /// Unit normals of the vertices, computed when first asked for after a change.
    pub fn normals(&mut self) -> &[Vec3] {
        self.refresh_normals();
        &self.outputs.normals
    }

    /// Texture coordinates of the vertices.
    pub fn uvs(&self) -> &[Vec2] {
        &self.outputs.uvs
    }

    /// Three vertices a triangle.
    pub fn indices(&self) -> &[u32] {
        &self.outputs.indices
    }

    /// Which original vertex each vertex came from; for one that a cut made on an edge, the nearer end's.
    pub fn source_vertices(&self) -> &[u32] {
        &self.outputs.sources
    }

    /// Whether each vertex is at a border that a tear or a cut made, which a renderer may fringe. The
    /// borders that the cloth was made with are hems.
    pub fn frayed(&self) -> &[bool] {
        &self.outputs.frayed
    }

    /// How many particles there are.
    pub fn particle_count(&self) -> u32 {
        self.world.particles.len() as u32
    }

    /// Where a particle is [m]; `None` if there is no such particle.
    pub fn position(&self, particle: u32) -> Option<Vec3> {
        let at = particle as usize;
        (at < self.world.particles.len()).then(|| self.world.particles.x.at(at))
    }

    /// Velocity of a particle [m/s]; `None` if there is no such particle.
    pub fn velocity(&self, particle: u32) -> Option<Vec3> {
        let at = particle as usize;
        (at < self.world.particles.len()).then(|| self.world.particles.v.at(at))
    }

    /// Mass of a particle [kg]; `None` if there is no such particle.
    pub fn mass(&self, particle: u32) -> Option<f32> {
        self.world.particles.mass.get(particle as usize).copied()
    }

    /// Whether any of these addresses lies in a list that it lends, now or later: for faces whose callers
    /// hold plain pointers.
    pub fn lends(&self, addresses: &Range<usize>) -> bool {
        fn meets<T>(list: &Vec<T>, addresses: &Range<usize>) -> bool {
            let start = list.as_ptr().addr();
            start < addresses.end && addresses.start < start + size_of::<T>() * list.capacity()
        }
        let lent = &self.outputs;
        [&lent.positions, &lent.normals].into_iter().any(|list| meets(list, addresses))
            || [&lent.sources, &lent.indices].into_iter().any(|list| meets(list, addresses))
            || meets(&lent.uvs, addresses)
            || meets(&lent.frayed, addresses)
    }

    /// Changes when the triangles do.
    pub fn topology_revision(&self) -> u32 {
        self.topology_revision
    }

    /// Changes when positions do.
    pub fn state_revision(&self) -> u32 {
        self.state_revision
    }

    /// FloatBlock about the cloth as it is now.
    pub fn stats(&self) -> Stats {
        let world = &self.world;
        let ((max_stretch, mean_stretch), kinetic_energy) =
            with_float_env(|| (stats::stretch(world), stats::kinetic_energy(world)));
        Stats {
            particles: world.particles.len() as u32,
            triangles: world.mesh.triangles.len() as u32,
            constraints: world.constraints.links.len() as u32,
            active_constraints: world.constraints.active_links().count() as u32,
            pieces: world.pieces,
            ticks: world.tick,
            blend: self.blend(),
            max_stretch,
            mean_stretch,
            over_stretched: world.over_stretched,
            kinetic_energy,
            max_speed: with_float_env(|| stats::max_speed(world)),
            asleep: world.is_asleep(),
            bytes: self.bytes(),
            seconds: world.profile.seconds(),
        }
    }

    fn refresh_normals(&mut self) {
        if self.outputs.normals_current {
            return;
        }
        let start = self.world.profile.start();
        let (world, outputs) = (&self.world, &mut self.outputs);
        world.threads.run_in_pool(world.particles.len(), || {
            with_float_env(|| outputs.follow_normals(world))
        });
        self.world.profile.book(Stage::Outputs, start);
    }

    fn bytes(&self) -> u64 {
        let world = &self.world;
        // Texture coordinates, sources, frayed borders and particles are there twice.
        let told = size_of::<Vec2>() + 2 * size_of::<u32>() + 1;
        let vertex = size_of::<[Vec3; 2]>() + 2 * told;
        let particle = world.particles.bytes_each();
        let triangle = size_of::<[u32; 3]>() * 3 + size_of::<[f32; 3]>();
        let bytes = world.capacity() * particle
            + world.vertex_capacity() * vertex
            + world.triangle_capacity * triangle
            + world.constraints.bytes()
            + world.grid_cells.as_ref().map_or(0, GridCells::bytes)
            + world.plate_elements.as_ref().map_or(0, |plates| plates.bytes())
            + world.tethers.bytes()
            + self.outputs.drawn.bytes()
            + world.particle_collision.as_ref().map_or(0, |crowd| crowd.bytes())
            + world.warm_start.bytes()
            + world.surface_collision.as_ref().map_or(0, |layers| layers.bytes());
        bytes as u64
    }
}
