//! Numbers as texts have them.

use asperity_material::units::rounded;

/// Seven digits: more than any instrument has, and none of rounding.
pub(crate) fn digits(value: f64) -> String {
    rounded(value, 7).to_string()
}
