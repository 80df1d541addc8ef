//! What holds today, for the tests: a few runs of many cases, each with the grade that it has.

use crate::run::Quality::{self, Accurate, Default};
use crate::run::Run;
use crate::trial::Case;
use crate::trial::Grade::{self, Excellent};

/// A run of a trial: case, start of the quantity's name, how it is played, and its grade.
struct Held(&'static str, &'static str, Quality, u32, u32, Grade);

const HELD: &[Held] = &[
    Held("shear", "sag of cotton, 0.3 m", Accurate, 24, 120, Excellent),
    Held("slack", "sag over L between clamps, Γ = 100", Default, 40, 60, Excellent),
    Held("slack", "height over L of a ring, Γ = 100", Default, 56, 60, Excellent),
    Held("slack", "height over L of a ring, Γ = 30", Default, 24, 60, Excellent),
    Held("cantilever", "H over L, Γ = 8.0042", Default, 24, 60, Excellent),
    Held("cantilever", "W over L, Γ = 100", Default, 40, 120, Excellent),
    Held("cantilever", "H over L, Γ = 10, 0.37 m", Default, 24, 60, Excellent),
    Held("cantilever", "length over bending length", Default, 56, 60, Excellent),
    Held("mesh", "H over L, Γ = 100", Default, 40, 60, Excellent),
    Held("mesh", "H over L, Γ = 8.0042", Default, 56, 60, Excellent),
    Held("mesh", "H over L, Γ = 1", Default, 56, 60, Excellent),
    Held("catenary", "sag over S, L/S = 1.05", Default, 56, 60, Excellent),
    Held("catenary", "sag over S, L/S = 1.1", Default, 24, 120, Excellent),
    Held("taut", "sag over S, Ks = 100 ", Default, 40, 60, Excellent),
    Held("taut", "sag over S, Ks = 1000 ", Accurate, 24, 120, Excellent),
    Held("hanging", "stretch by own weight, 1 m", Default, 56, 60, Excellent),
    Held("hanging", "stretch by five times", Default, 24, 60, Excellent),
    Held("hanging", "stretch with rigid links, 1 m", Default, 56, 60, Excellent),
    Held("flight", "drop in 1 s", Default, 24, 60, Excellent),
    Held("pendulum", "period, 90°", Default, 3, 60, Excellent),
    Held("pendulum", "energy left after 5 s, 90°", Default, 3, 60, Excellent),
    Held("swing", "energy gained at most in 5 s, 90°", Default, 24, 60, Excellent),
    Held("swing", "energy left after 5 s, 30°", Default, 40, 60, Excellent),
    Held("period", "period, 0.37 m", Default, 40, 60, Excellent),
    Held("spin", "angular momentum", Default, 24, 60, Excellent),
    Held("bulge", "bulge over the span at 5 m/s", Default, 24, 60, Excellent),
    Held("bulge", "bulge over the span at 10 m/s", Default, 40, 120, Excellent),
    Held("bulge", "bulge over the span at 10 m/s", Accurate, 24, 60, Excellent),
    Held("fall", "speed after 3 s, 0.15", Default, 24, 60, Excellent),
    Held("tilt", "angle, K = 1,", Default, 24, 60, Excellent),
    Held("friction", "slope at which it slides, µ = 0.5", Default, 24, 60, Excellent),
    Held("friction", "way in 1 s", Default, 24, 60, Excellent),
    Held("friction", "way until it stops, 1.3", Default, 40, 60, Excellent),
    Held("rebound", "rebound from 0.5 m, e = 0.5", Default, 24, 60, Excellent),
    Held("rest", "greatest RMS speed", Default, 24, 60, Excellent),
];

/// Plays the runs of [`HELD`] and fails with those that are worse than their grade.
pub fn check(cases: &[Case]) -> Result<(), String> {
    let mut misses = Vec::new();
    for Held(name, quantity, quality, nodes, rate, grade) in HELD {
        let run = Run { quality: *quality, nodes: *nodes, rate: *rate };
        let case = cases
            .iter()
            .find(|case| case.name == *name)
            .ok_or(format!("there is no case {name:?}"))?;
        let found = case.trials.iter().find_map(|trial| {
            let index = trial.quantities.iter().position(|q| q.name.starts_with(quantity))?;
            Some((trial, index))
        });
        let (trial, index) = found.ok_or(format!("{name} has no quantity {quantity:?}"))?;
        let outcome = (trial.play)(&run).map_err(|why| format!("{name}: {why}"))?;
        let measured = &trial.quantities[index];
        let value = outcome.values[index];
        let line = format!(
            "{name}: {}, {}, {nodes} nodes, 1/{rate} s: {value:.5}, reference {:.5}",
            measured.name,
            quality.name(),
            measured.reference
        );
        println!("{line}");
        if !outcome.settled || measured.grade(value) > *grade {
            misses.push(line);
        }
    }
    if misses.is_empty() { Ok(()) } else { Err(format!("missed:\n{}", misses.join("\n"))) }
}
