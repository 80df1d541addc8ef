//! Bodies and meshes that several scenes use.

use muslin::glam::Vec3;
use muslin::{ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision, Shape};
use std::f32::consts::{PI, TAU};

/// A plane at this height [m].
pub fn floor(height: f32) -> ColliderDesc {
    ColliderDesc { position: Vec3::Y * height, ..ColliderDesc::default() }
}

pub fn sphere(radius: f32, position: Vec3) -> ColliderDesc {
    ColliderDesc { shape: Shape::Sphere, radius, position, ..ColliderDesc::default() }
}

/// A capsule along y.
pub fn capsule(radius: f32, half_height: f32, position: Vec3) -> ColliderDesc {
    ColliderDesc { shape: Shape::Capsule, radius, half_height, position, ..ColliderDesc::default() }
}

pub fn cuboid(half_extents: Vec3, position: Vec3) -> ColliderDesc {
    ColliderDesc { shape: Shape::Box, half_extents, position, ..ColliderDesc::default() }
}

/// A box as a closed mesh, with `cells` × `cells` squares on each face.
pub fn box_mesh(half_extents: Vec3, cells: u32) -> ColliderDesc {
    let mut mesh = Welded::default();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let at = |i: u32, j: u32| {
                let on = |k: u32| 2.0 * k as f32 / cells as f32 - 1.0;
                let mut p = Vec3::ZERO;
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, on(i), on(j));
                p * half_extents
            };
            for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
                let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                let faces =
                    if side > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
                faces.into_iter().for_each(|face| mesh.push(face));
            }
        }
    }
    mesh.into_collider()
}

/// A closed body around the origin: rings from pole to pole, `radius(up, around)` times the
/// direction, with `up` from −1 to 1 and `around` in radians.
pub fn round_mesh(rings: u32, around: u32, radius: impl Fn(f32, f32) -> Vec3) -> ColliderDesc {
    let at = |ring: u32, k: u32| {
        let angle = (k % around) as f32 / around as f32 * TAU;
        let (sine, cosine) = (ring as f32 / rings as f32 * PI).sin_cos();
        let sine = if ring == 0 || ring == rings { 0.0 } else { sine };
        radius(cosine, angle) * Vec3::new(sine * angle.cos(), cosine, sine * angle.sin())
    };
    let mut mesh = Welded::default();
    for (ring, k) in (0..rings).flat_map(|ring| (0..around).map(move |k| (ring, k))) {
        let (a, b) = (at(ring, k), at(ring, k + 1));
        let (c, d) = (at(ring + 1, k), at(ring + 1, k + 1));
        if ring > 0 {
            mesh.push([a, b, c]);
        }
        if ring + 1 < rings {
            mesh.push([b, d, c]);
        }
    }
    mesh.into_collider()
}

/// A lumpy body of about 6,900 vertices, 0.3 m wide.
pub fn lumpy_mesh() -> ColliderDesc {
    round_mesh(58, 120, |up, around| {
        Vec3::splat(0.3 + 0.03 * (5.0 * around).sin() * (1.0 - up * up) + 0.04 * (6.0 * up).cos())
    })
}

/// A lumpy ball of 10,000 vertices with two ears, 0.25 m high, between which it is concave.
pub fn head_with_ears() -> ColliderDesc {
    let ears = [-1.0, 1.0].map(|side| Vec3::new(0.5 * side, 0.85, 0.1).normalize());
    round_mesh(83, 122, |up, around| {
        let level = (1.0 - up * up).max(0.0).sqrt();
        let direction = Vec3::new(level * around.cos(), up, level * around.sin());
        let ear = |ear: Vec3| (-40.0 * (1.0 - direction.dot(ear))).exp();
        let lumps = 0.02 * (7.0 * around).sin() * level + 0.02 * (9.0 * up).cos();
        Vec3::splat(0.2 + lumps + 0.25 * ears.map(ear).into_iter().sum::<f32>())
    })
}

/// Triangles whose equal corners share a vertex.
#[derive(Default)]
struct Welded {
    positions: Vec<Vec3>,
    indices: Vec<u32>,
    known: std::collections::HashMap<[u32; 3], u32>,
}

impl Welded {
    fn push(&mut self, corners: [Vec3; 3]) {
        for p in corners {
            // Adding zero makes −0 and 0 one key.
            let key = (p + Vec3::ZERO).to_array().map(f32::to_bits);
            let next = self.positions.len() as u32;
            let index = *self.known.entry(key).or_insert(next);
            if index == next {
                self.positions.push(p);
            }
            self.indices.push(index);
        }
    }

    fn into_collider(self) -> ColliderDesc {
        let Self { positions, indices, .. } = self;
        ColliderDesc { shape: Shape::Mesh, positions, indices, ..ColliderDesc::default() }
    }
}

/// A square sheet of `side` × `side` particles and `width` [m] in the x–y plane, around the origin,
/// without pins.
pub fn upright_sheet(side: u32, width: f32) -> GridDesc {
    GridDesc {
        columns: side,
        rows: side,
        spacing: width / (side - 1) as f32,
        origin: Vec3::new(-0.5 * width, 0.5 * width, 0.0),
        pin_mode: PinMode::None,
        ..GridDesc::default()
    }
}

/// A level square sheet at a height [m], around the y axis, without pins.
pub fn level_sheet(side: u32, width: f32, height: f32) -> GridDesc {
    GridDesc {
        origin: Vec3::new(-0.5 * width, height, -0.5 * width),
        down: Vec3::Z,
        ..upright_sheet(side, width)
    }
}

/// The same sheet, whose surface collides with itself.
pub fn with_surface(mut desc: GridDesc) -> GridDesc {
    desc.settings.self_collision = SelfCollision::Surface;
    desc
}

/// The same sheet with a bound of stretch.
pub fn with_bound(mut desc: GridDesc, max_stretch: f32) -> GridDesc {
    desc.settings.max_stretch = max_stretch;
    desc
}

/// The same sheet without damping and air, so that only gravity and bodies change its momentum.
pub fn without_losses(mut desc: GridDesc) -> GridDesc {
    desc.settings.damping = 0.0;
    (desc.material.drag, desc.material.lift) = (0.0, 0.0);
    desc
}

/// Adds a grid of `columns` × `rows` vertices to a mesh.
pub fn push_patch(desc: &mut MeshDesc, columns: u32, rows: u32, at: impl Fn(u32, u32) -> Vec3) {
    let first = desc.positions.len() as u32;
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        desc.positions.push(at(column, row));
    }
    for (row, column) in
        (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| (row, column)))
    {
        let a = first + row * columns + column;
        let (b, c, d) = (a + 1, a + columns, a + columns + 1);
        let is_falling = (row + column).is_multiple_of(2);
        desc.indices.extend(if is_falling { [a, c, d, a, d, b] } else { [a, c, b, c, d, b] });
    }
}

/// A tube about the y axis that hangs from its first ring: `around` vertices per ring.
pub fn tube(around: u32, rings: u32, ring: impl Fn(u32) -> (f32, f32)) -> MeshDesc {
    let mut desc = MeshDesc::default();
    for (row, k) in (0..rings).flat_map(|row| (0..around).map(move |k| (row, k))) {
        let (radius, height) = ring(row);
        let (sine, cosine) = (k as f32 / around as f32 * TAU).sin_cos();
        desc.positions.push(Vec3::new(radius * cosine, height, radius * sine));
    }
    for (row, k) in (0..rings - 1).flat_map(|row| (0..around).map(move |k| (row, k))) {
        let (a, b) = (row * around + k, row * around + (k + 1) % around);
        let (c, d) = (a + around, b + around);
        let is_falling = (row + k).is_multiple_of(2);
        desc.indices.extend(if is_falling { [a, d, c, a, b, d] } else { [a, b, c, b, d, c] });
    }
    desc
}
