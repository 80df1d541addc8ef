//! Heightfields: terrain over a regular grid of heights.
//!
//! ```text
//! a ─── b      Each cell has two triangles, split along the diagonal a–d:
//! │ ╲   │      a point with u > v (u along x, v along z) is over a, b, d; any other over a, c, d.
//! │   ╲ │
//! c ─── d      → x, ↓ z
//! ```
//! The distance of a point is its distance from the plane of the triangle below it: exact above the
//! interior of that triangle, and a lower bound above convex ground.
//!
//! Reads its heights; writes features to the list of the caller. Invariant: only ridges are edge
//! features (their `outward` points up); valleys are not.

use crate::geometry::aabb::Aabb;
use crate::geometry::bends::BendHistogram;
use crate::geometry::features::{EdgeFeature, FeatureSides, Features};
use crate::math::{max, min};
use core::ops::RangeInclusive;
use glam::Vec3;

/// Terrain: the points below a surface over a regular grid in x and z. Its depth below the lowest
/// point is the larger side of the grid.
#[derive(Clone, Debug)]
pub(crate) struct Heightfield {
    columns: u32,
    rows: u32,
    /// Between neighbouring grid points [m].
    spacing: f32,
    heights: Vec<f32>,
    bounds: Aabb,
    bends: BendHistogram,
}

impl Heightfield {
    /// Makes the terrain from `columns` × `rows` heights [m], row by row: along x, then along z.
    /// There are at least two columns and two rows.
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
        let bends = BendHistogram::default();
        let mut terrain = Self { columns, rows, spacing, heights, bounds, bends };
        for (column, row) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)))
        {
            for to in EDGE_DIRECTIONS[..3].iter() {
                let edge = terrain.edge([column, row], *to);
                edge.into_iter().for_each(|edge| terrain.bends.insert(edge.bend));
            }
        }
        terrain
    }

    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Returns the bends at its ridges.
    pub fn bends(&self) -> &BendHistogram {
        &self.bends
    }

    pub fn spacing(&self) -> f32 {
        self.spacing
    }

    fn point(&self, column: u32, row: u32) -> Vec3 {
        let height = self.heights[(row * self.columns + column) as usize];
        Vec3::new(column as f32 * self.spacing, height, row as f32 * self.spacing)
    }

    /// Returns the signed distance of a point from the plane of the triangle at its x and z [m],
    /// and the normal of that plane; `None` beside the terrain or below its bounds.
    pub fn signed_distance(&self, p: Vec3) -> Option<(f32, Vec3)> {
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

    /// Returns the columns and rows of grid points under some bounds; `None` if there are none.
    fn grid_range(&self, bounds: &Aabb) -> Option<[RangeInclusive<u32>; 2]> {
        let range = |low: f32, high: f32, count: u32| {
            // Casts saturate, so ranges end at the border of the terrain.
            let (from, to) = ((low / self.spacing).floor(), (high / self.spacing).ceil());
            (to >= 0.0 && from <= (count - 1) as f32)
                .then(|| max(from, 0.0) as u32..=(to as u32).min(count - 1))
        };
        let columns = range(bounds.low.x, bounds.high.x, self.columns)?;
        Some([columns, range(bounds.low.z, bounds.high.z, self.rows)?])
    }

    /// Returns the edge feature from a grid point in one of `EDGE_DIRECTIONS`; `None` in valleys,
    /// where the surface is flat, and at the border.
    fn edge(&self, [column, row]: [u32; 2], (right, down): (i32, i32)) -> Option<EdgeFeature> {
        let at = |right: i32, down: i32| {
            let (column, row) = (column.checked_add_signed(right)?, row.checked_add_signed(down)?);
            (column < self.columns && row < self.rows).then(|| self.point(column, row))
        };
        let number = EDGE_DIRECTIONS.iter().position(|edge| *edge == (right, down))?;
        // Each triangle at the edge also has the next or the previous edge of this point.
        let [one, other] = [EDGE_DIRECTIONS[(number + 1) % 6], EDGE_DIRECTIONS[(number + 5) % 6]];
        let ends = [at(0, 0)?, at(right, down)?];
        let opposite = [at(one.0, one.1)?, at(other.0, other.1)?];
        EdgeFeature::new(ends, opposite, FeatureSides::Solid).filter(|edge| edge.outward.y > 0.0)
    }

    /// Pushes the edge and vertex features under some bounds, except edges for which `is_smooth`
    /// holds.
    pub fn push_features(
        &self,
        bounds: &Aabb,
        is_smooth: impl Fn(&EdgeFeature) -> bool,
        features: &mut Features,
    ) {
        let Some([columns, rows]) = self.grid_range(bounds) else { return };
        for (column, row) in rows.flat_map(|row| columns.clone().map(move |column| (column, row))) {
            let own = EDGE_DIRECTIONS
                .map(|to| self.edge([column, row], to).filter(|edge| !is_smooth(edge)));
            features.edges.extend(own[..3].iter().flatten());
            let at = self.point(column, row);
            let edges = own.iter().flatten();
            features.push_vertex(at, edges.map(|edge| (edge.ends[1], *edge)));
        }
    }
}

/// The edges at a grid point in circular order, as columns and rows to their other ends. The last
/// three are among the first three of other points.
const EDGE_DIRECTIONS: [(i32, i32); 6] = [(1, 0), (1, 1), (0, 1), (-1, 0), (-1, -1), (0, -1)];

#[cfg(test)]
mod tests {
    use super::*;

    fn hills() -> Heightfield {
        let heights = (0..20).map(|i| ((i * 7) % 5) as f32 * 0.25).collect();
        Heightfield::new(5, 4, 0.5, heights)
    }

    #[test]
    fn the_distance_is_zero_on_the_surface() {
        let terrain = hills();
        for column in 0..5 {
            for row in 0..4 {
                let at = terrain.point(column, row);
                let (height, normal) = terrain.signed_distance(at).unwrap();
                assert!(height.abs() < 1.0e-6 && normal.y > 0.0, "{at}: {height} m");
                let (height, normal) = terrain.signed_distance(at + Vec3::Y).unwrap();
                assert!((height - normal.y).abs() < 1.0e-6);
            }
        }
        let middle = (terrain.point(1, 1) + terrain.point(2, 1) + terrain.point(2, 2)) / 3.0;
        assert!(terrain.signed_distance(middle).unwrap().0.abs() < 1.0e-6);
        assert!(terrain.signed_distance(Vec3::new(-0.1, 0.0, 0.5)).is_none());
    }

    #[test]
    fn a_pyramid_has_six_edges_at_its_tip_and_valleys_have_none() {
        let mut heights = vec![0.0; 25];
        heights[12] = 0.5;
        let terrain = Heightfield::new(5, 5, 0.5, heights);
        let place = Aabb { low: Vec3::splat(0.9), high: Vec3::splat(1.1) };
        let mut features = Features::default();
        terrain.push_features(&place, |_| false, &mut features);
        let tip = Vec3::new(1.0, 0.5, 1.0);
        assert!(
            features.vertices.iter().any(|vertex| vertex.position == tip && vertex.outward.y > 0.9)
        );
        assert_eq!(features.edges.iter().filter(|edge| edge.ends.contains(&tip)).count(), 6);
        assert!(features.edges.iter().all(|edge| edge.outward.y > 0.0));
        features.clear();
        terrain.push_features(&place, |_| true, &mut features);
        assert!(features.edges.is_empty() && features.vertices.is_empty());
    }
}
