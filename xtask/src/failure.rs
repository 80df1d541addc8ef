//! The error of every chore: one line that says why it stopped.

use std::fmt;

/// Why a chore stopped, and where there is one, the remedy.
#[derive(Debug)]
pub struct Failure(String);

/// The result of a chore.
pub type Result<T = ()> = std::result::Result<T, Failure>;

impl Failure {
    /// A failure with this message.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Adds to an error what the program was doing.
pub trait During<T> {
    /// Puts `activity`, such as "reading a.txt", before the message of an error.
    fn during(self, activity: impl FnOnce() -> String) -> Result<T>;
}

impl<T, E: fmt::Display> During<T> for std::result::Result<T, E> {
    fn during(self, activity: impl FnOnce() -> String) -> Result<T> {
        // With `{:#}` some errors print their causes on the same line.
        self.map_err(|error| Failure::new(format!("{}: {error:#}", activity())))
    }
}
