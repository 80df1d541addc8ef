//! A scene while it runs: its cloths, and a ball that rolls through them if there is one.
//!
//! The ball is a collider of the first cloth. It moves along z as a cosine of time, so before each
//! tick it gets the pose at the end of that tick, and the collider sweeps there.

use glam::{Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Result, Settings, Shape};
use std::f32::consts::TAU;

/// The cloths of a scene, and the ball that moves through them.
#[derive(Debug)]
pub struct SceneInstance {
    /// The cloths, in the order of the scene.
    pub cloths: Vec<Cloth>,
    ball: Option<RollingBall>,
}

/// Motion of a ball that rolls back and forth along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallMotion {
    /// Midpoint of the motion [m].
    pub centre: Vec3,
    /// Radius of the ball [m].
    pub radius: f32,
    /// Largest distance from the midpoint [m].
    pub amplitude: f32,
    /// Duration of one cycle [s].
    pub period: f32,
}

/// The ball of a running scene.
#[derive(Debug)]
struct RollingBall {
    motion: BallMotion,
    /// Collider of the first cloth.
    collider: Collider,
    /// Number of ticks that it has moved for.
    ticks: u32,
}

impl BallMotion {
    /// Returns position and rotation `seconds` after the ball was at its largest z.
    pub fn pose_at(&self, seconds: f32) -> (Vec3, Quat) {
        let z = self.amplitude * (TAU * seconds / self.period).cos();
        (self.centre + Vec3::Z * z, Quat::from_rotation_x(z / self.radius))
    }
}

impl From<Cloth> for SceneInstance {
    fn from(cloth: Cloth) -> Self {
        Self { cloths: vec![cloth], ball: None }
    }
}

impl From<Vec<Cloth>> for SceneInstance {
    fn from(cloths: Vec<Cloth>) -> Self {
        Self { cloths, ball: None }
    }
}

impl SceneInstance {
    /// Creates an instance of one cloth, and adds a ball that rolls through it.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn with_ball(mut cloth: Cloth, motion: BallMotion) -> Result<Self> {
        let (position, rotation) = motion.pose_at(0.0);
        let collider = cloth.add_collider(&ColliderDesc {
            shape: Shape::Sphere,
            radius: motion.radius,
            position,
            rotation,
            ..ColliderDesc::default()
        })?;
        Ok(Self { cloths: vec![cloth], ball: Some(RollingBall { motion, collider, ticks: 0 }) })
    }

    /// Returns centre and radius of the ball [m], if there is one.
    pub fn ball(&self) -> Option<(Vec3, f32)> {
        let ball = self.ball.as_ref()?;
        Some((ball.motion.pose_at(ball.seconds(&self.cloths[0])).0, ball.motion.radius))
    }

    /// Runs exactly `ticks` ticks of every cloth.
    pub fn step(&mut self, ticks: u32) {
        let Some(ball) = &mut self.ball else {
            self.cloths.iter_mut().for_each(|cloth| cloth.step(ticks));
            return;
        };
        for _ in 0..ticks {
            ball.set_target(&mut self.cloths[0]);
            self.cloths[0].step(1);
            ball.ticks = ball.ticks.wrapping_add(1);
        }
    }

    /// Runs the ticks that `seconds` [s] of frame time are due.
    ///
    /// # Errors
    /// As [`Cloth::advance`]: `seconds` is negative or not finite.
    pub fn advance(&mut self, seconds: f32) -> Result<()> {
        let Some(ball) = &mut self.ball else {
            return self.cloths.iter_mut().try_for_each(|cloth| cloth.advance(seconds).map(|_| ()));
        };
        let cloth = &mut self.cloths[0];
        let Settings { tick, max_ticks_per_advance, .. } = *cloth.settings();
        // One tick at a time, so that the ball moves in every tick, also of a late frame.
        let mut remaining = seconds.min(tick * max_ticks_per_advance as f32);
        loop {
            ball.set_target(cloth);
            ball.ticks = ball.ticks.wrapping_add(cloth.advance(remaining.min(tick))?);
            remaining -= tick;
            if remaining <= 0.0 {
                return Ok(());
            }
        }
    }
}

impl RollingBall {
    /// Returns the time within the current cycle [s].
    fn seconds(&self, cloth: &Cloth) -> f32 {
        // The remainder of whole cycles, so that f32 holds the time exactly however long it runs.
        let period = (self.motion.period / cloth.settings().tick).round().max(1.0);
        (f64::from(self.ticks) % f64::from(period)) as f32 * cloth.settings().tick
    }

    /// Moves the collider to the pose that the ball has after the next tick.
    fn set_target(&self, cloth: &mut Cloth) {
        let (position, rotation) = self.motion.pose_at(self.seconds(cloth) + cloth.settings().tick);
        let result = cloth.move_collider(self.collider, position, rotation);
        debug_assert!(result.is_ok(), "the ball of the scene does not move: {result:?}");
    }
}
