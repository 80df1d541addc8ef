//! Colliders: shapes that the cloth collides with.

use super::value::{MuslinQuat, MuslinVec3};
use crate::ffi::pointers::{read_u32s, read_vec3s};
use crate::status::{CallError, Result};
use core::ptr;
use muslin_core::{ColliderDesc, Shape};

/// Half-space below `position` along the rotated y axis; infinite in extent.
pub const MUSLIN_SHAPE_PLANE: u32 = 0;
/// Sphere of `radius` around `position`.
pub const MUSLIN_SHAPE_SPHERE: u32 = 1;
/// Capsule along the rotated y axis: spheres of `radius` at -`half_height` and of `top_radius` at
/// +`half_height`, and all between them (a tapered capsule if the radii differ).
pub const MUSLIN_SHAPE_CAPSULE: u32 = 2;
/// Box that extends by `half_extents` to either side of `position` along each rotated axis.
pub const MUSLIN_SHAPE_BOX: u32 = 3;
/// Convex hull of `positions`.
pub const MUSLIN_SHAPE_CONVEX: u32 = 4;
/// Triangle mesh: the triangles of `indices` over `positions`.
///
/// The cloth stays on the side where it is: both sides are outside. So the mesh need not be closed
/// or consistently wound. With `solid` a closed mesh pushes out what is inside. The gap is at least
/// 0.1 mm.
pub const MUSLIN_SHAPE_MESH: u32 = 5;
/// Terrain: all below a surface over a grid of `columns` * `rows` heights.
///
/// The heights are `spacing` apart along the rotated x and z axes, starting at `position`. The
/// terrain is as deep as it is wide, and has no side walls.
pub const MUSLIN_SHAPE_HEIGHTFIELD: u32 = 6;

/// Descriptor of a collider: shape, pose and surface properties. Initialise it with
/// muslin_collider_desc_init, which describes a floor at height 0.
///
/// Fields that the shape does not use are ignored. All lists are copied when the collider is added.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinColliderDesc {
    /// Set by muslin_collider_desc_init.
    pub struct_size: u32,
    /// Shape: one of MUSLIN_SHAPE_.... Default MUSLIN_SHAPE_PLANE.
    pub shape: u32,
    /// Position [m]; for a plane, a point on its surface. Default 0, 0, 0.
    pub position: MuslinVec3,
    /// Rotation, a unit quaternion; a plane's normal is the rotated y axis. Default: none.
    pub rotation: MuslinQuat,
    /// Coulomb friction coefficient. Default -1: that of the material. Otherwise at least 0.
    pub friction: f32,
    /// Share of the normal velocity that a bounce returns. Default -1: that of the material.
    /// Otherwise from 0 to 1.
    pub restitution: f32,
    /// Share of the tangential velocity that remains after each substep in contact, in addition to
    /// Coulomb friction. Default 1 (all of it). From 0 to 1.
    pub tangential_restitution: f32,
    /// Gap between cloth and surface [m]. Default -1: the material's thickness. Otherwise at least
    /// 0.
    ///
    /// On surfaces that are round or slightly curved, particles keep a larger gap, so that the
    /// triangles between them do not sink in: up to 1/5 of the mean edge for spheres and capsules,
    /// 1/10 for other shapes.
    pub thickness: f32,
    /// Radius of a sphere or capsule [m]. Default 0.5. Above 0.
    pub radius: f32,
    /// Radius of the upper end of a capsule [m]. Default -1: `radius`. Otherwise above 0.
    pub top_radius: f32,
    /// Capsule: distance from its centre to the centres of its ends [m]. Default 0.5. At least 0.
    pub half_height: f32,
    /// Box: distance from its centre to its sides [m]. Default 0.5 each. Above 0.
    pub half_extents: MuslinVec3,
    /// Heightfield: distance between neighbouring heights [m]. Default 1. Above 0.
    pub spacing: f32,
    /// Heightfield: number of heights along x. Default 0. From 2 to 4096.
    pub columns: u32,
    /// Heightfield: number of heights along z. Default 0. From 2 to 4096.
    pub rows: u32,
    /// Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
    /// multiple of 4.
    pub position_stride: u32,
    /// Number of positions. Default 0. From 4 to 1024 for a convex hull, at most 4194304 for a
    /// mesh.
    pub vertex_count: u32,
    /// Number of indices. Default 0. A multiple of 3, at most 50331648.
    pub index_count: u32,
    /// Convex hull or mesh: points [m], 3 numbers each.
    pub positions: *const f32,
    /// Mesh: 3 points per triangle. Triangles without an area are ignored.
    pub indices: *const u32,
    /// Heightfield: `columns` * `rows` heights [m], row by row along x.
    pub heights: *const f32,
    /// Mesh: largest depth from which particles inside are pushed out [m]. Default 0: both sides of its
    /// triangles are outside. At least 0 and below 1e6.
    ///
    /// Above 0 the mesh must be closed and consistently wound: every edge in two triangles, once in
    /// each direction. Normals may point inward or outward. Particles move towards the closest point of
    /// the surface at 0.05 m/s. Each tick makes one closest-point query per particle in the bounds of
    /// the mesh.
    pub solid: f32,
    /// Not used. Default 0.
    pub reserved: u32,
}

impl Default for MuslinColliderDesc {
    fn default() -> Self {
        let desc = ColliderDesc::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            shape: desc.shape as u32,
            position: desc.position.into(),
            rotation: desc.rotation.into(),
            friction: desc.friction,
            restitution: desc.restitution,
            tangential_restitution: desc.tangential_restitution,
            thickness: desc.thickness,
            radius: desc.radius,
            top_radius: desc.top_radius,
            half_height: desc.half_height,
            half_extents: desc.half_extents.into(),
            spacing: desc.spacing,
            columns: desc.columns,
            rows: desc.rows,
            position_stride: 0,
            vertex_count: 0,
            index_count: 0,
            positions: ptr::null(),
            indices: ptr::null(),
            heights: ptr::null(),
            solid: desc.solid,
            reserved: 0,
        }
    }
}

/// Larger counts are refused before a list is read; the limits of cloth meshes.
const MAX_VERTICES: u32 = 1 << 22;
const MAX_INDICES: u32 = 12 * MAX_VERTICES;
/// Larger counts are refused before the list is read; the limit of the core.
const MAX_HEIGHTS: u32 = 4096;

impl MuslinColliderDesc {
    /// Copies the lists that the shape uses out of the caller's memory.
    ///
    /// # Safety
    /// Every list is NULL or as long as its counts say.
    pub unsafe fn read(&self) -> Result<ColliderDesc> {
        let shape = Shape::from_number(self.shape)?;
        let mut desc = ColliderDesc {
            shape,
            position: self.position.into(),
            rotation: self.rotation.into(),
            friction: self.friction,
            restitution: self.restitution,
            tangential_restitution: self.tangential_restitution,
            thickness: self.thickness,
            radius: self.radius,
            top_radius: self.top_radius,
            half_height: self.half_height,
            half_extents: self.half_extents.into(),
            spacing: self.spacing,
            columns: self.columns,
            rows: self.rows,
            solid: self.solid,
            ..ColliderDesc::default()
        };
        let require = |fits: bool, field: &str, must: &str| {
            if fits { Ok(()) } else { Err(CallError::bad_value(field, must)) }
        };
        if matches!(shape, Shape::Convex | Shape::Mesh) {
            require(self.vertex_count >= 3, "vertex_count", "be at least 3")?;
            require(self.vertex_count <= MAX_VERTICES, "vertex_count", "be at most 4194304")?;
            let (stride, count) = (self.position_stride, self.vertex_count);
            // SAFETY: guaranteed by the caller.
            desc.positions =
                unsafe { read_vec3s("positions", self.positions.cast(), stride, count)? };
        }
        if matches!(shape, Shape::Mesh) {
            require(self.index_count > 0, "index_count", "be at least 3")?;
            require(self.index_count <= MAX_INDICES, "index_count", "be at most 50331648")?;
            require(self.index_count.is_multiple_of(3), "index_count", "be a multiple of 3")?;
            // SAFETY: guaranteed by the caller.
            desc.indices = unsafe { read_u32s("indices", self.indices, self.index_count)? };
        }
        if matches!(shape, Shape::Heightfield) {
            let is_allowed = |count: u32| (2..=MAX_HEIGHTS).contains(&count);
            require(is_allowed(self.columns), "columns", "be from 2 to 4096")?;
            require(is_allowed(self.rows), "rows", "be from 2 to 4096")?;
            let count = self.columns * self.rows;
            // SAFETY: guaranteed by the caller; u32 and f32 have the same size.
            let bits = unsafe { read_u32s("heights", self.heights.cast(), count)? };
            desc.heights = bits.into_iter().map(f32::from_bits).collect();
        }
        Ok(desc)
    }
}

const _: () = assert!(
    MUSLIN_SHAPE_PLANE == Shape::Plane as u32
        && MUSLIN_SHAPE_SPHERE == Shape::Sphere as u32
        && MUSLIN_SHAPE_CAPSULE == Shape::Capsule as u32
        && MUSLIN_SHAPE_BOX == Shape::Box as u32
        && MUSLIN_SHAPE_CONVEX == Shape::Convex as u32
        && MUSLIN_SHAPE_MESH == Shape::Mesh as u32
        && MUSLIN_SHAPE_HEIGHTFIELD == Shape::Heightfield as u32
);
