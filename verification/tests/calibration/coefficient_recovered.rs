//! Claim: the collapse finds the ε_r = c tan β that data were made with, through 1 % of noise, and says "not
//! determined" where the data are elastic and hold none.
//!
//! Source: the data are made so; their curve is that of published cone indentation (ln Y a quartic in
//! ln X); any smooth one would do.
//! Tolerance of c 5 %: the half width of its own 95 % interval.

use asperity_calibration::case::Case;
use asperity_calibration::fit::{Data, SplitMix, angles, strain_coefficient};
use asperity_calibration::loading_curvature::LoadingCurvature;
use asperity_calibration::row::Row;
use asperity_calibration::sweep::Sweep;

fn rows(k_over_e: impl Fn(&Case) -> f64) -> Vec<Row> {
    let mut random = SplitMix(7);
    let mut row = |case: Case| {
        let k_over_e = k_over_e(&case) * (1.0 + 0.01 * random.normal());
        let kick =
            LoadingCurvature { k_over_e, error: 0.01, contact_ratio: 0.9, increments: 1, iterations: 1 };
        Row { case, outcome: Ok(kick), wall_s: 0.0 }
    };
    Sweep::default().cases().into_iter().map(&mut row).collect()
}

#[test]
fn known_coefficient_is_found_and_elastic_data_give_none() {
    let c = 0.1;
    let made = rows(|case| {
        let stress = case.hardening().unwrap().representative_stress(c * case.tan_beta());
        let l = (case.elastic().reduced_modulus() * case.tan_beta() / stress).ln();
        let ln_y = -1.147_675e-4 * l.powi(4) + 1.171_629e-2 * l.powi(3) - 0.212_961 * l * l + 1.409_473 * l
            - 0.701_906;
        ln_y.exp() * stress / case.tan_beta().powi(2)
    });
    let found = strain_coefficient(&angles(&Data::new(&made))).unwrap();
    assert!((found.c / c - 1.0).abs() < 0.05, "{found:?}");
    assert!(found.ci95[0] < c && c < found.ci95[1], "{found:?}");
    let elastic = angles(&Data::new(&rows(|case| 0.7 / case.tan_beta())));
    assert!(elastic.iter().all(|a| a.strain.is_none()));
    assert_eq!(strain_coefficient(&elastic), None);
}
