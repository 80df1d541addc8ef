//! `simplify_below`: short edges are collapsed and low triangles get another diagonal, while
//! topology, borders, seams and pins stay.

use crate::common::garments::{assert_mesh_invariants, push_grid_patch};
use crate::common::{rms_speed, triangles};
use crate::slivers::{CELL, drop_on_floor, slivered_sheet};
use muslin::glam::{DVec3, Vec2, Vec3};
use muslin::{Cloth, Map, Material, MeshDesc, Preset};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

type Triangles = Vec<[u32; 3]>;

/// The triangles of each edge, by its ends.
fn edges_of(triangles: &[[u32; 3]]) -> BTreeMap<[u32; 2], Vec<usize>> {
    let mut edges: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (at, [a, b, c]) in triangles.iter().enumerate() {
        for [p, q] in [[a, b], [b, c], [c, a]] {
            edges.entry([*p.min(q), *p.max(q)]).or_default().push(at);
        }
    }
    edges
}

/// Number of sets of items that are connected by links.
fn count_groups(links: &BTreeMap<u32, BTreeSet<u32>>) -> usize {
    let (mut seen, mut count) = (BTreeSet::new(), 0);
    for start in links.keys() {
        count += usize::from(!seen.contains(start));
        let mut stack = vec![*start];
        while let Some(at) = stack.pop() {
            if seen.insert(at) {
                stack.extend(&links[&at]);
            }
        }
    }
    count
}

/// Euler characteristic, number of pieces and number of border loops; `None` if a mesh is not
/// manifold or has a triangle twice.
fn topology(triangles: &[[u32; 3]]) -> Option<[i64; 3]> {
    let edges = edges_of(triangles);
    let sorted = triangles.iter().map(|corners| {
        let mut corners = *corners;
        corners.sort_unstable();
        corners
    });
    let distinct: BTreeSet<_> = sorted.collect();
    let is_proper = triangles.iter().all(|[a, b, c]| a != b && b != c && c != a);
    if !is_proper || distinct.len() < triangles.len() || edges.values().any(|at| at.len() > 2) {
        return None;
    }
    let (mut pieces, mut borders) = (BTreeMap::new(), BTreeMap::<_, BTreeSet<_>>::new());
    let mut fans: BTreeMap<u32, BTreeMap<u32, BTreeSet<u32>>> = BTreeMap::new();
    for [a, b, c] in triangles {
        for [center, p, q] in [[a, b, c], [b, c, a], [c, a, b]] {
            let ring = fans.entry(*center).or_default();
            ring.entry(*p).or_default().insert(*q);
            ring.entry(*q).or_default().insert(*p);
            pieces.entry(*p).or_insert_with(BTreeSet::new).extend([*q, *center]);
        }
    }
    for ([a, b], _) in edges.iter().filter(|(_, at)| at.len() == 1) {
        borders.entry(*a).or_default().insert(*b);
        borders.entry(*b).or_default().insert(*a);
    }
    let is_manifold = fans.values().all(|ring| count_groups(ring) == 1);
    let euler = (fans.len() + triangles.len()) as i64 - edges.len() as i64;
    is_manifold.then(|| [euler, count_groups(&pieces) as i64, count_groups(&borders) as i64])
}

fn particle_triangles(cloth: &Cloth) -> Triangles {
    let particles = cloth.vertex_particles();
    triangles(cloth).into_iter().map(|corners| corners.map(|v| particles[v as usize])).collect()
}

fn rest_positions(cloth: &Cloth) -> Vec<DVec3> {
    (0..cloth.particle_count()).map(|p| cloth.position(p).unwrap().as_dvec3()).collect()
}

/// Normal of a triangle, as long as twice its area, and its least height.
fn measure(x: &[DVec3], corners: [u32; 3]) -> (DVec3, f64) {
    let [a, b, c] = corners.map(|p| x[p as usize]);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    let normal = (b - a).cross(c - a);
    (normal, normal.length() / longest)
}

/// Creates a cloth that is simplified, and checks that it is sound and has the topology that it has
/// without.
fn simplified(desc: &MeshDesc) -> Cloth {
    let whole = Cloth::mesh(&MeshDesc { simplify_below: 0.0, ..desc.clone() }).unwrap();
    let mut cloth = Cloth::mesh(desc).unwrap();
    assert_mesh_invariants(&mut cloth, desc);
    let (before, after) = (whole.mesh_report(), cloth.mesh_report());
    assert_eq!(before.particles - after.particles, after.collapsed_edges);
    let removed = after.collapsed_triangles + after.trimmed_triangles;
    assert_eq!(before.kept_triangles - after.kept_triangles, removed);
    let topologies = [&whole, &cloth].map(|cloth| topology(&particle_triangles(cloth)));
    assert!(topologies[0].is_some() && topologies[0] == topologies[1], "{topologies:?}");
    let x = rest_positions(&cloth);
    let edges = edges_of(&particle_triangles(&cloth));
    let below = f64::from(desc.simplify_below);
    let length = |[a, b]: &[u32; 2]| x[*a as usize].distance(x[*b as usize]);
    assert_eq!(edges.keys().filter(|edge| length(edge) < below).count() as u32, after.short_edges);
    let given: BTreeSet<_> =
        desc.positions.iter().map(|x| x.to_array().map(f32::to_bits)).collect();
    let is_given = |x: &DVec3| given.contains(&x.as_vec3().to_array().map(f32::to_bits));
    assert!(x.iter().all(is_given), "particles are at given positions");
    cloth
}

/// The sheet with slivers, simplified.
fn smooth_sheet() -> MeshDesc {
    MeshDesc { simplify_below: 0.2 * CELL, ..slivered_sheet() }
}

#[test]
fn a_sheet_with_slivers_has_none_afterwards() {
    let report = *Cloth::mesh(&slivered_sheet()).unwrap().mesh_report();
    assert!(report.worst_aspect > 80.0 && report.shortest_edge < 0.02 * CELL, "{report:?}");
    let cloth = simplified(&smooth_sheet());
    let report = *cloth.mesh_report();
    println!("{report:?}");
    assert!(report.collapsed_edges > 100 && report.flipped_edges > 50, "{report:?}");
    assert!(report.worst_aspect < 8.0 && report.shortest_edge >= 0.2 * CELL, "{report:?}");
    assert_eq!((report.short_edges, report.thin_triangles), (0, 0));
    assert_eq!(report.warnings(), Vec::<String>::new());
}

#[test]
fn a_simplified_sheet_hangs_still() {
    for preset in [Preset::Silk, Preset::Leather] {
        let mut desc = smooth_sheet();
        desc.material = Material::preset(preset);
        let mut cloth = Cloth::mesh(&desc).unwrap();
        cloth.step(720);
        let speed = rms_speed(&cloth);
        println!("{preset:?}: {speed:.6} m/s");
        assert!(speed < 0.01, "{preset:?} moves at {speed} m/s after twelve seconds");
    }
}

#[test]
fn a_simplified_sheet_falls_on_a_floor_and_comes_to_rest() {
    let (cloth, fastest) = drop_on_floor(smooth_sheet());
    assert!(fastest < 4.0, "a particle moved at {fastest} m/s");
    assert!(rms_speed(&cloth) < 0.02, "{} m/s after three seconds", rms_speed(&cloth));
    let highest = cloth.positions().iter().map(|x| x.y).fold(0.0, f32::max);
    assert!(highest < 0.05, "a particle is at {highest} m");
}

#[test]
fn a_mesh_without_short_edges_keeps_its_bits() {
    let mut desc = crate::common::irregular_mesh();
    let mut plain = Cloth::mesh(&desc).unwrap();
    desc.simplify_below = 0.3 * plain.mesh_report().shortest_edge;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    assert_eq!(cloth.mesh_report(), plain.mesh_report());
    [&mut cloth, &mut plain].into_iter().for_each(|cloth| {
        cloth.step(20);
    });
    assert_eq!(cloth.state_hash(), plain.state_hash());
}

#[test]
fn a_limit_above_the_mean_edge_is_refused() {
    let mean_edge = Cloth::mesh(&slivered_sheet()).unwrap().mesh_report().mean_edge;
    let with = |simplify_below| Cloth::mesh(&MeshDesc { simplify_below, ..slivered_sheet() });
    assert!(with(mean_edge).is_ok());
    let error = with(mean_edge * 1.000_001).unwrap_err().to_string();
    assert_eq!(error, "`simplify_below` must be at most the mean length of the edges");
    for length in [f32::NAN, f32::INFINITY, -1.0e-9] {
        let error = with(length).unwrap_err().to_string();
        assert_eq!(error, "`simplify_below` must be finite and at least 0");
    }
}

/// Two patches of `size` cells of 0.125 m that are welded along a column, with coordinates of their
/// own, where `moved` shifts the grid points.
fn seamed_sheet(size: u32, moved: impl Fn(u32, u32) -> Vec2) -> MeshDesc {
    let mut desc = MeshDesc { weld_distance: 0.0, ..MeshDesc::default() };
    for patch in 0..2 {
        push_grid_patch(&mut desc, [size + 1, size + 1], 0.0, |column, row| {
            let at = Vec2::new((column + patch * size) as f32, -(row as f32));
            (0.125 * (at + moved(column + patch * size, row))).extend(0.0)
        });
    }
    let half = desc.positions.len() / 2;
    let offset = |vertex| if vertex < half { 0.0 } else { 10.0 };
    desc.uvs =
        (0..2 * half).map(|v| desc.positions[v].truncate() + Vec2::splat(offset(v))).collect();
    desc
}

#[test]
fn every_corner_keeps_the_texture_coordinates_of_its_place_and_of_its_side() {
    // Short edges across, along and next to the seam in column 4.
    let mut desc = seamed_sheet(4, |column, row| match (column, row) {
        (3, 1) | (3, 3) => Vec2::X * 0.95,
        (5, 1) | (5, 2) => Vec2::X * -0.96,
        (4, 2) => Vec2::Y * -0.97,
        (1, 1) => Vec2::new(0.94, 0.0),
        _ => Vec2::ZERO,
    });
    desc.simplify_below = 0.02;
    let mut cloth = simplified(&desc);
    assert!(cloth.mesh_report().collapsed_edges >= 5, "{:?}", cloth.mesh_report());
    assert_eq!(cloth.mesh_report().short_edges, 0);
    let check = |cloth: &Cloth| {
        for corners in triangles(cloth) {
            let sides = corners.map(|vertex| cloth.uvs()[vertex as usize].x > 8.0);
            assert!(sides.iter().all(|side| *side == sides[0]), "{corners:?} crosses the seam");
            for vertex in corners {
                let (x, uv) = (cloth.positions()[vertex as usize], cloth.uvs()[vertex as usize]);
                let place = uv - if sides[0] { Vec2::splat(10.0) } else { Vec2::ZERO };
                assert!(place.distance(x.truncate()) < 1.0e-5, "vertex {vertex}: {x} has {uv}");
                assert!(if sides[0] { x.x > 0.4999 } else { x.x < 0.5001 }, "vertex {vertex}: {x}");
            }
        }
    };
    check(&cloth);
    // The collapsed vertices follow their particles through a cut along the seam.
    cloth.cut(Vec3::new(0.5, 1.0, -1.0), Vec3::new(0.5, -0.3, -1.0), Vec3::Z * 2.0).unwrap();
    check(&cloth);
    assert_mesh_invariants(&mut cloth, &desc);
    cloth.step(10);
    assert_mesh_invariants(&mut cloth, &desc);
}

#[test]
fn triangles_without_common_vertices_collapse_once_they_are_welded() {
    // As in an STL file: each triangle has vertices of its own.
    let mut desc = smooth_sheet();
    desc.pinned.clear();
    let indexed = simplified(&desc);
    desc.positions = desc.indices.iter().map(|v| desc.positions[*v as usize]).collect();
    desc.indices = (0..desc.positions.len() as u32).collect();
    desc.weld_distance = 0.0;
    let cloth = simplified(&desc);
    assert_eq!(cloth.mesh_report().particles, indexed.mesh_report().particles);
    assert_eq!(cloth.mesh_report().short_edges, 0);
}

#[test]
fn borders_and_corners_stay_where_they_are() {
    // Short edges on the border, at a corner and inwards from it.
    let mut desc = seamed_sheet(4, |column, row| match (column, row) {
        (1, 0) | (1, 4) => Vec2::X * -0.95,
        (7, 0) => Vec2::X * 0.95,
        (4, 0) => Vec2::X * 0.97,
        (0, 2) => Vec2::Y * 0.96,
        (3, 3) => Vec2::Y * -0.95,
        _ => Vec2::ZERO,
    });
    desc.uvs.clear();
    desc.simplify_below = 0.02;
    let cloth = simplified(&desc);
    assert!(cloth.mesh_report().collapsed_edges >= 5, "{:?}", cloth.mesh_report());
    let (x, triangles) = (rest_positions(&cloth), particle_triangles(&cloth));
    for corner in [[0.0, 0.0], [1.0, 0.0], [0.0, -0.5], [1.0, -0.5]] {
        let corner = DVec3::new(corner[0], corner[1], 0.0);
        assert!(x.iter().any(|x| x.distance(corner) < 1.0e-6), "the corner {corner} is gone");
    }
    let edges = edges_of(&triangles);
    let border = edges.iter().filter(|(_, at)| at.len() == 1);
    let length: f64 = border.map(|([a, b], _)| x[*a as usize].distance(x[*b as usize])).sum();
    assert!((length - 3.0).abs() < 1.0e-6, "the border is {length} m long");
    let area: f64 = triangles.iter().map(|corners| measure(&x, *corners).0.z.abs() / 2.0).sum();
    assert!((area - 0.5).abs() < 1.0e-6, "the area is {area} m²");
}

#[test]
fn low_triangles_at_a_border_move_it_once_by_less_than_the_limit() {
    // Rows of the sheet below its upper border, each far lower than the limit.
    let mut desc = seamed_sheet(4, |_, row| Vec2::Y * (0.97 * row.min(3) as f32));
    desc.uvs.clear();
    let (column, lowest) = (|v: usize| v % 5, 0.125 * 0.09);
    for vertex in (0..50).filter(|vertex| vertex / 5 % 2 == 1 && column(*vertex) < 4) {
        desc.positions[vertex].x += 0.0625;
    }
    desc.simplify_below = 0.02;
    let cloth = simplified(&desc);
    let (x, triangles) = (rest_positions(&cloth), particle_triangles(&cloth));
    let used: BTreeSet<u32> = triangles.iter().flatten().copied().collect();
    for column in 0..9 {
        let near = |p: &&u32| (x[**p as usize].x - 0.125 * f64::from(column)).abs() < 0.07;
        let top = used.iter().filter(near).map(|p| x[*p as usize].y).fold(-1.0, f64::max);
        assert!(top > -0.02 && top > -2.0 * lowest, "the border is {top} m high at {column}");
    }
}

#[test]
fn pins_and_maps_follow_the_particles() {
    let mut desc = seamed_sheet(4, |column, row| match (column, row) {
        (0, 1) => Vec2::Y * 0.97,
        (2, 2) => Vec2::X * 0.96,
        (6, 0) => Vec2::X * -0.97,
        _ => Vec2::ZERO,
    });
    desc.uvs.clear();
    // A corner, an inner vertex next to a free one, both ends of a short edge.
    desc.pinned = vec![0, 12, 25 + 1, 25 + 2];
    desc.simplify_below = 0.02;
    let mut cloth = simplified(&desc);
    assert_eq!(cloth.mesh_report().collapsed_edges, 3);
    let particle = |cloth: &Cloth, vertex: u32| cloth.vertex_particles()[vertex as usize];
    let mut expected = desc.pinned.iter().map(|v| particle(&cloth, *v)).collect::<Vec<_>>();
    expected.sort_unstable();
    expected.dedup();
    assert_eq!(expected.len(), 3);
    assert_eq!(cloth.pinned().collect::<Vec<_>>(), expected);
    for vertex in [0, 12] {
        let at = desc.positions[vertex as usize];
        assert_eq!(cloth.position(particle(&cloth, vertex)), Some(at), "a pin stays");
    }
    assert_eq!(particle(&cloth, 12), particle(&cloth, 13), "the free vertex went to the pin");
    // One scale per particle, by the vertices.
    let mut scales = vec![1.0; cloth.particle_count() as usize];
    scales[particle(&cloth, 13) as usize] = 0.25;
    cloth.set_map(Map::Bend, Some(&scales)).unwrap();
    assert!(cloth.set_map(Map::Bend, Some(&vec![1.0; desc.positions.len()])).is_err());
    cloth.step(30);
    for vertex in [0, 12, 13] {
        let given = desc.positions[if vertex == 13 { 12 } else { vertex as usize }];
        assert_eq!(cloth.positions()[vertex as usize], given, "vertex {vertex} is held");
    }
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    cloth.reset();
    restored.reset();
    assert_eq!(restored.state_hash(), cloth.state_hash());
    assert_eq!(restored.mesh_report(), cloth.mesh_report());
}

/// A sheet or a tube, flat or wavy, whose vertices are moved at random and some of which come close
/// to others.
fn random_mesh() -> impl Strategy<Value = MeshDesc> {
    let size = (2..7_u32, 2..7_u32, 0..3_u32);
    let moves = prop::collection::vec((0.0..1.0_f32, 0.0..1.0_f32, 0..6_u8), 49);
    (size, moves, 0.05..1.0_f32, any::<u64>()).prop_map(
        |((columns, rows, form), moves, share, seed)| {
            let mut desc = MeshDesc::default();
            push_grid_patch(&mut desc, [columns + 1, rows + 1], 0.0, |column, row| {
                let (right, down, near) = moves[(7 * row + column) as usize % moves.len()];
                let reach = if near == 0 { 0.9 } else { 0.3 };
                let at = Vec2::new(column as f32 + reach * right, row as f32 + reach * down);
                let turn = at.x * std::f32::consts::TAU / (columns as f32 + 1.0);
                match form {
                    0 => at.extend(0.0),
                    1 => at.extend(0.4 * (3.0 * at.x).sin()),
                    _ => Vec3::new(turn.cos(), turn.sin(), 0.7 * at.y),
                }
            });
            if form == 2 {
                // Closes the tube: the vertices of the last column join the first.
                let per_row = columns + 1;
                for v in desc.indices.iter_mut().filter(|v| **v % per_row == columns) {
                    *v -= columns;
                }
            }
            desc.uvs.clear();
            let count = desc.positions.len() as u32;
            desc.pinned = (0..count).filter(|v| seed >> (v % 64) & 31 == 0).collect();
            if let Ok(cloth) = Cloth::mesh(&desc) {
                desc.simplify_below = share * cloth.mesh_report().mean_edge;
            }
            desc
        },
    )
}

/// Why the edge from `u` to `v` cannot collapse to `v`; `None` if it can. Tries it on a copy.
fn obstacle(
    x: &[DVec3],
    triangles: &[[u32; 3]],
    [u, v]: [u32; 2],
    pinned: &BTreeSet<u32>,
    below: f64,
) -> Option<&'static str> {
    let edges = edges_of(triangles);
    let borders: Vec<u32> = edges
        .iter()
        .filter(|(ends, at)| ends.contains(&u) && at.len() == 1)
        .map(|([a, b], _)| if *a == u { *b } else { *a })
        .collect();
    if pinned.contains(&u) && !pinned.contains(&v) {
        return Some("pin");
    }
    if let [a, b] = borders[..] {
        let (along, back) = (x[a as usize] - x[u as usize], x[b as usize] - x[u as usize]);
        if !borders.contains(&v)
            || along.angle_between(back) < 2.0 / 3.0 * std::f64::consts::PI + 1e-9
        {
            return Some("border");
        }
    }
    let moved = |corners: &[u32; 3]| corners.map(|p| if p == u { v } else { p });
    let (mut before, mut after) = (f64::INFINITY, f64::INFINITY);
    let fan = triangles.iter().filter(|corners| corners.contains(&u));
    let mean: DVec3 = fan.clone().map(|corners| measure(x, *corners).0).sum();
    let mut copy: Triangles = triangles.iter().filter(|c| !c.contains(&u)).copied().collect();
    for corners in fan {
        let (normal, height) = measure(x, *corners);
        before = before.min(height);
        if corners.contains(&v) {
            continue;
        }
        copy.push(moved(corners));
        let (new_normal, new_height) = measure(x, moved(corners));
        after = after.min(new_height);
        if new_normal.dot(if height < below { mean } else { normal })
            <= 1.0e-9 * mean.length_squared()
        {
            return Some("normal");
        }
    }
    if after < before * (1.0 + 1e-9) && after < 0.5 * below * (1.0 + 1e-9) {
        return Some("height");
    }
    (topology(&copy) != topology(triangles)).then_some("topology")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn short_edges_of_random_meshes_are_collapsed_unless_something_forbids_it(desc in random_mesh()) {
        prop_assume!(Cloth::mesh(&desc).is_ok());
        let mut cloth = simplified(&desc);
        let (x, triangles) = (rest_positions(&cloth), particle_triangles(&cloth));
        let pinned: BTreeSet<u32> = cloth.pinned().collect();
        let below = f64::from(desc.simplify_below);
        for [a, b] in edges_of(&triangles).keys().copied() {
            if x[a as usize].distance(x[b as usize]) < below {
                for ends in [[a, b], [b, a]] {
                    let why = obstacle(&x, &triangles, ends, &pinned, below);
                    prop_assert!(why.is_some(), "{ends:?} could collapse");
                }
            }
        }
        let near = |at: &Vec3| desc.pinned.iter().any(|v| desc.positions[*v as usize] == *at);
        prop_assert!(cloth.pinned().all(|p| near(&cloth.position(p).unwrap())));
        cloth.step(3);
        let restored = Cloth::restore(&cloth.save()).unwrap();
        prop_assert_eq!(restored.state_hash(), cloth.state_hash());
        prop_assert_eq!(restored.vertex_particles(), cloth.vertex_particles());
    }
}
