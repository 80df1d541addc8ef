//! Measures of a draped disc, seen from above: its drape coefficient, and the folds of its rim.

use glam::{Vec2, Vec3};
use muslin::Cloth;
use std::f32::consts::TAU;

/// Cells along each side of the square raster in which the shadow is counted.
const CELLS: usize = 640;

/// Returns the drape coefficient of Cusick, 0 to 1: the share that the disc shades of the ring
/// between the supporting disc (radius `support` [m]) and the flat fabric (`radius` [m]). The first
/// vertex of the cloth is its centre.
///
/// ```text
///   (shadow − π support²) / (π radius² − π support²)
/// ```
pub fn drape_coefficient(cloth: &Cloth, support: f32, radius: f32) -> f32 {
    let disc = |radius: f32| 0.5 * TAU * radius * radius;
    (shadow_area(cloth, 1.1 * radius) - disc(support)) / (disc(radius) - disc(support))
}

/// Returns the area that the cloth shades in the square of half-size `half_size` [m] around its
/// first vertex [m²]: the cells whose centre is inside the projection of a triangle.
fn shadow_area(cloth: &Cloth, half_size: f32) -> f32 {
    let x = cloth.positions();
    let cell = 2.0 * half_size / CELLS as f32;
    let project =
        |i: u32| (Vec2::new(x[i as usize].x - x[0].x, x[i as usize].z - x[0].z) + half_size) / cell;
    let mut shaded = vec![false; CELLS * CELLS];
    for t in cloth.indices().chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(project);
        let orientation = (b - a).perp_dot(c - a);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let cells = |low: f32, high: f32| {
            (low - 0.5).ceil().max(0.0) as usize
                ..((high + 0.5).floor().max(0.0) as usize).min(CELLS)
        };
        for row in cells(low.y, high.y) {
            for column in cells(low.x, high.x) {
                let centre = Vec2::new(column as f32 + 0.5, row as f32 + 0.5);
                let left_of = |a: Vec2, b: Vec2| (b - a).perp_dot(centre - a) * orientation >= 0.0;
                if left_of(a, b) && left_of(b, c) && left_of(c, a) {
                    shaded[row * CELLS + column] = true;
                }
            }
        }
    }
    shaded.iter().filter(|shaded| **shaded).count() as f32 * cell * cell
}

/// Distances of the rim of a disc from its centre, seen from above, at equal angles around it [m].
#[derive(Clone, Debug, PartialEq)]
pub struct Outline(Vec<f32>);

/// Number of angles in an outline.
const ANGLES: usize = 360;

impl Outline {
    /// Measures a disc of this radius [m] whose centre is the first vertex.
    pub fn from_cloth(cloth: &Cloth, radius: f32) -> Self {
        let x = cloth.positions();
        let flat = |x: Vec3| Vec2::new(x.x, x.z);
        let mut rim: Vec<_> = cloth
            .uvs()
            .iter()
            .zip(x)
            .filter(|(uv, _)| (**uv - 0.5).length() > 0.5 - 1.0e-4)
            // Sorted by the angle at rest: folds may lie over each other.
            .map(|(uv, at)| (((0.5 - uv.y).atan2(uv.x - 0.5)).rem_euclid(TAU), flat(*at - x[0])))
            .collect();
        rim.sort_by(|a, b| a.0.total_cmp(&b.0));
        let distance = |turn: f32| {
            let next = rim.partition_point(|(angle, _)| *angle < turn) % rim.len();
            let last = (next + rim.len() - 1) % rim.len();
            let gap = (rim[next].0 - rim[last].0).rem_euclid(TAU);
            let share = (turn - rim[last].0).rem_euclid(TAU) / gap.max(1.0e-6);
            rim[last].1.lerp(rim[next].1, share).length().min(1.1 * radius)
        };
        Self((0..ANGLES).map(|i| distance(TAU * i as f32 / ANGLES as f32)).collect())
    }

    /// Counts the folds: excursions of the rim outwards and back by a quarter of its whole range. A
    /// rim whose range is below a hundredth of its largest distance has none.
    pub fn count_folds(&self) -> usize {
        let low = self.0.iter().copied().fold(f32::MAX, f32::min);
        let high = self.0.iter().copied().fold(0.0, f32::max);
        if high - low < 0.01 * high {
            return 0;
        }
        let step = 0.25 * (high - low);
        // One pass around from the innermost point: each move outwards by a step, after one
        // inwards, is a fold.
        let start = self.0.iter().position(|distance| *distance == low).unwrap_or(0);
        let (mut folds, mut is_out, mut extremum) = (0, false, low);
        for i in 0..self.0.len() {
            let distance = self.0[(start + i) % self.0.len()];
            extremum = if is_out { extremum.max(distance) } else { extremum.min(distance) };
            if (distance - extremum).abs() > step {
                is_out = !is_out;
                extremum = distance;
                folds += usize::from(is_out);
            }
        }
        folds
    }
}
