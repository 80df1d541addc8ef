//! A blade for cuts: the parallelogram that a segment sweeps out.
//!
//! ```text
//!  from ────── to
//!   │ sweep     │        normal = (to − from) × sweep
//!   ▼           ▼
//!   ·───────────·
//! ```
//! A segment a–b crosses the blade if a and b lie strictly on different sides of its plane and the
//! crossing point lies on the parallelogram. All arithmetic is f64, so that the side tests of a
//! shared point agree.
//!
//! Reads only its own fields and the points that it is given, and writes nothing.
//! Invariant: the parallelogram has an area; [`Blade::new`] refuses any other.

use glam::{DVec3, Vec3};

/// The parallelogram with one corner at `corner` and the sides `edge` and `sweep` [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blade {
    corner: DVec3,
    edge: DVec3,
    sweep: DVec3,
    /// The normal; its length is the area [m²].
    normal: DVec3,
}

/// The smallest allowed sine of the angle between the segment and its sweep.
const MIN_SINE: f64 = 1.0e-4;

impl Blade {
    /// Makes the blade that the segment `from`–`to` sweeps along `sweep` [m]; `None` if it has no
    /// area.
    pub fn new(from: Vec3, to: Vec3, sweep: Vec3) -> Option<Self> {
        let (corner, sweep) = (from.as_dvec3(), sweep.as_dvec3());
        let edge = to.as_dvec3() - corner;
        let normal = edge.cross(sweep);
        let is_flat = normal.length() <= MIN_SINE * edge.length() * sweep.length();
        (!is_flat).then_some(Self { corner, edge, sweep, normal })
    }

    /// Returns the signed distance of a point from the plane of the blade times the area [m³].
    pub fn signed_side(&self, x: Vec3) -> f64 {
        (x.as_dvec3() - self.corner).dot(self.normal)
    }

    /// Returns whether a point of the plane lies on the blade, boundary included.
    pub fn contains(&self, x: DVec3) -> bool {
        let r = x - self.corner;
        let area2 = self.normal.length_squared();
        let along = r.cross(self.sweep).dot(self.normal);
        let down = self.edge.cross(r).dot(self.normal);
        let inside = |at: f64| (0.0..=area2).contains(&at);
        inside(along) && inside(down)
    }

    /// Returns where the blade crosses the segment from `a` to `b`, as a fraction of it in 0..1;
    /// `None` if it does not, or if an end lies on the plane.
    pub fn segment_crossing(&self, a: Vec3, b: Vec3) -> Option<f64> {
        let (at_a, at_b) = (self.signed_side(a), self.signed_side(b));
        if !((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) {
            return None;
        }
        let fraction = at_a / (at_a - at_b);
        let (a, b) = (a.as_dvec3(), b.as_dvec3());
        self.contains(a + (b - a) * fraction).then_some(fraction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blade_crosses_only_segments_through_its_parallelogram() {
        let blade = Blade::new(Vec3::ZERO, Vec3::X * 2.0, Vec3::new(1.0, 3.0, 0.0)).unwrap();
        let crossing =
            |x: f32, y: f32| blade.segment_crossing(Vec3::new(x, y, -1.0), Vec3::new(x, y, 3.0));
        assert_eq!(crossing(1.0, 1.0), Some(0.25));
        assert_eq!(crossing(2.9, 2.9), Some(0.25));
        assert_eq!(crossing(0.1, 2.9), None, "left of the slanted side");
        assert_eq!(crossing(1.0, -0.1), None);
        assert_eq!(
            blade.segment_crossing(Vec3::ONE, Vec3::new(1.0, 1.0, 2.0)),
            None,
            "both ends on one side"
        );
    }

    #[test]
    fn a_parallelogram_without_area_is_refused() {
        let one = Vec3::new(0.3, -2.0, 1.0e9);
        assert!(Blade::new(one, one, Vec3::X).is_none());
        assert!(Blade::new(one, Vec3::ZERO, Vec3::ZERO).is_none());
        assert!(Blade::new(Vec3::ZERO, Vec3::X, Vec3::X * -4.0).is_none());
        assert!(Blade::new(Vec3::ZERO, Vec3::X * 1.0e30, Vec3::Y * 1.0e-30).is_some());
    }
}
