//! Collider descriptors of feature `facet-colliders`: convex hulls, meshes and heightfields.
//!
//! Reads a [`ColliderDesc`]; makes its collision shape.
//! Invariant: other shapes never come here.

use crate::error::{Error, Result, check, check_index};
use crate::geometry::aabb::Aabb;
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::convex_hull;
use crate::geometry::features::ShapeFeatures;
use crate::geometry::heightfield::Heightfield;
use crate::geometry::solid_mesh;
use crate::geometry::triangle_surface;
use crate::geometry::triangle_surface::TriangleSurface;
use crate::state::collider_desc::{ColliderDesc, MAX_COORDINATE, Shape, is_near, is_size};
use crate::state::origin::whole_metres;
use glam::Vec3;

/// Maximum number of points of a convex hull.
const MAX_HULL_POINTS: usize = 1024;

/// Maximum number of heights in one direction.
const MAX_HEIGHTS: u32 = 4096;

/// Largest distance of a convex hull or mesh from zero in its frame, before its coordinates are
/// made relative to its center [m].
const MAX_SHAPE_DISTANCE: f32 = 16.0;

impl ColliderDesc {
    /// Validates the fields of a shape with facets.
    pub(super) fn check_facets(&self) -> Result<()> {
        let size = "be above 0 and below 1e6";
        match self.shape {
            Shape::Convex => {
                let few = (4..=MAX_HULL_POINTS).contains(&self.positions.len());
                check(few, "collider.positions", "be from 4 to 1024")?;
                self.check_positions()
            }
            Shape::Mesh => {
                self.check_positions()?;
                let is_whole = !self.indices.is_empty() && self.indices.len().is_multiple_of(3);
                check(is_whole, "collider.indices", "hold triangles, three indices each")?;
                let is_depth = self.solid == 0.0 || is_size(self.solid);
                check(is_depth, "collider.solid", "be at least 0 and below 1e6")?;
                let count = self.positions.len();
                self.indices.iter().try_for_each(|i| check_index(*i, count, "collider.indices"))
            }
            _ => {
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
        let all_near = self.positions.iter().all(is_near);
        check(all_near, "collider.positions", "be between -1e6 and 1e6")
    }

    /// The vertices of a mesh relative to `shape_center`, and those of its triangles that have an
    /// area.
    pub(crate) fn mesh_surface(&self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let center = self.shape_center();
        let positions: Vec<Vec3> = self.positions.iter().map(|x| *x - center).collect();
        let (triangles, _) = self.indices.as_chunks::<3>();
        let triangles = triangle_surface::non_degenerate(&positions, triangles);
        (positions, triangles)
    }

    /// Returns 1 if the normals of a solid mesh point outward, −1 if they point inward, and 0 for other
    /// shapes.
    ///
    /// # Errors
    /// `BadValue` if `solid` is above 0 and the mesh is not closed and consistently wound.
    pub(crate) fn orientation(&self) -> Result<f32> {
        if self.shape != Shape::Mesh || self.solid == 0.0 {
            return Ok(0.0);
        }
        let (positions, triangles) = self.mesh_surface();
        solid_mesh::orientation(&positions, &triangles).ok_or(Error::BadValue {
            field: "collider.solid",
            must: "be 0 unless the mesh is closed and consistently wound",
        })
    }

    /// The point that the coordinates of the collision shape are relative to, in the local frame
    /// [m]: zero, or whole metres in a convex hull or mesh that is far from zero, e.g. because its
    /// positions are those in a large world.
    pub(crate) fn shape_center(&self) -> Vec3 {
        let bounds = match self.shape {
            Shape::Convex | Shape::Mesh => Aabb::from_points(self.positions.iter().copied()),
            _ => return Vec3::ZERO,
        };
        if bounds.expanded(MAX_SHAPE_DISTANCE).contains(&Aabb::from_points([Vec3::ZERO])) {
            Vec3::ZERO
        } else {
            whole_metres(Vec3::ZERO, bounds.center())
        }
    }

    /// Builds the collision shape of a checked descriptor, relative to `shape_center`.
    ///
    /// # Errors
    /// `BadValue` if the points of a convex hull lie in one plane, or no triangle of a mesh has an
    /// area.
    pub(super) fn facet_shape(&self) -> Result<CollisionShape> {
        let bad = |field, must| Error::BadValue { field, must };
        Ok(match self.shape {
            Shape::Convex => {
                let center = self.shape_center();
                let positions: Vec<Vec3> = self.positions.iter().map(|x| *x - center).collect();
                let (body, triangles) = convex_hull::build(&positions)
                    .ok_or(bad("collider.positions", "not lie in one plane"))?;
                CollisionShape::ConvexHull(body, ShapeFeatures::build(&positions, &triangles, true))
            }
            Shape::Mesh => {
                let (positions, triangles) = self.mesh_surface();
                let surface = TriangleSurface::new(&positions, &triangles)
                    .ok_or(bad("collider.indices", "hold a triangle with an area"))?;
                CollisionShape::TriangleSurface(
                    surface,
                    ShapeFeatures::build(&positions, &triangles, false),
                )
            }
            _ => {
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
}
