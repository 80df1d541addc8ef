//! A surface of triangles: both its sides are outside, and there is no inside.

use crate::geometry::aabb::Aabb;
use crate::geometry::bvh::Bvh;
use crate::geometry::closest_points::{interpolate, triangle_to_origin};
use crate::math::TINY;
use glam::Vec3;

/// Triangles that stay where they are, in a tree.
#[derive(Clone, Debug)]
pub(crate) struct TriangleSurface {
    facets: Vec<SurfaceTriangle>,
    tree: Bvh,
}

/// One of its triangles.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceTriangle {
    pub corners: [Vec3; 3],
    /// Of length one.
    pub normal: Vec3,
}

/// A way that passes by a triangle this close, as a share of its size, still hits it: where triangles meet
/// there is no gap.
const RIM: f32 = 1.0e-5;

/// The triangles that have an area.
pub(crate) fn non_degenerate(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let has_area = |triangle: &&[u32; 3]| {
        let [a, b, c] = triangle.map(|i| positions[i as usize]);
        (b - a).cross(c - a).length() > 0.0
    };
    triangles.iter().filter(has_area).copied().collect()
}

impl TriangleSurface {
    /// Of triangles that have an area; nothing without any.
    pub fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<Self> {
        let mut facets = Vec::new();
        for triangle in triangles {
            let corners = triangle.map(|i| positions[i as usize]);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            facets.push(SurfaceTriangle { corners, normal: normal * (1.0 / normal.length()) });
        }
        let bounds: Vec<Aabb> =
            facets.iter().map(|facet| Aabb::from_points(facet.corners)).collect();
        (!facets.is_empty()).then(|| Self { tree: Bvh::over(&bounds), facets })
    }

    pub fn bounds(&self) -> Aabb {
        self.tree.bounds()
    }

    /// Adds the facets within `reach` of a point.
    pub fn find_near(&self, point: Vec3, reach: f32, found: &mut Vec<u32>) {
        let place = Aabb { low: point - Vec3::splat(reach), high: point + Vec3::splat(reach) };
        let is_near = |facet: &u32| {
            let SurfaceTriangle { corners, normal } = &self.facets[*facet as usize];
            let height = (point - corners[0]).dot(*normal);
            // Negated, so that to what is not a number all is near.
            let is_far = height.abs() > reach || {
                let corners = corners.map(|corner| corner - point);
                interpolate(corners, triangle_to_origin(corners)).length_squared() > reach * reach
            };
            !is_far
        };
        found.extend(self.tree.near(place).filter(is_near));
    }
}

/// A surface near a point: the facets that may be there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch<'a> {
    pub surface: &'a TriangleSurface,
    pub facets: &'a [u32],
}

impl Patch<'_> {
    fn facets(&self) -> impl Iterator<Item = &SurfaceTriangle> {
        self.facets.iter().map(|facet| &self.surface.facets[*facet as usize])
    }

    /// Where the way from one point to another first goes through, and the way back out from there.
    pub fn strike(&self, from: Vec3, to: Vec3) -> Option<(Vec3, Vec3)> {
        let way = to - from;
        let mut first: Option<(f32, Vec3)> = None;
        for facet in self.facets() {
            let fall = way.dot(facet.normal);
            let above = (from - facet.corners[0]).dot(facet.normal);
            let still_above = (to - facet.corners[0]).dot(facet.normal);
            if above * still_above > 0.0 {
                continue;
            }
            // From above down, or from below up.
            if fall * above >= 0.0 {
                continue;
            }
            let share = -above / fall;
            let is_past = share.is_nan() || share > 1.0;
            if is_past || first.is_some_and(|(before, _)| before <= share) {
                continue;
            }
            let at = facet.corners.map(|corner| corner - (from + way * share));
            let miss = interpolate(at, triangle_to_origin(at)).length_squared();
            let size = (at[1] - at[0]).length_squared() + (at[2] - at[0]).length_squared();
            if miss <= RIM * RIM * size {
                first = Some((share, if above > 0.0 { facet.normal } else { -facet.normal }));
            }
        }
        first.map(|(share, out)| (from + way * share, out))
    }

    /// How far a point is, if nearer than `reach`, and the way out from its closest point there: to
    /// the side where it is, or that of `from` if it is on the surface.
    pub fn closest(&self, point: Vec3, from: Vec3, reach: f32) -> Option<(f32, Vec3)> {
        let mut least = (reach * reach, None);
        for facet in self.facets() {
            // No facet is nearer than its plane.
            let own = (point - facet.corners[0]).dot(facet.normal);
            if own * own >= least.0 {
                continue;
            }
            let corners = facet.corners.map(|corner| corner - point);
            let weights = triangle_to_origin(corners);
            let at = interpolate(corners, weights);
            let distance2 = at.length_squared();
            if distance2 < least.0 {
                let length = distance2.sqrt();
                let height = if own.abs() > TINY {
                    own
                } else {
                    (from - facet.corners[0]).dot(facet.normal)
                };
                let out = if height > 0.0 { facet.normal } else { -facet.normal };
                // Over a facet its normal is exact, where a short way from it is not.
                let is_beside = weights.iter().any(|w| *w <= 0.0) && length > TINY;
                let found =
                    if is_beside { (length, at * (-1.0 / length)) } else { (own.abs(), out) };
                least = (distance2, Some(found));
            }
        }
        least.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square in the plane y = 0 of two triangles, and a wall along one of its sides.
    fn corner() -> TriangleSurface {
        let positions =
            [Vec3::ZERO, Vec3::Z, Vec3::X + Vec3::Z, Vec3::X, Vec3::Y, Vec3::Y + Vec3::Z];
        TriangleSurface::new(&positions, &[[0, 1, 2], [0, 2, 3], [0, 4, 1], [1, 4, 5]]).unwrap()
    }

    /// The part of a surface that is near two places.
    fn patch(surface: &TriangleSurface, from: Vec3, to: Vec3) -> Vec<u32> {
        let mut facets = Vec::new();
        surface.find_near((from + to) * 0.5, (to - from).length() + 0.2, &mut facets);
        facets
    }

    fn strike(surface: &TriangleSurface, from: Vec3, to: Vec3) -> Option<(Vec3, Vec3)> {
        Patch { surface, facets: &patch(surface, from, to) }.strike(from, to)
    }

    #[test]
    fn a_way_through_is_struck_where_it_goes_in_first() {
        let surface = corner();
        let (at, out) =
            strike(&surface, Vec3::new(0.5, 0.5, 0.5), Vec3::new(0.5, -0.5, 0.5)).unwrap();
        assert_eq!((at, out), (Vec3::new(0.5, 0.0, 0.5), Vec3::Y));
        let (_, out) =
            strike(&surface, Vec3::new(0.5, -0.5, 0.4), Vec3::new(0.5, 0.5, 0.4)).unwrap();
        assert_eq!(out, Vec3::NEG_Y);
        let (_, out) =
            strike(&surface, Vec3::new(0.2, 0.4, 0.4), Vec3::new(-0.6, -0.6, 0.4)).unwrap();
        assert_eq!(out, Vec3::X);
        assert!(strike(&surface, Vec3::new(1.5, 0.5, 0.5), Vec3::new(1.5, -0.5, 0.5)).is_none());
        assert!(strike(&surface, Vec3::new(0.5, 0.5, 0.5), Vec3::new(0.5, 0.1, 0.5)).is_none());
    }

    #[test]
    fn nothing_slips_through_between_triangles() {
        let surface = corner();
        for i in 1..1000 {
            let on_diagonal = Vec3::new(i as f32, 0.0, i as f32) * 1.0e-3;
            let lean = Vec3::new(0.1, 1.0, -0.07);
            assert!(
                strike(&surface, on_diagonal + lean, on_diagonal - lean).is_some(),
                "at {i} mm"
            );
        }
    }

    #[test]
    fn the_closest_point_is_on_the_nearest_facet() {
        let surface = corner();
        let closest = |x, y| {
            let p = Vec3::new(x, y, 0.5);
            let facets = patch(&surface, p, p);
            Patch { surface: &surface, facets: &facets }.closest(p, Vec3::Y, 0.2)
        };
        let (distance, out) = closest(0.3, 0.1).unwrap();
        assert!((distance - 0.1).abs() < 1.0e-6 && (out - Vec3::Y).length() < 1.0e-6);
        let (distance, out) = closest(1.1, 0.1).unwrap();
        let aslant = Vec3::new(1.0, 1.0, 0.0);
        assert!((out * distance - aslant * 0.1).length() < 1.0e-6, "{distance} m, {out}");
        assert!(closest(0.5, 0.3).is_none());
    }
}
