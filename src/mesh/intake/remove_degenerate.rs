//! Sifting: triangles without an area and repeated ones are left out.

use crate::error::{Error, Result};
use crate::math::sort::sort;
use glam::Vec3;

/// A triangle whose height is at most this share of its longest edge has no area but by rounding.
const MIN_RELATIVE_HEIGHT: f64 = 1.0e-6;

/// What is left of some triangles.
#[derive(Clone, Debug)]
pub(super) struct KeptTriangles {
    /// Their numbers, lowest first.
    pub triangles: Vec<u32>,
    /// How many had no area.
    pub degenerate: u32,
    /// How many had the corners of an earlier one.
    pub duplicates: u32,
}

/// Sifts triangles, as they are and as welding leaves them.
pub(super) fn remove_degenerate(
    positions: &[Vec3],
    given: &[[u32; 3]],
    welded: &[u32],
) -> Result<KeptTriangles> {
    let mut kept = Vec::with_capacity(given.len());
    for (at, corners) in given.iter().enumerate() {
        let joined = corners.map(|v| welded[v as usize]);
        if is_degenerate(positions, corners) || is_degenerate(positions, &joined) {
            continue;
        }
        if !area(joined.map(|v| positions[v as usize])).is_finite() {
            return Err(Error::BadMesh {
                at: at as u32,
                must: "leave every triangle an area that is finite",
            });
        }
        kept.push(at as u32);
    }
    let degenerate = (given.len() - kept.len()) as u32;
    let mut sorted: Vec<([u32; 3], u32)> = kept
        .iter()
        .map(|at| (*at, given[*at as usize]))
        .map(|(at, corners)| {
            let mut corners = corners.map(|v| welded[v as usize]);
            sort(&mut corners);
            (corners, at)
        })
        .collect();
    sort(&mut sorted);
    sorted.dedup_by_key(|(corners, _)| *corners);
    let duplicates = (kept.len() - sorted.len()) as u32;
    if duplicates > 0 {
        kept = sorted.into_iter().map(|(_, at)| at).collect();
        sort(&mut kept);
    }
    if kept.is_empty() {
        return Err(Error::BadMesh { at: 0, must: "hold at least one triangle with an area" });
    }
    Ok(KeptTriangles { triangles: kept, degenerate, duplicates })
}

/// Whether a triangle names a vertex twice or has no area.
pub(super) fn is_degenerate(positions: &[Vec3], corners: &[u32; 3]) -> bool {
    let [a, b, c] = *corners;
    if a == b || b == c || c == a {
        return true;
    }
    let corner_positions = corners.map(|v| positions[v as usize]);
    let [a, b, c] = corner_positions.map(|x| x.as_dvec3());
    let longest = [b - a, c - b, a - c].iter().fold(0.0_f64, |longest, edge| {
        let squared = edge.length_squared();
        if squared > longest { squared } else { longest }
    });
    // What rounds to nothing in the numbers of the solver is nothing too.
    (b - a).cross(c - a).length() <= MIN_RELATIVE_HEIGHT * longest || area(corner_positions) == 0.0
}

/// Twice the area [m²].
fn area([a, b, c]: [Vec3; 3]) -> f32 {
    (b - a).cross(c - a).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slivers_by_rounding_are_degenerate_and_thin_triangles_are_not() {
        let thin = |height: f32| [Vec3::ZERO, Vec3::X, Vec3::new(0.5, height, 0.0)];
        assert!(is_degenerate(&thin(0.0), &[0, 1, 2]));
        assert!(is_degenerate(&thin(5.0e-7), &[0, 1, 2]));
        assert!(!is_degenerate(&thin(2.0e-6), &[0, 1, 2]));
        assert!(is_degenerate(&thin(1.0), &[0, 1, 1]));
    }

    #[test]
    fn the_first_of_equal_triangles_stays_whichever_way_it_winds() {
        let corner_positions = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE];
        let triangles = [[1, 2, 3], [0, 1, 2], [2, 1, 0], [1, 1, 2], [1, 2, 0]];
        let kept_triangles =
            remove_degenerate(&corner_positions, &triangles, &[0, 1, 2, 3]).unwrap();
        assert_eq!(
            (kept_triangles.triangles, kept_triangles.degenerate, kept_triangles.duplicates),
            (vec![0, 1], 1, 2)
        );
    }

    #[test]
    fn welding_may_leave_a_triangle_without_an_area() {
        let corner_positions =
            [Vec3::ZERO, Vec3::X, Vec3::new(0.5, 1.0e-3, 0.0), Vec3::X * 0.5, Vec3::Y];
        let kept_triangles =
            remove_degenerate(&corner_positions, &[[0, 1, 4], [0, 1, 2]], &[0, 1, 3, 3, 4])
                .unwrap();
        assert_eq!((kept_triangles.triangles, kept_triangles.degenerate), (vec![0], 1));
    }
}
