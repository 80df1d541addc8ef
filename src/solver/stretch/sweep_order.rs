//! The direction of a Gauss-Seidel sweep through the colours of the constraints.
//!
//! The sweeps of a substep alternate (symmetric Gauss-Seidel), so that a load travels in both
//! directions through the cloth. Stages read it; nothing is written.
//! Invariant: the order of the colours changes the result, the order inside a colour does not.

/// The direction of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SweepOrder {
    Forward,
    Backward,
}
