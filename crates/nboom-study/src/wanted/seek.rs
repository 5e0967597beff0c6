//! A number of a serialised value, by its JSON pointer. All that does not lead to it is passed over.

use std::fmt;

use serde::ser::{
    Impossible, Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeTuple, Serializer,
};

/// The number at a pointer; `None` where JSON has none.
pub(super) fn number(value: &impl Serialize, pointer: &str) -> Option<f64> {
    value.serialize(Seek { pointer }).ok().flatten()
}

type Found = Result<Option<f64>, fmt::Error>;

/// Takes what is at the end of a pointer.
#[derive(Clone, Copy)]
struct Seek<'p> {
    pointer: &'p str,
}

/// Takes what the first part of a pointer leads to in a list or table.
struct Inside<'p> {
    first: &'p str,
    rest: Seek<'p>,
    /// Of a list, how many elements have passed.
    passed: usize,
    /// Of a table, whether the last key is the one.
    is_next: bool,
    found: Option<f64>,
}

impl<'p> Seek<'p> {
    fn here(self, number: f64) -> Found {
        Ok(Some(number).filter(|number| self.pointer.is_empty() && number.is_finite()))
    }

    fn inside(self) -> Result<Inside<'p>, fmt::Error> {
        let path = self.pointer.strip_prefix('/').unwrap_or_default();
        let length = path.find('/').unwrap_or(path.len());
        let (first, pointer) = path.split_at(length);
        Ok(Inside { first, rest: Self { pointer }, passed: 0, is_next: false, found: None })
    }
}

impl Inside<'_> {
    fn take<T: Serialize + ?Sized>(&mut self, is_it: bool, value: &T) -> Result<(), fmt::Error> {
        if is_it {
            self.found = value.serialize(self.rest)?;
        }
        Ok(())
    }
}

/// A key as text.
struct Key<'k, T: ?Sized>(&'k T);

impl<T: Serialize + ?Sized> fmt::Display for Key<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.serialize(f)
    }
}

/// Numbers, and what is none.
macro_rules! numbers {
    ($($name:ident($type:ty))*) => {
        $(fn $name(self, value: $type) -> Found {
            self.here(value as f64)
        })*
    };
}
macro_rules! others {
    ($($name:ident($($type:ty),*))*) => {
        $(fn $name(self, $(_: $type),*) -> Found {
            Ok(None)
        })*
    };
}

impl<'p> Serializer for Seek<'p> {
    type Ok = Option<f64>;
    type Error = fmt::Error;
    type SerializeSeq = Inside<'p>;
    type SerializeTuple = Inside<'p>;
    type SerializeMap = Inside<'p>;
    type SerializeStruct = Inside<'p>;
    type SerializeTupleStruct = Impossible<Option<f64>, fmt::Error>;
    type SerializeTupleVariant = Impossible<Option<f64>, fmt::Error>;
    type SerializeStructVariant = Impossible<Option<f64>, fmt::Error>;

    numbers! {
        serialize_i8(i8) serialize_i16(i16) serialize_i32(i32) serialize_i64(i64)
        serialize_u8(u8) serialize_u16(u16) serialize_u32(u32) serialize_u64(u64)
        serialize_f32(f32) serialize_f64(f64)
    }

    others! {
        serialize_bool(bool) serialize_char(char) serialize_str(&str) serialize_bytes(&[u8])
        serialize_none() serialize_unit() serialize_unit_struct(&'static str)
        serialize_unit_variant(&'static str, u32, &'static str)
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Found {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Found {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: &T,
    ) -> Found {
        Err(fmt::Error)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Inside<'p>, fmt::Error> {
        self.inside()
    }

    fn serialize_tuple(self, _: usize) -> Result<Inside<'p>, fmt::Error> {
        self.inside()
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Inside<'p>, fmt::Error> {
        self.inside()
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Inside<'p>, fmt::Error> {
        self.inside()
    }

    fn serialize_tuple_struct(
        self,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleStruct, fmt::Error> {
        Err(fmt::Error)
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleVariant, fmt::Error> {
        Err(fmt::Error)
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeStructVariant, fmt::Error> {
        Err(fmt::Error)
    }
}

impl SerializeSeq for Inside<'_> {
    type Ok = Option<f64>;
    type Error = fmt::Error;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), fmt::Error> {
        let is_it = self.first.parse() == Ok(self.passed);
        self.passed += 1;
        self.take(is_it, value)
    }

    fn end(self) -> Found {
        Ok(self.found)
    }
}

impl SerializeTuple for Inside<'_> {
    type Ok = Option<f64>;
    type Error = fmt::Error;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), fmt::Error> {
        SerializeSeq::serialize_element(self, value)
    }

    fn end(self) -> Found {
        Ok(self.found)
    }
}

impl SerializeMap for Inside<'_> {
    type Ok = Option<f64>;
    type Error = fmt::Error;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), fmt::Error> {
        self.is_next = Key(key).to_string() == self.first;
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), fmt::Error> {
        self.take(self.is_next, value)
    }

    fn end(self) -> Found {
        Ok(self.found)
    }
}

impl SerializeStruct for Inside<'_> {
    type Ok = Option<f64>;
    type Error = fmt::Error;

    fn serialize_field<T: Serialize + ?Sized>(
        &mut self,
        key: &'static str,
        value: &T,
    ) -> Result<(), fmt::Error> {
        self.take(key == self.first, value)
    }

    fn end(self) -> Found {
        Ok(self.found)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[derive(serde::Serialize)]
    struct Inner {
        number: f64,
        none: Option<f64>,
    }

    #[derive(serde::Serialize)]
    struct Outer {
        #[serde(flatten)]
        flat: Inner,
        count: usize,
        below: i64,
        text: &'static str,
        list: Vec<Inner>,
        pair: (f64, f64),
        infinite: f64,
        named: BTreeMap<&'static str, f64>,
    }

    #[test]
    fn a_number_is_what_serde_json_has_at_its_pointer() {
        let inner = |number| Inner { number, none: None };
        let value = Outer {
            flat: Inner { number: 1.5, none: Some(0.25) },
            count: 7,
            below: -3,
            text: "4",
            list: vec![inner(2.0), inner(0.1 + 0.2)],
            pair: (5.0, 6.0),
            infinite: f64::INFINITY,
            named: [("a", 8.0), ("b", 9.0)].into(),
        };
        let json = serde_json::to_value(&value).expect("keys are texts");
        let there =
            ["/number", "/none", "/count", "/below", "/list/1/number", "/pair/1", "/named/b"];
        let not_there = [
            "",
            "/",
            "/text",
            "/list",
            "/list/2/number",
            "/list/0/none",
            "/infinite",
            "/a",
            "/named",
        ];
        for pointer in there.iter().chain(&not_there) {
            let expected = json.pointer(pointer).and_then(serde_json::Value::as_f64);
            assert_eq!(number(&value, pointer), expected, "{pointer}");
            assert_eq!(expected.is_some(), there.contains(pointer), "{pointer}");
        }
    }
}
