//! Renderer of the cloth scenes: forward rendering with two shadow-casting lights.
//!
//! ```text
//! shadow maps ─▶ sky ─▶ reflections ─▶ ground ─▶ solids ─▶ cloth ─▶ threads, wireframe ─▶ glow, dust
//!       ─▶ glass ─▶ trail (multisampled HDR target) ─▶ resolve ─▶ post ─▶ output
//! ```
//! Method: passes write linear colours to a multisampled half-float target; [`post`] applies tone
//! mapping. All shaders run on OpenGL 3.3 and on WebGL 2.
//!
//! Reads [`ClothSurface`]s and a [`FrameScene`]; writes the pixels of the output target.
//!
//! Invariant: child modules import shared types from `pass` and `hdr_target`, never from this file.

mod canvas;
pub mod cloth_material;
pub mod dust;
pub mod fringe;
pub mod glass;
pub mod glow;
mod glsl;
pub mod ground;
mod halo;
mod hdr_target;
mod lazy_program;
pub mod light;
pub mod mesh;
mod pass;
pub mod post;
pub mod receipt_renderer;
pub mod shadow;
pub mod sky;
pub mod sky_light;
pub mod solid;
pub mod trail;
pub mod wireframe;

use three_d::{ClearState, Context, CoreError, RenderTarget, Viewport};

use crate::camera::CameraView;
use crate::fabric::Appearance;
pub use canvas::OffscreenCanvas;
use cloth_material::ClothAlbedo;
use hdr_target::HdrTarget;
use lazy_program::LazyProgram;
use light::Light;
pub use mesh::ClothSurface;
use mesh::Detail;
use pass::{RenderPass, UnitQuad};

/// The contents of a frame, except for the cloths.
#[derive(Clone, Copy, Debug)]
pub struct FrameScene<'a> {
    /// Camera view.
    pub view: CameraView,
    /// Appearance of each cloth.
    pub appearances: &'a [Appearance],
    /// Supports and obstacles.
    pub solids: &'a [solid::Solid],
    /// Trail of the blade.
    pub trail: &'a [trail::TrailPoint],
    /// Whether to draw the links over the dimmed cloth.
    pub wireframe: bool,
    /// Time of what moves by itself [s].
    pub time: f32,
    /// Velocity of the rain [m/s], if it rains.
    pub rain: Option<glam::Vec3>,
    /// Fraction of the output pixels to draw along each side; the result is scaled up.
    pub resolution_scale: f32,
    /// Whether to draw one sample per pixel, for slow machines; the first such frame has no
    /// reflections and no dust.
    pub is_low: bool,
}

/// All GPU resources of the cloth scenes; created again after a lost context.
pub struct Renderer {
    context: Context,
    lights: light::Lights,
    /// Buffers of each cloth.
    cloths: Vec<ClothBuffers>,
    shadow: shadow::ShadowMap,
    coarse_shadow: shadow::ShadowMap,
    rim_shadow: shadow::ShadowMap,
    sky: sky::Sky,
    cloth: cloth_material::ClothMaterial,
    ground: ground::Ground,
    glass: glass::Glass,
    glow: glow::Glow,
    dust: dust::Dust,
    wireframe: wireframe::Wireframe,
    fringe: fringe::Fringe,
    trail: trail::Trail,
    solids: solid::Solids,
    post: post::Post,
    quad: UnitQuad,
    target: Option<HdrTarget>,
    /// Whether a frame was drawn.
    has_drawn: bool,
}

/// GPU buffers of a cloth and of its frayed edges.
struct ClothBuffers {
    mesh: mesh::Mesh,
    threads: fringe::FrayedThreads,
}

/// Size of the key light's shadow map [texels].
const KEY_SHADOW_SIZE: u32 = 1536;
/// Size of the coarse depth map that measures how far shadows fall on the floor [texels].
const COARSE_SHADOW_SIZE: u32 = 256;
/// Size of the rim light's shadow map [texels].
const RIM_SHADOW_SIZE: u32 = 512;

impl Renderer {
    /// Compiles the shaders of the first frame and creates the textures.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses a shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let depths = shadow::DepthProgram::new(context)?;
        Ok(Self {
            context: context.clone(),
            lights: light::Lights::default(),
            cloths: Vec::new(),
            shadow: shadow::ShadowMap::new(context, &depths, KEY_SHADOW_SIZE),
            coarse_shadow: shadow::ShadowMap::new(context, &depths, COARSE_SHADOW_SIZE),
            rim_shadow: shadow::ShadowMap::new(context, &depths, RIM_SHADOW_SIZE),
            sky: sky::Sky::new(context)?,
            cloth: cloth_material::ClothMaterial::new(context)?,
            ground: ground::Ground::new(context)?,
            glass: glass::Glass::new(context),
            glow: glow::Glow::new(context)?,
            dust: dust::Dust::new(context)?,
            wireframe: wireframe::Wireframe::new(context),
            fringe: fringe::Fringe::new(context),
            trail: trail::Trail::new(context),
            solids: solid::Solids::new(context)?,
            post: post::Post::new(context)?,
            quad: UnitQuad::new(context),
            target: None,
            has_drawn: false,
        })
    }

    /// Sets the number of cloths; new ones are empty.
    pub fn set_cloth_count(&mut self, count: usize) {
        let made = || ClothBuffers {
            mesh: mesh::Mesh::new(&self.context),
            threads: fringe::FrayedThreads::new(&self.context),
        };
        self.cloths.resize_with(count, made);
    }

    /// Uploads the current state of the cloth with this index.
    pub fn upload_cloth(&mut self, cloth: usize, surface: &ClothSurface<'_>) {
        if let Some(uploaded) = self.cloths.get_mut(cloth) {
            uploaded.mesh.update(surface);
            uploaded.threads.update(surface);
        }
    }

    /// Draws all cloths and `frame` into the whole of `output`.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses.
    pub fn draw(
        &mut self,
        frame: &FrameScene<'_>,
        output: &RenderTarget<'_>,
    ) -> Result<(), CoreError> {
        let side = |pixels: u32| (pixels as f32 * frame.resolution_scale).round().max(1.0) as u32;
        let (width, height) = (side(output.width()), side(output.height()));
        self.prepare_program()?;
        HdrTarget::resize(&mut self.target, &self.context, [width, height], frame.is_low);
        let [key, rim] = [&self.lights.key, &self.lights.rim].map(Light::clip_from_world);
        let maps = [
            (&self.shadow, key, Detail::Full),
            (&self.coarse_shadow, key, Detail::Coarse),
            (&self.rim_shadow, rim, Detail::Coarse),
        ];
        for (shadow, clip, detail) in maps {
            let meshes = self.cloths.iter().map(|cloth| &cloth.mesh);
            shadow.draw(meshes, clip, detail, |viewport| {
                self.solids.draw_depth(clip, viewport, frame.solids);
            })?;
        }

        let Some(target) = &self.target else {
            return Ok(());
        };
        let albedos: Vec<_> =
            frame.appearances.iter().map(|appearance| ClothAlbedo::new(*appearance)).collect();
        let cloths = || self.cloths.iter().zip(&albedos);
        let pass = RenderPass {
            viewport: Viewport::new_at_origo(width, height),
            clip_from_world: frame.view.clip_from_world(width as f32 / height as f32),
            view: frame.view,
            lights: self.lights,
        };
        let shadows = [&self.shadow, &self.rim_shadow];
        let halos = halo::halos(&frame.view, frame.time);
        // Their programs and pipelines are compiled when they are first drawn.
        let is_plain = frame.is_low && !self.has_drawn;
        let dim = if frame.wireframe { 0.16 } else { 1.0 };
        target
            .samples
            .clear(ClearState::color_and_depth(0.0, 0.0, 0.0, 1.0, 1.0))
            .write::<CoreError>(|| {
                self.sky.draw(&pass, &self.quad);
                if !is_plain {
                    self.solids.draw_reflection(&pass, &self.shadow, frame.solids);
                    for (cloth, albedo) in cloths() {
                        self.cloth.draw_reflection(&pass, &cloth.mesh, shadows, albedo);
                    }
                }
                self.ground.draw(
                    &pass,
                    &self.quad,
                    &self.shadow,
                    &self.coarse_shadow,
                    frame.solids,
                    &halos,
                );
                self.solids.draw(&pass, &self.shadow, frame.solids, dim);
                for (cloth, albedo) in cloths() {
                    self.cloth.draw(&pass, &cloth.mesh, shadows, albedo, dim);
                }
                for (cloth, albedo) in cloths() {
                    self.fringe.draw(&pass, &cloth.threads, &self.shadow, albedo, dim)?;
                    if frame.wireframe {
                        self.wireframe.draw(&pass, &cloth.mesh)?;
                    }
                }
                self.glow.draw(&pass, &self.quad, &halos);
                if !is_plain {
                    self.dust.draw(&pass, frame.time);
                }
                if let Some(velocity) = frame.rain {
                    self.dust.draw_rain(&pass, velocity, frame.time)?;
                }
                Ok(())
            })?;
        // Glass refracts the picture without it.
        let has_glass = frame.solids.iter().any(|solid| solid.is_glass);
        if has_glass {
            target.samples.resolve_color_to(&target.resolved.as_color_target(None));
        }
        target.samples.write::<CoreError>(|| {
            if has_glass {
                let sources = (&self.shadow, &target.resolved);
                self.glass.draw(&pass, &self.solids, frame.solids, sources, dim)?;
            }
            self.trail.draw(&pass, frame.trail)
        })?;
        target.samples.resolve_color_to(&target.resolved.as_color_target(None));
        output.write::<CoreError>(|| {
            self.post.draw(output.viewport(), &self.quad, &target.resolved);
            Ok(())
        })?;
        self.has_drawn = true;
        Ok(())
    }

    /// Compiles one of the programs that the frames so far did not need, except before the first
    /// frame.
    fn prepare_program(&self) -> Result<(), CoreError> {
        let Self { glass, wireframe, fringe, trail, dust, .. } = self;
        let programs =
            [&fringe.program, &trail.program, &wireframe.program, &glass.program, &dust.rain];
        let is_waiting = |program: &&&LazyProgram| !program.is_ready();
        match programs.iter().find(is_waiting) {
            Some(program) if self.has_drawn => program.get().map(|_| ()),
            _ => Ok(()),
        }
    }

    /// Returns the context of the GPU resources.
    pub fn context(&self) -> &Context {
        &self.context
    }
}
