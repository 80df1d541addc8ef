//! What the user may change: validated, clamped, and kept between visits.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::fabric::Fabric;
use crate::scene_kind::SceneKind;

/// Wind, as a share of a fresh breeze.
pub const WIND: RangeInclusive<f32> = 0.0..=3.0;
/// Gravity [m/s²].
pub const GRAVITY: RangeInclusive<f32> = 0.0..=20.0;
/// Stiffness: sweeps over the links.
pub const STIFFNESS: RangeInclusive<f32> = 1.0..=12.0;
/// Damping: the share of its velocity that a particle loses in a sixtieth of a second.
pub const DAMPING: RangeInclusive<f32> = 0.0..=0.06;
/// Particles along a side of the sheet.
pub const RESOLUTIONS: [u32; 5] = [24, 40, 56, 96, 128];

/// Which particles hold the sheet up.
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

/// The controls' values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Strength of the wind, in [`WIND`].
    pub wind: f32,
    /// Downwards [m/s²], in [`GRAVITY`].
    pub gravity: f32,
    /// Sweeps over the links, in [`STIFFNESS`].
    pub stiffness: u32,
    /// Share of velocity lost each sixtieth of a second, in [`DAMPING`].
    pub damping: f32,
    /// Links are drawn over the cloth.
    pub wireframe: bool,
    /// Over-stretched links tear.
    pub tearing: bool,
    /// Pointers cut instead of grabbing.
    pub blade: bool,
    /// Time stands still.
    pub paused: bool,
    /// What is on the stage.
    pub scene: SceneKind,
    /// What its cloth is of.
    pub fabric: Fabric,
    /// What holds the sheet up.
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
    /// Reads what [`Settings::to_json`] wrote; values out of range are brought into it.
    ///
    /// # Errors
    /// What is wrong with the text, if it is not such a document; use the defaults then.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        let mut settings: Self = serde_json::from_str(text)?;
        settings.clamp();
        Ok(settings)
    }

    /// The values as a JSON document.
    pub fn to_json(&self) -> String {
        // Numbers, booleans and unit variants: there is nothing in it that JSON could not say.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Brings every value into its range; what is no number becomes the default.
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

    /// [`Settings::damping`] as the rate that Muslin takes [1/s].
    pub fn damping_rate(&self) -> f32 {
        -(1.0 - self.damping).ln() * 60.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_survive_writing_and_reading() {
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
    fn values_out_of_range_are_brought_into_it() {
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
    fn a_missing_value_is_the_usual_one_and_a_corrupt_document_is_refused() {
        let settings = Settings::from_json(r#"{"wind": 1.5, "from_the_future": true}"#).unwrap();
        assert_eq!(settings.wind, 1.5);
        assert_eq!(settings.gravity, Settings::default().gravity);
        for text in ["", "{", "null", "3", r#"{"wind": "strong"}"#, r#"{"pinning": "glue"}"#] {
            assert!(Settings::from_json(text).is_err(), "{text:?} was taken");
        }
    }

    #[test]
    fn damping_loses_its_share_every_sixtieth() {
        let settings = Settings { damping: 0.03, ..Settings::default() };
        let left = (-settings.damping_rate() / 60.0).exp();
        assert!((left - 0.97).abs() < 1.0e-6, "{left} is left");
    }
}
