//! The shadow of the key light: a depth map of the stage, compared and filtered by the card.
//!
//! The map never moves, so that still shadows stay still.

use glam::Mat4;
use three_d::context::{self, HasContext};
use three_d::{
    ClearState, Context, CoreError, DepthTexture2D, Program, RenderStates, Viewport, Wrapping,
    WriteMask,
};

use super::light::{Light, Lights};
use super::mesh::Mesh;
use super::pass::{to_gl_matrix, to_gl_vector};

/// The map, and what fills it.
pub struct ShadowMap {
    context: Context,
    depths: DepthProgram,
    map: DepthTexture2D,
}

impl ShadowMap {
    /// An empty map of `size` texels a side.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context, size: u32) -> Result<Self, CoreError> {
        Ok(Self {
            context: context.clone(),
            depths: DepthProgram::new(context)?,
            map: depth_map(context, size),
        })
    }

    /// Fills the map with the cloth and the solids as the key light sees it.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses.
    pub(super) fn draw<'a>(
        &self,
        meshes: impl Iterator<Item = &'a Mesh>,
        clip: Mat4,
        draw_others: impl Fn(Viewport),
    ) -> Result<(), CoreError> {
        self.map.as_depth_target().clear(ClearState::depth(1.0)).write::<CoreError>(|| {
            let viewport = Viewport::new_at_origo(self.map.width(), self.map.height());
            for mesh in meshes {
                self.depths.draw(mesh, clip, viewport);
            }
            draw_others(viewport);
            Ok(())
        })?;
        Ok(())
    }

    /// Hands map and key light to a program that includes `light.glsl`.
    pub(super) fn bind(&self, program: &Program, lights: &Lights) {
        self.bind_with_clip(program, &lights.key, lights.key.clip_from_world());
    }

    /// The same for any light, and the clip space that the map was drawn in.
    pub(super) fn bind_with_clip(&self, program: &Program, key: &Light, clip: Mat4) {
        program.use_uniform("shadowFromWorld", to_gl_matrix(clip));
        program.use_uniform("keyTowards", to_gl_vector(key.towards));
        program.use_uniform("keyColour", to_gl_vector(key.colour));
        program.use_depth_texture("shadowMap", &self.map);
        enable_depth_compare(&self.context);
    }

    /// Hands the bare depths to a program.
    pub(super) fn bind_depths(&self, program: &Program, name: &str) {
        program.use_depth_texture(name, &self.map);
    }
}

/// The program that draws how far cloth is from a light.
pub(super) struct DepthProgram(Program);

impl DepthProgram {
    /// Compiles it.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let [vertex, fragment] =
            [include_str!("shaders/depth.vert"), include_str!("shaders/depth.frag")];
        Program::from_source(context, vertex, fragment).map(Self)
    }

    /// Draws a cloth into the part of a depth map that `viewport` is.
    pub fn draw(&self, mesh: &Mesh, clip: Mat4, viewport: Viewport) {
        self.0.use_uniform("shadowFromWorld", to_gl_matrix(clip));
        self.0.use_vertex_attribute("position", &mesh.positions);
        let states = RenderStates { write_mask: WriteMask::DEPTH, ..RenderStates::default() };
        self.0.draw_elements(states, viewport, &mesh.triangles);
    }
}

/// An empty depth map of `size` texels a side.
pub(super) fn depth_map(context: &Context, size: u32) -> DepthTexture2D {
    let edge = Wrapping::ClampToEdge;
    DepthTexture2D::new::<f32>(context, size, size, edge, edge)
}

/// Has the depth texture that was just bound enable_depth_compare and blend what a shadow sampler asks of it.
pub(super) fn enable_depth_compare(context: &Context) {
    // three-d binds the map for plain reads; a shadow sampler compares and blends instead.
    let parameters = [
        (context::TEXTURE_COMPARE_MODE, context::COMPARE_REF_TO_TEXTURE),
        (context::TEXTURE_COMPARE_FUNC, context::LEQUAL),
        (context::TEXTURE_MIN_FILTER, context::LINEAR),
        (context::TEXTURE_MAG_FILTER, context::LINEAR),
    ];
    for (name, value) in parameters {
        // SAFETY: plain GL state of the texture that `use_depth_texture` has just bound; the
        // context is current wherever a frame is drawn.
        unsafe {
            context.tex_parameter_i32(context::TEXTURE_2D, name, value as i32);
        }
    }
}
