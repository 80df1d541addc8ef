//! Return animation: moves every particle from its current position to its initial position on the
//! grid.
//!
//! ```text
//! x(t) = x₀ + (x₁ − x₀) · (1 − (1 − t/T)³)        T = 0.5 s
//! ```
//! Method: cubic ease-out per particle.
//!
//! Reads the positions at the start; writes positions of the cloth.
//!
//! Invariant: no tick of the simulation runs during the animation.

use glam::Vec3;
use muslin::{Cloth, GridDesc, Result};

/// Duration [s].
pub const SECONDS: f32 = 0.5;

/// State of the animation.
#[derive(Debug)]
pub struct ReturnAnimation {
    from: Vec<Vec3>,
    to: Vec<Vec3>,
    age: f32,
}

impl ReturnAnimation {
    /// Starts at the current positions; a particle that a tear has added moves to its source
    /// vertex.
    pub fn new(cloth: &Cloth, desc: &GridDesc) -> Self {
        let place = |particle: &u32| {
            let [row, column] = [particle / desc.columns, particle % desc.columns];
            let way = desc.right * column as f32 + desc.down * row as f32;
            desc.origin + way * desc.spacing
        };
        let to = cloth.source_vertices().iter().map(place).collect();
        Self { from: cloth.positions().to_vec(), to, age: 0.0 }
    }

    /// Advances by `seconds` [s]; returns whether the animation still runs.
    ///
    /// # Errors
    /// As [`Cloth::set_position`].
    pub fn advance(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<bool> {
        self.age += seconds;
        let share = ease_out(self.age / SECONDS);
        for (particle, (from, to)) in (0..).zip(self.from.iter().zip(&self.to)) {
            cloth.set_position(particle, from.lerp(*to, share))?;
        }
        // The tolerance covers the rounding of the frame times.
        Ok(self.age < SECONDS - 1.0e-3)
    }

    /// Returns the greatest distance of a particle from its final position [m].
    #[cfg(test)]
    pub fn greatest_distance(&self, cloth: &Cloth) -> f32 {
        let tracks = cloth.positions().iter().zip(&self.to).map(|(at, to)| at.distance(*to));
        tracks.fold(0.0, f32::max)
    }
}

/// Cubic ease-out.
fn ease_out(share: f32) -> f32 {
    let left = 1.0 - share.clamp(0.0, 1.0);
    1.0 - left * left * left
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_animation_starts_fast_and_ends_slowly() {
        assert_eq!((ease_out(0.0), ease_out(1.0), ease_out(7.0)), (0.0, 1.0, 1.0));
        let tracks: Vec<f32> =
            (0..10).map(|i| ease_out((i + 1) as f32 / 10.0) - ease_out(i as f32 / 10.0)).collect();
        assert!(tracks.windows(2).all(|two| two[1] < two[0]), "{tracks:?}");
    }
}
