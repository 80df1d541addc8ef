//! Stage `Predict`: where each particle would go by itself.
//!
//! Second-order backward differences (BDF2), which lose next to no energy where the first-order
//! velocities of plain position-based dynamics lose most of it:
//!
//! ```text
//! x* = x + (x - x_prev) / 3 + 2/3 h v + 4/9 h² a
//! ```
//! English and Bridson, "Animating developable surfaces using nonconforming elements", 2008, sec. 3.

use super::World;
use crate::math::columns::Columns;
use crate::math::max;
use glam::{Mat3, Vec3};

/// Moves every free particle; `scratch.start` keeps where it was.
pub(crate) fn advance(world: &mut World) {
    let h = world.settings.substep();
    let p = &mut world.particles;
    let a = &world.scratch.acceleration;
    world.scratch.start.copy_from(&p.x);
    let mut farthest = 0.0;
    for (x, x_prev, v, a) in [
        (&mut p.x.x, &p.x_prev.x, &p.v.x, &a.x),
        (&mut p.x.y, &p.x_prev.y, &p.v.y, &a.y),
        (&mut p.x.z, &p.x_prev.z, &p.v.z, &a.z),
    ] {
        farthest = max(advance_column(x, x_prev, v, a, &p.w, h), farthest);
    }
    // Per component, so that this is no less than a third of the square of the longest move.
    let reach = world.reach();
    if 3.0 * farthest * farthest > reach * reach {
        clamp_displacement(world, reach);
    }
}

fn advance_column(x: &mut [f32], x_prev: &[f32], v: &[f32], a: &[f32], w: &[f32], h: f32) -> f32 {
    let (h23, h49) = (h * (2.0 / 3.0), h * h * (4.0 / 9.0));
    let mut farthest = 0.0;
    for ((((x, x_prev), v), a), w) in x.iter_mut().zip(x_prev).zip(v).zip(a).zip(w) {
        let step = (*x - x_prev) * (1.0 / 3.0) + v * h23 + a * h49;
        let step = if *w > 0.0 { step } else { 0.0 };
        *x += step;
        farthest = max(step.abs(), farthest);
    }
    farthest
}

/// Keeps each move within `reach` of the cloth's own rigid motion, so that a violent yank is
/// absorbed and yet a cloth may fall, fly and spin as fast as it likes.
fn clamp_displacement(world: &mut World, reach: f32) {
    let p = &mut world.particles;
    let start = &world.scratch.start;
    let rigid = RigidMotion::fit(start, &p.x, &p.mass, &p.w);
    for i in 0..p.len() {
        if p.w[i] <= 0.0 {
            continue;
        }
        let from = start.at(i);
        let common = rigid.at(from);
        let own = p.x.at(i) - from - common;
        let length2 = own.length_squared();
        if length2 > reach * reach {
            p.x.set(i, from + common + own * (reach / length2.sqrt()));
        }
    }
}

/// The motion of a solid body: a shift and a small turn about the centre.
struct RigidMotion {
    center: Vec3,
    shift: Vec3,
    turn: Vec3,
}

impl RigidMotion {
    /// The rigid motion with the momentum and angular momentum of all moves.
    fn fit(start: &Columns, end: &Columns, mass: &[f32], w: &[f32]) -> Self {
        let free = || (0..mass.len()).filter(|i| w[*i] > 0.0);
        let (mut total, mut center, mut shift) = (0.0, Vec3::ZERO, Vec3::ZERO);
        for i in free() {
            total += mass[i];
            center += start.at(i) * mass[i];
            shift += (end.at(i) - start.at(i)) * mass[i];
        }
        if total <= 0.0 {
            return Self { center, shift: Vec3::ZERO, turn: Vec3::ZERO };
        }
        (center, shift) = (center * (1.0 / total), shift * (1.0 / total));
        let (mut spin, mut inertia) = (Vec3::ZERO, Mat3::ZERO);
        for i in free() {
            let r = start.at(i) - center;
            spin += r.cross(end.at(i) - start.at(i) - shift) * mass[i];
            let r2 = r.length_squared();
            let columns = [r * r.x, r * r.y, r * r.z];
            let axes = [Vec3::X, Vec3::Y, Vec3::Z];
            let solid = |axis: usize| (axes[axis] * r2 - columns[axis]) * mass[i];
            inertia.x_axis += solid(0);
            inertia.y_axis += solid(1);
            inertia.z_axis += solid(2);
        }
        Self { center, shift, turn: solve(&inertia, spin) }
    }

    /// How far a point moves with the body.
    fn at(&self, point: Vec3) -> Vec3 {
        self.shift + self.turn.cross(point - self.center)
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
