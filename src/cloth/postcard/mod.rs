//! Encoder and decoder for the postcard wire format, version 1 (<https://postcard.jamesmunns.com>).
//!
//! Integers of more than one byte are varints (seven bits per byte, lowest first); floats are
//! little-endian; lists are preceded by their length, enum variants by their index; structs have no
//! framing.
//!
//! Muslin has its own implementation to keep the code small: serde generates code per field, and
//! the postcard crate would be a twentieth of what a web page loads. For the same reason neither
//! has errors for serde: writing cannot fail for the types of a save, and reading continues with
//! zeros after the first error and reports that error at the end.
//!
//! Reads and writes only its arguments.
//! Invariant: output and accepted input are the same as those of the postcard crate (tested).

mod error;
mod read;
mod write;

use crate::cloth::postcard::read::ByteReader;
use crate::cloth::postcard::write::ByteWriter;
use serde::{Deserialize, Serialize};

/// Appends the encoded value to `prefix` and returns all bytes.
///
/// # Panics
/// If the value contains a type that saves never contain, such as a text.
pub(crate) fn write(value: &impl Serialize, prefix: Vec<u8>) -> Vec<u8> {
    let mut writer = ByteWriter(prefix);
    let Ok(()) = value.serialize(&mut writer);
    writer.0
}

/// Decodes a value from the start of `bytes`; ignores the bytes after it. Returns nothing if the
/// bytes do not encode such a value.
///
/// # Panics
/// As [`write()`].
pub(crate) fn read<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Option<T> {
    let mut reader = ByteReader::new(bytes);
    let Ok(value) = T::deserialize(&mut reader);
    (!reader.has_failed).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    enum Variants {
        Bare,
        One(u32),
        Two(u16, f32),
        Named { a: u8, b: Option<bool> },
    }

    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    struct Wrapped(f64);

    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    struct All {
        flag: bool,
        small: Vec<u8>,
        middle: Vec<u16>,
        large: Vec<u32>,
        largest: Vec<u64>,
        size: usize,
        floats: Vec<f32>,
        wrapped: Wrapped,
        some: Option<[u32; 3]>,
        none: Option<u32>,
        pair: (u8, f32),
        place: glam::Vec3,
        kinds: Vec<Variants>,
        nothing: (),
    }

    fn all() -> All {
        All {
            flag: true,
            small: (0..=255).collect(),
            middle: vec![0, 127, 128, 16_383, 16_384, u16::MAX],
            large: (0..32).flat_map(|bit| [(1 << bit) - 1, 1 << bit]).chain([u32::MAX]).collect(),
            largest: (0..64).flat_map(|bit| [(1 << bit) - 1, 1 << bit]).chain([u64::MAX]).collect(),
            size: 300,
            floats: vec![0.0, -0.0, 1.5, f32::INFINITY, f32::MIN_POSITIVE / 2.0],
            wrapped: Wrapped(-0.1),
            some: Some([1, 2, 3_000_000]),
            none: None,
            pair: (7, 0.25),
            place: glam::Vec3::new(1.0, 2.0, -3.0),
            kinds: vec![
                Variants::Bare,
                Variants::One(500),
                Variants::Two(9, 0.5),
                Variants::Named { a: 3, b: Some(false) },
                Variants::Named { a: 4, b: None },
            ],
            nothing: (),
        }
    }

    #[test]
    fn values_are_encoded_as_postcard_does_and_decoded_again() {
        let bytes = write(&all(), vec![1, 2]);
        assert_eq!(bytes[..2], [1, 2]);
        assert_eq!(bytes[2..], postcard::to_allocvec(&all()).unwrap());
        assert_eq!(read(&bytes[2..]), Some(all()));
        let followed = [&bytes[2..], &[9]].concat();
        assert_eq!(read(&followed), Some(all()));
    }

    #[test]
    fn damaged_bytes_give_the_same_value_or_error_as_in_postcard() {
        let bytes_of_all = write(&all(), Vec::new());
        for end in 0..bytes_of_all.len() {
            assert_eq!(read::<All>(&bytes_of_all[..end]), None, "{end} bytes");
        }
        let mut still_readable = 0;
        for at in 0..bytes_of_all.len() {
            for change in [1, 2, 0x7f, 0x80, 0xff] {
                let mut bytes = bytes_of_all.clone();
                bytes[at] ^= change;
                let (ours, theirs) = (read::<All>(&bytes), postcard::from_bytes::<All>(&bytes));
                assert_eq!(ours.is_some(), theirs.is_ok(), "byte {at} by {change}");
                if let (Some(ours), Ok(theirs)) = (ours, theirs) {
                    // Compare as text, since NaN is not equal to NaN.
                    assert_eq!(format!("{ours:?}"), format!("{theirs:?}"), "byte {at} by {change}");
                    still_readable += 1;
                }
            }
        }
        assert!(still_readable > 100, "only {still_readable} changes were still readable");
    }

    #[test]
    fn varints_with_too_many_bits_are_refused() {
        for last in 0..=255 {
            let short = [0xff, 0xff, last];
            assert_eq!(read::<u16>(&short), postcard::from_bytes(&short).ok(), "{last}");
            let middle = [0xff, 0xff, 0xff, 0xff, last];
            assert_eq!(read::<u32>(&middle), postcard::from_bytes(&middle).ok(), "{last}");
            let mut long = [0xff; 10];
            long[9] = last;
            assert_eq!(read::<u64>(&long), postcard::from_bytes(&long).ok(), "{last}");
        }
    }

    #[test]
    fn a_false_list_length_allocates_no_memory() {
        let claim = [0xff, 0xff, 0xff, 0xff, 0x0f, 1, 2, 3];
        assert_eq!(read::<Vec<[u64; 4]>>(&claim), None);
        assert_eq!(read::<Vec<Vec<Variants>>>(&claim), None);
    }

    #[test]
    fn types_that_saves_never_contain_panic() {
        let panics = |run: fn()| std::panic::catch_unwind(run).is_err();
        assert!(panics(|| drop(write(&"text", Vec::new()))));
        assert!(panics(|| drop(write(&-1, Vec::new()))));
        assert!(panics(|| assert_eq!(read::<i32>(&[1]), None)));
        assert!(panics(|| drop(read::<String>(&[1, 65]))));
    }
}
