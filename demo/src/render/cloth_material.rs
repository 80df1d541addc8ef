//! Cloth material: a two-sided woven surface with anisotropic gloss, sheen and transmission.
//!
//! Method: a forward pass with `cloth.frag`; the reflection on the floor is a second, mirrored
//! pass.
//!
//! Reads a [`Mesh`], the shadow maps of key and rim light, the lights and a fabric [`Appearance`];
//! writes colour and depth of the current target.
//!
//! Invariant: colours are linear here; [`ClothAlbedo`] converts them from sRGB.

use glam::{Vec2, Vec3};
use three_d::{Context, CoreError, Program, RenderStates};

use super::glsl::glsl;
use super::light::{FLOOR, linear};
use super::mesh::{Detail, Mesh};
use super::pass::{ALPHA_BLEND, RenderPass, to_gl_matrix, to_gl_vector};
use super::shadow::ShadowMap;
use crate::fabric::Appearance;

/// The parameters of an [`Appearance`] with linear colours.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClothAlbedo {
    appearance: Appearance,
    front: Vec3,
    back: Vec3,
    seam: Vec3,
    pub(super) warp: Vec3,
    pub(super) weft: Vec3,
}

impl ClothAlbedo {
    pub(super) fn new(appearance: Appearance) -> Self {
        let saturation = |colour: u32| {
            let pure = linear(colour);
            let grey = pure.dot(Vec3::new(0.2126, 0.7152, 0.0722));
            Vec3::splat(grey).lerp(pure, appearance.saturation)
        };
        let [warp, weft] = appearance.threads.map(saturation);
        Self {
            appearance,
            front: saturation(appearance.front),
            back: saturation(appearance.back),
            seam: saturation(appearance.seam.0),
            warp,
            weft,
        }
    }
}

/// Shader program of the cloth.
pub struct ClothMaterial {
    program: Program,
}

/// Which image of the cloth a pass draws.
#[derive(Clone, Copy, PartialEq)]
enum As {
    Itself,
    Reflection,
}

impl ClothMaterial {
    /// Compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let fragment = glsl!("light.glsl", "weave.glsl", "cloth.frag");
        Ok(Self { program: Program::from_source(context, glsl!("cloth.vert"), fragment)? })
    }

    /// Draws the cloth; a `dim` below one darkens it, for the wireframe.
    pub(super) fn draw(
        &self,
        pass: &RenderPass,
        mesh: &Mesh,
        shadows: [&ShadowMap; 2],
        albedo: &ClothAlbedo,
        dim: f32,
    ) {
        self.prepare(pass, mesh, shadows, albedo, As::Itself);
        self.program.use_uniform("dim", dim);
        self.program.draw_elements(
            RenderStates::default(),
            pass.viewport,
            mesh.triangles(Detail::Full),
        );
    }

    /// Draws the mirror image below the floor; the floor is blended over it later.
    pub(super) fn draw_reflection(
        &self,
        pass: &RenderPass,
        mesh: &Mesh,
        shadows: [&ShadowMap; 2],
        albedo: &ClothAlbedo,
    ) {
        self.prepare(pass, mesh, shadows, albedo, As::Reflection);
        self.program.use_uniform("dim", 1.0_f32);
        let states = RenderStates { blend: ALPHA_BLEND, ..RenderStates::default() };
        self.program.draw_elements(states, pass.viewport, mesh.triangles(Detail::Coarse));
    }

    fn prepare(
        &self,
        pass: &RenderPass,
        mesh: &Mesh,
        shadows: [&ShadowMap; 2],
        albedo: &ClothAlbedo,
        shown: As,
    ) {
        let p = &self.program;
        let mut eye = pass.view.eye;
        if shown == As::Reflection {
            eye.y = 2.0 * FLOOR - eye.y;
        }
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("eye", to_gl_vector(eye));
        p.use_uniform("mirrored", if shown == As::Reflection { 1.0_f32 } else { 0.0 });
        p.use_uniform("floorHeight", FLOOR);
        p.use_uniform("fillTowards", to_gl_vector(pass.lights.fill.towards));
        p.use_uniform("fillColour", to_gl_vector(pass.lights.fill.colour));
        p.use_uniform("rimTowards", to_gl_vector(pass.lights.rim.towards));
        p.use_uniform("rimColour", to_gl_vector(pass.lights.rim.colour));
        let [key, rim] = shadows;
        key.bind(p, &pass.lights);
        p.use_uniform("rimFromWorld", to_gl_matrix(pass.lights.rim.clip_from_world()));
        rim.bind_compared(p, "rimMap");
        self.albedo(albedo, mesh.span);
        p.use_uniform("roundHem", if mesh.is_round { 1.0_f32 } else { 0.0 });
        p.use_vertex_attribute("position", &mesh.positions);
        p.use_vertex_attribute("normal", &mesh.normals);
        p.use_vertex_attribute("texcoord", &mesh.uvs);
        p.use_vertex_attribute("frayed", &mesh.frayed);
        p.use_vertex_attribute("hollow", &mesh.hollows);
    }

    fn albedo(&self, albedo: &ClothAlbedo, span: Vec2) {
        let (p, appearance) = (&self.program, &albedo.appearance);
        let [across, along, strength, mirror] = appearance.gloss;
        let [relief, slub] = appearance.relief;
        p.use_uniform("span", three_d::Vec2::new(span.x, span.y));
        p.use_uniform("frontAlbedo", to_gl_vector(albedo.front));
        p.use_uniform("backAlbedo", to_gl_vector(albedo.back));
        p.use_uniform("seamAlbedo", to_gl_vector(albedo.seam));
        p.use_uniform("seamCover", appearance.seam.1);
        p.use_uniform(
            "cloth",
            three_d::Vec4::new(appearance.count, relief, slub, appearance.weave),
        );
        p.use_uniform("gloss", three_d::Vec4::new(across, along, strength, mirror));
        p.use_uniform("fibres", three_d::Vec2::new(appearance.fuzz, appearance.transmission));
        p.use_uniform("printed", appearance.print as u32 as f32);
    }
}
