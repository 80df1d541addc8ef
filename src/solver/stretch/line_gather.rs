//! Where lines find their particles: each has a seat, a point beside the others with all that is asked of
//! it in one place, after a first seat that is nobody's.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::{
    Float, LANES, Level, Scalar, Simd, gather_transpose, scatter_transpose, vectored,
};
use crate::model::line_blocks;
use crate::solver::stretch::line_solver::{Step, excess, length, limited, longest};
use crate::solver::world::World;

/// Copies the particles to their seats.
pub(crate) fn take(world: &mut World, is_rigid: bool) {
    let (level, p, scratch) = (world.level, &world.particles, &mut world.scratch);
    let s = &mut scratch.lines;
    s.points.resize(p.len() + 1, [0.0; 4]);
    s.points[0] = [0.0; 4];
    if scratch.interleaved.is_current {
        let particles = scratch.interleaved.points.iter().zip(&p.w);
        for (seat, ([x, y, z, _], w)) in s.points[1..].iter_mut().zip(particles) {
            *seat = [*x, *y, *z, *w];
        }
    } else {
        seat(level, p.x.all(), &p.w, &mut s.points[1..]);
    }
    s.starts.clear();
    if is_rigid {
        s.starts.resize(p.len() + 1, [0.0; 4]);
        seat_back(level, scratch.predicted.all(), scratch.displacement.all(), &mut s.starts[1..]);
    }
}

/// Where particles sit, and where they sat when the substep began, if links do not give way.
#[derive(Clone, Copy)]
pub(crate) struct Seats<'a> {
    pub points: &'a [[f32; 4]],
    pub starts: &'a [[f32; 4]],
}

impl Seats<'_> {
    /// Brings what some lanes of a step ask of their particles: where they are, their inverse mass, and what links
    /// are to be long. `was` goes along, where the particles of the step before were.
    #[inline(always)]
    pub fn bring<S: Simd, const SOFT: bool>(
        &self,
        s: S,
        first: usize,
        was: &mut [S::F; 4],
        laid: &line_blocks::Step,
        step: &mut Step,
    ) {
        let to = gather_transpose(s, self.points, &laid.to[first..]);
        for (lanes, to) in step.to.iter_mut().zip(to) {
            s.store(lanes, first, to);
        }
        if SOFT {
            return step.rest(s, first, &laid.rest);
        }
        let start = gather_transpose(s, self.starts, &laid.to[first..]);
        let span = [start[0] - was[0], start[1] - was[1], start[2] - was[2]];
        step.mend(s, first, length(s, span), &laid.rest);
        *was = start;
    }
}

vectored! {
    /// Brings all that a block asks, if links do not give way.
    pub(crate) fn fetch_rigid(laid: &[line_blocks::Step], seats: Seats<'_>, room: &mut [Step])
        = fetch_lanes::<_, false>, Avx2, fetch_apart::<false>
}

vectored! {
    /// The same, if they do.
    pub(crate) fn fetch_soft(laid: &[line_blocks::Step], seats: Seats<'_>, room: &mut [Step])
        = fetch_lanes::<_, true>, Avx2, fetch_apart::<true>
}

fn fetch_apart<const SOFT: bool>(laid: &[line_blocks::Step], seats: Seats<'_>, room: &mut [Step]) {
    fetch_lanes::<_, SOFT>(Scalar, laid, seats, room);
}

#[inline(always)]
fn fetch_lanes<S: Simd, const SOFT: bool>(
    s: S,
    laid: &[line_blocks::Step],
    seats: Seats<'_>,
    room: &mut [Step],
) {
    for first in (0..LANES).step_by(S::LANES) {
        let mut was = [s.splat(0.0); 4];
        for (laid, step) in laid.iter().zip(&mut *room) {
            seats.bring::<S, SOFT>(s, first, &mut was, laid, step);
        }
    }
}

/// Has the particles of a block go their ways.
pub(crate) fn put(
    level: Level,
    laid: &[line_blocks::Step],
    room: &[Step],
    points: &mut [[f32; 4]],
) {
    let mut is_far = false;
    put_at_once(level, laid, room, points, &mut is_far);
    if is_far {
        put_apart(laid, room, points, &mut is_far);
    }
}

vectored! {
    /// The same as long as no way may be too long; else finds that.
    fn put_at_once(
        laid: &[line_blocks::Step],
        room: &[Step],
        points: &mut [[f32; 4]],
        is_far: &mut bool,
    ) = put_lanes, Avx2, put_apart
}

#[inline(always)]
fn put_lanes<S: Simd>(
    s: S,
    laid: &[line_blocks::Step],
    room: &[Step],
    points: &mut [[f32; 4]],
    is_far: &mut bool,
) {
    for first in (0..LANES).step_by(S::LANES) {
        let (mut way, mut most) = ([s.splat(0.0); 3], s.splat(0.0));
        for (laid, step) in laid.iter().zip(room) {
            way = step.way(s, first, way);
            most = excess(s, longest(s, way), &laid.rest, first).max(most);
            let [x, y, z] = step.there(s, first, way);
            scatter_transpose(s, points, &laid.to[first..], [x, y, z, s.load(&step.to[3], first)]);
        }
        *is_far |= s.any_positive(most);
    }
}

#[inline(never)]
fn put_apart(laid: &[line_blocks::Step], room: &[Step], points: &mut [[f32; 4]], _: &mut bool) {
    for lane in 0..LANES {
        let mut way = [0.0; 3];
        for (laid, step) in laid.iter().zip(room) {
            way = step.way(Scalar, lane, way);
            let [x, y, z] = step.there(Scalar, lane, limited(way, laid.rest[lane].abs()));
            points[laid.to[lane] as usize] = [x, y, z, step.to[3][lane]];
        }
    }
}

/// Copies them back.
pub(crate) fn leave(world: &mut World) {
    let seats = &world.scratch.lines.points[1..];
    if world.scratch.interleaved.is_current {
        for (point, [x, y, z, _]) in world.scratch.interleaved.points.iter_mut().zip(seats) {
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
        scatter_transpose(s, &mut seats[first..first + S::LANES], &IN_TURN, numbers);
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
        scatter_transpose(s, &mut seats[first..first + S::LANES], &IN_TURN, numbers);
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
        let numbers = gather_transpose(s, &seats[first..first + S::LANES], &IN_TURN);
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
