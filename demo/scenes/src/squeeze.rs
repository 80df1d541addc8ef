//! Crumpling: hands close around a whole sheet, again and again, and let go of it.

use glam::{Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Result};

/// So many palms close all around it. With fewer, paper is pinched where they meet.
const PALMS: u32 = 32;
/// How often they do.
const TIMES: u32 = 3;
/// How long they stay closed, and how long they are open until they close again [s].
const CLOSED: f32 = 0.1;
const LOOSE: f32 = 0.12;
/// How far from the middle of the ball they close to, in units.
const BALL: f32 = 1.15;
/// How high over the floor that is at least, in units.
const HEIGHT: f32 = 2.2;
/// Their friction: paper slides under them rather than being drawn out.
const FRICTION: f32 = 0.2;

/// Hands that close.
#[derive(Debug)]
pub struct Squeeze {
    palms: Vec<Palm>,
    /// Where the ball will be, and how long a unit is [m].
    middle: Vec3,
    unit: f32,
    /// How long they have been closing or open [s], and how many times they will close again.
    age: f32,
    again: u32,
}

/// A plane that faces the middle.
#[derive(Debug)]
struct Palm {
    collider: Collider,
    /// The way out, and how far out it was at first [m].
    out: Vec3,
    from: f32,
}

impl Squeeze {
    /// How long hands take to close [s].
    pub const CLOSING: f32 = 0.8;

    /// Puts palms all around a sheet, just outside, where a unit is so long [m].
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn new(cloth: &mut Cloth, unit: f32) -> Result<Self> {
        let (palms, middle) = (Vec::with_capacity(PALMS as usize), Vec3::ZERO);
        let mut hands = Self { palms, middle, unit, age: 0.0, again: TIMES - 1 };
        hands.spread(cloth)?;
        Ok(hands)
    }

    fn spread(&mut self, cloth: &mut Cloth) -> Result<()> {
        let positions = cloth.positions();
        let middle = positions.iter().sum::<Vec3>() / positions.len() as f32;
        let floor = (crate::receipt::FLOOR + HEIGHT) * self.unit;
        self.middle = middle.with_y(middle.y.max(floor));
        for at in 0..PALMS {
            let out = around(at);
            let far = |x: &Vec3| (*x - self.middle).dot(out);
            let from = cloth.positions().iter().map(far).fold(BALL * self.unit, f32::max);
            let desc = ColliderDesc {
                position: self.middle + out * from,
                rotation: facing_in(out),
                friction: FRICTION,
                ..ColliderDesc::default()
            };
            self.palms.push(Palm { collider: cloth.add_collider(&desc)?, out, from });
        }
        Ok(())
    }

    /// Goes on for one tick, and says whether there is more to do; hands have let go otherwise.
    ///
    /// # Errors
    /// As [`Cloth::move_collider`].
    pub fn tick(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<bool> {
        self.age += seconds;
        if self.age > Self::CLOSING + CLOSED {
            self.open(cloth)?;
            if self.again > 0 && self.age > Self::CLOSING + CLOSED + LOOSE {
                (self.age, self.again) = (0.0, self.again - 1);
                self.spread(cloth)?;
                return Ok(true);
            }
            return Ok(self.again > 0);
        }
        let share = (self.age / Self::CLOSING).min(1.0);
        let share = share * share * (3.0 - 2.0 * share);
        for Palm { collider, out, from } in &self.palms {
            let at = self.middle + *out * (from + share * (BALL * self.unit - from));
            cloth.move_collider(*collider, at, facing_in(*out))?;
        }
        Ok(true)
    }

    /// Lets go before the time.
    ///
    /// # Errors
    /// As [`Cloth::remove_collider`].
    pub fn release(mut self, cloth: &mut Cloth) -> Result<()> {
        self.open(cloth)
    }

    fn open(&mut self, cloth: &mut Cloth) -> Result<()> {
        self.palms.drain(..).try_for_each(|palm| cloth.remove_collider(palm.collider))
    }
}

/// Directions spread evenly over a ball, each turned on by the golden angle.
fn around(at: u32) -> Vec3 {
    let y = 1.0 - (2 * at + 1) as f32 / PALMS as f32;
    let (sin, cos) = (2.399_963 * at as f32).sin_cos();
    let flat = (1.0 - y * y).sqrt();
    Vec3::new(flat * cos, y, flat * sin)
}

fn facing_in(out: Vec3) -> Quat {
    Quat::from_rotation_arc(Vec3::Y, -out)
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
        cloth.unpin_all();
        let mut squeeze = Squeeze::new(&mut cloth, Sheet::Paper.unit()).unwrap();
        while squeeze.tick(TICK, &mut cloth).unwrap() {
            cloth.step(1);
        }
        cloth
    }

    #[test]
    fn what_was_squeezed_comes_to_rest() {
        // On small screens or others, squeezed after so many ticks.
        for (small, after) in [(false, 60), (true, 60), (true, 75), (true, 90)] {
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
