//! Gather and scatter of chains whose particles are at a fixed stride, as on a grid (strided
//! blocks).
//!
//! No index is read: particles come straight from the columns, four chains at a time.
//!
//! ```text
//! chain_stride = 1 (chains side by side)     a step of four chains is one load       *_direct
//! link_stride = 1 (chains along a column)    four steps of four chains are four
//!                                            loads, transposed 4 × 4                 *_transposed
//! fewer than eight chains                    scalar                                  *_scalar
//! ```
//! Reads positions, inverse masses and `scratch.predicted − scratch.displacement`; writes the steps
//! (`LineStep`) and at the end the positions.
//! Invariant: every function that takes pointers is called for strided blocks that lie within the
//! columns, which `StridedBlock::assert_within` checked; a strided block has at least four steps.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code, unused_imports)
)]

use crate::math::columns::Columns;
use crate::math::simd::{Baseline, Float, LANES, Level, Scalar, Simd, leveled, transpose_4x4};
use crate::model::chain_blocks::{self, StridedBlock};
use crate::solver::stretch::line_step::{
    LineStep, abs, clamp_length, length, limit_excess, max_component,
};

/// The lanes of the smallest vector (`Baseline`), and the number of steps that are transposed at
/// once.
const FOUR: usize = 4;

type Vector = <Baseline as Simd>::F;

/// Computes the positions at the start of the substep, after one sentinel entry.
pub(crate) fn compute_starts(
    level: Level,
    predicted: &Columns,
    displacement: &Columns,
    starts: &mut Columns,
) {
    starts.resize(predicted.x.len() + 1);
    let columns =
        starts.slices_mut().into_iter().zip(predicted.slices()).zip(displacement.slices());
    for ((start, predicted), displacement) in columns {
        subtract(level, predicted, displacement, &mut start[1..]);
    }
}

leveled! {
    fn subtract(a: &[f32], b: &[f32], difference: &mut [f32]) = subtract_lanes
}

#[inline(always)]
fn subtract_lanes(a: &[f32], b: &[f32], difference: &mut [f32]) {
    for ((difference, a), b) in difference.iter_mut().zip(a).zip(b) {
        *difference = a - b;
    }
}

// `#[inline(never)]` on the loops below: WebAssembly engines run out of registers in long
// functions.

/// Gathers the positions and inverse masses of a strided block.
pub(crate) fn gather(strided: StridedBlock, x: &Columns, w: &[f32], steps: &mut [LineStep]) {
    let [x, y, z] = x.slices();
    let columns = [x, y, z, w];
    if strided.chain_count < LANES {
        return gather_scalar(strided, columns, steps);
    }
    strided.assert_within(steps.len(), columns);
    let columns = columns.map(<[f32]>::as_ptr);
    // SAFETY: the strided block lies within the columns, as was just checked.
    unsafe {
        if strided.chain_stride == 1 {
            gather_direct(strided, columns, steps);
        } else {
            gather_transposed(strided, columns, steps);
        }
    }
}

/// # Safety
/// The strided block lies within the columns.
#[inline(never)]
unsafe fn gather_direct(strided: StridedBlock, columns: [*const f32; 4], steps: &mut [LineStep]) {
    let (s, mut at) = (Baseline::new(), strided.index(0, 0));
    for step in steps {
        for (to, column) in step.to.iter_mut().zip(columns) {
            // SAFETY: the caller guarantees it.
            unsafe {
                let column = column.add(at);
                s.store(to, 0, s.load_from(column));
                s.store(to, FOUR, s.load_from(column.add(FOUR)));
            }
        }
        at += strided.link_stride;
    }
}

/// # Safety
/// The strided block lies within the columns and has at least four steps.
#[inline(never)]
unsafe fn gather_transposed(
    strided: StridedBlock,
    columns: [*const f32; 4],
    steps: &mut [LineStep],
) {
    let s = Baseline::new();
    for start in blocks_of_four(steps.len()) {
        let steps = &mut steps[start..start + FOUR];
        for first in [0, FOUR] {
            let at = strided.index(first, start);
            for (axis, column) in columns.into_iter().enumerate() {
                // SAFETY: the caller guarantees it.
                let rows =
                    unsafe { transpose_4x4(s, load_4x4(s, column.add(at), strided.chain_stride)) };
                for (step, row) in steps.iter_mut().zip(rows) {
                    s.store(&mut step.to[axis], first, row);
                }
            }
        }
    }
}

/// Loads four numbers each from four addresses that are `chain_stride` numbers apart.
///
/// # Safety
/// All sixteen numbers are readable.
#[inline(always)]
unsafe fn load_4x4(s: Baseline, first: *const f32, chain_stride: usize) -> [Vector; FOUR] {
    // SAFETY: the caller guarantees it.
    unsafe {
        [
            s.load_from(first),
            s.load_from(first.add(chain_stride)),
            s.load_from(first.add(2 * chain_stride)),
            s.load_from(first.add(3 * chain_stride)),
        ]
    }
}

fn gather_scalar(strided: StridedBlock, columns: [&[f32]; 4], steps: &mut [LineStep]) {
    for (number, step) in steps.iter_mut().enumerate() {
        for (to, column) in step.to.iter_mut().zip(columns) {
            for lane in 0..LANES {
                to[lane] = if lane < strided.chain_count {
                    column[strided.index(lane, number)]
                } else {
                    0.0
                };
            }
        }
    }
}

/// Sets the target lengths of rigid links, from their lengths at the start of the substep.
pub(crate) fn set_relaxed_targets(
    strided: StridedBlock,
    starts: &Columns,
    block: &[chain_blocks::ChainStep],
    steps: &mut [LineStep],
) {
    let starts = starts.slices();
    if strided.chain_count < LANES {
        return set_relaxed_targets_scalar(strided, starts, block, steps);
    }
    let own = starts.map(|column| &column[1..]);
    strided.assert_within(steps.len(), own);
    // SAFETY: the strided block lies within the columns, as was just checked, and the sentinel is
    // before them.
    unsafe {
        if strided.chain_stride == 1 {
            set_relaxed_targets_direct(strided, own.map(<[f32]>::as_ptr), block, steps);
        } else {
            set_relaxed_targets_transposed(strided, starts.map(<[f32]>::as_ptr), block, steps);
        }
    }
}

/// # Safety
/// The strided block lies within the columns.
#[inline(never)]
unsafe fn set_relaxed_targets_direct(
    strided: StridedBlock,
    [x, y, z]: [*const f32; 3],
    block: &[chain_blocks::ChainStep],
    steps: &mut [LineStep],
) {
    let (s, mut at) = (Baseline::new(), strided.index(0, 0));
    // The first step of a chain has no link, so its target is not used.
    let mut last = at;
    for (step, chain_step) in steps.iter_mut().zip(block) {
        for first in [0, FOUR] {
            // SAFETY: the caller guarantees it.
            let span = unsafe {
                [
                    s.load_from(x.add(at + first)) - s.load_from(x.add(last + first)),
                    s.load_from(y.add(at + first)) - s.load_from(y.add(last + first)),
                    s.load_from(z.add(at + first)) - s.load_from(z.add(last + first)),
                ]
            };
            step.set_relaxed_target(s, first, length(s, span), &chain_step.rest);
        }
        (last, at) = (at, at + strided.link_stride);
    }
}

/// # Safety
/// The strided block lies within the columns behind their first entry, and has at least four steps.
#[inline(never)]
unsafe fn set_relaxed_targets_transposed(
    strided: StridedBlock,
    [x, y, z]: [*const f32; 3],
    block: &[chain_blocks::ChainStep],
    steps: &mut [LineStep],
) {
    let s = Baseline::new();
    // The length of the link that runs to particle `at`. For the first particle of a chain the
    // result belongs to no link and is not used.
    let start_length = |at: usize| {
        // SAFETY: the caller guarantees it.
        unsafe {
            let (x, y, z) = (x.add(at), y.add(at), z.add(at));
            let dx = s.load_from(x.add(1)) - s.load_from(x);
            let dy = s.load_from(y.add(1)) - s.load_from(y);
            let dz = s.load_from(z.add(1)) - s.load_from(z);
            length(s, [dx, dy, dz])
        }
    };
    for start in blocks_of_four(steps.len()) {
        let (steps, block) = (&mut steps[start..start + FOUR], &block[start..start + FOUR]);
        for first in [0, FOUR] {
            let (at, across) = (strided.index(first, start), strided.chain_stride);
            let lengths = [
                start_length(at),
                start_length(at + across),
                start_length(at + 2 * across),
                start_length(at + 3 * across),
            ];
            for ((step, chain_step), start_length) in
                steps.iter_mut().zip(block).zip(transpose_4x4(s, lengths))
            {
                step.set_relaxed_target(s, first, start_length, &chain_step.rest);
            }
        }
    }
}

fn set_relaxed_targets_scalar(
    strided: StridedBlock,
    starts: [&[f32]; 3],
    block: &[chain_blocks::ChainStep],
    steps: &mut [LineStep],
) {
    for lane in 0..LANES {
        let mut last = [0.0; 3];
        for (number, (step, chain_step)) in steps.iter_mut().zip(block).enumerate() {
            let at = strided.index(lane, number) + 1;
            let start =
                if lane < strided.chain_count { starts.map(|column| column[at]) } else { last };
            let start_length = length(Scalar, [0, 1, 2].map(|axis| start[axis] - last[axis]));
            step.set_relaxed_target(Scalar, lane, start_length, &chain_step.rest);
            last = start;
        }
    }
}

/// Displaces the particles of a strided block; none moves farther than the rest length of its link.
pub(crate) fn scatter(
    strided: StridedBlock,
    block: &[chain_blocks::ChainStep],
    steps: &[LineStep],
    x: &mut Columns,
) {
    let columns = &mut x.slices_mut();
    let mut is_done = strided.chain_count == LANES;
    if is_done {
        strided.assert_within(steps.len(), columns.each_ref().map(|column| &**column));
        let columns = columns.each_mut().map(|column| column.as_mut_ptr());
        // SAFETY: the strided block lies within the columns, as was just checked.
        is_done = unsafe {
            if strided.chain_stride == 1 {
                scatter_direct(strided, block, steps, columns)
            } else {
                scatter_transposed(strided, block, steps, columns)
            }
        };
    }
    if !is_done {
        (0..strided.chain_count)
            .for_each(|chain| scatter_chain_clamped(strided, block, steps, columns, chain));
    }
}

/// Displaces the particles of a strided block without a limit. Returns true if no displacement
/// exceeds its limit; otherwise [`scatter_chain_clamped`] must repeat all chains.
///
/// # Safety
/// The strided block lies within the columns.
#[inline(never)]
unsafe fn scatter_direct(
    strided: StridedBlock,
    block: &[chain_blocks::ChainStep],
    steps: &[LineStep],
    columns: [*mut f32; 3],
) -> bool {
    let (s, mut at) = (Baseline::new(), strided.index(0, 0));
    let zero = s.splat(0.0);
    let (mut u, mut other_u) = ([zero; 3], [zero; 3]);
    let (mut excess, mut other_excess) = (zero, zero);
    for (step, chain_step) in steps.iter().zip(block) {
        u = step.displacement(s, 0, u);
        excess = limit_excess(s, max_component(s, u), &chain_step.rest, 0).max(excess);
        let moved = step.displaced(s, 0, u);
        other_u = step.displacement(s, FOUR, other_u);
        other_excess =
            limit_excess(s, max_component(s, other_u), &chain_step.rest, FOUR).max(other_excess);
        let other_moved = step.displaced(s, FOUR, other_u);
        for axis in 0..3 {
            // SAFETY: the caller guarantees it.
            unsafe {
                let column = columns[axis].add(at);
                s.store_to(column, moved[axis]);
                s.store_to(column.add(FOUR), other_moved[axis]);
            }
        }
        at += strided.link_stride;
    }
    !(s.any_positive(excess) || s.any_positive(other_excess))
}

/// As [`scatter_direct`], for chains that run along a column.
///
/// # Safety
/// The strided block lies within the columns and has at least four steps.
#[inline(never)]
unsafe fn scatter_transposed(
    strided: StridedBlock,
    block: &[chain_blocks::ChainStep],
    steps: &[LineStep],
    columns: [*mut f32; 3],
) -> bool {
    let s = Baseline::new();
    let zero = s.splat(0.0);
    let mut excess = zero;
    for first in [0, FOUR] {
        let (mut displacements, mut done) = ([[zero; FOUR]; 3], 0);
        for start in blocks_of_four(steps.len()) {
            let (steps, block) = (&steps[start..start + FOUR], &block[start..start + FOUR]);
            let at = strided.index(first, start);
            // The last four steps overlap with steps that are done.
            let before = FOUR - 1 - (done - start);
            done = start + FOUR;
            let mut largest = [zero; FOUR];
            // One axis at a time needs fewer registers.
            for axis in 0..3 {
                let (mut u, mut moved) = (displacements[axis][before], [zero; FOUR]);
                for (number, step) in steps.iter().enumerate() {
                    u = step.displacement_along(s, axis, first, u);
                    displacements[axis][number] = u;
                    moved[number] = u + s.load(&step.to[axis], first);
                    largest[number] = abs(s, u).max(largest[number]);
                }
                for (chain, row) in transpose_4x4(s, moved).into_iter().enumerate() {
                    // SAFETY: the caller guarantees it.
                    unsafe {
                        s.store_to(columns[axis].add(at + chain * strided.chain_stride), row);
                    };
                }
            }
            for (component, chain_step) in largest.into_iter().zip(block) {
                excess = limit_excess(s, component, &chain_step.rest, first).max(excess);
            }
        }
    }
    !s.any_positive(excess)
}

/// Displaces the particles of one chain, none farther than its limit.
fn scatter_chain_clamped(
    strided: StridedBlock,
    block: &[chain_blocks::ChainStep],
    steps: &[LineStep],
    columns: &mut [&mut [f32]; 3],
    chain: usize,
) {
    let mut u = [0.0; 3];
    for (number, (step, chain_step)) in steps.iter().zip(block).enumerate() {
        u = step.displacement(Scalar, chain, u);
        let moved = step.displaced(Scalar, chain, clamp_length(u, chain_step.rest[chain].abs()));
        for (column, moved) in columns.iter_mut().zip(moved) {
            column[strided.index(chain, number)] = moved;
        }
    }
}

/// The starts of blocks of four steps that cover `count` steps; the last block may overlap with the
/// one before.
fn blocks_of_four(count: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by(FOUR).map(move |start| start.min(count - FOUR))
}

impl StridedBlock {
    /// The index of the particle that a step of a chain runs to.
    #[inline(always)]
    fn index(&self, chain: usize, step: usize) -> usize {
        self.first + chain * self.chain_stride + step * self.link_stride
    }

    /// Checks that eight chains of `steps` steps lie within the columns.
    ///
    /// # Panics
    /// If they do not.
    fn assert_within<const N: usize>(&self, steps: usize, columns: [&[f32]; N]) {
        let last = self.index(LANES - 1, steps - 1);
        assert!(
            columns.iter().all(|column| last < column.len()),
            "every chain runs over existing particles"
        );
    }
}

const _: () = assert!(LANES == 2 * FOUR);
