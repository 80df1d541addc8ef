//! Dust in the key light, and rain: motes drift through the air and glint where the beam passes;
//! drops fall as streaks.
//!
//! Method: one draw call of small quads; `dust.vert` and `rain.vert` compute their places from their
//! numbers and the time, so that nothing is uploaded.
//!
//! Reads the camera view and the time; writes the current colour target.
//!
//! Invariant: motes and drops are black where their paths start again.

use glam::Vec3;
use three_d::{Blend, Context, CoreError, Cull, Program, RenderStates, VertexBuffer, WriteMask};

use super::glsl::glsl;
use super::lazy_program::LazyProgram;
use super::light::{FLOOR, STAGE_CENTRE};
use super::pass::{RenderPass, to_gl_matrix, to_gl_vector};

/// Number of motes.
const MOTES: u32 = 90;
/// Number of drops.
const DROPS: u32 = 700;

/// Corners of the motes and of the drops, and the shader programs.
pub struct Dust {
    dust: Program,
    pub(super) rain: LazyProgram,
    motes: VertexBuffer<[f32; 3]>,
    drops: VertexBuffer<[f32; 3]>,
}

impl Dust {
    /// Compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        Ok(Self {
            dust: Program::from_source(context, glsl!("dust.vert"), glsl!("dust.frag"))?,
            rain: LazyProgram::new(context, glsl!("rain.vert"), glsl!("rain.frag")),
            motes: VertexBuffer::new_with_data(context, &quads(MOTES)),
            drops: VertexBuffer::new_with_data(context, &quads(DROPS)),
        })
    }

    /// Draws the motes as they are at `time` [s].
    pub(super) fn draw(&self, pass: &RenderPass, time: f32) {
        let p = &self.dust;
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("centre", to_gl_vector(STAGE_CENTRE));
        p.use_uniform("right", to_gl_vector(pass.view.right()));
        p.use_uniform("up", to_gl_vector(pass.view.up()));
        p.use_uniform("keyTowards", to_gl_vector(pass.lights.key.towards));
        p.use_uniform("keyColour", to_gl_vector(pass.lights.key.colour));
        p.use_uniform("time", time);
        p.use_vertex_attribute("mote", &self.motes);
        p.draw_arrays(added(), pass.viewport, self.motes.vertex_count());
    }

    /// Draws drops that fall with `velocity` [m/s] as they are at `time` [s].
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub(super) fn draw_rain(
        &self,
        pass: &RenderPass,
        velocity: Vec3,
        time: f32,
    ) -> Result<(), CoreError> {
        let p = self.rain.get()?;
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("centre", to_gl_vector(STAGE_CENTRE));
        p.use_uniform("eye", to_gl_vector(pass.view.eye));
        p.use_uniform("velocity", to_gl_vector(velocity));
        p.use_uniform("floorHeight", FLOOR);
        p.use_uniform("pixel", 1.0 / pass.view.focal_length_pixels(pass.viewport.height as f32));
        p.use_uniform("time", time);
        p.use_vertex_attribute("mote", &self.drops);
        p.draw_arrays(added(), pass.viewport, self.drops.vertex_count());
        Ok(())
    }
}

/// Returns corner (-1 to 1) and number for two triangles of each of `count` quads.
fn quads(count: u32) -> Vec<[f32; 3]> {
    let quad = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    (0..count).flat_map(|i| quad.map(|[x, y]| [x, y, i as f32])).collect()
}

/// Adds light, hidden by what is nearer.
fn added() -> RenderStates {
    RenderStates {
        blend: Blend::ADD,
        cull: Cull::None,
        write_mask: WriteMask::COLOR,
        ..RenderStates::default()
    }
}
