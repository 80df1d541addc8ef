//! Values from bytes.

use crate::cloth::postcard::{Refused, Result};
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer};
use serde::de::{SeqAccess, VariantAccess, Visitor};
use serde::forward_to_deserialize_any;

/// What is left to read. Where the bytes end too early or are no such value, this is noted, and what is read from then
/// on is zeros: so nothing that reads a field has to look.
pub(crate) struct Reader<'a> {
    left: &'a [u8],
    pub has_failed: bool,
}

// Functions of their own, as they are called for every field.
impl<'a> Reader<'a> {
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

    /// 0 or 1, as whether there is something.
    #[inline(never)]
    fn flag(&mut self) -> bool {
        let byte = self.byte();
        if byte > 1 {
            self.fail();
        }
        byte == 1
    }

    /// A number of so many bits.
    #[inline(never)]
    fn number(&mut self, bits: u32) -> u64 {
        let mut number = 0;
        for at in (0..bits).step_by(7) {
            let byte = self.byte();
            number |= u64::from(byte & 0x7f) << at;
            let room = bits - at;
            if room < 7 && byte >> room != 0 {
                break;
            }
            if byte < 0x80 {
                return number;
            }
        }
        self.fail();
        0
    }

    #[inline(never)]
    fn word(&mut self) -> u32 {
        if let Some((first, left)) = self.left.split_first_chunk() {
            self.left = left;
            return u32::from_le_bytes(*first);
        }
        self.fail();
        0
    }

    /// How long a list is, whose every entry takes a byte at least: no list is believed to be longer than what is left.
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

/// Whole numbers.
macro_rules! numbers {
    ($($name:ident: $type:ty, $visit:ident;)*) => {$(
        #[inline]
        fn $name<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
            let number = self.number(<$type>::BITS);
            visitor.$visit(number as $type)
        }
    )*};
}

impl<'de> Deserializer<'de> for &mut Reader<'de> {
    type Error = Refused;

    // Kinds of which a cloth has nothing, and what says itself what it is.
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

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value> {
        Err(Refused)
    }

    #[inline]
    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_bool(self.flag())
    }

    #[inline]
    fn deserialize_u8<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_u8(self.byte())
    }

    #[inline]
    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_f32(f32::from_bits(self.word()))
    }

    #[inline]
    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        let (low, high) = (self.word(), self.word());
        visitor.visit_f64(f64::from_bits(u64::from(high) << 32 | u64::from(low)))
    }

    #[inline]
    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        if self.flag() { visitor.visit_some(self) } else { visitor.visit_none() }
    }

    #[inline]
    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_unit()
    }

    #[inline]
    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_unit()
    }

    #[inline]
    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_newtype_struct(self)
    }

    #[inline]
    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        let left = self.count();
        visitor.visit_seq(Parts::<true> { reader: self, left })
    }

    #[inline]
    fn deserialize_tuple<V: Visitor<'de>>(self, left: usize, visitor: V) -> Result<V::Value> {
        visitor.visit_seq(Parts::<false> { reader: self, left })
    }

    #[inline]
    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        left: usize,
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_seq(Parts::<false> { reader: self, left })
    }

    #[inline]
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_seq(Parts::<false> { reader: self, left: fields.len() })
    }

    #[inline]
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_enum(self)
    }
}

/// What follows each other: in a list, of which nothing more is made where reading has failed, or in what has as many
/// parts always.
struct Parts<'a, 'de, const IS_LIST: bool> {
    reader: &'a mut Reader<'de>,
    left: usize,
}

impl<'de, const IS_LIST: bool> SeqAccess<'de> for Parts<'_, 'de, IS_LIST> {
    type Error = Refused;

    #[inline]
    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>> {
        if self.left == 0 || IS_LIST && self.reader.has_failed {
            return Ok(None);
        }
        self.left -= 1;
        Ok(Some(seed.deserialize(&mut *self.reader)?))
    }

    #[inline]
    fn size_hint(&self) -> Option<usize> {
        Some(self.left)
    }
}

impl<'de> EnumAccess<'de> for &mut Reader<'de> {
    type Error = Refused;
    type Variant = Self;

    #[inline]
    fn variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<(T::Value, Self)> {
        let at = self.number(u32::BITS) as u32;
        Ok((seed.deserialize(IntoDeserializer::<Refused>::into_deserializer(at))?, self))
    }
}

impl<'de> VariantAccess<'de> for &mut Reader<'de> {
    type Error = Refused;

    #[inline]
    fn unit_variant(self) -> Result<()> {
        Ok(())
    }

    #[inline]
    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value> {
        seed.deserialize(self)
    }

    #[inline]
    fn tuple_variant<V: Visitor<'de>>(self, left: usize, visitor: V) -> Result<V::Value> {
        visitor.visit_seq(Parts::<false> { reader: self, left })
    }

    #[inline]
    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_seq(Parts::<false> { reader: self, left: fields.len() })
    }
}
