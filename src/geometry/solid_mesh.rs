//! The inside of a closed triangle mesh.
//!
//! ```text
//! cos = n · (p − q) / |p − q|        q: closest point of the mesh to p, n: normal of its triangle
//! ```
//! A point is inside if it lies behind the closest triangle. If several triangles are equally close,
//! because they share the closest edge or vertex, the one with the largest |cos| decides.
//!
//! Reads positions and triangles; writes nothing.
//! Invariant: only a mesh with every edge in two triangles, once in each direction, has an inside.

use crate::geometry::closest_points::{interpolate, triangle_to_origin};
use crate::geometry::features::weld_positions;
use crate::math::sort::sort_groups;
use glam::Vec3;

/// Squares of distances that differ by no more than this share count as equal.
const TIE: f32 = 1.0e-4;

/// Returns 1 if the normals of a closed, consistently wound mesh point outward, and −1 if they point
/// inward; `None` if it is not closed or not consistently wound.
pub(crate) fn orientation(positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<f32> {
    let welded = weld_positions(positions);
    let (mut sides, mut volume) = (Vec::new(), 0.0);
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| welded[i as usize]);
        sides.extend([[a, b], [b, c], [c, a]].map(|[from, to]| [from.min(to), from.max(to), from]));
        let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
        volume += a.dot(b.cross(c));
    }
    sort_groups(&mut sides, |[low, ..]| *low);
    let is_whole = |same: &[[u32; 3]]| same.len() == 2 && same[0][2] != same[1][2];
    let is_closed = sides.chunk_by(|a, b| a[..2] == b[..2]).all(is_whole);
    is_closed.then_some(if volume < 0.0 { -1.0 } else { 1.0 })
}

/// A query for the closest point of a mesh, among the triangles that it visits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClosestPointQuery {
    point: Vec3,
    /// The square of the largest distance that counts [m²].
    limit: f32,
    /// The square of the distance of the closest triangle [m²]; infinite if there is none.
    squared: f32,
    /// The closest point, and the normal of its triangle by the right-hand rule.
    closest: Vec3,
    normal: Vec3,
    /// The cosine of the angle between the normal and the direction to the point.
    cosine: f32,
}

impl ClosestPointQuery {
    /// Makes a query for a point, up to `distance` [m].
    pub fn new(point: Vec3, distance: f32) -> Self {
        let (limit, squared) = (distance * distance, f32::INFINITY);
        Self { point, limit, squared, closest: Vec3::ZERO, normal: Vec3::ZERO, cosine: 0.0 }
    }

    /// The point, and the square of the distance to search [m²].
    pub fn start(&self) -> (Vec3, f32) {
        (self.point, self.limit)
    }

    /// Visits a triangle. Returns the square of the distance [m²] to search from then on.
    #[inline(never)]
    pub fn visit(&mut self, corners: [Vec3; 3]) -> f32 {
        let relative = corners.map(|corner| corner - self.point);
        let offset = interpolate(relative, triangle_to_origin(relative));
        let squared = offset.length_squared();
        if squared <= self.limit && squared <= self.squared * (1.0 + TIE) {
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let area = normal.length();
            let normal = normal * if area > 0.0 { 1.0 / area } else { 0.0 };
            let cosine = if squared > 0.0 { -offset.dot(normal) / squared.sqrt() } else { 0.0 };
            let is_nearer = squared < self.squared * (1.0 - TIE);
            if is_nearer || cosine.abs() > self.cosine.abs() {
                (self.closest, self.normal, self.cosine) = (self.point + offset, normal, cosine);
            }
            if squared < self.squared {
                self.squared = squared;
            }
        }
        let least = if self.squared < self.limit { self.squared } else { self.limit };
        least * (1.0 + TIE)
    }

    /// Returns the closest point and the direction to it, of length one, if the point is inside a mesh of
    /// this orientation.
    pub fn if_inside(&self, orientation: f32) -> Option<(Vec3, Vec3)> {
        if self.squared == f32::INFINITY || self.cosine * orientation >= 0.0 {
            return None;
        }
        let offset = self.closest - self.point;
        let length = offset.length();
        Some((self.closest, if length > 0.0 { offset * (1.0 / length) } else { self.normal }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [Vec3; 4] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

    #[test]
    fn only_a_closed_consistently_wound_mesh_has_an_inside() {
        assert_eq!(orientation(&CORNERS, &FACES), Some(1.0));
        assert_eq!(orientation(&CORNERS, &FACES.map(|[a, b, c]| [a, c, b])), Some(-1.0));
        assert_eq!(orientation(&CORNERS, &FACES[..3]), None);
        let mut mixed = FACES;
        mixed[3].swap(0, 1);
        assert_eq!(orientation(&CORNERS, &mixed), None);
    }

    #[test]
    fn points_beside_faces_edges_and_corners_are_told_inside_from_outside() {
        let find = |point: Vec3, distance: f32| {
            let mut query = ClosestPointQuery::new(point, distance);
            for face in FACES {
                query.visit(face.map(|i| CORNERS[i as usize]));
            }
            query.if_inside(1.0)
        };
        let inside = find(Vec3::new(0.2, 0.1, 0.3), 1.0);
        assert!(inside.is_some_and(|(closest, out)| {
            (closest - Vec3::new(0.2, 0.0, 0.3)).length() < 1.0e-6
                && (out - Vec3::NEG_Y).length() < 1.0e-5
        }));
        assert!(find(Vec3::new(0.2, 0.1, 0.3), 0.05).is_none());
        // Outside a face, two edges and a corner, all of them at acute angles.
        for x in [-0.1, 1.1] {
            assert!(find(Vec3::new(x, 0.2, 0.2), 1.0).is_none());
            assert!(find(Vec3::new(x, -0.01, -0.01), 1.0).is_none());
            assert!(find(Vec3::new(x, 0.0, 0.0), 1.0).is_none());
        }
        assert!(find(Vec3::new(0.98, 0.005, 0.005), 1.0).is_some());
    }
}
