//! Detection of a regular grid in a given mesh, so that it can use the grid solver.
//!
//! Compares the triangles with those of `grid` (same order), then fits the spacing and checks each
//! position against rounding error.
//!
//! Reads triangles and positions; returns a `DetectedGrid`.

use crate::mesh::grid;
use crate::mesh::grid::GridFrame;
use glam::Vec3;

/// Tolerated deviation of a position, relative to the largest coordinate: a few units of rounding.
const ROUNDING: f32 = 4.0 * f32::EPSILON;

/// Number of neighbouring floats tried as spacing, on either side of the first estimate.
const SPACING_GUESSES: i32 = 16;

/// A regular grid whose vertices and triangles have the order of `grid`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DetectedGrid {
    pub columns: u32,
    pub rows: u32,
    pub frame: GridFrame,
}

impl DetectedGrid {
    /// Returns the grid that a mesh is, or `None`: same order of vertices and triangles as `grid`,
    /// square cells, evenly spaced up to rounding.
    ///
    /// If some frame along the coordinate axes reproduces the positions exactly, the result has
    /// that frame.
    pub fn detect(triangles: &[[u32; 3]], positions: &[Vec3]) -> Option<Self> {
        let columns = triangles.first()?[1];
        if columns < 2 || !positions.len().is_multiple_of(columns as usize) {
            return None;
        }
        let rows = positions.len() as u32 / columns;
        let count = 2 * u64::from(columns - 1) * u64::from(rows.saturating_sub(1));
        let is_grid = rows >= 2 && triangles.len() as u64 == count;
        if !is_grid || triangles != grid::triangles(columns, rows) {
            return None;
        }
        let [origin, right, down] = [0, columns - 1, (rows - 1) * columns]
            .map(|vertex| positions[vertex as usize].as_dvec3());
        let [right, down] = [right - origin, down - origin];
        let spacing =
            0.5 * (right.length() / f64::from(columns - 1) + down.length() / f64::from(rows - 1));
        let frame = GridFrame {
            origin: positions[0],
            right: right.normalize_or_zero().as_vec3(),
            down: down.normalize_or_zero().as_vec3(),
            spacing: spacing as f32,
        };
        let guess = Self { columns, rows, frame };
        if !guess.is_within_rounding(positions) {
            return None;
        }
        let bits = frame.spacing.to_bits();
        let mut offsets = (0..=SPACING_GUESSES).flat_map(|off| [off, -off]);
        let with = |off: i32| {
            let spacing = f32::from_bits(bits.wrapping_add_signed(off));
            Self { frame: GridFrame { spacing, ..frame }, ..guess }
        };
        let exact = offsets.find(|off| with(*off).is_exact(positions));
        Some(exact.map_or(guess, with))
    }

    fn is_within_rounding(&self, positions: &[Vec3]) -> bool {
        let GridFrame { right, down, spacing, .. } = self.frame;
        let largest = positions.iter().fold(spacing, |most, x| most.max(x.abs().max_element()));
        let off = largest * ROUNDING;
        let is_near = |x: Vec3, y: Vec3| (x - y).abs().max_element() <= off;
        right.dot(down).abs() <= ROUNDING
            && positions
                .iter()
                .zip(grid::positions(self.columns, self.rows, &self.frame))
                .all(|(x, y)| is_near(*x, y))
    }

    fn is_exact(&self, positions: &[Vec3]) -> bool {
        // Most guesses fail within the first row already.
        let ends = Self { rows: 1, ..*self };
        let row = grid::positions(ends.columns, ends.rows, &ends.frame);
        positions[..self.columns as usize] == row
            && positions == grid::positions(self.columns, self.rows, &self.frame)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(columns: u32, rows: u32, frame: GridFrame) -> (Vec<[u32; 3]>, Vec<Vec3>) {
        (grid::triangles(columns, rows), grid::positions(columns, rows, &frame))
    }

    const FRAME: GridFrame = GridFrame {
        origin: Vec3::new(-0.7, 3.1, 0.2),
        right: Vec3::X,
        down: Vec3::NEG_Y,
        spacing: 0.05,
    };

    #[test]
    fn a_grid_is_detected_with_its_exact_positions() {
        for (columns, rows) in [(2, 2), (40, 40), (7, 31)] {
            let (triangles, positions) = sheet(columns, rows, FRAME);
            let found = DetectedGrid::detect(&triangles, &positions).unwrap();
            assert_eq!((found.columns, found.rows), (columns, rows));
            assert_eq!(grid::positions(columns, rows, &found.frame), positions);
        }
        let whole = GridFrame { origin: Vec3::Y, ..FRAME };
        let (triangles, positions) = sheet(40, 40, whole);
        assert_eq!(DetectedGrid::detect(&triangles, &positions).unwrap().frame.spacing, 0.05);
    }

    #[test]
    fn a_rotated_grid_is_detected_within_rounding() {
        let (right, down) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.8, 0.0, -0.6));
        let (triangles, positions) = sheet(20, 10, GridFrame { right, down, ..FRAME });
        let found = DetectedGrid::detect(&triangles, &positions).unwrap();
        assert!((found.frame.spacing - 0.05).abs() < 1.0e-6);
    }

    #[test]
    fn an_irregular_grid_is_not_detected() {
        let (triangles, positions) = sheet(6, 5, FRAME);
        let mut moved = positions.clone();
        moved[8].z += 1.0e-4;
        assert!(DetectedGrid::detect(&triangles, &moved).is_none());
        let longer: Vec<Vec3> = positions.iter().map(|x| *x * Vec3::new(1.0, 1.01, 1.0)).collect();
        assert!(DetectedGrid::detect(&triangles, &longer).is_none());
        let mut other = triangles.clone();
        other[5].rotate_left(1);
        assert!(DetectedGrid::detect(&other, &positions).is_none());
        assert!(DetectedGrid::detect(&triangles[1..], &positions).is_none());
    }
}
