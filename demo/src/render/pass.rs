//! Shared state of the render passes: camera, lights, a unit quad, and conversions to three-d's
//! types.
//!
//! Method: one [`RenderPass`] per frame that all child modules of `render` read.
//!
//! Reads the camera view and the lights; writes nothing but shader uniforms.
//!
//! Invariant: this file imports no other pass, so that passes can share it without an import
//! circle.

use glam::{Mat4, Vec3};
use three_d::{
    Blend, BlendEquationType, BlendMultiplierType, Context, Program, RenderStates, VertexBuffer,
    Viewport,
};

use super::light::Lights;
use crate::camera::CameraView;

/// Blending by the alpha of what is drawn over what is opaque.
pub(super) const ALPHA_BLEND: Blend = Blend::Enabled {
    source_rgb_multiplier: BlendMultiplierType::SrcAlpha,
    source_alpha_multiplier: BlendMultiplierType::Zero,
    destination_rgb_multiplier: BlendMultiplierType::OneMinusSrcAlpha,
    destination_alpha_multiplier: BlendMultiplierType::One,
    rgb_equation: BlendEquationType::Add,
    alpha_equation: BlendEquationType::Add,
};

/// State that all draw calls of a frame share.
pub(super) struct RenderPass {
    pub(super) viewport: Viewport,
    pub(super) clip_from_world: Mat4,
    pub(super) view: CameraView,
    pub(super) lights: Lights,
}

impl RenderPass {
    pub(super) fn aspect(&self) -> f32 {
        self.viewport.width as f32 / self.viewport.height as f32
    }
}

/// Two triangles that cover the square from -1 to 1.
pub(super) struct UnitQuad(VertexBuffer<[f32; 2]>);

impl UnitQuad {
    pub(super) fn new(context: &Context) -> Self {
        let (l, h) = (-1.0, 1.0);
        Self(VertexBuffer::new_with_data(
            context,
            &[[l, l], [h, l], [h, h], [l, l], [h, h], [l, h]],
        ))
    }

    pub(super) fn draw(&self, program: &Program, states: RenderStates, viewport: Viewport) {
        program.use_vertex_attribute("corner", &self.0);
        program.draw_arrays(states, viewport, self.0.vertex_count());
    }
}

/// Converts a matrix of glam to three-d's type.
pub(super) fn to_gl_matrix(m: Mat4) -> three_d::Mat4 {
    m.to_cols_array_2d().into()
}

/// Converts a vector of glam to three-d's type.
pub(super) fn to_gl_vector(v: Vec3) -> three_d::Vec3 {
    v.to_array().into()
}
