//! Scene: a gathered curtain hangs from the rings of a rod, and a ball rolls back and forth through
//! it.

use crate::instance::{BallMotion, SceneInstance};
use crate::scene::{FLOOR, Scene, built, with_self_collision};
use glam::{Vec2, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Result, Settings};
use std::f32::consts::TAU;

/// A curtain on rings above a floor.
#[derive(Clone, Copy, Debug)]
pub struct Curtain;

impl Curtain {
    /// Width and height of the fabric when it lies flat [m].
    pub const SIZE: Vec2 = Vec2::new(2.6, 1.85);
    /// Midpoint of the rod [m].
    pub const ROD: Vec3 = Vec3::new(0.0, 0.92, 0.0);
    /// Distance between the outermost rings [m].
    pub const WIDTH: f32 = 2.0;
    /// Number of rings.
    pub const RINGS: u32 = 11;
    /// Distance from the axis of the rod down to the top of the fabric [m].
    pub const DROP: f32 = 0.06;
    /// Motion of the ball, which rolls on the floor.
    pub const BALL: BallMotion = BallMotion {
        centre: Vec3::new(0.1, FLOOR + 0.36, 0.0),
        radius: 0.36,
        amplitude: 1.15,
        period: 8.0,
    };

    /// Returns columns and rows of a grid with this many particles across.
    pub fn grid_size(particles_across: u32) -> [u32; 2] {
        let spacing = Self::spacing(particles_across);
        [particles_across.max(2), (Self::SIZE.y / spacing).round() as u32 + 1]
    }

    /// Returns the distance between neighbouring particles [m] for this many across.
    pub fn spacing(particles_across: u32) -> f32 {
        Self::SIZE.x / (particles_across.max(2) - 1) as f32
    }

    /// Returns the descriptor of a flat curtain with this many particles across.
    pub fn desc(particles_across: u32) -> GridDesc {
        let [columns, rows] = Self::grid_size(particles_across);
        // 8 substeps: the ball loads few rings at a time, and moves far in a substep.
        let settings = Settings { substeps: 8, max_stretch: 0.02, ..Settings::default() };
        GridDesc {
            columns,
            rows,
            spacing: Self::spacing(particles_across),
            origin: Self::ROD + Vec3::new(-0.5 * Self::SIZE.x, -Self::DROP, 0.0),
            pin_mode: PinMode::None,
            settings: with_self_collision(settings, columns * rows),
            ..GridDesc::default()
        }
    }

    /// Creates a cloth of this descriptor, folds it between the rings, and pins it to them.
    ///
    /// # Errors
    /// As [`Cloth::grid`].
    pub fn hang_on_rings(desc: &GridDesc) -> Result<Cloth> {
        let mut cloth = Cloth::grid(desc)?;
        for row in 0..desc.rows {
            for column in 0..desc.columns {
                let particle = row * desc.columns + column;
                let height = cloth.positions()[particle as usize].y;
                let point = point_on_folds(column as f32 / (desc.columns - 1) as f32);
                cloth.set_position(particle, Vec3::new(point.x, height, point.y))?;
            }
        }
        for column in Self::ring_columns(desc.columns) {
            cloth.pin(column, None)?;
        }
        Ok(cloth)
    }

    /// Returns the points at which the rings hold the fabric [m].
    pub fn ring_positions() -> impl Iterator<Item = Vec3> {
        (0..Self::RINGS).map(|ring| {
            let point = point_on_folds(ring as f32 / (Self::RINGS - 1) as f32);
            Self::ROD + Vec3::new(point.x, -Self::DROP, point.y)
        })
    }

    /// Returns the columns of particles that the rings hold.
    pub fn ring_columns(columns: u32) -> impl Iterator<Item = u32> {
        (0..Self::RINGS).map(move |ring| ring * (columns - 1) / (Self::RINGS - 1))
    }

    /// Adds the floor as a collider.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn add_floor(cloth: &mut Cloth) -> Result<()> {
        let floor = ColliderDesc { position: Vec3::Y * FLOOR, ..ColliderDesc::default() };
        cloth.add_collider(&floor).map(|_| ())
    }
}

/// Returns the point [m] at a share 0 to 1 of the width of the fabric, seen from above. There is
/// one fold between each two rings, alternately to the front and to the back. The curve is as long
/// as the fabric is wide, so no thread is stretched.
///
/// ```text
/// direction(s) = SWING cos(2π folds s),   point(s) = ∫₀ˢ (cos direction, sin direction) SIZE.x ds
/// ```
fn point_on_folds(share: f32) -> Vec2 {
    // Number of steps of the numerical integration.
    const STEPS: usize = 2000;
    let step = Curtain::SIZE.x / STEPS as f32;
    let folds = (Curtain::RINGS - 1) as f32 / 2.0;
    let mut point = Vec2::new(-0.5 * Curtain::WIDTH, 0.0);
    let steps = share * STEPS as f32;
    for i in 0..steps.ceil() as usize {
        let along = (i as f32 + 0.5) / STEPS as f32;
        point += Vec2::from_angle(SWING * (TAU * folds * along).cos())
            * (step * (steps - i as f32).min(1.0));
    }
    point
}

/// Amplitude of the direction along a fold [rad]. J₀(`SWING`) = `WIDTH` / `SIZE.x`, with the Bessel
/// function J₀, so that the curve ends at the last ring.
const SWING: f32 = 0.999;

impl Scene for Curtain {
    const NAME: &'static str = "curtain with a ball";
    const ABOUT: &'static str =
        "A ball rolls through it; it slides over the ball and closes behind it.";

    fn build() -> SceneInstance {
        let instance = Self::hang_on_rings(&Self::desc(48)).and_then(|mut cloth| {
            Self::add_floor(&mut cloth)?;
            SceneInstance::with_ball(cloth, Self::BALL)
        });
        built(instance)
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let x = instance.cloths[0].positions();
        for column in Self::ring_columns(48) {
            let off = (x[column as usize].y - (Self::ROD.y - Self::DROP)).abs();
            if off > 1.0e-4 {
                return Err(format!("the fabric is {off} m off a ring"));
            }
        }
        let (centre, radius) = instance.ball().ok_or("there is no ball")?;
        let nearest = x.iter().map(|x| x.distance(centre) - radius).fold(f32::MAX, f32::min);
        if nearest < -2.0e-3 {
            return Err(format!("a particle is {nearest} m inside the ball"));
        }
        let lowest = x.iter().map(|x| x.y).fold(f32::MAX, f32::min);
        if lowest < FLOOR - 1.0e-3 {
            return Err(format!("a particle is under the floor, at {lowest} m"));
        }
        let stretch = instance.cloths[0].stats().max_stretch;
        if stretch > 0.05 {
            return Err(format!("the largest stretch is {stretch}"));
        }
        Ok(())
    }
}
