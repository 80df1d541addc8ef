//! Particles one after the other, x, y, z and inverse mass of each together: what pairs of anything want.

use crate::math::columns::Columns;
use crate::math::simd::{Baseline, Float, Scalar, Simd, transpose_4x4};
use crate::math::wide4::{Float4, Four, xyz};
use crate::solver::integrate::rigid_motion::RigidMotion;
use core::array;
use glam::Vec3;

/// Moves a particle.
#[inline(always)]
pub(crate) fn shift(spot: &mut Float4, by: Vec3) {
    spot[0] += by.x;
    spot[1] += by.y;
    spot[2] += by.z;
}

/// Moves a particle, and leaves its mass.
#[inline(always)]
pub(crate) fn push(spot: &mut Float4, by: Four) {
    (Four::of(spot) + by.ways()).put(spot);
}

/// Does something for each of so many particles, some side by side: as many from a place on as there are lanes. For
/// some it is done twice.
macro_rules! each {
    ($count:expr, |$simd:ident, $at:ident| $work:expr) => {
        if $count < Baseline::LANES {
            let $simd = Scalar;
            for $at in 0..$count {
                $work;
            }
        } else {
            let ($simd, last) = (Baseline::new(), $count - Baseline::LANES);
            let mut $at = 0;
            loop {
                $work;
                if $at == last {
                    break;
                }
                $at = last.min($at + Baseline::LANES);
            }
        }
    };
}

/// Particles from a place on, turned so that each number has its lanes, of which there are four or one.
#[inline(always)]
fn fetch<S: Simd>(s: S, spots: &[Float4], at: usize) -> [S::F; 4] {
    let spots = &spots[at..at + S::LANES];
    if S::LANES == 1 {
        return array::from_fn(|k| s.load(&spots[0], k));
    }
    transpose_4x4(s, array::from_fn(|k| s.load(&spots[k], 0)))
}

/// Puts them back.
#[inline(always)]
fn put<S: Simd>(s: S, spots: &mut [Float4], at: usize, numbers: [S::F; 4]) {
    let spots = &mut spots[at..at + S::LANES];
    if S::LANES == 1 {
        numbers.into_iter().enumerate().for_each(|(k, number)| s.store(&mut spots[0], k, number));
        return;
    }
    for (spot, row) in spots.iter_mut().zip(transpose_4x4(s, numbers)) {
        s.store(spot, 0, row);
    }
}

/// Makes it the list of these particles.
pub(crate) fn gather(spots: &mut Vec<Float4>, x: &Columns, w: &[f32]) {
    spots.resize(w.len(), [0.0; 4]);
    let [x, y, z] = x.all();
    each!(w.len(), |s, at| {
        put(s, spots, at, [s.load(x, at), s.load(y, at), s.load(z, at), s.load(w, at)]);
    });
}

/// Puts particles back.
pub(crate) fn scatter(spots: &[Float4], x: &mut Columns) {
    let [x, y, z] = x.all_mut();
    each!(spots.len(), |s, at| {
        let [new_x, new_y, new_z, _] = fetch(s, spots, at);
        s.store(x, at, new_x);
        s.store(y, at, new_y);
        s.store(z, at, new_z);
    });
}

/// The ways from one state to another.
pub(crate) fn list_ways(from: &[Float4], to: &[Float4], ways: &mut Columns) {
    ways.resize(to.len());
    let [x, y, z] = ways.all_mut();
    each!(to.len(), |s, at| {
        let (from, to) = (fetch(s, from, at), fetch(s, to, at));
        s.store(x, at, to[0] - from[0]);
        s.store(y, at, to[1] - from[1]);
        s.store(z, at, to[2] - from[2]);
    });
}

/// Where all are without how they move with the whole.
pub(crate) fn take_back(spots: &[Float4], whole: &RigidMotion, to: &mut [Float4]) {
    each!(spots.len(), |s, at| {
        let [x, y, z, w] = fetch(s, spots, at);
        let by = whole.displacement_lanes(s, [x, y, z]);
        put(s, to, at, [x - by[0], y - by[1], z - by[2], w]);
    });
}

/// Lists how particles at `x` move against the whole.
pub(crate) fn gather_against(
    whole: &RigidMotion,
    x: &Columns,
    motion: &Columns,
    ways: &mut Vec<Float4>,
) {
    let [x, y, z] = x.all();
    let motion = motion.all();
    ways.resize(x.len(), [0.0; 4]);
    each!(x.len(), |s, at| {
        let by = whole.displacement_lanes(s, [s.load(x, at), s.load(y, at), s.load(z, at)]);
        let mut way = [s.splat(0.0); 4];
        for axis in 0..3 {
            way[axis] = s.load(motion[axis], at) - by[axis];
        }
        put(s, ways, at, way);
    });
}

/// Takes back what that did, after `ways` changed.
pub(crate) fn scatter_along(
    whole: &RigidMotion,
    x: &Columns,
    ways: &[Float4],
    motion: &mut Columns,
) {
    let [x, y, z] = x.all();
    let motion = motion.all_mut();
    each!(x.len(), |s, at| {
        let by = whole.displacement_lanes(s, [s.load(x, at), s.load(y, at), s.load(z, at)]);
        let way = fetch(s, ways, at);
        for axis in 0..3 {
            s.store(motion[axis], at, way[axis] + by[axis]);
        }
    });
}

/// How all moved from one state to another, in the mean.
pub(crate) fn drift(from: &[Float4], to: &[Float4]) -> Vec3 {
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
    let all = sums.iter().fold(rest, |sum, part| sum + xyz(part));
    all * (1.0 / from.len() as f32)
}

/// Gives each room around the way that it made from one state to another: `share` of how far it got against the drift,
/// and `spare` more. The ways that it may make so are from, to.
pub(crate) fn give_room(
    [start, now]: [&[Float4]; 2],
    [from, to]: [&mut [Float4]; 2],
    drift: Vec3,
    [share, spare]: [f32; 2],
) {
    each!(now.len(), |s, at| {
        let (before, after) = (fetch(s, start, at), fetch(s, now, at));
        let way = [0, 1, 2].map(|axis| after[axis] - before[axis]);
        let [x, y, z] = [0, 1, 2].map(|axis| way[axis] - s.splat(drift[axis]));
        let against = Float::sqrt(x * x + y * y + z * z);
        let room = against * s.splat(share) + s.splat(spare);
        let [x, y, z] = way;
        put(s, from, at, [x - room, y - room, z - room, s.splat(0.0)]);
        put(s, to, at, [x + room, y + room, z + room, s.splat(0.0)]);
    });
}

/// Whether any is held.
pub(crate) fn is_any_held(spots: &[Float4]) -> bool {
    spots.iter().any(|spot| spot[3] <= 0.0)
}

/// The middle of all mass, of places and inverse masses.
pub(crate) fn middle(spots: impl Iterator<Item = (Vec3, f32)>) -> Vec3 {
    let (mut sum, mut all) = ([0.0_f64; 3], 0.0_f64);
    for (x, w) in spots {
        let mass = 1.0 / f64::from(w);
        all += mass;
        for (sum, x) in sum.iter_mut().zip(x.to_array()) {
            *sum += mass * f64::from(x);
        }
    }
    Vec3::from_array(sum.map(|sum| (sum / all) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_by_fours_do_as_each_alone_however_many_there_are() {
        for count in 0..10 {
            let number = |i: usize, k: usize| ((i * 7 + k * 13) % 31) as f32 / 7.0 - 2.0;
            let vector = |i: usize, k: usize| Vec3::new(number(i, k), number(i, k + 1), -0.0);
            let [mut x, mut motion, mut ways] = [(); 3].map(|()| Columns::zeros(count));
            let w: Vec<f32> = (0..count).map(|i| number(i, 5)).collect();
            for i in 0..count {
                x.set(i, vector(i, 0));
                motion.set(i, vector(i, 3));
            }
            let points = || (0..count).map(|i| (vector(i, 0), vector(i, 3), 1.0));
            let whole = RigidMotion::of_points(points);
            let [mut spots, mut turned] = [(); 2].map(|()| Vec::new());
            gather(&mut spots, &x, &w);
            gather_against(&whole, &x, &motion, &mut turned);
            list_ways(&spots, &turned, &mut ways);
            for i in 0..count {
                let against = vector(i, 3) - whole.displacement_at(vector(i, 0));
                assert_eq!(spots[i].map(f32::to_bits), with(vector(i, 0), w[i]), "{i} of {count}");
                assert_eq!(turned[i].map(f32::to_bits), with(against, 0.0), "{i} of {count}");
                assert_eq!(bits(ways.at(i)), bits(against - vector(i, 0)), "{i} of {count}");
            }
            scatter_along(&whole, &x, &turned, &mut motion);
            take_back(&spots, &whole, &mut turned);
            scatter(&turned, &mut ways);
            for i in 0..count {
                let at = whole.displacement_at(vector(i, 0));
                let along = (vector(i, 3) - at) + at;
                assert_eq!(bits(motion.at(i)), bits(along), "{i} of {count}");
                assert_eq!(bits(ways.at(i)), bits(vector(i, 0) - at), "{i} of {count}");
                assert_eq!(turned[i][3].to_bits(), w[i].to_bits(), "{i} of {count}");
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
