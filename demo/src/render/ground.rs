//! The stage floor: it takes the shadow, a breath of reflection, and fades into the backdrop.

use three_d::{Blend, Context, CoreError, Program, RenderStates, WriteMask};

use super::light::{FLOOR, STAGE_CENTRE};
use super::pass::{RenderPass, UnitQuad, to_gl_matrix, to_gl_vector};
use super::shadow::ShadowMap;

/// Half a side of the floor [m]; it has faded away long before.
const REACH: f32 = 8.0;

/// The program that shades the floor.
pub struct Ground {
    program: Program,
}

impl Ground {
    /// Compiles the floor.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let fragment =
            concat!(include_str!("shaders/light.glsl"), include_str!("shaders/ground.frag"));
        Ok(Self {
            program: Program::from_source(context, include_str!("shaders/ground.vert"), fragment)?,
        })
    }

    pub(super) fn draw(&self, pass: &RenderPass, quad: &UnitQuad, shadow: &ShadowMap) {
        let p = &self.program;
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("reach", REACH);
        p.use_uniform("floorHeight", FLOOR);
        p.use_uniform("eye", to_gl_vector(pass.view.eye));
        p.use_uniform("centre", to_gl_vector(STAGE_CENTRE));
        p.use_uniform("rimTowards", to_gl_vector(pass.lights.rim.towards));
        p.use_uniform("rimColour", to_gl_vector(pass.lights.rim.colour));
        shadow.bind(p, &pass.lights);
        let states = RenderStates {
            blend: Blend::TRANSPARENCY,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        quad.draw(p, states, pass.viewport);
    }
}
