//! Wind: the air around a cloth.

use super::value::MuslinVec3;
use crate::status::{CallError, Result};
use muslin_core::{Wind, WindModel};

/// Aerodynamic forces on each triangle, proportional to the square of the relative air speed. Still
/// air damps the motion.
pub const MUSLIN_WIND_SURFACE: u32 = 0;
/// A field of sine waves that accelerates each particle, independent of the direction of the
/// surface. The length of `velocity` is the strength [m/s^2].
pub const MUSLIN_WIND_SINE_FIELD: u32 = 1;

/// The air around a cloth: steady wind with gusts, changing direction and turbulence. Equal seeds
/// give equal gusts. Initialise it with muslin_wind_init, which describes still air.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinWind {
    /// Set by muslin_wind_init.
    pub struct_size: u32,
    /// Model: MUSLIN_WIND_SURFACE (default) or MUSLIN_WIND_SINE_FIELD.
    pub model: u32,
    /// Mean velocity of the air [m/s]. Default 0, 0, 0.
    pub velocity: MuslinVec3,
    /// Variation of the speed over time, as a share of it. Default 0. From 0 to 1.
    pub gust: f32,
    /// Variation of the direction over time [rad]. Default 0. From 0 to pi.
    pub wander: f32,
    /// Variation of the air velocity in space, as a share of the speed. Default 0. From 0 to 1.
    pub turbulence: f32,
    /// Density of the air [kg/m^3]. Default 1.2. At least 0; 0 is a vacuum.
    pub air_density: f32,
    /// Selects the sequence of gusts and turbulence. Default 0.
    pub seed: u32,
}

impl Default for MuslinWind {
    fn default() -> Self {
        Self::from(&Wind::default())
    }
}

impl From<&Wind> for MuslinWind {
    fn from(wind: &Wind) -> Self {
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
