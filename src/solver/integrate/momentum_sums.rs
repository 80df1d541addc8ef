//! Sums over all free particles of a cloth: mass, linear and angular momentum, moment of inertia.
//!
//! ```text
//! Σ m   Σ m x   Σ m d               r = x − c
//! Σ m r × (d − t)   Σ m (r² 1 − r rᵀ)
//! ```
//! d is a displacement, a velocity or an acceleration; c and t are given, commonly the means of x
//! and d.
//!
//! Reads positions, displacements and masses; writes nothing.
//! Invariant: the sums use eight lanes in a fixed order, so the bits do not depend on the SIMD
//! level.

use crate::math::columns::Columns;
use crate::math::simd::{Float, LANES, LaneArray, Level, Scalar, Simd, vectored};
use glam::{DVec3, Mat3, Vec3};

/// All particles: positions, displacements, masses and inverse masses. The sums skip those with
/// zero inverse mass.
#[derive(Clone, Copy)]
pub(crate) struct FreeParticles<'a> {
    pub x: [&'a [f32]; 3],
    pub displacement: [&'a [f32]; 3],
    pub mass: &'a [f32],
    pub w: &'a [f32],
}

impl<'a> FreeParticles<'a> {
    /// The particles of a range.
    #[inline(always)]
    fn slice(&self, from: usize, to: usize) -> Self {
        let Self { x, displacement, mass, w } = *self;
        let [x, displacement] = [x, displacement]
            .map(|columns: [&'a [f32]; 3]| columns.map(|column| &column[from..to]));
        Self { x, displacement, mass: &mass[from..to], w: &w[from..to] }
    }

    /// Positions, displacements and masses in lanes; the mass of a held particle is 0.
    #[inline(always)]
    fn load<S: Simd>(&self, s: S, at: usize) -> ([S::F; 3], [S::F; 3], S::F) {
        let ([x, y, z], [dx, dy, dz]) = (self.x, self.displacement);
        (
            [s.load(x, at), s.load(y, at), s.load(z, at)],
            [s.load(dx, at), s.load(dy, at), s.load(dz, at)],
            s.select_or_zero(s.load(self.w, at), s.load(self.mass, at)),
        )
    }
}

/// Sums of masses [kg], of positions times mass, and of displacements times mass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinearSums {
    pub mass: f32,
    pub center: Vec3,
    pub momentum: Vec3,
}

impl LinearSums {
    pub fn of(level: Level, free: FreeParticles<'_>) -> Self {
        let mut sums = [[0.0; LANES]; 7];
        sum_momentum(level, free, &mut sums);
        let [mass, x, y, z, dx, dy, dz] = sums.map(sum_of_lanes);
        Self { mass, center: Vec3::new(x, y, z), momentum: Vec3::new(dx, dy, dz) }
    }
}

/// The angular momentum of displacements less `mean[1]`, and the moment of inertia, both about
/// `mean[0]`.
pub(crate) fn spin_and_inertia(
    level: Level,
    free: FreeParticles<'_>,
    mean: [Vec3; 2],
) -> (Vec3, Mat3) {
    let mut sums = [[0.0; LANES]; 9];
    sum_angular_momentum(level, free, mean.map(|v| v.to_array()), &mut sums);
    let [x, y, z, xx, yy, zz, xy, yz, zx] = sums.map(sum_of_lanes);
    let inertia = Mat3::from_cols(
        Vec3::new(yy + zz, -xy, -zx),
        Vec3::new(-xy, zz + xx, -yz),
        Vec3::new(-zx, -yz, xx + yy),
    );
    (Vec3::new(x, y, z), inertia)
}

vectored! {
    /// Sums m, m x and m d. Particle i goes to lane i mod 8.
    fn sum_momentum(free: FreeParticles<'_>, sums: &mut [LaneArray; 7])
        = sum_momentum_lanes, sum_momentum_scalar
}

vectored! {
    /// Sums m r × (d − t) and the products of m r, where r leads from the centre of mass.
    fn sum_angular_momentum(free: FreeParticles<'_>, mean: [[f32; 3]; 2], sums: &mut [LaneArray; 9])
        = sum_angular_momentum_lanes, sum_angular_momentum_scalar
}

fn sum_momentum_scalar(free: FreeParticles<'_>, sums: &mut [LaneArray; 7]) {
    sum_momentum_lanes(Scalar, free, sums);
}

fn sum_angular_momentum_scalar(
    free: FreeParticles<'_>,
    mean: [[f32; 3]; 2],
    sums: &mut [LaneArray; 9],
) {
    sum_angular_momentum_lanes(Scalar, free, mean, sums);
}

#[inline(always)]
fn sum_momentum_lanes<S: Simd>(s: S, free: FreeParticles<'_>, sums: &mut [LaneArray; 7]) {
    let count = free.w.len();
    let whole = free.slice(0, count / LANES * LANES);
    for first in (0..LANES).step_by(S::LANES) {
        let mut sum = [s.splat(0.0); 7];
        let mut at = first;
        while at + S::LANES <= whole.w.len() {
            add_momentum(&mut sum, whole.load(s, at));
            at += LANES;
        }
        for (sums, sum) in sums.iter_mut().zip(sum) {
            s.store(sums, first, sum);
        }
    }
    let rest = free.slice(whole.w.len(), count);
    for lane in 0..rest.w.len() {
        let mut sum = sums.map(|sums| sums[lane]);
        add_momentum(&mut sum, rest.load(Scalar, lane));
        sums.iter_mut().zip(sum).for_each(|(sums, sum)| sums[lane] = sum);
    }
}

#[inline(always)]
fn sum_angular_momentum_lanes<S: Simd>(
    s: S,
    free: FreeParticles<'_>,
    [center, translation]: [[f32; 3]; 2],
    sums: &mut [LaneArray; 9],
) {
    let count = free.w.len();
    let whole = free.slice(0, count / LANES * LANES);
    let mean = [
        [s.splat(center[0]), s.splat(center[1]), s.splat(center[2])],
        [s.splat(translation[0]), s.splat(translation[1]), s.splat(translation[2])],
    ];
    for first in (0..LANES).step_by(S::LANES) {
        let mut sum = [s.splat(0.0); 9];
        let mut at = first;
        while at + S::LANES <= whole.w.len() {
            add_angular_momentum(&mut sum, mean, whole.load(s, at));
            at += LANES;
        }
        for (sums, sum) in sums.iter_mut().zip(sum) {
            s.store(sums, first, sum);
        }
    }
    let rest = free.slice(whole.w.len(), count);
    for lane in 0..rest.w.len() {
        let mut sum = sums.map(|sums| sums[lane]);
        add_angular_momentum(&mut sum, [center, translation], rest.load(Scalar, lane));
        sums.iter_mut().zip(sum).for_each(|(sums, sum)| sums[lane] = sum);
    }
}

#[inline(always)]
fn add_momentum<F: Float>(sum: &mut [F; 7], (x, displacement, mass): ([F; 3], [F; 3], F)) {
    sum[0] = sum[0] + mass;
    for axis in 0..3 {
        sum[1 + axis] = sum[1 + axis] + x[axis] * mass;
        sum[4 + axis] = sum[4 + axis] + displacement[axis] * mass;
    }
}

#[inline(always)]
fn add_angular_momentum<F: Float>(
    sum: &mut [F; 9],
    [center, translation]: [[F; 3]; 2],
    (x, displacement, mass): ([F; 3], [F; 3], F),
) {
    let [x, y, z] = [x[0] - center[0], x[1] - center[1], x[2] - center[2]];
    let (dx, dy, dz) = (
        displacement[0] - translation[0],
        displacement[1] - translation[1],
        displacement[2] - translation[2],
    );
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

/// Points with displacements: calls its argument with position, displacement and mass of each. Not
/// generic, since few sums run over points and each copy would cost code size.
pub(crate) type Points<'a> = &'a dyn Fn(&mut dyn FnMut(Vec3, Vec3, f32));

/// Sums over points: of masses, of positions and displacements times mass, and the angular momentum
/// of the displacements about the origin.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PointSums {
    pub mass: f64,
    pub center: DVec3,
    pub momentum: DVec3,
    pub spin: DVec3,
}

impl PointSums {
    pub fn of(points: Points<'_>) -> Self {
        let mut sums = Self::default();
        points(&mut |x, displacement, mass| {
            let (x, mass) = (x.as_dvec3(), f64::from(mass));
            let momentum = displacement.as_dvec3() * mass;
            sums.mass += mass;
            sums.center += x * mass;
            sums.momentum += momentum;
            sums.spin += x.cross(momentum);
        });
        sums
    }

    /// Sums the particles of a list, given columns of all particles.
    pub fn of_columns(list: &[u32], x: &Columns, displacement: &Columns, mass: &[f32]) -> Self {
        Self::of(&|add| {
            for i in list.iter().map(|i| *i as usize) {
                add(x.get(i), displacement.get(i), mass[i]);
            }
        })
    }

    /// The centre of mass [m].
    pub fn mean_position(&self) -> DVec3 {
        if self.mass > 0.0 { self.center / self.mass } else { self.center }
    }
}

/// Sum of all lanes.
fn sum_of_lanes(lanes: LaneArray) -> f32 {
    lanes.into_iter().sum()
}
