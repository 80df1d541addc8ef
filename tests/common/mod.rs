//! Helpers shared by the integration tests: cloth descriptors, measurements, and the invariants
//! that hold after any tear or cut.
#![allow(dead_code)]

pub mod crossings;
pub mod elastica;
pub mod folding;
pub mod garments;
pub mod shapes;
pub mod skins;
pub mod strip;

use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Material, MeshDesc, PinMode, Settings};
use std::collections::HashMap;

/// Settings and material with gravity and links only: no damping, no drag, no lift.
pub fn bare() -> (Settings, Material) {
    let settings = Settings { damping: 0.0, ..Settings::default() };
    let material = Material { drag: 0.0, lift: 0.0, ..Material::default() };
    (settings, material)
}

/// A grid in the x–y plane with gravity and links only: no damping, no drag, no lift.
pub fn bare_grid(columns: u32, rows: u32, spacing: f32, pin_mode: PinMode) -> GridDesc {
    let (settings, material) = bare();
    GridDesc { columns, rows, spacing, pin_mode, settings, material, ..GridDesc::default() }
}

/// Three quarters of a ring of triangles, some wound the other way, with one triangle added at its
/// start.
pub fn irregular_mesh() -> MeshDesc {
    let mut positions = Vec::new();
    for i in 0..10 {
        let angle = i as f32 * 0.5;
        let wobble = 1.0 + 0.1 * (i as f32 * 2.3).sin();
        for radius in [0.5, 0.9 * wobble, 1.3] {
            positions.push(Vec3::new(
                radius * angle.cos(),
                radius * angle.sin(),
                0.05 * angle.sin(),
            ));
        }
    }
    let mut indices = Vec::new();
    for i in 0..9 {
        for ring in 0..2 {
            let (a, b) = (3 * i + ring, 3 * (i + 1) + ring);
            let quad = [[a, a + 1, b], [b, a + 1, b + 1]];
            for (at, [p, q, r]) in quad.into_iter().enumerate() {
                indices.extend(if (i + at as u32).is_multiple_of(3) {
                    [q, p, r]
                } else {
                    [p, q, r]
                });
            }
        }
    }
    positions.push(Vec3::new(1.8, -0.2, 0.0));
    indices.extend([1, 2, positions.len() as u32 - 1]);
    let uvs = positions.iter().map(|x| x.truncate()).collect();
    MeshDesc { positions, indices, uvs, pinned: vec![0, 2], ..MeshDesc::default() }
}

/// Vertex indices of each triangle.
pub fn triangles(cloth: &Cloth) -> Vec<[u32; 3]> {
    cloth.indices().chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect()
}

/// Total mass [kg].
pub fn total_mass(cloth: &Cloth) -> f64 {
    let mass = |i: usize| f64::from(cloth.mass(i as u32).unwrap());
    (0..cloth.positions().len()).map(mass).sum()
}

/// Root mean square speed of all particles [m/s].
pub fn rms_speed(cloth: &Cloth) -> f32 {
    let count = cloth.particle_count();
    let sum: f32 = (0..count).map(|i| cloth.velocity(i).unwrap().length_squared()).sum();
    (sum / count as f32).sqrt()
}

/// Asserts the invariants that hold for every torn cloth. `before` is the same cloth before any
/// tear.
pub fn assert_tear_invariants(cloth: &Cloth, before: &Cloth) {
    assert_cut_invariants(cloth, before);
    let sources = cloth.source_vertices();
    assert_eq!(
        cloth.indices().len(),
        before.indices().len(),
        "the number of triangles must not change"
    );
    for (now, then) in cloth.indices().iter().zip(before.indices()) {
        let source = sources[*now as usize];
        assert_eq!(source, *then, "a triangle corner must keep its source vertex");
    }
}

/// Asserts the invariants that hold for every torn and cut cloth. `before` is the same cloth before
/// any tear or cut; its texture is planar and has no overlaps, so that areas can be measured in it.
pub fn assert_cut_invariants(cloth: &Cloth, before: &Cloth) {
    let count = cloth.positions().len();
    let sources = cloth.source_vertices();
    assert_eq!(sources.len(), count);
    assert_eq!(cloth.uvs().len(), count);
    assert!(cloth.indices().iter().all(|index| (*index as usize) < count));
    assert!(sources.iter().all(|source| (*source as usize) < before.positions().len()));
    let mut is_used = vec![false; count];
    cloth.indices().iter().for_each(|index| is_used[*index as usize] = true);
    let was_used =
        |v: usize| v >= before.positions().len() || before.indices().contains(&(v as u32));
    assert!((0..count).all(|v| is_used[v] || !was_used(v)), "a vertex without triangles");
    let (area, area_before) = (texture_area(cloth), texture_area(before));
    assert!((area - area_before).abs() <= 1.0e-6 * area_before, "area {area}, was {area_before}");
    let mut edges: HashMap<[u32; 2], u32> = HashMap::new();
    for [a, b, c] in triangles(cloth) {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            *edges.entry([p.min(q), p.max(q)]).or_default() += 1;
        }
    }
    for (edge, uses) in &edges {
        assert!(*uses <= 2, "edge {edge:?} has {uses} triangles");
    }
    assert_one_fan_per_vertex(cloth);
    let mut all: Vec<[u32; 3]> = triangles(cloth);
    all.iter_mut().for_each(|triangle| triangle.sort_unstable());
    all.sort_unstable();
    assert!(all.windows(2).all(|two| two[0] != two[1]), "a duplicate triangle");
    let mut beside = vec![Vec::new(); count];
    for [a, b] in edges.keys() {
        beside[*a as usize].push(*b);
        beside[*b as usize].push(*a);
    }
    for (a, b, kind) in cloth.links() {
        assert!((a as usize) < count && (b as usize) < count && a != b);
        let joined = edges.contains_key(&[a.min(b), a.max(b)]);
        // Shear and bend links span two adjacent triangles or two edges in a row.
        let over = || beside[a as usize].iter().any(|v| beside[b as usize].contains(v));
        let may_span = kind != muslin::LinkKind::Stretch && over();
        assert!(joined || may_span, "a {kind:?} link {a}–{b} without triangles");
    }
    let (mass, exact) = (total_mass(cloth), total_mass(before));
    assert!((mass - exact).abs() <= 1.0e-6 * exact, "mass {mass} kg, was {exact} kg");
    assert!(cloth.positions().iter().all(|x| x.is_finite()));
}

/// Total area of the triangles in the texture.
fn texture_area(cloth: &Cloth) -> f64 {
    let uv = |v: u32| cloth.uvs()[v as usize].as_dvec2();
    let area = |[a, b, c]: [u32; 3]| 0.5 * (uv(b) - uv(a)).perp_dot(uv(c) - uv(a)).abs();
    triangles(cloth).into_iter().map(area).sum()
}

/// Asserts that the triangles of every vertex are connected through edges.
fn assert_one_fan_per_vertex(cloth: &Cloth) {
    let mut around: HashMap<u32, Vec<[u32; 3]>> = HashMap::new();
    for triangle in triangles(cloth) {
        for v in triangle {
            around.entry(v).or_default().push(triangle);
        }
    }
    for (v, fan) in around {
        let mut reached = vec![false; fan.len()];
        let mut stack = vec![0];
        while let Some(at) = stack.pop() {
            if std::mem::replace(&mut reached[at], true) {
                continue;
            }
            for other in 0..fan.len() {
                let shared = fan[at].iter().filter(|p| **p != v && fan[other].contains(p)).count();
                if shared > 0 && !reached[other] {
                    stack.push(other);
                }
            }
        }
        assert!(reached.iter().all(|r| *r), "vertex {v} joins two fans at a point: {fan:?}");
    }
}
