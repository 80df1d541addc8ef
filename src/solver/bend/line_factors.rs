//! Factors of the two directions of `plate`, for one shift.
//!
//! ```text
//! (µM + h² K_weft)   one pentadiagonal system per row
//! (µM + h² K_warp)   one pentadiagonal system per column
//! ```
//! Method: see `plate` and `banded`.
//!
//! Reads element weights, masses and inverse masses; writes the factors.
//! Invariant: the factors belong to the stored stiffness and shift; a stiffness of −1 marks none.

use crate::math::heap_bytes::heap_bytes;
use crate::model::plate_elements::{PerKind, PlateElements};
use crate::solver::bend::banded::{GridLine, PentadiagonalFactor};

/// Factors of both directions for one shift µ.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineFactors {
    pub stiffness: f32,
    pub shift: f32,
    pub weft: PentadiagonalFactor,
    pub warp: PentadiagonalFactor,
}

heap_bytes!(LineFactors { weft, warp } plain { stiffness, shift });

impl LineFactors {
    /// Allocates factors for `count` particles; no stiffness is factored yet.
    pub fn new(count: usize) -> Self {
        let (weft, warp) = (PentadiagonalFactor::new(count), PentadiagonalFactor::new(count));
        Self { stiffness: -1.0, shift: 0.0, weft, warp }
    }

    /// Factors all rows and columns for the current stiffness and shift.
    pub fn factor(
        &mut self,
        plates: &PlateElements,
        weight: &PerKind<Vec<f32>>,
        w: &[f32],
        mass: &[f32],
    ) {
        let (columns, rows) = (plates.columns, plates.rows);
        let (stiffness, shift) = (self.stiffness, self.shift);
        for row in 0..rows {
            let line = GridLine { first: row * columns, step: 1, count: columns };
            self.weft.factor(line, &weight[0], w, mass, stiffness, shift);
        }
        for column in 0..columns {
            let line = GridLine { first: column, step: columns, count: rows };
            self.warp.factor(line, &weight[1], w, mass, stiffness, shift);
        }
    }
}
