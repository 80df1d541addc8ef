//! What a caller can get wrong, said in words that name the field and the rule.

use core::fmt;

/// The result of every call whose input can be wrong.
pub type Result<T, E = Error> = core::result::Result<T, E>;

/// Why a call was refused. Whatever refused it left the cloth as it was.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A value is out of its range, not finite, or does not fit another one.
    BadValue {
        /// The field or argument, as it is spelt in the API.
        field: &'static str,
        /// The rule it broke: "`field` must …".
        must: &'static str,
    },
    /// An index points past the last particle or vertex.
    BadIndex {
        /// The field or argument, as it is spelt in the API.
        field: &'static str,
        /// What was given.
        index: u32,
        /// How many there are.
        count: u32,
    },
    /// A handle of a grab, an attachment or a collider that this cloth does not have (any more).
    BadHandle {
        /// The kind of handle: "grab", "attachment" or "collider".
        what: &'static str,
    },
    /// The mesh cannot be cloth.
    BadMesh {
        /// The first triangle or vertex at fault.
        at: u32,
        /// The rule it broke.
        must: &'static str,
    },
    /// A stream of vertices cannot be written.
    BadStream {
        /// Which of the streams, from 0 on.
        stream: u32,
        /// Its field, as it is spelt in the API.
        field: &'static str,
        /// The rule it broke: "`streams[0].field` must …".
        must: &'static str,
    },
    /// The buffer of a stream of vertices has too little room.
    SmallStream {
        /// Which of the streams, from 0 on.
        stream: u32,
        /// The bytes that are to be written, from the first to the last.
        needed: u64,
        /// The bytes that there are.
        size: u64,
    },
    /// The room that was reserved when the cloth was made is used up.
    Full {
        /// What there is no room for.
        what: &'static str,
    },
    /// The bytes are not a saved cloth of this version, or were damaged.
    BadSave {
        /// What is wrong with them.
        why: &'static str,
    },
    /// A known wish that this version does not fulfil yet.
    Unsupported {
        /// The wish.
        what: &'static str,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadValue { field, must } => write!(f, "`{field}` must {must}"),
            Self::BadIndex { field, index, count } => {
                write!(f, "`{field}` must be below {count}, but is {index}")
            }
            Self::BadHandle { what } => write!(f, "`{what}` must be a live {what} of this cloth"),
            Self::BadMesh { at, must } => write!(f, "`indices` must {must} (see number {at})"),
            Self::BadStream { stream, field, must } => {
                write!(f, "`streams[{stream}].{field}` must {must}")
            }
            Self::SmallStream { stream, needed, size } => {
                write!(f, "`streams[{stream}].size` must be at least {needed}, but is {size}")
            }
            Self::Full { what } => write!(f, "no room is left for {what}"),
            Self::BadSave { why } => write!(f, "`buffer` must hold a saved cloth: {why}"),
            Self::Unsupported { what } => write!(f, "{what} is not supported"),
        }
    }
}

impl core::error::Error for Error {}

/// Refuses a number that is not finite or breaks `rule`.
pub(crate) fn check(ok: bool, field: &'static str, must: &'static str) -> Result<()> {
    if ok { Ok(()) } else { Err(Error::BadValue { field, must }) }
}

/// Refuses a vector with a component that is not finite.
pub(crate) fn check_finite(v: glam::Vec3, field: &'static str) -> Result<()> {
    check(v.is_finite(), field, "be finite")
}

/// Refuses an index that is not below `count`.
pub(crate) fn check_index(index: u32, count: usize, field: &'static str) -> Result<()> {
    if (index as usize) < count {
        Ok(())
    } else {
        Err(Error::BadIndex { field, index, count: count as u32 })
    }
}
