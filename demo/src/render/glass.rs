//! Glass balls: solids that refract the picture behind them.
//!
//! ```text
//! eye ─▶ surface ── refract ──▶ inside ── refract ──▶ floor or backdrop ─▶ its pixel
//! ```
//! Method: the picture without glass is resolved first; each ball then samples it where the twice
//! refracted ray ends (screen-space refraction), with one index of refraction per colour.
//!
//! Reads the resolved picture, the shadow map of the key light and the lights; writes colour and
//! depth of the current target.
//!
//! Invariant: glass casts no shadow of the depth maps; the floor draws its caustic.

use three_d::{Context, CoreError, RenderStates, Texture2D};

use super::glsl::glsl;
use super::lazy_program::LazyProgram;
use super::light::{FLOOR, invert_tone_curve};
use super::pass::{RenderPass, to_gl_vector};
use super::shadow::ShadowMap;
use super::solid::{Solid, Solids};

/// Shader program of the balls.
pub struct Glass {
    pub(super) program: LazyProgram,
}

impl Glass {
    /// Creates what draws the balls.
    pub fn new(context: &Context) -> Self {
        let vertex = glsl!("capsule.glsl", "solid.vert");
        let fragment = glsl!("light.glsl", "glass.frag");
        Self { program: LazyProgram::new(context, vertex, fragment) }
    }

    /// Draws the balls among `all`, whose meshes are in `solids`, from far to near.
    pub(super) fn draw(
        &self,
        pass: &RenderPass,
        solids: &Solids,
        all: &[Solid],
        (shadow, scene): (&ShadowMap, &Texture2D),
        dim: f32,
    ) -> Result<(), CoreError> {
        let p = self.program.get()?;
        let mut balls: Vec<_> = all.iter().filter(|solid| solid.is_glass).collect();
        let away = |ball: &Solid| ball.from.distance(pass.view.eye);
        balls.sort_by(|a, b| away(b).total_cmp(&away(a)));
        for ball in balls {
            let triangles = solids.place(p, pass.clip_from_world, ball, 0.0);
            p.use_uniform("mirrored", 0.0_f32);
            p.use_uniform("eye", to_gl_vector(pass.view.eye));
            p.use_uniform("centre", to_gl_vector(ball.from));
            p.use_uniform("ball", ball.radius);
            p.use_uniform("floorHeight", FLOOR);
            p.use_uniform("dim", dim);
            p.use_uniform("lowColour", to_gl_vector(invert_tone_curve(0x05070d)));
            p.use_uniform("highColour", to_gl_vector(invert_tone_curve(0x0b1020)));
            p.use_uniform("fillTowards", to_gl_vector(pass.lights.fill.towards));
            p.use_uniform("fillColour", to_gl_vector(pass.lights.fill.colour));
            p.use_uniform("rimTowards", to_gl_vector(pass.lights.rim.towards));
            p.use_uniform("rimColour", to_gl_vector(pass.lights.rim.colour));
            p.use_texture("scene", scene);
            shadow.bind(p, &pass.lights);
            p.draw_elements(RenderStates::default(), pass.viewport, triangles);
        }
        Ok(())
    }
}
