//! Sensitivity of c: one grid for both laws and both tools, fitted whole and in parts.

use asperity::calibration::case::Tool;
use asperity::calibration::fit::{
    DEVELOPED_PLASTICITY, Data, StrainCoefficient, angles, developed, strain_coefficient,
};
use asperity::calibration::row::Row;
use asperity::calibration::sweep::Sweep;
use asperity::material::HardeningLaw;
use asperity::material::units::Stress;
use asperity::simulation::scene::Accuracy;
use rayon::prelude::*;

/// E/σ_y of the grid: the range of the default sweep, its two halves, and stiffer materials beyond it.
const RATIOS: [f64; 9] = [100.0, 150.0, 225.0, 350.0, 500.0, 700.0, 1050.0, 2000.0, 4000.0];

/// Ranges of E/σ_y that are fitted.
const RANGES: [[f64; 2]; 4] = [[100.0, 350.0], [350.0, 1050.0], [100.0, 1050.0], [100.0, 4000.0]];

/// Hardening exponents of the grid, and the largest of those that are fitted.
const EXPONENTS: [f64; 5] = [0.0, 0.1, 0.2, 0.3, 0.5];
const LARGEST_EXPONENTS: [f64; 2] = [0.3, 0.5];

/// The four sweeps of the grid: crush and indentation, each with both laws.
pub fn sweeps(accuracy: Accuracy) -> Vec<Sweep> {
    let mut sweeps = Vec::new();
    for tool in [Tool::Plane, Tool::Cone] {
        for law in [HardeningLaw::Hollomon, HardeningLaw::Swift] {
            sweeps.push(Sweep {
                youngs_modulus: RATIOS.map(|r| Stress(1e9 * r)).to_vec(),
                yield_stress: vec![Stress(1e9)],
                hardening_exponent: EXPONENTS.to_vec(),
                hardening_law: law,
                tool,
                accuracy,
                ..Sweep::default()
            });
        }
    }
    sweeps
}

/// c of a part of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Smallest and largest n.
    pub exponents: [f64; 2],
    /// Smallest and largest E/σ_y.
    pub ratios: [f64; 2],
    /// c of all cases; `None`: not determined.
    pub all: Option<StrainCoefficient>,
    /// c where E* tan β/σ_r is at least [`DEVELOPED_PLASTICITY`].
    pub developed: Option<StrainCoefficient>,
}

/// c of every part of the rows of one sweep.
pub fn lines(rows: &[Row]) -> Vec<Line> {
    let data = Data::new(rows);
    let mut parts = Vec::new();
    for largest in LARGEST_EXPONENTS {
        for least in [0.1, 0.0] {
            parts.extend(RANGES.map(|ratios| ([least, largest], ratios)));
        }
    }
    let fitted = |&(exponents, ratios): &([f64; 2], [f64; 2])| {
        let within = |[low, high]: [f64; 2], v: f64| v >= low * (1.0 - 1e-9) && v <= high * (1.0 + 1e-9);
        let part = data.filtered(|_, s| {
            within(exponents, s.hardening.exponent) && within(ratios, 1.0 / s.hardening.yield_stress)
        });
        let all = strain_coefficient(&angles(&part));
        let developed =
            all.and_then(|s| strain_coefficient(&angles(&developed(&part, s.c, DEVELOPED_PLASTICITY))));
        Line { exponents, ratios, all, developed }
    };
    parts.par_iter().map(fitted).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sweep_of_the_grid_is_valid_and_holds_every_part() {
        for sweep in sweeps(Accuracy::Draft) {
            sweep.validate().unwrap();
            assert_eq!(sweep.cases().len(), 450);
        }
        for [low, high] in RANGES {
            assert!(RATIOS.contains(&low) && RATIOS.contains(&high));
        }
        assert_eq!(lines(&[]).len(), 16);
    }
}
