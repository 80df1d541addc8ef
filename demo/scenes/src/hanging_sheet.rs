//! The hanging sheet: pinned along its top edge, in a light wind that comes and goes.

use crate::{Cast, Scene};
use glam::Vec3;
use muslin::{Cloth, GridDesc, PinMode, Result, Wind};

/// A square sheet of cotton, two metres wide, centred on the origin.
#[derive(Clone, Copy, Debug)]
pub struct HangingSheet;

impl HangingSheet {
    /// Length of a side [m].
    pub const SIZE: f32 = 2.0;

    /// The descriptor of a sheet with so many particles a side, pinned in one of the ways.
    pub fn desc(particles_a_side: u32, pin_mode: PinMode) -> GridDesc {
        let half = Self::SIZE / 2.0;
        GridDesc {
            columns: particles_a_side,
            rows: particles_a_side,
            spacing: Self::SIZE / (particles_a_side.max(2) - 1) as f32,
            origin: Vec3::new(-half, half, 0.0),
            pin_mode,
            ..GridDesc::default()
        }
    }

    /// A light wind of `speed` [m/s] out of the picture, gusting and straying.
    pub fn wind(speed: f32) -> Wind {
        Wind {
            velocity: Vec3::new(0.15, 0.0, 1.0).normalize() * speed,
            gust: 0.6,
            wander: 0.5,
            turbulence: 0.25,
            seed: 1,
            ..Wind::default()
        }
    }

    /// The sheet with so many particles a side, in the wind of the scene.
    ///
    /// # Errors
    /// As [`Cloth::grid`]: fewer than two particles a side, or far too many.
    pub fn with(particles_a_side: u32, pin_mode: PinMode) -> Result<Cloth> {
        let mut cloth = Cloth::grid(&Self::desc(particles_a_side, pin_mode))?;
        cloth.set_wind(Self::wind(2.0))?;
        Ok(cloth)
    }
}

impl Scene for HangingSheet {
    const NAME: &'static str = "hanging sheet";
    const ABOUT: &'static str =
        "Pinned along its top edge; the wind swells and lifts it, and it falls back.";

    fn build() -> Cast {
        match Self::with(40, PinMode::TopEdge) {
            Ok(cloth) => cloth.into(),
            Err(error) => unreachable!("the scene's own descriptor: {error}"),
        }
    }

    fn check(cast: &Cast) -> core::result::Result<(), String> {
        let cloth = &cast.cloths[0];
        let half = Self::SIZE / 2.0;
        let top = &cloth.positions()[..40];
        if top.iter().any(|x| (x.y - half).abs() > 1.0e-4) {
            return Err("the top edge left its pins".into());
        }
        let lowest = cloth.positions().iter().map(|x| x.y).fold(half, f32::min);
        if lowest > 0.0 {
            return Err(format!("nothing hangs lower than y = {lowest}"));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.05 {
            return Err(format!("it is stretched by {stretch}"));
        }
        Ok(())
    }
}
