//! Exact sign of the orientation of four points.
//!
//! ```text
//! orientation(a, b, c, d) = sign of det [a − d, b − d, c − d]
//! ```
//! A filter in f64 decides nearly all cases; where its error bound does not, expansions of f64 give
//! the exact sign (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
//! Predicates", DCG 1997).
//!
//! Reads points whose coordinates are f32 values; writes nothing.
//! Invariant: the sign is that of exact arithmetic.

use muslin::glam::DVec3;

/// Error bound of the filter, times the permanent of the determinant (Shewchuk, `o3derrboundA`).
const ERROR_BOUND: f64 = 7.771_561_172_376_103e-16;

/// 1 if `d` is below the plane through `a`, `b`, `c` (which appear counter-clockwise from above), −1
/// if above, 0 if the four are coplanar.
pub fn orientation([a, b, c, d]: [DVec3; 4]) -> i8 {
    let (u, v, w) = (a - d, b - d, c - d);
    let product =
        |i: usize, j: usize| [v.to_array()[i] * w.to_array()[j], w.to_array()[i] * v.to_array()[j]];
    let mut determinant = 0.0;
    let mut permanent = 0.0;
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let [p, q] = product(i, j);
        determinant += (p - q) * u.to_array()[k];
        permanent += (p.abs() + q.abs()) * u.to_array()[k].abs();
    }
    if determinant.abs() > ERROR_BOUND * permanent {
        return if determinant > 0.0 { 1 } else { -1 };
    }
    exact_orientation([a, b, c, d])
}

fn exact_orientation([a, b, c, d]: [DVec3; 4]) -> i8 {
    let difference = |p: DVec3| [0, 1, 2].map(|k| Expansion::difference(p[k], d[k]));
    let (u, v, w) = (difference(a), difference(b), difference(c));
    let mut sum = Expansion::default();
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        sum.add(&v[i].product(&w[j]).product(&u[k]), 1.0);
        sum.add(&w[i].product(&v[j]).product(&u[k]), -1.0);
    }
    sum.sign()
}

/// A sum of f64 that do not overlap, in ascending order of magnitude: an exact number.
#[derive(Clone, Debug, Default)]
struct Expansion(Vec<f64>);

impl Expansion {
    fn difference(a: f64, b: f64) -> Self {
        let mut sum = Self::default();
        sum.grow(a);
        sum.grow(-b);
        sum
    }

    /// Adds one number (Shewchuk, GROW-EXPANSION).
    fn grow(&mut self, number: f64) {
        let mut carry = number;
        let mut grown = Vec::with_capacity(self.0.len() + 1);
        for part in &self.0 {
            let (sum, error) = two_sum(carry, *part);
            carry = sum;
            grown.extend((error != 0.0).then_some(error));
        }
        grown.extend((carry != 0.0).then_some(carry));
        self.0 = grown;
    }

    /// Adds `sign` times another expansion; `sign` is 1 or −1.
    fn add(&mut self, other: &Self, sign: f64) {
        other.0.iter().for_each(|part| self.grow(part * sign));
    }

    fn product(&self, other: &Self) -> Self {
        let mut sum = Self::default();
        for a in &self.0 {
            for b in &other.0 {
                let product = a * b;
                sum.grow(a.mul_add(*b, -product));
                sum.grow(product);
            }
        }
        sum
    }

    fn sign(&self) -> i8 {
        self.0.last().map_or(0, |largest| if *largest > 0.0 { 1 } else { -1 })
    }
}

/// The rounded sum and its error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_follows_the_side_of_the_plane() {
        let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert_eq!(orientation([a, b, c, DVec3::Z]), -1);
        assert_eq!(orientation([a, b, c, -DVec3::Z]), 1);
        assert_eq!(orientation([a, b, c, DVec3::new(0.3, 0.9, 0.0)]), 0);
    }

    #[test]
    fn the_sign_is_exact_where_the_filter_cannot_decide() {
        // Four points of the plane z = x + y, one of them lifted by the smallest step of its z.
        let on =
            |x: f32, y: f32| DVec3::new(f64::from(x), f64::from(y), f64::from(x) + f64::from(y));
        let points = [on(1.0, 0.0), on(0.0, 1.0), on(3.0, 5.0), on(0.125, 0.25)];
        assert_eq!(orientation(points), 0);
        for (step, sign) in [(f64::EPSILON / 4.0, 1), (-f64::EPSILON / 4.0, -1)] {
            let mut moved = points;
            moved[3].z += step;
            let [a, b, c, d] = moved;
            let reference = orientation([a, b, c, DVec3::new(d.x, d.y, d.z + step * 1.0e9)]);
            assert_eq!(orientation(moved), reference, "{sign}");
            assert_ne!(orientation(moved), 0);
        }
    }
}
