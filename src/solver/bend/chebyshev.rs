//! Descents: what an implicit step would do, in a few explicit ones.
//!
//! An implicit step takes a shape whose stiffness over mass is λ by the share λ / (1 + λ) of what it is bent.
//! Chebyshev's iteration (Golub and Varga 1961) comes near to 1 / (1 + λ) for all λ up to some bound
//! with a polynomial, step by step, without looking at more than forces. It is led here so that λ = 0 is a
//! root of what is left out:
//!
//! ```text
//! 1 − (1 + λ) q(λ) = T(y(λ)) / T(y(−1)),    y leads λ = 0 to the first root of T and the bound to 1
//! ```
//! so that wide folds, whose λ is small, bend as the material says however few the steps. With one step
//! it is the explicit one. The root of the bound is about as many steps as it takes.

/// As many steps as one descent has at most.
const MOST: usize = 10;

/// The square of the tangent of a quarter of a half turn over the number of steps: what the first root of
/// that Chebyshev polynomial is away from one end over what it is from the other.
const TO_FIRST_ROOT: [f32; MOST] = [
    1.0,
    0.171_572_88,
    0.071_796_77,
    0.039_566_13,
    0.025_085_63,
    0.017_332_38,
    0.012_695_19,
    0.009_700_557,
    0.007_654_266,
    0.006_193_959,
];

/// The share of an implicit step that may be left out, and what one step alone may.
const LEFT_OUT: f32 = 0.2;
const LEFT_OUT_BY_ONE: f32 = 0.34;

/// The steps: in each, the way is so much of the last way, and so much of what the force gives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChebyshevSteps {
    steps: [[f32; 2]; MOST],
    count: usize,
}

impl ChebyshevSteps {
    /// For a stiffness over mass of at most `bound` in whatever shape; none if that takes too many steps.
    pub fn new(bound: f32) -> Option<Self> {
        for (at, to_root) in TO_FIRST_ROOT.into_iter().enumerate() {
            let count = at + 1;
            let below = bound * to_root;
            let (middle, half) = (1.0 + 0.5 * (bound - below), 0.5 * (bound + below));
            // T of what −1 is led to.
            let far = middle / half;
            let (mut last, mut t) = (1.0, far);
            for _ in 1..count {
                (last, t) = (t, 2.0 * far * t - last);
            }
            let most = if count == 1 { LEFT_OUT_BY_ONE } else { LEFT_OUT };
            // Beyond 1 the first root is too far from its end.
            if far > 1.0 && t * most > 1.0 {
                return Some(Self::between(middle, half, count));
            }
        }
        None
    }

    fn between(middle: f32, half: f32, count: usize) -> Self {
        let mut steps = [[0.0; 2]; MOST];
        steps[0] = [0.0, 1.0 / middle];
        let mut last = half / middle;
        for step in &mut steps[1..count] {
            let next = 1.0 / (2.0 * middle / half - last);
            *step = [next * last, 2.0 * next / half];
            last = next;
        }
        Self { steps, count }
    }

    /// Keep and take of each step: the first keeps nothing.
    pub fn steps(&self) -> &[[f32; 2]] {
        &self.steps[..self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a descent moves a shape by that is bent by 1, over λ.
    fn descend(descent: &ChebyshevSteps, lambda: f32) -> f32 {
        let (mut force, mut way, mut sum) = (1.0, 0.0, 0.0);
        for [keep, take] in descent.steps() {
            force -= (1.0 + lambda) * way;
            way = way * keep + force * take;
            sum += way;
        }
        sum
    }

    #[test]
    fn a_descent_is_an_implicit_step_but_for_a_fifth() {
        for bound in [0.01, 0.3, 0.5, 1.5, 3.0, 8.0, 15.0, 24.0, 40.0] {
            let descent = ChebyshevSteps::new(bound).unwrap();
            for at in 0..=100 {
                let lambda = bound * at as f32 / 100.0;
                let left_out = 1.0 - (1.0 + lambda) * descend(&descent, lambda);
                let most = if descent.count == 1 { LEFT_OUT_BY_ONE } else { LEFT_OUT };
                assert!(left_out.abs() < most + 1.0e-4, "{left_out} left out of {lambda}/{bound}");
            }
            let flat = descend(&descent, 0.0);
            assert!((flat - 1.0).abs() < 1.0e-5, "flat shapes get {flat}, bound {bound}");
        }
        assert!(ChebyshevSteps::new(100.0).is_none());
        assert!(ChebyshevSteps::new(f32::NAN).is_none());
    }
}
