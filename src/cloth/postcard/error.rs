//! The error type of the postcard encoder and decoder. It has no values.
//!
//! Serde's traits return a `Result` for every field. With an error that cannot exist, the compiler
//! removes the code that handles it.
//! Invariant: nothing that the bytes contain makes serde create an error. The decoder marks damaged
//! bytes in `ByteReader::has_failed` and continues with zeros.

use core::fmt;
use serde::{de, ser};

/// An error without values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PostcardError {}

impl fmt::Display for PostcardError {
    fn fmt(&self, _: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {}
    }
}

impl std::error::Error for PostcardError {}

impl ser::Error for PostcardError {
    fn custom<T: fmt::Display>(_: T) -> Self {
        unsupported()
    }
}

impl de::Error for PostcardError {
    fn custom<T: fmt::Display>(_: T) -> Self {
        unsupported()
    }
}

/// Panics: the type of a field is one that saves never contain.
#[cold]
#[inline(never)]
pub(crate) fn unsupported() -> ! {
    panic!("saves contain no values of this type");
}

/// The result of encoding or decoding a value.
pub(crate) type PostcardResult<T> = Result<T, PostcardError>;
