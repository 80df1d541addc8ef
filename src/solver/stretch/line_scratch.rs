//! Scratch buffers of the line solver.
//!
//! Written and read by `line_solver`, `line_gather` and `line_strided`.
//! Invariant: entry 0 of every list is a sentinel that belongs to no particle and no link; lanes of
//! a block without a link use it.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::solver::stretch::line_step::LineStep;

/// Gathered particles, and the steps of the block that is solved.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineScratch {
    /// `[x, y, z, w]` of each particle, after the sentinel.
    pub points: Vec<[f32; 4]>,
    /// `[x, y, z, 0]` of each particle at the start of the substep, after the sentinel.
    pub start_points: Vec<[f32; 4]>,
    /// Positions at the start of the substep as columns, after the sentinel; used by strided
    /// blocks.
    pub start_columns: Columns,
    /// The steps of one block, after the sentinel.
    pub steps: Vec<LineStep>,
}

heap_bytes!(LineScratch { points, start_points, start_columns, steps } plain {});

impl LineScratch {
    /// Allocates buffers for blocks of at most `steps` steps over `particles` particles: points if
    /// blocks may have to be gathered, and columns if they may be strided.
    pub fn new(steps: usize, particles: usize, [gathers, has_strided]: [bool; 2]) -> Self {
        let [points, columns] =
            [gathers, has_strided].map(|is_used| if is_used { particles + 1 } else { 0 });
        Self {
            points: Vec::with_capacity(points),
            start_points: Vec::with_capacity(points),
            start_columns: Columns::with_capacity(columns),
            steps: vec![LineStep::default(); steps + 1],
        }
    }
}
