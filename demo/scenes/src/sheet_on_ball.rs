//! Scene: a free sheet falls onto a ball, drapes over it, and its corners hang down in folds.

use crate::instance::SceneInstance;
use crate::scene::{Scene, built, with_self_collision};
use glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Result, Settings, Shape, Wind};

/// A square sheet without pins above a ball.
#[derive(Clone, Copy, Debug)]
pub struct SheetOnBall;

impl SheetOnBall {
    /// Length of a side [m].
    pub const SIZE: f32 = 2.0;
    /// Centre of the ball [m].
    pub const CENTRE: Vec3 = Vec3::new(0.0, -0.3, 0.0);
    /// Radius of the ball [m].
    pub const RADIUS: f32 = 0.55;
    /// Initial height of the sheet above the centre of the ball [m].
    const DROP: f32 = 0.95;

    /// Returns the descriptor of a flat sheet above the ball, with this many particles per side.
    pub fn desc(particles_per_side: u32) -> GridDesc {
        let half = Self::SIZE / 2.0;
        GridDesc {
            columns: particles_per_side,
            rows: particles_per_side,
            spacing: Self::SIZE / (particles_per_side.max(2) - 1) as f32,
            origin: Self::CENTRE + Vec3::new(-half, Self::DROP, -half),
            down: Vec3::Z,
            pin_mode: PinMode::None,
            settings: with_self_collision(
                Settings::default(),
                particles_per_side * particles_per_side,
            ),
            ..GridDesc::default()
        }
    }

    /// Adds the ball as a collider. Draw it a little smaller than [`SheetOnBall::RADIUS`]:
    /// triangles of the cloth are flat, so between their corners they come closer to its centre.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn add_ball(cloth: &mut Cloth) -> Result<()> {
        let ball = ColliderDesc {
            shape: Shape::Sphere,
            position: Self::CENTRE,
            radius: Self::RADIUS,
            ..ColliderDesc::default()
        };
        cloth.add_collider(&ball).map(|_| ())
    }

    /// Returns a light, gusty wind of `speed` [m/s] across the sheet.
    pub fn wind(speed: f32) -> Wind {
        Wind {
            velocity: Vec3::new(0.5, 0.0, 1.0).normalize() * speed,
            gust: 0.7,
            wander: 0.8,
            turbulence: 0.3,
            seed: 3,
            ..Wind::default()
        }
    }
}

impl Scene for SheetOnBall {
    const NAME: &'static str = "sheet on a ball";
    const ABOUT: &'static str = "It falls, drapes over the ball, and its corners fold.";

    fn build() -> SceneInstance {
        let cloth = Cloth::grid(&Self::desc(40)).and_then(|mut cloth| {
            Self::add_ball(&mut cloth)?;
            Ok(cloth)
        });
        built(cloth)
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let cloth = &instance.cloths[0];
        let distance = |x: &Vec3| x.distance(Self::CENTRE) - Self::RADIUS;
        let nearest = cloth.positions().iter().map(distance).fold(f32::MAX, f32::min);
        if nearest < -2.0e-3 {
            return Err(format!("a particle is {nearest} m inside the ball"));
        }
        let middle = &cloth.positions()[20 * 40 + 20];
        if distance(middle) > 0.02 {
            return Err(format!(
                "the middle of the sheet is {} m above the ball",
                distance(middle)
            ));
        }
        let lowest = cloth.positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
        if lowest > Self::CENTRE.y {
            return Err(format!("the corners do not hang down: the lowest is at {lowest} m"));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.1 {
            return Err(format!("the largest stretch is {stretch}"));
        }
        Ok(())
    }
}
