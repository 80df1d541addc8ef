//! Bytes in the format of postcard, version 1: numbers of more than a byte seven bits at a time, the lowest first;
//! floats as they are, little-endian; lists behind their length, enums behind their number, all else bare.
//!
//! Written out here since what a value is saved and restored by is woven in for every field: postcard's own code would
//! be a twentieth of what a page loads. So writing cannot fail, and reading goes on with zeros where it has failed.

mod read;
mod write;

use crate::cloth::postcard::read::Reader;
use crate::cloth::postcard::write::Writer;
use core::fmt;
use serde::{Deserialize, Serialize, de, ser};

/// Why a value is not written or not read: it is of a kind that no cloth is made of, or the bytes are not one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Refused;

type Result<T> = core::result::Result<T, Refused>;

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("it is no such value")
    }
}

impl std::error::Error for Refused {}

impl ser::Error for Refused {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self
    }
}

impl de::Error for Refused {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self
    }
}

/// Writes a value behind what there is.
pub(crate) fn write(value: &impl Serialize, behind: Vec<u8>) -> Result<Vec<u8>> {
    let mut writer = Writer(behind);
    value.serialize(&mut writer)?;
    Ok(writer.0)
}

/// Reads a value; what follows it is left.
pub(crate) fn read<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T> {
    let mut reader = Reader::new(bytes);
    let value = T::deserialize(&mut reader)?;
    if reader.has_failed { Err(Refused) } else { Ok(value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    enum Kind {
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
        kinds: Vec<Kind>,
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
                Kind::Bare,
                Kind::One(500),
                Kind::Two(9, 0.5),
                Kind::Named { a: 3, b: Some(false) },
                Kind::Named { a: 4, b: None },
            ],
            nothing: (),
        }
    }

    #[test]
    fn values_are_written_as_postcard_writes_them_and_read_back() {
        let bytes = write(&all(), vec![1, 2]).unwrap();
        assert_eq!(bytes[..2], [1, 2]);
        assert_eq!(bytes[2..], postcard::to_allocvec(&all()).unwrap());
        assert_eq!(read(&bytes[2..]), Ok(all()));
        let followed = [&bytes[2..], &[9]].concat();
        assert_eq!(read(&followed), Ok(all()));
    }

    #[test]
    fn whatever_postcard_refuses_is_refused_and_what_it_reads_is_read_alike() {
        let whole = write(&all(), Vec::new()).unwrap();
        for end in 0..whole.len() {
            assert_eq!(read::<All>(&whole[..end]), Err(Refused), "{end} bytes");
        }
        let mut read_anyway = 0;
        for at in 0..whole.len() {
            for change in [1, 2, 0x7f, 0x80, 0xff] {
                let mut bytes = whole.clone();
                bytes[at] ^= change;
                let (ours, theirs) = (read::<All>(&bytes), postcard::from_bytes::<All>(&bytes));
                assert_eq!(ours.is_ok(), theirs.is_ok(), "byte {at} by {change}");
                if let (Ok(ours), Ok(theirs)) = (ours, theirs) {
                    // Of numbers that are none, no two are equal.
                    assert_eq!(format!("{ours:?}"), format!("{theirs:?}"), "byte {at} by {change}");
                    read_anyway += 1;
                }
            }
        }
        assert!(read_anyway > 100, "only {read_anyway} changes gave another value");
    }

    #[test]
    fn numbers_of_more_bits_than_they_have_are_refused() {
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
    fn a_list_that_claims_to_be_endless_takes_no_memory() {
        let claim = [0xff, 0xff, 0xff, 0xff, 0x0f, 1, 2, 3];
        assert_eq!(read::<Vec<[u64; 4]>>(&claim), Err(Refused));
        assert_eq!(read::<Vec<Vec<Kind>>>(&claim), Err(Refused));
    }

    #[test]
    fn what_no_cloth_is_made_of_is_refused() {
        assert_eq!(write(&"text", Vec::new()), Err(Refused));
        assert_eq!(write(&-1, Vec::new()), Err(Refused));
        assert_eq!(read::<i32>(&[1]), Err(Refused));
        assert_eq!(read::<String>(&[1, 65]), Err(Refused));
    }
}
