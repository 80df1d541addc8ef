//! Floor of the cloth scenes: receives light and shadow, lets the reflections through, and fades
//! into the backdrop.
//!
//! Method: one quad, blended over the mirrored cloth. Shadows soften with the distance from what
//! casts them (percentage-closer soft shadows: Fernando, SIGGRAPH 2005).
//!
//! Reads the shadow maps, the lights, the halos, the solids and the camera view; writes the current
//! colour target.
//!
//! Invariant: it is drawn after the reflections and before the cloth.

use glam::Vec3;
use three_d::{Blend, Context, CoreError, Program, RenderStates, WriteMask};

use super::glsl::glsl;
use super::halo::{Halo, LAMPS};
use super::light::{FLOOR, STAGE_CENTRE, STAGE_DEPTH, STAGE_RADIUS};
use super::pass::{RenderPass, UnitQuad, to_gl_matrix, to_gl_vector};
use super::shadow::ShadowMap;
use super::solid::Solid;

/// Half the side of the quad [m]; the floor fades out before its border.
const HALF_SIDE: f32 = 8.0;
/// Most solids that darken the floor around their feet.
const MAX_FEET: usize = 8;
/// Most balls of glass that gather light on the floor.
const MAX_GLASS: usize = 6;
/// A solid that ends this far above the floor stands on it [m].
const STANDING: f32 = 0.03;

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
        let fragment = glsl!("light.glsl", "ground.frag");
        Ok(Self { program: Program::from_source(context, glsl!("ground.vert"), fragment)? })
    }

    /// Draws the floor; `depths` is a coarse depth map of the key light, which measures how far
    /// shadows fall.
    pub(super) fn draw(
        &self,
        pass: &RenderPass,
        quad: &UnitQuad,
        shadow: &ShadowMap,
        depths: &ShadowMap,
        solids: &[Solid],
        halos: &[Halo],
    ) {
        let p = &self.program;
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("reach", HALF_SIDE);
        p.use_uniform("floorHeight", FLOOR);
        p.use_uniform("eye", to_gl_vector(pass.view.eye));
        p.use_uniform("centre", to_gl_vector(STAGE_CENTRE));
        p.use_uniform("fillColour", to_gl_vector(pass.lights.fill.colour));
        p.use_uniform("rimTowards", to_gl_vector(pass.lights.rim.towards));
        p.use_uniform("rimColour", to_gl_vector(pass.lights.rim.colour));
        p.use_uniform("depthRange", STAGE_DEPTH.end - STAGE_DEPTH.start);
        p.use_uniform("radius", STAGE_RADIUS);
        let feet = feet(solids);
        p.use_uniform("footCount", feet.len() as i32);
        p.use_uniform_array("feet", &padded::<MAX_FEET, _>(feet.iter().copied()).map(to_gl_vector));
        let glass = solids.iter().filter(|solid| solid.is_glass);
        let glass = glass.map(|ball| ball.from.extend(ball.radius).to_array());
        p.use_uniform("glassCount", glass.clone().count().min(MAX_GLASS) as i32);
        p.use_uniform_array("glass", &padded::<MAX_GLASS, _>(glass).map(three_d::Vec4::from));
        let spheres = halos.iter().map(|halo| halo.centre.extend(halo.radius).to_array());
        p.use_uniform("haloCount", halos.len() as i32);
        p.use_uniform_array("halos", &padded::<LAMPS, _>(spheres).map(three_d::Vec4::from));
        let tints = halos.iter().map(|halo| halo.tint);
        p.use_uniform_array("haloTints", &padded::<LAMPS, _>(tints).map(to_gl_vector));
        depths.bind_depths(p, "depths");
        shadow.bind(p, &pass.lights);
        let states = RenderStates {
            blend: Blend::TRANSPARENCY,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        quad.draw(p, states, pass.viewport);
    }
}

/// Returns `values`, and defaults up to the length that the shader declares.
fn padded<const N: usize, T: Default>(mut values: impl Iterator<Item = T>) -> [T; N] {
    std::array::from_fn(|_| values.next().unwrap_or_default())
}

/// Returns x, z and radius of the largest solids that stand on the floor [m].
fn feet(solids: &[Solid]) -> Vec<Vec3> {
    let lowest = |solid: &Solid| solid.from.y.min(solid.to.y) - solid.bevel.unwrap_or(0.0);
    let stands = |solid: &&Solid| lowest(solid) < FLOOR + STANDING;
    let mut feet: Vec<_> = solids
        .iter()
        .filter(stands)
        .map(|solid| Vec3::new(solid.from.x, solid.from.z, solid.radius))
        .collect();
    feet.sort_by(|a, b| b.z.total_cmp(&a.z));
    feet.truncate(MAX_FEET);
    feet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_solids_that_stand_on_the_floor_have_feet() {
        let floor = Vec3::Y * FLOOR;
        let solids = [
            Solid::sphere(Vec3::Y, 0.5, 0),
            Solid::cylinder(floor + Vec3::X, floor + Vec3::X + Vec3::Y, 0.2, 0.01, 0),
            Solid::capsule(floor, Vec3::ZERO, 0.3, 0),
        ];
        let feet = feet(&solids);
        assert_eq!(feet, [Vec3::Z * 0.3, Vec3::new(1.0, 0.0, 0.2)]);
    }
}
