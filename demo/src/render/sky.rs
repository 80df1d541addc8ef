//! Backdrop of the cloth scenes: a dark dome with haze over the horizon.
//!
//! Method: one full-screen pass without depth test.
//!
//! Reads the camera view; writes the current colour target.
//!
//! Invariant: it is drawn first, behind everything.

use three_d::{Context, CoreError, DepthTest, Program, RenderStates, WriteMask};

use super::glsl::glsl;
use super::light::invert_tone_curve;
use super::pass::{RenderPass, UnitQuad, to_gl_vector};

/// Shader program of the backdrop.
pub struct Sky {
    program: Program,
}

impl Sky {
    /// Compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        Ok(Self {
            program: Program::from_source(context, glsl!("screen.vert"), glsl!("sky.frag"))?,
        })
    }

    pub(super) fn draw(&self, pass: &RenderPass, quad: &UnitQuad) {
        let p = &self.program;
        p.use_uniform("lowColour", to_gl_vector(invert_tone_curve(0x05070d)));
        p.use_uniform("highColour", to_gl_vector(invert_tone_curve(0x0b1020)));
        let half = pass.view.half_extent(pass.aspect());
        p.use_uniform("forward", to_gl_vector(pass.view.forward()));
        p.use_uniform("shift", three_d::Vec2::new(pass.view.shift.x, pass.view.shift.y));
        p.use_uniform("across", to_gl_vector(pass.view.right() * half.x));
        p.use_uniform("upward", to_gl_vector(pass.view.up() * half.y));
        let states = RenderStates {
            depth_test: DepthTest::Always,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        quad.draw(p, states, pass.viewport);
    }
}
