//! The cloth's own material: woven, two-sided, satin, and a little translucent.

use glam::Vec3;
use three_d::{
    Blend, BlendEquationType, BlendMultiplierType, Context, CoreError, Program, RenderStates,
};

use super::light::{FLOOR, linear};
use super::mesh::Mesh;
use super::shadow::Shadow;
use super::{Pass, matrix, vector};

/// The front of the cloth.
const FRONT: u32 = 0x9fb6ff;
/// Its back: the paler of the brief's two blues.
const BACK: u32 = 0xc0c8ff;

/// How much of a colour the silver keeps: the lights and the dome bring the rest of the blue.
const COLOUR_KEPT: f32 = 0.72;

/// A base colour as the threads reflect it.
fn silver(colour: u32) -> Vec3 {
    let pure = linear(colour);
    let grey = pure.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    Vec3::splat(grey).lerp(pure, COLOUR_KEPT)
}

/// The program that shades cloth.
pub struct ClothMaterial {
    program: Program,
}

impl ClothMaterial {
    /// Compiles the material.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let fragment =
            concat!(include_str!("shaders/light.glsl"), include_str!("shaders/cloth.frag"));
        Ok(Self {
            program: Program::from_source(context, include_str!("shaders/cloth.vert"), fragment)?,
        })
    }

    /// Draws the cloth; `dim` below one darkens it under a wireframe.
    pub(super) fn draw(&self, pass: &Pass, mesh: &Mesh, shadow: &Shadow, dim: f32) {
        self.prepare(pass, mesh, shadow, dim, false);
        self.program.draw_elements(RenderStates::default(), pass.viewport, &mesh.triangles);
    }

    /// Draws the cloth upside down below the floor; the floor is blended over it afterwards.
    pub(super) fn draw_reflection(&self, pass: &Pass, mesh: &Mesh, shadow: &Shadow) {
        self.prepare(pass, mesh, shadow, 1.0, true);
        let states = RenderStates {
            blend: Blend::Enabled {
                source_rgb_multiplier: BlendMultiplierType::SrcAlpha,
                source_alpha_multiplier: BlendMultiplierType::Zero,
                destination_rgb_multiplier: BlendMultiplierType::OneMinusSrcAlpha,
                destination_alpha_multiplier: BlendMultiplierType::One,
                rgb_equation: BlendEquationType::Add,
                alpha_equation: BlendEquationType::Add,
            },
            ..RenderStates::default()
        };
        self.program.draw_elements(states, pass.viewport, &mesh.triangles);
    }

    fn prepare(&self, pass: &Pass, mesh: &Mesh, shadow: &Shadow, dim: f32, mirrored: bool) {
        let p = &self.program;
        let mut eye = pass.sight.eye;
        if mirrored {
            eye.y = 2.0 * FLOOR - eye.y;
        }
        p.use_uniform("clipFromWorld", matrix(pass.clip_from_world));
        p.use_uniform("eye", vector(eye));
        p.use_uniform("mirrored", if mirrored { 1.0_f32 } else { 0.0 });
        p.use_uniform("dim", dim);
        p.use_uniform("floorHeight", FLOOR);
        p.use_uniform("fillTowards", vector(pass.lights.fill.towards));
        p.use_uniform("fillColour", vector(pass.lights.fill.colour));
        p.use_uniform("rimTowards", vector(pass.lights.rim.towards));
        p.use_uniform("rimColour", vector(pass.lights.rim.colour));
        p.use_uniform("frontAlbedo", vector(silver(FRONT)));
        p.use_uniform("backAlbedo", vector(silver(BACK)));
        shadow.use_in(p, &pass.lights);
        p.use_vertex_attribute("position", &mesh.positions);
        p.use_vertex_attribute("normal", &mesh.normals);
        p.use_vertex_attribute("texcoord", &mesh.uvs);
    }
}
