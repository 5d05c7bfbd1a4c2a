//! Units of columns: symbols and words with their value in SI.

use crate::units::{Force, Length, Stress};

/// Dimension of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Metres.
    Length,
    /// Newtons.
    Force,
    /// Pascals.
    Stress,
    /// A pure number.
    Ratio,
}

/// Prefixes that are written out, and those of symbols.
pub(crate) const PREFIXES: [(&str, f64); 10] = [
    ("pico", 1e-12),
    ("nano", 1e-9),
    ("micro", 1e-6),
    ("mikro", 1e-6),
    ("milli", 1e-3),
    ("centi", 1e-2),
    ("kilo", 1e3),
    ("mega", 1e6),
    ("giga", 1e9),
    ("deci", 1e-1),
];

/// Units of ratios, and their names, with their value.
const RATIOS: &[(&str, f64)] = &[
    ("", 1.0),
    ("1", 1.0),
    ("-", 1.0),
    ("–", 1.0),
    ("—", 1.0),
    ("#", 1.0),
    ("mm/mm", 1.0),
    ("m/m", 1.0),
    ("in/in", 1.0),
    ("%", 1e-2),
    ("percent", 1e-2),
    ("per cent", 1e-2),
    ("pct", 1e-2),
    ("prozent", 1e-2),
    ("pourcent", 1e-2),
    ("‰", 1e-3),
    ("permille", 1e-3),
    ("per mille", 1e-3),
    ("promille", 1e-3),
    ("millistrain", 1e-3),
    ("mε", 1e-3),
    ("mm/m", 1e-3),
    ("microstrain", 1e-6),
    ("micro strain", 1e-6),
    ("ustrain", 1e-6),
    ("µstrain", 1e-6),
    ("μstrain", 1e-6),
    ("µε", 1e-6),
    ("με", 1e-6),
    ("µm/m", 1e-6),
    ("μm/m", 1e-6),
    ("um/m", 1e-6),
];

const POUND: f64 = 4.448_221_615_260_5;

/// Symbols and words of lengths beside those of a scene, with their SI value.
const LENGTHS: &[(&str, f64)] = &[
    ("Å", 1e-10),
    ("å", 1e-10),
    ("angstrom", 1e-10),
    ("inch", 0.0254),
    ("inches", 0.0254),
    ("in", 0.0254),
    ("mil", 25.4e-6),
    ("mils", 25.4e-6),
    ("thou", 25.4e-6),
    ("uin", 25.4e-9),
    ("µin", 25.4e-9),
    ("microinch", 25.4e-9),
    ("microinches", 25.4e-9),
    ("micron", 1e-6),
    ("microns", 1e-6),
    ("mkm", 1e-6),
    ("мкм", 1e-6),
    ("нм", 1e-9),
    ("мм", 1e-3),
    ("м", 1.0),
];

/// The same of forces: the load of a hardness tester in grams is their weight.
const FORCES: &[(&str, f64)] = &[
    ("g", 9.80665e-3),
    ("kg", 9.80665),
    ("gf", 9.80665e-3),
    ("kgf", 9.80665),
    ("kp", 9.80665),
    ("mgf", 9.80665e-6),
    ("lbf", POUND),
    ("lb", POUND),
    ("lbs", POUND),
    ("pound", POUND),
    ("pounds", POUND),
    ("kip", 1e3 * POUND),
    ("kips", 1e3 * POUND),
    ("gram", 9.80665e-3),
    ("grams", 9.80665e-3),
    ("cN", 1e-2),
    ("daN", 10.0),
    ("dyn", 1e-5),
    ("мкН", 1e-6),
    ("мН", 1e-3),
    ("Н", 1.0),
];

/// The same of stresses.
const STRESSES: &[(&str, f64)] = &[
    ("N/mm2", 1e6),
    ("N/mm²", 1e6),
    ("N/mm^2", 1e6),
    ("kN/mm2", 1e9),
    ("kN/mm²", 1e9),
    ("kN/mm^2", 1e9),
    ("MN/m2", 1e6),
    ("MN/m²", 1e6),
    ("MN/m^2", 1e6),
    ("N/m2", 1.0),
    ("N/m²", 1.0),
    ("N/m^2", 1.0),
    ("daN/mm2", 1e7),
    ("daN/mm²", 1e7),
    ("kp/mm2", 9.80665e6),
    ("kp/mm²", 9.80665e6),
    ("psi", 6.894_757_293_168e3),
    ("kpsi", 6.894_757_293_168e6),
    ("ksi", 6.894_757_293_168e6),
    ("kgf/mm2", 9.80665e6),
    ("kgf/mm²", 9.80665e6),
    ("kgf/mm^2", 9.80665e6),
    ("kg/mm2", 9.80665e6),
    ("kg/mm²", 9.80665e6),
    ("kg/mm^2", 9.80665e6),
    // a millipascal is no stress of a metal, so that case tells nothing else
    ("Mpa", 1e6),
    ("MPA", 1e6),
    ("mpa", 1e6),
    ("gpa", 1e9),
    ("Gpa", 1e9),
    ("GPA", 1e9),
];

impl Dimension {
    /// Symbols beside those of a quantity of a scene, and words, with their SI value.
    fn further(self) -> &'static [(&'static str, f64)] {
        match self {
            Dimension::Length => LENGTHS,
            Dimension::Force => FORCES,
            Dimension::Stress => STRESSES,
            Dimension::Ratio => RATIOS,
        }
    }

    fn symbols(self) -> &'static [(&'static str, f64)] {
        match self {
            Dimension::Length => Length::UNITS,
            Dimension::Force => Force::UNITS,
            Dimension::Stress => Stress::UNITS,
            Dimension::Ratio => &[],
        }
    }

    fn words(self) -> &'static [&'static str] {
        match self {
            Dimension::Length => &["m", "meter", "meters", "metre", "metres"],
            Dimension::Force => &["n", "newton", "newtons"],
            Dimension::Stress => &["pa", "pascal", "pascals"],
            Dimension::Ratio => &[],
        }
    }

    /// The SI value of one `unit`: a symbol, or words such as `micro N`, `micro_newton`, `nanometers`.
    pub fn scale(self, unit: &str) -> Option<f64> {
        let unit = unit.trim().trim_matches(['(', ')', '[', ']', '{', '}']).trim().trim_end_matches('.');
        let known = |test: &dyn Fn(&str) -> bool| {
            self.symbols().iter().chain(self.further()).find(|(name, _)| test(name)).map(|(_, scale)| *scale)
        };
        known(&|name| name == unit).or_else(|| self.scale_in_words(&unit.to_lowercase())).or_else(|| {
            known(&|name| self != Dimension::Stress && name.to_lowercase() == unit.to_lowercase())
        })
    }

    fn scale_in_words(self, unit: &str) -> Option<f64> {
        let is_word = |word: &str| self.words().contains(&word);
        if unit.len() > 2 && is_word(unit) {
            return Some(1.0);
        }
        PREFIXES.iter().find_map(|(prefix, scale)| {
            let base = unit.strip_prefix(prefix)?.trim_start_matches([' ', '_', '-']);
            is_word(base).then_some(*scale)
        })
    }

    /// Its usual units, for messages.
    pub fn units(self) -> &'static str {
        match self {
            Dimension::Length => "pm, nm, um, mm, m, in, mil",
            Dimension::Force => "nN, uN, mN, N, kN, gf, kgf, lbf",
            Dimension::Stress => "Pa, kPa, MPa, GPa, N/mm2",
            Dimension::Ratio => "1, %, permille, microstrain",
        }
    }
}
