//! The bounds of all particles, in several lanes.
//!
//! Reads positions and writes nothing.
//! Invariant: minima and maxima do not depend on the order; NaN is left out.

use crate::geometry::aabb::Aabb;
use crate::math::columns::Columns;
use crate::math::{max, min};
use glam::Vec3;

/// Independent minima and maxima, so that one need not wait for the last.
const LANES: usize = 8;

/// Returns the smallest box around some positions [m].
pub(super) fn of_columns(positions: &Columns) -> Aabb {
    let mut extremes = [[f32::INFINITY, f32::NEG_INFINITY]; 3];
    for (column, extremes) in positions.slices().into_iter().zip(&mut extremes) {
        find_extremes(column, extremes);
    }
    let [low, high] = [0, 1].map(|k| Vec3::from_array(extremes.map(|axis| axis[k])));
    Aabb { low, high }
}

/// Extends `extremes`, the least and the largest value so far, by a column.
fn find_extremes(column: &[f32], extremes: &mut [f32; 2]) {
    let (chunks, rest) = column.as_chunks::<LANES>();
    let (mut low, mut high) = ([extremes[0]; LANES], [extremes[1]; LANES]);
    for chunk in chunks {
        for lane in 0..LANES {
            low[lane] = min(chunk[lane], low[lane]);
            high[lane] = max(chunk[lane], high[lane]);
        }
    }
    for value in rest.iter().chain(&low) {
        extremes[0] = min(*value, extremes[0]);
    }
    for value in rest.iter().chain(&high) {
        extremes[1] = max(*value, extremes[1]);
    }
}
