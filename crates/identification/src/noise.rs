//! The noise of curves that state none.

use crate::experiment::{Data, Experiment};
use crate::parameters::Unknowns;

/// Factors by which the noise of a curve that states none may change from one round to the next without
/// another round.
const SETTLED_NOISE_FACTOR: f64 = 1.15;

/// Takes the noise of curves that state none from the scatter of their loading about the fit; true where
/// one changed.
pub fn noise_from_scatter(experiments: &mut [Experiment], unknowns: &Unknowns, point: &[f64]) -> bool {
    let mut changed = false;
    for experiment in experiments.iter_mut().filter(|e| !e.noise_given) {
        let Data::Curve(measured) = &experiment.data else { continue };
        let Some(differences) = experiment.differences(unknowns, point, false) else { continue };
        let loading = &differences[..measured.loading.len()];
        let freedom = (loading.len() as f64 - unknowns.parameters.len() as f64).max(1.0);
        let scatter = (loading.iter().map(|d| d * d).sum::<f64>() / freedom).sqrt().clamp(1e-3, 0.2);
        let ratio = (scatter / experiment.noise).max(experiment.noise / scatter);
        experiment.noise = scatter;
        changed |= ratio > SETTLED_NOISE_FACTOR;
    }
    changed
}
