//! Why a chore stopped, in one line.

use std::fmt;

/// What went wrong, and where there is one, what to do about it.
#[derive(Debug)]
pub struct Failure(String);

/// What a chore returns.
pub type Result<T = ()> = std::result::Result<T, Failure>;

impl Failure {
    /// Says `why`.
    pub fn new(why: impl Into<String>) -> Self {
        Self(why.into())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Says what was going on when something failed.
pub trait During<T> {
    /// `what` becomes the start of the sentence.
    fn during(self, what: impl FnOnce() -> String) -> Result<T>;
}

impl<T, E: fmt::Display> During<T> for std::result::Result<T, E> {
    fn during(self, what: impl FnOnce() -> String) -> Result<T> {
        // `{:#}` is how some errors tell their causes on the same line.
        self.map_err(|error| Failure::new(format!("{}: {error:#}", what())))
    }
}
