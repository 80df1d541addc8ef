//! Questions to a cloth: what rays hit and take hold of, which links hold.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_finite};
use crate::geometry::ray::Ray;
use crate::math::float_env::with_float_env;
use crate::model::links::LinkKind;
use crate::state::grabs::Grab;
use glam::Vec3;

/// Where a ray hits a cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle that was hit: indices `3 * triangle` and the two after it.
    pub triangle: u32,
    /// Its particle nearest to the hit.
    pub particle: u32,
    /// Weight of the triangle's second corner.
    pub u: f32,
    /// Weight of the triangle's third corner.
    pub v: f32,
    /// Distance from the ray's origin [m].
    pub distance: f32,
    /// Where [m].
    pub position: Vec3,
    /// Unit normal of the triangle, on the side that was hit.
    pub normal: Vec3,
}

impl Cloth {
    /// The links that hold, each once: two particles and what it resists.
    pub fn links(&self) -> impl Iterator<Item = (u32, u32, LinkKind)> + '_ {
        self.world.constraints.active_links()
    }

    /// The colours that links are solved in, in order: what they resist, and how many of the links that
    /// it was woven with they hold. No particle appears twice in a colour.
    pub fn colors(&self) -> impl Iterator<Item = (LinkKind, usize)> + '_ {
        self.world.constraints.batches.iter().map(|batch| (batch.kind, batch.count))
    }

    /// The first triangle along a ray, within `max_distance` [m] (which may be infinite), hit from
    /// either side. `direction` need not have length one.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless `origin` and `direction` are finite,
    /// `direction` is not zero, and `max_distance` is at least 0.
    pub fn raycast(&self, origin: Vec3, direction: Vec3, max_distance: f32) -> Result<Option<Hit>> {
        check(max_distance >= 0.0, "max_distance", "be at least 0")?;
        let ray = ray(origin, direction)?;
        Ok(with_float_env(|| self.first_hit(&ray, max_distance)))
    }

    /// Takes hold of the particle that a ray points at: the nearest one of the triangle that it hits,
    /// or else the nearest one within `radius` [m] of it. Says where that particle is [m]. `None` if
    /// there is none.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless `origin` and `direction` are finite,
    /// `direction` is not zero, and `radius` is at least 0 and finite;
    /// [`Error::Full`](crate::Error::Full) if 64 grabs are held already.
    pub fn grab_ray(
        &mut self,
        origin: Vec3,
        direction: Vec3,
        radius: f32,
    ) -> Result<Option<(Grab, Vec3)>> {
        check(radius.is_finite() && radius >= 0.0, "radius", "be at least 0 and finite")?;
        let ray = ray(origin, direction)?;
        let pointed_at = with_float_env(|| {
            let hit = self.first_hit(&ray, f32::INFINITY).map(|hit| hit.particle);
            hit.or_else(|| self.nearest_to(&ray, radius))
        });
        let Some(particle) = pointed_at else {
            return Ok(None);
        };
        let grab = self.grab_particle(particle)?;
        Ok(Some((grab, self.world.particles.x.at(particle as usize))))
    }

    fn first_hit(&self, ray: &Ray, max_distance: f32) -> Option<Hit> {
        let x = &self.world.particles.x;
        let mut first: Option<Hit> = None;
        for (index, vertices) in self.world.mesh.triangles.iter().enumerate() {
            let corners = vertices.map(|v| x.at(v as usize));
            let Some(meeting) = ray.intersect_triangle(corners) else {
                continue;
            };
            let nearest_yet = first.map_or(max_distance, |hit| hit.distance);
            let is_nearer = meeting.distance < nearest_yet
                || (first.is_none() && meeting.distance <= max_distance);
            if !is_nearer {
                continue;
            }
            let [a, b, c] = corners;
            let position = ray.origin + ray.direction * meeting.distance;
            let normal = (b - a).cross(c - a);
            let facing = if normal.dot(ray.direction) > 0.0 { -1.0 } else { 1.0 };
            let far = |corner: usize| (corners[corner] - position).length_squared();
            let mut nearest = 0;
            for corner in 1..3 {
                if far(corner) < far(nearest) {
                    nearest = corner;
                }
            }
            first = Some(Hit {
                triangle: index as u32,
                particle: vertices[nearest],
                u: meeting.u,
                v: meeting.v,
                distance: meeting.distance,
                position,
                normal: normal * (facing / normal.length()),
            });
        }
        first
    }

    fn nearest_to(&self, ray: &Ray, radius: f32) -> Option<u32> {
        let mut nearest = None;
        let mut least = radius;
        for (particle, x) in self.world.particles.x.iter().enumerate() {
            let distance = ray.distance_to_point(x);
            if distance < least || (nearest.is_none() && distance <= least) {
                (nearest, least) = (Some(particle as u32), distance);
            }
        }
        nearest
    }
}

fn ray(origin: Vec3, direction: Vec3) -> Result<Ray> {
    check_finite(origin, "origin")?;
    check_finite(direction, "direction")?;
    with_float_env(|| {
        // Scaled first, so that no length overflows or vanishes.
        let largest = direction.x.abs().max(direction.y.abs()).max(direction.z.abs());
        check(largest > 0.0, "direction", "not be zero")?;
        let scaled = direction * (1.0 / largest);
        let usable = scaled.is_finite();
        check(usable, "direction", "be longer than the smallest number")?;
        Ok(Ray { origin, direction: scaled * (1.0 / scaled.length()) })
    })
}
