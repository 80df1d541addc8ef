//! Queries: ray casts and the links of the solver.
//!
//! Rays walk the tree of `ray_tree`.
//!
//! Reads `World`; writes only the cached tree.
//! Invariant: of equally near hits, the one with the lowest index is returned.

use crate::cloth::Cloth;
use crate::cloth::ray_tree::{HitSearch, ParticleSearch};
use crate::error::{Result, check, check_finite};
use crate::geometry::ray::Ray;
use crate::math::float_env::with_float_env;
use crate::model::links::LinkKind;
use glam::Vec3;

/// Where a ray hits a cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle that was hit: its corners are the indices `3 * triangle` and the two after it.
    pub triangle: u32,
    /// The corner particle nearest to the hit.
    pub particle: u32,
    /// Barycentric weight of the triangle's second corner.
    pub u: f32,
    /// Barycentric weight of the triangle's third corner.
    pub v: f32,
    /// Distance from the ray's origin [m].
    pub distance: f32,
    /// Point of the hit [m].
    pub position: Vec3,
    /// Unit normal of the triangle, on the side that was hit.
    pub normal: Vec3,
}

impl Cloth {
    /// Returns the intact links (distance constraints): the two particles and the kind of each.
    pub fn links(&self) -> impl Iterator<Item = (u32, u32, LinkKind)> + '_ {
        self.world.constraints.active_links()
    }

    /// Returns the colours of the graph colouring in solving order: the kind of their links, and
    /// the number of links that each had in the rest state. Within a colour, no particle appears
    /// twice.
    pub fn colors(&self) -> impl Iterator<Item = (LinkKind, usize)> + '_ {
        self.world.constraints.batches.iter().map(|batch| (batch.kind, batch.count))
    }

    /// Returns the first triangle that a ray hits within `max_distance` [m], from either side;
    /// `None` if it hits nothing.
    ///
    /// `direction` need not have length 1; `max_distance` may be infinite. Of equally near triangles
    /// the one with the lowest index is returned.
    ///
    /// The first ray builds a tree over the triangles, and the first one after positions changed
    /// updates it; further rays take time in proportion to the depth of the tree. The tree is no part
    /// of a save or of the hash, and takes no memory before the first ray.
    ///
    /// ```
    /// use muslin::glam::Vec3;
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let cloth = Cloth::grid(&GridDesc::default())?;
    /// let hit = cloth.raycast(Vec3::new(1.0, -1.0, 5.0), Vec3::NEG_Z, f32::INFINITY)?;
    /// assert_eq!(hit.map(|hit| hit.distance), Some(5.0));
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `origin` or `direction` is not finite,
    /// `direction` is zero, or `max_distance` is negative.
    pub fn raycast(&self, origin: Vec3, direction: Vec3, max_distance: f32) -> Result<Option<Hit>> {
        check(max_distance >= 0.0, "max_distance", "be at least 0")?;
        let ray = self.relative_ray(origin, direction)?;
        Ok(with_float_env(|| self.first_hit(&ray, max_distance)))
    }

    /// Checks the arguments, in absolute coordinates, and returns a ray relative to the origin of
    /// the cloth.
    pub(super) fn relative_ray(&self, origin: Vec3, direction: Vec3) -> Result<Ray> {
        let Ray { origin, direction } = ray(origin, direction)?;
        Ok(Ray { origin: self.world.to_relative(origin), direction })
    }

    /// Returns the nearest hit of a relative ray within `max_distance`.
    pub(super) fn first_hit(&self, ray: &Ray, max_distance: f32) -> Option<Hit> {
        let mut search = HitSearch::new(&self.world, ray, max_distance);
        self.ray_tree.visit(&self.world, self.revisions(), &mut search);
        let (triangle, hit) = search.first?;
        let vertices = self.world.mesh.triangles[triangle as usize];
        let corners = vertices.map(|v| self.world.particles.x.get(v as usize));
        let [a, b, c] = corners;
        let position = ray.origin + ray.direction * hit.distance;
        let normal = (b - a).cross(c - a);
        let facing = if normal.dot(ray.direction) > 0.0 { -1.0 } else { 1.0 };
        let distance2 = |corner: usize| (corners[corner] - position).length_squared();
        let mut nearest = 0;
        for corner in 1..3 {
            if distance2(corner) < distance2(nearest) {
                nearest = corner;
            }
        }
        Some(Hit {
            triangle,
            particle: vertices[nearest],
            u: hit.u,
            v: hit.v,
            distance: hit.distance,
            position: self.world.to_absolute(position),
            normal: normal * (facing / normal.length()),
        })
    }

    /// Returns the particle nearest to a relative ray, within `radius`.
    pub(super) fn nearest_to(&self, ray: &Ray, radius: f32) -> Option<u32> {
        let mut search = ParticleSearch::new(&self.world, ray, radius);
        self.ray_tree.visit(&self.world, self.revisions(), &mut search);
        search.nearest
    }

    /// Revisions of triangles and positions, of which the ray tree must be.
    fn revisions(&self) -> [u32; 2] {
        [self.topology_revision, self.state_revision]
    }
}

/// Checks the arguments and returns a ray with a unit direction.
fn ray(origin: Vec3, direction: Vec3) -> Result<Ray> {
    check_finite(origin, "origin")?;
    check_finite(direction, "direction")?;
    with_float_env(|| {
        // Scale first, so that the squared length neither overflows nor underflows.
        let largest = direction.x.abs().max(direction.y.abs()).max(direction.z.abs());
        check(largest > 0.0, "direction", "not be zero")?;
        let scaled = direction * (1.0 / largest);
        check(scaled.is_finite(), "direction", "be long enough to be normalized")?;
        Ok(Ray { origin, direction: scaled * (1.0 / scaled.length()) })
    })
}
