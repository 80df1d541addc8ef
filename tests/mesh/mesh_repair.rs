//! Mesh repair: each single defect is repaired and reported, any triangle soup becomes a sound mesh
//! or is refused, and a grid is recognised in every form in which it is given.

use crate::common::garments::{assert_mesh_invariants, push_grid_patch};
use crate::common::{bare_grid, irregular_mesh};
use muslin::glam::Vec3;
use muslin::{Cloth, Error, GridDesc, Material, MeshDesc, MeshReport, PinMode, Preset, Wind};
use proptest::prelude::*;

/// A flat sheet of 5 × 5 vertices with the diagonals of a grid and without defects.
fn clean_sheet() -> MeshDesc {
    let mut desc = MeshDesc::default();
    push_grid_patch(&mut desc, [5, 5], 0.0, |x, y| Vec3::new(x as f32, -(y as f32), 0.0) * 0.125);
    desc
}

/// Creates a cloth from a mesh and checks that it is sound, before and after it has moved. Returns
/// the cloth and its report.
fn checked_cloth(desc: &MeshDesc) -> (Cloth, MeshReport) {
    let mut cloth = Cloth::mesh(desc).unwrap();
    assert_mesh_invariants(&mut cloth, desc);
    cloth.step(5);
    assert_mesh_invariants(&mut cloth, desc);
    // Without the quality, which `mesh_quality` tests.
    let report = MeshReport {
        shortest_edge: 0.0,
        mean_edge: 0.0,
        worst_aspect: 0.0,
        thin_triangles: 0,
        thinnest_triangle: 0,
        ..*cloth.mesh_report()
    };
    (cloth, report)
}

/// The report of the clean sheet.
const CLEAN: MeshReport = MeshReport {
    vertices: 25,
    triangles: 32,
    particles: 25,
    kept_triangles: 32,
    welded_vertices: 0,
    dropped_degenerate: 0,
    dropped_duplicates: 0,
    turned_triangles: 0,
    split_edges: 0,
    split_vertices: 0,
    unused_vertices: 0,
    pieces: 1,
    one_sided_pieces: 0,
    is_grid: true,
    shortest_edge: 0.0,
    mean_edge: 0.0,
    worst_aspect: 0.0,
    thin_triangles: 0,
    thinnest_triangle: 0,
    collapsed_edges: 0,
    collapsed_triangles: 0,
    trimmed_triangles: 0,
    flipped_edges: 0,
    short_edges: 0,
};

#[test]
fn a_clean_mesh_is_not_changed() {
    let desc = clean_sheet();
    let (cloth, report) = checked_cloth(&desc);
    assert_eq!(report, CLEAN);
    assert!(report.is_clean());
    assert_eq!(cloth.indices(), desc.indices);
    assert!(cloth.vertex_particles().iter().copied().eq(0..25));
    let (_, irregular) = checked_cloth(&irregular_mesh());
    assert_eq!((irregular.particles, irregular.is_grid), (31, false));
}

#[test]
fn degenerate_triangles_are_dropped() {
    let mut desc = clean_sheet();
    // A repeated vertex, three collinear vertices, and three that are nearly collinear.
    desc.indices.splice(6..6, [0, 0, 1, 0, 1, 2]);
    desc.positions.push(Vec3::new(0.3, -0.3, 1.0e-9));
    desc.uvs.push(desc.uvs[0]);
    desc.indices.extend([0, 25, 12]);
    let (cloth, report) = checked_cloth(&desc);
    let expected = MeshReport { dropped_degenerate: 3, vertices: 26, triangles: 35, ..CLEAN };
    assert_eq!(
        report,
        MeshReport { particles: 26, unused_vertices: 1, is_grid: false, ..expected }
    );
    assert_eq!(cloth.indices(), clean_sheet().indices);
}

#[test]
fn duplicate_triangles_are_dropped_with_either_winding() {
    let mut desc = clean_sheet();
    let [a, b, c] = [desc.indices[9], desc.indices[10], desc.indices[11]];
    desc.indices.extend([a, b, c, b, c, a, c, b, a]);
    let (cloth, report) = checked_cloth(&desc);
    assert_eq!(report, MeshReport { dropped_duplicates: 3, triangles: 35, ..CLEAN });
    assert_eq!(cloth.indices(), clean_sheet().indices);
}

#[test]
fn triangles_with_the_winding_of_the_minority_are_turned() {
    let mut desc = clean_sheet();
    for at in [1, 8, 9, 30] {
        desc.indices.swap(3 * at, 3 * at + 1);
    }
    let (mut cloth, report) = checked_cloth(&desc);
    assert_eq!(report, MeshReport { turned_triangles: 4, is_grid: false, ..CLEAN });
    assert!(cloth.normals().iter().all(|normal| normal.z > 0.9));
    // With all triangles reversed, the minority is the same four triangles.
    desc.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    let (mut cloth, report) = checked_cloth(&desc);
    assert_eq!(report.turned_triangles, 4);
    assert!(cloth.normals().iter().all(|normal| normal.z < -0.9));
}

#[test]
fn a_third_triangle_at_an_edge_becomes_a_separate_piece() {
    let mut desc = clean_sheet();
    let fin = desc.positions.len() as u32;
    desc.positions.push(Vec3::new(0.3, -0.25, 0.1));
    desc.uvs.push(desc.uvs[0]);
    desc.indices.extend([12, 13, fin]);
    let (cloth, report) = checked_cloth(&desc);
    assert_eq!((report.split_edges, report.split_vertices, report.pieces), (1, 2, 2));
    assert_eq!(report.particles, 28);
    assert_eq!(&cloth.indices()[..96], &clean_sheet().indices[..], "the sheet keeps its vertices");
    assert_eq!(&cloth.indices()[96..], [26, 27, fin]);
    assert_eq!(&cloth.source_vertices()[26..], [12, 13]);
}

#[test]
fn the_flattest_two_of_three_triangles_at_an_edge_stay_joined() {
    // A floor triangle and a wall come first, then the other half of the floor.
    let mut desc = MeshDesc {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::new(0.5, 1.0, 0.2), Vec3::NEG_Z],
        ..MeshDesc::default()
    };
    desc.indices = vec![0, 1, 2, 1, 0, 3, 0, 1, 4];
    let (cloth, report) = checked_cloth(&desc);
    assert_eq!((report.split_edges, report.split_vertices, report.turned_triangles), (1, 2, 1));
    assert_eq!(cloth.indices(), [0, 1, 2, 5, 6, 3, 0, 4, 1]);
}

#[test]
fn pieces_that_meet_in_one_vertex_are_separated() {
    let mut desc = clean_sheet();
    let far = desc.positions.len() as u32;
    desc.positions.extend([Vec3::new(0.5, -0.75, 0.0), Vec3::new(0.75, -0.75, 0.0)]);
    desc.uvs.extend([desc.uvs[0]; 2]);
    desc.indices.extend([24, far, far + 1]);
    desc.pinned = vec![24];
    let (cloth, report) = checked_cloth(&desc);
    assert_eq!((report.split_edges, report.split_vertices, report.pieces), (0, 1, 2));
    assert_eq!(&cloth.indices()[96..], [27, far, far + 1]);
    assert_eq!(
        cloth.pinned().collect::<Vec<_>>(),
        [24, 27],
        "both copies of a pinned vertex are pinned"
    );
}

#[test]
fn duplicate_vertices_are_welded_to_one_particle() {
    let mut desc = MeshDesc { weld_distance: 1.0e-3, ..MeshDesc::default() };
    for first in [0, 4] {
        push_grid_patch(&mut desc, [5, 5], 0.0, |x, y| {
            Vec3::new((first + x) as f32 + 1.0e-3 * first as f32, -(y as f32), 0.0) * 0.125
        });
    }
    desc.pinned = vec![4, 45];
    let (cloth, report) = checked_cloth(&desc);
    let expected = MeshReport { vertices: 50, triangles: 64, particles: 45, ..CLEAN };
    let expected = MeshReport { kept_triangles: 64, welded_vertices: 5, ..expected };
    assert_eq!(report, MeshReport { is_grid: false, ..expected });
    assert_eq!(cloth.indices(), desc.indices);
    for row in 0..5 {
        let of = |vertex: usize| cloth.vertex_particles()[vertex];
        assert_eq!(of(5 * row + 4), of(25 + 5 * row));
    }
    assert_eq!(cloth.pinned().collect::<Vec<_>>(), [4, 24], "pins are particles, not vertices");
    // Without welding they are two pieces.
    let (_, report) = checked_cloth(&MeshDesc { weld_distance: -1.0, ..desc });
    assert_eq!((report.pieces, report.particles, report.welded_vertices), (2, 50, 0));
}

#[test]
fn a_weld_distance_larger_than_the_mesh_does_not_collapse_it() {
    let desc = MeshDesc { weld_distance: 100.0, ..clean_sheet() };
    let (_, report) = checked_cloth(&desc);
    assert!(report.kept_triangles > 0 && report.particles >= 3, "{report:?}");
}

#[test]
fn pieces_and_unused_vertices_are_kept() {
    let mut desc = clean_sheet();
    desc.positions.extend([Vec3::Z, Vec3::Z * 2.0]);
    desc.uvs.extend([desc.uvs[0]; 2]);
    push_grid_patch(&mut desc, [3, 3], 1.0, |x, y| Vec3::new(x as f32, -(y as f32), 9.0));
    let (cloth, report) = checked_cloth(&desc);
    assert_eq!((report.pieces, report.unused_vertices, report.particles), (2, 2, 36));
    assert!(report.is_clean());
    assert_eq!(cloth.stats().pieces, 2);
}

#[test]
fn a_mesh_beyond_repair_is_refused_with_its_reason() {
    let flat = MeshDesc { positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0], ..clean_sheet() };
    let flat = MeshDesc { indices: vec![0, 1, 2, 1, 2, 1], uvs: Vec::new(), ..flat };
    let error = Cloth::mesh(&flat).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`indices` must hold at least one triangle with an area (triangle or vertex 0)"
    );
    let mut vast = clean_sheet();
    vast.positions[12] = Vec3::splat(3.0e38);
    vast.positions[13] = Vec3::new(-3.0e38, 3.0e38, 0.0);
    let error = Cloth::mesh(&vast).unwrap_err();
    assert!(matches!(
        error,
        Error::BadMesh { must: "leave every triangle an area that is finite", .. }
    ));
    let mut far = clean_sheet();
    far.indices[7] = 25;
    let error = Cloth::mesh(&far).unwrap_err();
    assert_eq!(error, Error::BadIndex { field: "indices", index: 25, count: 25 });
    for weld_distance in [f32::NAN, f32::INFINITY] {
        let error = Cloth::mesh(&MeshDesc { weld_distance, ..clean_sheet() }).unwrap_err();
        assert_eq!(error.to_string(), "`weld_distance` must be finite");
    }
}

/// The mesh descriptor of the triangles that a grid gives to its renderer.
fn mesh_of_grid(desc: &GridDesc) -> MeshDesc {
    let grid = Cloth::grid(desc).unwrap();
    MeshDesc {
        positions: grid.positions().to_vec(),
        indices: grid.indices().to_vec(),
        uvs: grid.uvs().to_vec(),
        pinned: grid.pinned().collect(),
        material: desc.material.clone(),
        settings: desc.settings.clone(),
        ..MeshDesc::default()
    }
}

#[test]
fn a_sheet_given_as_grid_or_as_mesh_gives_the_same_bits() {
    for spacing in [0.05, 0.0625, 0.037] {
        let mut desc = bare_grid(23, 18, spacing, PinMode::TopCorners);
        desc.origin = Vec3::new(0.0, 1.7, -0.3);
        desc.material =
            Material { tear_stretch: 1.2, lift: 0.5, ..Material::preset(Preset::Cotton) };
        desc.settings.tearing = true;
        let mut grid = Cloth::grid(&desc).unwrap();
        let mut mesh = Cloth::mesh(&mesh_of_grid(&desc)).unwrap();
        assert!(mesh.mesh_report().is_grid);
        for cloth in [&mut grid, &mut mesh] {
            let velocity = Vec3::new(0.5, 0.0, 3.0);
            cloth.set_wind(Wind { velocity, turbulence: 0.5, ..Wind::default() }).unwrap();
            cloth.step(60);
            let grab = cloth.grab_particle(11 * 23 + 9).unwrap();
            let at = cloth.position(11 * 23 + 9).unwrap();
            for tick in 1..=60 {
                let pull = Vec3::new(0.25, -0.5, 1.0) * (spacing * 0.25 * tick as f32);
                cloth.move_grab(grab, at + pull).unwrap();
                cloth.step(1);
            }
            cloth.crease(Vec3::new(0.0, 1.6, -0.3), Vec3::new(0.6, 1.4, -0.3), 1.0).unwrap();
            let (from, to) = (Vec3::new(0.1, 9.0, -9.0), Vec3::new(0.3, -9.0, -9.0));
            assert!(cloth.cut(from, to, Vec3::Z * 18.0).unwrap() > 0);
            cloth.release(grab).unwrap();
            cloth.step(60);
        }
        assert!(grid.particle_count() > 23 * 18 + 10, "the cloth tore");
        assert_eq!(mesh.state_hash(), grid.state_hash(), "spacing {spacing}");
        assert_eq!(mesh.positions(), grid.positions());
        assert_eq!(mesh.normals(), grid.normals());
        assert_eq!(mesh.indices(), grid.indices());
    }
}

#[test]
fn a_grid_with_a_split_seam_is_recognised_after_welding() {
    let desc = bare_grid(11, 9, 0.1, PinMode::TopEdge);
    let mut seamed = mesh_of_grid(&desc);
    // Triangles right of column 5 use duplicates of that column's vertices.
    let mut duplicates = Vec::new();
    for row in 0..9 {
        duplicates.push(seamed.positions.len() as u32);
        seamed.positions.push(seamed.positions[row * 11 + 5]);
        seamed.uvs.push(seamed.uvs[row * 11 + 5]);
    }
    let column = |v: u32| v % 11;
    let (triangles, _) = seamed.indices.as_chunks_mut::<3>();
    for triangle in triangles.iter_mut().filter(|t| t.iter().any(|v| column(*v) > 5)) {
        for vertex in triangle.iter_mut().filter(|v| column(**v) == 5) {
            *vertex = duplicates[*vertex as usize / 11];
        }
    }
    seamed.weld_distance = 0.0;
    let (mut grid, mut mesh) = (Cloth::grid(&desc).unwrap(), Cloth::mesh(&seamed).unwrap());
    assert!(mesh.mesh_report().is_grid);
    assert_eq!(mesh.mesh_report().welded_vertices, 9);
    grid.step(90);
    mesh.step(90);
    assert_eq!(mesh.state_hash(), grid.state_hash());
    assert_eq!(mesh.indices(), seamed.indices);
    assert_mesh_invariants(&mut mesh, &seamed);
}

/// Random triangles between a few points, some of which coincide.
fn triangle_soup() -> impl Strategy<Value = MeshDesc> {
    let point = prop::array::uniform3(0..5_i32);
    let positions = prop::collection::vec(point, 4..24);
    let weld = prop::sample::select(vec![-1.0, 0.0, 0.3, 1.5]);
    (positions, weld, any::<u64>(), 1..80_usize).prop_map(|(points, weld_distance, seed, count)| {
        let mut random = seed | 1;
        let mut next = |below: usize| {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            (random % below as u64) as u32
        };
        let positions: Vec<Vec3> =
            points.iter().map(|p| Vec3::from_array(p.map(|x| x as f32 * 0.25))).collect();
        let indices = (0..3 * count).map(|_| next(positions.len())).collect();
        let pinned = vec![next(positions.len())];
        MeshDesc { positions, indices, pinned, weld_distance, ..MeshDesc::default() }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn any_triangle_soup_becomes_a_sound_cloth_or_is_refused(
        mut desc in triangle_soup(),
        tears in any::<bool>(),
    ) {
        desc.settings.tearing = tears;
        desc.material.tear_stretch = 1.1;
        match Cloth::mesh(&desc) {
            Ok(mut cloth) => {
                assert_mesh_invariants(&mut cloth, &desc);
                let report = *cloth.mesh_report();
                let dropped = report.dropped_degenerate + report.dropped_duplicates;
                prop_assert_eq!(report.triangles, report.kept_triangles + dropped);
                let copies = report.particles + report.welded_vertices - report.split_vertices;
                prop_assert_eq!(report.vertices, copies);
                prop_assert_eq!(cloth.stats().pieces, report.pieces);
                cloth.step(3);
                let blade = [Vec3::new(-1.0, 0.4, -1.0), Vec3::new(3.0, 0.55, -1.0)];
                let _ = cloth.cut(blade[0], blade[1], Vec3::Z * 4.0);
                cloth.step(3);
                assert_mesh_invariants(&mut cloth, &desc);
                let restored = Cloth::restore(&cloth.save()).unwrap();
                prop_assert_eq!(restored.state_hash(), cloth.state_hash());
                prop_assert_eq!(restored.indices(), cloth.indices());
                prop_assert_eq!(restored.vertex_particles(), cloth.vertex_particles());
            }
            Err(error) => {
                let has_no_triangle = matches!(error, Error::BadMesh { at: 0, .. });
                prop_assert!(has_no_triangle, "{}", error);
            }
        }
    }
}
