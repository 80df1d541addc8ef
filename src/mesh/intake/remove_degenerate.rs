//! Removal of degenerate triangles (no area) and duplicates.
//!
//! A triangle is degenerate if its height is at most 10⁻⁶ of its longest edge, before or after
//! welding.

use crate::error::{Error, Result};
use crate::math::sort::sort;
use glam::Vec3;

/// A triangle with a height of at most this share of its longest edge is degenerate.
const MIN_RELATIVE_HEIGHT: f64 = 1.0e-6;

/// The triangles that remain.
#[derive(Clone, Debug)]
pub(super) struct KeptTriangles {
    /// Their numbers in the given list, ascending.
    pub triangles: Vec<u32>,
    /// Number of removed triangles without area.
    pub degenerate: u32,
    /// Number of removed triangles with the corners of an earlier one.
    pub duplicates: u32,
}

/// Returns the triangles that are not degenerate, as given and after welding, without duplicates.
/// `welded[v]` is the vertex that vertex v was welded to.
///
/// # Errors
/// `BadMesh` if an area is not finite or no triangle remains.
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
    // An area that rounds to zero in f32 counts as none, because the solver computes in f32.
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
    fn triangles_flat_up_to_rounding_are_degenerate_and_thin_ones_are_not() {
        let thin = |height: f32| [Vec3::ZERO, Vec3::X, Vec3::new(0.5, height, 0.0)];
        assert!(is_degenerate(&thin(0.0), &[0, 1, 2]));
        assert!(is_degenerate(&thin(5.0e-7), &[0, 1, 2]));
        assert!(!is_degenerate(&thin(2.0e-6), &[0, 1, 2]));
        assert!(is_degenerate(&thin(1.0), &[0, 1, 1]));
    }

    #[test]
    fn the_first_of_duplicate_triangles_is_kept_for_any_winding() {
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
    fn a_triangle_that_welding_makes_degenerate_is_removed() {
        let corner_positions =
            [Vec3::ZERO, Vec3::X, Vec3::new(0.5, 1.0e-3, 0.0), Vec3::X * 0.5, Vec3::Y];
        let kept_triangles =
            remove_degenerate(&corner_positions, &[[0, 1, 4], [0, 1, 2]], &[0, 1, 3, 3, 4])
                .unwrap();
        assert_eq!((kept_triangles.triangles, kept_triangles.degenerate), (vec![0], 1));
    }
}
