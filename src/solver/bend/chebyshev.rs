//! Chebyshev iteration: approximates an implicit bending step by a few explicit ones.
//!
//! Method: an implicit step removes the share λ / (1 + λ) of a shape whose stiffness over mass is
//! λ. The Chebyshev iteration (Golub and Varga 1961) approximates 1 / (1 + λ) by a polynomial q for
//! all λ up to a bound; each step only evaluates forces. The interval is chosen so that λ = 0 is a
//! root of the error:
//!
//! ```text
//! 1 − (1 + λ) q(λ) = T(y(λ)) / T(y(−1)),    y maps λ = 0 to the first root of T and the bound to 1
//! ```
//! Wide folds have a small λ, so they bend exactly as the material says, with any number of steps.
//! With one step this is explicit Euler. The number of steps is about the square root of the bound.
//!
//! Reads a bound for the stiffness over mass; gives coefficients for `plate`.
//! Invariant: for every λ from 0 to the bound the relative error is at most `MAX_ERROR`, or
//! `MAX_ERROR_ONE_STEP` with one step.

/// Largest number of steps.
const MAX_STEPS: usize = 10;

/// tan²(π / (4 n)) for n steps: the distances of the first root of T_n to the two ends of [−1, 1],
/// the smaller divided by the larger.
const FIRST_ROOT_RATIO: [f32; MAX_STEPS] = [
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

/// Largest relative error against an implicit step, with several steps and with one step.
const MAX_ERROR: f32 = 0.2;
const MAX_ERROR_ONE_STEP: f32 = 0.34;

/// Coefficients of the steps: displacement = keep · last displacement + gain · w · force.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChebyshevSteps {
    steps: [[f32; 2]; MAX_STEPS],
    count: usize,
}

impl ChebyshevSteps {
    /// Chooses the fewest steps for a stiffness over mass of at most `bound` in every shape; `None`
    /// if that takes more than `MAX_STEPS`.
    pub fn new(bound: f32) -> Option<Self> {
        for (at, ratio) in FIRST_ROOT_RATIO.into_iter().enumerate() {
            let count = at + 1;
            let below = bound * ratio;
            let (middle, half) = (1.0 + 0.5 * (bound - below), 0.5 * (bound + below));
            // T at the point to which −1 maps.
            let far = middle / half;
            let (mut last, mut t) = (1.0, far);
            for _ in 1..count {
                (last, t) = (t, 2.0 * far * t - last);
            }
            let max_error = if count == 1 { MAX_ERROR_ONE_STEP } else { MAX_ERROR };
            // `far <= 1` means that −1 maps into the interval, where T does not grow.
            if far > 1.0 && t * max_error > 1.0 {
                return Some(Self::between(middle, half, count));
            }
        }
        None
    }

    fn between(middle: f32, half: f32, count: usize) -> Self {
        let mut steps = [[0.0; 2]; MAX_STEPS];
        steps[0] = [0.0, 1.0 / middle];
        let mut last = half / middle;
        for step in &mut steps[1..count] {
            let next = 1.0 / (2.0 * middle / half - last);
            *step = [next * last, 2.0 * next / half];
            last = next;
        }
        Self { steps, count }
    }

    /// Coefficients `[keep, gain]` of each step; `keep` of the first is 0.
    pub fn steps(&self) -> &[[f32; 2]] {
        &self.steps[..self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Displacement of a shape of amplitude 1 divided by λ.
    fn apply(steps: &ChebyshevSteps, lambda: f32) -> f32 {
        let (mut force, mut displacement, mut sum) = (1.0, 0.0, 0.0);
        for [keep, gain] in steps.steps() {
            force -= (1.0 + lambda) * displacement;
            displacement = displacement * keep + force * gain;
            sum += displacement;
        }
        sum
    }

    #[test]
    fn the_error_against_an_implicit_step_is_at_most_a_fifth() {
        for bound in [0.01, 0.3, 0.5, 1.5, 3.0, 8.0, 15.0, 24.0, 40.0] {
            let steps = ChebyshevSteps::new(bound).unwrap();
            for at in 0..=100 {
                let lambda = bound * at as f32 / 100.0;
                let error = 1.0 - (1.0 + lambda) * apply(&steps, lambda);
                let max_error = if steps.count == 1 { MAX_ERROR_ONE_STEP } else { MAX_ERROR };
                assert!(error.abs() < max_error + 1.0e-4, "error {error} at {lambda} of {bound}");
            }
            let flat = apply(&steps, 0.0);
            assert!((flat - 1.0).abs() < 1.0e-5, "λ = 0 gives {flat}, bound {bound}");
        }
        assert!(ChebyshevSteps::new(100.0).is_none());
        assert!(ChebyshevSteps::new(f32::NAN).is_none());
    }
}
