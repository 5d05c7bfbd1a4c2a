//! Quantities written as strings with units ("210 GPa", "20 um"), kept in SI.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt::{self, Display};
use std::marker::PhantomData;
use std::str::FromStr;

/// The reason why a quantity could not be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct UnitError(String);

/// The size of a unit that files do not take, as messages add it: " (1 lbf is 4.448222 N)", or nothing.
pub(crate) fn conversion(unit: &str) -> String {
    const FACTORS: [(&str, &str); 12] = [
        ("A", "an ampere; write Å for 0.1 nm"),
        ("in", "25.4 mm"),
        ("inch", "25.4 mm"),
        ("mil", "25.4 um"),
        ("thou", "25.4 um"),
        ("lbf", "4.448222 N"),
        ("kgf", "9.80665 N"),
        ("gf", "9.80665 mN"),
        ("psi", "6.894757 kPa"),
        ("ksi", "6.894757 MPa"),
        ("kgf/mm2", "9.80665 MPa"),
        ("HV", "9.80665 MPa of hardness, which is no yield stress"),
    ];
    let known = FACTORS.iter().find(|(name, _)| *name == unit);
    known.map_or(String::new(), |(_, factor)| format!(" (1 {unit} is {factor})"))
}

/// Splits "20 um" into a finite number and a unit, and returns the number in SI.
fn parse(text: &str, dimension: &str, units: &[(&str, f64)]) -> Result<f64, UnitError> {
    let names = || units.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let text = text.trim();
    // the unit is the longest known one at the end, else the trailing run of letters; an exponent ("2e-6 m")
    // ends in a digit and so stays with the number
    let part_of_word = |c: char| c.is_alphabetic() || c == '/';
    let known = units.iter().filter_map(|(name, _)| {
        let number = text.strip_suffix(name)?;
        (!number.ends_with(part_of_word)).then_some(number.len())
    });
    let trailing = || {
        text.rfind(|c: char| !part_of_word(c))
            .map_or(0, |i| i + text[i..].chars().next().map_or(1, char::len_utf8))
    };
    let split = known.min().unwrap_or_else(trailing);
    let (number, unit) = (text[..split].trim(), &text[split..]);
    if unit.is_empty() {
        return Err(UnitError(format!(
            "\"{text}\" has no unit{}: write a {dimension} with one of {}, for example \"{} {}\"",
            if text.contains(char::is_alphabetic) { format!(" of {dimension}") } else { String::new() },
            names(),
            if text.contains(char::is_alphabetic) { "1" } else { text },
            units[0].0
        )));
    }
    let value: f64 = number.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
        let comma = number.replace(',', ".");
        let way = match comma.parse::<f64>() {
            Ok(_) if comma != number => format!(": write the decimal point, \"{comma} {unit}\""),
            _ => String::new(),
        };
        UnitError(format!("\"{text}\" is not a finite number with a unit of {dimension} ({}){way}", names()))
    })?;
    let scale = units.iter().find(|(name, _)| *name == unit).map(|(_, scale)| *scale).ok_or_else(|| {
        let factor = conversion(unit);
        UnitError(format!("\"{unit}\" is not a unit of {dimension}{factor}: use one of {}", names()))
    })?;
    let si = value * scale;
    if si.is_finite() && (value == 0.0) == (si == 0.0) {
        Ok(si)
    } else {
        Err(UnitError(format!("\"{text}\" is outside the range of numbers that can be computed with")))
    }
}

/// The JSON schema of a number with one of `units` in a string, which is what `parse` reads.
pub fn quantity_schema<'u>(units: impl IntoIterator<Item = &'u (&'u str, f64)>) -> Schema {
    let units: Vec<&str> = units.into_iter().map(|(name, _)| *name).collect();
    let number = r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?";
    json_schema!({
        "type": "string",
        "pattern": format!(r"^\s*{number}\s*({})\s*$", units.join("|").replace('(', r"\(").replace(')', r"\)")),
        "examples": [format!("1 {}", units.first().unwrap_or(&""))],
    })
}

/// Reads a value from a text; where none stands, the error says that `expected` should.
///
/// # Errors
/// Something else than a text, or a text that is no such value.
pub fn from_text<'de, T, D>(deserializer: D, expected: impl Display) -> Result<T, D::Error>
where
    T: FromStr<Err: Display>,
    D: Deserializer<'de>,
{
    struct Text<T, E>(PhantomData<T>, E);
    impl<T: FromStr<Err: Display>, E: Display> serde::de::Visitor<'_> for Text<T, E> {
        type Value = T;
        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.1.fmt(f)
        }
        fn visit_str<R: serde::de::Error>(self, text: &str) -> Result<T, R> {
            text.parse().map_err(R::custom)
        }
    }
    deserializer.deserialize_any(Text(PhantomData, expected))
}

/// `value` to so many significant digits: 210 GPa over 300 MPa is 700, whichever units they were written in.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// The shortest text that [`parse`] reads back to the bits of `value`, which is in `si`: of several equally
/// short ones that of the first unit. A value that is not finite has only its SI unit.
fn shortest(value: f64, si: &str, units: &[(&str, f64)]) -> String {
    let in_unit = |(name, scale): &(&str, f64)| {
        let mut numbers = (1..=17).map(|digits| rounded(value / scale, digits));
        let number = numbers.find(|number| number * scale == value)?;
        let digits = format!("{number:?}");
        Some(format!("{} {name}", digits.strip_suffix(".0").unwrap_or(&digits)))
    };
    // bar is read and not written: 0.5 MPa stays so
    let written = units.iter().filter(|(name, _)| name.is_ascii() && !name.ends_with("bar"));
    written.filter_map(in_unit).min_by_key(String::len).unwrap_or_else(|| format!("{value:?} {si}"))
}

macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident, $dimension:literal, $si:literal, $units:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
        pub struct $name(pub f64);

        impl $name {
            /// The units it may be written in, with their value in SI.
            pub const UNITS: &'static [(&'static str, f64)] = $units;

            /// The number of `unit`s in this quantity; `unit` must be one of [`Self::UNITS`], else NaN.
            pub fn in_unit(self, unit: &str) -> f64 {
                Self::UNITS.iter().find(|(name, _)| *name == unit).map_or(f64::NAN, |(_, scale)| self.0 / scale)
            }
        }

        impl std::str::FromStr for $name {
            type Err = UnitError;
            fn from_str(text: &str) -> Result<Self, UnitError> {
                parse(text, $dimension, Self::UNITS).map($name)
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(&self.to_string())
            }
        }

        impl fmt::Display for $name {
            /// The shortest text that reads back to the same bits.
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&shortest(self.0, $si, Self::UNITS))
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }
            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                quantity_schema(Self::UNITS)
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let unit = $name::UNITS[0].0;
                from_text(deserializer, format_args!("a {} as a string with a unit, for example \"1 {unit}\"", $dimension))
            }
        }
    };
}

quantity!(
    /// A length, kept in metres.
    Length, "length", "m",
    &[("um", 1e-6), ("nm", 1e-9), ("mm", 1e-3), ("cm", 1e-2), ("m", 1.0), ("µm", 1e-6), ("μm", 1e-6), ("pm", 1e-12), ("km", 1e3)]
);
quantity!(
    /// A stress, pressure or modulus, kept in pascals.
    Stress, "stress", "Pa",
    &[("MPa", 1e6), ("GPa", 1e9), ("kPa", 1e3), ("Pa", 1.0), ("TPa", 1e12), ("bar", 1e5), ("mbar", 1e2), ("N/mm2", 1e6), ("N/mm²", 1e6)]
);
quantity!(
    /// A force, kept in newtons.
    Force, "force", "N",
    &[("N", 1.0), ("mN", 1e-3), ("uN", 1e-6), ("µN", 1e-6), ("μN", 1e-6), ("nN", 1e-9), ("kN", 1e3), ("MN", 1e6)]
);
quantity!(
    /// A force per length (the load on a ridge in plane strain), kept in newtons per metre.
    LineForce, "force per length", "N/m",
    &[("N/mm", 1e3), ("N/m", 1.0), ("kN/m", 1e3), ("mN/m", 1e-3), ("kN/mm", 1e6)]
);
quantity!(
    /// A stiffness, force per depth, kept in newtons per metre.
    Stiffness, "stiffness", "N/m",
    &[("N/um", 1e6), ("mN/nm", 1e6), ("N/m", 1.0), ("mN/um", 1e3), ("N/mm", 1e3), ("kN/mm", 1e6), ("N/µm", 1e6), ("uN/nm", 1e3), ("MN/m", 1e6)]
);
quantity!(
    /// A way per force (of a machine's frame), kept in metres per newton.
    Compliance, "compliance", "m/N",
    &[("nm/mN", 1e-6), ("um/N", 1e-6), ("µm/N", 1e-6), ("μm/N", 1e-6), ("nm/N", 1e-9), ("nm/uN", 1e-3), ("um/mN", 1e-3), ("um/kN", 1e-9), ("mm/kN", 1e-6), ("mm/N", 1e-3), ("m/N", 1.0)]
);
quantity!(
    /// A thermal conductivity, kept in watts per metre and kelvin.
    ThermalConductivity, "thermal conductivity", "W/(m K)",
    &[("W/(m K)", 1.0), ("W/(m·K)", 1.0), ("W/(mK)", 1.0), ("W/mK", 1.0), ("W/m/K", 1.0), ("mW/(m K)", 1e-3)]
);
quantity!(
    /// An electrical conductivity, kept in siemens per metre.
    ElectricalConductivity, "electrical conductivity", "S/m",
    &[("MS/m", 1e6), ("S/m", 1.0), ("kS/m", 1e3), ("S/cm", 1e2)]
);
quantity!(
    /// Memory, kept in bytes.
    Memory, "memory", "B",
    &[("GB", 1e9), ("MB", 1e6), ("kB", 1e3), ("B", 1.0), ("GiB", 1073741824.0), ("MiB", 1048576.0)]
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_read_and_refuse_as_a_person_would_expect() {
        assert_eq!("20 um".parse::<Length>().unwrap().0, 20.0 * 1e-6);
        assert_eq!("2e-6m".parse::<Length>().unwrap().0, 2e-6);
        for (said, factor) in [
            ("2 mil".parse::<Length>().map(|v| v.0), "1 mil is 25.4 um"),
            ("3 lbf".parse::<Force>().map(|v| v.0), "1 lbf is 4.448222 N"),
            ("200 HV".parse::<Stress>().map(|v| v.0), "1 HV is 9.80665 MPa of hardness"),
        ] {
            let said = said.unwrap_err().to_string();
            assert!(said.contains(factor), "{said}");
        }
        assert_eq!(" 210 GPa ".parse::<Stress>().unwrap().0, 210e9);
        for (text, pascals, written) in
            [("2 bar", 2e5, "0.2 MPa"), ("0.1 mbar", 10.0, "10 Pa"), ("3 N/mm²", 3e6, "3 MPa")]
        {
            let stress: Stress = text.parse().unwrap();
            assert_eq!((stress.0, stress.to_string().as_str()), (pascals, written), "{text}");
        }
        for bad in ["20", "20 MPa", "nan um", "inf um", "um", "", "1e400 um", "1e-320 nm", "1 2 um"] {
            assert!(bad.parse::<Length>().is_err(), "{bad}");
        }
        let said = "3,5 um".parse::<Length>().unwrap_err().to_string();
        assert!(said.ends_with("write the decimal point, \"3.5 um\""), "{said}");
    }

    #[test]
    fn units_of_more_than_letters_are_read_and_their_lack_is_told() {
        for text in ["50 W/(m K)", "50W/(m·K)", "50 W/mK"] {
            assert_eq!(text.parse::<ThermalConductivity>().unwrap().0, 50.0);
        }
        assert_eq!(ThermalConductivity(0.5).to_string().parse::<ThermalConductivity>().unwrap().0, 0.5);
        assert_eq!("58 MS/m".parse::<ElectricalConductivity>().unwrap().0, 58.0 * 1e6);
        for (bad, word) in
            [("50", "has no unit:"), ("50 W/(m F)", "of thermal conductivity:"), ("50 W", "\"W\"")]
        {
            let said = bad.parse::<ThermalConductivity>().unwrap_err().to_string();
            assert!(said.contains(word) && said.contains("W/(m K)"), "{said}");
        }
    }

    #[test]
    fn a_written_quantity_reads_back_to_the_same_bits() {
        let odd = [20e-6, 1.0 / 3.0, 2e-300, 1e300, f64::MAX, -0.1, 0.0];
        let whole = (0..2000).map(|i| f64::from(i) * 1e-6);
        let any = (0..2000).map(|i| (0.37 * f64::from(i) - 300.0).exp());
        for v in odd.into_iter().chain(whole).chain(any) {
            assert_eq!(Length(v).to_string().parse::<Length>().unwrap().0.to_bits(), v.to_bits(), "{v:e}");
            assert_eq!(Stress(v).to_string().parse::<Stress>().unwrap().0.to_bits(), v.to_bits(), "{v:e}");
        }
    }

    #[test]
    fn a_quantity_is_written_as_a_person_writes_it() {
        for text in ["50 um", "0.3 um", "20 nm", "114.3 um", "1 mm", "1 m", "0 m", "1e-20 m"] {
            assert_eq!(text.parse::<Length>().unwrap().to_string(), text);
        }
        for text in ["210 GPa", "300 MPa", "1141 GPa", "0.3 Pa"] {
            assert_eq!(text.parse::<Stress>().unwrap().to_string(), text);
        }
        assert_eq!("30 uN".parse::<Force>().unwrap().to_string(), "30 uN");
        assert_eq!(Compliance(0.5 * 1e-6).to_string(), "0.5 um/N");
        assert_eq!(Length(f64::NAN).to_string(), "NaN m");
    }
}
