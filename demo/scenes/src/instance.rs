//! A scene while it runs: its cloths, and a ball, a figure or a walker that moves through them if
//! there is one.
//!
//! The ball is a collider of the first cloth and moves along z as a cosine of time; the figure wears
//! the first cloth; the walker is a collider of all cloths. Before each tick they get their pose at
//! the end of that tick, and the colliders sweep there.

use crate::figure::dressed::DressedBody;
use crate::walker::Walker;
use glam::{Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Result, Settings, Shape};
use std::f32::consts::TAU;

/// The cloths of a scene, and what moves through them.
#[derive(Debug)]
pub struct SceneInstance {
    /// The cloths, in the order of the scene.
    pub cloths: Vec<Cloth>,
    mover: Option<Mover>,
}

/// What moves through the cloths.
#[derive(Debug)]
enum Mover {
    Ball(RollingBall),
    Figure(Box<DressedBody>),
    Walker(Walker),
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
        Self { cloths: vec![cloth], mover: None }
    }
}

impl From<Vec<Cloth>> for SceneInstance {
    fn from(cloths: Vec<Cloth>) -> Self {
        Self { cloths, mover: None }
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
        let ball = RollingBall { motion, collider, ticks: 0 };
        Ok(Self { cloths: vec![cloth], mover: Some(Mover::Ball(ball)) })
    }

    /// Creates an instance of the clothes that a figure wears.
    pub(crate) fn with_figure(cloth: Cloth, body: DressedBody) -> Self {
        Self { cloths: vec![cloth], mover: Some(Mover::Figure(Box::new(body))) }
    }

    /// Creates an instance of cloths that a walker is a collider of.
    pub(crate) fn with_walker(cloths: Vec<Cloth>, walker: Walker) -> Self {
        Self { cloths, mover: Some(Mover::Walker(walker)) }
    }

    /// Returns centre and radius of the ball [m], if there is one.
    pub fn ball(&self) -> Option<(Vec3, f32)> {
        let Some(Mover::Ball(ball)) = &self.mover else {
            return None;
        };
        Some((ball.motion.pose_at(ball.seconds(&self.cloths[0])).0, ball.motion.radius))
    }

    /// Returns the figure, if there is one.
    pub fn figure(&self) -> Option<&DressedBody> {
        match &self.mover {
            Some(Mover::Figure(body)) => Some(body),
            _ => None,
        }
    }

    /// Returns the walker, if there is one.
    pub fn walker(&self) -> Option<&Walker> {
        match &self.mover {
            Some(Mover::Walker(walker)) => Some(walker),
            _ => None,
        }
    }

    /// Returns the walker to send it somewhere, if there is one.
    pub fn walker_mut(&mut self) -> Option<&mut Walker> {
        match &mut self.mover {
            Some(Mover::Walker(walker)) => Some(walker),
            _ => None,
        }
    }

    /// Returns the cloths, and the figure if there is one.
    pub fn parts(&mut self) -> (&mut [Cloth], Option<&DressedBody>) {
        let figure = match &self.mover {
            Some(Mover::Figure(body)) => Some(&**body),
            _ => None,
        };
        (&mut self.cloths, figure)
    }

    /// Updates what is drawn of the figure, if there is one.
    ///
    /// # Errors
    /// As [`DressedBody::update_drawn`].
    pub fn update_drawn(&mut self) -> Result<()> {
        match &mut self.mover {
            Some(Mover::Figure(body)) => body.update_drawn(&self.cloths[0]),
            _ => Ok(()),
        }
    }

    /// Runs exactly `ticks` ticks of every cloth.
    pub fn step(&mut self, ticks: u32) {
        let Some(mover) = &mut self.mover else {
            self.cloths.iter_mut().for_each(|cloth| cloth.step(ticks));
            return;
        };
        for _ in 0..ticks {
            mover.set_targets(&mut self.cloths);
            self.cloths.iter_mut().for_each(|cloth| cloth.step(1));
            mover.add_ticks(1);
        }
    }

    /// Runs the ticks that `seconds` [s] of frame time are due.
    ///
    /// # Errors
    /// As [`Cloth::advance`]: `seconds` is negative or not finite.
    pub fn advance(&mut self, seconds: f32) -> Result<()> {
        let Some(mover) = &mut self.mover else {
            return Cloth::advance_many(&mut self.cloths, seconds).map(|_| ());
        };
        let Settings { tick, max_ticks_per_advance, .. } = *self.cloths[0].settings();
        // One tick at a time, so that it moves in every tick, also of a late frame.
        let mut remaining = seconds.min(tick * max_ticks_per_advance as f32);
        loop {
            mover.set_targets(&mut self.cloths);
            let ticks = Cloth::advance_many(&mut self.cloths, remaining.min(tick))?;
            mover.add_ticks(ticks[0]);
            remaining -= tick;
            if remaining <= 0.0 {
                return Ok(());
            }
        }
    }
}

impl Mover {
    /// Sets the poses at the end of the next tick.
    fn set_targets(&mut self, cloths: &mut [Cloth]) {
        match self {
            Self::Ball(ball) => ball.set_target(&mut cloths[0]),
            Self::Figure(body) => body.set_targets(&mut cloths[0]),
            Self::Walker(walker) => walker.set_targets(cloths),
        }
    }

    /// Counts ticks that have run.
    fn add_ticks(&mut self, ticks: u32) {
        match self {
            Self::Ball(ball) => ball.ticks = ball.ticks.wrapping_add(ticks),
            Self::Figure(body) => body.add_ticks(ticks),
            Self::Walker(walker) => walker.add_ticks(ticks),
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
