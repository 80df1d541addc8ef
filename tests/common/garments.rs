//! Garment meshes as artists export them, with duplicate vertices along seams, and a mesh with
//! every defect that the mesh intake repairs.

use muslin::glam::{Vec2, Vec3};
use muslin::{Cloth, MeshDesc};
use std::collections::{HashMap, HashSet};
use std::f32::consts::{PI, TAU};

/// Appends a grid of `columns` × `rows` vertices, the position of each given by `at(column, row)`.
/// Its texture coordinates start at `u`, so that patches do not overlap in the texture. Returns the
/// index of its first vertex.
pub fn push_grid_patch(
    desc: &mut MeshDesc,
    [columns, rows]: [u32; 2],
    u: f32,
    at: impl Fn(u32, u32) -> Vec3,
) -> u32 {
    let first = desc.positions.len() as u32;
    for row in 0..rows {
        for column in 0..columns {
            desc.positions.push(at(column, row));
            desc.uvs.push(Vec2::new(u + column as f32 / 64.0, row as f32 / 64.0));
        }
    }
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = first + row * columns + column;
            let (b, c, d) = (a + 1, a + columns, a + columns + 1);
            let is_falling = (row + column) % 2 == 0;
            desc.indices.extend(if is_falling { [a, c, d, a, d, b] } else { [a, c, b, c, d, b] });
        }
    }
    first
}

/// A disc that is pinned along a tenth of its rim. It has no defects.
pub fn disc() -> MeshDesc {
    let (around, rings) = (40, 10);
    let mut desc = MeshDesc { positions: vec![Vec3::ZERO], ..MeshDesc::default() };
    for ring in 1..=rings {
        for i in 0..around {
            let (sine, cosine) = (i as f32 / around as f32 * TAU).sin_cos();
            desc.positions.push(Vec3::new(cosine, sine, 0.0) * (0.05 * ring as f32));
        }
    }
    let at = |ring: u32, i: u32| if ring == 0 { 0 } else { 1 + (ring - 1) * around + i % around };
    for i in 0..around {
        desc.indices.extend([0, at(1, i), at(1, i + 1)]);
    }
    for ring in 1..rings {
        for i in 0..around {
            let (a, b) = (at(ring, i), at(ring, i + 1));
            let (c, d) = (at(ring + 1, i), at(ring + 1, i + 1));
            desc.indices.extend([a, c, d, a, d, b]);
        }
    }
    desc.uvs = desc.positions.iter().map(|x| x.truncate()).collect();
    desc.pinned = (0..=4).map(|i| at(rings, 8 + i)).collect();
    desc
}

/// A sleeve: a tube with duplicate vertices along its seam, pinned at one end.
pub fn sleeve() -> MeshDesc {
    let mut desc = MeshDesc { weld_distance: 1.0e-4, ..MeshDesc::default() };
    let (around, rings) = (24, 16);
    push_grid_patch(&mut desc, [around + 1, rings], 0.0, |i, ring| {
        let (sine, cosine) = (i as f32 / around as f32 * TAU).sin_cos();
        Vec3::new(0.15 * cosine, -0.04 * ring as f32, 0.15 * sine)
    });
    desc.pinned = (0..=around).collect();
    desc
}

/// A Möbius strip: a half twist and welded ends, pinned by six vertices.
pub fn moebius_strip() -> MeshDesc {
    let mut desc = MeshDesc { weld_distance: 1.0e-4, ..MeshDesc::default() };
    let (along, across) = (60, 5);
    push_grid_patch(&mut desc, [along + 1, across], 0.0, |i, side| {
        let turn = i as f32 / along as f32;
        let (sine, cosine) = (turn * TAU).sin_cos();
        let (tilt, level) = (turn * PI).sin_cos();
        let off = 0.05 * (side as f32 - 2.0);
        Vec3::new((0.5 + off * level) * cosine, off * tilt, (0.5 + off * level) * sine)
    });
    desc.pinned = vec![0, 1, 20, 21, 40, 41];
    desc
}

/// A shirt: front and back, each made of a body and two sleeves that are separate in the texture.
/// Open at the neck, the hem and the cuffs; pinned at the shoulders.
pub fn shirt() -> MeshDesc {
    dense_shirt(1)
}

/// The same shirt with `n` × `n` cells in place of each.
pub fn dense_shirt(n: u32) -> MeshDesc {
    let mut desc = MeshDesc { weld_distance: 1.0e-4, ..MeshDesc::default() };
    let step = 0.04 / n as f32;
    // In steps times `n`: the body spans x from 6 to 16 and y from 0 to 18; the sleeves span x from
    // 0 to 6 and from 16 to 22, and y from 0 to 5.
    let on_seam = |x: u32, y: u32| {
        let at_shoulder = y == 0 && !(9 * n..=13 * n).contains(&x);
        let at_side = (x == 6 * n || x == 16 * n) && y >= 5 * n;
        let under_arm = y == 5 * n && !(6 * n..=16 * n).contains(&x);
        at_shoulder || at_side || under_arm
    };
    for (side, u) in [(1.0, 0.0), (-1.0, 1.0)] {
        let place = |x: u32, y: u32| {
            let bulge = if on_seam(x, y) { 0.0 } else { 0.03 * side };
            Vec3::new(x as f32 * step, -(y as f32) * step, bulge)
        };
        let body =
            push_grid_patch(&mut desc, [10 * n + 1, 18 * n + 1], u, |x, y| place(6 * n + x, y));
        let sleeve = [6 * n + 1, 5 * n + 1];
        push_grid_patch(&mut desc, sleeve, u + 0.25, place);
        push_grid_patch(&mut desc, sleeve, u + 0.5, |x, y| place(16 * n + x, y));
        if side < 0.0 {
            // Wind the triangles of the back the other way, so that they face outwards.
            let first = desc.indices.iter().position(|v| *v == body).unwrap();
            desc.indices[first..].as_chunks_mut::<3>().0.iter_mut().for_each(|t| t.swap(1, 2));
        }
        desc.pinned.extend([1, 2, 8, 9].map(|column| body + column * n));
    }
    desc
}

/// A pinned cloth with every defect that the mesh intake repairs.
pub fn defective_mesh() -> MeshDesc {
    let mut desc = MeshDesc { weld_distance: 1.0e-3, ..MeshDesc::default() };
    // Two halves with a gap below the weld distance; the right half is wound the other way, except
    // for two triangles.
    let place = |x: u32, y: u32| Vec3::new(x as f32, -(y as f32), 0.0) * 0.05;
    let left = push_grid_patch(&mut desc, [9, 12], 0.0, place);
    let half = desc.indices.len();
    let right = push_grid_patch(&mut desc, [9, 12], 1.0, |x, y| place(8 + x, y) + Vec3::X * 4.0e-4);
    desc.indices[half..].as_chunks_mut::<3>().0.iter_mut().for_each(|t| t.swap(1, 2));
    desc.indices[half + 9..half + 15].as_chunks_mut::<3>().0.iter_mut().for_each(|t| t.swap(1, 2));
    // Duplicate triangles, a triangle that uses a vertex twice, and one without area.
    let again: Vec<u32> = desc.indices[30..36].to_vec();
    desc.indices.extend([again[1], again[0], again[2], again[3], again[4], again[5]]);
    desc.indices.extend([left, left, left + 1, left, left + 1, left + 2]);
    // A third triangle on an edge in the middle of the sheet, with one end pinned, and a triangle
    // that is joined to the sheet by one vertex only.
    let (a, b) = (left + 5 * 9 + 3, left + 5 * 9 + 4);
    let fin = desc.positions.len() as u32;
    desc.positions.push(place(3, 5) + Vec3::new(0.025, 0.0, 0.05));
    desc.positions.push(place(7, 11) + Vec3::new(0.02, -0.05, 0.0));
    desc.positions.push(place(7, 11) + Vec3::new(-0.02, -0.05, 0.0));
    desc.indices.extend([a, b, fin]);
    let point = left + 11 * 9 + 7;
    desc.indices.extend([point, fin + 1, fin + 2]);
    // Vertices without triangles, and a separate piece.
    desc.positions.extend([Vec3::Y, Vec3::Y * 2.0]);
    desc.uvs.resize(desc.positions.len(), Vec2::ZERO);
    let separate = push_grid_patch(&mut desc, [5, 5], 2.0, |x, y| place(20 + x, y));
    desc.pinned = vec![left, left + 4, right + 2, right + 8, a, b, point, separate, separate + 4];
    desc
}

/// Asserts the invariants of vertices and particles that hold for every mesh after intake, tears
/// and cuts.
pub fn assert_mesh_invariants(cloth: &mut Cloth, given: &MeshDesc) {
    let (particles, report) = (cloth.particle_count() as usize, *cloth.mesh_report());
    let view = cloth.view();
    let count = view.positions.len();
    let capacity = view.vertex_capacity as usize;
    assert!(particles <= count && count <= capacity, "{particles} {count} {capacity}");
    assert!(count >= given.positions.len(), "given vertices keep their numbers");
    for length in [view.normals.len(), view.uvs.len(), view.frayed.len(), view.particles.len()] {
        assert_eq!(length, count);
    }
    assert_eq!(view.source_vertices.len(), count);
    assert!(
        view.source_vertices[..given.positions.len()]
            .iter()
            .copied()
            .eq(0..given.positions.len() as u32)
    );
    assert!(view.source_vertices.iter().all(|v| (*v as usize) < given.positions.len()));
    assert!(view.particles.iter().all(|particle| (*particle as usize) < particles));
    assert!(view.indices.iter().all(|v| (*v as usize) < count));
    assert!(view.indices.len() as u32 >= 3 * report.kept_triangles);
    assert!(view.indices.len() as u32 <= view.index_capacity);
    assert!(view.positions.iter().chain(view.normals).all(|x| x.is_finite()));
    let triangles: Vec<[u32; 3]> = view.indices.as_chunks::<3>().0.to_vec();
    let of_particles: Vec<[u32; 3]> =
        triangles.iter().map(|triangle| triangle.map(|v| view.particles[v as usize])).collect();
    let mut at_edge: HashMap<[u32; 2], Vec<usize>> = HashMap::new();
    for (at, [a, b, c]) in of_particles.iter().copied().enumerate() {
        assert!(a != b && b != c && c != a, "triangle {at} uses a particle twice");
        for [p, q] in [[a, b], [b, c], [c, a]] {
            at_edge.entry([p.min(q), p.max(q)]).or_default().push(at);
        }
    }
    assert!(
        at_edge.values().all(|around| around.len() <= 2),
        "an edge has more than two triangles"
    );
    assert_one_fan_per_particle(&of_particles, particles);
    let normals = view.normals.to_vec();
    let (positions, to) = (view.positions.to_vec(), view.particles.to_vec());
    let mut normal_of: HashMap<u32, Vec3> = HashMap::new();
    for (vertex, particle) in to.iter().enumerate() {
        assert_eq!(cloth.position(*particle), Some(positions[vertex]), "vertex {vertex}");
        assert_eq!(*normal_of.entry(*particle).or_insert(normals[vertex]), normals[vertex]);
    }
    let with_vertices: HashSet<u32> = to.into_iter().collect();
    assert_eq!(with_vertices.len(), particles, "every particle has a vertex");
}

/// Asserts that the triangles of every particle are connected through edges.
fn assert_one_fan_per_particle(triangles: &[[u32; 3]], particles: usize) {
    let mut around: Vec<Vec<[u32; 3]>> = vec![Vec::new(); particles];
    for triangle in triangles {
        triangle.iter().for_each(|particle| around[*particle as usize].push(*triangle));
    }
    for (particle, fan) in around.iter().enumerate().filter(|(_, fan)| !fan.is_empty()) {
        let mut reached = vec![false; fan.len()];
        let mut stack = vec![0];
        while let Some(at) = stack.pop() {
            if std::mem::replace(&mut reached[at], true) {
                continue;
            }
            stack.extend((0..fan.len()).filter(|other| {
                let is_shared = |p: &&u32| **p != particle as u32 && fan[*other].contains(p);
                !reached[*other] && fan[at].iter().any(|p| is_shared(&p))
            }));
        }
        assert!(reached.iter().all(|r| *r), "particle {particle} joins two fans at a point");
    }
}
