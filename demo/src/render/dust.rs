//! Dust in the key light: motes that drift through the air and glint where the beam passes.
//!
//! Method: one draw call of small quads; `dust.vert` computes their places from their numbers and
//! the time, so that nothing is uploaded.
//!
//! Reads the camera view and the time; writes the current colour target.
//!
//! Invariant: a mote is black where its path starts again.

use three_d::{Blend, Context, CoreError, Program, RenderStates, VertexBuffer, WriteMask};

use super::light::STAGE_CENTRE;
use super::pass::{RenderPass, to_gl_matrix, to_gl_vector};

/// Number of motes.
const MOTES: u32 = 90;

/// Corners of the motes, and the shader program.
pub struct Dust {
    program: Program,
    /// Corner (-1 to 1) and number of the mote.
    corners: VertexBuffer<[f32; 3]>,
}

impl Dust {
    /// Compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let quad = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let corners: Vec<_> =
            (0..MOTES).flat_map(|i| quad.map(|[x, y]| [x, y, i as f32])).collect();
        Ok(Self {
            program: Program::from_source(
                context,
                include_str!("shaders/dust.vert"),
                include_str!("shaders/dust.frag"),
            )?,
            corners: VertexBuffer::new_with_data(context, &corners),
        })
    }

    /// Draws the motes as they are at `time` [s].
    pub(super) fn draw(&self, pass: &RenderPass, time: f32) {
        let p = &self.program;
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("centre", to_gl_vector(STAGE_CENTRE));
        p.use_uniform("right", to_gl_vector(pass.view.right()));
        p.use_uniform("up", to_gl_vector(pass.view.up()));
        p.use_uniform("keyTowards", to_gl_vector(pass.lights.key.towards));
        p.use_uniform("keyColour", to_gl_vector(pass.lights.key.colour));
        p.use_uniform("time", time);
        p.use_vertex_attribute("mote", &self.corners);
        let states = RenderStates {
            blend: Blend::ADD,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        p.draw_arrays(states, pass.viewport, self.corners.vertex_count());
    }
}
