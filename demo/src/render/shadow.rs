//! Shadow map of a light: a depth texture with hardware comparison and filtering.
//!
//! Method: depth-only pass from the light, then percentage-closer filtering in `light.glsl`
//! (Reeves, Salesin, Cook, SIGGRAPH 1987).
//!
//! Reads meshes and a light matrix; writes a depth texture.
//!
//! Invariant: for the cloth scenes the light matrix is constant, so that shadows at rest do not
//! flicker.

use std::rc::Rc;

use glam::Mat4;
use three_d::context::{self, HasContext};
use three_d::{
    ClearState, Context, CoreError, DepthTexture2D, Program, RenderStates, Viewport, Wrapping,
    WriteMask,
};

use super::glsl::glsl;
use super::light::{Light, Lights};
use super::mesh::{Detail, Mesh};
use super::pass::{to_gl_matrix, to_gl_vector};

/// Depth texture of one light, and the program that fills it and others.
pub struct ShadowMap {
    context: Context,
    depths: Rc<DepthProgram>,
    map: DepthTexture2D,
}

impl ShadowMap {
    /// Creates an empty map of `size` × `size` texels, which `depths` fills.
    pub(super) fn new(context: &Context, depths: &Rc<DepthProgram>, size: u32) -> Self {
        Self { context: context.clone(), depths: depths.clone(), map: depth_map(context, size) }
    }

    /// Draws the depth of `meshes`, and of other objects through `draw_others`, as the light sees
    /// them.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses.
    pub(super) fn draw<'a>(
        &self,
        meshes: impl Iterator<Item = &'a Mesh>,
        clip: Mat4,
        detail: Detail,
        draw_others: impl Fn(Viewport),
    ) -> Result<(), CoreError> {
        self.map.as_depth_target().clear(ClearState::depth(1.0)).write::<CoreError>(|| {
            let viewport = Viewport::new_at_origo(self.map.width(), self.map.height());
            for mesh in meshes {
                self.depths.draw(mesh, clip, detail, viewport);
            }
            draw_others(viewport);
            Ok(())
        })?;
        Ok(())
    }

    /// Binds the map and the key light to a program that includes `light.glsl`.
    pub(super) fn bind(&self, program: &Program, lights: &Lights) {
        self.bind_with_clip(program, &lights.key, lights.key.clip_from_world());
    }

    /// Binds the map with any light, and with the light matrix that the map was drawn with.
    pub(super) fn bind_with_clip(&self, program: &Program, key: &Light, clip: Mat4) {
        program.use_uniform("shadowFromWorld", to_gl_matrix(clip));
        program.use_uniform("keyTowards", to_gl_vector(key.towards));
        program.use_uniform("keyColour", to_gl_vector(key.colour));
        program.use_depth_texture("shadowMap", &self.map);
        enable_depth_compare(&self.context);
    }

    /// Binds the map alone, with comparison, to a sampler.
    pub(super) fn bind_compared(&self, program: &Program, name: &str) {
        program.use_depth_texture(name, &self.map);
        enable_depth_compare(&self.context);
    }

    /// Binds the map as a plain depth texture.
    pub(super) fn bind_depths(&self, program: &Program, name: &str) {
        program.use_depth_texture(name, &self.map);
    }
}

/// Depth-only program for cloth.
pub(super) struct DepthProgram(Program);

impl DepthProgram {
    /// Compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Rc<Self>, CoreError> {
        let [vertex, fragment] = [glsl!("depth.vert"), glsl!("depth.frag")];
        Ok(Rc::new(Self(Program::from_source(context, vertex, fragment)?)))
    }

    /// Draws a cloth into the part of a depth map that `viewport` covers.
    pub fn draw(&self, mesh: &Mesh, clip: Mat4, detail: Detail, viewport: Viewport) {
        self.0.use_uniform("shadowFromWorld", to_gl_matrix(clip));
        self.0.use_vertex_attribute("position", &mesh.positions);
        let states = RenderStates { write_mask: WriteMask::DEPTH, ..RenderStates::default() };
        self.0.draw_elements(states, viewport, mesh.triangles(detail));
    }
}

/// Creates an empty depth map of `size` × `size` texels.
pub(super) fn depth_map(context: &Context, size: u32) -> DepthTexture2D {
    let edge = Wrapping::ClampToEdge;
    DepthTexture2D::new::<f32>(context, size, size, edge, edge)
}

/// Enables comparison and linear filtering of the depth texture that was bound last, as shadow
/// samplers need it.
pub(super) fn enable_depth_compare(context: &Context) {
    // three-d sets the texture up for plain reads.
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
