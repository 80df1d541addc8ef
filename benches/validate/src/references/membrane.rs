//! In-plane sag of a square membrane that is held by one vertical edge: plane stress without
//! coupling between warp and weft, and small strains.
//!
//! ```text
//! energy per area = ½ K (εx² + εy²) + ½ G γ²,   load per area = σ g, downwards
//! ```
//! Bilinear finite elements with 2 × 2 Gauss points (O. C. Zienkiewicz, "The Finite Element
//! Method", chapter 6), solved by conjugate gradients.

/// Elements along each side.
const SIDE: usize = 64;

/// Stiffness of a square element of side 1, for the unknowns ux, uy of its four corners.
fn element(stretch: f64, shear: f64) -> [[f64; 8]; 8] {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
    let mut stiffness = [[0.0; 8]; 8];
    let point = 1.0 / 3.0_f64.sqrt();
    for [px, py] in corners.map(|[x, y]: [f64; 2]| [x * point, y * point]) {
        // Derivatives of the shape functions; half a side is ½.
        let slopes = corners.map(|[x, y]| [0.5 * x * (1.0 + y * py), 0.5 * y * (1.0 + x * px)]);
        let mut strain = [[0.0; 8]; 3];
        for (corner, [dx, dy]) in slopes.into_iter().enumerate() {
            strain[0][2 * corner] = dx;
            strain[1][2 * corner + 1] = dy;
            strain[2][2 * corner] = dy;
            strain[2][2 * corner + 1] = dx;
        }
        for (row, modulus) in strain.into_iter().zip([stretch, stretch, shear]) {
            for i in 0..8 {
                for j in 0..8 {
                    stiffness[i][j] += 0.25 * modulus * row[i] * row[j];
                }
            }
        }
    }
    stiffness
}

/// Unknowns of the corners of an element.
fn unknowns(x: usize, y: usize) -> [usize; 8] {
    let node = |x: usize, y: usize| 2 * (y * (SIDE + 1) + x);
    let corners = [node(x, y), node(x + 1, y), node(x, y + 1), node(x + 1, y + 1)];
    core::array::from_fn(|i| corners[i / 2] + i % 2)
}

/// Stiffness times displacement; held unknowns have none.
fn multiply(stiffness: &[[f64; 8]; 8], displacement: &[f64], is_held: &[bool]) -> Vec<f64> {
    let mut force = vec![0.0; displacement.len()];
    for y in 0..SIDE {
        for x in 0..SIDE {
            let at = unknowns(x, y);
            for (row, i) in stiffness.iter().zip(at) {
                force[i] += row.iter().zip(at).map(|(k, j)| k * displacement[j]).sum::<f64>();
            }
        }
    }
    force.iter_mut().zip(is_held).filter(|(_, held)| **held).for_each(|(force, _)| *force = 0.0);
    force
}

/// Mean sag of the free vertical edge of a square of side `length` [m]; `stretch`, `shear` [N/m],
/// `load` = σ g [N/m²].
pub fn edge_sag(length: f64, stretch: f64, shear: f64, load: f64) -> f64 {
    let stiffness = element(stretch, shear);
    let count = 2 * (SIDE + 1) * (SIDE + 1);
    let is_held: Vec<bool> = (0..count).map(|i| (i / 2) % (SIDE + 1) == 0).collect();
    let mut residual = vec![0.0; count];
    let cell = length / SIDE as f64;
    for y in 0..SIDE {
        for x in 0..SIDE {
            for i in unknowns(x, y).into_iter().skip(1).step_by(2) {
                residual[i] += 0.25 * load * cell * cell;
            }
        }
    }
    residual.iter_mut().zip(&is_held).filter(|(_, held)| **held).for_each(|(r, _)| *r = 0.0);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (mut solution, mut direction) = (vec![0.0; count], residual.clone());
    let mut square = dot(&residual, &residual);
    let end = 1.0e-20 * square;
    while square > end {
        let force = multiply(&stiffness, &direction, &is_held);
        let step = square / dot(&direction, &force);
        for i in 0..count {
            solution[i] += step * direction[i];
            residual[i] -= step * force[i];
        }
        let next = dot(&residual, &residual);
        let share = next / square;
        square = next;
        direction.iter_mut().zip(&residual).for_each(|(d, r)| *d = r + share * *d);
    }
    let edge = (0..=SIDE).map(|y| solution[2 * (y * (SIDE + 1) + SIDE) + 1]);
    edge.sum::<f64>() / (SIDE + 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_membrane_with_rigid_threads_sags_by_shear_alone() {
        // σ g L² / (2 G); stretch adds about 1.5 σ g L² / K.
        let sag = edge_sag(0.3, 1.0e6, 50.0, 1.7658);
        assert!((sag / (1.7658 * 0.09 / 100.0) - 1.0).abs() < 0.01, "{sag}");
    }
}
