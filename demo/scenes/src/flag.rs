//! Scene: a nylon flag on a pole in a gusty wind.

use crate::instance::SceneInstance;
use crate::scene::{Scene, built};
use glam::{Vec2, Vec3};
use muslin::{Cloth, GridDesc, Material, PinMode, Preset, Result, Settings, Wind};

/// A nylon flag of 1.8 m by 1.2 m that streams along x from its hoist, the edge at the pole.
#[derive(Clone, Copy, Debug)]
pub struct Flag;

impl Flag {
    /// Width and height [m].
    pub const SIZE: Vec2 = Vec2::new(1.8, 1.2);
    /// Top corner at the hoist [m].
    pub const HOIST: Vec3 = Vec3::new(-0.9, 0.95, 0.0);

    /// Returns columns and rows of a grid with this many particles along the longer side.
    pub fn grid_size(particles_across: u32) -> [u32; 2] {
        [particles_across, ((2 * particles_across).div_ceil(3)).max(2)]
    }

    /// Returns the descriptor of a flag with this many particles across.
    pub fn desc(particles_across: u32) -> GridDesc {
        let [columns, rows] = Self::grid_size(particles_across);
        GridDesc {
            columns,
            rows,
            spacing: Self::SIZE.x / (columns.max(2) - 1) as f32,
            origin: Self::HOIST,
            pin_mode: PinMode::None,
            material: Material::preset(Preset::FlagNylon),
            // A gust pulls it taut, and woven nylon hardly stretches.
            settings: Settings { max_stretch: 0.02, ..Settings::default() },
            ..GridDesc::default()
        }
    }

    /// Creates a flag that is pinned along its hoist, or at the two ends of the hoist only.
    ///
    /// # Errors
    /// As [`Cloth::grid`].
    pub fn hoist(desc: &GridDesc, ends_only: bool) -> Result<Cloth> {
        let mut cloth = Cloth::grid(desc)?;
        for row in 0..desc.rows {
            if !ends_only || row == 0 || row + 1 == desc.rows {
                cloth.pin(row * desc.columns, None)?;
            }
        }
        Ok(cloth)
    }

    /// Returns a wind of `speed` [m/s] along the flag, with gusts and a wandering direction.
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
    const ABOUT: &'static str = "Pinned at its hoist; waves run along it to the free edge.";

    fn build() -> SceneInstance {
        let cloth = Self::hoist(&Self::desc(40), false).and_then(|mut cloth| {
            cloth.set_wind(Self::wind(7.0))?;
            Ok(cloth)
        });
        built(cloth)
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let cloth = &instance.cloths[0];
        let [columns, rows] = Self::grid_size(40).map(|n| n as usize);
        let x = cloth.positions();
        let hoist = (0..rows).map(|row| x[row * columns]);
        if let Some(off) = hoist.map(|x| (x.x - Self::HOIST.x).abs()).find(|off| *off > 1.0e-4) {
            return Err(format!("the hoist is {off} m off its pole"));
        }
        let free_end = |row: usize| x[(row + 1) * columns - 1];
        let length =
            (0..rows).map(|row| free_end(row).x - Self::HOIST.x).sum::<f32>() / rows as f32;
        // A wave may fold the free edge back for a moment.
        if length < 0.2 * Self::SIZE.x {
            return Err(format!("the flag hangs: its free edge is {length} m from the pole"));
        }
        let (near, far) =
            x.iter().fold((f32::MAX, f32::MIN), |(near, far), x| (near.min(x.z), far.max(x.z)));
        if far - near < 0.05 {
            return Err(format!("the flag does not wave: its extent along z is {} m", far - near));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.05 {
            return Err(format!("the largest stretch is {stretch}"));
        }
        Ok(())
    }
}
