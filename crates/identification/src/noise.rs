//! The noise of curves that state none.

use crate::experiment::{Data, Experiment};
use crate::parameters::Unknowns;

/// Factors by which the noise of a curve that states none may change from one round to the next without
/// another round.
const SETTLED_NOISE_FACTOR: f64 = 1.15;
/// Least and largest standard deviation of a force that is taken from the scatter: an instrument is hardly
/// better, a curve that scatters more is none.
const NOISE_RANGE: [f64; 2] = [1e-3, 0.2];
/// Largest correlation of neighbouring points: above it a curve would say nothing.
const LARGEST_CORRELATION: f64 = 0.9;

/// Takes the noise of curves that state none, and its correlation from point to point, from the scatter of
/// their loading about the fit; true where one changed.
pub fn noise_from_scatter(experiments: &mut [Experiment], unknowns: &Unknowns, point: &[f64]) -> bool {
    let mut changed = false;
    for experiment in experiments.iter_mut().filter(|e| !e.noise_given) {
        let Data::Curve(measured) = &experiment.data else { continue };
        let Some(differences) = experiment.differences(unknowns, point, false) else { continue };
        let loading = &differences[..measured.loading.len()];
        let freedom = (loading.len() as f64 - unknowns.parameters.len() as f64).max(1.0);
        let [least, largest] = NOISE_RANGE;
        let scatter = (loading.iter().map(|d| d * d).sum::<f64>() / freedom).sqrt().clamp(least, largest);
        let ratio = (scatter / experiment.noise).max(experiment.noise / scatter);
        (experiment.noise, experiment.noise_correlation) = (scatter, neighbours_correlation(loading));
        changed |= ratio > SETTLED_NOISE_FACTOR;
    }
    changed
}

/// Correlation of neighbouring `differences`, 0 where chance alone explains it (95 %).
fn neighbours_correlation(differences: &[f64]) -> f64 {
    let square: f64 = differences.iter().map(|d| d * d).sum();
    let products: f64 = differences.windows(2).map(|pair| pair[0] * pair[1]).sum();
    let correlation = if square > 0.0 { products / square } else { 0.0 };
    let chance = 2.0 / (differences.len().max(1) as f64).sqrt();
    if correlation > chance { correlation.min(LARGEST_CORRELATION) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slow wave has neighbours that are alike, signs that alternate have none.
    #[test]
    fn readings_that_drift_together_are_told_from_readings_that_scatter() {
        let wave: Vec<f64> = (0..30).map(|i| (0.3 * f64::from(i)).sin()).collect();
        assert!(neighbours_correlation(&wave) > 0.8, "{}", neighbours_correlation(&wave));
        let scatter: Vec<f64> = (0..30).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        assert_eq!(neighbours_correlation(&scatter), 0.0);
    }
}
