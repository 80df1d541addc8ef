//! The curtain: it hangs on rings at a rod, gathered, and a ball rolls to and fro through it.

use crate::{Cast, FLOOR, Roll, Scene, apart};
use glam::{Vec2, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Result, Settings};
use std::f32::consts::TAU;

/// A curtain on its rings, over a floor.
#[derive(Clone, Copy, Debug)]
pub struct Curtain;

impl Curtain {
    /// Width of the fabric, and its height [m].
    pub const SIZE: Vec2 = Vec2::new(2.6, 1.85);
    /// The middle of the rod [m].
    pub const ROD: Vec3 = Vec3::new(0.0, 0.92, 0.0);
    /// How far the rings are from the outermost ones on the other side [m].
    pub const WIDTH: f32 = 2.0;
    /// Rings on the rod.
    pub const RINGS: u32 = 11;
    /// How far below the middle of the rod the rings hold the fabric [m].
    pub const DROP: f32 = 0.06;
    /// The ball, which rolls on the floor.
    pub const BALL: Roll =
        Roll { centre: Vec3::new(0.1, FLOOR + 0.36, 0.0), radius: 0.36, reach: 1.15, period: 8.0 };

    /// Particles across and down, for so many across.
    pub fn weave(particles_across: u32) -> [u32; 2] {
        let spacing = Self::spacing(particles_across);
        [particles_across.max(2), (Self::SIZE.y / spacing).round() as u32 + 1]
    }

    /// From particle to particle, for so many across [m].
    pub fn spacing(particles_across: u32) -> f32 {
        Self::SIZE.x / (particles_across.max(2) - 1) as f32
    }

    /// The descriptor of a curtain with so many particles across, spread flat.
    pub fn desc(particles_across: u32) -> GridDesc {
        let [columns, rows] = Self::weave(particles_across);
        // The ball pulls at few rings at a time, and comes a long way in a substep.
        let settings = Settings { substeps: 8, max_stretch: 0.02, ..Settings::default() };
        GridDesc {
            columns,
            rows,
            spacing: Self::spacing(particles_across),
            origin: Self::ROD + Vec3::new(-0.5 * Self::SIZE.x, -Self::DROP, 0.0),
            pin_mode: PinMode::None,
            settings: apart(settings, columns * rows),
            ..GridDesc::default()
        }
    }

    /// Hangs a fabric of this descriptor on the rings, in folds, over nothing yet.
    ///
    /// # Errors
    /// As [`Cloth::grid`].
    pub fn hung(desc: &GridDesc) -> Result<Cloth> {
        let mut cloth = Cloth::grid(desc)?;
        for row in 0..desc.rows {
            for column in 0..desc.columns {
                let particle = row * desc.columns + column;
                let height = cloth.positions()[particle as usize].y;
                let place = fold(column as f32 / (desc.columns - 1) as f32);
                cloth.set_position(particle, Vec3::new(place.x, height, place.y))?;
            }
        }
        for column in Self::held(desc.columns) {
            cloth.pin(column, None)?;
        }
        Ok(cloth)
    }

    /// Where the rings hold the fabric [m].
    pub fn rings() -> impl Iterator<Item = Vec3> {
        (0..Self::RINGS).map(|ring| {
            let place = fold(ring as f32 / (Self::RINGS - 1) as f32);
            Self::ROD + Vec3::new(place.x, -Self::DROP, place.y)
        })
    }

    /// The columns that rings hold.
    pub fn held(columns: u32) -> impl Iterator<Item = u32> {
        (0..Self::RINGS).map(move |ring| ring * (columns - 1) / (Self::RINGS - 1))
    }

    /// Lays the floor.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn put_floor(cloth: &mut Cloth) -> Result<()> {
        let floor = ColliderDesc { position: Vec3::Y * FLOOR, ..ColliderDesc::default() };
        cloth.add_collider(&floor).map(|_| ())
    }
}

/// Where a share of the way along the fabric is, seen from above: a fold between any two rings, to the front and
/// to the back by turns. The folds are as long as the fabric, so no thread is stretched.
fn fold(share: f32) -> Vec2 {
    // As a sum of small steps along a curve whose direction swings: x of its end is `WIDTH`.
    const STEPS: usize = 2000;
    let step = Curtain::SIZE.x / STEPS as f32;
    let folds = (Curtain::RINGS - 1) as f32 / 2.0;
    let mut at = Vec2::new(-0.5 * Curtain::WIDTH, 0.0);
    let steps = share * STEPS as f32;
    for i in 0..steps.ceil() as usize {
        let along = (i as f32 + 0.5) / STEPS as f32;
        at += Vec2::from_angle(SWING * (TAU * folds * along).cos())
            * (step * (steps - i as f32).min(1.0));
    }
    at
}

/// How far the direction of a fold swings to either side [rad]: J0 of it is `WIDTH` over `SIZE.x`.
const SWING: f32 = 0.999;

impl Scene for Curtain {
    const NAME: &'static str = "curtain with a ball";
    const ABOUT: &'static str = "The ball rolls through it; it slides over and closes behind.";

    fn build() -> Cast {
        let made = Self::hung(&Self::desc(48)).and_then(|mut cloth| {
            Self::put_floor(&mut cloth)?;
            Cast::with_ball(cloth, Self::BALL)
        });
        match made {
            Ok(cast) => cast,
            Err(error) => unreachable!("the scene's own descriptor: {error}"),
        }
    }

    fn check(cast: &Cast) -> core::result::Result<(), String> {
        let x = cast.cloths[0].positions();
        for column in Self::held(48) {
            let off = (x[column as usize].y - (Self::ROD.y - Self::DROP)).abs();
            if off > 1.0e-4 {
                return Err(format!("it left a ring by {off} m"));
            }
        }
        let (centre, radius) = cast.ball().ok_or("there is no ball")?;
        let nearest = x.iter().map(|x| x.distance(centre) - radius).fold(f32::MAX, f32::min);
        if nearest < -2.0e-3 {
            return Err(format!("a particle is {nearest} m inside the ball"));
        }
        let lowest = x.iter().map(|x| x.y).fold(f32::MAX, f32::min);
        if lowest < FLOOR - 1.0e-3 {
            return Err(format!("a particle is under the floor, at {lowest} m"));
        }
        let stretch = cast.cloths[0].stats().max_stretch;
        if stretch > 0.05 {
            return Err(format!("it is stretched by {stretch}"));
        }
        Ok(())
    }
}
