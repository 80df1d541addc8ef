//! Bytes as postcard writes and reads them, each number in a call of its own: woven in wherever a field is saved or
//! restored, what moves them would be most of what both take of a library.

use postcard::{Deserializer, Result, de_flavors, ser_flavors};
use serde::{Deserialize, Serialize};

/// Writes a value behind what there is.
pub(crate) fn write(value: &impl Serialize, behind: Vec<u8>) -> Result<Vec<u8>> {
    postcard::serialize_with_flavor(value, Written(behind))
}

/// Reads a value; what follows it is left.
pub(crate) fn read<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T> {
    T::deserialize(&mut Deserializer::from_flavor(Unread(bytes)))
}

struct Written(Vec<u8>);

impl ser_flavors::Flavor for Written {
    type Output = Vec<u8>;

    #[inline(never)]
    fn try_extend(&mut self, bytes: &[u8]) -> Result<()> {
        self.0.extend_from_slice(bytes);
        Ok(())
    }

    #[inline(never)]
    fn try_push(&mut self, byte: u8) -> Result<()> {
        self.0.push(byte);
        Ok(())
    }

    fn finalize(self) -> Result<Vec<u8>> {
        Ok(self.0)
    }
}

struct Unread<'a>(&'a [u8]);

impl<'a> de_flavors::Flavor<'a> for Unread<'a> {
    type Remainder = &'a [u8];
    type Source = &'a [u8];

    #[inline(never)]
    fn pop(&mut self) -> Result<u8> {
        let (first, rest) =
            self.0.split_first().ok_or(postcard::Error::DeserializeUnexpectedEnd)?;
        self.0 = rest;
        Ok(*first)
    }

    /// So that no list is believed to be longer than what is left.
    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }

    #[inline(never)]
    fn try_take_n(&mut self, count: usize) -> Result<&'a [u8]> {
        let (some, rest) =
            self.0.split_at_checked(count).ok_or(postcard::Error::DeserializeUnexpectedEnd)?;
        self.0 = rest;
        Ok(some)
    }

    fn finalize(self) -> Result<&'a [u8]> {
        Ok(self.0)
    }
}
