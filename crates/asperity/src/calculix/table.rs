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

/// A hardening curve as a table, stresses in units of `unit` Pa: a table as it is, a law sampled.
pub fn curve_table(curve: &HardeningCurve, unit: f64) -> PlasticTable {
    match curve {
        HardeningCurve::Power(law) => plastic_table(law, unit),
        HardeningCurve::Table(table) => PlasticTable {
            points: table.points().map(|[strain, stress]| [stress / unit, strain]).collect(),
            error: 0.0,
        },
        curve => sampled(curve, unit),
    }
}

/// First strain beyond 0 of a sampled curve over its last.
const FIRST_SHARE: f64 = 1e-6;

/// Samples `curve` from first yield to [`LAST_STRAIN`]; stresses in units of `unit` Pa.
///
/// Of candidates in equal ratios, points stand where the running integral of √|dslope/dε_p| reaches equal
/// parts: the error of a chord, step²/8 |σ''|, is then about the same everywhere.
fn sampled(curve: &HardeningCurve, unit: f64) -> PlasticTable {
    let candidates = 40 * POINTS;
    let ratio = FIRST_SHARE.recip().powf(1.0 / (candidates - 1) as f64);
    let beyond = (0..candidates).map(|i| FIRST_SHARE * LAST_STRAIN * ratio.powi(i as i32));
    let strains: Vec<f64> = std::iter::once(0.0).chain(beyond).collect();
    let slopes: Vec<f64> = strains.iter().map(|p| curve.flow(*p).slope).collect();
    let mut bends = vec![0.0];
    for (step, slope) in strains.windows(2).zip(slopes.windows(2)) {
        let bend = ((slope[1] - slope[0]).abs() * (step[1] - step[0])).sqrt();
        bends.push(bends[bends.len() - 1] + bend);
    }
    let all = bends[bends.len() - 1];
    let mut chosen: Vec<usize> = (0..POINTS - 1)
        .map(|i| bends.partition_point(|bend| *bend < all * i as f64 / (POINTS - 2) as f64))
        .chain([candidates])
        .collect();
    chosen.dedup();
    let stress = |strain: f64| curve.flow(strain).yield_stress / unit;
    let points: Vec<[f64; 2]> =
        chosen.into_iter().filter_map(|i| strains.get(i)).map(|p| [stress(*p), *p]).collect();
    let error = points.windows(2).map(|pair| interpolation_error(&stress, pair)).fold(0.0, f64::max);
    PlasticTable { points, error }
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
    use asperity_material::Voce;

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
    fn a_table_follows_a_law_that_saturates() {
        for saturation_strain in [1e-3, 0.1, 2.0] {
            let law = Voce { yield_stress: 300e6, saturation_stress: 900e6, saturation_strain };
            let table = curve_table(&law.into(), 1e6);
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
