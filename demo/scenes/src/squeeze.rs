//! Crumpling: hands close around a whole sheet, again and again, and let go of it.

#[cfg(test)]
mod tests;

use glam::{Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Material, Result};

/// So many palms close all around it. With fewer, paper is pinched where they meet.
const PALMS: u32 = 32;
/// How far from the middle they close to, one time after the other, in units: little by little, as hands do.
const BALLS: [f32; 6] = [1.1, 1.05, 1.0, 0.95, 0.9, 0.9];
/// How long that takes from the second time on, and how long they stay closed [s].
const AGAIN: f32 = 0.3;
const CLOSED: f32 = 0.2;
/// They yield to that much of it then, in so much time, or in as much when they let go at last [s].
const YIELDS: f32 = 1.15;
const YIELDING: f32 = 0.2;
const LETS_GO: f32 = 0.5;
/// How long they are off until they close again [s].
const LOOSE: f32 = 0.12;
/// How far they are turned from one time to the next [rad], and what about.
const TURN: f32 = 1.7;
const ABOUT: Vec3 = Vec3::new(0.830_455, 0.498_273, 0.249_136);
/// Angle up to which folds open again that hands keep pressing [rad]: held folded, paper gives way.
const PRESSED: f32 = 0.2;
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
    /// How long they have been at it this time [s], and which time it is.
    age: f32,
    time: usize,
    /// Angle up to which folds open again, out of hands [rad].
    yield_angle: f32,
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
    /// How long hands take to close at first [s].
    pub const CLOSING: f32 = 1.0;

    /// Puts palms all around a sheet, just outside, where a unit is so long [m].
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn new(cloth: &mut Cloth, unit: f32) -> Result<Self> {
        let (palms, middle) = (Vec::with_capacity(PALMS as usize), Vec3::ZERO);
        let yield_angle = cloth.material().yield_angle;
        let mut hands = Self { palms, middle, unit, age: 0.0, time: 0, yield_angle };
        hands.spread(cloth)?;
        set_yield_angle(cloth, yield_angle.min(PRESSED))?;
        Ok(hands)
    }

    fn spread(&mut self, cloth: &mut Cloth) -> Result<()> {
        let positions = cloth.positions();
        let middle = positions.iter().sum::<Vec3>() / positions.len() as f32;
        let floor = (crate::receipt::FLOOR + HEIGHT) * self.unit;
        self.middle = middle.with_y(middle.y.max(floor));
        let turned = Quat::from_axis_angle(ABOUT.normalize(), TURN * self.time as f32);
        for at in 0..PALMS {
            let out = turned * around(at);
            let far = |x: &Vec3| (*x - self.middle).dot(out);
            let from = cloth.positions().iter().map(far).fold(self.ball(), f32::max);
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

    /// How far from the middle palms close to this time [m].
    fn ball(&self) -> f32 {
        BALLS[self.time] * self.unit
    }

    /// Goes on for one tick, and says whether there is more to do; hands have let go otherwise.
    ///
    /// # Errors
    /// As [`Cloth::move_collider`].
    pub fn tick(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<bool> {
        self.age += seconds;
        let is_last = self.time + 1 == BALLS.len();
        let closing = if self.time == 0 { Self::CLOSING } else { AGAIN };
        let yielding = if is_last { LETS_GO } else { YIELDING };
        let since = self.age - closing - CLOSED;
        if since > yielding {
            self.open(cloth)?;
            if is_last {
                set_yield_angle(cloth, self.yield_angle)?;
                return Ok(false);
            }
            if since > yielding + LOOSE {
                (self.age, self.time) = (0.0, self.time + 1);
                self.spread(cloth)?;
            }
            return Ok(true);
        }
        let (ball, share) = (self.ball(), (self.age / closing).min(1.0));
        let share = share * share * (3.0 - 2.0 * share);
        let yields = 1.0 + (YIELDS - 1.0) * (since / yielding).max(0.0);
        for Palm { collider, out, from } in &self.palms {
            let far = if since > 0.0 { ball * yields } else { from + share * (ball - from) };
            cloth.move_collider(*collider, self.middle + *out * far, facing_in(*out))?;
        }
        Ok(true)
    }

    /// Lets go before the time.
    ///
    /// # Errors
    /// As [`Cloth::remove_collider`].
    pub fn release(mut self, cloth: &mut Cloth) -> Result<()> {
        set_yield_angle(cloth, self.yield_angle)?;
        self.open(cloth)
    }

    fn open(&mut self, cloth: &mut Cloth) -> Result<()> {
        self.palms.drain(..).try_for_each(|palm| cloth.remove_collider(palm.collider))
    }
}

fn set_yield_angle(cloth: &mut Cloth, yield_angle: f32) -> Result<()> {
    let material = cloth.material().clone();
    cloth.set_material(Material { yield_angle, ..material })
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
