//! The convex hull of points.

use crate::geometry::aabb::Aabb;
use crate::geometry::polyhedron::{Face, Polyhedron};
use glam::{DVec3, Vec3};

/// Points less far apart than this share of the size of all are one, or in one plane.
const FLAT: f64 = 1.0e-6;

/// A triangle of the hull in the making.
#[derive(Clone, Copy, Debug)]
struct Facet {
    corners: [u32; 3],
    normal: DVec3,
    offset: f64,
}

/// The least convex body that holds all points, and the triangles of its surface; nothing if they lie in a plane.
///
/// One point after the other: what it sees of the body goes, and the rim of that is joined to it.
pub(crate) fn build(points: &[Vec3]) -> Option<(Polyhedron, Vec<[u32; 3]>)> {
    let bounds = Aabb::from_points(points.iter().copied());
    let at: Vec<DVec3> = points.iter().map(|point| point.as_dvec3()).collect();
    let hair = FLAT * f64::from(bounds.half_extents().length());
    let mut facets = first_four(&at, hair)?;
    for (point, x) in at.iter().enumerate() {
        let sees = |facet: &Facet| x.dot(facet.normal) - facet.offset > hair;
        let mut rim = Vec::new();
        for facet in facets.iter().filter(|facet| sees(facet)) {
            let [a, b, c] = facet.corners;
            for edge in [[a, b], [b, c], [c, a]] {
                // An edge that both its triangles give is inside.
                let back = [edge[1], edge[0]];
                match rim.iter().position(|other| *other == back) {
                    Some(other) => _ = rim.swap_remove(other),
                    None => rim.push(edge),
                }
            }
        }
        if rim.is_empty() {
            continue;
        }
        facets.retain(|facet| !sees(facet));
        facets.extend(rim.into_iter().filter_map(|[a, b]| facet(&at, [a, b, point as u32])));
    }
    let triangles = facets.iter().map(|facet| facet.corners).collect();
    Some((body(&facets, bounds), triangles))
}

fn facet(at: &[DVec3], corners: [u32; 3]) -> Option<Facet> {
    let [a, b, c] = corners.map(|i| at[i as usize]);
    let normal = (b - a).cross(c - a);
    let length = normal.length();
    (length > 0.0).then(|| {
        let normal = normal * (1.0 / length);
        Facet { corners, normal, offset: normal.dot(a) }
    })
}

/// Four points that are not in a plane, as far apart as may be.
fn first_four(at: &[DVec3], hair: f64) -> Option<Vec<Facet>> {
    let farthest = |from: &dyn Fn(DVec3) -> f64| {
        let far = at.iter().map(|x| from(*x)).enumerate();
        far.fold((0, 0.0), |most, one| if one.1 > most.1 { one } else { most })
    };
    let a = 0_usize;
    let (b, apart) = farthest(&|x| (x - at[a]).length());
    if apart <= hair {
        return None;
    }
    let along = (at[b] - at[a]) * (1.0 / apart);
    let (c, apart) = farthest(&|x| (x - at[a]).cross(along).length());
    if apart <= hair {
        return None;
    }
    let first = facet(at, [a as u32, b as u32, c as u32])?;
    let (d, apart) = farthest(&|x| (x.dot(first.normal) - first.offset).abs());
    if apart <= hair {
        return None;
    }
    let [a, b, c, d] = [a, b, c, d].map(|i| i as u32);
    let is_below = at[d as usize].dot(first.normal) < first.offset;
    let (b, c) = if is_below { (b, c) } else { (c, b) };
    [[a, b, c], [a, d, b], [b, d, c], [c, d, a]].into_iter().map(|f| facet(at, f)).collect()
}

/// Joins facets in one plane.
fn body(facets: &[Facet], bounds: Aabb) -> Polyhedron {
    let mut faces: Vec<Facet> = Vec::new();
    for facet in facets {
        if !faces.iter().any(|face| facet.normal.dot(face.normal) > 1.0 - 1.0e-9) {
            faces.push(*facet);
        }
    }
    let faces = faces
        .iter()
        .map(|face| Face { normal: face.normal.as_vec3(), offset: face.offset as f32 })
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

    fn nearest(body: &Polyhedron, p: Vec3) -> f32 {
        body.faces.iter().map(|face| face.distance(p)).fold(f32::NEG_INFINITY, f32::max)
    }

    #[test]
    fn the_hull_of_a_boxs_corners_is_the_box() {
        let mut points = box_points();
        points.extend([Vec3::ZERO, Vec3::new(1.0, 0.3, 0.2), Vec3::new(0.9, -1.9, 2.9)]);
        let (hull, triangles) = build(&points).unwrap();
        assert_eq!((hull.faces.len(), triangles.len()), (6, 12));
        let relief = ShapeFeatures::build(&points, &triangles, true).features;
        assert_eq!((relief.ridges.len(), relief.corners.len()), (12, 8));
        for i in 0..100 {
            let wave = |k: f32| (i as f32 * k).sin() * 4.0;
            let p = Vec3::new(wave(1.3), wave(0.7), wave(2.1));
            let exact = (p.abs() - Vec3::new(1.0, 2.0, 3.0)).max_element();
            assert!((nearest(&hull, p) - exact).abs() < 1.0e-5);
        }
    }

    #[test]
    fn a_hull_holds_all_its_points_and_is_touched_by_its_corners() {
        let points: Vec<Vec3> = (0..300)
            .map(|i| {
                let wave = |k: f32| (i as f32 * k).sin();
                Vec3::new(wave(1.37), wave(2.11), wave(0.73)) * (0.2 + 0.8 * wave(3.3).abs())
            })
            .collect();
        let (hull, triangles) = build(&points).unwrap();
        assert!(points.iter().all(|p| nearest(&hull, *p) < 1.0e-5));
        let mut corners = triangles.as_flattened().to_vec();
        assert!(corners.iter().all(|i| nearest(&hull, points[*i as usize]) > -1.0e-5));
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
