//! What a page reads: addresses of lists that it makes views of, and numbers.

use crate::RawCloth;
use crate::numbers::{Reader, Writer};
use crate::refusal::{Result, refusal};
use muslin::{Error, Stage};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// How many vertices there are.
    pub fn vertex_count(&self) -> u32 {
        self.cloth.positions().len() as u32
    }

    /// How many vertices there may ever be.
    pub fn vertex_capacity(&mut self) -> u32 {
        self.cloth.view().vertex_capacity
    }

    /// How many indices there are.
    pub fn index_count(&self) -> u32 {
        self.cloth.indices().len() as u32
    }

    /// How many indices there may ever be.
    pub fn index_capacity(&mut self) -> u32 {
        self.cloth.view().index_capacity
    }

    /// Where the positions are: 3 f32 a vertex.
    pub fn positions_ptr(&self) -> *const f32 {
        self.cloth.positions().as_ptr().cast()
    }

    /// Where the normals are: 3 f32 a vertex. Computes them when it must.
    pub fn normals_ptr(&mut self) -> *const f32 {
        self.cloth.normals().as_ptr().cast()
    }

    /// Where the texture coordinates are: 2 f32 a vertex.
    pub fn uvs_ptr(&self) -> *const f32 {
        self.cloth.uvs().as_ptr().cast()
    }

    /// Where the indices are: u32.
    pub fn indices_ptr(&self) -> *const u32 {
        self.cloth.indices().as_ptr()
    }

    /// Where the source vertices are: u32.
    pub fn source_vertices_ptr(&self) -> *const u32 {
        self.cloth.source_vertices().as_ptr()
    }

    /// Where it says whether vertices are frayed: 1 byte a vertex.
    pub fn frayed_ptr(&self) -> *const u8 {
        self.cloth.frayed().as_ptr().cast()
    }

    /// Where the particles of the vertices are: u32.
    pub fn vertex_particles_ptr(&self) -> *const u32 {
        self.cloth.vertex_particles().as_ptr()
    }

    /// What had to be repaired of the mesh, in the order of the package's REPORT.
    pub fn mesh_report(&self) -> Vec<u32> {
        let report = self.cloth.mesh_report();
        vec![
            report.vertices,
            report.triangles,
            report.particles,
            report.kept_triangles,
            report.welded_vertices,
            report.dropped_degenerate,
            report.dropped_duplicates,
            report.turned_triangles,
            report.split_edges,
            report.split_vertices,
            report.unused_vertices,
            report.pieces,
            report.one_sided_pieces,
            u32::from(report.is_grid),
        ]
    }

    /// What changed with the triangles since a revision: first vertex, how many, first index, how many.
    pub fn changes(&self, since_topology_revision: u32) -> Vec<u32> {
        let changes = self.cloth.changes(since_topology_revision);
        vec![changes.first_vertex, changes.vertex_count, changes.first_index, changes.index_count]
    }

    /// Changes when the triangles do.
    pub fn topology_revision(&self) -> u32 {
        self.cloth.topology_revision()
    }

    /// Changes when positions do.
    pub fn state_revision(&self) -> u32 {
        self.cloth.state_revision()
    }

    /// The share of a tick that `advance` still owes.
    pub fn blend(&self) -> f32 {
        self.cloth.blend()
    }

    /// Time since it was made or reset [s].
    pub fn time(&self) -> f64 {
        self.cloth.time()
    }

    /// Where a particle is.
    pub fn position(&self, particle: u32) -> Result<Vec<f64>> {
        let position = self.cloth.position(particle);
        let mut list = Writer::default();
        list.vector(position.ok_or_else(|| refusal(self.no_such(particle)))?);
        Ok(list.0)
    }

    /// Velocity of a particle.
    pub fn velocity(&self, particle: u32) -> Result<Vec<f64>> {
        let velocity = self.cloth.velocity(particle);
        let mut list = Writer::default();
        list.vector(velocity.ok_or_else(|| refusal(self.no_such(particle)))?);
        Ok(list.0)
    }

    /// Mass of a particle.
    pub fn mass(&self, particle: u32) -> Result<f32> {
        self.cloth.mass(particle).ok_or_else(|| refusal(self.no_such(particle)))
    }

    /// What a ray hits first, or nothing; `ray` is its origin and direction. Gives triangle, particle,
    /// u, v, distance, position and normal.
    pub fn raycast(&self, ray: &[f64], max_distance: f32) -> Result<Vec<f64>> {
        let mut ray = Reader::new(ray);
        let hit = self.cloth.raycast(ray.vector(), ray.vector(), max_distance).map_err(refusal)?;
        let mut list = Writer::default();
        if let Some(hit) = hit {
            list.counts(&[hit.triangle, hit.particle]);
            list.numbers(&[hit.u, hit.v, hit.distance]);
            list.vector(hit.position);
            list.vector(hit.normal);
        }
        Ok(list.0)
    }

    /// All events that were not read yet: kind, tick, position, particle a, particle b, vertex, source
    /// and count of each.
    pub fn events(&mut self) -> Vec<f64> {
        let mut list = Writer::default();
        while let Some(event) = self.cloth.next_event() {
            list.counts(&[event.kind as u32, event.tick]);
            list.vector(event.position);
            list.counts(&[event.particle_a, event.particle_b]);
            list.counts(&[event.vertex, event.source, event.count]);
        }
        list.0
    }

    /// Numbers about the cloth, then the seconds of each stage.
    pub fn stats(&self) -> Vec<f64> {
        let stats = self.cloth.stats();
        let mut list = Writer::default();
        list.counts(&[stats.particles, stats.triangles, stats.constraints]);
        list.counts(&[stats.active_constraints, stats.pieces, stats.ticks]);
        list.numbers(&[stats.blend, stats.max_stretch, stats.mean_stretch, stats.kinetic_energy]);
        list.counts(&[stats.over_stretched, u32::from(stats.asleep)]);
        list.numbers(&[stats.max_speed]);
        list.0.push(stats.bytes as f64);
        list.numbers(&stats.seconds);
        list.0
    }

    fn no_such(&self, particle: u32) -> Error {
        Error::BadIndex { field: "particle", index: particle, count: self.cloth.particle_count() }
    }
}

/// The stages of a tick in order, with spaces between.
#[wasm_bindgen]
pub fn stage_names() -> String {
    Stage::ALL.map(Stage::name).join(" ")
}
