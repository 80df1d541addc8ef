//! Convex hulls of points, by incremental construction.
//!
//! The hull starts as a tetrahedron of points that are far apart. Each further point removes the
//! triangles that it sees (it lies in front of their planes), and new triangles join the point to
//! the horizon, the boundary of the hole (O'Rourke, "Computational Geometry in C", 1998, ch. 4).
//! The arithmetic is f64, with a tolerance relative to the size of the point set.
//!
//! Reads the points; returns new lists.
//! Invariant: every point lies in the hull up to the tolerance, and triangles wind outward.

use crate::geometry::aabb::Aabb;
use crate::geometry::polyhedron::{FacePlane, Polyhedron};
use glam::{DVec3, Vec3};

/// Distances below this fraction of the size of the point set count as zero.
const TOLERANCE: f64 = 1.0e-6;

/// A triangle of the hull under construction.
#[derive(Clone, Copy, Debug)]
struct HullTriangle {
    corners: [u32; 3],
    normal: DVec3,
    offset: f64,
}

/// Returns the convex hull of points as face planes and as triangles of point indices; `None` if
/// the points lie in one plane.
pub(crate) fn build(points: &[Vec3]) -> Option<(Polyhedron, Vec<[u32; 3]>)> {
    let bounds = Aabb::from_points(points.iter().copied());
    let at: Vec<DVec3> = points.iter().map(|point| point.as_dvec3()).collect();
    let tolerance = TOLERANCE * f64::from(bounds.half_extents().length());
    let mut triangles = initial_tetrahedron(&at, tolerance)?;
    for (point, x) in at.iter().enumerate() {
        let is_visible =
            |triangle: &HullTriangle| x.dot(triangle.normal) - triangle.offset > tolerance;
        let mut horizon = Vec::new();
        for triangle in triangles.iter().filter(|triangle| is_visible(triangle)) {
            let [a, b, c] = triangle.corners;
            for edge in [[a, b], [b, c], [c, a]] {
                // An edge of two removed triangles lies inside the hole.
                let back = [edge[1], edge[0]];
                match horizon.iter().position(|other| *other == back) {
                    Some(other) => _ = horizon.swap_remove(other),
                    None => horizon.push(edge),
                }
            }
        }
        if horizon.is_empty() {
            continue;
        }
        triangles.retain(|triangle| !is_visible(triangle));
        triangles.extend(
            horizon.into_iter().filter_map(|[a, b]| hull_triangle(&at, [a, b, point as u32])),
        );
    }
    let indices = triangles.iter().map(|triangle| triangle.corners).collect();
    Some((merge_coplanar(&triangles, bounds), indices))
}

fn hull_triangle(at: &[DVec3], corners: [u32; 3]) -> Option<HullTriangle> {
    let [a, b, c] = corners.map(|i| at[i as usize]);
    let normal = (b - a).cross(c - a);
    let length = normal.length();
    (length > 0.0).then(|| {
        let normal = normal * (1.0 / length);
        HullTriangle { corners, normal, offset: normal.dot(a) }
    })
}

/// Returns a tetrahedron of points that are far apart; `None` if all points lie in one plane.
fn initial_tetrahedron(at: &[DVec3], tolerance: f64) -> Option<Vec<HullTriangle>> {
    let farthest = |from: &dyn Fn(DVec3) -> f64| {
        let far = at.iter().map(|x| from(*x)).enumerate();
        far.fold((0, 0.0), |most, one| if one.1 > most.1 { one } else { most })
    };
    let a = 0_usize;
    let (b, distance) = farthest(&|x| (x - at[a]).length());
    if distance <= tolerance {
        return None;
    }
    let along = (at[b] - at[a]) * (1.0 / distance);
    let (c, distance) = farthest(&|x| (x - at[a]).cross(along).length());
    if distance <= tolerance {
        return None;
    }
    let first = hull_triangle(at, [a as u32, b as u32, c as u32])?;
    let (d, distance) = farthest(&|x| (x.dot(first.normal) - first.offset).abs());
    if distance <= tolerance {
        return None;
    }
    let [a, b, c, d] = [a, b, c, d].map(|i| i as u32);
    let is_below = at[d as usize].dot(first.normal) < first.offset;
    let (b, c) = if is_below { (b, c) } else { (c, b) };
    [[a, b, c], [a, d, b], [b, d, c], [c, d, a]].into_iter().map(|f| hull_triangle(at, f)).collect()
}

/// Returns the face planes of the hull, one for all triangles in one plane.
fn merge_coplanar(triangles: &[HullTriangle], bounds: Aabb) -> Polyhedron {
    let mut faces: Vec<HullTriangle> = Vec::new();
    for triangle in triangles {
        if !faces.iter().any(|face| triangle.normal.dot(face.normal) > 1.0 - 1.0e-9) {
            faces.push(*triangle);
        }
    }
    let faces = faces
        .iter()
        .map(|face| FacePlane { normal: face.normal.as_vec3(), offset: face.offset as f32 })
        .collect();
    Polyhedron { faces, bounds }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::features::ShapeFeatures;

    fn box_points() -> Vec<Vec3> {
        let both = [-1.0, 1.0];
        both.into_iter()
            .flat_map(|x| {
                both.into_iter().flat_map(move |y| both.map(|z| Vec3::new(x, 2.0 * y, 3.0 * z)))
            })
            .collect()
    }

    fn distance(body: &Polyhedron, p: Vec3) -> f32 {
        body.faces.iter().map(|face| face.distance(p)).fold(f32::NEG_INFINITY, f32::max)
    }

    #[test]
    fn the_hull_of_the_corners_of_a_box_is_the_box() {
        let mut points = box_points();
        points.extend([Vec3::ZERO, Vec3::new(1.0, 0.3, 0.2), Vec3::new(0.9, -1.9, 2.9)]);
        let (hull, triangles) = build(&points).unwrap();
        assert_eq!((hull.faces.len(), triangles.len()), (6, 12));
        let features = ShapeFeatures::build(&points, &triangles, true).features;
        assert_eq!((features.edges.len(), features.vertices.len()), (12, 8));
        for i in 0..100 {
            let wave = |k: f32| (i as f32 * k).sin() * 4.0;
            let p = Vec3::new(wave(1.3), wave(0.7), wave(2.1));
            let exact = (p.abs() - Vec3::new(1.0, 2.0, 3.0)).max_element();
            assert!((distance(&hull, p) - exact).abs() < 1.0e-5);
        }
    }

    #[test]
    fn a_hull_contains_all_points_and_its_vertices_lie_on_its_surface() {
        let points: Vec<Vec3> = (0..300)
            .map(|i| {
                let wave = |k: f32| (i as f32 * k).sin();
                Vec3::new(wave(1.37), wave(2.11), wave(0.73)) * (0.2 + 0.8 * wave(3.3).abs())
            })
            .collect();
        let (hull, triangles) = build(&points).unwrap();
        assert!(points.iter().all(|p| distance(&hull, *p) < 1.0e-5));
        let mut corners = triangles.as_flattened().to_vec();
        assert!(corners.iter().all(|i| distance(&hull, points[*i as usize]) > -1.0e-5));
        corners.sort_unstable();
        corners.dedup();
        // Euler's formula.
        assert_eq!(2 * corners.len(), triangles.len() + 4);
    }

    #[test]
    fn flat_points_have_no_hull() {
        let flat: Vec<Vec3> = box_points().into_iter().map(|p| p.with_y(0.5)).collect();
        assert!(build(&flat).is_none());
        assert!(build(&[Vec3::ONE; 5]).is_none());
        let line: Vec<Vec3> = (0..5).map(|i| Vec3::X * i as f32).collect();
        assert!(build(&line).is_none());
    }
}
