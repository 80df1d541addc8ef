//! What a draped disc shows from above: its shadow, and the folds of its rim.

use glam::{Vec2, Vec3};
use muslin::Cloth;
use std::f32::consts::TAU;

/// Cells along a side of the square in which a shadow is counted.
const CELLS: usize = 640;

/// The share of the ring between two radii [m] that a disc shades, seen from above: Cusick's drape coefficient,
/// from 0 to 1. Its first vertex is its middle.
pub fn drape_coefficient(cloth: &Cloth, held: f32, radius: f32) -> f32 {
    let disc = |radius: f32| 0.5 * TAU * radius * radius;
    (area(cloth, 1.1 * radius) - disc(held)) / (disc(radius) - disc(held))
}

/// The area that a cloth shades within `reach` of its first vertex [m²].
fn area(cloth: &Cloth, reach: f32) -> f32 {
    let x = cloth.positions();
    let cell = 2.0 * reach / CELLS as f32;
    let plan =
        |i: u32| (Vec2::new(x[i as usize].x - x[0].x, x[i as usize].z - x[0].z) + reach) / cell;
    let mut shaded = vec![false; CELLS * CELLS];
    for t in cloth.indices().chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(plan);
        let turned = (b - a).perp_dot(c - a);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let cells = |low: f32, high: f32| {
            (low - 0.5).ceil().max(0.0) as usize
                ..((high + 0.5).floor().max(0.0) as usize).min(CELLS)
        };
        for row in cells(low.y, high.y) {
            for column in cells(low.x, high.x) {
                let at = Vec2::new(column as f32 + 0.5, row as f32 + 0.5);
                let left_of = |a: Vec2, b: Vec2| (b - a).perp_dot(at - a) * turned >= 0.0;
                if left_of(a, b) && left_of(b, c) && left_of(c, a) {
                    shaded[row * CELLS + column] = true;
                }
            }
        }
    }
    shaded.iter().filter(|shaded| **shaded).count() as f32 * cell * cell
}

/// How far the rim of a disc is from its middle, seen from above, all around [m].
#[derive(Clone, Debug, PartialEq)]
pub struct Outline(Vec<f32>);

/// Directions in which an outline is told.
const AROUND: usize = 360;

impl Outline {
    /// Of the disc of this radius [m] whose middle is the first vertex.
    pub fn of(cloth: &Cloth, radius: f32) -> Self {
        let x = cloth.positions();
        let flat = |x: Vec3| Vec2::new(x.x, x.z);
        let mut rim: Vec<_> = cloth
            .uvs()
            .iter()
            .zip(x)
            .filter(|(uv, _)| (**uv - 0.5).length() > 0.5 - 1.0e-4)
            // By where it was woven: folds may lie over each other.
            .map(|(uv, at)| (((0.5 - uv.y).atan2(uv.x - 0.5)).rem_euclid(TAU), flat(*at - x[0])))
            .collect();
        rim.sort_by(|a, b| a.0.total_cmp(&b.0));
        let away = |turn: f32| {
            let next = rim.partition_point(|(at, _)| *at < turn) % rim.len();
            let last = (next + rim.len() - 1) % rim.len();
            let gap = (rim[next].0 - rim[last].0).rem_euclid(TAU);
            let share = (turn - rim[last].0).rem_euclid(TAU) / gap.max(1.0e-6);
            rim[last].1.lerp(rim[next].1, share).length().min(1.1 * radius)
        };
        Self((0..AROUND).map(|i| away(TAU * i as f32 / AROUND as f32)).collect())
    }

    /// How many folds there are: ways out and back in again by a quarter of what the rim swings in all. A rim that
    /// swings by less than a hundredth of its radius has none.
    pub fn folds(&self) -> usize {
        let low = self.0.iter().copied().fold(f32::MAX, f32::min);
        let high = self.0.iter().copied().fold(0.0, f32::max);
        if high - low < 0.01 * high {
            return 0;
        }
        let step = 0.25 * (high - low);
        // Around once from the innermost point: each way out by a step, after one back in, is a fold.
        let start = self.0.iter().position(|away| *away == low).unwrap_or(0);
        let (mut folds, mut is_out, mut turning) = (0, false, low);
        for i in 0..self.0.len() {
            let away = self.0[(start + i) % self.0.len()];
            turning = if is_out { turning.max(away) } else { turning.min(away) };
            if (away - turning).abs() > step {
                is_out = !is_out;
                turning = away;
                folds += usize::from(is_out);
            }
        }
        folds
    }
}
