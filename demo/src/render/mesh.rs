//! Vertex and index buffers of one cloth.
//!
//! Method: positions and normals are uploaded every frame; texture coordinates and indices only
//! when the topology revision changes.
//!
//! Reads a [`ClothSurface`]; writes GPU buffers.
//!
//! Invariant: all vertex buffers have the same number of entries.

use glam::{Vec2, Vec3};
use three_d::{Context, ElementBuffer, VertexBuffer};

/// The data of a cloth that the renderer needs: borrowed arrays with one entry per vertex.
#[derive(Clone, Copy, Debug)]
pub struct ClothSurface<'a> {
    /// Positions [m].
    pub positions: &'a [Vec3],
    /// Length in the simulation of one drawn metre [m].
    pub unit: f32,
    /// Unit normals of the front.
    pub normals: &'a [Vec3],
    /// Texture coordinates, 0 to 1 along each side.
    pub uvs: &'a [Vec2],
    /// Whether a vertex lies on a torn or cut edge.
    pub frayed: &'a [bool],
    /// How far each vertex lies behind its surroundings, as seen from the front [m]; none means
    /// zeros.
    pub hollows: &'a [f32],
    /// Three vertex indices per triangle.
    pub indices: &'a [u32],
    /// The same for fewer and larger triangles; empty if there are none.
    pub coarse_indices: &'a [u32],
    /// Two vertex indices per line of the wireframe.
    pub lines: &'a [u32],
    /// Size of the texture space, in drawn metres.
    pub span: Vec2,
    /// Whether the cloth is a disc, with a circular hem around the centre of the texture space.
    pub is_round: bool,
    /// Revision of texture coordinates, frayed edges, indices and lines; a new value uploads them
    /// again.
    pub revision: u64,
}

/// Which triangles of a cloth a pass draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Detail {
    /// Those of the smooth surface.
    Full,
    /// Those of the cloth itself, where the difference does not show.
    Coarse,
}

/// GPU buffers of one [`ClothSurface`].
pub struct Mesh {
    pub(super) positions: VertexBuffer<[f32; 3]>,
    pub(super) normals: VertexBuffer<[f32; 3]>,
    pub(super) uvs: VertexBuffer<[f32; 2]>,
    pub(super) frayed: VertexBuffer<f32>,
    pub(super) hollows: VertexBuffer<f32>,
    triangles: ElementBuffer<u32>,
    coarse_triangles: ElementBuffer<u32>,
    pub(super) lines: ElementBuffer<u32>,
    pub(super) span: Vec2,
    pub(super) is_round: bool,
    revision: Option<u64>,
    staging: Vec<[f32; 3]>,
    depths: Vec<f32>,
}

impl Mesh {
    /// Creates empty buffers.
    pub fn new(context: &Context) -> Self {
        Self {
            positions: VertexBuffer::new(context),
            normals: VertexBuffer::new(context),
            uvs: VertexBuffer::new(context),
            frayed: VertexBuffer::new(context),
            hollows: VertexBuffer::new(context),
            triangles: ElementBuffer::new(context),
            coarse_triangles: ElementBuffer::new(context),
            lines: ElementBuffer::new(context),
            span: Vec2::ONE,
            is_round: false,
            revision: None,
            staging: Vec::new(),
            depths: Vec::new(),
        }
    }

    /// Returns the triangles of a detail.
    pub(super) fn triangles(&self, detail: Detail) -> &ElementBuffer<u32> {
        match detail {
            Detail::Coarse if self.coarse_triangles.count() > 0 => &self.coarse_triangles,
            _ => &self.triangles,
        }
    }

    /// Uploads positions and normals, and the other buffers if the revision has changed.
    pub fn update(&mut self, surface: &ClothSurface<'_>) {
        let staging = &mut self.staging;
        let mut upload = |buffer: &mut VertexBuffer<[f32; 3]>, values: &[Vec3], scale: f32| {
            staging.clear();
            staging.extend(values.iter().map(|v| (*v * scale).to_array()));
            buffer.fill(staging);
        };
        upload(&mut self.positions, surface.positions, surface.unit.recip());
        upload(&mut self.normals, surface.normals, 1.0);
        let depths = surface.hollows.iter().map(|depth| depth / surface.unit);
        self.depths.clear();
        self.depths.extend(depths);
        self.depths.resize(surface.positions.len(), 0.0);
        self.hollows.fill(&self.depths);
        self.span = surface.span;
        self.is_round = surface.is_round;
        if self.revision != Some(surface.revision) {
            let uvs: Vec<_> = surface.uvs.iter().map(|uv| uv.to_array()).collect();
            self.uvs.fill(&uvs);
            let frayed: Vec<_> = surface.frayed.iter().map(|f| f32::from(u8::from(*f))).collect();
            self.frayed.fill(&frayed);
            self.triangles.fill(surface.indices);
            self.coarse_triangles.fill(surface.coarse_indices);
            self.lines.fill(surface.lines);
            self.revision = Some(surface.revision);
        }
    }
}
