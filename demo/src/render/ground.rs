//! Floor of the cloth scenes: receives the shadow, lets the reflections through, and fades into the
//! backdrop.
//!
//! Method: one quad, blended over the mirrored cloth.
//!
//! Reads the shadow map, the lights and the camera view; writes the current colour target.
//!
//! Invariant: it is drawn after the reflections and before the cloth.

use three_d::{Blend, Context, CoreError, Program, RenderStates, WriteMask};

use super::light::{FLOOR, STAGE_CENTRE};
use super::pass::{RenderPass, UnitQuad, to_gl_matrix, to_gl_vector};
use super::shadow::ShadowMap;

/// Half the side of the quad [m]; the floor fades out before its border.
const HALF_SIDE: f32 = 8.0;

/// Shader program of the floor.
pub struct Ground {
    program: Program,
}

impl Ground {
    /// Compiles the shaders.
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
        p.use_uniform("reach", HALF_SIDE);
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
