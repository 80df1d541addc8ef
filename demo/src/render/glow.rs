//! Light halos: additive billboards with one radial texture.
//!
//! Method: one quad per halo, parallel to the screen, blended additively.
//!
//! Reads the camera view; writes the current colour target.
//!
//! Invariant: the texture is zero at its border, so that the quad is not visible.

use glam::Vec3;
use three_d::{
    Blend, Context, CoreError, CpuTexture, Interpolation, Program, RenderStates, Texture2D,
    TextureData, Wrapping, WriteMask,
};

use super::light::{STAGE_CENTRE, linear};
use super::pass::{RenderPass, UnitQuad, to_gl_matrix, to_gl_vector};

/// Size of the radial texture [texels].
const SIZE: u32 = 128;

/// Centre [m], radius [m] and colour of a halo.
struct Halo {
    centre: Vec3,
    radius: f32,
    tint: Vec3,
}

/// The halos with their texture and shader program.
pub struct Glow {
    program: Program,
    texture: Texture2D,
    halos: [Halo; 3],
}

impl Glow {
    /// Generates the texture and compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses the shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let texture = CpuTexture {
            name: "halo".into(),
            data: TextureData::RU8(radial()),
            width: SIZE,
            height: SIZE,
            min_filter: Interpolation::Linear,
            mag_filter: Interpolation::Linear,
            mipmap: None,
            wrap_s: Wrapping::ClampToEdge,
            wrap_t: Wrapping::ClampToEdge,
        };
        Ok(Self {
            program: Program::from_source(
                context,
                include_str!("shaders/glow.vert"),
                include_str!("shaders/glow.frag"),
            )?,
            texture: Texture2D::new(context, &texture),
            halos: [
                Halo {
                    centre: STAGE_CENTRE + Vec3::new(-2.3, 1.5, -1.6),
                    radius: 2.6,
                    tint: linear(0xfff1dc) * 0.011,
                },
                Halo {
                    centre: STAGE_CENTRE + Vec3::new(0.2, 0.1, -1.8),
                    radius: 3.4,
                    tint: linear(0x3a5cff) * 0.026,
                },
                Halo {
                    centre: STAGE_CENTRE + Vec3::new(2.1, 0.7, -2.0),
                    radius: 2.2,
                    tint: linear(0xff9d5c) * 0.022,
                },
            ],
        })
    }

    pub(super) fn draw(&self, pass: &RenderPass, quad: &UnitQuad) {
        let p = &self.program;
        let (right, up) = (pass.view.right(), pass.view.up());
        for halo in &self.halos {
            p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
            p.use_uniform("centre", to_gl_vector(halo.centre));
            p.use_uniform("right", to_gl_vector(right * halo.radius));
            p.use_uniform("up", to_gl_vector(up * halo.radius));
            p.use_uniform("tint", to_gl_vector(halo.tint));
            p.use_texture("halo", &self.texture);
            let states = RenderStates {
                blend: Blend::ADD,
                write_mask: WriteMask::COLOR,
                ..RenderStates::default()
            };
            quad.draw(p, states, pass.viewport);
        }
    }
}

/// Returns a disc that fades smoothly to zero at its border.
fn radial() -> Vec<u8> {
    let middle = 0.5 * (SIZE - 1) as f32;
    let texel = |i: u32| {
        let x = ((i % SIZE) as f32 - middle) / middle;
        let y = ((i / SIZE) as f32 - middle) / middle;
        let fall = (1.0 - (x * x + y * y).sqrt()).clamp(0.0, 1.0);
        (255.0 * fall * fall * (3.0 - 2.0 * fall)).round() as u8
    };
    (0..SIZE * SIZE).map(texel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_halo_is_bright_at_its_centre_and_zero_at_its_border() {
        let texture = radial();
        let (size, half) = (SIZE as usize, SIZE as usize / 2);
        assert!(texture[half * size + half] > 250);
        assert!((0..size).all(|i| texture[i] == 0 && texture[i * size] == 0));
    }
}
