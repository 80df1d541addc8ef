//! Post-processing: vignette, filmic tone mapping, sRGB conversion and ordered dither.
//!
//! Method: one full-screen pass with `post.frag`.
//!
//! Reads the resolved HDR texture; writes the output target.
//!
//! Invariant: it is the last pass of a frame.

use three_d::{
    Context, CoreError, DepthTest, Program, RenderStates, Texture2D, Viewport, WriteMask,
};

use super::glsl::glsl;
use super::pass::UnitQuad;

/// Shader program of the post-processing pass.
pub struct Post {
    program: Program,
}

impl Post {
    /// Compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        Ok(Self {
            program: Program::from_source(context, glsl!("screen.vert"), glsl!("post.frag"))?,
        })
    }

    pub(super) fn draw(&self, viewport: Viewport, quad: &UnitQuad, scene: &Texture2D) {
        let p = &self.program;
        p.use_texture("scene", scene);
        p.use_uniform("aspect", viewport.width as f32 / viewport.height as f32);
        p.use_uniform("exposure", 1.30_f32);
        let states = RenderStates {
            depth_test: DepthTest::Always,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        quad.draw(p, states, viewport);
    }
}
