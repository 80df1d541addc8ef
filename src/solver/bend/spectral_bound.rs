//! Upper bound for the stiffness over mass of any bending shape of a grid, as `chebyshev` needs it.
//!
//! With K the matrix of the bending energy and M the mass matrix, this is a bound for the largest
//! eigenvalue of M⁻¹ K, relative to the stiffness of an interior element.
//!
//! Method: bound by the diagonal for a whole sheet; Gershgorin's circle theorem (1931) for a torn
//! one. Reads element weights and inverse masses; `of_torn` also overwrites two buffers.
//! Invariant: no eigenvalue exceeds the bound.

use crate::model::plate_elements::PerKind;

/// Bound for a sheet without tears [1/kg]: four times the largest ratio of a particle's diagonal
/// stiffness to its mass, because the stiffness of an element is at most four times its share of
/// the diagonal.
pub(crate) fn of_whole(columns: usize, [weft, warp, twist]: &PerKind<Vec<f32>>, w: &[f32]) -> f32 {
    let before = |list: &[f32], at: usize, steps: usize| {
        if at >= steps { list[at - steps] } else { 0.0 }
    };
    let after =
        |list: &[f32], at: usize, steps: usize| list.get(at + steps).copied().unwrap_or(0.0);
    let mut largest = 0.0_f32;
    for at in 0..w.len() {
        let weft_sum = 4.0 * weft[at] + (before(weft, at, 1) + after(weft, at, 1));
        let warp_sum = 4.0 * warp[at] + (before(warp, at, columns) + after(warp, at, columns));
        let twist_sum = (twist[at] + before(twist, at, 1))
            + (before(twist, at, columns) + before(twist, at, columns + 1));
        let diagonal = ((weft_sum + warp_sum) + twist_sum) * w[at];
        largest = if diagonal > largest { diagonal } else { largest };
    }
    4.0 * largest
}

/// Bound for a torn sheet [1/kg]: the largest absolute row sum of M⁻½ K M⁻½ (Gershgorin 1931).
///
/// It is tighter where single particles with little mass are joined to heavy ones. The buffers
/// receive the square roots of `w`, and padded values per element.
pub(crate) fn of_torn(
    columns: usize,
    weight: &PerKind<Vec<f32>>,
    w: &[f32],
    (z, padded): (&mut [f32], &mut PerKind<Vec<f32>>),
) -> f32 {
    let (count, edge) = (w.len(), columns + 1);
    for (z, w) in z.iter_mut().zip(w) {
        *z = w.sqrt();
    }
    for at in 1..count - 1 {
        padded[0][edge + at] = weight[0][at] * (2.0 * z[at] + (z[at - 1] + z[at + 1]));
    }
    for at in columns..count - columns {
        padded[1][edge + at] = weight[1][at] * (2.0 * z[at] + (z[at - columns] + z[at + columns]));
    }
    for at in 0..count - edge {
        padded[2][edge + at] =
            weight[2][at] * ((z[at] + z[at + 1]) + (z[at + columns] + z[at + edge]));
    }
    let [weft, warp, twist] = padded;
    let mut largest = 0.0_f32;
    for (at, z) in z.iter().enumerate() {
        let weft_sum = 2.0 * weft[edge + at] + (weft[columns + at] + weft[edge + at + 1]);
        let warp_sum = 2.0 * warp[edge + at] + (warp[at + 1] + warp[edge + at + columns]);
        let twist_sum = (twist[edge + at] + twist[columns + at]) + (twist[at + 1] + twist[at]);
        let row = ((weft_sum + warp_sum) + twist_sum) * z;
        largest = if row > largest { row } else { largest };
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: usize = 9;
    const ROWS: usize = 7;

    /// Particles at a tear.
    const LIGHT: [usize; 2] = [3 * COLUMNS + 2, 3 * COLUMNS + 6];

    /// A sheet with one held particle, and two at a tear that hang from the cells above them with a
    /// quarter of the mass.
    fn torn() -> (PerKind<Vec<f32>>, Vec<f32>) {
        let mut weight = [const { Vec::new() }; 3];
        for at in 0..COLUMNS * ROWS {
            let (row, column) = (at / COLUMNS, at % COLUMNS);
            let is_inside = |at: usize, count: usize| f32::from(u8::from(at > 0 && at < count - 1));
            weight[0].push(is_inside(column, COLUMNS));
            weight[1].push(is_inside(row, ROWS));
            let is_cell = row < ROWS - 1 && column < COLUMNS - 1;
            weight[2].push(if is_cell { 2.0 } else { 0.0 });
        }
        let mut w = vec![1.0; COLUMNS * ROWS];
        w[COLUMNS] = 0.0;
        for at in LIGHT {
            w[at] = 4.0;
            [0, 1].into_iter().for_each(|right| weight[0][at + right] = 0.0);
            [0, COLUMNS].into_iter().for_each(|below| weight[1][at + below] = 0.0);
            [0, 1].into_iter().for_each(|left| weight[2][at - left] = 0.0);
        }
        (weight, w)
    }

    /// Largest eigenvalue by power iteration.
    fn exact([weft, warp, twist]: &PerKind<Vec<f32>>, w: &[f32]) -> f64 {
        let count = w.len();
        let mut x: Vec<f64> = (0..count).map(|at| (at as f64 * 2.3).sin()).collect();
        let mut largest = 0.0;
        for _ in 0..2000 {
            let mut force = vec![0.0; count];
            let mut add = |at: &[(usize, f64)], weight: f32| {
                let curve: f64 = at.iter().map(|(at, c)| x[*at] * c).sum();
                at.iter().for_each(|(at, c)| force[*at] += curve * c * f64::from(weight));
            };
            for at in (0..count).filter(|at| weft[*at] > 0.0) {
                add(&[(at - 1, 1.0), (at, -2.0), (at + 1, 1.0)], weft[at]);
            }
            for at in (0..count).filter(|at| warp[*at] > 0.0) {
                add(&[(at - COLUMNS, 1.0), (at, -2.0), (at + COLUMNS, 1.0)], warp[at]);
            }
            for at in (0..count).filter(|at| twist[*at] > 0.0) {
                let (right, below) = (at + 1, at + COLUMNS);
                add(&[(at, 1.0), (right, -1.0), (below, -1.0), (below + 1, 1.0)], twist[at]);
            }
            force.iter_mut().zip(w).for_each(|(force, w)| *force *= f64::from(*w));
            largest = force.iter().fold(0.0_f64, |largest, force| largest.max(force.abs()));
            x = force.iter().map(|force| force / largest).collect();
        }
        largest
    }

    fn bound_of_torn(weight: &PerKind<Vec<f32>>, w: &[f32]) -> f32 {
        let around = || vec![0.0; w.len() + 2 * (COLUMNS + 1)];
        let (mut z, mut padded) = (vec![0.0; w.len()], [around(), around(), around()]);
        of_torn(COLUMNS, weight, w, (&mut z, &mut padded))
    }

    #[test]
    fn no_eigenvalue_exceeds_either_bound() {
        let (weight, w) = torn();
        let exact = exact(&weight, &w);
        let bounds = [of_whole(COLUMNS, &weight, &w), bound_of_torn(&weight, &w)].map(f64::from);
        assert!(exact > 50.0 && bounds.iter().all(|bound| exact < *bound), "{exact} {bounds:?}");
    }

    #[test]
    fn light_particles_do_not_raise_the_bound_of_a_torn_sheet_above_a_whole_one() {
        let (weight, w) = torn();
        let [by_diagonal, by_rows] = [of_whole(COLUMNS, &weight, &w), bound_of_torn(&weight, &w)];
        let whole = 4.0 * 20.0;
        assert!(by_rows < whole && by_diagonal > 1.1 * whole, "{by_diagonal} {by_rows}");
    }
}
