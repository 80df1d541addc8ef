//! What a cloth falls on.

use super::value::{MuslinQuat, MuslinVec3};
use crate::ffi::pointers::{read_u32s, read_vec3s};
use crate::status::{CallError, Result};
use core::ptr;
use muslin_core::{ColliderDesc, Shape};

/// All that is below `position` along the turned y axis.
pub const MUSLIN_SHAPE_PLANE: u32 = 0;
/// A ball of `radius` around `position`.
pub const MUSLIN_SHAPE_SPHERE: u32 = 1;
/// Balls of `radius` and `top_radius` at -`half_height` and +`half_height` along the turned y axis, and all
/// between them.
pub const MUSLIN_SHAPE_CAPSULE: u32 = 2;
/// A box that reaches `half_extents` to either side of `position` along each turned axis.
pub const MUSLIN_SHAPE_BOX: u32 = 3;
/// The least convex body that holds all of `positions`.
pub const MUSLIN_SHAPE_CONVEX: u32 = 4;
/// The triangles that `indices` join of `positions`. Cloth stays on the side where it is: both are outside,
/// and nothing is inside, so that it need not be closed nor wound one way. It keeps a gap of 0.1 mm at
/// least.
pub const MUSLIN_SHAPE_MESH: u32 = 5;
/// Ground: all below a surface over `columns` * `rows` heights, `spacing` apart along the turned x and z axes
/// from `position` on, as deep as it is wide. It has no sides.
pub const MUSLIN_SHAPE_HEIGHTFIELD: u32 = 6;

/// A collider: its shape, where it is and how it feels. Begin with muslin_collider_desc_init: a floor
/// at height 0. Fields that its shape does not use are ignored; all lists are copied while it is added.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinColliderDesc {
    /// Set by muslin_collider_desc_init.
    pub struct_size: u32,
    /// What it is, one of MUSLIN_SHAPE_...; MUSLIN_SHAPE_PLANE.
    pub shape: u32,
    /// Where it is [m]; 0, 0, 0. A point of the surface of a plane.
    pub position: MuslinVec3,
    /// How it is turned; not at all. A plane's normal is the turned y axis.
    pub rotation: MuslinQuat,
    /// Coulomb coefficient; -1, which takes the material's. Else at least 0.
    pub friction: f32,
    /// Share of the normal speed that a bounce gives back; -1, which takes the material's. Else from
    /// 0 to 1.
    pub restitution: f32,
    /// Share of the sliding speed that every substep of touching leaves, beside Coulomb friction; 1,
    /// all of it. From 0 to 1.
    pub tangential_restitution: f32,
    /// Gap kept from its surface [m]; -1, which takes the material's thickness. Else at least 0. Where a surface is
    /// round or bends little, particles stay farther off by what is between them would sink in: at most a fifth
    /// of the mean edge from balls and capsules, a tenth from others.
    pub thickness: f32,
    /// Of a sphere or capsule [m]; 0.5. Above 0.
    pub radius: f32,
    /// Of the upper end of a capsule [m]; -1, which is as `radius`. Else above 0.
    pub top_radius: f32,
    /// Of a capsule: from its middle to the centres of its ends [m]; 0.5. At least 0.
    pub half_height: f32,
    /// Of a box: from its middle to its sides [m]; 0.5 each. Above 0.
    pub half_extents: MuslinVec3,
    /// Of a heightfield: from one height to the next [m]; 1. Above 0.
    pub spacing: f32,
    /// Of a heightfield: heights along x; 0. From 2 to 4096.
    pub columns: u32,
    /// Of a heightfield: heights along z; 0. From 2 to 4096.
    pub rows: u32,
    /// Bytes from one position to the next; 0, which is 12. A multiple of 4.
    pub position_stride: u32,
    /// How many positions there are; 0. Of a convex body from 4 to 1024, of a mesh at most 4194304.
    pub vertex_count: u32,
    /// How many indices there are; 0. A multiple of 3, at most 50331648.
    pub index_count: u32,
    /// Of a convex body or a mesh: its points [m], 3 numbers each.
    pub positions: *const f32,
    /// Of a mesh: points of its triangles, 3 each. Triangles without an area do not count.
    pub indices: *const u32,
    /// Of a heightfield: `columns` * `rows` heights [m], row by row along x.
    pub heights: *const f32,
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
        }
    }
}

/// More than this is refused unread; the bounds of meshes that are cloth.
const MAX_VERTICES: u32 = 1 << 22;
const MAX_INDICES: u32 = 12 * MAX_VERTICES;
/// More heights in one direction than this are refused unread; the core's own bound.
const MAX_HEIGHTS: u32 = 4096;

impl MuslinColliderDesc {
    /// The collider, with its lists copied out of the caller's memory; only those of its shape.
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
            ..ColliderDesc::default()
        };
        let require = |fits: bool, field: &str, must: &str| {
            if fits { Ok(()) } else { Err(CallError::bad_value(field, must)) }
        };
        if matches!(shape, Shape::Convex | Shape::Mesh) {
            require(self.vertex_count >= 3, "vertex_count", "be at least 3")?;
            require(self.vertex_count <= MAX_VERTICES, "vertex_count", "be at most 4194304")?;
            let (stride, count) = (self.position_stride, self.vertex_count);
            // SAFETY: the caller's promise above.
            desc.positions =
                unsafe { read_vec3s("positions", self.positions.cast(), stride, count)? };
        }
        if matches!(shape, Shape::Mesh) {
            require(self.index_count > 0, "index_count", "be at least 3")?;
            require(self.index_count <= MAX_INDICES, "index_count", "be at most 50331648")?;
            require(self.index_count.is_multiple_of(3), "index_count", "be a multiple of 3")?;
            // SAFETY: the caller's promise above.
            desc.indices = unsafe { read_u32s("indices", self.indices, self.index_count)? };
        }
        if matches!(shape, Shape::Heightfield) {
            let is_allowed = |count: u32| (2..=MAX_HEIGHTS).contains(&count);
            require(is_allowed(self.columns), "columns", "be from 2 to 4096")?;
            require(is_allowed(self.rows), "rows", "be from 2 to 4096")?;
            let count = self.columns * self.rows;
            // SAFETY: the caller's promise above; a number has the size of any other.
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
