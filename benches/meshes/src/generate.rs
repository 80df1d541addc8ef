//! Generated meshes with the statistics of meshes that people bring: how far the lengths of edges
//! spread, how many slivers there are, and seams with doubled vertices.
//!
//! ```text
//! lattice of points ─▶ moved at random, but for the outline ─▶ Delaunay ─▶ placed in space
//! ```
//! Invariant: the same meshes on every machine but for the last bits of sines.

use crate::noise::Noise;
use delaunator::{Point, triangulate};
use muslin::MeshDesc;
use muslin::glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// All generated meshes with their names; only small ones for a test.
pub fn all(is_test: bool) -> Vec<(String, MeshDesc)> {
    let named = |name: &str, desc: MeshDesc| (name.to_owned(), desc);
    let mut meshes =
        vec![named("plane", plane(51)), named("irregular skirt", skirt(77, 52, 0.38, 0.87))];
    if !is_test {
        meshes.push(named("shirt with seams", shirt()));
        meshes.push(named("square with slivers", slivers(80)));
        meshes.push(named("fine skirt", skirt(296, 110, 0.27, 1.0)));
    }
    meshes
}

/// A pattern piece: points of the plane and triangles, cut out of a lattice.
struct Piece {
    /// In units of the lattice.
    points: Vec<Vec2>,
    /// Whether each point is on the outline.
    is_outline: Vec<bool>,
    indices: Vec<u32>,
}

/// Cuts a piece out of `columns` × `rows` cells, those for which `has_cell` holds. Inner points are
/// moved by at most `jitter` cells along each axis.
fn piece(
    [columns, rows]: [i32; 2],
    has_cell: impl Fn(i32, i32) -> bool,
    jitter: f64,
    noise: &mut Noise,
) -> Piece {
    let is_cell =
        |x: i32, y: i32| (0..columns).contains(&x) && (0..rows).contains(&y) && has_cell(x, y);
    let (mut points, mut is_outline) = (Vec::new(), Vec::new());
    for y in 0..=rows {
        for x in 0..=columns {
            let around = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
            let count = around.iter().filter(|(x, y)| is_cell(*x, *y)).count();
            if count > 0 {
                let reach = if count == 4 { jitter } else { 0.0 };
                let mut moved = |at: i32, most: i32| {
                    let at = f64::from(at) + reach * noise.next();
                    // Not beyond the outline.
                    if reach > 0.0 { at.clamp(0.004, f64::from(most) - 0.004) } else { at }
                };
                points.push(Point { x: moved(x, columns), y: moved(y, rows) });
                is_outline.push(count < 4);
            }
        }
    }
    let mut indices = Vec::new();
    for corners in triangulate(&points).triangles.as_chunks::<3>().0 {
        let [a, b, c] = corners.map(|index| &points[index]);
        let center = [(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0].map(|x| x.floor() as i32);
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if area.abs() > 1.0e-9 && is_cell(center[0], center[1]) {
            indices.extend(corners.map(|index| index as u32));
        }
    }
    let points = points.iter().map(|p| Vec2::new(p.x as f32, p.y as f32)).collect();
    Piece { points, is_outline, indices }
}

/// A plane of `side` × `side` particles of 20 mm, with the diagonals in turn, so that it is no grid.
fn plane(side: u32) -> MeshDesc {
    let mut desc = MeshDesc::default();
    for row in 0..side {
        desc.positions.extend((0..side).map(|x| Vec3::new(x as f32, -(row as f32), 0.0) * 0.02));
    }
    for row in 0..side - 1 {
        for a in (row * side..).take(side as usize - 1) {
            let [b, c, d] = [a + 1, a + side, a + side + 1];
            let is_even = (a % side + row).is_multiple_of(2);
            desc.indices.extend(if is_even { [a, c, b, b, c, d] } else { [a, c, d, a, d, b] });
        }
    }
    desc
}

/// A square of 0.5 m as a mesher cuts it that does not look at angles: as the file `cloth.obj` of
/// Genesis, with edges of 0.09 to 16 mm around a mean of 7.2 mm, and heights from 0.01 mm on.
fn slivers(side: i32) -> MeshDesc {
    let cut = piece([side - 1; 2], |_, _| true, 1.2, &mut Noise::new(7));
    let scale = 0.5 / (side - 1) as f32;
    let positions = cut.points.iter().map(|p| (*p * scale).extend(0.0)).collect();
    MeshDesc { positions, indices: cut.indices, ..MeshDesc::default() }
}

/// A skirt: a tube that widens from a radius of 0.15 m to 0.3 m on a length of 0.5 m, all times
/// `size`. `jitter` is in cells.
fn skirt(around: u32, rows: u32, jitter: f64, size: f32) -> MeshDesc {
    let mut noise = Noise::new(5);
    let mut desc = MeshDesc::default();
    for row in 0..rows {
        let reach = if row == 0 || row == rows - 1 { 0.0 } else { jitter };
        for column in 0..around {
            let mut moved = |at: u32| (f64::from(at) + reach * noise.next()) as f32;
            let (angle, down) =
                (moved(column) / around as f32 * TAU, moved(row) / (rows - 1) as f32);
            let radius = size * (0.15 + 0.15 * down);
            let height = -0.5 * size * down;
            desc.positions.push(Vec3::new(radius * angle.cos(), height, radius * angle.sin()));
        }
    }
    for row in 0..rows - 1 {
        for column in 0..around {
            let next = (column + 1) % around;
            let [a, b] = [column, next].map(|column| row * around + column);
            let [c, d] = [a + around, b + around];
            let length =
                |p: u32, q: u32| desc.positions[p as usize].distance(desc.positions[q as usize]);
            let is_falling = length(a, d) < length(b, c);
            desc.indices.extend(if is_falling { [a, b, d, a, d, c] } else { [a, b, c, b, d, c] });
        }
    }
    desc
}

/// A shirt of two panels that are joined along the sides and the shoulders, where each has vertices
/// and texture coordinates of its own: as `unisex_shirt.usd` of Newton, with edges of 1.5 to 23 mm
/// around a mean of 11.4 mm.
fn shirt() -> MeshDesc {
    const SIZE: [i32; 2] = [78, 57];
    /// Columns of each sleeve, its rows, and half of the columns of the neck.
    const SLEEVE: [i32; 2] = [17, 18];
    const NECK: f32 = 9.0;
    /// Cells from a seam to where the panels are parallel.
    const ROUND: f32 = 14.0;
    let has_cell =
        |x: i32, y: i32| y >= SIZE[1] - SLEEVE[1] || (SLEEVE[0]..SIZE[0] - SLEEVE[0]).contains(&x);
    let mut desc = MeshDesc::default();
    for side in [1.0, -1.0] {
        let seed = if side > 0.0 { 11 } else { 12 };
        let cut = piece(SIZE, has_cell, 0.4, &mut Noise::new(seed));
        let first = desc.positions.len() as u32;
        // The hem, the cuffs and the neck are open.
        let is_open = |p: &Vec2| {
            let [right, top] = SIZE.map(|count| count as f32);
            let is_neck = p.y == top && (p.x - 0.5 * right).abs() < NECK;
            p.y == 0.0 || p.x == 0.0 || p.x == right || is_neck
        };
        let seam: Vec<&Vec2> = (cut.points.iter().zip(&cut.is_outline))
            .filter(|(p, is_outline)| **is_outline && !is_open(p))
            .map(|(p, _)| p)
            .collect();
        for p in &cut.points {
            let [x, y] = [p.x / SIZE[0] as f32, p.y / SIZE[1] as f32];
            let distance = seam.iter().map(|at| at.distance(*p)).fold(f32::INFINITY, f32::min);
            let slack = 1.0 - (distance / ROUND).min(1.0);
            let depth = 0.08 * (1.0 - slack * slack);
            // Cells are wider at the sides and lower at the top.
            let at = Vec2::new(
                0.74 * (x - 0.5 + 0.05 * (TAU * x).sin() / TAU),
                0.52 * (y + 0.3 * (PI * y).sin() / PI),
            );
            desc.positions.push(at.extend(side * depth));
            desc.uvs.push(*p / SIZE[0] as f32 + Vec2::X * if side > 0.0 { 0.0 } else { 2.0 });
        }
        for corners in cut.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|vertex| first + vertex);
            desc.indices.extend(if side > 0.0 { [a, b, c] } else { [a, c, b] });
        }
    }
    desc
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin::{Cloth, MeshReport};

    /// The report of a mesh whose vertices at one place are joined, and its edges [mm], ascending.
    fn measure(mut desc: MeshDesc) -> (MeshReport, Vec<f32>) {
        desc.weld_distance = 0.0;
        let cloth = Cloth::mesh(&desc).unwrap();
        let triangles = desc.indices.as_chunks::<3>().0.iter();
        let edges = triangles.flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        let place = |vertex: u32| desc.positions[vertex as usize];
        let mut edges: Vec<f32> = edges.map(|[a, b]| 1.0e3 * place(a).distance(place(b))).collect();
        edges.sort_by(f32::total_cmp);
        (*cloth.mesh_report(), edges)
    }

    /// Asserts the number of particles, the mean edge [mm], and the lengths of edges at shares of
    /// all, within a part of them.
    fn assert_statistics(
        desc: MeshDesc,
        particles: u32,
        mean: f32,
        shares: &[(f64, f32, f32)],
    ) -> MeshReport {
        let (report, edges) = measure(desc);
        println!("{report:?}");
        assert!(report.particles.abs_diff(particles) < particles / 20, "{}", report.particles);
        assert_eq!((report.pieces, report.split_edges, report.dropped_degenerate), (1, 0, 0));
        let mean_edge = 1.0e3 * report.mean_edge;
        assert!((mean_edge / mean - 1.0).abs() < 0.15, "the mean edge is {mean_edge} mm");
        let found = |share: f64| edges[((edges.len() - 1) as f64 * share) as usize];
        let all: Vec<f32> = shares.iter().map(|(share, ..)| found(*share)).collect();
        let is_near = |(found, (_, length, part)): (&f32, &(f64, f32, f32))| {
            (found / length - 1.0).abs() <= *part
        };
        assert!(all.iter().zip(shares).all(is_near), "{all:?} mm, wanted {shares:?}");
        report
    }

    #[test]
    fn the_square_has_the_slivers_of_the_file_that_it_stands_for() {
        let shares = [
            (0.001, 0.29, 0.5),
            (0.01, 0.88, 0.4),
            (0.05, 1.96, 0.3),
            (0.5, 6.8, 0.15),
            (0.99, 16.4, 0.25),
        ];
        let report = assert_statistics(slivers(80), 6400, 7.16, &shares);
        assert!((3..30).contains(&report.thin_triangles), "{}", report.thin_triangles);
        assert!(report.shortest_edge < 0.2e-3, "{}", report.shortest_edge);
    }

    #[test]
    fn the_shirt_has_the_edges_of_the_file_that_it_stands_for() {
        let shares = [(0.0, 1.47, 0.6), (0.01, 5.93, 0.4), (0.5, 10.1, 0.2), (0.99, 22.7, 0.25)];
        let report = assert_statistics(shirt(), 6436, 11.4, &shares);
        assert_eq!(report.thin_triangles, 0);
        assert!(report.welded_vertices > 150, "{}", report.welded_vertices);
    }

    #[test]
    fn the_skirts_have_the_edges_of_the_files_that_they_stand_for() {
        assert_statistics(skirt(77, 52, 0.38, 0.87), 4004, 14.2, &[(0.0, 2.7, 0.5)]);
        let fine = [(0.0, 1.6, 0.5), (0.01, 2.98, 0.25), (0.5, 5.19, 0.15), (0.99, 8.45, 0.25)];
        assert_statistics(skirt(296, 110, 0.27, 1.0), 32_558, 5.32, &fine);
    }
}
