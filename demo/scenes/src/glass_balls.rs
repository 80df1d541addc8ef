//! Scene: a free sheet falls onto two balls of glass, and three smaller ones lie beside it.

use crate::instance::SceneInstance;
use crate::scene::{FLOOR, Scene, built, with_self_collision};
use glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Result, Settings, Shape};

/// A square sheet without pins above balls that lie on a floor.
#[derive(Clone, Copy, Debug)]
pub struct GlassBalls;

/// A ball at x and z that lies on the floor.
const fn ball(x: f32, z: f32, radius: f32) -> (Vec3, f32) {
    (Vec3::new(x, FLOOR + radius, z), radius)
}

impl GlassBalls {
    /// Length of a side of the sheet [m].
    pub const SIZE: f32 = 1.7;
    /// Centres and radii of the balls [m].
    pub const BALLS: [(Vec3, f32); 5] = [
        ball(-0.44, -0.16, 0.60),
        ball(0.56, 0.06, 0.44),
        ball(0.04, 0.82, 0.27),
        ball(1.16, 0.66, 0.18),
        ball(-0.95, 0.76, 0.14),
    ];
    /// Initial height of the sheet above the floor [m].
    const DROP: f32 = 1.62;
    /// Middle of the sheet at the start, seen from above [m].
    const MIDDLE: [f32; 2] = [-0.02, -0.08];

    /// Returns the descriptor of a flat sheet above the balls, with this many particles per side.
    pub fn desc(particles_per_side: u32) -> GridDesc {
        let half = Self::SIZE / 2.0;
        let [x, z] = Self::MIDDLE;
        GridDesc {
            columns: particles_per_side,
            rows: particles_per_side,
            spacing: Self::SIZE / (particles_per_side.max(2) - 1) as f32,
            origin: Vec3::new(x - half, FLOOR + Self::DROP, z - half),
            down: Vec3::Z,
            pin_mode: PinMode::None,
            // It falls on both balls at once, which would stretch it between them.
            settings: with_self_collision(
                Settings { max_stretch: 0.06, ..Settings::default() },
                particles_per_side * particles_per_side,
            ),
            ..GridDesc::default()
        }
    }

    /// Adds the balls as colliders. Draw them a little smaller: triangles of the cloth are flat, so
    /// between their corners they come closer to the centre of a ball.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn add_balls(cloth: &mut Cloth) -> Result<()> {
        Self::BALLS.into_iter().try_for_each(|(position, radius)| {
            let ball =
                ColliderDesc { shape: Shape::Sphere, position, radius, ..ColliderDesc::default() };
            cloth.add_collider(&ball).map(|_| ())
        })
    }
}

impl Scene for GlassBalls {
    const NAME: &'static str = "sheet on balls of glass";
    const ABOUT: &'static str =
        "It falls on two balls, hangs between them, and leaves others bare.";

    fn build() -> SceneInstance {
        let cloth = Cloth::grid(&Self::desc(40)).and_then(|mut cloth| {
            let floor = ColliderDesc { position: Vec3::Y * FLOOR, ..ColliderDesc::default() };
            cloth.add_collider(&floor)?;
            Self::add_balls(&mut cloth)?;
            Ok(cloth)
        });
        built(cloth)
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let cloth = &instance.cloths[0];
        let gap = |ball: usize| {
            let (centre, radius) = Self::BALLS[ball];
            let gaps = cloth.positions().iter().map(move |x| x.distance(centre) - radius);
            gaps.fold(f32::MAX, f32::min)
        };
        for ball in 0..Self::BALLS.len() {
            if gap(ball) < -2.0e-3 {
                return Err(format!("a particle is {} m inside ball {ball}", -gap(ball)));
            }
        }
        for ball in [0, 1] {
            if gap(ball) > 0.02 {
                return Err(format!("the sheet is {} m off ball {ball}", gap(ball)));
            }
        }
        let lowest = cloth.positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
        if lowest < FLOOR - 1.0e-3 {
            return Err(format!("a particle is under the floor, at {lowest} m"));
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.1 {
            return Err(format!("the largest stretch is {stretch}"));
        }
        Ok(())
    }
}
