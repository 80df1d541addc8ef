//! The geometry of a collider in its own frame: one of the primitives, a convex hull, a triangle
//! surface or a heightfield.
//!
//! It is built once from the public `ColliderDesc` and shared by all copies of the collider. The
//! narrow phases match on it; broad and mid phase use its bounds, its distance bound and its
//! features.
//!
//! Reads only itself and writes nothing.
//! Invariant: the shape lies inside [`CollisionShape::bounds`], and
//! [`CollisionShape::distance_bound`] never gives more than the true distance of a point outside.

use crate::geometry::aabb::Aabb;
use crate::geometry::bends::BendHistogram;
use crate::geometry::features::ShapeFeatures;
use crate::geometry::heightfield::Heightfield;
use crate::geometry::polyhedron::Polyhedron;
use crate::geometry::primitives::{Capsule, Cuboid, HalfSpace, PlacedSphere, Sphere};
use crate::geometry::signed_distance::SignedDistance;
use crate::geometry::triangle_surface::TriangleSurface;
use crate::math::max;
use glam::Vec3;

/// A collision shape in its own frame. Shapes with flat faces carry their edge and vertex features.
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
    /// Returns the bounds of the shape in its own frame [m].
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::HalfSpace(_) => {
                Aabb { high: Vec3::new(f32::INFINITY, 0.0, f32::INFINITY), ..Aabb::ALL }
            }
            Self::Sphere(sphere) => Aabb::from_points([Vec3::ZERO]).expanded(sphere.radius),
            Self::Capsule(capsule) => {
                let mut bounds = Aabb::EMPTY;
                for PlacedSphere { center, radius } in capsule.ends() {
                    bounds.merge(&Aabb::from_points([center]).expanded(radius));
                }
                bounds
            }
            Self::Cuboid(cuboid, _) => {
                Aabb::from_points([-cuboid.half_extents, cuboid.half_extents])
            }
            Self::ConvexHull(body, _) => body.bounds(),
            Self::TriangleSurface(surface, _) => surface.bounds(),
            Self::Heightfield(terrain) => terrain.bounds(),
        }
    }

    /// Returns how much a shape with flat faces bends at its edges; `None` for smooth shapes.
    pub fn bends(&self) -> Option<&BendHistogram> {
        match self {
            Self::HalfSpace(_) | Self::Sphere(_) | Self::Capsule(_) => None,
            Self::Cuboid(_, features)
            | Self::ConvexHull(_, features)
            | Self::TriangleSurface(_, features) => Some(&features.bends),
            Self::Heightfield(terrain) => Some(terrain.bends()),
        }
    }

    /// Returns whether this is a surface whose vertices move.
    pub fn deforms(&self) -> bool {
        matches!(self, Self::TriangleSurface(surface, _) if surface.deforms())
    }

    /// Returns the shape if it is one of the solids whose distance takes no search.
    pub fn solid(&self) -> Option<&dyn SignedDistance> {
        match self {
            Self::HalfSpace(solid) => Some(solid),
            Self::Sphere(solid) => Some(solid),
            Self::Capsule(solid) => Some(solid),
            Self::Cuboid(solid, _) => Some(solid),
            Self::ConvexHull(..) | Self::TriangleSurface(..) | Self::Heightfield(_) => None,
        }
    }

    /// Returns how deep a point is inside [m]: 0 or less outside, beside a heightfield and for
    /// triangle surfaces, which have two sides.
    pub fn depth(&self, p: Vec3) -> f32 {
        let distance = match self {
            Self::ConvexHull(body, _) => body.largest_distance(p),
            Self::Heightfield(terrain) => terrain.signed_distance(p).map_or(0.0, |one| one.0),
            _ => self.solid().map_or(0.0, |solid| solid.signed_distance(p).0),
        };
        -distance
    }

    /// Returns how far the center of a solid lies below a point of its surface along the outward
    /// direction [m]; infinity for shapes without a center.
    pub fn depth_of_center(&self, surface_point: Vec3, outward: Vec3) -> f32 {
        match self {
            Self::Cuboid(..) => surface_point.dot(outward),
            Self::ConvexHull(body, _) => (surface_point - body.bounds().center()).dot(outward),
            _ => f32::INFINITY,
        }
    }

    /// Returns a shape that contains this one and whose distance is cheap to compute.
    pub fn distance_bound(&self) -> DistanceBound {
        match self {
            Self::HalfSpace(_) => DistanceBound::HalfSpace,
            Self::Heightfield(terrain) => DistanceBound::Below(terrain.bounds().high.y),
            Self::Sphere(sphere) => DistanceBound::Capsule(0.0, 0.0, sphere.radius),
            Self::Capsule(capsule) => {
                let [bottom, top] = capsule.ends();
                let radius = max(bottom.radius, top.radius);
                let (middle, half_height) = capsule.axis();
                DistanceBound::Capsule(middle, half_height, radius)
            }
            Self::Cuboid(..) | Self::ConvexHull(..) | Self::TriangleSurface(..) => {
                let bounds = self.bounds();
                DistanceBound::Box(bounds.center(), bounds.half_extents())
            }
        }
    }
}

/// A simple shape that contains a collision shape: the distance of a point from it is a lower bound
/// of the distance from the shape itself.
#[derive(Clone, Copy, Debug)]
pub(crate) enum DistanceBound {
    /// The half space y ≤ 0. Only the end position of a particle counts: a particle that ends above
    /// the plane is free, whatever its path was.
    HalfSpace,
    /// All points below a height [m].
    Below(f32),
    /// A capsule along the y axis: y of its middle, from there to the ends of its axis, radius [m]; a
    /// sphere around the origin has no axis.
    Capsule(f32, f32, f32),
    /// A box: center and half extents [m].
    Box(Vec3, Vec3),
}
