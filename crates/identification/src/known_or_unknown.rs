//! A quantity that is known, a number, or sought, a range of two; and a share in percent.

use asperity_material::units::from_text;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{F64Deserializer, StrDeserializer};
use serde::de::{Error, IntoDeserializer, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

/// A quantity of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KnownOrUnknown<T> {
    /// It is this.
    Known(T),
    /// It lies between these two, the lower one first.
    Range([T; 2]),
}

impl<T: Copy> KnownOrUnknown<T> {
    /// The same in other terms.
    pub fn map<U>(self, f: impl Fn(T) -> U) -> KnownOrUnknown<U> {
        match self {
            KnownOrUnknown::Known(value) => KnownOrUnknown::Known(f(value)),
            KnownOrUnknown::Range(ends) => KnownOrUnknown::Range(ends.map(f)),
        }
    }
}

impl<T: Serialize> Serialize for KnownOrUnknown<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            KnownOrUnknown::Known(value) => value.serialize(serializer),
            KnownOrUnknown::Range(ends) => ends.serialize(serializer),
        }
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for KnownOrUnknown<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EitherVisitor(PhantomData))
    }
}

struct EitherVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for EitherVisitor<T> {
    type Value = KnownOrUnknown<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value that is known, or a list of two, [lowest, highest], for one that is sought")
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<KnownOrUnknown<T>, E> {
        let plain: F64Deserializer<E> = number.into_deserializer();
        T::deserialize(plain).map(KnownOrUnknown::Known)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<KnownOrUnknown<T>, E> {
        self.visit_f64(number as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<KnownOrUnknown<T>, E> {
        let plain: StrDeserializer<'_, E> = text.into_deserializer();
        T::deserialize(plain).map(KnownOrUnknown::Known)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<KnownOrUnknown<T>, A::Error> {
        let wrong = || A::Error::custom("a range is a list of two values, [lowest, highest]");
        let low = list.next_element()?.ok_or_else(wrong)?;
        let high = list.next_element()?.ok_or_else(wrong)?;
        match list.next_element::<T>()? {
            None => Ok(KnownOrUnknown::Range([low, high])),
            Some(_) => Err(wrong()),
        }
    }
}

impl<T: JsonSchema> JsonSchema for KnownOrUnknown<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Sought{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<T>();
        json_schema!({
            "anyOf": [one.clone(), { "type": "array", "items": one, "minItems": 2, "maxItems": 2 }]
        })
    }
}

/// A share, written in percent: "0.5 %".
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Percent(pub f64);

impl Serialize for Percent {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{:?} %", 100.0 * self.0))
    }
}

impl<'de> Deserialize<'de> for Percent {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_text(deserializer, "a percentage as a string, for example \"0.5 %\"")
    }
}

impl FromStr for Percent {
    type Err = String;

    fn from_str(text: &str) -> Result<Percent, String> {
        let number = text.trim().strip_suffix('%').and_then(|number| number.trim().parse::<f64>().ok());
        number
            .filter(|n| n.is_finite())
            .map(|n| Percent(n / 100.0))
            .ok_or_else(|| format!("\"{text}\" is no percentage: write it like \"0.5 %\""))
    }
}

impl JsonSchema for Percent {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Percent".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "pattern": r"^\s*[0-9.]+([eE][-+]?[0-9]+)?\s*%\s*$", "examples": ["0.5 %"] })
    }
}
