//! Ambient occlusion from the sky: visibility of four directions, each by a small depth map.
//!
//! Method: a 2 × 2 atlas of orthographic depth maps; `sky_light.glsl` weights them by the surface
//! normal. Concave parts and contacts with the floor get darker.
//!
//! Reads a [`Mesh`]; writes the depth atlas.
//!
//! Invariant: the light matrices in the shader are the ones that the maps were drawn with.

use std::rc::Rc;

use glam::{Mat4, Vec3};
use three_d::{ClearState, Context, CoreError, DepthTexture2D, Program, Viewport};

use super::light::Light;
use super::mesh::{Detail, Mesh};
use super::pass::{to_gl_matrix, to_gl_vector};
use super::shadow::{DepthProgram, depth_map, enable_depth_compare};

/// Maps per side of the atlas.
const SIDE: u32 = 2;
const COUNT: usize = (SIDE * SIDE) as usize;
/// Size of one map [texels].
const TEXELS: u32 = 384;

/// Depth atlas with its directions and light matrices.
pub struct SkyLight {
    context: Context,
    depths: Rc<DepthProgram>,
    maps: DepthTexture2D,
    towards: [Vec3; COUNT],
    clips: [Mat4; COUNT],
}

impl SkyLight {
    /// Creates empty maps, which `depths` fills.
    pub(super) fn new(context: &Context, depths: &Rc<DepthProgram>) -> Self {
        // One direction nearly straight up, so that hanging paper is not seen edge-on, and three
        // inclined ones around it.
        let around = |turn: f32| Vec3::new(turn.sin(), 0.62, turn.cos()).normalize();
        Self {
            context: context.clone(),
            depths: depths.clone(),
            maps: depth_map(context, SIDE * TEXELS),
            towards: [
                Vec3::new(-0.2, 1.0, 0.3).normalize(),
                around(-0.5),
                around(1.6),
                around(3.7),
            ],
            clips: [Mat4::IDENTITY; COUNT],
        }
    }

    /// Draws the maps for a cloth within `radius` of `centre`.
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
                self.depths.draw(mesh, clip, Detail::Full, viewport);
            }
            Ok(())
        })?;
        Ok(())
    }

    /// Binds the maps to a program that includes `sky_light.glsl`.
    pub(super) fn bind(&self, program: &Program) {
        program.use_uniform_array("skyFromWorld", &self.clips.map(to_gl_matrix));
        program.use_uniform_array("skyTowards", &self.towards.map(to_gl_vector));
        program.use_depth_texture("skyMaps", &self.maps);
        enable_depth_compare(&self.context);
    }
}
