//! Patterns of the clothes: a flared skirt and a loose shirt without sleeves, around the figure in
//! its rest pose.
//!
//! ```text
//!   skirt: a tube, from the waist down       shirt: a tube up to the armholes, then two panels
//!      ╭────╮ waist                              ╭──╮    ╭──╮ shoulder seams
//!     ╱      ╲                                   │  ╰────╯  │ neckline
//!    ╱        ╲ hem                              ╰╮        ╭╯ armholes
//! ```
//! Method: the surface of a garment is a function of column and row, sampled coarsely for the cloth
//! and finely for its skin, so that the vertices of the cloth are vertices of the skin.
//!
//! Reads nothing; returns [`Panel`]s.
//!
//! Invariant: fronts face outwards, and no two vertices of a garment at rest are at the same place,
//! except along the seam of a fine panel, where texture coordinates wrap around.

use super::motion::smooth;
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, TAU};

/// Number of times that a skin is finer than its cloth, along each direction.
pub const SKIN_DETAIL: u32 = 3;
/// Columns of the skirt, and its rows of cells.
pub const SKIRT: [u32; 2] = [48, 13];
/// Columns of the shirt, its rows up to the armholes, and its rows above them.
const SHIRT: [u32; 3] = [36, 9, 6];
/// Columns of a panel of the shirt on each side of its middle.
const PANEL: i32 = 6;
/// Columns of the shoulder seam that the body holds, on each side of the middle.
const HELD_COLUMNS: f32 = 4.5;
/// Columns of the neckline on each side of the middle, and its rows in front and at the back.
const NECK: i32 = 2;
const NECK_ROWS: [u32; 2] = [3, 2];
/// Margin at both sides of the texture, so that the printed hem runs around and not up the seam.
const MARGIN: f32 = 0.06;

/// Width and height of the textures, including the margins [m].
pub const SKIRT_SPAN: Vec2 = Vec2::new(2.6, 0.62);
/// Width and height of the texture of the shirt, including the margins [m].
pub const SHIRT_SPAN: Vec2 = Vec2::new(1.5, 0.60);

/// Profile of the skirt: height above the sole, half width and half depth [m]. A fitted yoke ends
/// at the hips.
const SKIRT_PROFILE: [[f32; 3]; 4] =
    [[1.065, 0.134, 0.099], [1.025, 0.150, 0.116], [0.92, 0.215, 0.180], [0.555, 0.450, 0.410]];

/// A sampled garment.
#[derive(Clone, Debug, Default)]
pub struct Panel {
    /// Positions around the figure in its rest pose [m].
    pub positions: Vec<Vec3>,
    /// Texture coordinates: across, and from the hem upwards.
    pub uvs: Vec<Vec2>,
    /// Three vertices per triangle.
    pub indices: Vec<u32>,
    /// Vertices that the body holds: the waist, or the shoulder seams.
    pub held: Vec<u32>,
}

/// Builds the vertices of a panel once each, by column and row.
struct Builder<F> {
    panel: Panel,
    columns: u32,
    vertices: Vec<Option<u32>>,
    /// Position, texture coordinates, and whether the body holds the vertex.
    sample: F,
}

impl<F: Fn(f32, f32) -> (Vec3, Vec2, bool)> Builder<F> {
    /// `columns` is one more than the cells around if the seam has two columns of vertices.
    fn new(columns: u32, rows: u32, sample: F) -> Self {
        let vertices = vec![None; (columns * rows) as usize];
        Self { panel: Panel::default(), columns, vertices, sample }
    }

    /// Returns the vertex of a column and row, at this place of the surface.
    fn vertex(&mut self, column: u32, row: u32, place: [f32; 2]) -> u32 {
        let slot = &mut self.vertices[(row * self.columns + column) as usize];
        *slot.get_or_insert_with(|| {
            let (position, uv, held) = (self.sample)(place[0], place[1]);
            let vertex = self.panel.positions.len() as u32;
            self.panel.positions.push(position);
            self.panel.uvs.push(uv);
            if held {
                self.panel.held.push(vertex);
            }
            vertex
        })
    }

    /// Adds the two triangles of a cell: corners from the lower left, counter-clockwise. Diagonals
    /// alternate, so that the mesh has no preferred direction.
    fn cell(&mut self, [a, b, c, d]: [u32; 4], is_odd: bool) {
        let triangles = if is_odd { [a, b, d, b, c, d] } else { [a, b, c, a, c, d] };
        self.panel.indices.extend(triangles);
    }
}

/// Returns the skirt, `detail` times as fine as the cloth. A detail above 1 doubles the vertices of
/// the seam for the texture.
pub fn skirt(detail: u32) -> Panel {
    let [columns, rows] = SKIRT.map(|n| n * detail);
    let stored = if detail > 1 { columns + 1 } else { columns };
    let sample = |column: f32, row: f32| {
        let around = column / SKIRT[0] as f32;
        let up = row / SKIRT[1] as f32;
        (skirt_point(around, 1.0 - up), texture(around, up), row > SKIRT[1] as f32 - 1.01)
    };
    let mut builder = Builder::new(stored, rows + 1, sample);
    for row in 0..rows {
        for column in 0..columns {
            let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[right, up]| {
                let (column, row) = (column + right, row + up);
                let place = [column as f32, row as f32].map(|at| at / detail as f32);
                builder.vertex(column % stored, row, place)
            });
            builder.cell(corners, (column + row) % 2 == 1);
        }
    }
    builder.panel
}

fn texture(around: f32, up: f32) -> Vec2 {
    Vec2::new(MARGIN + (1.0 - 2.0 * MARGIN) * around, up)
}

/// Returns a point of the skirt at a share of the way around from the back, and of the way down.
fn skirt_point(around: f32, down: f32) -> Vec3 {
    let lengths: [f32; 3] = core::array::from_fn(|i| {
        let [a, b] = [SKIRT_PROFILE[i], SKIRT_PROFILE[i + 1]];
        Vec2::new(b[0] - a[0], b[1] - a[1]).length()
    });
    let mut left = down * lengths.iter().sum::<f32>();
    let mut i = 0;
    while i < 2 && left > lengths[i] {
        left -= lengths[i];
        i += 1;
    }
    let share = left / lengths[i];
    let [y, wide, deep] = core::array::from_fn(|k| {
        SKIRT_PROFILE[i][k] + share * (SKIRT_PROFILE[i + 1][k] - SKIRT_PROFILE[i][k])
    });
    let angle = TAU * around;
    // The hips are behind the waist.
    let back = -0.012 * smooth(0.0, 0.25, down);
    Vec3::new(-wide * angle.sin(), y, back - deep * angle.cos())
}

/// Returns the shirt, `detail` times as fine as the cloth.
pub fn shirt(detail: u32) -> Panel {
    let [columns, lower, upper] = SHIRT.map(|n| n * detail);
    let stored = if detail > 1 { columns + 1 } else { columns };
    let rows = lower + upper;
    let sample = |column: f32, row: f32| {
        let is_seam = row > (SHIRT[1] + SHIRT[2]) as f32 - 0.01;
        // The sleeve ends hang free.
        let from_middle = (column - SHIRT[0] as f32 / 2.0).abs();
        let is_held = is_seam && from_middle < HELD_COLUMNS;
        (shirt_point(column, row), shirt_texture(column, row), is_held)
    };
    let mut builder = Builder::new(stored, rows + 1, sample);
    for row in 0..rows {
        for column in 0..columns {
            if row >= lower && !is_panel(column, row - lower, detail) {
                continue;
            }
            let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[right, up]| {
                let (mut column, row) = (column + right, row + up);
                // Front and back of the cloth share the vertices of the shoulder seam. The skin
                // has them twice, for the texture.
                let is_front = 4 * column > columns && 4 * column < 3 * columns;
                if row == rows && detail == 1 && !is_front {
                    column = (3 * columns / 2 - column) % columns;
                }
                let place = [column as f32, row as f32].map(|at| at / detail as f32);
                builder.vertex(column % stored, row, place)
            });
            builder.cell(corners, (column + row) % 2 == 1);
        }
    }
    builder.panel
}

/// Returns whether the shirt has this cell above the armholes; `row` counts from there.
fn is_panel(column: u32, row: u32, detail: u32) -> bool {
    let half = (SHIRT[0] / 2 * detail) as i32;
    let column = column as i32;
    // Cells from the middle of the front and of the back: −1 is the first one on one side.
    let middles = [column - half, if column < half { column } else { column - 2 * half }];
    let within =
        |cell: i32, reach: i32| cell >= -reach * detail as i32 && cell < reach * detail as i32;
    middles.into_iter().zip(NECK_ROWS).any(|(cell, neck_rows)| {
        let is_neck = within(cell, NECK) && row >= (SHIRT[2] - neck_rows) * detail;
        within(cell, PANEL) && !is_neck
    })
}

/// Returns a point of the shirt. Columns count around from the middle of the back.
fn shirt_point(column: f32, row: f32) -> Vec3 {
    let angle = TAU * column / SHIRT[0] as f32;
    let signed_power = |x: f32, power: f32| x.abs().powf(power).copysign(x);
    let across = -signed_power(angle.sin(), 0.85);
    let ahead = -signed_power(angle.cos(), 0.7);
    let up = (row / SHIRT[1] as f32).min(1.0);
    let (low, high) = (0.925, 1.225);
    let wide = 0.250 + up * (0.174 - 0.250);
    let deep = 0.214 + up * (0.148 - 0.214);
    let over = ((row - SHIRT[1] as f32) / SHIRT[2] as f32).max(0.0);
    if over == 0.0 {
        return Vec3::new(wide * across, low + up * (high - low), deep * ahead);
    }
    let x = wide * across * (1.0 + 0.19 * over * over);
    let (sin, cos) = (FRAC_PI_2 * over.min(1.0)).sin_cos();
    // The shoulder seam rises to the neck, falls over the shoulder, and lies a little behind the
    // middle.
    let (inner, outer) = ((0.11 - x.abs()).max(0.0), (x.abs() - 0.155).max(0.0));
    let seam = 1.446 + 0.5 * inner - 12.0 * outer * outer;
    let cos = if over > 0.999 { 0.0 } else { cos.powf(0.7) };
    Vec3::new(x, high + (seam - high) * sin, deep * ahead * cos - 0.012 * over)
}

fn shirt_texture(column: f32, row: f32) -> Vec2 {
    texture(column / SHIRT[0] as f32, row / (SHIRT[1] + SHIRT[2]) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn garments_have_the_expected_borders_and_face_outwards() {
        for (panel, borders) in [(skirt(1), 2), (shirt(1), 4)] {
            let mut directed: Vec<[u32; 2]> = Vec::new();
            for t in panel.indices.chunks_exact(3) {
                let [a, b, c] = [t[0], t[1], t[2]].map(|i| panel.positions[i as usize]);
                let (middle, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a));
                let axis = Vec3::new(0.0, middle.y.min(1.2), 0.0);
                assert!(normal.dot(middle - axis) > 0.0, "a triangle at {middle} faces inwards");
                directed.extend([[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
            }
            directed.sort_unstable();
            let open: Vec<_> = directed
                .iter()
                .filter(|[a, b]| directed.binary_search(&[*b, *a]).is_err())
                .collect();
            // Each border is a closed loop of directed edges.
            let mut unused: Vec<_> = open.iter().map(|edge| **edge).collect();
            let mut loops = 0;
            while let Some([start, mut at]) = unused.pop() {
                while at != start {
                    let next = unused.iter().position(|edge| edge[0] == at).unwrap();
                    at = unused.swap_remove(next)[1];
                }
                loops += 1;
            }
            assert_eq!(loops, borders);
        }
    }

    #[test]
    fn a_skin_has_the_vertices_of_its_cloth_and_is_several_times_finer() {
        for (coarse, fine) in [(skirt(1), skirt(SKIN_DETAIL)), (shirt(1), shirt(SKIN_DETAIL))] {
            let count = coarse.positions.len();
            assert!((450..750).contains(&count), "{count} particles");
            assert!(fine.positions.len() > 7 * count && fine.positions.len() < 10 * count);
            for x in &coarse.positions {
                assert!(fine.positions.iter().any(|y| x.distance(*y) < 1.0e-5), "{x} is missing");
            }
        }
    }
}
