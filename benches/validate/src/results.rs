//! Plays all runs of a case and keeps what they gave.

use crate::run::{Outcome, QUALITIES, Quality, RATES, Run};
use crate::trial::{Case, ErrorKind, Grade, Quantity, Trial};

/// A run and its outcome.
pub struct Played {
    pub run: Run,
    pub outcome: Outcome,
}

/// A trial with all of its runs.
pub struct TrialResult<'a> {
    pub trial: &'a Trial,
    pub played: Vec<Played>,
}

/// The run of one quality that is farthest off.
pub struct Worst {
    /// Its signed error, as the quantity measures errors.
    pub error: f64,
    pub grade: Grade,
    /// Runs of this quality that did not settle, of all.
    pub unsettled: [usize; 2],
    /// Greatest RMS speed of those that did not settle [m/s].
    pub speed: f64,
}

/// Plays all runs of the trials of a case.
pub fn play(case: &Case) -> Result<Vec<TrialResult<'_>>, String> {
    case.trials.iter().map(|trial| play_trial(case.name, trial)).collect()
}

fn play_trial<'a>(name: &str, trial: &'a Trial) -> Result<TrialResult<'a>, String> {
    let mut played = Vec::new();
    for quality in QUALITIES {
        for rate in RATES {
            for nodes in trial.nodes {
                let run = Run { quality, nodes: *nodes, rate };
                let outcome = (trial.play)(&run)
                    .map_err(|why| format!("{name}, {}, {nodes} nodes: {why}", quality.name()))?;
                played.push(Played { run, outcome });
            }
        }
    }
    Ok(TrialResult { trial, played })
}

impl TrialResult<'_> {
    /// The runs of a quality.
    pub fn of(&self, quality: Quality) -> impl Iterator<Item = &Played> {
        self.played.iter().filter(move |played| played.run.quality == quality)
    }

    /// The worst run of a quality. A run that did not settle misses.
    pub fn worst(&self, index: usize, quality: Quality) -> Worst {
        let quantity = &self.trial.quantities[index];
        let mut worst =
            Worst { error: 0.0, grade: Grade::Excellent, unsettled: [0, 0], speed: 0.0 };
        for Played { outcome, .. } in self.of(quality) {
            let value = outcome.values[index];
            let error = quantity.error(value);
            // NaN is worse than any number.
            if error.is_nan() || error.abs() >= worst.error.abs() {
                worst.error = error;
            }
            let grade = if outcome.settled { quantity.grade(value) } else { Grade::Missed };
            worst.grade = worst.grade.max(grade);
            worst.unsettled[0] += usize::from(!outcome.settled);
            worst.unsettled[1] += 1;
            worst.speed =
                if outcome.settled { worst.speed } else { worst.speed.max(outcome.rest_speed) };
        }
        worst
    }

    /// Mean time of a tick [ms] of a quality at these nodes.
    pub fn ms(&self, quality: Quality, nodes: u32) -> f64 {
        let times: Vec<f64> = self
            .of(quality)
            .filter(|played| played.run.nodes == nodes)
            .map(|played| played.outcome.ms)
            .collect();
        times.iter().sum::<f64>() / times.len().max(1) as f64
    }
}

/// Formats a signed error of a quantity: in per cent, or with the digits of its tolerance.
pub fn format_error(quantity: &Quantity, error: f64) -> String {
    match quantity.kind {
        _ if error.is_nan() => "none".into(),
        ErrorKind::Relative => {
            let digits = usize::from(error.abs() < 1.0);
            without_minus_zero(format!("{:+.digits$} %", 100.0 * error))
        }
        ErrorKind::Absolute => {
            without_minus_zero(format!("{error:+.*}", digits(quantity.tolerances[0] * 0.1)))
        }
    }
}

/// Formats a value or a reference of a quantity so that a tenth of its tolerance shows.
pub fn format_value(quantity: &Quantity, value: f64) -> String {
    let fine = match quantity.kind {
        ErrorKind::Relative => quantity.tolerances[0] * quantity.reference.abs(),
        ErrorKind::Absolute => quantity.tolerances[0],
    };
    let text = format!("{value:.*}", digits(0.1 * fine));
    if value.is_nan() { "none".into() } else { without_minus_zero(text) }
}

/// Formats the two tolerances of a quantity.
pub fn format_tolerances(quantity: &Quantity) -> String {
    let [excellent, ok] = quantity.tolerances;
    match quantity.kind {
        ErrorKind::Relative => format!("{:.1} / {:.1} %", 100.0 * excellent, 100.0 * ok),
        ErrorKind::Absolute => format!("{excellent} / {ok}"),
    }
}

/// The text of a number without the sign if it is zero as shown.
fn without_minus_zero(text: String) -> String {
    let is_zero = !text.contains(|letter: char| ('1'..='9').contains(&letter));
    if is_zero { text.replace(['-', '+'], "") } else { text }
}

/// Number of decimal places that show `step`.
fn digits(step: f64) -> usize {
    (-step.log10()).ceil().clamp(0.0, 6.0) as usize
}
