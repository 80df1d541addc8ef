//! Renderer of the receipt: paper over a matt ground in daylight, in the units and colours of the
//! receipt's specification.
//!
//! ```text
//! shadow map, coarse depth map, sky maps ─▶ ground ─▶ pins ─▶ paper ─▶ resolve ─▶ tone curve ─▶ output
//! ```
//! Method: one key light with a filtered shadow map; ambient light with occlusion from four sky
//! maps.
//!
//! Reads a [`ClothSurface`] and a [`ReceiptFrame`]; writes the pixels of the output target.
//!
//! Invariant: lengths are in scene units, not in metres.

use glam::{Mat4, Vec3};
use muslin_scenes::receipt;
use three_d::context::{self, HasContext};
use three_d::{
    ClearState, Context, CoreError, DepthTest, Interpolation, Mipmap, Program, RenderStates,
    RenderTarget, Texture2D, Viewport, Wrapping, WriteMask,
};

use super::glsl::glsl;
use super::hdr_target::HdrTarget;
use super::light::{Light, Lights, linear};
use super::mesh::{ClothSurface, Detail, Mesh};
use super::pass::{RenderPass, UnitQuad, to_gl_matrix, to_gl_vector};
use super::shadow::{DepthProgram, ShadowMap};
use super::sky_light::SkyLight;
use super::solid::{Solid, Solids};
use crate::camera::CameraView;
use crate::receipt::crease_map::CreaseMap;
use crate::receipt::ink_map::InkMap;

/// Colour of the background.
const BACKDROP: u32 = 0xe8e8e8;
/// Height of the ground, slightly below the floor, in units.
pub const GROUND: f32 = receipt::FLOOR - 0.02;
/// Half the side of the ground, in units.
const HALF_SIDE: f32 = 50.0;
/// Exposure that maps the sum of the specified lights to the range of a screen.
const EXPOSURE: f32 = 1.0 / 1.4;
/// Sizes [texels] of the key light's shadow map, and of the coarse depth map that measures how far
/// shadows fall.
const SHADOW_SIZE: u32 = 2048;
const DEPTH_SIZE: u32 = 256;
/// Least radius and depth of the volume that the shadow maps cover, in units.
const RADIUS: f32 = 5.0;
const DEPTH: f32 = 60.0;

/// The contents of a frame, except for the paper.
#[derive(Clone, Copy, Debug)]
pub struct ReceiptFrame<'a> {
    /// Camera view, in units.
    pub view: CameraView,
    /// Positions of the pins, in units.
    pub pins: &'a [Vec3],
    /// Fraction of the output pixels to draw along each side.
    pub resolution_scale: f32,
    /// Whether to draw one sample per pixel, for slow machines.
    pub is_low: bool,
}

/// All GPU resources of the receipt; created again after a lost context.
pub struct ReceiptRenderer {
    context: Context,
    lights: Lights,
    mesh: Mesh,
    shadow: ShadowMap,
    depths: ShadowMap,
    sky: SkyLight,
    ink: Texture2D,
    creases: Option<Texture2D>,
    paper: Program,
    ground: Program,
    solids: Solids,
    tone_curve: Program,
    quad: UnitQuad,
    target: Option<HdrTarget>,
    /// Centre and radius of the paper, in units.
    centre: Vec3,
    radius: f32,
}

impl ReceiptRenderer {
    /// Compiles the shaders, prints the receipt and creates the textures.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses a shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let lit = glsl!("light.glsl", "sky_light.glsl", "paper.frag");
        let ground = glsl!("light.glsl", "sky_light.glsl", "table.frag");
        let depths = DepthProgram::new(context)?;
        Ok(Self {
            context: context.clone(),
            lights: lights(),
            mesh: Mesh::new(context),
            shadow: ShadowMap::new(context, &depths, SHADOW_SIZE),
            depths: ShadowMap::new(context, &depths, DEPTH_SIZE),
            sky: SkyLight::new(context, &depths),
            ink: ink(context),
            creases: None,
            paper: Program::from_source(context, glsl!("cloth.vert"), lit)?,
            ground: Program::from_source(context, glsl!("ground.vert"), ground)?,
            solids: Solids::new(context)?,
            tone_curve: Program::from_source(
                context,
                glsl!("screen.vert"),
                glsl!("daylight.frag"),
            )?,
            quad: UnitQuad::new(context),
            target: None,
            centre: Vec3::ZERO,
            radius: RADIUS,
        })
    }

    /// Uploads the current state of the paper and of its creases.
    pub fn upload_paper(&mut self, surface: &ClothSurface<'_>, creases: &mut CreaseMap) {
        self.mesh.update(surface);
        let [width, height] = creases.size();
        let has_size = |map: &Texture2D| (map.width(), map.height()) == (width, height);
        if !self.creases.as_ref().is_some_and(has_size) {
            self.creases = Some(Texture2D::new_empty::<[f32; 4]>(
                &self.context,
                width,
                height,
                Interpolation::Nearest,
                Interpolation::Nearest,
                None,
                Wrapping::ClampToEdge,
                Wrapping::ClampToEdge,
            ));
        }
        if let Some(map) = &mut self.creases {
            map.fill(creases.texels());
        }
        let count = surface.positions.len().max(1) as f32;
        self.centre = surface.positions.iter().sum::<Vec3>() / count;
        let far = surface.positions.iter().map(|at| at.distance(self.centre));
        self.radius = far.fold(RADIUS, f32::max);
    }

    /// Draws the paper and `frame` into the whole of `output`.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses.
    pub fn draw(
        &mut self,
        view: &ReceiptFrame<'_>,
        output: &RenderTarget<'_>,
    ) -> Result<(), CoreError> {
        let side = |pixels: u32| (pixels as f32 * view.resolution_scale).round().max(1.0) as u32;
        let (width, height) = (side(output.width()), side(output.height()));
        HdrTarget::resize(&mut self.target, &self.context, [width, height], view.is_low);
        let pins: Vec<Solid> = view.pins.iter().map(|at| pin(*at)).collect();
        let key = self.lights.key;
        let clip = key.clip_around(self.centre, self.radius, 0.5 * DEPTH, 0.0..DEPTH);
        for shadow in [&self.shadow, &self.depths] {
            shadow.draw(std::iter::once(&self.mesh), clip, Detail::Full, |viewport| {
                self.solids.draw_depth(clip, viewport, &pins);
            })?;
        }
        self.sky.draw(&self.mesh, self.centre, self.radius)?;
        let Some(target) = &self.target else {
            return Ok(());
        };
        let pass = RenderPass {
            viewport: Viewport::new_at_origo(width, height),
            clip_from_world: view.view.clip_from_world(width as f32 / height as f32),
            view: view.view,
            lights: self.lights,
        };
        let backdrop = invert_daylight_curve(BACKDROP);
        target
            .samples
            .clear(ClearState::color_and_depth(backdrop.x, backdrop.y, backdrop.z, 1.0, 1.0))
            .write::<CoreError>(|| {
                self.draw_ground(&pass, clip, backdrop);
                self.solids.draw_with(&pass, &self.shadow, clip, &pins, 1.0);
                self.draw_paper(&pass, clip);
                Ok(())
            })?;
        target.samples.resolve_color_to(&target.resolved.as_color_target(None));
        output.write::<CoreError>(|| {
            self.tone_curve.use_texture("scene", &target.resolved);
            self.tone_curve.use_uniform("exposure", EXPOSURE);
            let states = RenderStates {
                depth_test: DepthTest::Always,
                write_mask: WriteMask::COLOR,
                ..RenderStates::default()
            };
            self.quad.draw(&self.tone_curve, states, output.viewport());
            Ok(())
        })?;
        Ok(())
    }

    /// Returns the context of the GPU resources.
    pub fn context(&self) -> &Context {
        &self.context
    }

    fn draw_ground(&self, pass: &RenderPass, clip: Mat4, backdrop: Vec3) {
        let p = &self.ground;
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("reach", HALF_SIDE);
        p.use_uniform("floorHeight", GROUND);
        p.use_uniform("backdrop", to_gl_vector(backdrop));
        p.use_uniform("depthRange", DEPTH);
        p.use_uniform("radius", self.radius);
        p.use_uniform("middle", to_gl_vector(self.centre));
        self.depths.bind_depths(p, "depths");
        self.shadow.bind_with_clip(p, &self.lights.key, clip);
        self.sky.bind(p);
        self.quad.draw(p, RenderStates::default(), pass.viewport);
    }

    fn draw_paper(&self, pass: &RenderPass, clip: Mat4) {
        let Some(creases) = &self.creases else {
            return;
        };
        let p = &self.paper;
        p.use_texture("creases", creases);
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("eye", to_gl_vector(pass.view.eye));
        p.use_uniform("mirrored", 0.0_f32);
        p.use_uniform("floorHeight", GROUND);
        p.use_uniform("span", three_d::Vec2::new(self.mesh.span.x, self.mesh.span.y));
        p.use_texture("ink", &self.ink);
        self.shadow.bind_with_clip(p, &self.lights.key, clip);
        self.sky.bind(p);
        p.use_vertex_attribute("position", &self.mesh.positions);
        p.use_vertex_attribute("normal", &self.mesh.normals);
        p.use_vertex_attribute("texcoord", &self.mesh.uvs);
        p.use_vertex_attribute("frayed", &self.mesh.frayed);
        // SAFETY: plain GL state, reset directly after the one draw call that needs it. Alpha to
        // coverage cuts the sawtooth ends of the paper out of the samples of a pixel.
        unsafe { self.context.enable(context::SAMPLE_ALPHA_TO_COVERAGE) };
        p.draw_elements(RenderStates::default(), pass.viewport, self.mesh.triangles(Detail::Full));
        // SAFETY: as above.
        unsafe { self.context.disable(context::SAMPLE_ALPHA_TO_COVERAGE) };
    }
}

/// The specified directional lights; the ambient light is in `sky_light.glsl`.
fn lights() -> Lights {
    Lights {
        key: Light::new(Vec3::new(6.0, 12.0, 8.0), 0xfff8ee, 1.2),
        fill: Light::new(Vec3::new(-6.0, 3.0, 8.0), 0xe0e8f0, 0.5),
        rim: Light::new(Vec3::new(-4.0, 6.0, -8.0), 0xffffff, 0.4),
    }
}

/// A push pin at a position of the paper.
fn pin(at: Vec3) -> Solid {
    let [from, to] = [0.02, 0.10].map(|out| at + Vec3::Z * out);
    Solid::capsule(from, to, 0.075, 0xc8402f)
}

/// Returns the print as a mipmapped texture with anisotropic filtering.
fn ink(context: &Context) -> Texture2D {
    let print = InkMap::new();
    let texture = Texture2D::new_empty::<u8>(
        context,
        print.size[0],
        print.size[1],
        Interpolation::Linear,
        Interpolation::Linear,
        Some(Mipmap { max_ratio: 16, ..Mipmap::default() }),
        Wrapping::ClampToEdge,
        Wrapping::ClampToEdge,
    );
    texture.fill(&print.ink);
    texture
}

/// Returns the linear colour that `daylight.frag` maps to the sRGB colour `0xrrggbb`.
fn invert_daylight_curve(srgb: u32) -> Vec3 {
    let unbent = |y: f32| if y < 0.7 { y } else { 0.7 - 0.3 * (1.0 - (y - 0.7) / 0.3).ln() };
    Vec3::from_array(linear(srgb).to_array().map(unbent)) / EXPOSURE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_backdrop_has_the_specified_colour_after_the_tone_curve() {
        let shoulder = |x: f32| x.min(0.7) + 0.3 * (1.0 - (-(x - 0.7).max(0.0) / 0.3).exp());
        for colour in [BACKDROP, 0x808080] {
            let wanted = linear(colour).to_array();
            for (light, wanted) in invert_daylight_curve(colour).to_array().into_iter().zip(wanted)
            {
                assert!((shoulder(light * EXPOSURE) - wanted).abs() < 1.0e-5);
            }
        }
    }

    #[test]
    fn the_key_light_has_the_specified_direction_and_colour() {
        let key = lights().key;
        assert!(key.towards.distance(Vec3::new(6.0, 12.0, 8.0).normalize()) < 1.0e-6);
        assert!(key.colour.distance(linear(0xfff8ee) * 1.2) < 1.0e-6);
        assert_eq!((SHADOW_SIZE, GROUND), (2048, -4.02));
    }
}
