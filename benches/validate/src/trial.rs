//! Cases and their trials: what is measured, what it should be, and how far off it may be.
//!
//! ```text
//! Case ─▶ Trial ─▶ play(run) ─▶ one value per Quantity ─▶ error ─▶ Grade
//! ```

use crate::run::{NODES, Outcome, Run};

/// How the error of a value is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorKind {
    /// Difference, in the unit of the quantity.
    Absolute,
    /// Difference as a share of the reference.
    Relative,
}

/// Whether a value is within a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Grade {
    Excellent,
    Ok,
    Missed,
}

impl Grade {
    pub const fn name(self) -> &'static str {
        match self {
            Self::Excellent => "E",
            Self::Ok => "OK",
            Self::Missed => "neither",
        }
    }
}

/// What a trial measures.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Name with the unit, such as `sag of the free edge [mm]`.
    pub name: String,
    pub reference: f64,
    pub kind: ErrorKind,
    /// Greatest error that is excellent, and greatest one that is acceptable.
    pub tolerances: [f64; 2],
}

impl Quantity {
    pub fn absolute(name: impl Into<String>, reference: f64, tolerances: [f64; 2]) -> Self {
        Self { name: name.into(), reference, kind: ErrorKind::Absolute, tolerances }
    }

    pub fn relative(name: impl Into<String>, reference: f64, tolerances: [f64; 2]) -> Self {
        Self { name: name.into(), reference, kind: ErrorKind::Relative, tolerances }
    }

    /// The signed error of a value.
    pub fn error(&self, value: f64) -> f64 {
        match self.kind {
            ErrorKind::Absolute => value - self.reference,
            ErrorKind::Relative => value / self.reference - 1.0,
        }
    }

    /// The grade of a value; one that is not a number misses.
    pub fn grade(&self, value: f64) -> Grade {
        let error = self.error(value).abs();
        match self.tolerances {
            [excellent, _] if error <= excellent => Grade::Excellent,
            [_, ok] if error <= ok => Grade::Ok,
            _ => Grade::Missed,
        }
    }
}

/// Plays a trial.
pub type Play = Box<dyn Fn(&Run) -> muslin::Result<Outcome>>;

/// One simulation and what is measured in it.
pub struct Trial {
    pub quantities: Vec<Quantity>,
    /// The numbers of nodes that it is played with.
    pub nodes: &'static [u32],
    pub play: Play,
}

impl Trial {
    pub fn new(
        quantities: impl Into<Vec<Quantity>>,
        play: impl Fn(&Run) -> muslin::Result<Outcome> + 'static,
    ) -> Self {
        Self { quantities: quantities.into(), nodes: &NODES, play: Box::new(play) }
    }
}

/// A group of trials with one source.
pub struct Case {
    /// What a person types to play it alone.
    pub name: &'static str,
    /// What is played.
    pub about: &'static str,
    /// Where the references come from: formula and publication.
    pub source: &'static str,
    pub trials: Vec<Trial>,
    /// Whether it is played if no case is named.
    pub is_default: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grade_is_that_of_the_error() {
        let length = Quantity::relative("length [m]", 2.0, [0.01, 0.05]);
        assert_eq!(length.grade(2.01), Grade::Excellent);
        assert_eq!(length.grade(1.92), Grade::Ok);
        assert_eq!(length.grade(2.2), Grade::Missed);
        assert_eq!(length.grade(f64::NAN), Grade::Missed);
        let stretch = Quantity::absolute("stretch [%]", 0.0, [0.5, 2.0]);
        assert_eq!(stretch.grade(-0.4), Grade::Excellent);
        assert_eq!(stretch.grade(-2.5), Grade::Missed);
    }
}
