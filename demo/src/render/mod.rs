//! The picture: cloths, their shadows and their reflections on a dark stage, from positions to pixels.
//!
//! Light is gathered in a linear, multisampled half-float target; [`post`] turns it into the
//! picture. Every shader is written for both desktop GL 3.3 and WebGL 2.

pub mod cloth_material;
pub mod desk;
pub mod fringe;
pub mod glow;
pub mod ground;
pub mod light;
pub mod mesh;
pub mod post;
pub mod shadow;
pub mod sky;
pub mod sky_light;
pub mod solid;
pub mod trail;
pub mod wireframe;

use glam::{Mat4, Vec3};
use three_d::{
    Blend, BlendEquationType, BlendMultiplierType, ClearState, ColorTarget, Context, CoreError,
    Program, RenderTarget, RenderTargetMultisample, VertexBuffer, Viewport, f16,
};

use crate::camera::Sight;
use crate::fabric::Look;
use cloth_material::Dye;
pub use mesh::Surface;

/// What a frame shows besides the cloths themselves.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// From where, and how wide.
    pub sight: Sight,
    /// How each of the cloths takes the light.
    pub looks: &'a [Look],
    /// What they hang on.
    pub solids: &'a [solid::Solid],
    /// The path of the blade.
    pub trail: &'a [trail::Spark],
    /// Whether the links are drawn over the dimmed cloth.
    pub wireframe: bool,
    /// The share of the output's pixels that are drawn along each side; the rest are blended.
    pub share: f32,
}

/// Everything on the graphics card; dropped and made anew when a context is lost.
pub struct Renderer {
    context: Context,
    lights: light::Lights,
    /// Those that were taken, then room for others.
    cloths: Vec<Taken>,
    shadow: shadow::Shadow,
    floor_shadow: shadow::Shadow,
    sky: sky::Sky,
    cloth: cloth_material::ClothMaterial,
    ground: ground::Ground,
    glow: glow::Glow,
    wireframe: wireframe::Wireframe,
    fringe: fringe::Fringe,
    trail: trail::Trail,
    solids: solid::Solids,
    post: post::Post,
    corners: Corners,
    target: Option<Target>,
}

/// A cloth on the graphics card.
struct Taken {
    mesh: mesh::Mesh,
    threads: fringe::Threads,
}

/// The linear picture while it is made: drawn multisampled, then resolved for [`post`].
struct Target {
    samples: RenderTargetMultisample<[f16; 4], f32>,
    resolved: three_d::Texture2D,
}

/// Texels along a side of the shadow map that the cloth itself reads.
const SHARP: u32 = 1024;
/// And of the one for the floor, whose shadows are far from what casts them and so softer.
const SOFT: u32 = 320;

/// How what the floor mirrors is blended over the backdrop.
const REFLECTION: Blend = Blend::Enabled {
    source_rgb_multiplier: BlendMultiplierType::SrcAlpha,
    source_alpha_multiplier: BlendMultiplierType::Zero,
    destination_rgb_multiplier: BlendMultiplierType::OneMinusSrcAlpha,
    destination_alpha_multiplier: BlendMultiplierType::One,
    rgb_equation: BlendEquationType::Add,
    alpha_equation: BlendEquationType::Add,
};

/// Samples per pixel.
const SAMPLES: u32 = 4;

impl Renderer {
    /// Compiles the shaders and makes the textures.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses a shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        Ok(Self {
            context: context.clone(),
            lights: light::Lights::default(),
            cloths: Vec::new(),
            shadow: shadow::Shadow::new(context, SHARP)?,
            floor_shadow: shadow::Shadow::new(context, SOFT)?,
            sky: sky::Sky::new(context)?,
            cloth: cloth_material::ClothMaterial::new(context)?,
            ground: ground::Ground::new(context)?,
            glow: glow::Glow::new(context)?,
            wireframe: wireframe::Wireframe::new(context)?,
            fringe: fringe::Fringe::new(context)?,
            trail: trail::Trail::new(context)?,
            solids: solid::Solids::new(context)?,
            post: post::Post::new(context)?,
            corners: Corners::new(context),
            target: None,
        })
    }

    /// There are so many cloths.
    pub fn expect(&mut self, count: usize) {
        let made = || Taken {
            mesh: mesh::Mesh::new(&self.context),
            threads: fringe::Threads::new(&self.context),
        };
        self.cloths.resize_with(count, made);
    }

    /// Takes the cloth of this number as it is now.
    pub fn take(&mut self, cloth: usize, surface: &Surface<'_>) {
        if let Some(taken) = self.cloths.get_mut(cloth) {
            taken.mesh.update(surface);
            taken.threads.update(surface);
        }
    }

    /// Draws one picture of what it was given into `output`, filling it.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses.
    pub fn draw(&mut self, frame: &Frame<'_>, output: &RenderTarget<'_>) -> Result<(), CoreError> {
        let side = |pixels: u32| (pixels as f32 * frame.share).round().max(1.0) as u32;
        let (width, height) = (side(output.width()), side(output.height()));
        Target::fit(&mut self.target, &self.context, width, height);
        let clip = self.lights.key.clip_from_world();
        for shadow in [&self.shadow, &self.floor_shadow] {
            let meshes = self.cloths.iter().map(|cloth| &cloth.mesh);
            shadow.draw(meshes, clip, &self.solids, frame.solids)?;
        }

        let Some(target) = &self.target else {
            return Ok(());
        };
        let dyes: Vec<_> = frame.looks.iter().map(|look| Dye::new(*look)).collect();
        let cloths = || self.cloths.iter().zip(&dyes);
        let pass = Pass {
            viewport: Viewport::new_at_origo(width, height),
            clip_from_world: frame.sight.clip_from_world(width as f32 / height as f32),
            sight: frame.sight,
            lights: self.lights,
        };
        target
            .samples
            .clear(ClearState::color_and_depth(0.0, 0.0, 0.0, 1.0, 1.0))
            .write::<CoreError>(|| {
                self.sky.draw(&pass, &self.corners);
                self.solids.draw_reflection(&pass, &self.shadow, frame.solids);
                for (cloth, dye) in cloths() {
                    self.cloth.draw_reflection(&pass, &cloth.mesh, &self.shadow, dye);
                }
                self.ground.draw(&pass, &self.corners, &self.floor_shadow);
                let dim = if frame.wireframe { 0.16 } else { 1.0 };
                self.solids.draw(&pass, &self.shadow, frame.solids, dim);
                for (cloth, dye) in cloths() {
                    self.cloth.draw(&pass, &cloth.mesh, &self.shadow, dye, dim);
                }
                for (cloth, dye) in cloths() {
                    self.fringe.draw(&pass, &cloth.threads, &self.shadow, dye, dim);
                    if frame.wireframe {
                        self.wireframe.draw(&pass, &cloth.mesh);
                    }
                }
                self.glow.draw(&pass, &self.corners);
                self.trail.draw(&pass, frame.trail);
                Ok(())
            })?;
        target.samples.resolve_color_to(&target.resolved.as_color_target(None));
        output.write::<CoreError>(|| {
            self.post.draw(output.viewport(), &self.corners, &target.resolved);
            Ok(())
        })?;
        Ok(())
    }

    /// The context that everything here lives in.
    pub fn context(&self) -> &Context {
        &self.context
    }
}

impl Target {
    /// Makes another target if the old one is of another size.
    fn fit(target: &mut Option<Self>, context: &Context, width: u32, height: u32) {
        let fits = target
            .as_ref()
            .is_some_and(|t| t.resolved.width() == width && t.resolved.height() == height);
        if !fits {
            // The old one goes first, so that two never share the card's memory.
            *target = None;
            *target = Some(Self {
                samples: RenderTargetMultisample::new(context, width, height, SAMPLES),
                resolved: post::linear_texture(context, width, height),
            });
        }
    }
}

/// A texture that a picture can be drawn into and read from: what `--shot` uses for a screen.
pub struct Canvas {
    colour: three_d::Texture2D,
    depth: three_d::DepthTexture2D,
}

impl Canvas {
    /// A canvas of `width` × `height` pixels.
    pub fn new(context: &Context, width: u32, height: u32) -> Self {
        use three_d::{DepthTexture2D, Interpolation::Nearest, Texture2D, Wrapping::ClampToEdge};
        Self {
            colour: Texture2D::new_empty::<[u8; 4]>(
                context,
                width,
                height,
                Nearest,
                Nearest,
                None,
                ClampToEdge,
                ClampToEdge,
            ),
            depth: DepthTexture2D::new::<f32>(context, width, height, ClampToEdge, ClampToEdge),
        }
    }

    /// Where to draw.
    pub fn target(&self) -> RenderTarget<'_> {
        RenderTarget::new(self.colour.as_color_target(None), self.depth.as_depth_target())
    }

    /// The pixels, top row first.
    pub fn pixels(&self) -> Vec<[u8; 4]> {
        let target: ColorTarget<'_> = self.colour.as_color_target(None);
        target.read()
    }
}

/// What every draw call of one picture shares.
pub(crate) struct Pass {
    viewport: Viewport,
    clip_from_world: Mat4,
    sight: Sight,
    lights: light::Lights,
}

impl Pass {
    fn aspect(&self) -> f32 {
        self.viewport.width as f32 / self.viewport.height as f32
    }
}

/// Two triangles over the square from -1 to 1.
pub(crate) struct Corners(VertexBuffer<[f32; 2]>);

impl Corners {
    fn new(context: &Context) -> Self {
        let (l, h) = (-1.0, 1.0);
        Self(VertexBuffer::new_with_data(
            context,
            &[[l, l], [h, l], [h, h], [l, l], [h, h], [l, h]],
        ))
    }

    fn draw(&self, program: &Program, states: three_d::RenderStates, viewport: Viewport) {
        program.use_vertex_attribute("corner", &self.0);
        program.draw_arrays(states, viewport, self.0.vertex_count());
    }
}

/// glam's matrix as three-d takes it.
pub(crate) fn matrix(m: Mat4) -> three_d::Mat4 {
    m.to_cols_array_2d().into()
}

/// glam's vector as three-d takes it.
pub(crate) fn vector(v: Vec3) -> three_d::Vec3 {
    v.to_array().into()
}
