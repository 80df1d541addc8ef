//! Decoder: a serde `Deserializer` over a byte slice.
//!
//! Reads the bytes; writes the value.
//! Invariant: after the first error, `has_failed` is set and every further read returns zeros, so
//! that the code for each field needs no branch.

use crate::cloth::postcard::error::{PostcardError, PostcardResult, unsupported};
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer};
use serde::de::{SeqAccess, VariantAccess, Visitor};
use serde::forward_to_deserialize_any;

/// The unread bytes, and whether reading has failed.
pub(crate) struct ByteReader<'a> {
    left: &'a [u8],
    pub has_failed: bool,
}

// Not inlined, since the generated code calls them for every field.
impl<'a> ByteReader<'a> {
    pub fn new(left: &'a [u8]) -> Self {
        Self { left, has_failed: false }
    }

    #[cold]
    #[inline(never)]
    fn fail(&mut self) {
        (self.left, self.has_failed) = (&[], true);
    }

    #[inline(never)]
    fn byte(&mut self) -> u8 {
        if let Some((first, left)) = self.left.split_first() {
            self.left = left;
            return *first;
        }
        self.fail();
        0
    }

    /// Reads a byte that must be 0 or 1.
    #[inline(never)]
    fn flag(&mut self) -> bool {
        let byte = self.byte();
        if byte > 1 {
            self.fail();
        }
        byte == 1
    }

    /// Reads a varint of at most `bits` bits.
    #[inline(never)]
    fn number(&mut self, bits: u32) -> u64 {
        let mut number = 0;
        for at in (0..bits).step_by(7) {
            let byte = self.byte();
            number |= u64::from(byte & 0x7f) << at;
            let remaining_bits = bits - at;
            if remaining_bits < 7 && byte >> remaining_bits != 0 {
                break;
            }
            if byte < 0x80 {
                return number;
            }
        }
        self.fail();
        0
    }

    /// Reads the index of one of `count` variants.
    #[inline(never)]
    fn variant(&mut self, count: u32) -> u32 {
        let at = self.number(u32::BITS) as u32;
        if at < count {
            return at;
        }
        self.fail();
        0
    }

    /// Reads four little-endian bytes.
    #[inline(never)]
    fn word(&mut self) -> u32 {
        if let Some((first, left)) = self.left.split_first_chunk() {
            self.left = left;
            return u32::from_le_bytes(*first);
        }
        self.fail();
        0
    }

    /// Reads the length of a list. Every entry takes at least one byte, so a length above the
    /// number of unread bytes is an error; this bounds the memory that false lengths can allocate.
    #[inline(never)]
    fn count(&mut self) -> usize {
        let count = self.number(usize::BITS) as usize;
        if count <= self.left.len() {
            return count;
        }
        self.fail();
        0
    }
}

/// Deserialize functions of the integer types.
macro_rules! numbers {
    ($($name:ident: $type:ty, $visit:ident;)*) => {$(
        #[inline]
        fn $name<V: Visitor<'de>>(self, visitor: V) -> PostcardResult<V::Value> {
            let number = self.number(<$type>::BITS);
            visitor.$visit(number as $type)
        }
    )*};
}

impl<'de> Deserializer<'de> for &mut ByteReader<'de> {
    type Error = PostcardError;

    // Types that saves never contain, and self-describing values, which the format does not have:
    // reading one panics.
    forward_to_deserialize_any! {
        i8 i16 i32 i64 i128 u128 char str string bytes byte_buf map identifier ignored_any
    }

    numbers! {
        deserialize_u16: u16, visit_u16;
        deserialize_u32: u32, visit_u32;
        deserialize_u64: u64, visit_u64;
    }

    fn is_human_readable(&self) -> bool {
        false
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> PostcardResult<V::Value> {
        unsupported()
    }

    #[inline]
    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> PostcardResult<V::Value> {
        visitor.visit_bool(self.flag())
    }

    #[inline]
    fn deserialize_u8<V: Visitor<'de>>(self, visitor: V) -> PostcardResult<V::Value> {
        visitor.visit_u8(self.byte())
    }

    #[inline]
    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> PostcardResult<V::Value> {
        visitor.visit_f32(f32::from_bits(self.word()))
    }

    #[inline]
    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> PostcardResult<V::Value> {
        let (low, high) = (self.word(), self.word());
        visitor.visit_f64(f64::from_bits(u64::from(high) << 32 | u64::from(low)))
    }

    #[inline]
    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> PostcardResult<V::Value> {
        if self.flag() { visitor.visit_some(self) } else { visitor.visit_none() }
    }

    #[inline]
    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> PostcardResult<V::Value> {
        visitor.visit_unit()
    }

    #[inline]
    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> PostcardResult<V::Value> {
        visitor.visit_unit()
    }

    #[inline]
    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> PostcardResult<V::Value> {
        visitor.visit_newtype_struct(self)
    }

    #[inline]
    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> PostcardResult<V::Value> {
        let left = self.count();
        visitor.visit_seq(Elements::<true> { reader: self, left })
    }

    #[inline]
    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        left: usize,
        visitor: V,
    ) -> PostcardResult<V::Value> {
        visitor.visit_seq(Elements::<false> { reader: self, left })
    }

    #[inline]
    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        left: usize,
        visitor: V,
    ) -> PostcardResult<V::Value> {
        visitor.visit_seq(Elements::<false> { reader: self, left })
    }

    #[inline]
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> PostcardResult<V::Value> {
        visitor.visit_seq(Elements::<false> { reader: self, left: fields.len() })
    }

    #[inline]
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> PostcardResult<V::Value> {
        let at = self.variant(variants.len() as u32);
        visitor.visit_enum(Variant { reader: self, at })
    }
}

/// The entries of a list, whose end is checked after an error, or the fields of a struct or tuple,
/// whose number is fixed.
struct Elements<'a, 'de, const IS_LIST: bool> {
    reader: &'a mut ByteReader<'de>,
    left: usize,
}

impl<'de, const IS_LIST: bool> SeqAccess<'de> for Elements<'_, 'de, IS_LIST> {
    type Error = PostcardError;

    #[inline]
    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> PostcardResult<Option<T::Value>> {
        // The generated code asks for each field of a struct or tuple once.
        if IS_LIST {
            if self.left == 0 || self.reader.has_failed {
                return Ok(None);
            }
            self.left -= 1;
        }
        Ok(Some(seed.deserialize(&mut *self.reader)?))
    }

    #[inline]
    fn size_hint(&self) -> Option<usize> {
        Some(self.left)
    }
}

/// A variant of an enum: its index, and the reader of its fields.
struct Variant<'a, 'de> {
    reader: &'a mut ByteReader<'de>,
    at: u32,
}

impl<'a, 'de> EnumAccess<'de> for Variant<'a, 'de> {
    type Error = PostcardError;
    type Variant = &'a mut ByteReader<'de>;

    #[inline]
    fn variant_seed<T: DeserializeSeed<'de>>(
        self,
        seed: T,
    ) -> PostcardResult<(T::Value, Self::Variant)> {
        let at = IntoDeserializer::<PostcardError>::into_deserializer(self.at);
        Ok((seed.deserialize(at)?, self.reader))
    }
}

impl<'de> VariantAccess<'de> for &mut ByteReader<'de> {
    type Error = PostcardError;

    #[inline]
    fn unit_variant(self) -> PostcardResult<()> {
        Ok(())
    }

    #[inline]
    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> PostcardResult<T::Value> {
        seed.deserialize(self)
    }

    #[inline]
    fn tuple_variant<V: Visitor<'de>>(self, left: usize, visitor: V) -> PostcardResult<V::Value> {
        visitor.visit_seq(Elements::<false> { reader: self, left })
    }

    #[inline]
    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> PostcardResult<V::Value> {
        visitor.visit_seq(Elements::<false> { reader: self, left: fields.len() })
    }
}
