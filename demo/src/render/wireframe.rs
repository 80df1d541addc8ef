//! Wireframe: the links of a cloth as thin lines over it.
//!
//! Method: indexed `GL_LINES` with a small depth offset towards the eye.
//!
//! Reads the line indices of a [`Mesh`]; writes the current colour target.
//!
//! Invariant: a mesh without lines draws nothing.

use three_d::context::{self, HasContext};
use three_d::{Blend, Context, CoreError, RenderStates, WriteMask};

use super::glsl::glsl;
use super::lazy_program::LazyProgram;
use super::light::linear;
use super::mesh::Mesh;
use super::pass::{RenderPass, to_gl_matrix};

/// Shader program of the lines.
pub struct Wireframe {
    context: Context,
    pub(super) program: LazyProgram,
}

impl Wireframe {
    /// Creates what draws the lines.
    pub fn new(context: &Context) -> Self {
        Self {
            context: context.clone(),
            program: LazyProgram::new(context, glsl!("wire.vert"), glsl!("wire.frag")),
        }
    }

    pub(super) fn draw(&self, pass: &RenderPass, mesh: &Mesh) -> Result<(), CoreError> {
        if mesh.lines.count() == 0 {
            return Ok(());
        }
        let p = self.program.get()?;
        let tint = linear(0x7cc0ff);
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("tint", three_d::Vec4::new(tint.x, tint.y, tint.z, 0.55));
        p.use_vertex_attribute("position", &mesh.positions);
        let states = RenderStates {
            blend: Blend::TRANSPARENCY,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        p.draw_elements_with(states, pass.viewport, &mesh.lines, || {
            // SAFETY: three-d has bound the program, the vertices and this element buffer, and
            // knows the count; only its primitive type is replaced by lines.
            unsafe {
                self.context.draw_elements(
                    context::LINES,
                    mesh.lines.count() as i32,
                    context::UNSIGNED_INT,
                    0,
                );
            }
        });
        Ok(())
    }
}
