//! Wind: a mean velocity with gusts, changes of direction and turbulence, all functions of time and
//! seed.
//!
//! Gusts and direction are sums of sines in time; turbulence is a sum of sines in space and time.
//! No random state: equal time and seed give equal wind on every platform.

use crate::error::{Result, check, check_finite};
use crate::math::hasher::unit;
use crate::math::trig::{cos, remainder, sin, sin_branchless};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// How the wind acts on the cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum WindModel {
    /// Aerodynamic pressure on each triangle: drag along its normal and lift, quadratic in the
    /// relative speed. Still air slows the cloth.
    #[default]
    Surface = 0,
    /// An acceleration of each particle from a field of sine waves, independent of the orientation
    /// of the cloth (the wind of the receipt demo). The length of `velocity` is its strength
    /// [m/s²].
    SineField = 1,
}

/// The wind. The default is still air.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Wind {
    /// How the wind acts. Default: on surfaces.
    pub model: WindModel,
    /// Mean velocity of the air [m/s]. Default: zero.
    pub velocity: Vec3,
    /// Amplitude of gusts, as a share of the speed, 0 to 1. Default: 0.
    pub gust: f32,
    /// Amplitude of changes of direction [rad], 0 to π. Default: 0.
    pub wander: f32,
    /// Amplitude of turbulence in space, as a share of the speed, 0 to 1. Default: 0.
    pub turbulence: f32,
    /// Density of the air [kg/m³], at least 0; 0 = vacuum. Default: 1.2.
    pub air_density: f32,
    /// Seed that selects the sequence of gusts and turbulence. Default: 0.
    pub seed: u32,
}

impl Default for Wind {
    fn default() -> Self {
        Self {
            model: WindModel::Surface,
            velocity: Vec3::ZERO,
            gust: 0.0,
            wander: 0.0,
            turbulence: 0.0,
            air_density: 1.2,
            seed: 0,
        }
    }
}

impl Wind {
    /// Refuses values that are out of range.
    pub(crate) fn check(&self) -> Result<()> {
        check_finite(self.velocity, "wind.velocity")?;
        let share = |v: f32| (0.0..=1.0).contains(&v);
        check(share(self.gust), "wind.gust", "be from 0 to 1")?;
        check(
            (0.0..=core::f32::consts::PI).contains(&self.wander),
            "wind.wander",
            "be from 0 to pi",
        )?;
        check(share(self.turbulence), "wind.turbulence", "be from 0 to 1")?;
        check(
            self.air_density.is_finite() && self.air_density >= 0.0,
            "wind.air_density",
            "be at least 0 and finite",
        )
    }

    /// Evaluates the wind at `time` [s]: gusts and direction; turbulence is added per particle, at
    /// positions relative to `origin` [m].
    pub(crate) fn sample(&self, time: f64, origin: Vec3) -> WindSample {
        let speed = self.velocity.length();
        if speed == 0.0 {
            return WindSample { mean: Vec3::ZERO, turbulence: 0.0, phase: [0.0; 3] };
        }
        let phase = f64::from(unit(self.seed, &[0])) * 100.0;
        let t = time + phase;
        // Gusts with periods of 6, 2.6 and 1.1 s.
        let swell = 0.55 * sin(1.05 * t) + 0.3 * sin(2.4 * t + 1.3) + 0.15 * sin(5.7 * t + 0.4);
        let wander_angle = 0.6 * sin(0.41 * t + 2.0) + 0.4 * sin(1.13 * t);
        let along = self.velocity * (1.0 / speed);
        // Two directions perpendicular to the wind, for any orientation.
        let helper = if along.y * along.y < 0.5 { Vec3::Y } else { Vec3::X };
        let across = along.cross(helper);
        let across = across * (1.0 / across.length());
        let lift = across.cross(along);
        let angle = f64::from(self.wander * wander_angle);
        let side = across * sin(angle) + lift * (0.35 * sin(angle * 0.7 + 0.2 * angle));
        let heading = along * cos(angle) + side;
        let mean = heading * (speed * (1.0 + self.gust * swell));
        let turn = core::f64::consts::TAU;
        let [x, y, z] = origin.to_array().map(f64::from);
        let [one, other] = TURBULENCE_WAVES.map(f64::from);
        let at_origin = [y * one + z * other, z * one + x * other, x * one + y * other];
        // Reduced modulo 2π in f64, because the SIMD kernels compute in f32.
        let phase_of =
            |rate: f64, start: f64| remainder(t * rate + phase * 4.8 + start, turn) as f32;
        let phase = [(0, 2.9), (1, 3.7), (2, 4.3)].map(|(k, rate)| phase_of(rate, at_origin[k]));
        WindSample { mean, turbulence: self.turbulence * speed, phase }
    }

    /// Estimate of the largest speed of the air: mean plus amplitudes of gusts and turbulence [m/s].
    pub(crate) fn greatest_speed(&self) -> f32 {
        self.velocity.length() * (1.0 + self.gust + self.turbulence)
    }

    /// Acceleration of the sine field at `time` [s] for a particle at `x` relative to `origin` [m],
    /// in m/s².
    pub(crate) fn sine_field(&self, time: f64, origin: Vec3, x: Vec3) -> Vec3 {
        let [px, py, pz] = (origin.as_dvec3() + x.as_dvec3()).to_array();
        let strength = self.velocity.length();
        Vec3::new(
            sin(time * 1.3 + px * 0.5) * 0.5 + sin(time * 2.7 + pz * 0.3) * 0.3,
            sin(time * 0.7 + py * 0.4) * 0.1,
            cos(time * 1.1 + px * 0.4) * 0.4 + cos(time * 3.1 + py * 0.2) * 0.2,
        ) * strength
    }
}

/// Wave numbers of the turbulence along two axes [rad/m].
const TURBULENCE_WAVES: [f32; 2] = [3.1, 1.7];

/// The wind at one moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WindSample {
    /// Velocity without turbulence [m/s].
    pub mean: Vec3,
    turbulence: f32,
    phase: [f32; 3],
}

impl WindSample {
    /// Returns whether there is turbulence.
    pub fn is_turbulent(&self) -> bool {
        self.turbulence > 0.0
    }

    /// Velocity that turbulence adds along an axis [m/s], at positions along the next axis and the
    /// one after it, relative to the origin.
    #[inline(always)]
    pub fn turbulence_along(&self, axis: usize, next: f32, last: f32) -> f32 {
        let [one, other] = TURBULENCE_WAVES;
        sin_branchless(next * one + last * other + self.phase[axis]) * self.turbulence
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_wind_is_its_velocity_at_any_time() {
        let wind = Wind { velocity: Vec3::new(0.0, 0.0, 2.0), ..Wind::default() };
        for time in [0.0, 1.7, 33.0] {
            let sample = wind.sample(time, Vec3::ZERO);
            assert!((sample.mean - wind.velocity).length() < 1.0e-6 && !sample.is_turbulent());
        }
    }

    #[test]
    fn gusts_stay_within_their_amplitude() {
        let velocity = Vec3::new(3.0, 0.0, 0.0);
        let wind = Wind { velocity, gust: 0.5, ..Wind::default() };
        let speeds: Vec<f32> =
            (0..600).map(|i| wind.sample(f64::from(i) * 0.1, Vec3::ZERO).mean.length()).collect();
        let (low, high) = (
            speeds.iter().copied().fold(9.0, f32::min),
            speeds.iter().copied().fold(0.0, f32::max),
        );
        assert!(low >= 1.499 && high <= 4.501 && high - low > 1.5, "{low} to {high}");
    }

    #[test]
    fn the_wind_at_a_place_does_not_depend_on_the_origin() {
        let wind = Wind { velocity: Vec3::X * 3.0, turbulence: 0.5, ..Wind::default() };
        let (origin, x) = (Vec3::new(40.0, -17.0, 300.0), Vec3::new(0.4, -0.8, 1.1));
        for axis in 0..3 {
            let [near, far] = [(Vec3::ZERO, origin + x), (origin, x)].map(|(origin, x)| {
                let (next, last) = (x[(axis + 1) % 3], x[(axis + 2) % 3]);
                wind.sample(1.25, origin).turbulence_along(axis, next, last)
            });
            assert!((near - far).abs() < 1.0e-3, "{near} and {far} m/s");
        }
        let field = |origin, x| wind.sine_field(1.25, origin, x);
        assert!((field(Vec3::ZERO, origin + x) - field(origin, x)).length() < 1.0e-4);
    }

    #[test]
    fn the_sine_field_matches_its_formula_in_f64() {
        let wind = Wind { model: WindModel::SineField, velocity: Vec3::X * 3.0, ..Wind::default() };
        let (t, x) = (1.25_f64, Vec3::new(0.4, -0.8, 1.1));
        let [px, py, pz] = [0.4_f64, -0.8, 1.1];
        let exact = [
            ((t * 1.3 + px * 0.5).sin() * 0.5 + (t * 2.7 + pz * 0.3).sin() * 0.3) * 3.0,
            (t * 0.7 + py * 0.4).sin() * 0.1 * 3.0,
            ((t * 1.1 + px * 0.4).cos() * 0.4 + (t * 3.1 + py * 0.2).cos() * 0.2) * 3.0,
        ];
        let computed = wind.sine_field(t, Vec3::ZERO, x).to_array();
        for (computed, exact) in computed.iter().zip(exact) {
            assert!((f64::from(*computed) - exact).abs() < 1.0e-6, "{computed} {exact}");
        }
    }
}
