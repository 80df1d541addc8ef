//! What a host says of a collider.

use crate::error::{Error, Result, check, check_index};
use crate::geometry::convex_hull;
use crate::geometry::features::ShapeFeatures;
use crate::geometry::shape::{Capsule, CollisionShape, Cuboid, HalfSpace, Sphere};
use crate::geometry::triangle_surface;
use crate::state::pose::{COLLIDER_FIELDS, check_pose};

use crate::geometry::heightfield::Heightfield;
use crate::geometry::triangle_surface::TriangleSurface;
use crate::math::hasher::StateHasher;
use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};

/// The shapes of colliders, each in a frame of its own that `position` and `rotation` put into the world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
#[non_exhaustive]
pub enum Shape {
    /// All that is below `position` along the turned y axis.
    #[default]
    Plane = 0,
    /// A ball of `radius` around `position`.
    Sphere = 1,
    /// Balls of `radius` and `top_radius` at -`half_height` and +`half_height` along the turned y axis, and
    /// all between them.
    Capsule = 2,
    /// A box that reaches `half_extents` to either side of `position` along each turned axis.
    Box = 3,
    /// The least convex body that holds all of `positions`. A soft sheet that hangs over its tips is not
    /// quite calm: it moves at some mm/s.
    Convex = 4,
    /// The triangles that `indices` join of `positions`. Cloth stays on the side where it is: both are
    /// outside, and nothing is inside, so that it need not be closed nor wound one way. It keeps a gap of
    /// 0.1 mm at least.
    Mesh = 5,
    /// Ground: all below a surface over `columns` × `rows` heights, `spacing` apart along the turned x and
    /// z axes from `position` on, as deep as it is wide. It has no sides.
    Heightfield = 6,
}

impl Shape {
    /// The shape that a face calls `number`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a number that names no shape of this version.
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

/// A collider: its shape, where it is and how it feels. Fields that its shape does not use are ignored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ColliderDesc {
    /// What it is; a plane.
    pub shape: Shape,
    /// Where it is [m]; the origin. A point of the surface of a plane.
    pub position: Vec3,
    /// How it is turned; not at all. A plane's normal is the turned y axis.
    pub rotation: Quat,
    /// Of a sphere or capsule [m]; 0.5. Above 0.
    pub radius: f32,
    /// Of the upper end of a capsule [m]; −1 is as `radius`. Above 0.
    pub top_radius: f32,
    /// Of a capsule: from its middle to the centres of its ends [m]; 0.5. At least 0.
    pub half_height: f32,
    /// Of a box: from its middle to its sides [m]; 0.5 each. Above 0.
    pub half_extents: Vec3,
    /// Of a convex body, at most 1024, or a mesh: its points [m]; none.
    pub positions: Vec<Vec3>,
    /// Of a mesh: points of its triangles, three each; none. Triangles without an area do not count.
    pub indices: Vec<u32>,
    /// Of a heightfield: heights along x; 0. From 2 to 4096.
    pub columns: u32,
    /// Of a heightfield: heights along z; 0. From 2 to 4096.
    pub rows: u32,
    /// Of a heightfield: from one height to the next [m]; 1. Above 0.
    pub spacing: f32,
    /// Of a heightfield: `columns` × `rows` heights [m], row by row along x; none.
    pub heights: Vec<f32>,
    /// Gap kept from its surface [m]; −1 takes the material's thickness. At least 0. Where a surface is round or
    /// bends little, particles stay farther off by what is between them would sink in: at most a fifth of the mean
    /// edge from balls and capsules, a tenth from others.
    pub thickness: f32,
    /// Coulomb coefficient; −1 takes the material's.
    pub friction: f32,
    /// Share of the normal speed that a bounce gives back, 0 to 1; −1 takes the material's.
    pub restitution: f32,
    /// Share of the sliding speed that every substep of touching leaves, beside Coulomb friction;
    /// 1 (all of it). The receipt's floor is 0.8, with `friction` 0 and `restitution` 0.2.
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
            thickness: -1.0,
            friction: -1.0,
            restitution: -1.0,
            tangential_restitution: 1.0,
        }
    }
}

/// Points of a convex body at most.
const MAX_HULL_POINTS: usize = 1024;

/// Heights of a heightfield in one direction at most.
const MAX_HEIGHTS: u32 = 4096;

/// No size or place within a shape is as much [m], so that f32 can still square it.
const MAX_COORDINATE: f32 = 1.0e6;

fn is_size(v: f32) -> bool {
    v > 0.0 && v < MAX_COORDINATE
}

impl ColliderDesc {
    /// Refuses a collider that cannot be.
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
            Shape::Convex => {
                let few = (4..=MAX_HULL_POINTS).contains(&self.positions.len());
                check(few, "collider.positions", "be from 4 to 1024")?;
                self.check_positions()
            }
            Shape::Mesh => {
                self.check_positions()?;
                let is_whole = !self.indices.is_empty() && self.indices.len().is_multiple_of(3);
                check(is_whole, "collider.indices", "hold triangles, three indices each")?;
                let count = self.positions.len();
                self.indices.iter().try_for_each(|i| check_index(*i, count, "collider.indices"))
            }
            Shape::Heightfield => {
                let few = |count: u32| (2..=MAX_HEIGHTS).contains(&count);
                check(few(self.columns), "collider.columns", "be from 2 to 4096")?;
                check(few(self.rows), "collider.rows", "be from 2 to 4096")?;
                check(is_size(self.spacing), "collider.spacing", size)?;
                check(
                    self.heights.len() == self.columns as usize * self.rows as usize,
                    "collider.heights",
                    "be `columns` times `rows`",
                )?;
                let near = |height: &f32| height.abs() < MAX_COORDINATE;
                check(self.heights.iter().all(near), "collider.heights", "be between -1e6 and 1e6")
            }
        }
    }

    fn check_positions(&self) -> Result<()> {
        let near = |x: &Vec3| x.to_array().iter().all(|c| c.abs() < MAX_COORDINATE);
        let all_near = self.positions.iter().all(near);
        check(all_near, "collider.positions", "be between -1e6 and 1e6")
    }

    /// The shape, ready to be touched. The descriptor has been checked but for what only making it shows.
    pub(crate) fn collision_shape(&self) -> Result<CollisionShape> {
        let bad = |field, must| Error::BadValue { field, must };
        Ok(match self.shape {
            Shape::Plane => CollisionShape::HalfSpace(HalfSpace),
            Shape::Sphere => CollisionShape::Sphere(Sphere { radius: self.radius }),
            Shape::Capsule => {
                let top = if self.top_radius < 0.0 { self.radius } else { self.top_radius };
                CollisionShape::Capsule(Capsule::new(self.half_height, self.radius, top))
            }
            Shape::Box => {
                let cuboid = Cuboid { half: self.half_extents };
                CollisionShape::Cuboid(cuboid, cuboid.features())
            }
            Shape::Convex => {
                let (body, triangles) = convex_hull::build(&self.positions)
                    .ok_or(bad("collider.positions", "not lie in one plane"))?;
                CollisionShape::ConvexHull(
                    body,
                    ShapeFeatures::build(&self.positions, &triangles, true),
                )
            }
            Shape::Mesh => {
                let (triangles, _) = self.indices.as_chunks::<3>();
                let triangles = triangle_surface::non_degenerate(&self.positions, triangles);
                let surface = TriangleSurface::new(&self.positions, &triangles)
                    .ok_or(bad("collider.indices", "hold a triangle with an area"))?;
                CollisionShape::TriangleSurface(
                    surface,
                    ShapeFeatures::build(&self.positions, &triangles, false),
                )
            }
            Shape::Heightfield => {
                let heights = self.heights.clone();
                CollisionShape::Heightfield(Heightfield::new(
                    self.columns,
                    self.rows,
                    self.spacing,
                    heights,
                ))
            }
        })
    }

    /// Adds all that touching depends on to a hash.
    pub(crate) fn hash(&self, hasher: &mut StateHasher) {
        hasher.write_u32s(&[self.shape as u32, self.columns, self.rows]);
        hasher.write_f32s(&[self.radius, self.top_radius, self.half_height, self.spacing]);
        hasher.write_f32s(&self.half_extents.to_array());
        hasher.write_f32s(&[self.thickness, self.friction, self.restitution]);
        hasher.write_f32s(&[self.tangential_restitution]);
        self.positions.iter().for_each(|x| hasher.write_f32s(&x.to_array()));
        hasher.write_u32s(&self.indices);
        hasher.write_f32s(&self.heights);
    }
}
