//! The air around a cloth.

use super::value::MuslinVec3;
use crate::status::{CallError, Result};
use muslin_core::{Wind, WindModel};

/// The air pushes each triangle along its normal, by the square of the relative speed; still air
/// brakes.
pub const MUSLIN_WIND_SURFACE: u32 = 0;
/// The air pushes each particle as a field of sine waves, whichever way the cloth faces. The length
/// of `velocity` is its strength as an acceleration [m/s^2].
pub const MUSLIN_WIND_SINE_FIELD: u32 = 1;

/// The air around a cloth. It gusts, wanders and swirls, always the same way for the same seed.
/// Begin with muslin_wind_init: still air.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinWind {
    /// Set by muslin_wind_init.
    pub struct_size: u32,
    /// How the air pushes: MUSLIN_WIND_SURFACE (this at first) or MUSLIN_WIND_SINE_FIELD.
    pub model: u32,
    /// Mean velocity of the air [m/s]; 0, 0, 0.
    pub velocity: MuslinVec3,
    /// How much the speed swells and falls, as a share of it; 0. From 0 to 1.
    pub gust: f32,
    /// How far the direction strays [rad]; 0. From 0 to pi.
    pub wander: f32,
    /// Swirls in space, as a share of the speed; 0. From 0 to 1.
    pub turbulence: f32,
    /// Density of the air [kg/m^3]; 1.2. At least 0; 0 is a vacuum.
    pub air_density: f32,
    /// Which gusts and swirls; 0.
    pub seed: u32,
}

impl Default for MuslinWind {
    fn default() -> Self {
        let wind = Wind::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            model: wind.model as u32,
            velocity: wind.velocity.into(),
            gust: wind.gust,
            wander: wind.wander,
            turbulence: wind.turbulence,
            air_density: wind.air_density,
            seed: wind.seed,
        }
    }
}

impl TryFrom<MuslinWind> for Wind {
    type Error = CallError;

    fn try_from(wind: MuslinWind) -> Result<Self> {
        let model = match wind.model {
            MUSLIN_WIND_SURFACE => WindModel::Surface,
            MUSLIN_WIND_SINE_FIELD => WindModel::SineField,
            _ => return Err(CallError::bad_value("wind.model", "be one of MUSLIN_WIND_...")),
        };
        Ok(Self {
            model,
            velocity: wind.velocity.into(),
            gust: wind.gust,
            wander: wind.wander,
            turbulence: wind.turbulence,
            air_density: wind.air_density,
            seed: wind.seed,
        })
    }
}
