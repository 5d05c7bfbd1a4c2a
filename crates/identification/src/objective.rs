//! All measurements at once: residuals in standard deviations, by one covariance for each measurement.

use super::experiment::Experiment;
use super::parameters::Unknowns;
use crate::levenberg_marquardt::Residuals;
use nalgebra::{Cholesky, DVector, Dyn};

/// The measurements with their covariances at one point.
pub struct Objective<'a> {
    experiments: &'a [Experiment],
    unknowns: &'a Unknowns,
    factors: Vec<Cholesky<f64, Dyn>>,
}

impl<'a> Objective<'a> {
    /// With the covariances at `point`; `None` where there is no metal.
    pub fn new(
        experiments: &'a [Experiment],
        unknowns: &'a Unknowns,
        point: &[f64],
    ) -> Option<Objective<'a>> {
        let factors = experiments.iter().map(|e| e.covariance(unknowns, point)?.cholesky());
        Some(Objective { experiments, unknowns, factors: factors.collect::<Option<_>>()? })
    }

    /// The residuals at `point`, in standard deviations and independent of each other.
    pub fn residuals(&self, point: &[f64]) -> Option<Vec<f64>> {
        let mut all = Vec::new();
        for (experiment, factor) in self.experiments.iter().zip(&self.factors) {
            let differences = DVector::from_vec(experiment.differences(self.unknowns, point, false)?);
            let whitened = factor.l_dirty().solve_lower_triangular(&differences)?;
            if whitened.iter().any(|x| !x.is_finite()) {
                return None;
            }
            all.extend(whitened.iter());
        }
        Some(all)
    }

    /// The residuals as a function.
    pub fn function(&self) -> impl Fn(&[f64]) -> Option<Vec<f64>> + Sync + '_ {
        |point| self.residuals(point)
    }

    /// The bounds of the coordinates.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.unknowns.parameters.iter().map(|p| p.bounds).collect()
    }
}

/// Rough residuals by the atlas of cones, with a standard deviation of `rough` beside the noise: where to
/// look at all.
pub fn roughly<'a>(experiments: &'a [Experiment], unknowns: &'a Unknowns, rough: f64) -> Box<Residuals<'a>> {
    Box::new(move |point: &[f64]| {
        let mut all = Vec::new();
        for experiment in experiments {
            let sharp = matches!(experiment.geometry, super::response::Geometry::Sharp { .. });
            let differences = experiment.differences(unknowns, point, true)?;
            // the points of a curve say together little more than one
            let many = (differences.len() as f64 / 3.0).max(1.0).sqrt();
            let error =
                (if sharp { 0.03 } else { rough }).hypot(experiment.noise).hypot(experiment.model_error);
            all.extend(differences.iter().map(|d| d / (error * many)));
        }
        all.iter().all(|x| x.is_finite()).then_some(all)
    })
}
