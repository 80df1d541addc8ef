//! Convex polyhedra, as the intersection of half spaces.
//!
//! ```text
//! d(p) = max over faces of (n · p − offset)
//! ```
//! Inside, this is the exact distance; outside, beyond edges and vertices, it is a lower bound, so
//! the offset surfaces of a polyhedron keep its sharp edges.
//!
//! Reads its faces and a point in its local frame. Writes face indices to the list of the caller.
//! Invariant: the faces that are collected for a ball of points contain the face of largest
//! distance for every point of that ball.

use crate::geometry::aabb::Aabb;
use crate::geometry::signed_distance::SignedDistance;
use crate::math::max;
use glam::Vec3;

/// A convex polyhedron.
#[derive(Clone, Debug)]
pub(crate) struct Polyhedron {
    pub faces: Vec<FacePlane>,
    pub bounds: Aabb,
}

/// The plane of a face: the polyhedron lies where `normal · p <= offset`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FacePlane {
    /// The outward normal, of length one.
    pub normal: Vec3,
    /// The signed distance of the plane from the origin [m].
    pub offset: f32,
}

impl FacePlane {
    /// Returns the signed distance of a point from the plane [m].
    #[inline(always)]
    pub fn distance(&self, p: Vec3) -> f32 {
        p.dot(self.normal) - self.offset
    }
}

impl Polyhedron {
    /// Returns the bounds [m].
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Returns the largest signed distance of a point from the plane of a face [m].
    pub fn largest_distance(&self, p: Vec3) -> f32 {
        self.faces.iter().fold(f32::NEG_INFINITY, |most, face| max(face.distance(p), most))
    }

    /// Pushes the faces that may have the largest distance for a point within `radius` [m] of `p`.
    pub fn push_candidate_faces(&self, p: Vec3, radius: f32, candidates: &mut Vec<u32>) {
        let distances = self.faces.iter().map(|face| face.distance(p));
        // Within the ball one distance grows and another falls by `radius` at most.
        let least = distances.fold(f32::NEG_INFINITY, f32::max) - 2.0 * radius;
        let is_candidate = |(_, face): &(usize, &FacePlane)| face.distance(p) >= least;
        let indexed = self.faces.iter().enumerate();
        candidates.extend(indexed.filter(is_candidate).map(|(at, _)| at as u32));
    }
}

/// A polyhedron restricted to the candidate faces of one particle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CandidateFaces<'a> {
    pub body: &'a Polyhedron,
    pub faces: &'a [u32],
}

impl SignedDistance for CandidateFaces<'_> {
    /// Returns the largest distance from a face plane: beyond edges and vertices it is less than
    /// the distance from the polyhedron.
    fn signed_distance(&self, p: Vec3) -> (f32, Vec3) {
        let mut most = (f32::NEG_INFINITY, Vec3::Y);
        for face in self.faces {
            let face = &self.body.faces[*face as usize];
            let distance = face.distance(p);
            if distance > most.0 {
                most = (distance, face.normal);
            }
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn candidate_faces_give_the_exact_distance_anywhere_in_their_ball() {
        let faces: Vec<FacePlane> = (0..200)
            .map(|i| {
                let wave = |k: f32| (i as f32 * k).sin();
                let normal = Vec3::new(wave(1.3), wave(2.7), wave(0.6)).normalize();
                FacePlane { normal, offset: 1.0 + 0.1 * wave(5.1) }
            })
            .collect();
        let all: Vec<u32> = (0..200).collect();
        let body = Polyhedron { faces, bounds: Aabb::EMPTY };
        for i in 0..50 {
            let wave = |k: f32| (i as f32 * k).cos();
            let p = Vec3::new(wave(1.1), wave(0.4), wave(2.9)) * 1.2;
            let mut candidates = Vec::new();
            body.push_candidate_faces(p, 0.05, &mut candidates);
            assert!(candidates.len() < 100, "{} of 200 faces are candidates", candidates.len());
            for direction in [Vec3::X, Vec3::NEG_Y, Vec3::Z] {
                let at = p + direction * 0.05;
                let distance = |faces| CandidateFaces { body: &body, faces }.signed_distance(at);
                assert_eq!(distance(&candidates), distance(&all));
            }
        }
    }
}
