//! Read access: addresses of vertex lists, revisions, events, statistics.
//!
//! `package/cloth.js` makes typed-array views at these addresses. An address is valid until the
//! next call that changes the cloth or grows the module's memory.

use crate::RawCloth;
use crate::packing::Writer;
use muslin::Stage;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
impl RawCloth {
    /// Returns the number of vertices.
    pub fn vertex_count(&self) -> u32 {
        self.cloth.positions().len() as u32
    }

    /// Returns the largest number of vertices that the cloth can ever have.
    pub fn vertex_capacity(&mut self) -> u32 {
        self.cloth.view().vertex_capacity
    }

    /// Returns the number of indices.
    pub fn index_count(&self) -> u32 {
        self.cloth.indices().len() as u32
    }

    /// Returns the largest number of indices that the cloth can ever have.
    pub fn index_capacity(&mut self) -> u32 {
        self.cloth.view().index_capacity
    }

    /// Returns the address of the positions: 3 f32 per vertex.
    pub fn positions_ptr(&self) -> *const f32 {
        self.cloth.positions().as_ptr().cast()
    }

    /// Returns the address of the positions relative to the origin: 3 f32 per vertex.
    pub fn relative_positions_ptr(&mut self) -> *const f32 {
        self.cloth.relative_positions().as_ptr().cast()
    }

    /// Returns the origin [m].
    pub fn origin(&self) -> Vec<f64> {
        let mut list = Writer::default();
        list.vector(self.cloth.origin());
        list.0
    }

    /// Returns the address of the normals: 3 f32 per vertex. Computes them if positions changed.
    pub fn normals_ptr(&mut self) -> *const f32 {
        self.cloth.normals().as_ptr().cast()
    }

    /// Returns the address of the texture coordinates: 2 f32 per vertex.
    pub fn uvs_ptr(&self) -> *const f32 {
        self.cloth.uvs().as_ptr().cast()
    }

    /// Returns the address of the indices: 3 u32 per triangle.
    pub fn indices_ptr(&self) -> *const u32 {
        self.cloth.indices().as_ptr()
    }

    /// Returns the address of the source vertices: 1 u32 per vertex.
    pub fn source_vertices_ptr(&self) -> *const u32 {
        self.cloth.source_vertices().as_ptr()
    }

    /// Returns the address of the frayed flags: 1 byte per vertex, 0 or 1.
    pub fn frayed_ptr(&self) -> *const u8 {
        self.cloth.frayed().as_ptr().cast()
    }

    /// Returns the address of the particles of the vertices: 1 u32 per vertex.
    pub fn vertex_particles_ptr(&self) -> *const u32 {
        self.cloth.vertex_particles().as_ptr()
    }

    /// Returns the mesh report, in the order of `REPORT` in `package/reports.js`.
    pub fn mesh_report(&self) -> Vec<f64> {
        let (report, mut list) = (self.cloth.mesh_report(), Writer::default());
        list.counts(&[
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
            report.thin_triangles,
            report.thinnest_triangle,
            report.collapsed_edges,
            report.collapsed_triangles,
            report.trimmed_triangles,
            report.flipped_edges,
            report.short_edges,
            u32::from(report.is_grid),
        ]);
        list.numbers(&[report.shortest_edge, report.mean_edge, report.worst_aspect]);
        list.0
    }

    /// Returns the ranges that changed since a topology revision: first vertex, vertex count, first
    /// index, index count.
    pub fn changes(&self, since_topology_revision: u32) -> Vec<u32> {
        let changes = self.cloth.changes(since_topology_revision);
        vec![changes.first_vertex, changes.vertex_count, changes.first_index, changes.index_count]
    }

    /// Returns the topology revision, which changes when the triangles change.
    pub fn topology_revision(&self) -> u32 {
        self.cloth.topology_revision()
    }

    /// Returns the state revision, which changes when positions change.
    pub fn state_revision(&self) -> u32 {
        self.cloth.state_revision()
    }

    /// Removes all pending events and returns them: kind, tick, position, particle a, particle b,
    /// vertex, source and count of each.
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

    /// Returns the statistics in the order of `STATS` in `package/reports.js`, then the seconds of
    /// each stage.
    pub fn stats(&self) -> Vec<f64> {
        let stats = self.cloth.stats();
        let mut list = Writer::default();
        list.counts(&[stats.particles, stats.triangles, stats.constraints]);
        list.counts(&[stats.active_constraints, stats.pieces, stats.ticks]);
        list.numbers(&[stats.blend, stats.max_stretch, stats.mean_stretch, stats.kinetic_energy]);
        list.counts(&[stats.over_stretched, u32::from(stats.asleep)]);
        list.numbers(&[stats.max_speed]);
        list.counts(&[stats.substeps, stats.held_inside, stats.free_inside, stats.crossings]);
        list.0.push(stats.bytes as f64);
        list.numbers(&stats.seconds);
        list.0
    }
}

/// Returns the names of the stages of a tick in order, separated by spaces.
#[wasm_bindgen]
pub fn stage_names() -> String {
    Stage::ALL.map(Stage::name).join(" ")
}
