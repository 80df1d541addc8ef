//! Mixed Voronoi areas: the share of a triangle's area that belongs to each of its corners.
//!
//! Meyer, Desbrun, Schröder, Barr, "Discrete differential-geometry operators for triangulated
//! 2-manifolds", 2003, where they are called `A_mixed`:
//!
//! ```text
//! acute:   area(a) = (|ac|² cot β + |ab|² cot γ) / 8
//! obtuse:  half of the area to the obtuse corner, a quarter to each of the others
//! ```
//! Reads three positions, writes nothing.
//! Invariant: the three areas add up to the area of the triangle.

use glam::Vec3;

/// Returns the mixed Voronoi area of each corner of a triangle [m²].
///
/// On a regular grid every interior particle gets the area of one cell, in whichever direction the
/// diagonals run.
pub(crate) fn corner_areas([a, b, c]: [Vec3; 3]) -> [f32; 3] {
    let doubled = (b - a).cross(c - a).length();
    let area = 0.5 * doubled;
    let dots = [(b - a).dot(c - a), (c - b).dot(a - b), (a - c).dot(b - c)];
    if let Some(obtuse) = dots.iter().position(|dot| *dot < 0.0) {
        let share = |corner: usize| {
            if corner == obtuse { 0.5 * area } else { 0.25 * area }
        };
        return [share(0), share(1), share(2)];
    }
    let cotangents = dots.map(|dot| dot / doubled);
    let opposite = [(c - b), (a - c), (b - a)].map(Vec3::length_squared);
    // Each edge at a corner contributes its squared length times the cotangent of the opposite
    // angle.
    let half = |edge: usize| opposite[edge] * cotangents[edge] * 0.125;
    [half(1) + half(2), half(2) + half(0), half(0) + half(1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corner_areas_add_up_and_depend_on_the_angles() {
        let right = corner_areas([Vec3::ZERO, Vec3::X, Vec3::Y]);
        assert_eq!(right, [0.25, 0.125, 0.125]);
        let flat = corner_areas([Vec3::ZERO, Vec3::X * 4.0, Vec3::new(2.0, 0.5, 0.0)]);
        assert_eq!(flat, [0.25, 0.25, 0.5]);
        let sharp = corner_areas([Vec3::ZERO, Vec3::X, Vec3::new(0.4, 0.9, 0.0)]);
        assert!((sharp.iter().sum::<f32>() - 0.45).abs() < 1.0e-6);
    }
}
