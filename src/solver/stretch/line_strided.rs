//! Lines whose particles lie evenly, as those of a grid do: what is asked of their particles comes straight
//! from the columns, four lines at a time. Of lines that lie side by side a step is one vector; of those that
//! run along a column four steps of four lines are four vectors, turned. Fewer than eight lines go number by number.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code, unused_imports)
)]

use crate::model::line_blocks;
use crate::solver::stretch::line_solver::{Step, excess, length, limited, longest, size};

use crate::math::columns::Columns;
use crate::math::simd::{Baseline, Float, LANES, Level, Scalar, Simd, leveled, transpose_4x4};
use crate::model::line_blocks::Strip;

/// What every machine with vectors has in one, and how many steps are turned at once.
const FOUR: usize = 4;

type Vector = <Baseline as Simd>::F;

/// Finds where particles were when the substep began, after one that is nobody's.
pub(crate) fn find_starts(level: Level, predicted: &Columns, way: &Columns, starts: &mut Columns) {
    starts.resize(predicted.x.len() + 1);
    for ((start, to), way) in starts.all_mut().into_iter().zip(predicted.all()).zip(way.all()) {
        go_back(level, to, way, &mut start[1..]);
    }
}

leveled! {
    fn go_back(to: &[f32], way: &[f32], start: &mut [f32]) = go_back_lanes
}

#[inline(always)]
fn go_back_lanes(to: &[f32], way: &[f32], start: &mut [f32]) {
    for ((start, to), way) in start.iter_mut().zip(to).zip(way) {
        *start = to - way;
    }
}

// What has loops of its own is a function of its own: in long ones engines run out of registers.

/// Fetches where the particles are, and their inverse mass.
pub(crate) fn fetch(strip: Strip, x: &Columns, w: &[f32], room: &mut [Step]) {
    let [x, y, z] = x.all();
    let columns = [x, y, z, w];
    if strip.lines < LANES {
        return fetch_apart(strip, columns, room);
    }
    strip.assert_within(room.len(), columns);
    let columns = columns.map(<[f32]>::as_ptr);
    // SAFETY: it was just found to be within.
    unsafe {
        if strip.across == 1 {
            fetch_straight(strip, columns, room);
        } else {
            fetch_turned(strip, columns, room);
        }
    }
}

/// # Safety
/// The whole strip lies within the columns; so for all that follow.
#[inline(never)]
unsafe fn fetch_straight(strip: Strip, columns: [*const f32; 4], room: &mut [Step]) {
    let (s, mut at) = (Baseline::new(), strip.at(0, 0));
    for step in room {
        for (to, column) in step.to.iter_mut().zip(columns) {
            // SAFETY: the caller's promise.
            unsafe {
                let column = column.add(at);
                s.store(to, 0, s.load_from(column));
                s.store(to, FOUR, s.load_from(column.add(FOUR)));
            }
        }
        at += strip.along;
    }
}

/// # Safety
/// As above; there are four steps at least.
#[inline(never)]
unsafe fn fetch_turned(strip: Strip, columns: [*const f32; 4], room: &mut [Step]) {
    let s = Baseline::new();
    for start in fours(room.len()) {
        let steps = &mut room[start..start + FOUR];
        for first in [0, FOUR] {
            let at = strip.at(first, start);
            for (axis, column) in columns.into_iter().enumerate() {
                // SAFETY: the caller's promise.
                let rows =
                    unsafe { transpose_4x4(s, four_by_four(s, column.add(at), strip.across)) };
                for (step, row) in steps.iter_mut().zip(rows) {
                    s.store(&mut step.to[axis], first, row);
                }
            }
        }
    }
}

/// Four numbers from a place on, and from three more.
///
/// # Safety
/// They are there.
#[inline(always)]
unsafe fn four_by_four(s: Baseline, place: *const f32, across: usize) -> [Vector; FOUR] {
    // SAFETY: the caller's promise.
    unsafe {
        [
            s.load_from(place),
            s.load_from(place.add(across)),
            s.load_from(place.add(2 * across)),
            s.load_from(place.add(3 * across)),
        ]
    }
}

fn fetch_apart(strip: Strip, columns: [&[f32]; 4], room: &mut [Step]) {
    for (number, step) in room.iter_mut().enumerate() {
        for (to, column) in step.to.iter_mut().zip(columns) {
            for lane in 0..LANES {
                to[lane] = if lane < strip.lines { column[strip.at(lane, number)] } else { 0.0 };
            }
        }
    }
}

/// Finds what links that do not give way are to be long, from where the substep began.
pub(crate) fn aim(strip: Strip, starts: &Columns, laid: &[line_blocks::Step], room: &mut [Step]) {
    let starts = starts.all();
    if strip.lines < LANES {
        return aim_apart(strip, starts, laid, room);
    }
    let own = starts.map(|column| &column[1..]);
    strip.assert_within(room.len(), own);
    // SAFETY: it was just found to be within, and there is a number in front of all.
    unsafe {
        if strip.across == 1 {
            aim_straight(strip, own.map(<[f32]>::as_ptr), laid, room);
        } else {
            aim_turned(strip, starts.map(<[f32]>::as_ptr), laid, room);
        }
    }
}

/// # Safety
/// As above.
#[inline(never)]
unsafe fn aim_straight(
    strip: Strip,
    [x, y, z]: [*const f32; 3],
    laid: &[line_blocks::Step],
    room: &mut [Step],
) {
    let (s, mut at) = (Baseline::new(), strip.at(0, 0));
    // Where a line begins nobody asks for what is found.
    let mut last = at;
    for (step, laid) in room.iter_mut().zip(laid) {
        for first in [0, FOUR] {
            // SAFETY: the caller's promise.
            let span = unsafe {
                [
                    s.load_from(x.add(at + first)) - s.load_from(x.add(last + first)),
                    s.load_from(y.add(at + first)) - s.load_from(y.add(last + first)),
                    s.load_from(z.add(at + first)) - s.load_from(z.add(last + first)),
                ]
            };
            step.mend(s, first, length(s, span), &laid.rest);
        }
        (last, at) = (at, at + strip.along);
    }
}

/// # Safety
/// As above, of what is behind the first numbers; there are four steps at least.
#[inline(never)]
unsafe fn aim_turned(
    strip: Strip,
    [x, y, z]: [*const f32; 3],
    laid: &[line_blocks::Step],
    room: &mut [Step],
) {
    let s = Baseline::new();
    // Links run from the particle before, or from one that is none of the line's: as above.
    let was = |at: usize| {
        // SAFETY: the caller's promise.
        unsafe {
            let (x, y, z) = (x.add(at), y.add(at), z.add(at));
            let dx = s.load_from(x.add(1)) - s.load_from(x);
            let dy = s.load_from(y.add(1)) - s.load_from(y);
            let dz = s.load_from(z.add(1)) - s.load_from(z);
            length(s, [dx, dy, dz])
        }
    };
    for start in fours(room.len()) {
        let (steps, laid) = (&mut room[start..start + FOUR], &laid[start..start + FOUR]);
        for first in [0, FOUR] {
            let (at, across) = (strip.at(first, start), strip.across);
            let lines = [was(at), was(at + across), was(at + 2 * across), was(at + 3 * across)];
            for ((step, laid), was) in steps.iter_mut().zip(laid).zip(transpose_4x4(s, lines)) {
                step.mend(s, first, was, &laid.rest);
            }
        }
    }
}

fn aim_apart(strip: Strip, starts: [&[f32]; 3], laid: &[line_blocks::Step], room: &mut [Step]) {
    for lane in 0..LANES {
        let mut last = [0.0; 3];
        for (number, (step, laid)) in room.iter_mut().zip(laid).enumerate() {
            let at = strip.at(lane, number) + 1;
            let start = if lane < strip.lines { starts.map(|column| column[at]) } else { last };
            let was = length(Scalar, [0, 1, 2].map(|axis| start[axis] - last[axis]));
            step.mend(Scalar, lane, was, &laid.rest);
            last = start;
        }
    }
}

/// Has the particles go their ways.
pub(crate) fn put(strip: Strip, laid: &[line_blocks::Step], room: &[Step], x: &mut Columns) {
    let columns = &mut x.all_mut();
    let mut is_done = strip.lines == LANES;
    if is_done {
        strip.assert_within(room.len(), columns.each_ref().map(|column| &**column));
        let columns = columns.each_mut().map(|column| column.as_mut_ptr());
        // SAFETY: it was just found to be within.
        is_done = unsafe {
            if strip.across == 1 {
                put_straight(strip, laid, room, columns)
            } else {
                put_turned(strip, laid, room, columns)
            }
        };
    }
    if !is_done {
        (0..strip.lines).for_each(|line| put_line(strip, laid, room, columns, line));
    }
}

/// Whether surely no way is too long; else all are to be put again.
///
/// # Safety
/// As above.
#[inline(never)]
unsafe fn put_straight(
    strip: Strip,
    laid: &[line_blocks::Step],
    room: &[Step],
    columns: [*mut f32; 3],
) -> bool {
    let (s, mut at) = (Baseline::new(), strip.at(0, 0));
    let zero = s.splat(0.0);
    let (mut way, mut other_way) = ([zero; 3], [zero; 3]);
    let (mut most, mut other_most) = (zero, zero);
    for (step, laid) in room.iter().zip(laid) {
        way = step.way(s, 0, way);
        most = excess(s, longest(s, way), &laid.rest, 0).max(most);
        let there = step.there(s, 0, way);
        other_way = step.way(s, FOUR, other_way);
        other_most = excess(s, longest(s, other_way), &laid.rest, FOUR).max(other_most);
        let other_there = step.there(s, FOUR, other_way);
        for axis in 0..3 {
            // SAFETY: the caller's promise.
            unsafe {
                let column = columns[axis].add(at);
                s.store_to(column, there[axis]);
                s.store_to(column.add(FOUR), other_there[axis]);
            }
        }
        at += strip.along;
    }
    !(s.any_positive(most) || s.any_positive(other_most))
}

/// The same of lines that run along a column.
///
/// # Safety
/// As above; there are four steps at least.
#[inline(never)]
unsafe fn put_turned(
    strip: Strip,
    laid: &[line_blocks::Step],
    room: &[Step],
    columns: [*mut f32; 3],
) -> bool {
    let s = Baseline::new();
    let zero = s.splat(0.0);
    let mut most = zero;
    for first in [0, FOUR] {
        let (mut ways, mut done) = ([[zero; FOUR]; 3], 0);
        for start in fours(room.len()) {
            let (steps, laid) = (&room[start..start + FOUR], &laid[start..start + FOUR]);
            let place = strip.at(first, start);
            // The last four reach back over some that went.
            let before = FOUR - 1 - (done - start);
            done = start + FOUR;
            let mut far = [zero; FOUR];
            // Axis by axis: registers are few.
            for axis in 0..3 {
                let (mut way, mut there) = (ways[axis][before], [zero; FOUR]);
                for (number, step) in steps.iter().enumerate() {
                    way = step.way_along(s, axis, first, way);
                    ways[axis][number] = way;
                    there[number] = way + s.load(&step.to[axis], first);
                    far[number] = size(s, way).max(far[number]);
                }
                for (line, row) in transpose_4x4(s, there).into_iter().enumerate() {
                    // SAFETY: the caller's promise.
                    unsafe { s.store_to(columns[axis].add(place + line * strip.across), row) };
                }
            }
            for (far, laid) in far.into_iter().zip(laid) {
                most = excess(s, far, &laid.rest, first).max(most);
            }
        }
    }
    !s.any_positive(most)
}

/// One line, number by number: there are fewer lines than lanes, or ways that may be too long.
fn put_line(
    strip: Strip,
    laid: &[line_blocks::Step],
    room: &[Step],
    columns: &mut [&mut [f32]; 3],
    line: usize,
) {
    let mut way = [0.0; 3];
    for (number, (step, laid)) in room.iter().zip(laid).enumerate() {
        way = step.way(Scalar, line, way);
        let there = step.there(Scalar, line, limited(way, laid.rest[line].abs()));
        for (column, there) in columns.iter_mut().zip(there) {
            column[strip.at(line, number)] = there;
        }
    }
}

/// Where four steps at a time begin; the last ones reach back.
fn fours(count: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by(FOUR).map(move |start| start.min(count - FOUR))
}

impl Strip {
    /// The particle that a step of a line runs to.
    #[inline(always)]
    fn at(&self, line: usize, step: usize) -> usize {
        self.first + line * self.across + step * self.along
    }

    /// # Panics
    /// If the strip does not lie within columns.
    fn assert_within<const N: usize>(&self, steps: usize, columns: [&[f32]; N]) {
        let last = self.at(LANES - 1, steps - 1);
        assert!(columns.iter().all(|column| last < column.len()), "lines run over particles");
    }
}

const _: () = assert!(LANES == 2 * FOUR);
