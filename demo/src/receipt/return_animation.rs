//! The way back to the pins: every particle eases from where it is to where it was woven.

use glam::Vec3;
use muslin::{Cloth, GridDesc, Result};

/// How long it takes [s].
pub const SECONDS: f32 = 0.5;

/// A receipt on its way back.
#[derive(Debug)]
pub struct ReturnAnimation {
    from: Vec<Vec3>,
    to: Vec<Vec3>,
    age: f32,
}

impl ReturnAnimation {
    /// Begins where everything is now; what tears have added goes to where it was torn from.
    pub fn new(cloth: &Cloth, desc: &GridDesc) -> Self {
        let place = |particle: &u32| {
            let [row, column] = [particle / desc.columns, particle % desc.columns];
            let way = desc.right * column as f32 + desc.down * row as f32;
            desc.origin + way * desc.spacing
        };
        let to = cloth.source_vertices().iter().map(place).collect();
        Self { from: cloth.positions().to_vec(), to, age: 0.0 }
    }

    /// Goes on for `seconds`, and says whether there is any way left.
    ///
    /// # Errors
    /// As [`Cloth::set_position`].
    pub fn advance(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<bool> {
        self.age += seconds;
        let share = ease_out(self.age / SECONDS);
        for (particle, (from, to)) in (0..).zip(self.from.iter().zip(&self.to)) {
            cloth.set_position(particle, from.lerp(*to, share))?;
        }
        // Half of a frame's rounding is no way left.
        Ok(self.age < SECONDS - 1.0e-3)
    }

    /// How far any particle is from where it goes [m].
    #[cfg(test)]
    pub fn farthest(&self, cloth: &Cloth) -> f32 {
        let tracks = cloth.positions().iter().zip(&self.to).map(|(at, to)| at.distance(*to));
        tracks.fold(0.0, f32::max)
    }
}

/// Fast at first, slow at last: a cubic.
fn ease_out(share: f32) -> f32 {
    let left = 1.0 - share.clamp(0.0, 1.0);
    1.0 - left * left * left
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_starts_fast_and_ends_slowly_where_it_should() {
        assert_eq!((ease_out(0.0), ease_out(1.0), ease_out(7.0)), (0.0, 1.0, 1.0));
        let tracks: Vec<f32> =
            (0..10).map(|i| ease_out((i + 1) as f32 / 10.0) - ease_out(i as f32 / 10.0)).collect();
        assert!(tracks.windows(2).all(|two| two[1] < two[0]), "{tracks:?}");
    }
}
