//! Mesh quality in the report: lengths of edges, aspect ratios and warnings.

use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, MeshDesc, MeshReport};

const EQUAL_EDGES: f32 = 1.154_700_5; // 2/√3

fn report(positions: &[[f32; 3]], indices: &[u32]) -> MeshReport {
    let desc = MeshDesc {
        positions: positions.iter().copied().map(Vec3::from).collect(),
        indices: indices.to_vec(),
        ..MeshDesc::default()
    };
    *Cloth::mesh(&desc).unwrap().mesh_report()
}

fn assert_close(measured: f32, expected: f32) {
    assert!((measured - expected).abs() <= 1.0e-5 * expected, "{measured}, expected {expected}");
}

#[test]
fn a_triangle_with_equal_edges_has_the_least_aspect_ratio() {
    for size in [1.0e-4, 1.0, 1.0e9] {
        let corners = [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.5 * size, 0.866_025_4 * size, 0.0]];
        let report = report(&corners, &[0, 1, 2]);
        assert_close(report.worst_aspect, EQUAL_EDGES);
        assert_close(report.shortest_edge, size);
        assert_close(report.mean_edge, size);
        assert_eq!((report.thin_triangles, report.warnings()), (0, vec![]));
    }
}

#[test]
fn each_edge_counts_once_and_the_diagonals_of_a_grid_count_too() {
    // Two cells: 3 edges down, 4 across, 2 diagonals.
    let grid = GridDesc { columns: 3, rows: 2, spacing: 0.5, ..GridDesc::default() };
    let grid = Cloth::grid(&grid).unwrap();
    let report = *grid.mesh_report();
    assert_close(report.shortest_edge, 0.5);
    assert_close(report.mean_edge, 0.5 * (7.0 + 2.0 * 2.0_f32.sqrt()) / 9.0);
    assert_close(report.worst_aspect, 2.0);
    assert_eq!(report.warnings(), Vec::<String>::new());
    let mesh = MeshDesc {
        positions: grid.positions().to_vec(),
        indices: grid.indices().to_vec(),
        ..MeshDesc::default()
    };
    let mesh = *Cloth::mesh(&mesh).unwrap().mesh_report();
    assert!(mesh.is_grid);
    assert_eq!(mesh, report);
}

/// A strip of triangles, each with its base on the line y = 0, of these heights [m].
fn strip_of(heights: &[f32]) -> (Vec<[f32; 3]>, Vec<u32>) {
    let (mut positions, mut indices) = (vec![[0.0; 3]], Vec::new());
    for (at, height) in heights.iter().enumerate() {
        let x = at as f32;
        positions.extend([[x + 1.0, 0.0, 0.0], [x + 0.5, *height, 0.0]]);
        let left = if at == 0 { 0 } else { 2 * at as u32 - 1 };
        indices.extend([left, 2 * at as u32 + 1, 2 * at as u32 + 2]);
    }
    (positions, indices)
}

#[test]
fn thin_triangles_are_counted_and_the_thinnest_has_its_given_number() {
    let (positions, mut indices) = strip_of(&[1.0, 0.0099, 0.001, 0.0101]);
    // A triangle without area, which is dropped, comes first.
    indices.splice(0..0, [0, 0, 1]);
    let report = report(&positions, &indices);
    assert_eq!((report.kept_triangles, report.thin_triangles), (4, 2));
    assert_eq!(report.thinnest_triangle, 3);
    assert_close(report.worst_aspect, 1000.0);
    assert_eq!(
        report.warnings(),
        [
            "1 triangle was removed for lack of an area",
            "2 triangles have a height under a hundredth of the longest edge; \
             the thinnest is triangle 3",
        ]
    );
}

#[test]
fn a_short_edge_is_a_warning() {
    let (mut positions, mut indices) = strip_of(&[1.0; 6]);
    // A small copy of the first triangle, apart from the others.
    positions.extend([[9.0, 0.0, 0.0], [9.005, 0.0, 0.0], [9.0025, 0.005, 0.0]]);
    indices.extend([13, 14, 15]);
    let report = report(&positions, &indices);
    assert!((report.shortest_edge - 0.005).abs() < 1.0e-6);
    assert_eq!(report.thin_triangles, 0);
    assert_eq!(report.warnings(), ["the shortest edge is under a hundredth of the mean edge"]);
}

#[test]
fn repairs_and_defects_are_warnings_with_their_numbers() {
    // Three triangles on one edge, a vertex in no triangle.
    let positions = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.5, 1.0, 0.0],
        [0.5, -1.0, 0.0],
        [0.5, 0.0, 1.0],
        [5.0, 5.0, 5.0],
    ];
    let report = report(&positions, &[0, 1, 2, 1, 0, 3, 0, 1, 4]);
    assert_eq!(
        report.warnings(),
        ["1 edge was split: more than two triangles met there", "1 vertex is in no triangle"]
    );
    let many = MeshReport { one_sided_pieces: 2, unused_vertices: 5, ..report };
    assert_eq!(
        many.warnings()[1..],
        ["2 pieces have one side only", "5 vertices are in no triangle"]
    );
}
