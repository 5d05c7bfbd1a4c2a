//! The door for closures of other crates: a law of one island that a program hands in.

use super::response::Response;
use asperity_material::{refuse_custom, write_custom};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::sync::Arc;

/// The contact law of one island from outside: its response to the island's mean slope tan β.
///
/// Pressures are Pa. The functions are pure: the same argument gives the same bits, whichever thread asks.
/// The load must grow with the slope, so that the plane that carries a load is found.
///
/// ```
/// use asperity_roughness::{IslandClosure, Regime, Response};
///
/// /// Pressure proportional to the slope, the whole island in contact.
/// #[derive(Debug)]
/// struct Proportional {
///     modulus: f64,
/// }
///
/// impl IslandClosure for Proportional {
///     fn name(&self) -> &str {
///         "proportional"
///     }
///     fn source(&self) -> &str {
///         "p = M tan(beta) on the island"
///     }
///     fn parameters(&self) -> Vec<(&str, f64)> {
///         vec![("modulus_Pa", self.modulus)]
///     }
///     fn respond(&self, tan_beta: f64) -> Response {
///         let island_pressure = self.modulus * tan_beta;
///         Response { island_pressure, area_ratio: 1.0, regime: Regime::Elastic, inside: true }
///     }
/// }
///
/// assert_eq!(Proportional { modulus: 2e9 }.elastic_pressure(0.1), 2e8);
/// ```
pub trait IslandClosure: fmt::Debug + Send + Sync {
    /// Name of the closure in results, not one of a built-in closure.
    fn name(&self) -> &str;

    /// Its source, in one line.
    fn source(&self) -> &str;

    /// Its numbers in SI by name, for results. Two closures of one name and the same numbers are taken to be
    /// the same.
    fn parameters(&self) -> Vec<(&str, f64)>;

    /// Mean pressure on the island (Pa), its share in true contact, and regime, at the island's mean gradient
    /// `tan_beta` > 0.
    fn respond(&self, tan_beta: f64) -> Response;

    /// Island pressure over tan β (Pa) and area ratio of a closure that is linear in tan β: its plane is
    /// found in one pass, and unloading returns all work. Unless given: it is not linear.
    fn linear(&self) -> Option<[f64; 2]> {
        None
    }

    /// Elastic pressure on the contact at `tan_beta`, Pa, for the plasticity index. Unless given: that of a
    /// gentle slope, in proportion.
    fn elastic_pressure(&self, tan_beta: f64) -> f64 {
        let gentle = self.respond(GENTLE);
        gentle.island_pressure / gentle.area_ratio / GENTLE * tan_beta
    }
}

/// A slope on which every island is elastic; a power of two, so that a linear law keeps its digits.
const GENTLE: f64 = 1.0 / 1_048_576.0;

/// A closure from outside, shared between the copies of a scene.
#[derive(Clone, Debug)]
pub struct OwnClosure(Arc<dyn IslandClosure>);

impl OwnClosure {
    /// The closure as a value of a scene.
    pub fn new(closure: Arc<dyn IslandClosure>) -> OwnClosure {
        OwnClosure(closure)
    }

    /// The closure as it was handed in.
    pub fn closure(&self) -> &dyn IslandClosure {
        self.0.as_ref()
    }
}

impl PartialEq for OwnClosure {
    fn eq(&self, other: &OwnClosure) -> bool {
        self.0.name() == other.0.name() && self.0.parameters() == other.0.parameters()
    }
}

impl Serialize for OwnClosure {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        write_custom(serializer, self.0.name(), self.0.parameters())
    }
}

impl<'de> Deserialize<'de> for OwnClosure {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<OwnClosure, D::Error> {
        Err(refuse_custom(deserializer, "closure"))
    }
}
