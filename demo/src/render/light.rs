//! Lights of a scene, and conversion of sRGB colours to linear values.
//!
//! Method: three directional lights (key, fill, rim); the sRGB transfer function of IEC 61966-2-1;
//! the filmic curve of Narkowicz (2015), inverted by bisection.
//!
//! Reads colours `0xrrggbb`; returns linear RGB and light matrices.
//!
//! Invariant: light directions have unit length and point from the scene to the light.

use std::ops::Range;

use glam::camera::rh::{proj, view};
use glam::{Mat4, Vec3};

/// Centre of the hanging sheet, and default target of the camera [m].
pub const STAGE_CENTRE: Vec3 = Vec3::new(0.0, -0.08, 0.0);

pub use muslin_scenes::FLOOR;

/// Radius around [`STAGE_CENTRE`] that the shadow map covers [m].
pub const STAGE_RADIUS: f32 = 2.7;

/// Distances from the eye of a light that its shadow map covers [m].
pub const STAGE_DEPTH: Range<f32> = 0.5 * STAGE_RADIUS..4.0 * STAGE_RADIUS;

/// A directional light.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Unit vector from the scene to the light.
    pub towards: Vec3,
    /// Linear colour times intensity.
    pub colour: Vec3,
}

/// Key, fill and rim light.
#[derive(Clone, Copy, Debug)]
pub struct Lights {
    /// Key light; casts shadows on everything.
    pub key: Light,
    /// Fill light, which brightens the shaded side.
    pub fill: Light,
    /// Rim light from behind, which brightens the silhouette; casts shadows on cloth.
    pub rim: Light,
}

impl Default for Lights {
    fn default() -> Self {
        Self {
            key: Light::new(Vec3::new(-1.0, 1.25, 1.05), 0xffead2, 2.3),
            fill: Light::new(Vec3::new(1.2, 0.25, 0.8), 0x829aff, 0.36),
            rim: Light::new(Vec3::new(0.85, 0.75, -1.25), 0xff8a50, 2.4),
        }
    }
}

impl Light {
    /// Creates a light from its direction, its colour `0xrrggbb` and its intensity.
    pub fn new(towards: Vec3, colour: u32, intensity: f32) -> Self {
        Self { towards: towards.normalize(), colour: linear(colour) * intensity }
    }

    /// Returns the orthographic light matrix that covers the stage.
    pub fn clip_from_world(&self) -> Mat4 {
        self.clip_around(STAGE_CENTRE, STAGE_RADIUS, 2.0 * STAGE_RADIUS, STAGE_DEPTH)
    }

    /// Returns the orthographic light matrix that covers a sphere; the eye is `away` [m] from its
    /// centre.
    pub fn clip_around(&self, centre: Vec3, radius: f32, away: f32, depth: Range<f32>) -> Mat4 {
        let eye = centre + self.towards * away;
        let up = if self.towards.y.abs() > 0.99 { Vec3::Z } else { Vec3::Y };
        let view = view::look_at_mat4(eye, centre, up);
        let r = radius;
        proj::opengl::orthographic(-r, r, -r, r, depth.start, depth.end) * view
    }
}

/// Converts an sRGB colour `0xrrggbb` to linear RGB.
pub fn linear(srgb: u32) -> Vec3 {
    let channel = |shift: u32| {
        let c = ((srgb >> shift) & 0xff) as f32 / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    Vec3::new(channel(16), channel(8), channel(0))
}

/// Returns the linear colour that the tone curve maps to the sRGB colour `0xrrggbb`.
///
/// The backdrop is specified by its final colour, so the curve must be inverted.
pub fn invert_tone_curve(srgb: u32) -> Vec3 {
    let wanted = linear(srgb).to_array();
    Vec3::from_array(wanted.map(|wanted| {
        let (mut low, mut high) = (0.0_f32, 64.0_f32);
        for _ in 0..48 {
            let middle = 0.5 * (low + high);
            if tone_curve(middle) < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }))
}

/// The filmic tone curve of `post.frag`: Narkowicz's fit of the ACES reference transform (2015).
fn tone_curve(x: f32) -> f32 {
    let x = x * 0.62;
    ((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_of_the_tone_curve_is_exact() {
        for colour in [0x05070d, 0x0b1020, 0x9fb6ff] {
            let out = invert_tone_curve(colour).to_array().map(tone_curve);
            let wanted = linear(colour).to_array();
            for (out, wanted) in out.iter().zip(wanted) {
                assert!((out - wanted).abs() < 1.0e-4, "{out} for {wanted}");
            }
        }
    }

    #[test]
    fn the_stage_fits_into_the_shadow_map() {
        let clip = Lights::default().key.clip_from_world();
        for corner in [Vec3::new(-1.0, 1.0, 0.0), Vec3::new(1.0, FLOOR, 0.6)] {
            let at = clip.project_point3(corner);
            assert!(at.abs().max_element() < 1.0, "{corner} lands at {at}");
        }
    }
}
