//! Light of the sky: how open a place is to a few directions of it, each with a small depth map of the cloth.
//! It darkens what is hollow, and grounds what lies on the floor.

use glam::{Mat4, Vec3};
use three_d::{ClearState, Context, CoreError, DepthTexture2D, Program, Viewport};

use super::light::Light;
use super::mesh::Mesh;
use super::pass::{to_gl_matrix, to_gl_vector};
use super::shadow::{DepthProgram, depth_map, enable_depth_compare};

/// Directions, in a square of maps.
const SIDE: u32 = 2;
const COUNT: usize = (SIDE * SIDE) as usize;
/// Texels along a side of a map.
const TEXELS: u32 = 384;

/// The maps, and what fills them.
pub struct SkyLight {
    context: Context,
    depths: DepthProgram,
    maps: DepthTexture2D,
    towards: [Vec3; COUNT],
    clips: [Mat4; COUNT],
}

impl SkyLight {
    /// Empty maps.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        // Straight up, and three ways around at a third of that height.
        let around = |turn: f32| Vec3::new(turn.sin(), 0.62, turn.cos()).normalize();
        Ok(Self {
            context: context.clone(),
            depths: DepthProgram::new(context)?,
            maps: depth_map(context, SIDE * TEXELS),
            towards: [Vec3::Y, around(-0.5), around(1.6), around(3.7)],
            clips: [Mat4::IDENTITY; COUNT],
        })
    }

    /// Fills the maps with a cloth that is within `radius` of a place.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses.
    pub(super) fn draw(&mut self, mesh: &Mesh, centre: Vec3, radius: f32) -> Result<(), CoreError> {
        for (clip, towards) in self.clips.iter_mut().zip(self.towards) {
            let light = Light { towards, colour: Vec3::ONE };
            *clip = light.clip_around(centre, radius, 30.0, 0.0..60.0);
        }
        self.maps.as_depth_target().clear(ClearState::depth(1.0)).write::<CoreError>(|| {
            for (i, clip) in (0..).zip(self.clips) {
                let viewport = Viewport {
                    x: ((i % SIDE) * TEXELS) as i32,
                    y: ((i / SIDE) * TEXELS) as i32,
                    width: TEXELS,
                    height: TEXELS,
                };
                self.depths.draw(mesh, clip, viewport);
            }
            Ok(())
        })?;
        Ok(())
    }

    /// Hands the maps to a program that includes `sky_light.glsl`.
    pub(super) fn bind(&self, program: &Program) {
        program.use_uniform_array("skyFromWorld", &self.clips.map(to_gl_matrix));
        program.use_uniform_array("skyTowards", &self.towards.map(to_gl_vector));
        program.use_depth_texture("skyMaps", &self.maps);
        enable_depth_compare(&self.context);
    }
}
