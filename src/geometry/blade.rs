//! A blade: the parallelogram that a segment sweeps.

use glam::{DVec3, Vec3};

/// A parallelogram from `corner` along `edge` and `sweep`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blade {
    corner: DVec3,
    edge: DVec3,
    sweep: DVec3,
    /// Across both, as long as the area.
    normal: DVec3,
}

/// The sine of the angle that the segment and its sweep have at least.
const LEAST_SINE: f64 = 1.0e-4;

impl Blade {
    /// The segment `from`–`to` swept along `sweep`; `None` if that is not a parallelogram.
    pub fn new(from: Vec3, to: Vec3, sweep: Vec3) -> Option<Self> {
        let (corner, sweep) = (from.as_dvec3(), sweep.as_dvec3());
        let edge = to.as_dvec3() - corner;
        let normal = edge.cross(sweep);
        let is_flat = normal.length() <= LEAST_SINE * edge.length() * sweep.length();
        (!is_flat).then_some(Self { corner, edge, sweep, normal })
    }

    /// On which side of the blade's plane a point is; the distance from it times the blade's area.
    pub fn side(&self, x: Vec3) -> f64 {
        (x.as_dvec3() - self.corner).dot(self.normal)
    }

    /// Whether a point of the plane is on the blade, its rim included.
    pub fn holds(&self, x: DVec3) -> bool {
        let way = x - self.corner;
        let area2 = self.normal.length_squared();
        let along = way.cross(self.sweep).dot(self.normal);
        let down = self.edge.cross(way).dot(self.normal);
        let inside = |at: f64| (0.0..=area2).contains(&at);
        inside(along) && inside(down)
    }

    /// Where the blade crosses the way from `a` to `b`, as a share of it; not at its ends.
    pub fn crossing(&self, a: Vec3, b: Vec3) -> Option<f64> {
        let (at_a, at_b) = (self.side(a), self.side(b));
        if !((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) {
            return None;
        }
        let share = at_a / (at_a - at_b);
        let (a, b) = (a.as_dvec3(), b.as_dvec3());
        self.holds(a + (b - a) * share).then_some(share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blade_crosses_what_goes_through_its_parallelogram_and_nothing_else() {
        let blade = Blade::new(Vec3::ZERO, Vec3::X * 2.0, Vec3::new(1.0, 3.0, 0.0)).unwrap();
        let share = |x: f32, y: f32| blade.crossing(Vec3::new(x, y, -1.0), Vec3::new(x, y, 3.0));
        assert_eq!(share(1.0, 1.0), Some(0.25));
        assert_eq!(share(2.9, 2.9), Some(0.25));
        assert_eq!(share(0.1, 2.9), None, "left of the slanted rim");
        assert_eq!(share(1.0, -0.1), None);
        assert_eq!(blade.crossing(Vec3::ONE, Vec3::new(1.0, 1.0, 2.0)), None, "on one side");
    }

    #[test]
    fn what_is_not_a_parallelogram_is_no_blade() {
        let one = Vec3::new(0.3, -2.0, 1.0e9);
        assert!(Blade::new(one, one, Vec3::X).is_none());
        assert!(Blade::new(one, Vec3::ZERO, Vec3::ZERO).is_none());
        assert!(Blade::new(Vec3::ZERO, Vec3::X, Vec3::X * -4.0).is_none());
        assert!(Blade::new(Vec3::ZERO, Vec3::X * 1.0e30, Vec3::Y * 1.0e-30).is_some());
    }
}
