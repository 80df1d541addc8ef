//! The cloth's vertices on the graphics card, kept up with the cloth.

use glam::{Vec2, Vec3};
use three_d::{Context, ElementBuffer, VertexBuffer};

/// A cloth as the renderer sees it: borrowed columns, one entry a vertex.
#[derive(Clone, Copy, Debug)]
pub struct ClothSurface<'a> {
    /// Where the vertices are [m].
    pub positions: &'a [Vec3],
    /// Length of what is drawn as a metre [m].
    pub unit: f32,
    /// Unit normals of the front face.
    pub normals: &'a [Vec3],
    /// Where in the weave, 0 to 1 along each side.
    pub uvs: &'a [Vec2],
    /// Whether a vertex is at a border that came about by tearing or cutting.
    pub frayed: &'a [bool],
    /// Three a triangle.
    pub indices: &'a [u32],
    /// Two a line of the wireframe.
    pub lines: &'a [u32],
    /// What the weave's coordinates span, as it is drawn [m].
    pub span: Vec2,
    /// Whether it is a disc: its hem runs around the middle of the weave's coordinates.
    pub is_round: bool,
    /// Another number says that uvs, frayed borders, indices or lines are others.
    pub revision: u64,
}

/// The buffers of one [`ClothSurface`].
pub struct Mesh {
    pub(super) positions: VertexBuffer<[f32; 3]>,
    pub(super) normals: VertexBuffer<[f32; 3]>,
    pub(super) uvs: VertexBuffer<[f32; 2]>,
    pub(super) frayed: VertexBuffer<f32>,
    pub(super) triangles: ElementBuffer<u32>,
    pub(super) lines: ElementBuffer<u32>,
    pub(super) span: Vec2,
    pub(super) is_round: bool,
    revision: Option<u64>,
    staging: Vec<[f32; 3]>,
}

impl Mesh {
    /// Empty buffers.
    pub fn new(context: &Context) -> Self {
        Self {
            positions: VertexBuffer::new(context),
            normals: VertexBuffer::new(context),
            uvs: VertexBuffer::new(context),
            frayed: VertexBuffer::new(context),
            triangles: ElementBuffer::new(context),
            lines: ElementBuffer::new(context),
            span: Vec2::ONE,
            is_round: false,
            revision: None,
            staging: Vec::new(),
        }
    }

    /// Uploads what may have changed: positions and normals always, the rest with the revision.
    pub fn update(&mut self, surface: &ClothSurface<'_>) {
        let staging = &mut self.staging;
        let mut upload = |buffer: &mut VertexBuffer<[f32; 3]>, values: &[Vec3], scale: f32| {
            staging.clear();
            staging.extend(values.iter().map(|v| (*v * scale).to_array()));
            buffer.fill(staging);
        };
        upload(&mut self.positions, surface.positions, surface.unit.recip());
        upload(&mut self.normals, surface.normals, 1.0);
        self.span = surface.span;
        self.is_round = surface.is_round;
        if self.revision != Some(surface.revision) {
            let uvs: Vec<_> = surface.uvs.iter().map(|uv| uv.to_array()).collect();
            self.uvs.fill(&uvs);
            let frayed: Vec<_> = surface.frayed.iter().map(|f| f32::from(u8::from(*f))).collect();
            self.frayed.fill(&frayed);
            self.triangles.fill(surface.indices);
            self.lines.fill(surface.lines);
            self.revision = Some(surface.revision);
        }
    }
}
