//! The motion of a solid body: a shift and a turn about the centre of mass.

use crate::math::columns::Columns;
use crate::math::simd::{Float, LANES, LaneArray, Level, Scalar, Simd, vectored};
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

    /// The same of all particles that are free, of which there may be many.
    pub fn of_free(level: Level, free: Free<'_>) -> Self {
        let mut sums = [[0.0; LANES]; 7];
        sum_ways(level, free, &mut sums);
        let [total, x, y, z, way_x, way_y, way_z] = sums.map(total_of);
        let (center, shift) = (Vec3::new(x, y, z), Vec3::new(way_x, way_y, way_z));
        if total <= 0.0 {
            return Self { center, shift: Vec3::ZERO, turn: Vec3::ZERO };
        }
        let (center, shift) = (center * (1.0 / total), shift * (1.0 / total));
        let mut sums = [[0.0; LANES]; 9];
        sum_turns(level, free, [center.to_array(), shift.to_array()], &mut sums);
        let [spin_x, spin_y, spin_z, xx, yy, zz, xy, yz, zx] = sums.map(total_of);
        let inertia = Mat3::from_cols(
            Vec3::new(yy + zz, -xy, -zx),
            Vec3::new(-xy, zz + xx, -yz),
            Vec3::new(-zx, -yz, xx + yy),
        );
        Self { center, shift, turn: solve(&inertia, Vec3::new(spin_x, spin_y, spin_z)) }
    }

    /// The part of it that leaves a body on a floor with this normal.
    pub fn along(self, normal: Vec3) -> Self {
        let Self { center, shift, turn } = self;
        Self { center, shift: shift - normal * shift.dot(normal), turn: normal * turn.dot(normal) }
    }

    /// How far points move with the body, as `at` has it.
    #[inline(always)]
    pub fn ways<S: Simd>(&self, s: S, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
        let Self { center, shift, turn } = self;
        let (x, y, z) = (x - s.splat(center.x), y - s.splat(center.y), z - s.splat(center.z));
        let (tx, ty, tz) = (s.splat(turn.x), s.splat(turn.y), s.splat(turn.z));
        [
            s.splat(shift.x) + (ty * z - tz * y),
            s.splat(shift.y) + (tz * x - tx * z),
            s.splat(shift.z) + (tx * y - ty * x),
        ]
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

/// All particles: where they are, their ways, masses and inverse masses. Those with none of the last are held.
#[derive(Clone, Copy)]
pub(crate) struct Free<'a> {
    pub x: [&'a [f32]; 3],
    pub way: [&'a [f32]; 3],
    pub mass: &'a [f32],
    pub w: &'a [f32],
}

impl<'a> Free<'a> {
    /// Those in a range.
    #[inline(always)]
    fn all_in(&self, from: usize, to: usize) -> Self {
        let Self { x, way, mass, w } = *self;
        let [x, way] =
            [x, way].map(|columns: [&'a [f32]; 3]| columns.map(|column| &column[from..to]));
        Self { x, way, mass: &mass[from..to], w: &w[from..to] }
    }

    /// Places, ways and masses of some.
    #[inline(always)]
    fn load<S: Simd>(&self, s: S, at: usize) -> ([S::F; 3], [S::F; 3], S::F) {
        let ([x, y, z], [way_x, way_y, way_z]) = (self.x, self.way);
        (
            [s.load(x, at), s.load(y, at), s.load(z, at)],
            [s.load(way_x, at), s.load(way_y, at), s.load(way_z, at)],
            s.select_or_zero(s.load(self.w, at), s.load(self.mass, at)),
        )
    }
}

vectored! {
    /// Sums of masses, and of places and ways by mass. Every eighth particle goes to the same lane.
    fn sum_ways(free: Free<'_>, sums: &mut [LaneArray; 7]) = sum_ways_of, Avx2, sum_ways_apart
}

vectored! {
    /// Sums of spins about a center of mass that moves, and of the products of what leads from there.
    fn sum_turns(free: Free<'_>, mean: [[f32; 3]; 2], sums: &mut [LaneArray; 9])
        = sum_turns_of, Avx2, sum_turns_apart
}

fn sum_ways_apart(free: Free<'_>, sums: &mut [LaneArray; 7]) {
    sum_ways_of(Scalar, free, sums);
}

fn sum_turns_apart(free: Free<'_>, mean: [[f32; 3]; 2], sums: &mut [LaneArray; 9]) {
    sum_turns_of(Scalar, free, mean, sums);
}

#[inline(always)]
fn sum_ways_of<S: Simd>(s: S, free: Free<'_>, sums: &mut [LaneArray; 7]) {
    let count = free.w.len();
    let whole = free.all_in(0, count / LANES * LANES);
    for first in (0..LANES).step_by(S::LANES) {
        let mut sum = [s.splat(0.0); 7];
        let mut at = first;
        while at + S::LANES <= whole.w.len() {
            add_ways(&mut sum, whole.load(s, at));
            at += LANES;
        }
        for (sums, sum) in sums.iter_mut().zip(sum) {
            s.store(sums, first, sum);
        }
    }
    let rest = free.all_in(whole.w.len(), count);
    for lane in 0..rest.w.len() {
        let mut sum = sums.map(|sums| sums[lane]);
        add_ways(&mut sum, rest.load(Scalar, lane));
        sums.iter_mut().zip(sum).for_each(|(sums, sum)| sums[lane] = sum);
    }
}

#[inline(always)]
fn sum_turns_of<S: Simd>(
    s: S,
    free: Free<'_>,
    [center, shift]: [[f32; 3]; 2],
    sums: &mut [LaneArray; 9],
) {
    let count = free.w.len();
    let whole = free.all_in(0, count / LANES * LANES);
    let mean = [
        [s.splat(center[0]), s.splat(center[1]), s.splat(center[2])],
        [s.splat(shift[0]), s.splat(shift[1]), s.splat(shift[2])],
    ];
    for first in (0..LANES).step_by(S::LANES) {
        let mut sum = [s.splat(0.0); 9];
        let mut at = first;
        while at + S::LANES <= whole.w.len() {
            add_turns(&mut sum, mean, whole.load(s, at));
            at += LANES;
        }
        for (sums, sum) in sums.iter_mut().zip(sum) {
            s.store(sums, first, sum);
        }
    }
    let rest = free.all_in(whole.w.len(), count);
    for lane in 0..rest.w.len() {
        let mut sum = sums.map(|sums| sums[lane]);
        add_turns(&mut sum, [center, shift], rest.load(Scalar, lane));
        sums.iter_mut().zip(sum).for_each(|(sums, sum)| sums[lane] = sum);
    }
}

#[inline(always)]
fn add_ways<F: Float>(sum: &mut [F; 7], (x, way, mass): ([F; 3], [F; 3], F)) {
    sum[0] = sum[0] + mass;
    for axis in 0..3 {
        sum[1 + axis] = sum[1 + axis] + x[axis] * mass;
        sum[4 + axis] = sum[4 + axis] + way[axis] * mass;
    }
}

#[inline(always)]
fn add_turns<F: Float>(
    sum: &mut [F; 9],
    [center, shift]: [[F; 3]; 2],
    (x, way, mass): ([F; 3], [F; 3], F),
) {
    let [x, y, z] = [x[0] - center[0], x[1] - center[1], x[2] - center[2]];
    let (dx, dy, dz) = (way[0] - shift[0], way[1] - shift[1], way[2] - shift[2]);
    let (mx, my, mz) = (x * mass, y * mass, z * mass);
    let new = [
        my * dz - mz * dy,
        mz * dx - mx * dz,
        mx * dy - my * dx,
        mx * x,
        my * y,
        mz * z,
        mx * y,
        my * z,
        mz * x,
    ];
    for (sum, new) in sum.iter_mut().zip(new) {
        *sum = *sum + new;
    }
}

/// What all lanes sum up to.
fn total_of(lanes: LaneArray) -> f32 {
    lanes.into_iter().sum()
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
    fn free_particles_move_as_points_do_whatever_the_lanes() {
        let mut number = 0.7_f32;
        let mut next = || {
            number = (number * 1.37 + 0.61) % 3.0;
            number - 1.5
        };
        let count = 67;
        let (mut x, mut way) = (Columns::default(), Columns::default());
        for _ in 0..count {
            x.push(Vec3::new(next(), next(), next()));
            way.push(Vec3::new(next(), next(), next()));
        }
        let mass: Vec<f32> = (0..count).map(|_| 2.0 + next()).collect();
        let w: Vec<f32> =
            (0..count).map(|i| if i % 9 == 4 { 0.0 } else { 1.0 / mass[i] }).collect();
        let free = || (0..count).filter(|i| w[*i] > 0.0);
        let one = RigidMotion::fit(free, &x, |i| way.at(i), &mass);
        let free = Free { x: x.all(), way: way.all(), mass: &mass, w: &w };
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);
        let all: Vec<_> =
            Level::all().into_iter().map(|level| RigidMotion::of_free(level, free)).collect();
        for other in &all {
            for point in [Vec3::ZERO, Vec3::new(1.0, -2.0, 0.5)] {
                assert!((one.at(point) - other.at(point)).length() < 1.0e-4);
                assert_eq!(bits(other.at(point)), bits(all[0].at(point)));
            }
        }
    }

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
