//! Crumpling: plane colliders ("palms") close around a whole sheet several times, until it is a
//! ball.
//!
//! The palms face the centre of the sheet from directions that are spread evenly over a sphere.
//! Each of the `RADII` is one squeeze:
//!
//! ```text
//! close to the radius ─▶ hold ─▶ yield a little ─▶ remove the palms ─▶ pause ─▶ next, rotated
//! ```
//!
//! [`Squeeze::tick`] moves the colliders of the cloth before each tick. Meanwhile the yield angle
//! of the material is lower, because paper that is held folded creeps.

#[cfg(test)]
mod tests;

use glam::{Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Material, Result};

/// Number of palms. With fewer, paper is pinched where they meet.
const PALMS: u32 = 32;
/// Distance of the closed palms from the centre in each squeeze [units]; it shrinks gradually.
const RADII: [f32; 6] = [1.1, 1.05, 1.0, 0.95, 0.9, 0.9];
/// Duration of closing from the second squeeze on [s].
const RECLOSE_TIME: f32 = 0.3;
/// How long the palms stay closed [s].
const HOLD_TIME: f32 = 0.2;
/// Factor on the radius to which the palms yield after holding.
const YIELD_FACTOR: f32 = 1.15;
/// Duration of yielding [s].
const YIELD_TIME: f32 = 0.2;
/// Duration of yielding in the last squeeze [s].
const LAST_YIELD_TIME: f32 = 0.5;
/// Pause between two squeezes, without palms [s].
const PAUSE: f32 = 0.12;
/// Rotation of all palms from one squeeze to the next [rad].
const ROTATION: f32 = 1.7;
/// Axis of that rotation.
const ROTATION_AXIS: Vec3 = Vec3::new(0.830_455, 0.498_273, 0.249_136);
/// Yield angle during a squeeze [rad]: paper that is held folded creeps.
const PRESSED_YIELD_ANGLE: f32 = 0.2;
/// Smallest height of the centre above the floor [units].
const MIN_HEIGHT: f32 = 2.2;
/// Friction of the palms: low, so that paper slides under them and is not pulled out.
const FRICTION: f32 = 0.2;

/// A running sequence of squeezes.
#[derive(Debug)]
pub struct Squeeze {
    palms: Vec<Palm>,
    /// Centre of the ball [m].
    centre: Vec3,
    /// Length of a unit [m].
    unit: f32,
    /// Time since the current squeeze began [s].
    age: f32,
    /// Index of the current squeeze in [`RADII`].
    round: usize,
    /// Yield angle of the material before and after the squeezes [rad].
    yield_angle: f32,
}

/// A plane collider that faces the centre.
#[derive(Debug)]
struct Palm {
    collider: Collider,
    /// Unit direction from the centre to the palm.
    outward: Vec3,
    /// Distance from the centre at the start of the squeeze [m].
    start: f32,
}

impl Squeeze {
    /// Duration of closing in the first squeeze [s].
    pub const CLOSING: f32 = 1.0;

    /// Adds palms all around the sheet, just outside it; `unit` is the length of a unit [m].
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn new(cloth: &mut Cloth, unit: f32) -> Result<Self> {
        let (palms, centre) = (Vec::with_capacity(PALMS as usize), Vec3::ZERO);
        let yield_angle = cloth.material().yield_angle;
        let mut squeeze = Self { palms, centre, unit, age: 0.0, round: 0, yield_angle };
        squeeze.add_palms(cloth)?;
        set_yield_angle(cloth, yield_angle.min(PRESSED_YIELD_ANGLE))?;
        Ok(squeeze)
    }

    /// Adds the palms of the current squeeze as colliders.
    fn add_palms(&mut self, cloth: &mut Cloth) -> Result<()> {
        let positions = cloth.positions();
        let mean = positions.iter().sum::<Vec3>() / positions.len() as f32;
        let floor = (crate::receipt::FLOOR + MIN_HEIGHT) * self.unit;
        self.centre = mean.with_y(mean.y.max(floor));
        let rotation =
            Quat::from_axis_angle(ROTATION_AXIS.normalize(), ROTATION * self.round as f32);
        for palm in 0..PALMS {
            let outward = rotation * spread_direction(palm);
            let distance = |x: &Vec3| (*x - self.centre).dot(outward);
            let start = cloth.positions().iter().map(distance).fold(self.radius(), f32::max);
            let desc = ColliderDesc {
                position: self.centre + outward * start,
                rotation: rotation_towards_centre(outward),
                friction: FRICTION,
                ..ColliderDesc::default()
            };
            self.palms.push(Palm { collider: cloth.add_collider(&desc)?, outward, start });
        }
        Ok(())
    }

    /// Returns the distance of the closed palms from the centre in the current squeeze [m].
    fn radius(&self) -> f32 {
        RADII[self.round] * self.unit
    }

    /// Moves the palms for the next tick of `seconds` [s], and returns whether the sequence
    /// continues. At the end all palms are removed.
    ///
    /// # Errors
    /// As [`Cloth::move_collider`] and [`Cloth::add_collider`].
    pub fn tick(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<bool> {
        self.age += seconds;
        let is_last = self.round + 1 == RADII.len();
        let closing = if self.round == 0 { Self::CLOSING } else { RECLOSE_TIME };
        let yield_time = if is_last { LAST_YIELD_TIME } else { YIELD_TIME };
        let since_hold = self.age - closing - HOLD_TIME;
        if since_hold > yield_time {
            self.remove_palms(cloth)?;
            if is_last {
                set_yield_angle(cloth, self.yield_angle)?;
                return Ok(false);
            }
            if since_hold > yield_time + PAUSE {
                (self.age, self.round) = (0.0, self.round + 1);
                self.add_palms(cloth)?;
            }
            return Ok(true);
        }
        let (radius, share) = (self.radius(), (self.age / closing).min(1.0));
        let share = share * share * (3.0 - 2.0 * share);
        let factor = 1.0 + (YIELD_FACTOR - 1.0) * (since_hold / yield_time).max(0.0);
        for Palm { collider, outward, start } in &self.palms {
            let distance =
                if since_hold > 0.0 { radius * factor } else { start + share * (radius - start) };
            let position = self.centre + *outward * distance;
            cloth.move_collider(*collider, position, rotation_towards_centre(*outward))?;
        }
        Ok(true)
    }

    /// Ends the sequence early.
    ///
    /// # Errors
    /// As [`Cloth::remove_collider`].
    pub fn release(mut self, cloth: &mut Cloth) -> Result<()> {
        set_yield_angle(cloth, self.yield_angle)?;
        self.remove_palms(cloth)
    }

    fn remove_palms(&mut self, cloth: &mut Cloth) -> Result<()> {
        self.palms.drain(..).try_for_each(|palm| cloth.remove_collider(palm.collider))
    }
}

fn set_yield_angle(cloth: &mut Cloth, yield_angle: f32) -> Result<()> {
    let material = cloth.material().clone();
    cloth.set_material(Material { yield_angle, ..material })
}

/// Returns one of [`PALMS`] unit directions that are spread evenly over the sphere: a Fibonacci
/// lattice, in which each is rotated by the golden angle.
fn spread_direction(index: u32) -> Vec3 {
    let y = 1.0 - (2 * index + 1) as f32 / PALMS as f32;
    let (sin, cos) = (2.399_963 * index as f32).sin_cos();
    let horizontal = (1.0 - y * y).sqrt();
    Vec3::new(horizontal * cos, y, horizontal * sin)
}

/// Returns the rotation that turns the normal of a plane (+y) towards the centre.
fn rotation_towards_centre(outward: Vec3) -> Quat {
    Quat::from_rotation_arc(Vec3::Y, -outward)
}
