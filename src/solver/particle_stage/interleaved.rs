//! Interleaved particle layout: x, y, z and inverse mass of a particle side by side.
//!
//! ```text
//! columns (SoA)      x x x x …   y y y y …   z z z z …   w w w w …
//! interleaved        x y z w | x y z w | x y z w | …                  one `Float4` per particle
//! ```
//! Kernels that access particles by index (pairs of vertices, edges and triangles) read one cache
//! line per particle from this layout, not four. Conversions transpose blocks of `Baseline::LANES`
//! particles.
//!
//! Reads and writes the lists that the caller passes in; the lists never shrink their capacity.
//!
//! Invariant: each particle is computed on its own, so its result does not depend on which block it
//! is in.

use crate::math::columns::Columns;
use crate::math::simd::{Baseline, Float, Scalar, Simd, transpose_4x4};
use crate::math::wide4::{Float4, Wide4, xyz};
use crate::solver::integrate::rigid_motion::RigidMotion;
use core::array;
use glam::Vec3;

/// Adds a displacement to the position of a particle.
#[inline(always)]
pub(crate) fn translate(particle: &mut Float4, by: Vec3) {
    particle[0] += by.x;
    particle[1] += by.y;
    particle[2] += by.z;
}

/// Adds the first three numbers of `by` to the position of a particle; its inverse mass stays.
#[inline(always)]
pub(crate) fn translate_wide(particle: &mut Float4, by: Wide4) {
    (Wide4::load(particle) + by.xyz0()).store(particle);
}

/// Runs `$work` for blocks of `$simd.LANES` particles from index `$i` on, until all `$count` are
/// done.
///
/// The last block may overlap the one before it, so `$work` must give the same result when it runs
/// twice.
macro_rules! for_blocks {
    ($count:expr, |$simd:ident, $i:ident| $work:expr) => {
        if $count < Baseline::LANES {
            let $simd = Scalar;
            for $i in 0..$count {
                $work;
            }
        } else {
            let ($simd, last) = (Baseline::new(), $count - Baseline::LANES);
            let mut $i = 0;
            loop {
                $work;
                if $i == last {
                    break;
                }
                $i = last.min($i + Baseline::LANES);
            }
        }
    };
}

/// Loads a block of particles from index `i` on as four columns: x, y, z, w. A block has four lanes
/// or one.
#[inline(always)]
fn load_columns<S: Simd>(s: S, particles: &[Float4], i: usize) -> [S::F; 4] {
    let particles = &particles[i..i + S::LANES];
    if S::LANES == 1 {
        return array::from_fn(|k| s.load(&particles[0], k));
    }
    transpose_4x4(s, array::from_fn(|k| s.load(&particles[k], 0)))
}

/// Stores four columns as a block of particles from index `i` on.
#[inline(always)]
fn store_columns<S: Simd>(s: S, particles: &mut [Float4], i: usize, columns: [S::F; 4]) {
    let particles = &mut particles[i..i + S::LANES];
    if S::LANES == 1 {
        columns
            .into_iter()
            .enumerate()
            .for_each(|(k, number)| s.store(&mut particles[0], k, number));
        return;
    }
    for (particle, row) in particles.iter_mut().zip(transpose_4x4(s, columns)) {
        s.store(particle, 0, row);
    }
}

/// Fills `particles` with positions and inverse masses.
pub(crate) fn gather(particles: &mut Vec<Float4>, x: &Columns, w: &[f32]) {
    particles.resize(w.len(), [0.0; 4]);
    let [x, y, z] = x.slices();
    for_blocks!(w.len(), |s, i| {
        let columns = [s.load(x, i), s.load(y, i), s.load(z, i), s.load(w, i)];
        store_columns(s, particles, i, columns);
    });
}

/// Writes the positions of `particles` back to columns.
pub(crate) fn scatter(particles: &[Float4], x: &mut Columns) {
    let [x, y, z] = x.slices_mut();
    for_blocks!(particles.len(), |s, i| {
        let [new_x, new_y, new_z, _] = load_columns(s, particles, i);
        s.store(x, i, new_x);
        s.store(y, i, new_y);
        s.store(z, i, new_z);
    });
}

/// Writes `to - from` of each particle to `displacements` [m].
pub(crate) fn compute_displacements(from: &[Float4], to: &[Float4], displacements: &mut Columns) {
    displacements.resize(to.len());
    let [x, y, z] = displacements.slices_mut();
    for_blocks!(to.len(), |s, i| {
        let (from, to) = (load_columns(s, from, i), load_columns(s, to, i));
        s.store(x, i, to[0] - from[0]);
        s.store(y, i, to[1] - from[1]);
        s.store(z, i, to[2] - from[2]);
    });
}

/// Writes each particle, moved back by its displacement under a rigid motion, to `out`.
pub(crate) fn subtract_rigid_motion(
    particles: &[Float4],
    motion: &RigidMotion,
    out: &mut [Float4],
) {
    for_blocks!(particles.len(), |s, i| {
        let [x, y, z, w] = load_columns(s, particles, i);
        let by = motion.displacement_lanes(s, [x, y, z]);
        store_columns(s, out, i, [x - by[0], y - by[1], z - by[2], w]);
    });
}

/// Fills `vectors` with a vector per particle (a velocity or a displacement), less the one that a
/// rigid motion has at its position `x`. The fourth number is 0.
pub(crate) fn gather_relative(
    motion: &RigidMotion,
    x: &Columns,
    columns: &Columns,
    vectors: &mut Vec<Float4>,
) {
    let [x, y, z] = x.slices();
    let columns = columns.slices();
    vectors.resize(x.len(), [0.0; 4]);
    for_blocks!(x.len(), |s, i| {
        let by = motion.displacement_lanes(s, [s.load(x, i), s.load(y, i), s.load(z, i)]);
        let mut relative = [s.splat(0.0); 4];
        for axis in 0..3 {
            relative[axis] = s.load(columns[axis], i) - by[axis];
        }
        store_columns(s, vectors, i, relative);
    });
}

/// Writes vectors from [`gather_relative`] back to columns: adds the rigid motion again.
pub(crate) fn scatter_relative(
    motion: &RigidMotion,
    x: &Columns,
    vectors: &[Float4],
    columns: &mut Columns,
) {
    let [x, y, z] = x.slices();
    let columns = columns.slices_mut();
    for_blocks!(x.len(), |s, i| {
        let by = motion.displacement_lanes(s, [s.load(x, i), s.load(y, i), s.load(z, i)]);
        let relative = load_columns(s, vectors, i);
        for axis in 0..3 {
            s.store(columns[axis], i, relative[axis] + by[axis]);
        }
    });
}

/// The mean displacement of all particles [m].
pub(crate) fn mean_displacement(from: &[Float4], to: &[Float4]) -> Vec3 {
    let mut sums = [[0.0_f32; 4]; 4];
    let (from4, to4) = (from.chunks_exact(4), to.chunks_exact(4));
    let rest = from4.remainder().iter().zip(to4.remainder());
    for (from, to) in from4.zip(to4) {
        for k in 0..4 {
            for c in 0..4 {
                sums[k][c] += to[k][c] - from[k][c];
            }
        }
    }
    let rest = rest.fold(Vec3::ZERO, |sum, (from, to)| sum + (xyz(to) - xyz(from)));
    let total = sums.iter().fold(rest, |sum, part| sum + xyz(part));
    total * (1.0 / from.len() as f32)
}

/// Computes the motion bound of each particle: a box around its displacement from `start` to `now`
/// [m].
///
/// Half the size of the box is `share` times the length of the displacement relative to `mean`,
/// plus `slack`. The lower corner goes to `low`, the upper one to `high`.
pub(crate) fn compute_motion_bounds(
    [start, now]: [&[Float4]; 2],
    [low, high]: [&mut [Float4]; 2],
    mean: Vec3,
    [share, slack]: [f32; 2],
) {
    for_blocks!(now.len(), |s, i| {
        let (before, after) = (load_columns(s, start, i), load_columns(s, now, i));
        let displacement = [0, 1, 2].map(|axis| after[axis] - before[axis]);
        let [x, y, z] = [0, 1, 2].map(|axis| displacement[axis] - s.splat(mean[axis]));
        let relative = Float::sqrt(x * x + y * y + z * z);
        let half = relative * s.splat(share) + s.splat(slack);
        let [x, y, z] = displacement;
        store_columns(s, low, i, [x - half, y - half, z - half, s.splat(0.0)]);
        store_columns(s, high, i, [x + half, y + half, z + half, s.splat(0.0)]);
    });
}

/// Whether any particle has zero inverse mass.
pub(crate) fn has_fixed_particle(particles: &[Float4]) -> bool {
    particles.iter().any(|particle| particle[3] <= 0.0)
}

/// The centre of mass of particles, given as positions and inverse masses; none may be fixed.
pub(crate) fn center_of_mass(particles: impl Iterator<Item = (Vec3, f32)>) -> Vec3 {
    let (mut sum, mut total) = ([0.0_f64; 3], 0.0_f64);
    for (x, w) in particles {
        let mass = 1.0 / f64::from(w);
        total += mass;
        for (sum, x) in sum.iter_mut().zip(x.to_array()) {
            *sum += mass * f64::from(x);
        }
    }
    Vec3::from_array(sum.map(|sum| (sum / total) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn block_passes_equal_one_particle_at_a_time_for_any_count() {
        for count in 0..10 {
            let number = |i: usize, k: usize| ((i * 7 + k * 13) % 31) as f32 / 7.0 - 2.0;
            let vector = |i: usize, k: usize| Vec3::new(number(i, k), number(i, k + 1), -0.0);
            let mut zeros = Columns::default();
            zeros.resize(count);
            let [mut x, mut velocities, mut out] = [(); 3].map(|()| zeros.clone());
            let w: Vec<f32> = (0..count).map(|i| number(i, 5)).collect();
            for i in 0..count {
                x.set(i, vector(i, 0));
                velocities.set(i, vector(i, 3));
            }
            let motion = RigidMotion::of_points(&|add| {
                (0..count).for_each(|i| add(vector(i, 0), vector(i, 3), 1.0));
            });
            let [mut particles, mut relative] = [(); 2].map(|()| Vec::new());
            gather(&mut particles, &x, &w);
            gather_relative(&motion, &x, &velocities, &mut relative);
            compute_displacements(&particles, &relative, &mut out);
            for i in 0..count {
                let v = vector(i, 3) - motion.displacement_at(vector(i, 0));
                let expected = with(vector(i, 0), w[i]);
                assert_eq!(particles[i].map(f32::to_bits), expected, "{i} of {count}");
                assert_eq!(relative[i].map(f32::to_bits), with(v, 0.0), "{i} of {count}");
                assert_eq!(bits(out.get(i)), bits(v - vector(i, 0)), "{i} of {count}");
            }
            scatter_relative(&motion, &x, &relative, &mut velocities);
            subtract_rigid_motion(&particles, &motion, &mut relative);
            scatter(&relative, &mut out);
            for i in 0..count {
                let rigid = motion.displacement_at(vector(i, 0));
                let v = (vector(i, 3) - rigid) + rigid;
                assert_eq!(bits(velocities.get(i)), bits(v), "{i} of {count}");
                assert_eq!(bits(out.get(i)), bits(vector(i, 0) - rigid), "{i} of {count}");
                assert_eq!(relative[i][3].to_bits(), w[i].to_bits(), "{i} of {count}");
            }
        }
    }

    fn bits(v: Vec3) -> [u32; 3] {
        v.to_array().map(f32::to_bits)
    }

    fn with(v: Vec3, w: f32) -> [u32; 4] {
        v.extend(w).to_array().map(f32::to_bits)
    }
}
