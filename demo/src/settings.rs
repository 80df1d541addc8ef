//! Settings of the cloth scenes: the values of the controls.
//!
//! Method: a serde document in JSON; unknown fields are ignored and missing ones get their
//! defaults.
//!
//! Reads and writes JSON text; the platform stores it.
//!
//! Invariant: after [`Settings::clamp`] every value is in its range.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::fabric::Fabric;
use crate::scene_kind::SceneKind;

/// Range of the wind, relative to the air speed of the scene.
pub const WIND: RangeInclusive<f32> = 0.0..=3.0;
/// Range of gravity [m/s²].
pub const GRAVITY: RangeInclusive<f32> = 0.0..=20.0;
/// Range of the stiffness: solver iterations per substep.
pub const STIFFNESS: RangeInclusive<f32> = 1.0..=12.0;
/// Range of the damping: fraction of its velocity that a particle loses in 1/60 s.
pub const DAMPING: RangeInclusive<f32> = 0.0..=0.06;
/// Allowed numbers of particles along a side.
pub const RESOLUTIONS: [u32; 5] = [24, 40, 56, 96, 128];

/// Which particles are pinned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pinning {
    /// The whole top row.
    #[default]
    TopEdge,
    /// The two ends of the top row.
    TopCorners,
    /// All four corners.
    Corners,
}

/// Values of the controls.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Strength of the wind, in [`WIND`].
    pub wind: f32,
    /// Gravity, downwards [m/s²], in [`GRAVITY`].
    pub gravity: f32,
    /// Solver iterations per substep, in [`STIFFNESS`].
    pub stiffness: u32,
    /// Fraction of the velocity lost in 1/60 s, in [`DAMPING`].
    pub damping: f32,
    /// Whether the links are drawn over the cloth.
    pub wireframe: bool,
    /// Whether overstretched links tear.
    pub tearing: bool,
    /// Whether pointers cut instead of grabbing.
    pub blade: bool,
    /// Whether the simulation is paused.
    pub paused: bool,
    /// The scene.
    pub scene: SceneKind,
    /// Fabric of the cloth.
    pub fabric: Fabric,
    /// Which particles are pinned.
    pub pinning: Pinning,
    /// Particles along a side, one of [`RESOLUTIONS`].
    pub resolution: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            wind: 0.8,
            gravity: 9.8,
            stiffness: 6,
            damping: 0.012,
            wireframe: false,
            tearing: false,
            blade: false,
            paused: false,
            scene: SceneKind::Sheet,
            fabric: Fabric::Silk,
            pinning: Pinning::TopEdge,
            resolution: 40,
        }
    }
}

impl Settings {
    /// Parses the text of [`Settings::to_json`] and clamps the values.
    ///
    /// # Errors
    /// The parse error of a text that is no such document; the caller then uses the defaults.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        let mut settings: Self = serde_json::from_str(text)?;
        settings.clamp();
        Ok(settings)
    }

    /// Returns the values as a JSON document.
    pub fn to_json(&self) -> String {
        // Numbers, booleans and unit variants only, so the conversion cannot fail.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Clamps every value to its range; a value that is not finite gets its default.
    pub fn clamp(&mut self) {
        let usual = Self::default();
        let keep = |value: f32, range: RangeInclusive<f32>, usual: f32| {
            if value.is_finite() { value.clamp(*range.start(), *range.end()) } else { usual }
        };
        self.wind = keep(self.wind, WIND, usual.wind);
        self.gravity = keep(self.gravity, GRAVITY, usual.gravity);
        self.damping = keep(self.damping, DAMPING, usual.damping);
        self.stiffness = self.stiffness.clamp(*STIFFNESS.start() as u32, *STIFFNESS.end() as u32);
        if !RESOLUTIONS.contains(&self.resolution) {
            self.resolution = usual.resolution;
        }
    }

    /// Converts [`Settings::damping`] to the damping rate of Muslin [1/s].
    pub fn damping_rate(&self) -> f32 {
        -(1.0 - self.damping).ln() * 60.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_equal_after_writing_and_reading() {
        let settings = Settings {
            wind: 2.25,
            tearing: true,
            fabric: Fabric::Denim,
            pinning: Pinning::Corners,
            resolution: 56,
            ..Settings::default()
        };
        assert_eq!(Settings::from_json(&settings.to_json()).unwrap(), settings);
    }

    #[test]
    fn values_out_of_range_are_clamped() {
        let text =
            r#"{"wind": 99, "gravity": -4, "stiffness": 0, "damping": 1, "resolution": 4096}"#;
        let settings = Settings::from_json(text).unwrap();
        assert_eq!((settings.wind, settings.gravity), (3.0, 0.0));
        assert_eq!((settings.stiffness, settings.damping), (1, 0.06));
        assert_eq!(settings.resolution, 40);
        let mut wild = Settings { wind: f32::NAN, ..Settings::default() };
        wild.clamp();
        assert_eq!(wild, Settings::default());
    }

    #[test]
    fn a_missing_value_gets_its_default_and_a_corrupt_document_is_an_error() {
        let settings = Settings::from_json(r#"{"wind": 1.5, "from_the_future": true}"#).unwrap();
        assert_eq!(settings.wind, 1.5);
        assert_eq!(settings.gravity, Settings::default().gravity);
        for text in ["", "{", "null", "3", r#"{"wind": "strong"}"#, r#"{"pinning": "glue"}"#] {
            assert!(Settings::from_json(text).is_err(), "{text:?} was taken");
        }
    }

    #[test]
    fn the_damping_rate_removes_the_set_fraction_in_a_sixtieth_of_a_second() {
        let settings = Settings { damping: 0.03, ..Settings::default() };
        let left = (-settings.damping_rate() / 60.0).exp();
        assert!((left - 0.97).abs() < 1.0e-6, "{left} is left");
    }
}
