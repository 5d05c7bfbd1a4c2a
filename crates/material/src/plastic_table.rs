//! A hardening law as the points of a table, for programs that take no law.

use crate::hardening::{Hardening, HardeningLaw};
use crate::hardening_curve::HardeningCurve;

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

/// A hardening curve as a table, stresses in units of `unit`: a table as it is, a law sampled at `most`
/// points or fewer, but two at least, up to a plastic strain of 10.
pub fn curve_table(curve: &HardeningCurve, unit: f64, most: usize) -> PlasticTable {
    match curve {
        HardeningCurve::Power(law) => power_table(law, unit, most),
        HardeningCurve::Table(table) => PlasticTable {
            points: table.points().map(|[strain, stress]| [stress / unit, strain]).collect(),
            error: 0.0,
        },
        curve => sampled(curve, unit, most),
    }
}

/// Error between two points below which they are not parted: what the digits of a deck leave.
const LEAST_ERROR: f64 = 1e-12;

/// Distance of two strains that are not parted further: a number of a deck keeps an exponent of two digits.
const CLOSEST: f64 = 1e-30;

/// Samples `curve` from first yield to [`LAST_STRAIN`]; stresses in units of `unit`.
///
/// The chord that misses the law by most is parted where it does so, until there are `most` points. The slope
/// of the law is not asked: it may be unbounded at first yield.
fn sampled(curve: &HardeningCurve, unit: f64, most: usize) -> PlasticTable {
    let stress = |strain: f64| curve.flow(strain).yield_stress / unit;
    let point = |strain: f64| [stress(strain), strain];
    let mut points = vec![point(0.0), point(LAST_STRAIN)];
    let mut misses = vec![largest_miss(&stress, &points)];
    while points.len() < most {
        let parted = |i: &usize| misses[*i].error > LEAST_ERROR && points[i + 1][1] - points[*i][1] > CLOSEST;
        let candidates = (0..misses.len()).filter(parted);
        let Some(worst) = candidates.max_by(|i, j| misses[*i].error.total_cmp(&misses[*j].error)) else {
            break;
        };
        points.insert(worst + 1, point(misses[worst].strain));
        let parts = [worst, worst + 1].map(|i| largest_miss(&stress, &points[i..i + 2]));
        misses.splice(worst..=worst, parts);
    }
    PlasticTable { error: misses.iter().map(|miss| miss.error).fold(0.0, f64::max), points }
}

/// Samples `law` from first yield to about [`LAST_STRAIN`]; stresses in units of `unit`.
///
/// The points are geometric in the strain measure e of the law σ = R eⁿ, so that the error in it, n(1-n)/8 (Δ
/// ln e)², is the same between any two.
fn power_table(law: &Hardening, unit: f64, most: usize) -> PlasticTable {
    if law.exponent == 0.0 {
        return PlasticTable { points: vec![[law.yield_stress / unit, 0.0]], error: 0.0 };
    }
    let first = law.yield_strain();
    let growth = (LAST_STRAIN / first).ln() / (most.max(2) - 1) as f64;
    let point = |i: usize| {
        let beyond = first * (growth * i as f64).exp_m1();
        let stress = law.representative_stress(beyond);
        let strain = match law.law {
            HardeningLaw::Hollomon => beyond - (stress - law.yield_stress) / law.youngs_modulus,
            HardeningLaw::Swift => beyond,
        };
        [stress / unit, strain]
    };
    let points: Vec<[f64; 2]> = (0..most.max(2)).map(point).collect();
    let stress = |strain: f64| law.flow(strain).yield_stress / unit;
    let error = points.windows(2).map(|pair| largest_miss(&stress, pair).error).fold(0.0, f64::max);
    PlasticTable { points, error }
}

/// Error of a chord against the law.
struct Miss {
    /// Relative error of the stress.
    error: f64,
    /// The strain where it is.
    strain: f64,
}

/// Shares of a chord where it is compared with its law: close at its beginning, where laws bend.
const SHARES: [f64; 10] = [0.015_625, 0.031_25, 0.062_5, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875];

/// The largest relative error of the chord through the two points of `pair`.
fn largest_miss(stress: &impl Fn(f64) -> f64, pair: &[[f64; 2]]) -> Miss {
    let [a, b] = [pair[0], pair[1]];
    let misses = SHARES.map(|share| {
        let strain = a[1] + share * (b[1] - a[1]);
        Miss { error: ((a[0] + share * (b[0] - a[0])) / stress(strain) - 1.0).abs(), strain }
    });
    let none = Miss { error: 0.0, strain: 0.5 * (a[1] + b[1]) };
    misses.into_iter().fold(none, |most, miss| if miss.error > most.error { miss } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow_curve::{FlowCurve, OwnLaw};
    use crate::hardening_table::HardeningTable;
    use crate::voce::Voce;
    use std::sync::Arc;

    const POINTS: usize = 200;

    #[test]
    fn a_table_follows_every_law_within_its_error() {
        for law in [HardeningLaw::Hollomon, HardeningLaw::Swift] {
            for exponent in [0.0, 0.1, 0.3, 0.6] {
                let metal = Hardening { law, yield_stress: 300e6, exponent, youngs_modulus: 210e9 };
                let table = power_table(&metal, 1e6, POINTS);
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
    fn a_table_follows_a_law_that_saturates() {
        for saturation_strain in [1e-3, 0.1, 2.0] {
            let law = Voce { yield_stress: 300e6, saturation_stress: 900e6, saturation_strain };
            let table = curve_table(&law.into(), 1e6, POINTS);
            assert!(table.points.len() <= POINTS && table.error < 2e-4, "{}", table.error);
            assert_eq!(table.points[0], [300.0, 0.0]);
            for i in 1..500 {
                let strain = 9.5 * (f64::from(i) / 500.0).powi(4);
                let exact = law.flow(strain).yield_stress / 1e6;
                let off = (interpolated(&table.points, strain) / exact - 1.0).abs();
                assert!(off <= 1.05 * table.error + 1e-12, "{saturation_strain} {strain} {off}");
            }
        }
    }

    /// σ = 300 MPa + K ε_pᵐ, whose slope has no bound at first yield.
    #[derive(Debug)]
    struct Root {
        strength: f64,
        power: f64,
    }

    impl FlowCurve for Root {
        fn name(&self) -> &str {
            "root"
        }
        fn parameters(&self) -> Vec<(&str, f64)> {
            vec![("strength_Pa", self.strength), ("power", self.power)]
        }
        fn flow(&self, plastic_strain: f64) -> [f64; 2] {
            let slope = self.power * self.strength * plastic_strain.powf(self.power - 1.0);
            [300e6 + self.strength * plastic_strain.powf(self.power), slope]
        }
    }

    /// The bounds are what parting reaches, rounded up: 6e-5, 1.2e-4, 2.4e-5. A straight law needs its ends
    /// alone.
    #[test]
    fn a_table_follows_a_law_without_a_bound_of_its_slope() {
        for (power, most) in [(0.5, 1e-4), (0.3, 2e-4), (0.8, 1e-4), (1.0, 1e-12)] {
            let law = OwnLaw::new(Arc::new(Root { strength: 500e6, power }));
            let table = curve_table(&law.clone().into(), 1e6, POINTS);
            assert!(table.points.len() <= POINTS && table.error <= most, "{power} {}", table.error);
            assert!(table.points.windows(2).all(|w| w[0][1] < w[1][1]), "{power}");
            assert_eq!(
                (table.points[0], table.points[table.points.len() - 1][1]),
                ([300.0, 0.0], LAST_STRAIN)
            );
            for i in 1..500 {
                let strain = 9.5 * (f64::from(i) / 500.0).powi(8);
                let exact = law.flow(strain).yield_stress / 1e6;
                let off = (interpolated(&table.points, strain) / exact - 1.0).abs();
                assert!(off <= 1.05 * table.error + 1e-12, "{power} {strain} {off}");
            }
        }
    }

    /// All but a jump at first yield: no table follows it, and the table says so.
    #[test]
    fn a_table_that_misses_its_law_says_by_how_much() {
        let law = OwnLaw::new(Arc::new(Root { strength: 500e6, power: 0.02 }));
        let table = curve_table(&law.into(), 1e6, POINTS);
        assert!(table.points.len() <= POINTS && table.error > 0.01, "{}", table.error);
    }

    #[test]
    fn a_table_stays_as_it_is() {
        let table = HardeningTable::new(&[[0.0, 300e6], [0.1, 450e6]]).unwrap();
        let written = curve_table(&table.into(), 1e6, POINTS);
        assert_eq!(written, PlasticTable { points: vec![[300.0, 0.0], [450.0, 0.1]], error: 0.0 });
    }

    fn interpolated(points: &[[f64; 2]], strain: f64) -> f64 {
        match points.windows(2).find(|w| w[1][1] >= strain) {
            Some(w) => w[0][0] + (w[1][0] - w[0][0]) * (strain - w[0][1]) / (w[1][1] - w[0][1]),
            None => points[points.len() - 1][0],
        }
    }
}
