//! Scene: a sheet that is pinned along its top edge hangs in a light, gusty wind.

use crate::instance::SceneInstance;
use crate::scene::{Scene, built};
use glam::Vec3;
use muslin::{Cloth, GridDesc, PinMode, Result, Wind};

/// A square sheet of cotton, two metres wide, centred at the origin.
#[derive(Clone, Copy, Debug)]
pub struct HangingSheet;

impl HangingSheet {
    /// Length of a side [m].
    pub const SIZE: f32 = 2.0;

    /// Returns the descriptor of a sheet with this many particles per side.
    pub fn desc(particles_per_side: u32, pin_mode: PinMode) -> GridDesc {
        let half = Self::SIZE / 2.0;
        GridDesc {
            columns: particles_per_side,
            rows: particles_per_side,
            spacing: Self::SIZE / (particles_per_side.max(2) - 1) as f32,
            origin: Vec3::new(-half, half, 0.0),
            pin_mode,
            ..GridDesc::default()
        }
    }

    /// Returns a wind of `speed` [m/s] towards the viewer, with gusts and a wandering direction.
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

    /// Creates a sheet with this many particles per side, in the wind of the scene.
    ///
    /// # Errors
    /// As [`Cloth::grid`]: fewer than two particles per side, or more than a cloth can have.
    pub fn create(particles_per_side: u32, pin_mode: PinMode) -> Result<Cloth> {
        let mut cloth = Cloth::grid(&Self::desc(particles_per_side, pin_mode))?;
        cloth.set_wind(Self::wind(2.0))?;
        Ok(cloth)
    }
}

impl Scene for HangingSheet {
    const NAME: &'static str = "hanging sheet";
    const ABOUT: &'static str = "Pinned along its top edge; gusts lift it, and it falls back.";

    fn build() -> SceneInstance {
        built(Self::create(40, PinMode::TopEdge))
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let cloth = &instance.cloths[0];
        let half = Self::SIZE / 2.0;
        let top = &cloth.positions()[..40];
        if top.iter().any(|x| (x.y - half).abs() > 1.0e-4) {
            return Err("the top edge is off its pins".into());
        }
        let lowest = cloth.positions().iter().map(|x| x.y).fold(half, f32::min);
        if lowest > 0.0 {
            return Err(format!("the sheet does not hang down: its lowest point is at {lowest} m"));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.05 {
            return Err(format!("the largest stretch is {stretch}"));
        }
        Ok(())
    }
}
