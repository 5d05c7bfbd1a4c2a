//! The answer of a closure to one island.

/// State of an island, in the order of shares and of numbers in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// Returns when unloaded.
    Elastic,
    /// Between first yield and full plasticity.
    Elastoplastic,
    /// Fully plastic.
    Plastic,
}

/// Pressure, area and regime of an island.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Mean pressure over the island, in Pa.
    pub island_pressure: f64,
    /// True contact area over the island's area.
    pub area_ratio: f64,
    /// Regime.
    pub regime: Regime,
    /// True where slope and stiffness lie inside the range of the law.
    pub inside: bool,
}
