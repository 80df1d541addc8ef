//! A heightfield: ground over a grid of heights.

use crate::geometry::aabb::Aabb;
use crate::geometry::features::{EdgeFeature, Features, Sides, Steps};
use crate::math::{max, min};
use core::ops::RangeInclusive;
use glam::Vec3;

/// All that is below a surface over a regular grid in x and z, as deep as the field is wide. Each cell has
/// two triangles, divided from its first corner to the opposite one.
#[derive(Clone, Debug)]
pub(crate) struct Heightfield {
    columns: u32,
    rows: u32,
    spacing: f32,
    heights: Vec<f32>,
    bounds: Aabb,
    steps: Steps,
}

impl Heightfield {
    /// Heights row by row: along x, then along z.
    pub fn new(columns: u32, rows: u32, spacing: f32, heights: Vec<f32>) -> Self {
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for height in &heights {
            (low, high) = (min(*height, low), max(*height, high));
        }
        let (width, length) = ((columns - 1) as f32 * spacing, (rows - 1) as f32 * spacing);
        let bounds = Aabb {
            low: Vec3::new(0.0, low - max(width, length), 0.0),
            high: Vec3::new(width, high, length),
        };
        let steps = Steps::default();
        let mut terrain = Self { columns, rows, spacing, heights, bounds, steps };
        for (column, row) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)))
        {
            for to in SPOKES[..3].iter() {
                let ridge = terrain.ridge([column, row], *to);
                ridge.into_iter().for_each(|ridge| terrain.steps.add(ridge.bend));
            }
        }
        terrain
    }

    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The bends of its ridges.
    pub fn steps(&self) -> &Steps {
        &self.steps
    }

    pub fn spacing(&self) -> f32 {
        self.spacing
    }

    fn point(&self, column: u32, row: u32) -> Vec3 {
        let height = self.heights[(row * self.columns + column) as usize];
        Vec3::new(column as f32 * self.spacing, height, row as f32 * self.spacing)
    }

    /// How far a point is above the plane of the triangle that it is over or under, and the normal of that;
    /// nothing beside or far below the field.
    pub fn above(&self, p: Vec3) -> Option<(f32, Vec3)> {
        let Aabb { low, high } = self.bounds;
        let is_over = p.x >= low.x && p.x <= high.x && p.z >= low.z && p.z <= high.z;
        if !is_over || p.y < low.y {
            return None;
        }
        let cell = |x: f32, count: u32| ((x / self.spacing) as u32).min(count - 2);
        let (column, row) = (cell(p.x, self.columns), cell(p.z, self.rows));
        let (u, v) = (p.x - column as f32 * self.spacing, p.z - row as f32 * self.spacing);
        let (first, last) = (self.point(column, row), self.point(column + 1, row + 1));
        let side = if u > v { self.point(column + 1, row) } else { self.point(column, row + 1) };
        let slope = if u > v {
            Vec3::new(side.y - first.y, 0.0, last.y - side.y)
        } else {
            Vec3::new(last.y - side.y, 0.0, side.y - first.y)
        };
        let normal = Vec3::new(-slope.x, self.spacing, -slope.z);
        let normal = normal * (1.0 / normal.length());
        Some(((p - first).dot(normal), normal))
    }

    /// The grid's lines and rows under some bounds.
    fn under(&self, bounds: &Aabb) -> Option<[RangeInclusive<u32>; 2]> {
        let range = |low: f32, high: f32, count: u32| {
            // Casts saturate: what is beside the field ends at its rim.
            let (from, to) = ((low / self.spacing).floor(), (high / self.spacing).ceil());
            (to >= 0.0 && from <= (count - 1) as f32)
                .then(|| max(from, 0.0) as u32..=(to as u32).min(count - 1))
        };
        let columns = range(bounds.low.x, bounds.high.x, self.columns)?;
        Some([columns, range(bounds.low.z, bounds.high.z, self.rows)?])
    }

    /// The ridge from a point of the grid along a spoke; nothing where the surface folds up, not at all, or
    /// ends.
    fn ridge(&self, [column, row]: [u32; 2], (right, down): (i32, i32)) -> Option<EdgeFeature> {
        let at = |right: i32, down: i32| {
            let (column, row) = (column.checked_add_signed(right)?, row.checked_add_signed(down)?);
            (column < self.columns && row < self.rows).then(|| self.point(column, row))
        };
        let number = SPOKES.iter().position(|spoke| *spoke == (right, down))?;
        // Both triangles at a spoke have the spoke beside it as an edge.
        let [one, other] = [SPOKES[(number + 1) % 6], SPOKES[(number + 5) % 6]];
        let ends = [at(0, 0)?, at(right, down)?];
        let tips = [at(one.0, one.1)?, at(other.0, other.1)?];
        EdgeFeature::new(ends, tips, Sides::SignedDistance).filter(|ridge| ridge.out.y > 0.0)
    }

    /// Adds what is under some bounds and bends more than `is_mild` lets.
    pub fn find_under(
        &self,
        bounds: &Aabb,
        is_mild: impl Fn(&EdgeFeature) -> bool,
        found: &mut Features,
    ) {
        let Some([columns, rows]) = self.under(bounds) else { return };
        for (column, row) in rows.flat_map(|row| columns.clone().map(move |column| (column, row))) {
            let own =
                SPOKES.map(|to| self.ridge([column, row], to).filter(|ridge| !is_mild(ridge)));
            found.ridges.extend(own[..3].iter().flatten());
            let at = self.point(column, row);
            let ridges = own.iter().flatten();
            found.add_corner(at, ridges.map(|ridge| (ridge.ends[1], *ridge)));
        }
    }
}

/// The edges at a point of the grid, around it: columns and rows to their other ends. The last three are
/// the first three of other points.
const SPOKES: [(i32, i32); 6] = [(1, 0), (1, 1), (0, 1), (-1, 0), (-1, -1), (0, -1)];

#[cfg(test)]
mod tests {
    use super::*;

    fn hills() -> Heightfield {
        let heights = (0..20).map(|i| ((i * 7) % 5) as f32 * 0.25).collect();
        Heightfield::new(5, 4, 0.5, heights)
    }

    #[test]
    fn points_of_the_surface_are_neither_above_nor_below_it() {
        let terrain = hills();
        for column in 0..5 {
            for row in 0..4 {
                let at = terrain.point(column, row);
                let (height, normal) = terrain.above(at).unwrap();
                assert!(height.abs() < 1.0e-6 && normal.y > 0.0, "{at}: {height} m");
                let (height, normal) = terrain.above(at + Vec3::Y).unwrap();
                assert!((height - normal.y).abs() < 1.0e-6);
            }
        }
        let middle = (terrain.point(1, 1) + terrain.point(2, 1) + terrain.point(2, 2)) / 3.0;
        assert!(terrain.above(middle).unwrap().0.abs() < 1.0e-6);
        assert!(terrain.above(Vec3::new(-0.1, 0.0, 0.5)).is_none());
    }

    #[test]
    fn a_pyramid_has_ridges_down_from_its_tip_and_valleys_have_none() {
        let mut heights = vec![0.0; 25];
        heights[12] = 0.5;
        let terrain = Heightfield::new(5, 5, 0.5, heights);
        let place = Aabb { low: Vec3::splat(0.9), high: Vec3::splat(1.1) };
        let mut found = Features::default();
        terrain.find_under(&place, |_| false, &mut found);
        let tip = Vec3::new(1.0, 0.5, 1.0);
        assert!(found.corners.iter().any(|corner| corner.at == tip && corner.out.y > 0.9));
        assert_eq!(found.ridges.iter().filter(|ridge| ridge.ends.contains(&tip)).count(), 6);
        assert!(found.ridges.iter().all(|ridge| ridge.out.y > 0.0));
        found.clear();
        terrain.find_under(&place, |_| true, &mut found);
        assert!(found.ridges.is_empty() && found.corners.is_empty());
    }
}
