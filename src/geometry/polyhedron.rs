//! Convex bodies by their faces.

use crate::geometry::aabb::Aabb;
use crate::geometry::shape::SignedDistance;
use glam::Vec3;

/// A convex body with flat faces.
#[derive(Clone, Debug)]
pub(crate) struct Polyhedron {
    pub faces: Vec<Face>,
    pub bounds: Aabb,
}

/// What lies below a plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// Out, of length one.
    pub normal: Vec3,
    /// How far out of the origin the plane is.
    pub offset: f32,
}

impl Face {
    #[inline(always)]
    pub fn distance(&self, p: Vec3) -> f32 {
        p.dot(self.normal) - self.offset
    }
}

impl Polyhedron {
    /// Adds the faces that may be the foremost for a point within `reach` of `p`.
    pub fn find_foremost(&self, p: Vec3, reach: f32, found: &mut Vec<u32>) {
        let most = self.faces.iter().map(|face| face.distance(p));
        // A face comes nearer by `reach` at most, and the foremost goes as far.
        let least = most.fold(f32::NEG_INFINITY, f32::max) - 2.0 * reach;
        let may = |(_, face): &(usize, &Face)| face.distance(p) >= least;
        found.extend(self.faces.iter().enumerate().filter(may).map(|(at, _)| at as u32));
    }
}

/// A convex body near a point: the faces that may be the foremost there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foremost<'a> {
    pub body: &'a Polyhedron,
    pub faces: &'a [u32],
}

impl SignedDistance for Foremost<'_> {
    /// Beyond ridges and corners this is the distance from the foremost face's plane, which is less than
    /// that from the body: bodies keep their sharp ridges at any distance.
    fn nearest(&self, p: Vec3) -> (f32, Vec3) {
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
    fn the_faces_found_for_a_point_are_enough_for_all_around_it() {
        let faces: Vec<Face> = (0..200)
            .map(|i| {
                let wave = |k: f32| (i as f32 * k).sin();
                let normal = Vec3::new(wave(1.3), wave(2.7), wave(0.6)).normalize();
                Face { normal, offset: 1.0 + 0.1 * wave(5.1) }
            })
            .collect();
        let all: Vec<u32> = (0..200).collect();
        let body = Polyhedron { faces, bounds: Aabb::EMPTY };
        for i in 0..50 {
            let wave = |k: f32| (i as f32 * k).cos();
            let p = Vec3::new(wave(1.1), wave(0.4), wave(2.9)) * 1.2;
            let mut found = Vec::new();
            body.find_foremost(p, 0.05, &mut found);
            assert!(found.len() < 100, "{} of 200 faces may be the foremost", found.len());
            for way in [Vec3::X, Vec3::NEG_Y, Vec3::Z] {
                let at = p + way * 0.05;
                let nearest = |faces| Foremost { body: &body, faces }.nearest(at);
                assert_eq!(nearest(&found), nearest(&all));
            }
        }
    }
}
