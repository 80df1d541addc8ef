//! What a scene is played by: its cloths, and the ball that rolls through them, if one does.

use glam::{Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Result, Settings, Shape};
use std::f32::consts::TAU;

/// The cloths of a scene, and what moves among them by itself.
#[derive(Debug)]
pub struct Cast {
    /// Its cloths, in the order of the scene.
    pub cloths: Vec<Cloth>,
    ball: Option<Rolling>,
}

/// A ball that rolls to and fro along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roll {
    /// The middle of its way [m].
    pub centre: Vec3,
    /// Its radius [m].
    pub radius: f32,
    /// How far it rolls to either side [m].
    pub reach: f32,
    /// From the farthest point on one side to the next time there [s].
    pub period: f32,
}

/// The ball where it is now.
#[derive(Debug)]
struct Rolling {
    roll: Roll,
    /// Its collider in the first cloth.
    collider: Collider,
    /// Ticks that it has rolled for.
    ticks: u32,
}

impl Roll {
    /// Where it is, and how it is turned, `seconds` after it was farthest towards +z.
    pub fn at(&self, seconds: f32) -> (Vec3, Quat) {
        let z = self.reach * (TAU * seconds / self.period).cos();
        (self.centre + Vec3::Z * z, Quat::from_rotation_x(z / self.radius))
    }
}

impl From<Cloth> for Cast {
    fn from(cloth: Cloth) -> Self {
        Self { cloths: vec![cloth], ball: None }
    }
}

impl From<Vec<Cloth>> for Cast {
    fn from(cloths: Vec<Cloth>) -> Self {
        Self { cloths, ball: None }
    }
}

impl Cast {
    /// A cloth, and a ball that rolls through it.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn with_ball(mut cloth: Cloth, roll: Roll) -> Result<Self> {
        let (position, rotation) = roll.at(0.0);
        let collider = cloth.add_collider(&ColliderDesc {
            shape: Shape::Sphere,
            radius: roll.radius,
            position,
            rotation,
            ..ColliderDesc::default()
        })?;
        Ok(Self { cloths: vec![cloth], ball: Some(Rolling { roll, collider, ticks: 0 }) })
    }

    /// The middle of the ball and its radius [m], if there is one.
    pub fn ball(&self) -> Option<(Vec3, f32)> {
        let ball = self.ball.as_ref()?;
        Some((ball.roll.at(ball.seconds(&self.cloths[0])).0, ball.roll.radius))
    }

    /// Runs exactly so many ticks.
    pub fn step(&mut self, ticks: u32) {
        let Some(ball) = &mut self.ball else {
            self.cloths.iter_mut().for_each(|cloth| cloth.step(ticks));
            return;
        };
        for _ in 0..ticks {
            ball.send(&mut self.cloths[0]);
            self.cloths[0].step(1);
            ball.ticks = ball.ticks.wrapping_add(1);
        }
    }

    /// Lets `seconds` pass.
    ///
    /// # Errors
    /// As [`Cloth::advance`]: `seconds` below 0 or not finite.
    pub fn advance(&mut self, seconds: f32) -> Result<()> {
        let Some(ball) = &mut self.ball else {
            return self.cloths.iter_mut().try_for_each(|cloth| cloth.advance(seconds).map(|_| ()));
        };
        let cloth = &mut self.cloths[0];
        let Settings { tick, max_ticks_per_advance, .. } = *cloth.settings();
        // One tick at a time, so that the ball rolls through a late frame as through others.
        let mut left = seconds.min(tick * max_ticks_per_advance as f32);
        loop {
            ball.send(cloth);
            ball.ticks = ball.ticks.wrapping_add(cloth.advance(left.min(tick))?);
            left -= tick;
            if left <= 0.0 {
                return Ok(());
            }
        }
    }
}

impl Rolling {
    fn seconds(&self, cloth: &Cloth) -> f32 {
        // Whole periods leave a ball where it is, and few ticks are exact.
        let period = (self.roll.period / cloth.settings().tick).round().max(1.0);
        (f64::from(self.ticks) % f64::from(period)) as f32 * cloth.settings().tick
    }

    /// Sends the ball to where it is after the next tick.
    fn send(&self, cloth: &mut Cloth) {
        let (position, rotation) = self.roll.at(self.seconds(cloth) + cloth.settings().tick);
        let sent = cloth.move_collider(self.collider, position, rotation);
        debug_assert!(sent.is_ok(), "the scene's own collider: {sent:?}");
    }
}
