//! Reference values, computed from the governing equations.

pub mod catenary;
#[allow(dead_code)]
#[path = "../../../../tests/common/elastica.rs"]
pub mod elastica;
pub mod membrane;
pub mod oscillation;
pub mod slack_elastica;

/// The root of an increasing function between two values, by bisection.
pub fn root([mut low, mut high]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}
