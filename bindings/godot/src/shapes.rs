//! Collision shapes of Godot as colliders of Muslin.
//!
//! Reads a `Shape3D` and the placement of its node; writes a `ColliderDesc` whose pose is that of
//! the node times a fixed offset.

use crate::convert::{Placement, to_muslin};
use crate::refusal::{Refusal, Result, check};
use godot::classes::{
    BoxShape3D, CapsuleShape3D, ConcavePolygonShape3D, ConvexPolygonShape3D, CylinderShape3D,
    HeightMapShape3D, Shape3D, SphereShape3D, WorldBoundaryShape3D,
};
use godot::obj::Gd;
use muslin::glam::{Quat, Vec3};
use muslin::{ColliderDesc, Shape};
use std::collections::HashMap;

/// Sides of the prism that stands for a cylinder.
const CYLINDER_SIDES: u16 = 32;

/// A collider in the frame of its node.
pub struct PlacedShape {
    /// Shape and sizes; the pose is not set.
    pub desc: ColliderDesc,
    /// Position in the rigid frame of the node [m].
    pub offset: Vec3,
    /// Rotation in the rigid frame of the node.
    pub turn: Quat,
}

impl PlacedShape {
    /// Converts a shape, scaled by the placement of its node.
    ///
    /// # Errors
    /// Names the kind of shape and what about it or its scale cannot be simulated.
    pub fn new(shape: &Gd<Shape3D>, placement: &Placement) -> Result<Self> {
        let desc = ColliderDesc::default();
        if let Ok(sphere) = shape.clone().try_cast::<SphereShape3D>() {
            let radius = sphere.get_radius() * uniform(placement, "a sphere")?;
            return Ok(Self::centred(ColliderDesc { shape: Shape::Sphere, radius, ..desc }));
        }
        if let Ok(capsule) = shape.clone().try_cast::<CapsuleShape3D>() {
            let scale = uniform(placement, "a capsule")?;
            let radius = capsule.get_radius() * scale;
            let half_height = (0.5 * capsule.get_height() * scale - radius).max(0.0);
            let shape = Shape::Capsule;
            return Ok(Self::centred(ColliderDesc { shape, radius, half_height, ..desc }));
        }
        if let Ok(cuboid) = shape.clone().try_cast::<BoxShape3D>() {
            let half = 0.5 * to_muslin(cuboid.get_size());
            if let Some(scale) = placement.scale() {
                let (shape, half_extents) = (Shape::Box, half * scale);
                return Ok(Self::centred(ColliderDesc { shape, half_extents, ..desc }));
            }
            let corner = |i: u32| {
                let side = |axis: u32| if i >> axis & 1 == 0 { -1.0 } else { 1.0 };
                half * Vec3::new(side(0), side(1), side(2))
            };
            return Ok(Self::hull((0..8).map(corner), placement));
        }
        if let Ok(cylinder) = shape.clone().try_cast::<CylinderShape3D>() {
            let (radius, half) = (cylinder.get_radius(), 0.5 * cylinder.get_height());
            let corners = (0..CYLINDER_SIDES).flat_map(|i| {
                let angle = f32::from(i) * core::f32::consts::TAU / f32::from(CYLINDER_SIDES);
                let (z, x) = angle.sin_cos();
                [half, -half].map(|y| Vec3::new(radius * x, y, radius * z))
            });
            return Ok(Self::hull(corners, placement));
        }
        if let Ok(plane) = shape.clone().try_cast::<WorldBoundaryShape3D>() {
            let plane = plane.get_plane();
            return Self::plane(to_muslin(plane.normal), plane.d, placement);
        }
        if let Ok(convex) = shape.clone().try_cast::<ConvexPolygonShape3D>() {
            let points = convex.get_points();
            return Ok(Self::hull(points.as_slice().iter().map(|p| to_muslin(*p)), placement));
        }
        if let Ok(concave) = shape.clone().try_cast::<ConcavePolygonShape3D>() {
            let faces = concave.get_faces();
            return Ok(Self::mesh(faces.as_slice().iter().map(|p| to_muslin(*p)), placement));
        }
        if let Ok(map) = shape.clone().try_cast::<HeightMapShape3D>() {
            return Self::height_map(&map, placement);
        }
        Err(Refusal::new(format!("`shape` must not be a {}", shape.get_class())))
    }

    fn centred(desc: ColliderDesc) -> Self {
        Self { desc, offset: Vec3::ZERO, turn: Quat::IDENTITY }
    }

    fn hull(points: impl Iterator<Item = Vec3>, placement: &Placement) -> Self {
        let positions = points.map(|p| placement.map(p)).collect();
        let shape = Shape::Convex;
        Self::centred(ColliderDesc { shape, positions, ..ColliderDesc::default() })
    }

    /// Triangles, whose equal corners become one vertex.
    fn mesh(corners: impl Iterator<Item = Vec3>, placement: &Placement) -> Self {
        let mut vertices = HashMap::new();
        let (mut positions, mut indices) = (Vec::new(), Vec::new());
        for corner in corners {
            let key = corner.to_array().map(f32::to_bits);
            indices.push(*vertices.entry(key).or_insert_with(|| {
                positions.push(placement.map(corner));
                positions.len() as u32 - 1
            }));
        }
        let shape = Shape::Mesh;
        Self::centred(ColliderDesc { shape, positions, indices, ..ColliderDesc::default() })
    }

    /// A half-space below the plane of points with `dot(normal, point) == distance`.
    fn plane(normal: Vec3, distance: f32, placement: &Placement) -> Result<Self> {
        let is_normal = normal.is_finite() && normal.length() > 1.0e-6;
        check(is_normal, "shape.plane.normal", "be finite and not zero")?;
        let unit = normal.normalize();
        let offset = placement.map(unit * distance);
        // Two directions in the plane stay in it, whatever the scale.
        let (a, b) = unit.any_orthonormal_pair();
        let mapped = placement.map(a).cross(placement.map(b));
        let mapped = if mapped.dot(placement.map(unit)) < 0.0 { -mapped } else { mapped };
        let turn = Quat::from_rotation_arc(Vec3::Y, mapped.normalize());
        Ok(Self { desc: ColliderDesc::default(), offset, turn })
    }

    fn height_map(map: &Gd<HeightMapShape3D>, placement: &Placement) -> Result<Self> {
        let (columns, rows) = (map.get_map_width() as u32, map.get_map_depth() as u32);
        let rule = "be scaled equally along x and z for a height map, and not mirrored";
        let scale =
            placement.scale().ok_or_else(|| Refusal::new(format!("`transform` must {rule}")))?;
        let is_square = (scale.x - scale.z).abs() <= 1.0e-3 * scale.x;
        let [x, y, z] = placement.linear;
        let is_mirrored = x.x.min(y.y).min(z.z) < 0.0;
        check(is_square && !is_mirrored, "transform", rule)?;
        let spacing = scale.x;
        let heights = map.get_map_data().as_slice().iter().map(|h| h * scale.y).collect();
        let half = |count: u32| -0.5 * spacing * count.saturating_sub(1) as f32;
        let offset = Vec3::new(half(columns), 0.0, half(rows));
        let shape = Shape::Heightfield;
        let desc =
            ColliderDesc { shape, columns, rows, spacing, heights, ..ColliderDesc::default() };
        Ok(Self { desc, offset, turn: Quat::IDENTITY })
    }

    /// Returns the pose of the collider while its node is at `placement`.
    pub fn pose(offset: Vec3, turn: Quat, placement: &Placement) -> (Vec3, Quat) {
        let rotation = (placement.rotation * turn).normalize();
        (placement.position + placement.rotation * offset, rotation)
    }
}

fn uniform(placement: &Placement, what: &str) -> Result<f32> {
    let must = format!("`transform` must be scaled equally along all axes for {what}");
    placement.uniform_scale().ok_or_else(|| Refusal::new(must))
}
