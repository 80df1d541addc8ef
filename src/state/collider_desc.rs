//! Collider descriptors: shape, pose and surface properties as a host gives them.

use crate::error::{Error, Result, check};
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::primitives::{Capsule, Cuboid, HalfSpace, Sphere};
use crate::math::hasher::StateHasher;
use crate::state::pose::{COLLIDER_FIELDS, check_pose};
use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};

/// Shape of a collider, in a local frame that `position` and `rotation` place in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
#[non_exhaustive]
pub enum Shape {
    /// Half-space below `position`, bounded by the local xz plane. The normal is the local y axis.
    #[default]
    Plane = 0,
    /// Sphere of `radius` about `position`.
    Sphere = 1,
    /// Convex hull of two spheres: of `radius` at −`half_height` and of `top_radius` at
    /// +`half_height` on the local y axis.
    Capsule = 2,
    /// Box that extends `half_extents` from `position` along each local axis, in both directions.
    Box = 3,
    /// Convex hull of `positions`. A soft sheet that hangs over its corners does not come fully to
    /// rest; it keeps moving by some mm/s.
    Convex = 4,
    /// Triangles `indices` over `positions`. Both sides of a triangle are outside and cloth stays
    /// on the side where it is, so the mesh need be neither closed nor consistently wound; with
    /// `solid` a closed one pushes out what is inside. Its minimum gap is 0.1 mm.
    Mesh = 5,
    /// Terrain: `columns` × `rows` heights at `spacing` along the local x and z axes, starting at
    /// `position`. It is solid below the surface, as deep as it is wide, and has no side walls.
    Heightfield = 6,
}

impl Shape {
    /// Returns the shape with this number in the C API.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for an unknown number.
    pub fn from_number(number: u32) -> Result<Self> {
        match number {
            0 => Ok(Self::Plane),
            1 => Ok(Self::Sphere),
            2 => Ok(Self::Capsule),
            3 => Ok(Self::Box),
            4 => Ok(Self::Convex),
            5 => Ok(Self::Mesh),
            6 => Ok(Self::Heightfield),
            _ => Err(Error::Unsupported { what: "a collider of this shape" }),
        }
    }
}

/// Descriptor of a collider. Fields that its shape does not use are ignored.
///
/// Sizes and points are in the local frame and below 1e6 m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ColliderDesc {
    /// Kind of shape. Default: plane.
    pub shape: Shape,
    /// Position in the world [m]; for a plane, a point of its surface. Default: the origin.
    pub position: Vec3,
    /// Rotation from the local frame to the world, a unit quaternion. Default: identity.
    pub rotation: Quat,
    /// Sphere, capsule: radius [m], above 0. Default: 0.5.
    pub radius: f32,
    /// Capsule: radius of the upper end [m], above 0; −1 = same as `radius`. Default: −1.
    pub top_radius: f32,
    /// Capsule: distance from its centre to the centre of each end [m], at least 0. Default: 0.5.
    pub half_height: f32,
    /// Box: half of its size along each axis [m], above 0. Default: 0.5 each.
    pub half_extents: Vec3,
    /// Convex, mesh: points [m]; 4 to 1024 for a convex hull. Default: none.
    pub positions: Vec<Vec3>,
    /// Mesh: three indices into `positions` per triangle. Triangles without area are ignored.
    /// Default: none.
    pub indices: Vec<u32>,
    /// Heightfield: number of heights along x, 2 to 4096. Default: 0.
    pub columns: u32,
    /// Heightfield: number of heights along z, 2 to 4096. Default: 0.
    pub rows: u32,
    /// Heightfield: distance between neighbouring heights [m], above 0. Default: 1.
    pub spacing: f32,
    /// Heightfield: `columns` × `rows` heights [m], row by row along x. Default: none.
    pub heights: Vec<f32>,
    /// Mesh: largest depth from which particles inside are pushed out [m], at least 0 and below 1e6; 0 =
    /// both sides of its triangles are outside. Above 0 the mesh must be closed and consistently wound:
    /// every edge in two triangles, once in each direction. Normals may point inward or outward.
    /// Particles move towards the closest point of the surface at 0.05 m/s. Each tick makes one
    /// closest-point query per particle in the bounds of the mesh. Default: 0.
    pub solid: f32,
    /// Gap between surface and particles [m], at least 0; −1 = thickness of the material. Default:
    /// −1.
    ///
    /// On curved surfaces particles keep a larger gap, so that the triangles between them do not
    /// penetrate: at most a fifth of the mean edge length more on spheres and capsules, a tenth on
    /// other shapes.
    pub thickness: f32,
    /// Coefficient of Coulomb friction, at least 0; −1 = that of the material. Default: −1.
    pub friction: f32,
    /// Share of the normal speed that remains after a bounce, 0 to 1; −1 = that of the material.
    /// Default: −1.
    pub restitution: f32,
    /// Share of the sliding speed that remains after each substep in contact, in addition to
    /// Coulomb friction, 0 to 1. Default: 1, no loss. The receipt demo's floor uses 0.8 with
    /// `friction` 0 and `restitution` 0.2.
    pub tangential_restitution: f32,
}

impl Default for ColliderDesc {
    fn default() -> Self {
        Self {
            shape: Shape::Plane,
            position: Vec3::ZERO,
            rotation: Quat::IDENTITY,
            radius: 0.5,
            top_radius: -1.0,
            half_height: 0.5,
            half_extents: Vec3::splat(0.5),
            positions: Vec::new(),
            indices: Vec::new(),
            columns: 0,
            rows: 0,
            spacing: 1.0,
            heights: Vec::new(),
            solid: 0.0,
            thickness: -1.0,
            friction: -1.0,
            restitution: -1.0,
            tangential_restitution: 1.0,
        }
    }
}

/// Bound of all sizes and coordinates within a shape [m], so that their squares are exact enough in
/// f32.
pub(super) const MAX_COORDINATE: f32 = 1.0e6;

pub(super) fn is_near(x: &Vec3) -> bool {
    x.to_array().iter().all(|c| c.abs() < MAX_COORDINATE)
}

/// Returns [`Error::BadEntry`] for the first of the `count` points of the list `field` that is too
/// far from zero or not finite.
pub(crate) fn check_coordinates(
    count: usize,
    point: &dyn Fn(usize) -> Vec3,
    field: &'static str,
) -> Result<()> {
    let must = "be between -1e6 and 1e6";
    match (0..count).position(|i| !is_near(&point(i))) {
        None => Ok(()),
        Some(index) => Err(Error::BadEntry { field, index: index as u32, must }),
    }
}

pub(super) fn is_size(v: f32) -> bool {
    v > 0.0 && v < MAX_COORDINATE
}

impl ColliderDesc {
    /// Validates the descriptor, except for defects that only building the shape detects.
    pub(crate) fn check(&self) -> Result<()> {
        check_pose(self.position, self.rotation, COLLIDER_FIELDS)?;
        self.check_shape()?;
        let size = "be at least 0 and finite, or -1";
        let not_negative = |v: f32| v == -1.0 || (v.is_finite() && v >= 0.0);
        check(not_negative(self.thickness), "collider.thickness", size)?;
        check(not_negative(self.friction), "collider.friction", size)?;
        let share = |v: f32| (0.0..=1.0).contains(&v);
        check(
            self.restitution == -1.0 || share(self.restitution),
            "collider.restitution",
            "be from 0 to 1, or -1",
        )?;
        check(
            share(self.tangential_restitution),
            "collider.tangential_restitution",
            "be from 0 to 1",
        )
    }

    fn check_shape(&self) -> Result<()> {
        let size = "be above 0 and below 1e6";
        match self.shape {
            Shape::Plane => Ok(()),
            Shape::Sphere => check(is_size(self.radius), "collider.radius", size),
            Shape::Capsule => {
                check(is_size(self.radius), "collider.radius", size)?;
                check(
                    self.top_radius == -1.0 || is_size(self.top_radius),
                    "collider.top_radius",
                    "be above 0 and below 1e6, or -1",
                )?;
                check(
                    self.half_height == 0.0 || is_size(self.half_height),
                    "collider.half_height",
                    "be at least 0 and below 1e6",
                )
            }
            Shape::Box => {
                let half = self.half_extents.to_array();
                check(half.into_iter().all(is_size), "collider.half_extents", size)
            }
            Shape::Convex | Shape::Mesh | Shape::Heightfield => self.check_facets(),
        }
    }

    /// Builds the collision shape of a checked descriptor, relative to `shape_center`.
    ///
    /// # Errors
    /// `BadValue` if the points of a convex hull lie in one plane, or no triangle of a mesh has an
    /// area.
    pub(crate) fn collision_shape(&self) -> Result<CollisionShape> {
        Ok(match self.shape {
            Shape::Plane => CollisionShape::HalfSpace(HalfSpace),
            Shape::Sphere => CollisionShape::Sphere(Sphere { radius: self.radius }),
            Shape::Capsule => {
                let top = if self.top_radius < 0.0 { self.radius } else { self.top_radius };
                CollisionShape::Capsule(Capsule::new(self.half_height, self.radius, top))
            }
            Shape::Box => {
                let cuboid = Cuboid { half_extents: self.half_extents };
                CollisionShape::Cuboid(cuboid, cuboid.features())
            }
            Shape::Convex | Shape::Mesh | Shape::Heightfield => return self.facet_shape(),
        })
    }

    /// Adds every field that affects contacts to a hash, except for the pose.
    pub(crate) fn hash(&self, hasher: &mut StateHasher) {
        hasher.write_u32s(&[self.shape as u32, self.columns, self.rows]);
        hasher.write_f32s(&[self.radius, self.top_radius, self.half_height, self.spacing]);
        hasher.write_f32s(&self.half_extents.to_array());
        hasher.write_f32s(&[self.thickness, self.friction, self.restitution]);
        hasher.write_f32s(&[self.tangential_restitution]);
        if self.solid > 0.0 {
            hasher.write_f32s(&[self.solid]);
        }
        self.positions.iter().for_each(|x| hasher.write_f32s(&x.to_array()));
        hasher.write_u32s(&self.indices);
        hasher.write_f32s(&self.heights);
    }
}
