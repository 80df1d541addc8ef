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
use super::solid::{Solid, Solids};
use super::{matrix, vector};

/// The map and the program that fills it.
pub struct Shadow {
    context: Context,
    program: Program,
    map: DepthTexture2D,
}

impl Shadow {
    /// An empty map of `size` texels a side.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context, size: u32) -> Result<Self, CoreError> {
        Ok(Self {
            context: context.clone(),
            program: Program::from_source(
                context,
                include_str!("shaders/depth.vert"),
                include_str!("shaders/depth.frag"),
            )?,
            map: DepthTexture2D::new::<f32>(
                context,
                size,
                size,
                Wrapping::ClampToEdge,
                Wrapping::ClampToEdge,
            ),
        })
    }

    /// Fills the map with the cloth and the solids as the key light sees it.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses.
    pub(super) fn draw(
        &self,
        mesh: &Mesh,
        clip: Mat4,
        shapes: &Solids,
        solids: &[Solid],
    ) -> Result<(), CoreError> {
        self.map.as_depth_target().clear(ClearState::depth(1.0)).write::<CoreError>(|| {
            self.program.use_uniform("shadowFromWorld", matrix(clip));
            self.program.use_vertex_attribute("position", &mesh.positions);
            let viewport = Viewport::new_at_origo(self.map.width(), self.map.height());
            self.program.draw_elements(
                RenderStates { write_mask: WriteMask::DEPTH, ..RenderStates::default() },
                viewport,
                &mesh.triangles,
            );
            shapes.draw_depth(clip, viewport, solids);
            Ok(())
        })?;
        Ok(())
    }

    /// Hands map and key light to a program that includes `light.glsl`.
    pub(super) fn use_in(&self, program: &Program, lights: &Lights) {
        self.use_with(program, &lights.key, lights.key.clip_from_world());
    }

    /// The same for any light, and the clip space that the map was drawn in.
    pub(super) fn use_with(&self, program: &Program, key: &Light, clip: Mat4) {
        program.use_uniform("shadowFromWorld", matrix(clip));
        program.use_uniform("keyTowards", vector(key.towards));
        program.use_uniform("keyColour", vector(key.colour));
        program.use_depth_texture("shadowMap", &self.map);
        compare(&self.context);
    }

    /// Hands the bare depths to a program.
    pub(super) fn use_depths(&self, program: &Program, name: &str) {
        program.use_depth_texture(name, &self.map);
    }
}

/// Has the depth texture that was just bound compare and blend what a shadow sampler asks of it.
pub(super) fn compare(context: &Context) {
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
