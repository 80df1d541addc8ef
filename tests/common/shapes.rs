//! Collider descriptors, and signed distances to them computed independently of the library.
#![allow(dead_code)]

use super::{bare_grid, rms_speed};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Shape};
use std::f32::consts::TAU;

/// An unpinned, horizontal, square sheet, centred over the origin at `height` [m].
pub fn free_sheet(nodes: u32, width: f32, height: f32) -> GridDesc {
    let spacing = width / (nodes - 1) as f32;
    let mut desc = bare_grid(nodes, nodes, spacing, PinMode::None);
    desc.down = Vec3::Z;
    desc.origin = Vec3::new(-0.5 * width, height, -0.5 * width);
    // Some damping, as air and internal friction give real fabric.
    desc.settings.damping = 0.5;
    desc
}

/// Signed distance of the world-space point `x` from a posed shape [m]; negative inside. Far away from a
/// hull or mesh it is a lower bound, which takes less time to compute.
pub fn signed_distance(desc: &ColliderDesc, x: Vec3) -> f32 {
    let p = desc.rotation.inverse() * (x - desc.position);
    let reach = desc.positions.iter().map(|corner| corner.length()).fold(0.0, f32::max);
    if reach > 0.0 && p.length() > 1.5 * reach {
        return p.length() - reach;
    }
    match desc.shape {
        Shape::Plane => p.y,
        Shape::Sphere => p.length() - desc.radius,
        Shape::Capsule => {
            let top = if desc.top_radius < 0.0 { desc.radius } else { desc.top_radius };
            capsule_distance(desc.half_height, [desc.radius, top], p)
        }
        Shape::Box => {
            let q = p.abs() - desc.half_extents;
            q.max(Vec3::ZERO).length() + q.max_element().min(0.0)
        }
        Shape::Convex => hull_distance(&desc.positions, p),
        Shape::Mesh => mesh_distance(desc, p),
        Shape::Heightfield => heightfield_distance(desc, p),
        other => panic!("no distance from {other:?}"),
    }
}

/// Least signed distance of any vertex and of any sampled triangle point [m]; positive is outside.
pub fn vertex_and_face_clearance(cloth: &Cloth, desc: &ColliderDesc) -> (f32, f32) {
    let x = cloth.positions();
    let vertices = x.iter().map(|x| signed_distance(desc, *x)).fold(f32::INFINITY, f32::min);
    let mut faces = vertices;
    for t in cloth.indices().chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(|i| x[i as usize]);
        if signed_distance(desc, (a + b + c) / 3.0) > (b - a).length().max((c - a).length()) {
            continue;
        }
        for i in 0..=8 {
            for j in 0..=8 - i {
                let (v, w) = (i as f32 / 8.0, j as f32 / 8.0);
                faces = faces.min(signed_distance(desc, a + (b - a) * v + (c - a) * w));
            }
        }
    }
    (vertices, faces)
}

/// Steps until the RMS speed was below 1 mm/s for 120 ticks in a row, and returns the number of
/// ticks; panics after `most` ticks.
pub fn ticks_until_rest(cloth: &mut Cloth, most: u32) -> u32 {
    let mut calm = 0;
    for tick in 1..=most {
        cloth.step(1);
        calm = if rms_speed(cloth) < 1.0e-3 { calm + 1 } else { 0 };
        if calm == 120 {
            return tick;
        }
    }
    panic!("after {most} ticks it still moves at {} m/s", rms_speed(cloth));
}

/// Runs ten seconds at rest and returns the largest RMS speed [m/s] and the largest drift of any
/// particle [m].
pub fn speed_and_drift_at_rest(cloth: &mut Cloth) -> (f32, f32) {
    let start = cloth.positions().to_vec();
    let mut most = 0.0_f32;
    for _ in 0..600 {
        cloth.step(1);
        most = most.max(rms_speed(cloth));
    }
    let drift = cloth.positions().iter().zip(start).map(|(now, then)| (*now - then).length());
    (most, drift.fold(0.0, f32::max))
}

/// Signed distance of `p` from a tapered capsule [m]: the union of balls with centres on the y axis,
/// whose radius changes linearly with the height of the centre. The nearest ball is the one where the
/// derivative of the distance by that height is zero, or the one at an end.
fn capsule_distance(half_height: f32, [bottom, top]: [f32; 2], p: Vec3) -> f32 {
    let from_axis = p.x.hypot(p.z);
    let slope = if half_height > 0.0 { (top - bottom) / (2.0 * half_height) } else { 0.0 };
    // If the radius changes faster than the height, the largest ball contains all others.
    let shift = if slope.abs() < 1.0 {
        slope * from_axis / (1.0 - slope * slope).sqrt()
    } else {
        slope * f32::INFINITY
    };
    let center = (p.y + shift).clamp(-half_height, half_height);
    from_axis.hypot(p.y - center) - (bottom + slope * (center + half_height))
}

/// Signed distance from the convex hull of `points`: the largest distance over all supporting
/// planes through three points.
fn hull_distance(points: &[Vec3], p: Vec3) -> f32 {
    let mut most = f32::NEG_INFINITY;
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().skip(i + 1) {
            for c in points.iter().skip(j + 1) {
                let normal = (*b - *a).cross(*c - *a).normalize();
                for normal in [normal, -normal] {
                    if points.iter().all(|x| (*x - *a).dot(normal) < 1.0e-5) {
                        most = most.max((p - *a).dot(normal));
                    }
                }
            }
        }
    }
    most
}

/// Signed distance from a closed mesh that is star-shaped around the origin: the distance from the
/// plane of the triangle that the ray from the origin through `p` hits.
fn mesh_distance(desc: &ColliderDesc, p: Vec3) -> f32 {
    let mut found = f32::INFINITY;
    for t in desc.indices.chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(|i| desc.positions[i as usize]);
        let is_within = |u: Vec3, v: Vec3, w: Vec3| {
            let n = u.cross(v);
            n.dot(p) * n.dot(w) >= -1.0e-6 * n.length_squared() * p.length() * w.length()
        };
        let normal = (b - a).cross(c - a).normalize();
        let normal = if normal.dot(a) > 0.0 { normal } else { -normal };
        if normal.dot(p) > 0.0 && is_within(a, b, c) && is_within(b, c, a) && is_within(c, a, b) {
            found = found.min((p - a).dot(normal));
        }
    }
    found
}

/// Vertical distance from a heightfield whose cells are split from first to last corner.
fn heightfield_distance(desc: &ColliderDesc, p: Vec3) -> f32 {
    let at = |c: u32, r: u32| desc.heights[(r * desc.columns + c) as usize];
    let (x, z) = (p.x / desc.spacing, p.z / desc.spacing);
    let is_over = |x: f32, count: u32| x >= 0.0 && x <= (count - 1) as f32;
    if !is_over(x, desc.columns) || !is_over(z, desc.rows) {
        return f32::INFINITY;
    }
    let (c, r) = ((x as u32).min(desc.columns - 2), (z as u32).min(desc.rows - 2));
    let (u, v) = (x - c as f32, z - r as f32);
    let (first, last) = (at(c, r), at(c + 1, r + 1));
    let height = if u > v {
        first + u * (at(c + 1, r) - first) + v * (last - at(c + 1, r))
    } else {
        first + v * (at(c, r + 1) - first) + u * (last - at(c, r + 1))
    };
    p.y - height
}

/// A sphere as a triangle mesh, with `rings` rings from pole to pole.
pub fn sphere_mesh(radius: f32, rings: u32) -> ColliderDesc {
    let around = 2 * rings;
    let mut positions = Vec::new();
    for ring in 0..=rings {
        let (sin, cos) = (ring as f32 * std::f32::consts::PI / rings as f32).sin_cos();
        // The sine of π is not exactly 0 in f32; all vertices of the last ring must coincide.
        let sin = if ring == rings { 0.0 } else { sin };
        for k in 0..around {
            let (s, c) = (k as f32 * TAU / around as f32).sin_cos();
            positions.push(Vec3::new(sin * c, cos, sin * s) * radius);
        }
    }
    let mut indices = Vec::new();
    for ring in 0..rings {
        for k in 0..around {
            let (a, b) = (ring * around + k, ring * around + (k + 1) % around);
            indices.extend([a, b, a + around, b, b + around, a + around]);
        }
    }
    ColliderDesc { shape: Shape::Mesh, positions, indices, ..Default::default() }
}

/// A hilly heightfield of `cells` × `cells` cells in a square around the origin.
pub fn hilly_heightfield(cells: u32, width: f32) -> ColliderDesc {
    let count = cells + 1;
    let heights = (0..count * count).map(|i| {
        let (x, z) = ((i % count) as f32 / cells as f32, (i / count) as f32 / cells as f32);
        0.08 * ((x * 13.0).sin() + (z * 11.0 + 1.0).sin())
    });
    ColliderDesc {
        shape: Shape::Heightfield,
        position: Vec3::new(-0.5 * width, 0.0, -0.5 * width),
        columns: count,
        rows: count,
        spacing: width / cells as f32,
        heights: heights.collect(),
        ..Default::default()
    }
}

/// A convex octahedron around the origin.
pub fn octahedron(size: f32) -> ColliderDesc {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let positions = axes.into_iter().flat_map(|axis| [axis * size, -axis * size]).collect();
    ColliderDesc { shape: Shape::Convex, positions, ..Default::default() }
}

/// A tube around the y axis of `around` x `rows` vertices, its lower end first.
pub fn tube(around: u32, rows: u32, radius: f32, [bottom, top]: [f32; 2]) -> (Vec<Vec3>, Vec<u32>) {
    let position = |v: u32| {
        let angle = TAU * (v % around) as f32 / around as f32;
        let y = bottom + (top - bottom) * (v / around) as f32 / (rows - 1) as f32;
        Vec3::new(radius * angle.cos(), y, radius * angle.sin())
    };
    let cell = |v: u32| {
        let (a, b) = (v, v / around * around + (v + 1) % around);
        [a, a + around, b, b, a + around, b + around]
    };
    let indices = (0..around * (rows - 1)).flat_map(cell).collect();
    ((0..around * rows).map(position).collect(), indices)
}

/// Swings the part of a body below y = 0.15 m about a hip, as a leg kicks: the rings of a tube turn,
/// and stay plane and round.
pub fn swung(body: &[Vec3], angle: f32) -> Vec<Vec3> {
    let hip = Vec3::Y * 0.1;
    let turned = |x: &Vec3| {
        let share = ((0.15 - x.y) / 0.3).clamp(0.0, 1.0);
        let share = share * share * (3.0 - 2.0 * share);
        hip + Quat::from_rotation_z(angle * share) * (*x - hip)
    };
    body.iter().map(turned).collect()
}

/// A tube that does not intersect itself: its triangles, and the lowest and highest corner of each.
pub struct Tube(Vec<([Vec3; 3], [Vec3; 2])>);

impl Tube {
    pub fn new(positions: &[Vec3], indices: &[u32]) -> Self {
        let triangles = indices.chunks(3).map(|ids| {
            let corners @ [a, b, c] = [0, 1, 2].map(|k| positions[ids[k] as usize]);
            (corners, [a.min(b).min(c), a.max(b).max(c)])
        });
        Self(triangles.collect())
    }

    /// How deep a point lies in the tube [m], 0 outside: the distance of the nearest point of its
    /// surface, if `x` is behind it.
    ///
    /// The normals of the triangles that share this point count by their angles there (Bærentzen and
    /// Aanæs, "Signed distance computation using the angle weighted pseudonormal", 2005).
    pub fn depth(&self, x: Vec3) -> f32 {
        let at_corners = self.0.iter().map(|([corner, ..], _)| corner.distance_squared(x));
        let mut distance = at_corners.fold(f32::INFINITY, f32::min).sqrt();
        let mut nearest = Vec::new();
        for (corners, [low, high]) in &self.0 {
            let gap2 = (low - x).max(x - high).max(Vec3::ZERO).length_squared();
            // Farther than the nearest so far by more than what counts as tied.
            if gap2 <= (distance + 1.0e-6).powi(2) {
                let (other, side) = distance_and_side(*corners, x);
                distance = distance.min(other);
                nearest.push((other, side));
            }
        }
        let tied = nearest.iter().filter(|(other, _)| *other <= distance + 1.0e-6);
        if tied.map(|(_, side)| side).sum::<f32>() < 0.0 { distance } else { 0.0 }
    }
}

/// Distance of `x` from a triangle [m], and on which side of it `x` is, times the angle of the
/// triangle at the nearest point.
fn distance_and_side([a, b, c]: [Vec3; 3], x: Vec3) -> (f32, f32) {
    let normal = (b - a).cross(c - a).normalize();
    let behind = |p: Vec3, q: Vec3| (q - p).cross(normal).dot(x - p) > 0.0;
    let edges = [[a, b], [b, c], [c, a]];
    if edges.iter().all(|[p, q]| !behind(*p, *q)) {
        let height = normal.dot(x - a);
        return (height.abs(), TAU * height);
    }
    let on_edge = |[p, q]: [Vec3; 2]| {
        let share = (x - p).dot(q - p) / (q - p).length_squared();
        (p + (q - p) * share.clamp(0.0, 1.0), share)
    };
    let each = edges.map(on_edge);
    let at = (0..3).min_by(|i, j| each[*i].0.distance(x).total_cmp(&each[*j].0.distance(x)));
    let at = at.unwrap();
    let (point, share) = each[at];
    let corner = |k: usize| {
        let [p, q] = edges[k % 3];
        let r = edges[(k + 2) % 3][0];
        (q - p).angle_between(r - p)
    };
    let angle = match share {
        share if share <= 0.0 => corner(at),
        share if share >= 1.0 => corner(at + 1),
        _ => 0.5 * TAU,
    };
    (point.distance(x), angle * normal.dot(x - point))
}
