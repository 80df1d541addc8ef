//! Light halos: soft additive billboards behind the stage.
//!
//! Method: one quad per halo, parallel to the screen, blended additively; `glow.frag` computes the
//! falloff, so that no texture limits its precision.
//!
//! Reads the camera view and the halos; writes the current colour target.
//!
//! Invariant: the falloff is zero at the border, so that the quad is not visible.

use three_d::{Blend, Context, CoreError, Program, RenderStates, WriteMask};

use super::glsl::glsl;
use super::halo::Halo;
use super::pass::{RenderPass, UnitQuad, to_gl_matrix, to_gl_vector};

/// Shader program of the halos.
pub struct Glow {
    program: Program,
}

impl Glow {
    /// Compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        Ok(Self { program: Program::from_source(context, glsl!("glow.vert"), glsl!("glow.frag"))? })
    }

    pub(super) fn draw(&self, pass: &RenderPass, quad: &UnitQuad, halos: &[Halo]) {
        let p = &self.program;
        let (right, up) = (pass.view.right(), pass.view.up());
        for halo in halos {
            p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
            p.use_uniform("centre", to_gl_vector(halo.centre));
            p.use_uniform("right", to_gl_vector(right * halo.radius));
            p.use_uniform("up", to_gl_vector(up * halo.radius));
            p.use_uniform("tint", to_gl_vector(halo.tint));
            p.use_uniform("core", halo.core);
            let states = RenderStates {
                blend: Blend::ADD,
                write_mask: WriteMask::COLOR,
                ..RenderStates::default()
            };
            quad.draw(p, states, pass.viewport);
        }
    }
}
