//! A hardening law as the points of a table.

use asperity_material::{Hardening, HardeningCurve, HardeningLaw};

/// Points of a table: CalculiX holds 200 for a material.
pub const POINTS: usize = 200;
/// Plastic strain at which the table ends; codes keep the stress constant beyond.
const LAST_STRAIN: f64 = 10.0;

/// Yield stress over plastic strain, to be interpolated linearly.
#[derive(Clone, Debug, PartialEq)]
pub struct PlasticTable {
    /// Yield stress and accumulated plastic strain.
    pub points: Vec<[f64; 2]>,
    /// Largest relative error of the interpolated stress.
    pub error: f64,
}

/// A hardening curve as a table, stresses in units of `unit` Pa: a table as it is, a power law sampled.
pub fn curve_table(curve: &HardeningCurve, unit: f64) -> PlasticTable {
    match curve {
        HardeningCurve::Power(law) => plastic_table(law, unit),
        HardeningCurve::Table(table) => PlasticTable {
            points: table.points().map(|[strain, stress]| [stress / unit, strain]).collect(),
            error: 0.0,
        },
    }
}

/// Samples `law` from first yield to about [`LAST_STRAIN`]; stresses in units of `unit` Pa.
///
/// The points are geometric in the strain measure e of the law σ = R eⁿ, so that the error in it, n(1-n)/8 (Δ
/// ln e)², is the same between any two.
fn plastic_table(law: &Hardening, unit: f64) -> PlasticTable {
    if law.exponent == 0.0 {
        return PlasticTable { points: vec![[law.yield_stress / unit, 0.0]], error: 0.0 };
    }
    let first = law.yield_strain();
    let growth = (LAST_STRAIN / first).ln() / (POINTS - 1) as f64;
    let point = |i: usize| {
        let beyond = first * (growth * i as f64).exp_m1();
        let stress = law.representative_stress(beyond);
        let strain = match law.law {
            HardeningLaw::Hollomon => beyond - (stress - law.yield_stress) / law.youngs_modulus,
            HardeningLaw::Swift => beyond,
        };
        [stress / unit, strain]
    };
    let points: Vec<[f64; 2]> = (0..POINTS).map(point).collect();
    let stress = |strain: f64| law.flow(strain).yield_stress / unit;
    let error = points.windows(2).map(|pair| interpolation_error(&stress, pair)).fold(0.0, f64::max);
    PlasticTable { points, error }
}

/// Largest relative error between two points, by sampling.
fn interpolation_error(stress: &impl Fn(f64) -> f64, pair: &[[f64; 2]]) -> f64 {
    let [a, b] = [pair[0], pair[1]];
    (1..8)
        .map(|i| {
            let share = f64::from(i) / 8.0;
            let exact = stress(a[1] + share * (b[1] - a[1]));
            ((a[0] + share * (b[0] - a[0])) / exact - 1.0).abs()
        })
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_follows_every_law_within_its_error() {
        for law in [HardeningLaw::Hollomon, HardeningLaw::Swift] {
            for exponent in [0.0, 0.1, 0.3, 0.6] {
                let metal = Hardening { law, yield_stress: 300e6, exponent, youngs_modulus: 210e9 };
                let table = plastic_table(&metal, 1e6);
                assert!(table.error < 2e-4, "{law:?} {exponent} {}", table.error);
                assert_eq!(table.points[0], [300.0, 0.0]);
                for i in 1..500 {
                    let strain = 9.5 * (f64::from(i) / 500.0).powi(4);
                    let exact = metal.flow(strain).yield_stress / 1e6;
                    let off = (interpolated(&table.points, strain) / exact - 1.0).abs();
                    assert!(off <= 1.05 * table.error + 1e-12, "{law:?} {exponent} {strain} {off}");
                }
            }
        }
    }

    #[test]
    fn a_table_stays_as_it_is() {
        let table = asperity_material::HardeningTable::new(&[[0.0, 300e6], [0.1, 450e6]]).unwrap();
        let written = curve_table(&table.into(), 1e6);
        assert_eq!(written, PlasticTable { points: vec![[300.0, 0.0], [450.0, 0.1]], error: 0.0 });
    }

    fn interpolated(points: &[[f64; 2]], strain: f64) -> f64 {
        match points.windows(2).find(|w| w[1][1] >= strain) {
            Some(w) => w[0][0] + (w[1][0] - w[0][0]) * (strain - w[0][1]) / (w[1][1] - w[0][1]),
            None => points[points.len() - 1][0],
        }
    }
}
