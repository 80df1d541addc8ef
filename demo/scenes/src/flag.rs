//! The flag: nylon on a pole, in a wind that comes and goes.

use crate::{Cast, Scene};
use glam::{Vec2, Vec3};
use muslin::{Cloth, GridDesc, Material, PinMode, Preset, Result, Settings, Wind};

/// A flag of printed nylon, 1.8 m by 1.2 m, that streams from its hoist along x.
#[derive(Clone, Copy, Debug)]
pub struct Flag;

impl Flag {
    /// Width and height [m].
    pub const SIZE: Vec2 = Vec2::new(1.8, 1.2);
    /// Its top corner at the hoist [m].
    pub const HOIST: Vec3 = Vec3::new(-0.9, 0.95, 0.0);

    /// Particles across and down, for so many along its longer side.
    pub fn weave(particles_across: u32) -> [u32; 2] {
        [particles_across, ((2 * particles_across).div_ceil(3)).max(2)]
    }

    /// The descriptor of a flag with so many particles across.
    pub fn desc(particles_across: u32) -> GridDesc {
        let [columns, rows] = Self::weave(particles_across);
        GridDesc {
            columns,
            rows,
            spacing: Self::SIZE.x / (columns.max(2) - 1) as f32,
            origin: Self::HOIST,
            pin_mode: PinMode::None,
            material: Material::preset(Preset::FlagNylon),
            // A gust snaps it taut; woven nylon hardly gives way.
            settings: Settings { max_stretch: 0.02, ..Settings::default() },
            ..GridDesc::default()
        }
    }

    /// The flag, held by the two ends of its hoist or by all of it.
    ///
    /// # Errors
    /// As [`Cloth::grid`].
    pub fn hoisted(desc: &GridDesc, ends_only: bool) -> Result<Cloth> {
        let mut cloth = Cloth::grid(desc)?;
        for row in 0..desc.rows {
            if !ends_only || row == 0 || row + 1 == desc.rows {
                cloth.pin(row * desc.columns, None)?;
            }
        }
        Ok(cloth)
    }

    /// A wind of `speed` [m/s] along the flag, gusting and straying.
    pub fn wind(speed: f32) -> Wind {
        Wind {
            velocity: Vec3::new(1.0, 0.0, 0.28).normalize() * speed,
            gust: 0.45,
            wander: 0.45,
            turbulence: 0.35,
            seed: 5,
            ..Wind::default()
        }
    }
}

impl Scene for Flag {
    const NAME: &'static str = "flag in the wind";
    const ABOUT: &'static str = "Held by its hoist; waves run along it to the fly.";

    fn build() -> Cast {
        let made = Self::hoisted(&Self::desc(40), false).and_then(|mut cloth| {
            cloth.set_wind(Self::wind(7.0))?;
            Ok(cloth)
        });
        match made {
            Ok(cloth) => cloth.into(),
            Err(error) => unreachable!("the scene's own descriptor: {error}"),
        }
    }

    fn check(cast: &Cast) -> core::result::Result<(), String> {
        let cloth = &cast.cloths[0];
        let [columns, rows] = Self::weave(40).map(|n| n as usize);
        let x = cloth.positions();
        let hoist = (0..rows).map(|row| x[row * columns]);
        if let Some(off) = hoist.map(|at| (at.x - Self::HOIST.x).abs()).find(|off| *off > 1.0e-4) {
            return Err(format!("the hoist left its pole by {off} m"));
        }
        let fly = |row: usize| x[(row + 1) * columns - 1];
        let reach = (0..rows).map(|row| fly(row).x - Self::HOIST.x).sum::<f32>() / rows as f32;
        // A wave may fold the fly back for a moment.
        if reach < 0.2 * Self::SIZE.x {
            return Err(format!("it hangs: its fly is {reach} m from the pole"));
        }
        let (near, far) =
            x.iter().fold((f32::MAX, f32::MIN), |(near, far), at| (near.min(at.z), far.max(at.z)));
        if far - near < 0.05 {
            return Err(format!("it does not wave: it is {} m deep", far - near));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.05 {
            return Err(format!("it is stretched by {stretch}"));
        }
        Ok(())
    }
}
