//! Primitive collision shapes, each in its own frame: half space, sphere, capsule, box.
//!
//! ```text
//! half space   d = y
//! sphere       d = |p| − r
//! capsule      d = |p − c(p)| − r(c)     c(p), r(c): center and radius of the closest sphere
//! box          d = |max(|p| − h, 0)|     outside;  the largest of |p| − h inside
//! ```
//! A tapered capsule is the convex hull of two spheres of different radii. It is the union of all
//! spheres between them, with linear center and radius. The sphere closest to a point is found by
//! shifting the point along the axis by its distance from the axis times a constant slope.
//!
//! Reads a point in the local frame and writes nothing.
//! Invariant: all distances are exact, and all normals have length one.

use crate::geometry::features::ShapeFeatures;
use crate::geometry::signed_distance::SignedDistance;
use crate::math::{max, min};
use glam::Vec3;

/// All points with y ≤ 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfSpace;

impl SignedDistance for HalfSpace {
    #[inline(always)]
    fn signed_distance(&self, p: Vec3) -> (f32, Vec3) {
        (p.y, Vec3::Y)
    }
}

/// A sphere around the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sphere {
    /// [m]
    pub radius: f32,
}

impl SignedDistance for Sphere {
    #[inline(always)]
    fn signed_distance(&self, p: Vec3) -> (f32, Vec3) {
        let length = p.length();
        let out = if length > 0.0 { p * (1.0 / length) } else { Vec3::Y };
        (length - self.radius, out)
    }
}

/// The convex hull of two spheres on the y axis: a capsule, tapered if their radii differ.
///
/// It is a family of spheres along the axis, whose radius is linear in y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Capsule {
    /// The y coordinate of the middle [m].
    middle: f32,
    /// From the middle to the centers of the end spheres [m].
    half_height: f32,
    /// The radius in the middle [m].
    radius: f32,
    /// How much the radius falls per metre of y.
    taper: f32,
    /// Drop in y from a point to the center of the closest sphere, per metre of distance from the
    /// axis.
    slope: f32,
}

impl Capsule {
    /// Makes the hull of spheres of radius `bottom` at -`half_height` and `top` at +`half_height`
    /// [m]. If one sphere contains the other, the capsule is that sphere.
    pub fn new(half_height: f32, bottom: f32, top: f32) -> Self {
        let difference = bottom - top;
        if difference.abs() >= 2.0 * half_height {
            let (middle, radius) =
                if bottom > top { (-half_height, bottom) } else { (half_height, top) };
            // The taper gives the normal at the center: that of `Sphere`.
            return Self { middle, half_height: 0.0, radius, taper: 1.0, slope: 0.0 };
        }
        let taper = difference / (2.0 * half_height);
        let slope = taper / (1.0 - taper * taper).sqrt();
        Self { middle: 0.0, half_height, radius: (bottom + top) * 0.5, taper, slope }
    }

    fn sphere(&self, y: f32) -> PlacedSphere {
        PlacedSphere { center: Vec3::Y * (self.middle + y), radius: self.radius - self.taper * y }
    }

    /// Returns the y coordinate of the middle and the distance from there to the end spheres [m].
    pub fn axis(&self) -> (f32, f32) {
        (self.middle, self.half_height)
    }

    /// Returns the spheres at the bottom and the top end.
    pub fn ends(&self) -> [PlacedSphere; 2] {
        [-self.half_height, self.half_height].map(|y| self.sphere(y))
    }

    /// Returns the radius of the smaller end [m].
    pub fn min_radius(&self) -> f32 {
        let [bottom, top] = self.ends();
        min(bottom.radius, top.radius)
    }

    /// Returns the sphere of the family that is closest to a point.
    #[inline(always)]
    pub fn closest_sphere(&self, p: Vec3) -> PlacedSphere {
        let from_axis = (p.x * p.x + p.z * p.z).sqrt();
        let y = p.y - self.middle - from_axis * self.slope;
        self.sphere(max(min(y, self.half_height), -self.half_height))
    }
}

impl SignedDistance for Capsule {
    #[inline(always)]
    fn signed_distance(&self, p: Vec3) -> (f32, Vec3) {
        let PlacedSphere { center, radius } = self.closest_sphere(p);
        let r = p - center;
        let length = r.length();
        // On the axis any normal of the cone is right.
        let any_normal = || Vec3::new((1.0 - self.taper * self.taper).sqrt(), self.taper, 0.0);
        let out = if length > 0.0 { r * (1.0 / length) } else { any_normal() };
        (length - radius, out)
    }
}

/// A sphere around any point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedSphere {
    /// [m]
    pub center: Vec3,
    /// [m]
    pub radius: f32,
}

/// A box around the origin with sides along the axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cuboid {
    /// Half of the size on each axis [m].
    pub half_extents: Vec3,
}

impl Cuboid {
    /// Builds its edge and vertex features.
    pub fn features(&self) -> ShapeFeatures {
        let sign = |i: usize, axis: usize| if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
        let corner = |i: usize| Vec3::new(sign(i, 0), sign(i, 1), sign(i, 2)) * self.half_extents;
        let corners: Vec<Vec3> = (0..8).map(corner).collect();
        let mut triangles = Vec::new();
        for (u, v, w) in [(1, 2, 4), (2, 4, 1), (4, 1, 2)] {
            for side in [0, w] {
                triangles.extend([[side, side + u, side + u + v], [side, side + u + v, side + v]]);
            }
        }
        ShapeFeatures::build(&corners, &triangles, true)
    }
}

impl SignedDistance for Cuboid {
    #[inline(always)]
    fn signed_distance(&self, p: Vec3) -> (f32, Vec3) {
        let q = Vec3::new(p.x.abs(), p.y.abs(), p.z.abs()) - self.half_extents;
        let sign = Vec3::new(1.0_f32.copysign(p.x), 1.0_f32.copysign(p.y), 1.0_f32.copysign(p.z));
        if q.x > 0.0 || q.y > 0.0 || q.z > 0.0 {
            let v = Vec3::new(max(q.x, 0.0), max(q.y, 0.0), max(q.z, 0.0));
            let length = v.length();
            return (length, v * sign * (1.0 / length));
        }
        if q.x > q.y && q.x > q.z {
            (q.x, Vec3::X * sign.x)
        } else if q.y > q.z {
            (q.y, Vec3::Y * sign.y)
        } else {
            (q.z, Vec3::Z * sign.z)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Asserts that the normal is the gradient of the distance and leads to the surface.
    fn assert_is_distance(solid: &impl SignedDistance, extent: f32) {
        for i in 0..300 {
            let wave = |k: f32| (i as f32 * k).sin() * extent;
            let p = Vec3::new(wave(1.13), wave(2.31), wave(0.77));
            let (d, out) = solid.signed_distance(p);
            assert!((out.length() - 1.0).abs() < 1.0e-5, "at {p}: {out}");
            let ahead = solid.signed_distance(p + out * 1.0e-3).0 - d;
            assert!((ahead - 1.0e-3).abs() < 2.0e-4, "at {p}: {ahead} for a millimetre");
            let surface = solid.signed_distance(p - out * d).0;
            assert!(surface.abs() < 1.0e-4, "at {p}: {surface} m off the surface");
        }
    }

    #[test]
    fn the_normal_is_the_gradient_of_the_distance() {
        assert_is_distance(&HalfSpace, 2.0);
        assert_is_distance(&Sphere { radius: 0.7 }, 2.0);
        assert_is_distance(&Capsule::new(0.5, 0.3, 0.3), 1.5);
        assert_is_distance(&Capsule::new(0.5, 0.4, 0.1), 1.5);
        assert_is_distance(&Capsule::new(0.1, 0.2, 0.7), 1.5);
        assert_is_distance(&Cuboid { half_extents: Vec3::new(0.5, 0.2, 0.9) }, 1.5);
    }

    #[test]
    fn a_tapered_capsule_is_the_hull_of_its_end_spheres() {
        let capsule = Capsule::new(0.5, 0.4, 0.1);
        for i in 0..200 {
            let wave = |k: f32| (i as f32 * k).sin() * 1.5;
            let p = Vec3::new(wave(1.13), wave(2.31), wave(0.77));
            let distances = (0..=1000)
                .map(|k| k as f32 / 1000.0)
                .map(|t| (p - Vec3::Y * (t - 0.5)).length() - (0.4 - 0.3 * t));
            let exact = distances.fold(f32::INFINITY, f32::min);
            let ours = capsule.signed_distance(p).0;
            assert!((ours - exact).abs() < 1.0e-3, "at {p}: {ours} m, exact {exact} m");
        }
    }
}
