//! Scene: a curtain of two panels on a rod, and a person who walks through between them.

use crate::instance::SceneInstance;
use crate::scene::{FLOOR, Scene, built, with_self_collision};
use crate::walker::Walker;
use glam::{Vec2, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Result, Settings};
use std::f32::consts::TAU;

/// A curtain in two panels above a floor.
#[derive(Clone, Copy, Debug)]
pub struct Doorway;

impl Doorway {
    /// Width and height of a panel when it lies flat [m].
    pub const SIZE: Vec2 = Vec2::new(1.16, 2.05);
    /// Midpoint of the rod [m].
    pub const ROD: Vec3 = Vec3::new(0.0, 0.76, 0.0);
    /// Width of a hanging panel [m].
    pub const WIDTH: f32 = 0.82;
    /// Number of rings of a panel.
    pub const RINGS: u32 = 6;
    /// Distance from the axis of the rod down to the top of the fabric [m].
    pub const DROP: f32 = 0.06;
    /// Largest distances of the walker from the middle along x and z [m].
    pub const BOUNDS: Vec2 = Vec2::new(0.5, 1.05);
    /// Width of fabric that the particles of the resolution spread over [m].
    const REFERENCE: f32 = 2.0;

    /// Returns columns and rows of a panel at a resolution: particles across two metres.
    pub fn grid_size(resolution: u32) -> [u32; 2] {
        let count = |side: f32| (side / Self::spacing(resolution)).round() as u32 + 1;
        [count(Self::SIZE.x), count(Self::SIZE.y)]
    }

    /// Returns the distance between neighbouring particles [m].
    pub fn spacing(resolution: u32) -> f32 {
        Self::REFERENCE / (resolution.max(2) - 1) as f32
    }

    /// Returns the descriptor of a flat panel.
    pub fn desc(resolution: u32) -> GridDesc {
        let [columns, rows] = Self::grid_size(resolution);
        let settings = Settings { substeps: 8, max_stretch: 0.02, ..Settings::default() };
        GridDesc {
            columns,
            rows,
            spacing: Self::spacing(resolution),
            origin: Self::ROD - Vec3::Y * Self::DROP,
            pin_mode: PinMode::None,
            settings: with_self_collision(settings, columns * rows),
            ..GridDesc::default()
        }
    }

    /// Creates the panels of this descriptor over a floor `clearance` [m] above that of the stage:
    /// folded, pinned to the rings, with the walker behind them.
    ///
    /// # Errors
    /// As [`Cloth::grid`].
    pub fn hang(desc: &GridDesc, clearance: f32) -> Result<SceneInstance> {
        let mut cloths = vec![Self::panel(desc, -Self::WIDTH)?, Self::panel(desc, 0.0)?];
        let position = Vec3::Y * (FLOOR + clearance);
        for cloth in &mut cloths {
            cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() })?;
        }
        let walker = Walker::new(&mut cloths, Self::BOUNDS)?;
        Ok(SceneInstance::with_walker(cloths, walker))
    }

    /// Creates the panel with its left edge at `left` [m]. Columns run from left to right in both
    /// panels, so that both show their front.
    fn panel(desc: &GridDesc, left: f32) -> Result<Cloth> {
        let mut cloth = Cloth::grid(desc)?;
        let places = folds(desc.columns, desc.spacing);
        for row in 0..desc.rows {
            for (column, place) in (0..desc.columns).zip(&places) {
                let particle = row * desc.columns + column;
                let height = cloth.positions()[particle as usize].y;
                cloth.set_position(particle, Vec3::new(left + place.x, height, place.y))?;
            }
        }
        for column in Self::ring_columns(desc.columns) {
            cloth.pin(column, None)?;
        }
        Ok(cloth)
    }

    /// Returns the points at which the rings of both panels hold the fabric [m].
    pub fn ring_positions(resolution: u32) -> Vec<Vec3> {
        let [columns, _] = Self::grid_size(resolution);
        let places = folds(columns, Self::spacing(resolution));
        let held = |left: f32| {
            let places = Self::ring_columns(columns).map(|column| places[column as usize]);
            places.map(move |at| Self::ROD + Vec3::new(left + at.x, -Self::DROP, at.y))
        };
        held(-Self::WIDTH).chain(held(0.0)).collect()
    }

    fn ring_columns(columns: u32) -> impl Iterator<Item = u32> {
        (0..Self::RINGS).map(move |ring| ring * (columns - 1) / (Self::RINGS - 1))
    }
}

/// Returns x and z of the particles of a row: one fold between each two rings, alternately to the
/// front and to the back, along a curve that is as long as the row and [`Doorway::WIDTH`] wide.
fn folds(columns: u32, spacing: f32) -> Vec<Vec2> {
    let count = (Doorway::RINGS - 1) as f32 / 2.0;
    let curve = |swing: f32| {
        let mut place = Vec2::ZERO;
        let mut places = vec![place];
        for i in 1..columns {
            let share = (i as f32 - 0.5) / (columns - 1) as f32;
            place += Vec2::from_angle(swing * (TAU * count * share).cos()) * spacing;
            places.push(place);
        }
        (places, place.x)
    };
    // The more the direction swings, the narrower the curve.
    let (mut low, mut high) = (0.0_f32, 1.4_f32);
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if curve(middle).1 > Doorway::WIDTH {
            low = middle;
        } else {
            high = middle;
        }
    }
    curve(low).0
}

impl Scene for Doorway {
    const NAME: &'static str = "curtain to walk through";
    const ABOUT: &'static str = "Its two panels part around who walks through, and close again.";

    fn build() -> SceneInstance {
        built(Self::hang(&Self::desc(40), 0.0))
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let walker = instance.walker().ok_or("there is no walker")?;
        let [radius, _] = Walker::RADII;
        let (low, high) = (FLOOR + radius, FLOOR + Walker::HEIGHTS[0] - radius);
        for cloth in &instance.cloths {
            for x in cloth.positions() {
                let axis = walker.position().with_y(x.y.clamp(low, high));
                let gap = x.distance(axis) - radius;
                if gap < -4.0e-3 {
                    return Err(format!("a particle at {x} is {} m inside the walker", -gap));
                }
                if x.y < FLOOR - 1.0e-3 {
                    return Err(format!("a particle is under the floor, at {} m", x.y));
                }
            }
            let stretch = cloth.stats().max_stretch;
            if stretch > 0.06 {
                return Err(format!("the largest stretch is {stretch}"));
            }
        }
        Ok(())
    }
}
