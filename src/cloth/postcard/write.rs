//! Encoder: a serde `Serializer` that appends to a byte vector.
//!
//! Reads the value; writes the bytes.
//! Invariant: it cannot fail for the types that a save contains.

use crate::cloth::postcard::error::{PostcardError, PostcardResult, unsupported};
use serde::ser::{Impossible, Serialize, Serializer};
use serde::ser::{SerializeSeq, SerializeStruct, SerializeStructVariant};
use serde::ser::{SerializeTuple, SerializeTupleStruct, SerializeTupleVariant};

/// The bytes so far.
pub(crate) struct ByteWriter(pub Vec<u8>);

// Not inlined, since the generated code calls them for every field.
impl ByteWriter {
    #[inline(never)]
    fn byte(&mut self, byte: u8) {
        self.0.push(byte);
    }

    #[inline(never)]
    fn number(&mut self, mut number: u64) {
        while number >= 0x80 {
            self.0.push(number as u8 | 0x80);
            number >>= 7;
        }
        self.0.push(number as u8);
    }

    #[inline(never)]
    fn word(&mut self, word: u32) {
        self.0.extend_from_slice(&word.to_le_bytes());
    }
}

/// Serialize functions of types that saves never contain. They panic.
macro_rules! refuse {
    ($($name:ident: $type:ty,)*) => {$(
        fn $name(self, _: $type) -> PostcardResult<()> {
            unsupported()
        }
    )*};
}

/// Serialize functions of the integer types.
macro_rules! numbers {
    ($($name:ident: $type:ty,)*) => {$(
        #[inline]
        fn $name(self, number: $type) -> PostcardResult<()> {
            self.number(number.into());
            Ok(())
        }
    )*};
}

impl<'a> Serializer for &'a mut ByteWriter {
    type Ok = ();
    type Error = PostcardError;
    type SerializeSeq = &'a mut ByteWriter;
    type SerializeTuple = &'a mut ByteWriter;
    type SerializeTupleStruct = &'a mut ByteWriter;
    type SerializeTupleVariant = &'a mut ByteWriter;
    type SerializeMap = Impossible<(), PostcardError>;
    type SerializeStruct = &'a mut ByteWriter;
    type SerializeStructVariant = &'a mut ByteWriter;

    refuse! {
        serialize_i8: i8,
        serialize_i16: i16,
        serialize_i32: i32,
        serialize_i64: i64,
        serialize_char: char,
        serialize_str: &str,
        serialize_bytes: &[u8],
    }

    numbers! {
        serialize_u16: u16,
        serialize_u32: u32,
        serialize_u64: u64,
    }

    fn is_human_readable(&self) -> bool {
        false
    }

    #[inline]
    fn serialize_bool(self, v: bool) -> PostcardResult<()> {
        self.serialize_u8(v.into())
    }

    #[inline]
    fn serialize_u8(self, v: u8) -> PostcardResult<()> {
        self.byte(v);
        Ok(())
    }

    #[inline]
    fn serialize_f32(self, v: f32) -> PostcardResult<()> {
        self.word(v.to_bits());
        Ok(())
    }

    #[inline]
    fn serialize_f64(self, v: f64) -> PostcardResult<()> {
        self.word(v.to_bits() as u32);
        self.word((v.to_bits() >> 32) as u32);
        Ok(())
    }

    #[inline]
    fn serialize_none(self) -> PostcardResult<()> {
        self.serialize_u8(0)
    }

    #[inline]
    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> PostcardResult<()> {
        self.byte(1);
        value.serialize(self)
    }

    #[inline]
    fn serialize_unit(self) -> PostcardResult<()> {
        Ok(())
    }

    #[inline]
    fn serialize_unit_struct(self, _: &'static str) -> PostcardResult<()> {
        Ok(())
    }

    #[inline]
    fn serialize_unit_variant(
        self,
        _: &'static str,
        at: u32,
        _: &'static str,
    ) -> PostcardResult<()> {
        self.serialize_u32(at)
    }

    #[inline]
    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> PostcardResult<()> {
        value.serialize(self)
    }

    #[inline]
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        at: u32,
        _: &'static str,
        value: &T,
    ) -> PostcardResult<()> {
        self.number(at.into());
        value.serialize(self)
    }

    #[inline]
    fn serialize_seq(self, count: Option<usize>) -> PostcardResult<Self> {
        self.number(count.unwrap_or_else(|| unsupported()) as u64);
        Ok(self)
    }

    #[inline]
    fn serialize_tuple(self, _: usize) -> PostcardResult<Self> {
        Ok(self)
    }

    #[inline]
    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> PostcardResult<Self> {
        Ok(self)
    }

    #[inline]
    fn serialize_tuple_variant(
        self,
        _: &'static str,
        at: u32,
        _: &'static str,
        _: usize,
    ) -> PostcardResult<Self> {
        self.number(at.into());
        Ok(self)
    }

    fn serialize_map(self, _: Option<usize>) -> PostcardResult<Self::SerializeMap> {
        unsupported()
    }

    #[inline]
    fn serialize_struct(self, _: &'static str, _: usize) -> PostcardResult<Self> {
        Ok(self)
    }

    #[inline]
    fn serialize_struct_variant(
        self,
        _: &'static str,
        at: u32,
        _: &'static str,
        _: usize,
    ) -> PostcardResult<Self> {
        self.number(at.into());
        Ok(self)
    }
}

/// Serialize functions of sequences, tuples and structs: elements follow each other without
/// framing.
macro_rules! compounds {
    ($($compound:ident: $part:ident($($name:ty)?);)*) => {$(
        impl $compound for &mut ByteWriter {
            type Ok = ();
            type Error = PostcardError;

            #[inline]
            fn $part<T: Serialize + ?Sized>(&mut self, $(_: $name,)? value: &T) -> PostcardResult<()> {
                value.serialize(&mut **self)
            }

            #[inline]
            fn end(self) -> PostcardResult<()> {
                Ok(())
            }
        }
    )*};
}

compounds! {
    SerializeSeq: serialize_element();
    SerializeTuple: serialize_element();
    SerializeTupleStruct: serialize_field();
    SerializeTupleVariant: serialize_field();
    SerializeStruct: serialize_field(&'static str);
    SerializeStructVariant: serialize_field(&'static str);
}
