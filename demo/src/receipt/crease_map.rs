//! Crease map: the normal of each cell of the sheet, and how sharply the cell was ever folded.
//!
//! ```text
//! n₀    n₁        fold angle of the edge between two cells: acos(n₀ · n₁)
//!  ╲ ╱╲ ╱         sharpness of a cell: from the greatest angle of its four edges so far
//!   ╳  ╳
//! ```
//! Method: folds leave marks in paper. The paper's shader interpolates the normals of cells without
//! sharpness smoothly, and moves those of others towards the nearest mode (mean shift), so that a
//! crease is a line between two facets and not a round bend. The line follows the interpolation and
//! not the edges of the mesh. Where most cells around are sharp, paper is crumpled: the shader adds
//! facets of a fixed pattern, for the creases that are finer than the cells.
//!
//! Reads the positions of the cloth on its grid; writes one texel per cell.
//!
//! Invariant: a sheet that was never folded has no sharpness.

use glam::Vec3;

/// Fold angles between neighbouring cells at which a crease begins to show, and has its full
/// sharpness [rad].
const SHARP: [f32; 2] = [0.30, 0.75];
/// Half the side of the square that tells crumpled paper from a single fold [cells], and means of
/// the sharpness in it at which paper begins to look crumpled, and is so altogether.
const REACH: usize = 3;
const CRUMPLED: [f32; 2] = [0.5, 0.75];

/// Normals and greatest fold angles of the cells.
#[derive(Clone, Debug, Default)]
pub struct CreaseMap {
    /// Cells across.
    columns: usize,
    normals: Vec<Vec3>,
    /// Least cosine of the angles between a cell and its neighbours so far.
    least_cosines: Vec<f32>,
    sharpness: Vec<f32>,
    means: Vec<f32>,
    texels: Vec<[f32; 4]>,
}

impl CreaseMap {
    /// Updates the normals and the greatest fold angles from the positions of a grid with
    /// `columns` × `rows` particles; further positions are those that tears have added.
    pub fn record(&mut self, positions: &[Vec3], [columns, rows]: [u32; 2]) {
        let [wide, high] = [columns as usize, rows as usize];
        let cells = (wide - 1) * (high - 1);
        self.columns = wide - 1;
        self.least_cosines.resize(cells, 1.0);
        self.normals.clear();
        for start in (0..high - 1).map(|row| row * wide) {
            let [upper, lower] = [start, start + wide].map(|from| &positions[from..from + wide]);
            let corners = upper.windows(2).zip(lower.windows(2));
            self.normals.extend(corners.map(|(upper, lower)| {
                (lower[1] - upper[0]).cross(upper[1] - lower[0]).normalize_or_zero()
            }));
        }
        for cell in 0..cells {
            let is_last = (cell + 1).is_multiple_of(self.columns);
            let right = (!is_last).then_some(cell + 1);
            let below = (cell + self.columns < cells).then_some(cell + self.columns);
            for other in right.into_iter().chain(below) {
                let cosine = self.normals[cell].dot(self.normals[other]);
                for side in [cell, other] {
                    self.least_cosines[side] = self.least_cosines[side].min(cosine);
                }
            }
        }
    }

    /// Removes the marks of earlier folds, as from a sheet that does not keep them.
    pub fn forget(&mut self) {
        self.least_cosines.clear();
    }

    /// Returns the numbers of cells across and down.
    pub fn size(&self) -> [u32; 2] {
        [self.columns as u32, (self.normals.len() / self.columns.max(1)) as u32]
    }

    /// Returns the normal of each cell, longer than one by how crumpled its surroundings are (0 to
    /// 1), and its sharpness (0 to 1), row by row from the top, where the second texture coordinate
    /// is one.
    pub fn texels(&mut self) -> &[[f32; 4]] {
        self.sharpness.clear();
        self.sharpness.extend(
            self.least_cosines
                .iter()
                .map(|cosine| smoothstep(SHARP, cosine.clamp(-1.0, 1.0).acos())),
        );
        // Means over a square: first across, then down.
        self.means.clear();
        for row in self.sharpness.chunks(self.columns.max(1)) {
            self.means.extend((0..row.len()).map(|column| mean(row, 1, column)));
        }
        self.texels.clear();
        for (cell, (normal, sharp)) in self.normals.iter().zip(&self.sharpness).enumerate() {
            let column = &self.means[cell % self.columns..];
            let share = mean(column, self.columns, cell / self.columns);
            let long = *normal * (1.0 + smoothstep(CRUMPLED, share));
            self.texels.push([long.x, long.y, long.z, *sharp]);
        }
        &self.texels
    }
}

/// Returns the mean of the values near `place`, of those that are `stride` apart.
fn mean(values: &[f32], stride: usize, place: usize) -> f32 {
    let count = values.len().div_ceil(stride);
    let near = place.saturating_sub(REACH)..(place + REACH + 1).min(count);
    let number = near.len() as f32;
    near.map(|i| values[i * stride]).sum::<f32>() / number
}

fn smoothstep([low, high]: [f32; 2], value: f32) -> f32 {
    let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin_scenes::Sheet;

    const SIZE: [u32; 2] = [6, 9];

    /// A sheet that lies in the plane of x and y, with its front to z, and is folded by `angle`
    /// [rad] to the back between the fourth and the fifth row of cells.
    fn folded(angle: f32) -> Vec<Vec3> {
        let [columns, rows] = SIZE;
        let below = Vec3::new(0.0, -angle.cos(), -angle.sin());
        let place =
            |row: u32| Vec3::NEG_Y * row.min(4) as f32 + below * row.saturating_sub(4) as f32;
        let row = |row| (0..columns).map(move |column| Vec3::X * column as f32 + place(row));
        (0..rows).flat_map(row).collect()
    }

    fn sharpness(map: &mut CreaseMap) -> Vec<f32> {
        map.texels().chunks(5).map(|row| row[2][3]).collect()
    }

    #[test]
    fn the_cells_at_a_fold_are_sharp_and_stay_so_after_it_is_opened() {
        let mut map = CreaseMap::default();
        map.record(&folded(1.0), SIZE);
        assert_eq!(map.size(), [5, 8]);
        let wanted = [0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0];
        assert_eq!(sharpness(&mut map), wanted);
        let normals: Vec<_> =
            map.texels().iter().map(|[x, y, z, _]| Vec3::new(*x, *y, *z)).collect();
        assert!(normals[0].distance(Vec3::Z) < 1.0e-6, "the front faces {}", normals[0]);
        assert!((normals[39].angle_between(Vec3::Z) - 1.0).abs() < 1.0e-3);
        map.record(&folded(0.0), SIZE);
        assert_eq!(sharpness(&mut map), wanted);
        assert!(map.texels().iter().all(|[_, _, z, _]| (z - 1.0).abs() < 1.0e-6));
    }

    #[test]
    fn paper_is_crumpled_where_it_is_folded_all_over_and_not_at_a_single_fold() {
        let size = [30, 30];
        let bumps = |bumpy: f32| {
            let place = move |i: u32| {
                let [row, column] = [i / 30, i % 30];
                let is_up = row % 2 == 0 && column < 15;
                Vec3::new(column as f32, -(row as f32), if is_up { bumpy } else { 0.0 })
            };
            (0..900).map(place).collect::<Vec<_>>()
        };
        let mut map = CreaseMap::default();
        map.record(&bumps(1.0), size);
        let lengths: Vec<_> =
            map.texels().iter().map(|[x, y, z, _]| Vec3::new(*x, *y, *z).length()).collect();
        for row in lengths.chunks(29) {
            assert!(row[3] > 1.99 && row[25] < 1.01, "{row:?}");
        }
        let mut line = CreaseMap::default();
        line.record(&folded(2.5), SIZE);
        let is_plain = |[x, y, z, _]: &[f32; 4]| Vec3::new(*x, *y, *z).length() < 1.2;
        assert!(line.texels().iter().all(is_plain), "{:?}", line.texels());
        map.forget();
        map.record(&bumps(0.0), size);
        assert!(map.texels().iter().all(|[_, _, z, sharp]| *z == 1.0 && *sharp == 0.0));
    }

    #[test]
    fn a_gentle_bend_and_the_curl_of_the_hanging_receipt_have_no_creases() {
        let mut map = CreaseMap::default();
        map.record(&folded(0.25), SIZE);
        assert!(sharpness(&mut map).iter().all(|sharp| *sharp == 0.0));
        for small in [false, true] {
            let mut cloth = Sheet::Paper.hang(small).unwrap();
            let mut map = CreaseMap::default();
            for _ in 0..60 {
                cloth.step(2);
                map.record(cloth.positions(), Sheet::Paper.grid_size(small));
            }
            assert!(map.texels().iter().all(|[.., sharp]| *sharp == 0.0), "small: {small}");
        }
    }
}
