//! Scene: a nylon flag with rips from its free edge, on a pole in a storm.

use crate::flag::Flag;
use crate::instance::SceneInstance;
use crate::scene::{Scene, built};
use glam::Vec3;
use muslin::{Cloth, Result, Wind};

/// The flag of [`Flag`], ripped into strips along its free half.
#[derive(Clone, Copy, Debug)]
pub struct TornFlag;

/// Rips along the weft: the heights at the free edge and at their inner ends, and the places of the
/// inner ends along the flag, as shares of its height from the top and of its width from the pole.
const RIPS: [([f32; 2], f32); 7] = [
    ([0.10, 0.14], 0.82),
    ([0.24, 0.21], 0.45),
    ([0.37, 0.40], 0.70),
    ([0.50, 0.55], 0.33),
    ([0.66, 0.64], 0.56),
    ([0.80, 0.77], 0.78),
    ([0.91, 0.89], 0.64),
];

impl TornFlag {
    /// Cuts the rips into a flag that is in its plane at the start.
    ///
    /// # Errors
    /// As [`Cloth::cut`]: the reserve is too small for the rips.
    pub fn rip(cloth: &mut Cloth) -> Result<()> {
        let sweep = Vec3::Z * 0.2;
        let place = |along: f32, down: f32| {
            let flat = Vec3::new(along * Flag::SIZE.x, -down * Flag::SIZE.y, 0.0);
            Flag::HOIST + flat - 0.5 * sweep
        };
        for ([outer, inner], end) in RIPS {
            cloth.cut(place(1.02, outer), place(end, inner), sweep)?;
        }
        Ok(())
    }

    /// Returns a wind of `speed` [m/s] along the flag that gusts and turns as in a storm.
    pub fn wind(speed: f32) -> Wind {
        Wind { gust: 0.6, wander: 0.6, turbulence: 0.6, seed: 11, ..Flag::wind(speed) }
    }
}

impl Scene for TornFlag {
    const NAME: &'static str = "torn flag in a storm";
    const ABOUT: &'static str = "Its strips whip in the gusts, and none comes off.";

    fn build() -> SceneInstance {
        let cloth = Flag::hoist(&Flag::desc(40), false).and_then(|mut cloth| {
            Self::rip(&mut cloth)?;
            cloth.set_wind(Self::wind(13.0))?;
            Ok(cloth)
        });
        built(cloth)
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let cloth = &instance.cloths[0];
        let stats = cloth.stats();
        if stats.pieces != 1 {
            return Err(format!("the flag is in {} pieces", stats.pieces));
        }
        let [columns, rows] = Flag::grid_size(40);
        let whole = columns * rows;
        if stats.particles < whole + 30 {
            return Err(format!("only {} particles are at rips", stats.particles - whole));
        }
        if stats.max_speed < 0.3 {
            return Err(format!("the strips move at {} m/s at most", stats.max_speed));
        }
        if stats.max_stretch > 0.08 {
            return Err(format!("the largest stretch is {}", stats.max_stretch));
        }
        let farthest = cloth.positions().iter().map(|x| x.distance(Flag::HOIST));
        let farthest = farthest.fold(0.0, f32::max);
        if farthest > 1.15 * Flag::SIZE.length() {
            return Err(format!("a strip is {farthest} m from the pole"));
        }
        Ok(())
    }
}
