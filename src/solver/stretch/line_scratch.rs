//! Scratch buffers of the line solver.
//!
//! Written and read by `line_solver`, `line_gather` and `line_strided`.
//! Invariant: entry 0 of every list is a sentinel that belongs to no particle and no link; lanes of
//! a block without a link use it.

use crate::math::columns::Columns;
use crate::math::reserve::ReserveTotal;
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

/// How long the lists of a cloth are.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LineLengths {
    steps: usize,
    points: usize,
    columns: usize,
}

impl LineLengths {
    /// The lengths for blocks of at most `steps` steps over `particles` particles: points if blocks
    /// may have to be gathered, and columns if they may be strided.
    pub fn new(steps: usize, particles: usize, [gathers, has_strided]: [bool; 2]) -> Self {
        let [points, columns] =
            [gathers, has_strided].map(|is_used| if is_used { particles + 1 } else { 0 });
        Self { steps: steps + 1, points, columns }
    }
}

impl LineScratch {
    /// Removes all entries but the steps: of these, each block overwrites what it reads, and none
    /// writes the first one.
    pub fn clear(&mut self) {
        self.points.clear();
        self.start_points.clear();
        self.start_columns.resize(0);
    }

    /// Allocates lists of these lengths. Steps without an entry become zero.
    pub fn reserve(&mut self, lengths: LineLengths) {
        self.points.reserve_total(lengths.points);
        self.start_points.reserve_total(lengths.points);
        self.start_columns.reserve(lengths.columns);
        self.steps.reserve_total(lengths.steps);
        self.steps.resize(lengths.steps, LineStep::default());
    }
}
