//! How deep particles and triangles of the cloth are in a collider, by signed distances of its own.
//!
//! | shape | depth of a particle | depth of a triangle |
//! | --- | --- | --- |
//! | plane | below the plane | that of its deepest corner |
//! | sphere, capsule | radius less distance from the centre or axis | the same, from the nearest point of the triangle |
//! | box | distance to the nearest face | shortest translation out of the box |
//! | closed mesh | distance to the nearest triangle, if a ray hits the mesh an odd number of times | none; the pairs that cross are counted |

use super::bvh::Bvh;
use super::crossings::count_crossings;
use super::distance::{segment_to_triangle, triangle_in_box};
use super::surface::Surface;
use muslin::glam::{DQuat, DVec3, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Shape};

/// Directions of the rays that tell inside from outside; two of three must agree.
const RAYS: [DVec3; 3] = [
    DVec3::new(0.6123, 0.5201, 0.5954),
    DVec3::new(-0.4441, 0.8217, 0.3573),
    DVec3::new(0.2719, -0.3313, -0.9035),
];

/// A collider of a cloth at its pose after the last tick.
#[derive(Debug)]
pub struct Body {
    /// The handle in the cloth.
    pub collider: Collider,
    /// Shape and pose.
    pub desc: ColliderDesc,
    /// The triangles of a mesh in its local frame, in world units.
    mesh: Option<Bvh>,
}

/// Greatest depth of particles and triangles [m], 0 or less outside, and pairs of triangles of
/// cloth and body that cross.
#[derive(Clone, Copy, Debug)]
pub struct Penetration {
    pub particles: f64,
    pub triangles: f64,
    pub pairs: usize,
}

impl Default for Penetration {
    fn default() -> Self {
        Self { particles: f64::NEG_INFINITY, triangles: f64::NEG_INFINITY, pairs: 0 }
    }
}

impl Penetration {
    pub fn max(self, other: Self) -> Self {
        Self {
            particles: self.particles.max(other.particles),
            triangles: self.triangles.max(other.triangles),
            pairs: self.pairs.max(other.pairs),
        }
    }
}

impl Body {
    pub fn new(collider: Collider, desc: ColliderDesc) -> Self {
        let mut body = Self { collider, desc, mesh: None };
        body.deform(body.desc.positions.clone());
        body
    }

    /// Sets the vertices of a mesh.
    pub fn deform(&mut self, positions: Vec<Vec3>) {
        self.desc.positions = positions;
        let desc = &self.desc;
        self.mesh = (desc.shape == Shape::Mesh).then(|| {
            let (indices, _) = desc.indices.as_chunks::<3>();
            let at = |v: u32| desc.positions[v as usize].as_dvec3();
            Bvh::new(indices.iter().map(|t| t.map(at)).collect())
        });
    }

    /// Depth of the cloth in this body; the particles for which `is_held` is true, and triangles
    /// with such a corner, do not count.
    pub fn penetration(&self, cloth: &Cloth, surface: &Surface, is_held: &[bool]) -> Penetration {
        let mut worst = Penetration::default();
        for particle in (0..cloth.particle_count()).filter(|i| !is_held[*i as usize]) {
            let Some(x) = cloth.position(particle) else { continue };
            worst.particles = worst.particles.max(self.depth(self.to_local(x.as_dvec3())));
        }
        if let Some(mesh) = &self.mesh {
            // Poses of mesh bodies are f32 too, but the rotated corners are rounded to f64 only.
            let triangles = (0..surface.corners.len())
                .filter(|t| surface.corners[*t].iter().all(|v| !is_held[*v as usize]))
                .map(|t| surface.tree.triangle(t).map(|p| self.to_local(p)));
            worst.pairs = count_crossings(&Bvh::new(triangles.collect()), mesh);
            return worst;
        }
        for (t, corners) in surface.corners.iter().enumerate() {
            if corners.iter().all(|v| !is_held[*v as usize]) {
                let local = surface.tree.triangle(t).map(|p| self.to_local(p));
                worst.triangles = worst.triangles.max(self.triangle_depth(local));
            }
        }
        worst
    }

    fn to_local(&self, x: DVec3) -> DVec3 {
        let rotation: DQuat = self.desc.rotation.as_dquat().normalize();
        rotation.inverse() * (x - self.desc.position.as_dvec3())
    }

    fn axis(&self) -> [DVec3; 2] {
        let half = DVec3::Y * f64::from(self.desc.half_height);
        [-half, half]
    }

    /// Depth of a point of the local frame [m]; 0 or less outside.
    fn depth(&self, p: DVec3) -> f64 {
        let radius = f64::from(self.desc.radius);
        match self.desc.shape {
            Shape::Plane => -p.y,
            Shape::Sphere => radius - p.length(),
            Shape::Capsule => {
                let [low, high] = self.axis();
                radius - p.distance(DVec3::Y * p.y.clamp(low.y, high.y))
            }
            Shape::Box => (self.desc.half_extents.as_dvec3() - p.abs()).min_element(),
            Shape::Mesh => self.mesh.as_ref().map_or(0.0, |mesh| mesh_depth(mesh, p)),
            other => panic!("there is no check for a {other:?}"),
        }
    }

    fn triangle_depth(&self, triangle: [DVec3; 3]) -> f64 {
        let radius = f64::from(self.desc.radius);
        match self.desc.shape {
            Shape::Sphere => radius - segment_to_triangle([DVec3::ZERO; 2], triangle),
            Shape::Capsule => radius - segment_to_triangle(self.axis(), triangle),
            Shape::Box => triangle_in_box(triangle, self.desc.half_extents.as_dvec3()),
            _ => triangle.map(|p| self.depth(p)).into_iter().fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

/// Distance to the surface of a closed mesh from inside [m]; 0 outside.
fn mesh_depth(mesh: &Bvh, p: DVec3) -> f64 {
    let is_odd = |ray: &&DVec3| !mesh.count_ray_hits(p, **ray).is_multiple_of(2);
    if RAYS.iter().filter(is_odd).count() < 2 { 0.0 } else { mesh.nearest(p) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin::glam::Vec3;

    fn body(desc: ColliderDesc) -> Body {
        Body::new(Collider::from_bits(1), desc)
    }

    #[test]
    fn points_inside_shapes_are_as_deep_as_their_way_out() {
        let sphere = body(ColliderDesc { shape: Shape::Sphere, radius: 1.0, ..Default::default() });
        assert_eq!(sphere.depth(DVec3::X * 0.75), 0.25);
        let capsule = ColliderDesc {
            shape: Shape::Capsule,
            radius: 0.5,
            half_height: 1.0,
            ..Default::default()
        };
        assert_eq!(body(capsule).depth(DVec3::new(0.25, 1.0, 0.0)), 0.25);
        let cuboid = ColliderDesc {
            shape: Shape::Box,
            half_extents: Vec3::new(1.0, 2.0, 3.0),
            ..Default::default()
        };
        assert_eq!(body(cuboid).depth(DVec3::new(0.5, 1.75, 0.0)), 0.25);
        assert_eq!(body(ColliderDesc::default()).depth(-DVec3::Y), 1.0);
    }

    #[test]
    fn points_inside_a_mesh_are_told_from_points_outside() {
        let mesh = body(crate::shapes::box_mesh(Vec3::ONE, 4));
        assert!((mesh.depth(DVec3::new(0.75, 0.1, 0.2)) - 0.25).abs() < 1.0e-9);
        assert_eq!(mesh.depth(DVec3::new(1.25, 0.1, 0.2)), 0.0);
    }
}
