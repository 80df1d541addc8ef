//! The cloth's own material: woven, two-sided, glossy or dull, and a little translucent.

use glam::{Vec2, Vec3};
use three_d::{Context, CoreError, Program, RenderStates};

use super::light::{FLOOR, linear};
use super::mesh::Mesh;
use super::shadow::Shadow;
use super::{Pass, REFLECTION, matrix, vector};
use crate::fabric::Look;

/// A [`Look`] as light meets it: linear colours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dye {
    look: Look,
    front: Vec3,
    back: Vec3,
    seam: Vec3,
    pub(super) warp: Vec3,
    pub(super) weft: Vec3,
}

impl Dye {
    pub(super) fn new(look: Look) -> Self {
        let kept = |colour: u32| {
            let pure = linear(colour);
            let grey = pure.dot(Vec3::new(0.2126, 0.7152, 0.0722));
            Vec3::splat(grey).lerp(pure, look.kept)
        };
        let [warp, weft] = look.threads.map(kept);
        Self {
            look,
            front: kept(look.front),
            back: kept(look.back),
            seam: kept(look.seam.0),
            warp,
            weft,
        }
    }
}

/// The program that shades cloth.
pub struct ClothMaterial {
    program: Program,
}

/// What the cloth is drawn as.
#[derive(Clone, Copy, PartialEq)]
enum As {
    Itself,
    Reflection,
}

impl ClothMaterial {
    /// Compiles the material.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let fragment = concat!(
            include_str!("shaders/light.glsl"),
            include_str!("shaders/weave.glsl"),
            include_str!("shaders/cloth.frag")
        );
        Ok(Self {
            program: Program::from_source(context, include_str!("shaders/cloth.vert"), fragment)?,
        })
    }

    /// Draws the cloth; `dim` below one darkens it under a wireframe.
    pub(super) fn draw(&self, pass: &Pass, mesh: &Mesh, shadow: &Shadow, dye: &Dye, dim: f32) {
        self.prepare(pass, mesh, shadow, dye, As::Itself);
        self.program.use_uniform("dim", dim);
        self.program.draw_elements(RenderStates::default(), pass.viewport, &mesh.triangles);
    }

    /// Draws the cloth upside down below the floor; the floor is blended over it afterwards.
    pub(super) fn draw_reflection(&self, pass: &Pass, mesh: &Mesh, shadow: &Shadow, dye: &Dye) {
        self.prepare(pass, mesh, shadow, dye, As::Reflection);
        self.program.use_uniform("dim", 1.0_f32);
        let states = RenderStates { blend: REFLECTION, ..RenderStates::default() };
        self.program.draw_elements(states, pass.viewport, &mesh.triangles);
    }

    fn prepare(&self, pass: &Pass, mesh: &Mesh, shadow: &Shadow, dye: &Dye, shown: As) {
        let p = &self.program;
        let mut eye = pass.sight.eye;
        if shown == As::Reflection {
            eye.y = 2.0 * FLOOR - eye.y;
        }
        p.use_uniform("clipFromWorld", matrix(pass.clip_from_world));
        p.use_uniform("eye", vector(eye));
        p.use_uniform("mirrored", if shown == As::Reflection { 1.0_f32 } else { 0.0 });
        p.use_uniform("floorHeight", FLOOR);
        p.use_uniform("fillTowards", vector(pass.lights.fill.towards));
        p.use_uniform("fillColour", vector(pass.lights.fill.colour));
        p.use_uniform("rimTowards", vector(pass.lights.rim.towards));
        p.use_uniform("rimColour", vector(pass.lights.rim.colour));
        shadow.use_in(p, &pass.lights);
        self.dye(dye, mesh.span);
        p.use_uniform("roundHem", if mesh.is_round { 1.0_f32 } else { 0.0 });
        p.use_vertex_attribute("position", &mesh.positions);
        p.use_vertex_attribute("normal", &mesh.normals);
        p.use_vertex_attribute("texcoord", &mesh.uvs);
        p.use_vertex_attribute("frayed", &mesh.frayed);
    }

    fn dye(&self, dye: &Dye, span: Vec2) {
        let (p, look) = (&self.program, &dye.look);
        let [across, along, strength, mirror] = look.gloss;
        let [relief, slub] = look.relief;
        p.use_uniform("span", three_d::Vec2::new(span.x, span.y));
        p.use_uniform("frontAlbedo", vector(dye.front));
        p.use_uniform("backAlbedo", vector(dye.back));
        p.use_uniform("seamAlbedo", vector(dye.seam));
        p.use_uniform("seamCover", look.seam.1);
        p.use_uniform("cloth", three_d::Vec4::new(look.count, relief, slub, look.weave));
        p.use_uniform("gloss", three_d::Vec4::new(across, along, strength, mirror));
        p.use_uniform("fibres", three_d::Vec2::new(look.fuzz, look.through));
        p.use_uniform("printed", if look.printed { 1.0_f32 } else { 0.0 });
    }
}
