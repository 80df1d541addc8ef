//! Encoder and decoder for the postcard wire format, version 1 (<https://postcard.jamesmunns.com>).
//!
//! Integers of more than one byte are varints (seven bits per byte, lowest first); floats are
//! little-endian; lists are preceded by their length, enum variants by their index; structs have no
//! framing.
//!
//! Muslin has its own implementation to keep the code small: serde generates code per field, and
//! the postcard crate would be a twentieth of what a web page loads. For the same reason writing
//! cannot fail for the types of a save, and reading continues with zeros after the first error and
//! reports that error at the end.
//!
//! Reads and writes only its arguments.
//! Invariant: output and accepted input are the same as those of the postcard crate (tested).

mod error;
mod read;
mod write;

use crate::cloth::postcard::error::{PostcardError, PostcardResult};
use crate::cloth::postcard::read::ByteReader;
use crate::cloth::postcard::write::ByteWriter;
use serde::{Deserialize, Serialize};

/// Appends the encoded value to `prefix` and returns all bytes.
pub(crate) fn write(value: &impl Serialize, prefix: Vec<u8>) -> PostcardResult<Vec<u8>> {
    let mut writer = ByteWriter(prefix);
    value.serialize(&mut writer)?;
    Ok(writer.0)
}

/// Decodes a value from the start of `bytes`; ignores the bytes after it.
pub(crate) fn read<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> PostcardResult<T> {
    let mut reader = ByteReader::new(bytes);
    let value = T::deserialize(&mut reader)?;
    if reader.has_failed { Err(PostcardError) } else { Ok(value) }
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
        let bytes = write(&all(), vec![1, 2]).unwrap();
        assert_eq!(bytes[..2], [1, 2]);
        assert_eq!(bytes[2..], postcard::to_allocvec(&all()).unwrap());
        assert_eq!(read(&bytes[2..]), Ok(all()));
        let followed = [&bytes[2..], &[9]].concat();
        assert_eq!(read(&followed), Ok(all()));
    }

    #[test]
    fn damaged_bytes_give_the_same_value_or_error_as_in_postcard() {
        let bytes_of_all = write(&all(), Vec::new()).unwrap();
        for end in 0..bytes_of_all.len() {
            assert_eq!(read::<All>(&bytes_of_all[..end]), Err(PostcardError), "{end} bytes");
        }
        let mut still_readable = 0;
        for at in 0..bytes_of_all.len() {
            for change in [1, 2, 0x7f, 0x80, 0xff] {
                let mut bytes = bytes_of_all.clone();
                bytes[at] ^= change;
                let (ours, theirs) = (read::<All>(&bytes), postcard::from_bytes::<All>(&bytes));
                assert_eq!(ours.is_ok(), theirs.is_ok(), "byte {at} by {change}");
                if let (Ok(ours), Ok(theirs)) = (ours, theirs) {
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
            assert_eq!(read::<u16>(&short).ok(), postcard::from_bytes(&short).ok(), "{last}");
            let middle = [0xff, 0xff, 0xff, 0xff, last];
            assert_eq!(read::<u32>(&middle).ok(), postcard::from_bytes(&middle).ok(), "{last}");
            let mut long = [0xff; 10];
            long[9] = last;
            assert_eq!(read::<u64>(&long).ok(), postcard::from_bytes(&long).ok(), "{last}");
        }
    }

    #[test]
    fn a_false_list_length_allocates_no_memory() {
        let claim = [0xff, 0xff, 0xff, 0xff, 0x0f, 1, 2, 3];
        assert_eq!(read::<Vec<[u64; 4]>>(&claim), Err(PostcardError));
        assert_eq!(read::<Vec<Vec<Variants>>>(&claim), Err(PostcardError));
    }

    #[test]
    fn types_that_saves_never_contain_are_refused() {
        assert_eq!(write(&"text", Vec::new()), Err(PostcardError));
        assert_eq!(write(&-1, Vec::new()), Err(PostcardError));
        assert_eq!(read::<i32>(&[1]), Err(PostcardError));
        assert_eq!(read::<String>(&[1, 65]), Err(PostcardError));
    }
}
