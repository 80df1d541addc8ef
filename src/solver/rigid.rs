//! The motion of a solid body: a shift and a turn about the centre of mass.

use crate::math::columns::Columns;
use crate::math::trig::{cos, sin};
use glam::{Mat3, Vec3};

/// How a body moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RigidMotion {
    center: Vec3,
    shift: Vec3,
    turn: Vec3,
}

impl RigidMotion {
    /// The rigid motion with the momentum and angular momentum of the ways of some particles at `x`.
    pub fn fit<I: Iterator<Item = usize>>(
        particles: impl Fn() -> I,
        x: &Columns,
        way: impl Fn(usize) -> Vec3,
        mass: &[f32],
    ) -> Self {
        Self::of_points(|| particles().map(|i| (x.at(i), way(i), mass[i])))
    }

    /// The same of points, each where it is, its way, and its mass.
    pub fn of_points<I: Iterator<Item = (Vec3, Vec3, f32)>>(points: impl Fn() -> I) -> Self {
        let (mut total, mut center, mut shift) = (0.0, Vec3::ZERO, Vec3::ZERO);
        for (x, way, mass) in points() {
            total += mass;
            center += x * mass;
            shift += way * mass;
        }
        if total <= 0.0 {
            return Self { center, shift: Vec3::ZERO, turn: Vec3::ZERO };
        }
        (center, shift) = (center * (1.0 / total), shift * (1.0 / total));
        let (mut spin, mut inertia) = (Vec3::ZERO, Mat3::ZERO);
        for (x, way, mass) in points() {
            let r = x - center;
            spin += r.cross(way - shift) * mass;
            let r2 = r.length_squared();
            let columns = [r * r.x, r * r.y, r * r.z];
            let axes = [Vec3::X, Vec3::Y, Vec3::Z];
            let solid = |axis: usize| (axes[axis] * r2 - columns[axis]) * mass;
            inertia.x_axis += solid(0);
            inertia.y_axis += solid(1);
            inertia.z_axis += solid(2);
        }
        Self { center, shift, turn: solve(&inertia, spin) }
    }

    /// How far a point moves with the body, as if it turned by little.
    pub fn at(&self, point: Vec3) -> Vec3 {
        self.shift + self.turn.cross(point - self.center)
    }

    /// Where a point gets to with the body, however far that turns: distances stay as they are.
    pub fn place(&self, point: Vec3) -> Vec3 {
        let (r, angle) = (point - self.center, self.turn.length());
        let mut turned = r;
        if angle > 0.0 {
            let axis = self.turn * (1.0 / angle);
            let (sin, cos) = (sin(f64::from(angle)), cos(f64::from(angle)));
            turned = r * cos + axis.cross(r) * sin + axis * (axis.dot(r) * (1.0 - cos));
        }
        self.center + self.shift + turned
    }
}

/// Cramer's rule; nothing if the matrix has no inverse to speak of.
fn solve(m: &Mat3, v: Vec3) -> Vec3 {
    let det = m.x_axis.dot(m.y_axis.cross(m.z_axis));
    let size = m.x_axis.x + m.y_axis.y + m.z_axis.z;
    if det <= 1.0e-6 * size * size * size {
        return Vec3::ZERO;
    }
    Vec3::new(
        v.dot(m.y_axis.cross(m.z_axis)),
        m.x_axis.dot(v.cross(m.z_axis)),
        m.x_axis.dot(m.y_axis.cross(v)),
    ) * (1.0 / det)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_that_turns_far_keeps_its_size() {
        let mut x = Columns::default();
        let corners = [Vec3::ZERO, Vec3::X, Vec3::new(0.3, 2.0, 0.0), Vec3::new(0.1, 0.4, 1.0)];
        corners.iter().for_each(|corner| x.push(*corner));
        let turn = |r: Vec3, share: f32| Vec3::new(0.4, -0.3, 0.8).cross(r) * share + Vec3::X;
        let fit = |share: f32| {
            RigidMotion::fit(|| 0..4, &x, |i| turn(corners[i], share), &[1.0, 2.0, 0.5, 1.0])
        };
        let (far, near) = (fit(1.0), fit(0.01));
        let placed = corners.map(|corner| far.place(corner));
        for i in 0..4 {
            assert!((far.at(corners[i]) - turn(corners[i], 1.0)).length() < 1.0e-5);
            let apart = |at: &[Vec3; 4]| at[i].distance(at[(i + 1) % 4]);
            assert!((apart(&placed) - apart(&corners)).abs() < 1.0e-6);
            let little = corners[i] + turn(corners[i], 0.01);
            assert!(near.place(corners[i]).distance(little) < 1.0e-4, "a small turn is straight");
        }
    }
}
