//! Crumpling: two hands gather the whole sheet into a fist and let go of it.

use glam::Vec3;
use muslin::{Cloth, Error, Grab, Result};

/// Fingers down and across the sheet.
const FINGERS: [u32; 2] = [8, 6];
/// How long they take to close [s], and how long they stay closed.
const CLOSING: f32 = 1.1;
const CLOSED: f32 = 0.6;
/// Radius of what they close to, in units.
const FIST: f32 = 0.65;
/// How high over the floor they close at least, in units.
const HEIGHT: f32 = 2.2;

/// Fingers that close.
#[derive(Debug)]
pub struct Squeeze {
    /// Each with where it takes hold and where it goes [m].
    fingers: Vec<(Grab, Vec3, Vec3)>,
    age: f32,
}

impl Squeeze {
    /// How long the fingers hold it [s].
    pub const HELD: f32 = CLOSING + CLOSED;

    /// Takes hold all over a sheet of so many particles, where a unit is so long [m].
    ///
    /// # Errors
    /// As [`Cloth::grab_particle`].
    pub fn new(cloth: &mut Cloth, [columns, rows]: [u32; 2], unit: f32) -> Result<Self> {
        let positions = cloth.positions();
        let middle = positions.iter().sum::<Vec3>() / positions.len() as f32;
        let floor = (crate::receipt::FLOOR + HEIGHT) * unit;
        let fist = middle.with_y(middle.y.max(floor));
        let mut fingers = Vec::new();
        let [down, across] = FINGERS;
        for i in 0..down {
            for j in 0..across {
                let row = (i * (rows - 1)) / (down - 1);
                let column = (j * (columns - 1)) / (across - 1);
                let particle = row * columns + column;
                let from = cloth.positions()[particle as usize];
                let grab = match cloth.grab_particle(particle) {
                    Ok(grab) => grab,
                    // Other hands hold all that can be held.
                    Err(Error::Full { .. }) => break,
                    Err(error) => return Err(error),
                };
                // By turns to the front and to the back, so that it buckles between the fingers; and each
                // row a little askew of the one before.
                let side = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
                let flat = Vec3::new(
                    j as f32 / (across - 1) as f32 - 0.5,
                    0.5 - i as f32 / (down - 1) as f32,
                    0.0,
                );
                let turned = Vec3::new(
                    flat.x + 0.12 * (1.9 * i as f32).sin(),
                    flat.y + 0.12 * (2.3 * j as f32).cos(),
                    side * (0.38 + 0.06 * (1.3 * (i * across + j) as f32).sin()),
                );
                fingers.push((grab, from, fist + turned.clamp_length_max(1.0) * (FIST * unit)));
            }
        }
        Ok(Self { fingers, age: 0.0 })
    }

    /// Closes for one tick, and says whether the fingers still hold; they have let go otherwise.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn tick(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<bool> {
        self.age += seconds;
        if self.age > Self::HELD {
            for (grab, ..) in self.fingers.drain(..) {
                cloth.release(grab)?;
            }
            return Ok(false);
        }
        let share = (self.age / CLOSING).min(1.0);
        let share = share * share * (3.0 - 2.0 * share);
        for (grab, from, to) in &self.fingers {
            cloth.move_grab(*grab, from.lerp(*to, share))?;
        }
        Ok(true)
    }

    /// Lets go before the time.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn release(self, cloth: &mut Cloth) -> Result<()> {
        self.fingers.into_iter().try_for_each(|(grab, ..)| cloth.release(grab))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sheet;

    const TICK: f32 = 1.0 / 120.0;

    /// Paper that is squeezed after so many ticks and let fall.
    fn squeezed(small: bool, after: u32) -> Cloth {
        let mut cloth = Sheet::Paper.hang(small).unwrap();
        cloth.step(after);
        let mut squeeze =
            Squeeze::new(&mut cloth, Sheet::Paper.weave(small), Sheet::Paper.unit()).unwrap();
        while squeeze.tick(TICK, &mut cloth).unwrap() {
            cloth.step(1);
        }
        cloth.unpin_all();
        cloth
    }

    #[test]
    fn what_was_squeezed_comes_to_rest() {
        // On small screens or others, squeezed after so many ticks.
        for (small, after) in [(false, 60), (false, 90), (true, 60), (true, 75), (true, 90)] {
            let mut cloth = squeezed(small, after);
            cloth.step(600);
            let before = cloth.positions().to_vec();
            cloth.step(120);
            let moved = cloth.positions().iter().zip(&before).map(|(x, at)| x.distance(*at));
            let most = moved.fold(0.0, f32::max) / Sheet::Paper.unit();
            assert!(most < 0.03, "{small}, {after}: within a second one moves by {most} units");
        }
    }
}
