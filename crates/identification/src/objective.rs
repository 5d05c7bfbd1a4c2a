//! All measurements at once: residuals in standard deviations, by one covariance for each measurement.

use super::experiment::{Covariance, Experiment};
use super::parameters::Unknowns;
use crate::levenberg_marquardt::{Function, ResidualFunction, Residuals, jacobian};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SymmetricEigen};

/// The measurements with the parts of their covariances at one point.
///
/// The deviations of what finite elements expect are those of the metal that is asked for: a metal far from
/// every computed one is not ruled out by what the emulator does not know of it.
pub struct Objective<'a> {
    experiments: &'a [Experiment],
    unknowns: &'a Unknowns,
    covariances: Vec<Covariance>,
}

impl<'a> Objective<'a> {
    /// With the parts of the covariances at `point`; `None` where there is no metal.
    pub fn new(
        experiments: &'a [Experiment],
        unknowns: &'a Unknowns,
        point: &[f64],
    ) -> Option<Objective<'a>> {
        let covariances = experiments.iter().map(|e| e.covariance(unknowns, point));
        Some(Objective { experiments, unknowns, covariances: covariances.collect::<Option<_>>()? })
    }

    /// Factors of the covariances at `point`.
    fn factors(&self, point: &[f64]) -> Option<Vec<Cholesky<f64, Dyn>>> {
        let both = self.experiments.iter().zip(&self.covariances);
        both.map(|(e, covariance)| covariance.factor(e.model_deviations(self.unknowns, point)?)).collect()
    }

    /// The differences at `point`, independent of each other by the `factors` of their covariances.
    fn whitened(&self, factors: &[Cholesky<f64, Dyn>], point: &[f64]) -> Option<Vec<f64>> {
        let mut all = Vec::new();
        for (experiment, factor) in self.experiments.iter().zip(factors) {
            let differences = DVector::from_vec(experiment.differences(self.unknowns, point, false)?);
            let whitened = factor.l_dirty().solve_lower_triangular(&differences)?;
            if whitened.iter().any(|x| !x.is_finite()) {
                return None;
            }
            all.extend(whitened.iter());
        }
        Some(all)
    }

    /// The bounds of the coordinates.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.unknowns.parameters.iter().map(|p| p.bounds).collect()
    }
}

impl ResidualFunction for Objective<'_> {
    fn residuals(&self, point: &[f64]) -> Option<Vec<f64>> {
        self.whitened(&self.factors(point)?, point)
    }

    fn about(&self, point: &[f64]) -> Option<Box<Function<'_>>> {
        let factors = self.factors(point)?;
        Some(Box::new(move |near| self.whitened(&factors, near)))
    }
}

/// Curvature of a coordinate whose bounds meet.
const HELD_CURVATURE: f64 = 1e18;

/// Curvature of half the sum of squares, coordinates over the widths of their bounds, with its eigenvalues
/// and directions.
pub fn curvature(objective: &Objective<'_>, point: &[f64]) -> Option<SymmetricEigen<f64, Dyn>> {
    let bounds = objective.bounds();
    let mut slopes = jacobian(objective, point, &bounds)?;
    for (mut column, [low, high]) in slopes.column_iter_mut().zip(&bounds) {
        column *= high - low;
    }
    let mut normal: DMatrix<f64> = slopes.tr_mul(&slopes);
    // a coordinate that is held is known
    for (i, _) in bounds.iter().enumerate().filter(|(_, [low, high])| high <= low) {
        normal[(i, i)] = HELD_CURVATURE;
    }
    Some(normal.symmetric_eigen())
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
