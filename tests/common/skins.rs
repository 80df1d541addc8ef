//! Render meshes for skins: fine sheets and spheres, with measurements.

use muslin::glam::{Vec2, Vec3};
use muslin::{Cloth, MeshDesc, Skin, SkinDesc};

/// A sheet of `columns` × `rows` vertices with corners at `origin` and `origin + size`, in the x–y
/// plane.
pub fn sheet(columns: u32, rows: u32, origin: Vec3, size: Vec2) -> SkinDesc {
    let share = |i: u32, count: u32| i as f32 / (count - 1) as f32;
    let uvs: Vec<Vec2> = (0..columns * rows)
        .map(|i| Vec2::new(share(i % columns, columns), share(i / columns, rows)))
        .collect();
    let positions = uvs.iter().map(|uv| origin + (*uv * size).extend(0.0)).collect();
    let mut indices = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = row * columns + column;
            let (b, c, d) = (a + 1, a + columns, a + columns + 1);
            indices.extend([a, c, b, b, c, d]);
        }
    }
    SkinDesc { positions, indices, uvs, ..SkinDesc::default() }
}

/// An icosahedron whose triangles are divided into four, `levels` times, on the unit sphere.
pub fn icosphere(levels: u32) -> MeshDesc {
    let g = 0.5 * (1.0 + 5.0_f32.sqrt());
    let mut positions: Vec<Vec3> = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        positions.extend([Vec3::new(a, b, 0.0), Vec3::new(0.0, a, b), Vec3::new(b, 0.0, a)]);
    }
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for a in 0..12_u32 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [x, y, z] = [a, b, c].map(|i| positions[i as usize]);
                let is_face = [x - y, y - z, z - x].iter().all(|edge| edge.length() < 2.1);
                if is_face {
                    let faces_out = (y - x).cross(z - x).dot(x) > 0.0;
                    triangles.push(if faces_out { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    assert_eq!(triangles.len(), 20);
    for _ in 0..levels {
        let mut middles: Vec<([u32; 2], u32)> = Vec::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[p, q]| {
                let ends = [p.min(q), p.max(q)];
                if let Some((_, middle)) = middles.iter().find(|(known, _)| *known == ends) {
                    return *middle;
                }
                let middle = positions.len() as u32;
                positions.push((positions[p as usize] + positions[q as usize]) * 0.5);
                middles.push((ends, middle));
                middle
            });
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    let positions = positions.iter().map(|x| x.normalize()).collect();
    MeshDesc { positions, indices: triangles.as_flattened().to_vec(), ..MeshDesc::default() }
}

/// The render mesh with the vertices and triangles of a mesh.
pub fn skin_of(mesh: &MeshDesc) -> SkinDesc {
    SkinDesc {
        positions: mesh.positions.clone(),
        indices: mesh.indices.clone(),
        uvs: mesh.uvs.clone(),
        ..SkinDesc::default()
    }
}

/// The largest ratio of the length of an edge of the skin to its length in the descriptor.
pub fn longest_edge_ratio(skin: &Skin, desc: &SkinDesc) -> f32 {
    let mut most = 0.0_f32;
    for corners in skin.indices().chunks_exact(3) {
        for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(a, b)| (corners[a], corners[b])) {
            let [p, q] = [a, b].map(|v| skin.positions()[v as usize]);
            let [given, other] =
                [a, b].map(|v| desc.positions[skin.source_vertices()[v as usize] as usize]);
            most = most.max((q - p).length() / (other - given).length());
        }
    }
    most
}

/// Asserts what holds for every skin after an update: finite positions, unit normals, lists of
/// equal length, and the triangles of the descriptor.
pub fn assert_skin_invariants(skin: &Skin, desc: &SkinDesc) {
    let count = skin.positions().len();
    assert!(skin.positions().iter().all(|x| x.is_finite()));
    for (v, n) in skin.normals().iter().enumerate() {
        assert!((n.length() - 1.0).abs() < 1.0e-5, "the normal of vertex {v} is {n}");
    }
    let lengths = [skin.normals().len(), skin.uvs().len(), skin.frayed().len()];
    assert_eq!(lengths, [count; 3]);
    assert_eq!(skin.source_vertices().len(), count);
    assert!(count <= skin.vertex_capacity() as usize);
    assert_eq!(skin.indices().len(), desc.indices.len(), "a triangle was lost");
    for (now, given) in skin.indices().iter().zip(&desc.indices) {
        assert_eq!(skin.source_vertices()[*now as usize], *given);
    }
    for (v, source) in skin.source_vertices().iter().enumerate() {
        assert!(v >= desc.positions.len() || v == *source as usize);
        assert!(desc.uvs.is_empty() || skin.uvs()[v] == desc.uvs[*source as usize]);
    }
}

/// A skin after an update.
pub fn updated(cloth: &Cloth, desc: &SkinDesc) -> Skin {
    let skin = Skin::new(cloth, desc).unwrap();
    assert_skin_invariants(&skin, desc);
    skin
}
