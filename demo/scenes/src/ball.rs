//! A sheet that falls on a ball: it lands, slides into folds and lies.

use crate::{Cast, Scene, apart};
use glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Result, Settings, Shape, Wind};

/// A square sheet that nothing holds, over a ball.
#[derive(Clone, Copy, Debug)]
pub struct SheetOnBall;

impl SheetOnBall {
    /// Length of a side [m].
    pub const SIZE: f32 = 2.0;
    /// The middle of the ball [m].
    pub const CENTRE: Vec3 = Vec3::new(0.0, -0.3, 0.0);
    /// Its radius [m].
    pub const RADIUS: f32 = 0.55;
    /// How high over its middle the sheet starts [m].
    const DROP: f32 = 0.95;

    /// The descriptor of a flat sheet over the ball, with so many particles a side.
    pub fn desc(particles_a_side: u32) -> GridDesc {
        let half = Self::SIZE / 2.0;
        GridDesc {
            columns: particles_a_side,
            rows: particles_a_side,
            spacing: Self::SIZE / (particles_a_side.max(2) - 1) as f32,
            origin: Self::CENTRE + Vec3::new(-half, Self::DROP, -half),
            down: Vec3::Z,
            pin_mode: PinMode::None,
            settings: apart(Settings::default(), particles_a_side * particles_a_side),
            ..GridDesc::default()
        }
    }

    /// Puts the ball under the sheet. Triangles cut its corners, so what is drawn may be a little
    /// smaller than [`SheetOnBall::RADIUS`].
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn put_ball(cloth: &mut Cloth) -> Result<()> {
        let ball = ColliderDesc {
            shape: Shape::Sphere,
            position: Self::CENTRE,
            radius: Self::RADIUS,
            ..ColliderDesc::default()
        };
        cloth.add_collider(&ball).map(|_| ())
    }

    /// A breath of wind across the sheet, of `speed` [m/s].
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
    const ABOUT: &'static str = "It falls, takes the shape of the ball, and its corners fold.";

    fn build() -> Cast {
        let made = Cloth::grid(&Self::desc(40)).and_then(|mut cloth| {
            Self::put_ball(&mut cloth)?;
            Ok(cloth)
        });
        match made {
            Ok(cloth) => cloth.into(),
            Err(error) => unreachable!("the scene's own descriptor: {error}"),
        }
    }

    fn check(cast: &Cast) -> core::result::Result<(), String> {
        let cloth = &cast.cloths[0];
        let away = |at: &Vec3| at.distance(Self::CENTRE) - Self::RADIUS;
        let nearest = cloth.positions().iter().map(away).fold(f32::MAX, f32::min);
        if nearest < -2.0e-3 {
            return Err(format!("a particle is {nearest} m inside the ball"));
        }
        let middle = &cloth.positions()[20 * 40 + 20];
        if away(middle) > 0.02 {
            return Err(format!("its middle is {} m off the ball", away(middle)));
        }
        let lowest = cloth.positions().iter().map(|at| at.y).fold(f32::MAX, f32::min);
        if lowest > Self::CENTRE.y {
            return Err(format!("its corners do not hang: the lowest is at {lowest} m"));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.1 {
            return Err(format!("it is stretched by {stretch}"));
        }
        Ok(())
    }
}
