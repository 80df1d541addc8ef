//! Public calls for reading: output lists, per-particle values and statistics.
//!
//! Reads `Outputs` and `World`; writes only cached normals.
//! Invariant: a returned slice keeps its address while the cloth lives (see `outputs`).

use crate::cloth::Cloth;
use crate::math::float_env::with_float_env;
use crate::math::heap_bytes::HeapBytes;
use crate::mesh::report::MeshReport;
use crate::solver::output::stats;
use crate::solver::stage::Stage;
use core::ops::Range;
use glam::{Vec2, Vec3};

/// All lists that a renderer needs, borrowed from the cloth. Every list but `indices` has one entry
/// per vertex.
///
/// Vertices are drawn; particles are simulated. Vertex `i` is particle `i`, unless the cloth was
/// made from a mesh whose vertices were welded or split, see [`Cloth::vertex_particles`]. Triangles
/// are the same, in the same order, for both.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Positions [m].
    pub positions: &'a [Vec3],
    /// Unit normals, weighted by triangle area; zero for a vertex that no triangle uses. Vertices
    /// of the same particle share its normal.
    pub normals: &'a [Vec3],
    /// Texture coordinates.
    pub uvs: &'a [Vec2],
    /// Three vertices per triangle, counter-clockwise seen from the front.
    pub indices: &'a [u32],
    /// The vertex of the descriptor that each vertex came from; for a vertex that a cut added on an
    /// edge, that of the nearer end.
    pub source_vertices: &'a [u32],
    /// Whether each vertex is on a border that a tear or cut made. Borders of the original cloth
    /// (hems) do not count.
    pub frayed: &'a [bool],
    /// Largest number of vertices that the cloth may ever have.
    pub vertex_capacity: u32,
    /// Largest number of indices that the cloth may ever have.
    pub index_capacity: u32,
    /// Changes whenever the indices change.
    pub topology_revision: u32,
    /// Changes whenever positions change.
    pub state_revision: u32,
    /// The particle of each vertex.
    pub particles: &'a [u32],
}

/// Statistics of a cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stats {
    /// Number of particles.
    pub particles: u32,
    /// Number of triangles.
    pub triangles: u32,
    /// Number of links in the rest state.
    pub constraints: u32,
    /// Number of links that are intact now.
    pub active_constraints: u32,
    /// Number of pieces: sets of triangles connected by edges.
    pub pieces: u32,
    /// Ticks since the cloth was made or reset.
    pub ticks: u32,
    /// Blend factor for drawing, see [`Cloth::blend`].
    pub blend: f32,
    /// Largest strain of a stretch link: 0.01 is 1 % above its rest length.
    pub max_stretch: f32,
    /// Mean strain of the stretch links.
    pub mean_stretch: f32,
    /// Number of links past [`Settings::max_stretch`](crate::Settings), which pins, grabs or
    /// anchors hold apart, 0 without that limit; plus the sewn pairs whose particles are both held
    /// apart.
    pub over_stretched: u32,
    /// Number of particles that pins, attachments or grabs hold more than 0.1 mm inside a collider.
    /// Nothing is inside a triangle mesh, which has two sides.
    pub held_inside: u32,
    /// Number of other particles more than 0.1 mm inside a collider.
    pub free_inside: u32,
    /// Number of crossings: pairs of an edge of the cloth and a triangle that it passes through, as
    /// found in the last tick; 0 without surface collision. A cloth without known crossings is
    /// tested in parts, all of it in 16 ticks.
    pub crossings: u32,
    /// Kinetic energy [J].
    pub kinetic_energy: f32,
    /// Speed of the fastest particle [m/s].
    pub max_speed: f32,
    /// Number of substeps of the last tick: [`Settings::substeps`](crate::Settings), or more where
    /// cloth and colliders moved fast relative to each other. A cloth that sleeps runs none and
    /// keeps the number.
    pub substeps: u32,
    /// Whether the cloth sleeps, see [`Settings::sleep_speed`](crate::Settings).
    pub asleep: bool,
    /// Memory of the cloth [bytes]: what it has allocated, and itself. What clones share counts in equal
    /// parts for each. Not counted are the shapes of colliders, and the scratch buffers of ticks, which
    /// each thread has once, for the largest cloth that it has made or stepped.
    pub bytes: u64,
    /// Time of each stage ([`Stage::ALL`](crate::Stage)) in the last call that ran ticks [s]; zeros
    /// without a clock ([`Cloth::set_clock`]).
    pub seconds: [f32; Stage::COUNT],
}

impl Cloth {
    /// Returns all lists that a renderer needs, without a copy. Computes the normals if positions
    /// changed since they were last read.
    pub fn view(&mut self) -> View<'_> {
        self.refresh_normals();
        View {
            positions: &self.outputs.positions,
            normals: &self.outputs.normals,
            uvs: &self.outputs.attributes.uvs,
            indices: &self.outputs.attributes.indices,
            source_vertices: &self.outputs.attributes.sources,
            frayed: &self.outputs.attributes.frayed,
            vertex_capacity: self.world.vertex_capacity() as u32,
            index_capacity: 3 * self.world.triangle_capacity as u32,
            topology_revision: self.topology_revision,
            state_revision: self.state_revision,
            particles: &self.outputs.attributes.particles,
        }
    }

    /// Returns the particle of each vertex.
    ///
    /// A mesh that was welded, or whose sheets were separated, has several vertices per particle;
    /// otherwise vertex `i` is particle `i`. Positions, normals, uvs, source vertices, frayed
    /// borders and indices belong to vertices. Calls that act on the cloth (pins, grabs, tears,
    /// positions and velocities) take particles, and a ray hit returns one. In an event,
    /// `particle_a` and `particle_b` are particles, `vertex` and `source` are vertices. Triangles
    /// have the same numbers in both.
    pub fn vertex_particles(&self) -> &[u32] {
        &self.outputs.attributes.particles
    }

    /// Returns what was repaired in the mesh that the cloth was made from. A grid needs no repair.
    pub fn mesh_report(&self) -> &MeshReport {
        &self.report
    }

    /// Returns the positions of the vertices [m].
    pub fn positions(&self) -> &[Vec3] {
        &self.outputs.positions
    }

    /// Returns the origin of the cloth [m]: the point that it is simulated relative to, in whole
    /// metres.
    ///
    /// It is zero while most of the cloth stays within 16 m of zero along each axis. Beyond, it
    /// follows the cloth, so that positions far from zero are as exact as near it. Every other
    /// position that the cloth takes or returns is absolute, except for
    /// [`Cloth::relative_positions`] and [`WriteDesc::relative`](crate::WriteDesc). Only ticks and
    /// calls that place particles move the origin.
    pub fn origin(&self) -> Vec3 {
        self.world.origin
    }

    /// Returns the positions of the vertices relative to [`Cloth::origin`] [m]. They are exact
    /// where [`Cloth::positions`], an f32 far from zero, are rounded: by up to 0.25 mm at 5 km.
    ///
    /// A renderer adds `origin − camera`, in f64 or relative to an origin of its own. The first
    /// call allocates the list; later ones copy to it if positions changed.
    pub fn relative_positions(&mut self) -> &[Vec3] {
        self.outputs.relative_positions(&self.world)
    }

    /// Returns the unit normals of the vertices. Computes them if positions changed since they were
    /// last read.
    pub fn normals(&mut self) -> &[Vec3] {
        self.refresh_normals();
        &self.outputs.normals
    }

    /// Returns the texture coordinates of the vertices; zeros if the mesh had none.
    pub fn uvs(&self) -> &[Vec2] {
        &self.outputs.attributes.uvs
    }

    /// Returns three vertices per triangle.
    pub fn indices(&self) -> &[u32] {
        &self.outputs.attributes.indices
    }

    /// Returns the vertex of the descriptor that each vertex came from; for a vertex that a cut
    /// added on an edge, that of the nearer end.
    pub fn source_vertices(&self) -> &[u32] {
        &self.outputs.attributes.sources
    }

    /// Returns whether each vertex is on a border that a tear or cut made, e.g. to draw fringes
    /// there. Borders of the original cloth (hems) do not count.
    pub fn frayed(&self) -> &[bool] {
        &self.outputs.attributes.frayed
    }

    /// Returns whether any of these addresses lies in an output list, up to its capacity. For
    /// bindings whose callers pass plain pointers.
    pub fn lends(&self, addresses: &Range<usize>) -> bool {
        fn meets<T>(list: &Vec<T>, addresses: &Range<usize>) -> bool {
            let start = list.as_ptr().addr();
            start < addresses.end && addresses.start < start + size_of::<T>() * list.capacity()
        }
        let outputs = &self.outputs;
        outputs.vector_lists().into_iter().any(|list| meets(list, addresses))
            || [&outputs.attributes.sources, &outputs.attributes.indices]
                .into_iter()
                .any(|list| meets(list, addresses))
            || meets(&outputs.attributes.uvs, addresses)
            || meets(&outputs.attributes.frayed, addresses)
    }

    /// Returns a number that changes whenever the triangles change. Never 0 in practice; it starts
    /// at 1.
    pub fn topology_revision(&self) -> u32 {
        self.topology_revision
    }

    /// Returns a number that changes whenever positions change.
    pub fn state_revision(&self) -> u32 {
        self.state_revision
    }

    /// Returns statistics of the current state. Computed on each call, in time proportional to the
    /// size of the cloth.
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
            ticks: world.clock.tick,
            blend: self.blend(),
            max_stretch,
            mean_stretch,
            over_stretched: world.violations.over_stretched.count
                + world.violations.open_pairs.count,
            held_inside: world.violations.held_inside.count,
            free_inside: world.violations.free_inside.count,
            crossings: world.violations.crossings.count,
            kinetic_energy,
            max_speed: with_float_env(|| stats::max_speed(world)),
            substeps: world.substeps,
            asleep: world.is_asleep(),
            bytes: self.bytes(),
            seconds: world.profile.seconds(),
        }
    }

    /// Computes the normals of the current positions, if they are out of date, and measures the
    /// time.
    fn refresh_normals(&mut self) {
        if self.outputs.are_normals_current {
            return;
        }
        let start = self.world.profile.start();
        let (world, outputs) = (&self.world, &mut self.outputs);
        world.threads.run_in_pool(world.particles.len(), || {
            with_float_env(|| outputs.refresh_normals(world));
        });
        self.world.profile.add(Stage::Outputs, start);
    }

    /// Returns the memory of the cloth [bytes].
    fn bytes(&self) -> u64 {
        let bytes = size_of::<Self>()
            + self.desc.heap_bytes()
            + self.world.heap_bytes()
            + self.world.collider_bytes()
            + self.outputs.heap_bytes()
            + self.history.heap_bytes()
            + self.ray_tree.bytes();
        bytes as u64
    }
}
