//! Halos of the lights: where they stand, and how bright they are in a frame.
//!
//! Method: a table of lamps on both sides of the stage; those beyond it are visible, and all
//! breathe slowly.
//!
//! Reads the camera view and the time; returns [`Halo`]s.
//!
//! Invariant: no halo is between the camera and the stage.

use std::f32::consts::TAU;

use glam::Vec3;

use super::light::{STAGE_CENTRE, linear};
use crate::camera::CameraView;

/// Share by which the halos get brighter and darker, and the period of that [s].
const BREATH: f32 = 0.10;
const BREATH_PERIOD: f32 = 7.0;

/// A halo as a light stand has it.
struct Lamp {
    /// Position relative to the stage [m].
    place: Vec3,
    /// Radius [m].
    radius: f32,
    /// Colour, `0xrrggbb`, its brightness, and that of the white core.
    colour: u32,
    brightness: f32,
    core: f32,
}

const fn lamp(place: [f32; 3], radius: f32, colour: u32, brightness: f32, core: f32) -> Lamp {
    Lamp { place: Vec3::from_array(place), radius, colour, brightness, core }
}

/// Warm behind the key light, cool behind the fill light, ember behind the rim light; then key,
/// fill and rim as they are seen from behind the stage.
const PLACES: [Lamp; LAMPS] = [
    lamp([-2.30, 1.15, -2.0], 2.7, 0xffb866, 0.24, 0.16),
    lamp([0.75, -0.20, -2.4], 3.4, 0x3558ff, 0.13, 0.0),
    lamp([2.00, 0.85, -2.0], 2.4, 0xff5a1e, 0.24, 0.06),
    lamp([2.20, 1.30, 2.3], 2.7, 0xffb866, 0.20, 0.12),
    lamp([-0.60, -0.10, 2.5], 3.4, 0x3558ff, 0.12, 0.0),
    lamp([-2.30, 0.50, 2.2], 2.2, 0xff5a1e, 0.12, 0.04),
];

/// Number of lamps: the most halos that a frame has.
pub(super) const LAMPS: usize = 6;

/// A halo in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Halo {
    /// Centre [m].
    pub centre: Vec3,
    /// Radius [m].
    pub radius: f32,
    /// Linear colour.
    pub tint: Vec3,
    /// Brightness of the white core.
    pub core: f32,
}

/// Returns the halos that a camera sees at `time` [s]: those beyond the stage.
pub(super) fn halos(view: &CameraView, time: f32) -> Vec<Halo> {
    let forward = view.forward();
    let shine = |(i, lamp): (usize, &Lamp)| {
        let behind = (lamp.place.dot(forward) / 1.2).clamp(0.0, 1.0);
        let turn = TAU * (time / BREATH_PERIOD + 0.31 * i as f32);
        let share = behind * (1.0 + BREATH * turn.sin());
        (behind > 0.0).then(|| Halo {
            centre: STAGE_CENTRE + lamp.place,
            radius: lamp.radius,
            tint: linear(lamp.colour) * lamp.brightness * share,
            core: lamp.core * share,
        })
    };
    PLACES.iter().enumerate().filter_map(shine).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;

    #[test]
    fn halos_are_seen_behind_the_stage_and_not_in_front_of_it() {
        let view = Camera::default().view();
        let halos = halos(&view, 0.0);
        assert_eq!(halos.len(), PLACES.len() / 2);
        for halo in halos {
            let depth = (halo.centre - STAGE_CENTRE).dot(view.forward());
            assert!(depth > 0.0 && halo.tint.max_element() > 0.05, "{halo:?} at {depth} m");
        }
    }

    #[test]
    fn halos_breathe_by_a_tenth() {
        let view = Camera::default().view();
        let brightness = (0..70).map(|i| halos(&view, 0.1 * i as f32)[0].tint.x);
        let (low, high) =
            brightness.fold((f32::MAX, 0.0_f32), |(low, high), x| (low.min(x), high.max(x)));
        assert!((high / low - 1.1 / 0.9).abs() < 0.01, "from {low} to {high}");
    }
}
