//! All measurements at once: residuals in standard deviations, by one covariance for each measurement.

use super::covariance::Covariance;
use super::emulator::{MODEL_PARTS, log_determinant};
use super::experiment::Experiment;
use super::parameters::Unknowns;
use crate::levenberg_marquardt::{Function, ResidualFunction, Residuals, jacobian};
use crate::numbers::limit;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SymmetricEigen};

/// The measurements with the parts of their covariances at one point.
///
/// The deviations of what finite elements expect are those of the metal that is asked for: a metal far from
/// every computed one is not ruled out by what the emulator does not know of it. A search does not prefer it
/// for that either: there the growth of ln det C over that of a computed metal is one more residual, as in
/// the likelihood of a normal law. Intervals go without it, for what was not asked does not narrow them.
pub struct Objective<'a> {
    experiments: &'a [Experiment],
    unknowns: &'a Unknowns,
    covariances: Vec<Covariance>,
    /// Sum of ln det C of computed metals, above which its growth counts; infinite where it does not.
    least_logarithm: f64,
}

/// Misfit of a measurement, or of several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// Sum of squares of its differences.
    pub chi2: f64,
    /// Their number.
    pub count: usize,
    /// Growth of the largest sum that chance allows because the noise was taken from few points.
    room: f64,
}

impl Misfit {
    /// That of several measurements together.
    pub fn sum(all: &[Misfit]) -> Misfit {
        Misfit {
            chi2: all.iter().map(|m| m.chi2).sum(),
            count: all.iter().map(|m| m.count).sum(),
            room: all.iter().map(|m| m.room).sum(),
        }
    }

    /// The largest sum that chance allows with so many `unknowns`.
    pub fn limit(&self, unknowns: usize) -> f64 {
        limit(self.count as i64 - unknowns as i64, self.room)
    }

    /// True where the sum is not larger.
    pub fn fits(&self, unknowns: usize) -> bool {
        self.chi2 <= self.limit(unknowns)
    }
}

impl<'a> Objective<'a> {
    /// With the parts of the covariances at `point`; `None` where there is no metal.
    pub fn new(
        experiments: &'a [Experiment],
        unknowns: &'a Unknowns,
        point: &[f64],
    ) -> Option<Objective<'a>> {
        let covariances = experiments.iter().map(|e| e.covariance(unknowns, point));
        let covariances: Vec<Covariance> = covariances.collect::<Option<_>>()?;
        let least = experiments.iter().zip(&covariances).map(|(e, c)| c.factor(e.least_deviations()));
        let least_logarithm = logarithm(&least.collect::<Option<Vec<_>>>()?);
        Some(Objective { experiments, unknowns, covariances, least_logarithm })
    }

    /// The same for intervals, in which what is not known of a metal counts for it.
    pub fn for_intervals(self) -> Objective<'a> {
        Objective { least_logarithm: f64::INFINITY, ..self }
    }

    /// Sum of squares of the differences at `point` alone.
    pub fn misfit(&self, point: &[f64]) -> Option<f64> {
        Some(self.misfits(point)?.iter().map(|misfit| misfit.chi2).sum())
    }

    /// Misfit of each measurement at `point`.
    pub fn misfits(&self, point: &[f64]) -> Option<Vec<Misfit>> {
        let all = self.whitened(&self.factors(point)?, point)?;
        let mut first = 0;
        let each = self.experiments.iter().map(|e| {
            let count = e.differences(self.unknowns, point, false)?.len();
            let chi2 = all[first..first + count].iter().map(|x| x * x).sum();
            first += count;
            Some(Misfit { chi2, count, room: e.room_for_the_noise(count) })
        });
        each.collect()
    }

    /// Factors of the covariances at `point`.
    fn factors(&self, point: &[f64]) -> Option<Vec<Cholesky<f64, Dyn>>> {
        let both = self.experiments.iter().zip(&self.covariances);
        both.map(|(e, covariance)| covariance.factor(e.model_deviations(self.unknowns, point)?)).collect()
    }

    /// The differences at `point`, independent of each other by the `factors` of their covariances, and the
    /// residual of the latter.
    fn whitened(&self, factors: &[Cholesky<f64, Dyn>], point: &[f64]) -> Option<Vec<f64>> {
        let each = self.independent(factors, point)?;
        let mut all: Vec<f64> = each.iter().flat_map(|whitened| whitened.iter().copied()).collect();
        all.push((logarithm(factors) - self.least_logarithm).max(0.0).sqrt());
        Some(all)
    }

    /// The differences of each measurement at `point`, independent of each other by the `factors`.
    fn independent(&self, factors: &[Cholesky<f64, Dyn>], point: &[f64]) -> Option<Vec<DVector<f64>>> {
        let of = |(experiment, factor): (&Experiment, &Cholesky<f64, Dyn>)| {
            let differences = DVector::from_vec(experiment.differences(self.unknowns, point, false)?);
            let whitened = factor.l_dirty().solve_lower_triangular(&differences)?;
            whitened.iter().all(|x| x.is_finite()).then_some(whitened)
        };
        self.experiments.iter().zip(factors).map(of).collect()
    }

    /// Variances of the model at `point`, of each measurement.
    fn variances(&self, point: &[f64]) -> Option<Vec<[f64; MODEL_PARTS]>> {
        let of = |e: &Experiment| Some(e.model_deviations(self.unknowns, point)?.map(|d| d * d));
        self.experiments.iter().map(of).collect()
    }

    /// The bounds of the coordinates.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.unknowns.parameters.iter().map(|p| p.bounds).collect()
    }
}

/// Sum of ln det of factored covariances.
fn logarithm(factors: &[Cholesky<f64, Dyn>]) -> f64 {
    factors.iter().map(log_determinant).sum()
}

impl ResidualFunction for Objective<'_> {
    fn residuals(&self, point: &[f64]) -> Option<Vec<f64>> {
        self.whitened(&self.factors(point)?, point)
    }

    fn about(&self, point: &[f64]) -> Option<Box<Function<'_>>> {
        let factors = self.factors(point)?;
        Some(Box::new(move |at| self.whitened(&factors, at)))
    }

    fn first_order(&self, point: &[f64]) -> Option<Box<Function<'_>>> {
        let (factors, variances) = (self.factors(point)?, self.variances(point)?);
        let whitened = self.independent(&factors, point)?;
        let each = || self.covariances.iter().zip(&factors);
        let changes: Vec<[DVector<f64>; MODEL_PARTS]> =
            each().zip(&whitened).map(|((c, factor), z)| c.growth_by_variances(factor, z)).collect();
        let growth = logarithm(&factors) - self.least_logarithm;
        let counts = self.least_logarithm.is_finite();
        let growths: Vec<[f64; MODEL_PARTS]> = each()
            .map(|(c, factor)| if counts { c.growth_of_the_logarithm(factor) } else { [0.0; MODEL_PARTS] })
            .collect();
        Some(Box::new(move |at| {
            let (mut all, mut growth) = (Vec::new(), growth);
            let found = self.independent(&factors, at)?.into_iter().zip(self.variances(at)?);
            for (i, (mut differences, now)) in found.enumerate() {
                for k in 0..MODEL_PARTS {
                    let more = now[k] - variances[i][k];
                    differences.axpy(more, &changes[i][k], 1.0);
                    growth += more * growths[i][k];
                }
                all.extend(differences.iter());
            }
            all.push(growth.max(0.0).sqrt());
            Some(all)
        }))
    }
}

/// Curvature of a coordinate whose bounds meet.
const HELD_CURVATURE: f64 = 1e18;

/// Derivatives of the residuals at `point`, coordinates over the widths of their bounds.
pub fn slopes(objective: &Objective<'_>, point: &[f64]) -> Option<DMatrix<f64>> {
    let bounds = objective.bounds();
    let mut slopes = jacobian(objective, point, &bounds)?;
    for (mut column, [low, high]) in slopes.column_iter_mut().zip(&bounds) {
        column *= high - low;
    }
    Some(slopes)
}

/// Curvature of half the sum of squares, coordinates over the widths of their bounds, with its eigenvalues
/// and directions.
pub fn curvature(objective: &Objective<'_>, point: &[f64]) -> Option<SymmetricEigen<f64, Dyn>> {
    let bounds = objective.bounds();
    let slopes = slopes(objective, point)?;
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
            let differences = experiment.differences(unknowns, point, true)?;
            // the points of a curve say together little more than one
            let many = (differences.len() as f64 / 3.0).max(1.0).sqrt();
            let error = (if experiment.is_similar() { 0.03 } else { rough })
                .hypot(experiment.noise)
                .hypot(experiment.model_error);
            all.extend(differences.iter().map(|d| d / (error * many)));
        }
        all.iter().all(|x| x.is_finite()).then_some(all)
    })
}
