//! Common parts of scenes drawn at random: their text with the end it deserves, and their metals.

use proptest::prelude::*;
use std::fmt::Write;

/// The end that a scene deserves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Every value is in its range.
    Sound,
    /// One value or key is wrong.
    Unsound,
    /// The text is cut off somewhere.
    CutOff,
}

/// A scene as text.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// TOML.
    pub text: String,
    /// The end to be expected of it.
    pub kind: Kind,
}

impl Drawn {
    /// True where its asperity or tool is a measured outline.
    pub fn is_measured(&self) -> bool {
        self.text.contains("\npoints = ")
    }

    /// True where the scene gives steps, elements or the penetration itself: what it promises then is not
    /// the program's to keep.
    pub fn gives_numbers(&self) -> bool {
        ["steps", "elements_in_contact", "penetration"]
            .iter()
            .any(|key| self.text.contains(&format!("\n{key} = ")))
    }
}

pub(crate) fn log_between(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Metals: all of the range of a law that another scene of the literature would use, and the ends of what is
/// allowed.
pub(crate) fn material() -> impl Strategy<Value = String> {
    let poissons_ratio = prop_oneof![8 => 0.0..0.49, 1 => Just(0.4999), 1 => -0.9..0.0];
    let exponent = prop_oneof![1 => Just(0.0), 4 => 0.0..0.6];
    (log_between(1.0, 1000.0), poissons_ratio, log_between(10.0, 5000.0), exponent, any::<bool>(), 0..8)
        .prop_map(|(modulus, poissons_ratio, ratio, exponent, swift, elastic)| {
            let mut text = format!(
                "[material]\nyoungs_modulus = \"{modulus} GPa\"\npoissons_ratio = {poissons_ratio}\n"
            );
            if elastic > 0 {
                let law = if swift { "swift" } else { "hollomon" };
                let _ = writeln!(text, "yield_stress = \"{} MPa\"", 1e3 * modulus / ratio);
                let _ = writeln!(text, "hardening_exponent = {exponent}\nhardening_law = \"{law}\"");
            }
            text
        })
}
