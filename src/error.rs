//! Errors of the public API.
//!
//! Every fallible call checks its arguments before it changes anything, so a call that returns an
//! error leaves the cloth unchanged. Each message names the field or argument and the rule that it
//! broke: "`settings.tick` must be above 0 and at most 1".

use core::fmt;

/// The result of every call that can fail.
pub type Result<T, E = Error> = core::result::Result<T, E>;

/// Why a call was refused. The refused call changed nothing.
///
/// Field and argument names are spelled as in the API. The C library and the JavaScript package
/// show these messages too; JavaScript converts the names to camelCase.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A value is out of range, not finite, or inconsistent with another value.
    BadValue {
        /// Name of the field or argument.
        field: &'static str,
        /// The broken rule, which completes the sentence "`field` must …".
        must: &'static str,
    },
    /// An entry of a list is out of range or not finite.
    BadEntry {
        /// Name of the list.
        field: &'static str,
        /// Index of the first such entry, from 0.
        index: u32,
        /// The broken rule, which completes the sentence "`field[index]` must …".
        must: &'static str,
    },
    /// A list does not have one entry per particle.
    BadCount {
        /// Name of the list.
        field: &'static str,
        /// Given number of entries.
        count: u32,
        /// Number of particles.
        needed: u32,
    },
    /// An index is not below the number of particles, vertices or points.
    BadIndex {
        /// Name of the field or argument.
        field: &'static str,
        /// The given index.
        index: u32,
        /// The number of items; valid indices are below it.
        count: u32,
    },
    /// A handle of a grab, an attachment or a collider is stale, made up or from another cloth.
    BadHandle {
        /// The kind of handle: "grab", "attachment" or "collider".
        what: &'static str,
    },
    /// The mesh cannot be made into cloth, even after repair.
    BadMesh {
        /// Index of the first triangle or vertex that breaks the rule.
        at: u32,
        /// The broken rule, which completes the sentence "`indices` must …".
        must: &'static str,
    },
    /// A vertex stream has a field that is invalid or does not fit another one.
    BadStream {
        /// Index of the stream in the list, from 0.
        stream: u32,
        /// Name of the field.
        field: &'static str,
        /// The broken rule, which completes the sentence "`streams[0].field` must …".
        must: &'static str,
    },
    /// The buffer of a vertex stream is too small.
    SmallStream {
        /// Index of the stream in the list, from 0.
        stream: u32,
        /// Required size [bytes], from the first written byte to the last.
        needed: u64,
        /// Given size [bytes].
        size: u64,
    },
    /// A limit on the number of items is reached, or the reserve for tears and cuts
    /// (`extra_particles`) is used up.
    Full {
        /// The item that does not fit, e.g. "another grab".
        what: &'static str,
    },
    /// The bytes are not a saved cloth, come from another format version, or are damaged.
    BadSave {
        /// The reason.
        why: &'static str,
    },
    /// The library was built without a feature of the crate that the request needs.
    MissingFeature {
        /// The request, e.g. "surface self-collision".
        what: &'static str,
        /// Name of the feature.
        feature: &'static str,
    },
    /// This version does not support the requested feature.
    Unsupported {
        /// The feature.
        what: &'static str,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message())
    }
}

impl Error {
    /// Returns the message, for language bindings. It is put together without `core::fmt`, which a
    /// wasm module then does not contain.
    #[doc(hidden)]
    pub fn message(&self) -> String {
        match self {
            Self::BadValue { field, must } => ["`", field, "` must ", must].concat(),
            Self::BadEntry { field, index, must } => {
                ["`", field, "[", &digits(*index), "]` must ", must].concat()
            }
            Self::BadCount { field, count, needed } => {
                let entries = " entries, one per particle, but has ";
                ["`", field, "` must have ", &digits(*needed), entries, &digits(*count)].concat()
            }
            Self::BadIndex { field, index, count } => {
                let (below, is) = ("` must be below ", ", but is ");
                ["`", field, below, &digits(*count), is, &digits(*index)].concat()
            }
            Self::BadHandle { what } => {
                ["`", what, "` must be a live ", what, " of this cloth"].concat()
            }
            Self::BadMesh { at, must } => {
                ["`indices` must ", must, " (triangle or vertex ", &digits(*at), ")"].concat()
            }
            Self::BadStream { stream, field, must } => {
                ["`streams[", &digits(*stream), "].", field, "` must ", must].concat()
            }
            Self::SmallStream { stream, needed, size } => {
                let (least, is) = ("].size` must be at least ", ", but is ");
                ["`streams[", &digits(*stream), least, &digits(*needed), is, &digits(*size)]
                    .concat()
            }
            Self::Full { what } => ["no room is left for ", what].concat(),
            Self::BadSave { why } => ["`buffer` must hold a saved cloth: ", why].concat(),
            Self::MissingFeature { what, feature } => {
                let rest = "`, which this build does not have";
                [what, " needs the feature `", feature, rest].concat()
            }
            Self::Unsupported { what } => [what, " is not supported"].concat(),
        }
    }
}

/// Returns the decimal digits of a number.
fn digits(number: impl Into<u64>) -> String {
    let (mut rest, mut digits) = (number.into(), Vec::new());
    loop {
        digits.push(char::from(b'0' + (rest % 10) as u8));
        rest /= 10;
        if rest == 0 {
            return digits.into_iter().rev().collect();
        }
    }
}

impl core::error::Error for Error {}

/// Returns [`Error::BadValue`] with `field` and `must` unless `ok`.
pub(crate) fn check(ok: bool, field: &'static str, must: &'static str) -> Result<()> {
    if ok { Ok(()) } else { Err(Error::BadValue { field, must }) }
}

/// Returns [`Error::BadValue`] for `field` unless all components of `v` are finite.
pub(crate) fn check_finite(v: glam::Vec3, field: &'static str) -> Result<()> {
    check(v.is_finite(), field, "be finite")
}

/// Returns [`Error::BadEntry`] for the first vector of the list `field` that is not finite.
pub(crate) fn check_all_finite(list: &[glam::Vec3], field: &'static str) -> Result<()> {
    match list.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(index) => Err(Error::BadEntry { field, index: index as u32, must: "be finite" }),
    }
}

/// Returns [`Error::BadIndex`] for `field` unless `index` is below `count`.
pub(crate) fn check_index(index: u32, count: usize, field: &'static str) -> Result<()> {
    if (index as usize) < count {
        Ok(())
    } else {
        Err(Error::BadIndex { field, index, count: count as u32 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_hold_all_digits_of_their_numbers() {
        for number in [0, 7, 10, 4_294_967_295, u64::MAX] {
            assert_eq!(digits(number), number.to_string());
        }
        let small = Error::SmallStream { stream: 3, needed: 12_000_000_000, size: 120 };
        let text = "`streams[3].size` must be at least 12000000000, but is 120";
        assert_eq!(small.to_string(), text);
        let count = Error::BadCount { field: "scales", count: 5, needed: 1600 };
        let text = "`scales` must have 1600 entries, one per particle, but has 5";
        assert_eq!(count.to_string(), text);
    }
}
