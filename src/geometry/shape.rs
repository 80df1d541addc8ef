//! Shapes, each in its own frame: how far a point is from one, and which way leads out.

use crate::geometry::aabb::Aabb;
use crate::geometry::features::{ShapeFeatures, Steps};
use crate::geometry::heightfield::Heightfield;
use crate::geometry::polyhedron::Polyhedron;
use crate::geometry::triangle_surface::TriangleSurface;
use crate::math::{max, min};
use glam::Vec3;

/// A convex body.
pub(crate) trait SignedDistance {
    /// How far outside a point is [m], less than 0 inside; and the direction out from there, of length
    /// one.
    fn nearest(&self, p: Vec3) -> (f32, Vec3);
}

/// All that is below y = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfSpace;

impl SignedDistance for HalfSpace {
    #[inline(always)]
    fn nearest(&self, p: Vec3) -> (f32, Vec3) {
        (p.y, Vec3::Y)
    }
}

/// A ball around the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sphere {
    pub radius: f32,
}

impl SignedDistance for Sphere {
    #[inline(always)]
    fn nearest(&self, p: Vec3) -> (f32, Vec3) {
        let length = p.length();
        let out = if length > 0.0 { p * (1.0 / length) } else { Vec3::Y };
        (length - self.radius, out)
    }
}

/// Two balls on the y axis and all that lies between them: a capsule, tapered if their sizes differ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Capsule {
    /// The height of the middle, and from there to the centres of the balls.
    middle: f32,
    half_height: f32,
    /// The radius in the middle, and how much less it is a metre higher.
    radius: f32,
    taper: f32,
    /// How much lower than a point the ball is that it is closest to, a metre of its distance from the
    /// axis.
    tilt: f32,
}

impl Capsule {
    /// With balls of these radii at -`half_height` and +`half_height`. Where one holds the other, that is
    /// all there is.
    pub fn new(half_height: f32, bottom: f32, top: f32) -> Self {
        let difference = bottom - top;
        if difference.abs() >= 2.0 * half_height {
            let (middle, radius) =
                if bottom > top { (-half_height, bottom) } else { (half_height, top) };
            return Self { middle, half_height: 0.0, radius, taper: 0.0, tilt: 0.0 };
        }
        let taper = difference / (2.0 * half_height);
        let tilt = taper / (1.0 - taper * taper).sqrt();
        Self { middle: 0.0, half_height, radius: (bottom + top) * 0.5, taper, tilt }
    }

    fn ball(&self, y: f32) -> PlacedSphere {
        PlacedSphere { center: Vec3::Y * (self.middle + y), radius: self.radius - self.taper * y }
    }

    /// The balls at both ends.
    pub fn ends(&self) -> [PlacedSphere; 2] {
        [-self.half_height, self.half_height].map(|y| self.ball(y))
    }

    /// The radius of its smaller end.
    pub fn slimmest(&self) -> f32 {
        let [bottom, top] = self.ends();
        min(bottom.radius, top.radius)
    }

    /// The ball that a point is closest to.
    #[inline(always)]
    pub fn ball_at(&self, p: Vec3) -> PlacedSphere {
        let from_axis = (p.x * p.x + p.z * p.z).sqrt();
        let y = p.y - self.middle - from_axis * self.tilt;
        self.ball(max(min(y, self.half_height), -self.half_height))
    }
}

impl SignedDistance for Capsule {
    #[inline(always)]
    fn nearest(&self, p: Vec3) -> (f32, Vec3) {
        let PlacedSphere { center, radius } = self.ball_at(p);
        let r = p - center;
        let length = r.length();
        // On the axis the way out leans as it does beside it.
        let lean = || Vec3::new((1.0 - self.taper * self.taper).sqrt(), self.taper, 0.0);
        let out = if length > 0.0 { r * (1.0 / length) } else { lean() };
        (length - radius, out)
    }
}

/// A ball somewhere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedSphere {
    pub center: Vec3,
    pub radius: f32,
}

/// A box around the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cuboid {
    pub half: Vec3,
}

impl Cuboid {
    /// Its ridges and corners.
    pub fn features(&self) -> ShapeFeatures {
        let sign = |i: usize, axis: usize| if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
        let corner = |i: usize| Vec3::new(sign(i, 0), sign(i, 1), sign(i, 2)) * self.half;
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
    fn nearest(&self, p: Vec3) -> (f32, Vec3) {
        let q = Vec3::new(p.x.abs(), p.y.abs(), p.z.abs()) - self.half;
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

/// A shape in its own frame.
#[derive(Clone, Debug)]
pub(crate) enum CollisionShape {
    HalfSpace(HalfSpace),
    Sphere(Sphere),
    Capsule(Capsule),
    Cuboid(Cuboid, ShapeFeatures),
    ConvexHull(Polyhedron, ShapeFeatures),
    TriangleSurface(TriangleSurface, ShapeFeatures),
    Heightfield(Heightfield),
}

impl CollisionShape {
    /// The bounds of the shape in its own frame.
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::HalfSpace(_) => {
                Aabb { high: Vec3::new(f32::INFINITY, 0.0, f32::INFINITY), ..Aabb::ALL }
            }
            Self::Sphere(ball) => Aabb::from_points([Vec3::ZERO]).expanded(ball.radius),
            Self::Capsule(capsule) => {
                let mut bounds = Aabb::EMPTY;
                for PlacedSphere { center, radius } in capsule.ends() {
                    bounds.merge(&Aabb::from_points([center]).expanded(radius));
                }
                bounds
            }
            Self::Cuboid(cuboid, _) => Aabb::from_points([-cuboid.half, cuboid.half]),
            Self::ConvexHull(body, _) => body.bounds,
            Self::TriangleSurface(surface, _) => surface.bounds(),
            Self::Heightfield(terrain) => terrain.bounds(),
        }
    }

    /// The bends of a shape of flat facets; nothing of one that is round.
    pub fn steps(&self) -> Option<&Steps> {
        match self {
            Self::HalfSpace(_) | Self::Sphere(_) | Self::Capsule(_) => None,
            Self::Cuboid(_, relief)
            | Self::ConvexHull(_, relief)
            | Self::TriangleSurface(_, relief) => Some(&relief.steps),
            Self::Heightfield(terrain) => Some(terrain.steps()),
        }
    }

    /// How far inside a shape with a middle its surface is deepest, as a way out sees a point of the surface;
    /// infinitely far where there is no middle.
    pub fn depth(&self, at: Vec3, out: Vec3) -> f32 {
        match self {
            Self::Cuboid(..) => at.dot(out),
            Self::ConvexHull(body, _) => (at - body.bounds.center()).dot(out),
            _ => f32::INFINITY,
        }
    }

    /// Cheap to compute, and never more than the distance of a point outside.
    pub fn bound(&self) -> DistanceBound {
        match self {
            Self::HalfSpace(_) => DistanceBound::Plane,
            Self::Heightfield(terrain) => DistanceBound::Below(terrain.bounds().high.y),
            Self::Sphere(ball) => DistanceBound::Sphere(ball.radius),
            Self::Capsule(capsule) => {
                let [bottom, top] = capsule.ends();
                let radius = max(bottom.radius, top.radius);
                DistanceBound::Rod(capsule.middle, capsule.half_height, radius)
            }
            Self::Cuboid(..) | Self::ConvexHull(..) | Self::TriangleSurface(..) => {
                let bounds = self.bounds();
                DistanceBound::Box(bounds.center(), bounds.half_extents())
            }
        }
    }
}

/// See `CollisionShape::bound`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum DistanceBound {
    /// The plane that all of it is below: what ends above it has touched nothing, however it came there.
    Plane,
    /// How high it reaches.
    Below(f32),
    /// Its radius.
    Sphere(f32),
    /// The height of its middle, half its height, and its radius.
    Rod(f32, f32, f32),
    /// Its middle, and from there to its sides.
    Box(Vec3, Vec3),
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The direction out is where the distance grows, as fast as one moves; and it leads to the surface.
    fn assert_is_distance(solid: &impl SignedDistance, reach: f32) {
        for i in 0..300 {
            let wave = |k: f32| (i as f32 * k).sin() * reach;
            let p = Vec3::new(wave(1.13), wave(2.31), wave(0.77));
            let (d, out) = solid.nearest(p);
            assert!((out.length() - 1.0).abs() < 1.0e-5, "at {p}: {out}");
            let ahead = solid.nearest(p + out * 1.0e-3).0 - d;
            assert!((ahead - 1.0e-3).abs() < 2.0e-4, "at {p}: {ahead} for a millimetre");
            let surface = solid.nearest(p - out * d).0;
            assert!(surface.abs() < 1.0e-4, "at {p}: {surface} m off the surface");
        }
    }

    #[test]
    fn distances_lead_to_surfaces() {
        assert_is_distance(&HalfSpace, 2.0);
        assert_is_distance(&Sphere { radius: 0.7 }, 2.0);
        assert_is_distance(&Capsule::new(0.5, 0.3, 0.3), 1.5);
        assert_is_distance(&Capsule::new(0.5, 0.4, 0.1), 1.5);
        assert_is_distance(&Capsule::new(0.1, 0.2, 0.7), 1.5);
        assert_is_distance(&Cuboid { half: Vec3::new(0.5, 0.2, 0.9) }, 1.5);
    }

    #[test]
    fn a_tapered_capsule_is_the_hull_of_its_balls() {
        let capsule = Capsule::new(0.5, 0.4, 0.1);
        for i in 0..200 {
            let wave = |k: f32| (i as f32 * k).sin() * 1.5;
            let p = Vec3::new(wave(1.13), wave(2.31), wave(0.77));
            let balls = (0..=1000)
                .map(|k| k as f32 / 1000.0)
                .map(|t| (p - Vec3::Y * (t - 0.5)).length() - (0.4 - 0.3 * t));
            let exact = balls.fold(f32::INFINITY, f32::min);
            let ours = capsule.nearest(p).0;
            assert!((ours - exact).abs() < 1.0e-3, "at {p}: {ours} m, exact {exact} m");
        }
    }
}
