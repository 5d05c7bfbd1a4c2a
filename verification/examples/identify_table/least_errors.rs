//! The least errors that the noise of a curve and its imprint allow: the bound of Cramér and Rao at the true
//! metal, by slopes of finite elements.

use crate::book::{Book, Solved};
use crate::imprints::{LENGTHS, Left, NOISE, POINTS, SLOPE_DEG, place};
use asperity::tables::Accuracy;
use asperity_calibration::indentation::{FORCES, residual_surface, solve};
use asperity_identification::interpolation::linear_between;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::report::Report;
use asperity_verification::twins::{indenter, recovery_between};
use nalgebra::{DMatrix, Matrix3};
use rayon::prelude::*;
use serde_json::json;

/// Factor of E/σ_y and change of n between which slopes are taken: so far apart that the scatter of finite
/// elements from metal to metal, 0.2 % of the depth in a height, is small beside the change.
const FACTOR: f64 = 1.1;
const CHANGE: f64 = 0.06;
/// Metals for which slopes are taken: the first of a sequence that covers all evenly.
const METALS: usize = 8;

/// Measurements of a metal of E 1: logarithms of the forces of loading and unloading at known depths, and
/// heights over the depth at known places.
struct Measured {
    loading: f64,
    recovery: [f64; FORCES.len()],
    left: Left,
}

fn measured(e_over_sy: f64, exponent: f64) -> Option<Measured> {
    let (cone, analyses) = (indenter(SLOPE_DEG, e_over_sy, exponent), Analyses::default());
    let (found, _) = solve(&cone, Accuracy::Standard, &analyses).ok()?;
    let left = residual_surface(&cone, Accuracy::Standard, &analyses).ok()?;
    let left = Left::new(left.points, left.contact_radius)?;
    Some(Measured { loading: found.k_over_e.ln(), recovery: found.recovery, left })
}

/// Slopes of all that is measured, forces first, by two metals that differ by `change`; `middle` tells the
/// unloading between them, and places are shares of the contact radius `radius`.
fn slopes([low, high]: [&Measured; 2], middle: &[f64; FORCES.len()], radius: f64, change: f64) -> Vec<f64> {
    let [loaded, unloaded, heights] = POINTS;
    let loading = (high.loading - low.loading) / change;
    let unloading = (1..unloaded).map(|k| {
        let share = 1.0 - k as f64 / unloaded as f64;
        let falls = (recovery_between(middle, share * 1.01) - recovery_between(middle, share * 0.99)) / 0.02;
        // at a depth that stays, more recovery is less force
        loading
            - (recovery_between(&high.recovery, share) - recovery_between(&low.recovery, share))
                / change
                / falls
    });
    let at = |of: &Measured, r: f64| linear_between(&of.left.surface, r);
    let imprint = (0..heights).map(|k| (at(high, radius * place(k)) - at(low, radius * place(k))) / change);
    std::iter::repeat_n(loading, loaded).chain(unloading).chain(imprint).collect()
}

/// Least standard deviation of ln σ_y, for heights alike over each of [`LENGTHS`], E and n sought as well.
fn least_deviations(e_over_sy: f64, exponent: f64) -> Option<Vec<f64>> {
    let low = (exponent - 0.5 * CHANGE).max(0.0);
    let metals = [
        [e_over_sy / FACTOR, exponent],
        [e_over_sy * FACTOR, exponent],
        [e_over_sy, low],
        [e_over_sy, low + CHANGE],
    ];
    let found: Option<Vec<Measured>> = metals.into_iter().map(|[ratio, n]| measured(ratio, n)).collect();
    let found = found?;
    let middle = std::array::from_fn(|k| 0.5 * (found[0].recovery[k] + found[1].recovery[k]));
    let radius = 0.5 * (found[0].left.contact_radius + found[1].left.contact_radius);
    let of_the_ratio = slopes([&found[0], &found[1]], &middle, radius, 2.0 * FACTOR.ln());
    let of_n = slopes([&found[2], &found[3]], &middle, radius, CHANGE);
    let forces = POINTS[0] + POINTS[1] - 1;
    // the ratio falls as σ_y grows; forces grow with E besides
    let rows = (0..of_n.len()).flat_map(|k| {
        let alone = if k < forces { 1.0 } else { 0.0 };
        [alone + of_the_ratio[k], -of_the_ratio[k], of_n[k]]
    });
    let slopes = DMatrix::from_row_iterator(of_n.len(), 3, rows);
    let [of_forces, of_heights] = [slopes.rows(0, forces), slopes.rows(forces, POINTS[2])];
    let told_by_forces = of_forces.tr_mul(&of_forces) / NOISE[0].powi(2);
    let deviation = |length: &f64| {
        let covariance = DMatrix::from_fn(POINTS[2], POINTS[2], |i, j| {
            let alike = (-(place(i) - place(j)).abs() / length).exp();
            NOISE[1].powi(2) * alike + NOISE[2].powi(2) * (1.0 + place(i) * place(j))
        });
        let weighed = covariance.cholesky()?.solve(&of_heights.into_owned());
        let told = &told_by_forces + of_heights.tr_mul(&weighed);
        let told = Matrix3::from_iterator(told.iter().copied());
        Some(told.try_inverse()?[(1, 1)].sqrt())
    };
    LENGTHS.iter().map(deviation).collect()
}

/// Writes the least errors of σ_y for the first [`METALS`] of each list of fits in `found`, of which there is
/// one for each of [`LENGTHS`], beside the errors of those fits.
pub fn section(report: &mut Report, book: &Book, found: &[Vec<Solved>]) {
    report.section("Errors of σ_y that the noise of a curve and its imprint allows at least");
    report.table("| roughness alike over | metals | least mean absolute error, % | found, % |");
    for (k, (length, solved)) in LENGTHS.iter().zip(found).enumerate() {
        let of = |s: &Solved| {
            let ratio = 1e3 * s.case.youngs_modulus / s.case.yield_stress;
            let least = book.recall(&format!("least errors of {ratio} {}", s.case.exponent), || {
                Some(json!(least_deviations(ratio, s.case.exponent)?))
            })?;
            Some([least[k].as_f64()?, (s.parameter("yield_stress")[0] / s.case.yield_stress - 1.0).abs()])
        };
        let first = &solved[..solved.len().min(METALS)];
        let rows: Vec<[f64; 2]> = first.par_iter().with_max_len(1).filter_map(of).collect();
        let mean = |i: usize| 100.0 * rows.iter().map(|row| row[i]).sum::<f64>() / rows.len() as f64;
        // the mean of a normal number without its sign
        let least = (2.0 / std::f64::consts::PI).sqrt() * mean(0);
        report.line(&format!(
            "| {length} contact radii | {} of {} | {least:.2} | {:.1} |",
            rows.len(),
            solved.len(),
            mean(1)
        ));
    }
}
