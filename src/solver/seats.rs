//! Where lines find their particles: each has a seat, a point beside the others with all that is asked of
//! it in one place, after a first seat that is nobody's.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use super::World;
use crate::math::simd::{LANES, Simd, turn, turn_back, vectored};

/// Copies the particles to their seats.
pub(crate) fn take(world: &mut World, is_rigid: bool) {
    let (level, p, scratch) = (world.level, &world.particles, &mut world.scratch);
    let s = &mut scratch.lines;
    s.points.resize(p.len() + 1, [0.0; 4]);
    s.points[0] = [0.0; 4];
    if scratch.packed.is_current {
        let particles = scratch.packed.points.iter().zip(&p.w);
        for (seat, ([x, y, z, _], w)) in s.points[1..].iter_mut().zip(particles) {
            *seat = [*x, *y, *z, *w];
        }
    } else {
        seat(level, p.x.all(), &p.w, &mut s.points[1..]);
    }
    if is_rigid {
        s.starts.resize(p.len() + 1, [0.0; 4]);
        seat_back(level, scratch.predicted.all(), scratch.way.all(), &mut s.starts[1..]);
    }
}

/// Copies them back.
pub(crate) fn leave(world: &mut World) {
    let seats = &world.scratch.lines.points[1..];
    if world.scratch.packed.is_current {
        for (point, [x, y, z, _]) in world.scratch.packed.points.iter_mut().zip(seats) {
            *point = [*x, *y, *z, 0.0];
        }
    } else {
        unseat(world.level, seats, world.particles.x.all_mut());
    }
}

vectored! {
    /// Points from columns and a column of weights.
    fn seat(columns: [&[f32]; 3], w: &[f32], seats: &mut [[f32; 4]])
        = seat_lanes, Avx2, seat_apart
}

vectored! {
    /// Points from columns, less another way.
    fn seat_back(columns: [&[f32]; 3], way: [&[f32]; 3], seats: &mut [[f32; 4]])
        = seat_back_lanes, Avx2, seat_back_apart
}

vectored! {
    /// Columns from points.
    fn unseat(seats: &[[f32; 4]], columns: [&mut [f32]; 3]) = unseat_lanes, Avx2, unseat_apart
}

#[inline(always)]
fn seat_lanes<S: Simd>(s: S, [x, y, z]: [&[f32]; 3], w: &[f32], seats: &mut [[f32; 4]]) {
    // One length for all, so that one check does.
    let count = seats.len();
    let (x, y, z, w) = (&x[..count], &y[..count], &z[..count], &w[..count]);
    let mut first = 0;
    while first + S::LANES <= count {
        let numbers = [s.load(x, first), s.load(y, first), s.load(z, first), s.load(w, first)];
        turn_back(s, &mut seats[first..first + S::LANES], &IN_TURN, numbers);
        first += S::LANES;
    }
    seat_apart([&x[first..], &y[first..], &z[first..]], &w[first..], &mut seats[first..]);
}

fn seat_apart([x, y, z]: [&[f32]; 3], w: &[f32], seats: &mut [[f32; 4]]) {
    for ((((seat, x), y), z), w) in seats.iter_mut().zip(x).zip(y).zip(z).zip(w) {
        *seat = [*x, *y, *z, *w];
    }
}

#[inline(always)]
fn seat_back_lanes<S: Simd>(s: S, to: [&[f32]; 3], way: [&[f32]; 3], seats: &mut [[f32; 4]]) {
    let count = seats.len();
    let [to, way] = [to, way].map(|columns| columns.map(|column| &column[..count]));
    let mut first = 0;
    while first + S::LANES <= count {
        let mut numbers = [s.splat(0.0); 4];
        for axis in 0..3 {
            numbers[axis] = s.load(to[axis], first) - s.load(way[axis], first);
        }
        turn_back(s, &mut seats[first..first + S::LANES], &IN_TURN, numbers);
        first += S::LANES;
    }
    seat_back_apart(to.map(|to| &to[first..]), way.map(|way| &way[first..]), &mut seats[first..]);
}

fn seat_back_apart(to: [&[f32]; 3], way: [&[f32]; 3], seats: &mut [[f32; 4]]) {
    for (at, seat) in seats.iter_mut().enumerate() {
        for axis in 0..3 {
            seat[axis] = to[axis][at] - way[axis][at];
        }
        seat[3] = 0.0;
    }
}

#[inline(always)]
fn unseat_lanes<S: Simd>(s: S, seats: &[[f32; 4]], columns: [&mut [f32]; 3]) {
    let count = seats.len();
    let [x, y, z] = columns;
    let (x, y, z) = (&mut x[..count], &mut y[..count], &mut z[..count]);
    let mut first = 0;
    while first + S::LANES <= count {
        let numbers = turn(s, &seats[first..first + S::LANES], &IN_TURN);
        s.store(x, first, numbers[0]);
        s.store(y, first, numbers[1]);
        s.store(z, first, numbers[2]);
        first += S::LANES;
    }
    unseat_apart(&seats[first..], [&mut x[first..], &mut y[first..], &mut z[first..]]);
}

fn unseat_apart(seats: &[[f32; 4]], [x, y, z]: [&mut [f32]; 3]) {
    for (((seat, x), y), z) in seats.iter().zip(x).zip(y).zip(z) {
        [*x, *y, *z, _] = *seat;
    }
}

/// The places of points that lie next to each other.
const IN_TURN: [u32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7];
