//! The error of the postcard encoder and decoder.
//!
//! It carries no detail: the caller reports any failure as damaged data.
//! Invariant: serde messages are dropped, so that no formatting code is linked.

use core::fmt;
use serde::{de, ser};

/// The value has a type that saves never contain, or the bytes do not encode the requested type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PostcardError;

impl fmt::Display for PostcardError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the bytes do not encode such a value")
    }
}

impl std::error::Error for PostcardError {}

impl ser::Error for PostcardError {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self
    }
}

impl de::Error for PostcardError {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self
    }
}

/// The result of encoding or decoding.
pub(crate) type PostcardResult<T> = Result<T, PostcardError>;
