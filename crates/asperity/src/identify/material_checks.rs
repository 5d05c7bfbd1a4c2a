//! Checks of the metal of a fit.

use asperity_identification::fit_file::{FitLaw, FitMaterial};
use asperity_identification::known_or_unknown::KnownOrUnknown;
use asperity_material::range;
use asperity_material::units::Stress;

/// A key of a table and the sentence that refuses its value.
pub(super) type KeyError = (String, String);

pub(super) fn key_error(key: &str, message: impl Into<String>) -> KeyError {
    (key.into(), message.into())
}

/// A range or a number within what is allowed.
fn check_number(
    key: &str,
    sought: KnownOrUnknown<f64>,
    [low, high]: [f64; 2],
    unit: &str,
) -> Result<(), KeyError> {
    let inside = |v: f64| v >= low && v <= high;
    match sought {
        KnownOrUnknown::Known(value) if !inside(value) => {
            Err(key_error(key, format!("must be from {low} to {high}{unit}, not {value}")))
        }
        KnownOrUnknown::Range([a, b]) if !(inside(a) && inside(b) && a < b) => Err(key_error(
            key,
            format!(
                "a range must rise and lie from {low} to {high}{unit}, not [{a}, {b}]: give [lowest, highest]"
            ),
        )),
        _ => Ok(()),
    }
}

/// Refuses a metal that no fit can have.
pub(super) fn check_material(material: &FitMaterial) -> Result<(), KeyError> {
    let modulus = material.youngs_modulus.map(|e| e.in_unit("GPa"));
    check_number("youngs_modulus", modulus, range::FITTED_MODULI_GPA, " GPa")?;
    check_number("poissons_ratio", material.poissons_ratio, range::FITTED_POISSONS_RATIOS, "")?;
    if material.hardening_law == FitLaw::Table {
        return check_table(material);
    }
    if material.hardening_table.is_some() {
        return Err(key_error(
            "hardening_table",
            "needs hardening_law = \"table\" beside it: add that, or remove it",
        ));
    }
    let missing =
        |key: &str| key_error("", format!("`{key}` is missing: give a number, or a range [lowest, highest]"));
    let stress = material.yield_stress.ok_or_else(|| missing("yield_stress"))?;
    check_stress("yield_stress", stress)?;
    let exponent = material.hardening_exponent.ok_or_else(|| missing("hardening_exponent"))?;
    check_number("hardening_exponent", exponent, range::VARIED_EXPONENTS, "")
}

fn check_stress(key: &str, sought: KnownOrUnknown<Stress>) -> Result<(), KeyError> {
    check_number(key, sought.map(|s| s.in_unit("MPa")), range::FITTED_YIELD_STRESSES_MPA, " MPa")
}

fn check_table(material: &FitMaterial) -> Result<(), KeyError> {
    for (key, given) in [
        ("yield_stress", material.yield_stress.is_some()),
        ("hardening_exponent", material.hardening_exponent.is_some()),
    ] {
        if given {
            return Err(key_error(key, "does not go with hardening_law = \"table\": remove it"));
        }
    }
    let table = material.hardening_table.as_deref().unwrap_or_default();
    if !(1..=8).contains(&table.len()) || table[0].0 != 0.0 {
        return Err(key_error(
            "hardening_law",
            "\"table\" needs hardening_table with 1 to 8 points from plastic strain 0 on, like [[0, [\"50 MPa\", \"1 GPa\"]], [0.1, [\"50 MPa\", \"2 GPa\"]]]",
        ));
    }
    if table.windows(2).any(|w| w[0].0.is_nan() || w[1].0.is_nan() || w[0].0 >= w[1].0) {
        return Err(key_error("hardening_table", "plastic strains must rise from point to point"));
    }
    for (i, (_, sought)) in table.iter().enumerate() {
        check_stress(&format!("hardening_table[{i}]"), *sought)?;
    }
    Ok(())
}
