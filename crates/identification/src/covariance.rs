//! Covariance of the differences between a measurement and what finite elements expect.

use super::emulator::{MODEL_PARTS, log_determinant};
use super::experiment::{Data, Expected, Experiment};
use super::imprint;
use super::interpolation::alike;
use super::parameters::Unknowns;
use super::unloading_parabola::UnloadingParabola;
use crate::measured_curve::Measured;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Logarithms of the depth over which the force that a body is expected to need is too large or too small
/// alike. That of a sharp cone is one number, K, off alike at every depth.
const ALIKE_LOG_DEPTH: f64 = 1.0;
/// Share of the deepest depth from which finite elements state the error of the force along a curve; below
/// it, where fewer elements touch, the error of a body grows as the inverse of the depth.
const STATED_DEPTH_SHARE: f64 = 0.2;
/// Shares of the peak force over which the error of the shape of the unloading curve is alike, and its
/// standard deviation over that of the whole recovery: an unloading is read at few forces, at a few steps.
const ALIKE_FORCE_SHARE: f64 = 0.25;
const WAY_SHAPE_SHARE: f64 = 0.5;

/// Effect on the difference at a point of a curve of errors of the expected force and of the unloading
/// curve.
struct ErrorOfAPoint {
    /// Logarithm of the depth over the deepest; unloading begins there.
    place: f64,
    /// Of a relative error of the force.
    by_the_force: f64,
    /// Of a relative error of the slope where unloading begins, and of the whole recovery.
    by_the_way: [f64; 2],
    /// Share of the peak force.
    share: f64,
}

/// Change of a logarithm by which its effect on the differences is taken.
const CHANGE: f64 = 1e-4;

/// Covariance of the differences of a measurement: what belongs to the data, and what each relative error of
/// the finite elements adds for a variance of 1.
#[derive(Clone, Debug)]
pub struct Covariance {
    noise: DMatrix<f64>,
    model: [DMatrix<f64>; MODEL_PARTS],
}

impl Covariance {
    /// That of data of which one error of the finite elements is known alone.
    fn of_the_first(noise: DMatrix<f64>, model: DMatrix<f64>) -> Covariance {
        let none = DMatrix::zeros(noise.nrows(), noise.ncols());
        Covariance::of_three(noise, [model, none.clone(), none])
    }

    /// That of data of which the errors of force, slope and recovery are known.
    fn of_three(noise: DMatrix<f64>, [force, slope, recovery]: [DMatrix<f64>; 3]) -> Covariance {
        let none = DMatrix::zeros(noise.nrows(), noise.ncols());
        Covariance { model: [force, slope, recovery, none], noise }
    }

    /// The factor of the covariance with the model's standard deviations; `None` where it has none.
    pub fn factor(&self, deviations: [f64; MODEL_PARTS]) -> Option<Cholesky<f64, Dyn>> {
        self.sum(deviations).cholesky()
    }

    /// Changes of `whitened` differences, independent of each other by `factor`, with each variance of the
    /// model, to first order.
    pub fn growth_by_variances(
        &self,
        factor: &Cholesky<f64, Dyn>,
        whitened: &DVector<f64>,
    ) -> [DVector<f64>; MODEL_PARTS] {
        let lower = factor.l_dirty();
        let weights = lower.tr_solve_lower_triangular(whitened);
        self.model.each_ref().map(|part| {
            let change = weights.as_ref().and_then(|w| lower.solve_lower_triangular(&(part * w)));
            change.map_or(DVector::zeros(whitened.len()), |change| -0.5 * change)
        })
    }

    /// Growth of ln det C with each variance of the model.
    pub fn growth_of_the_logarithm(&self, factor: &Cholesky<f64, Dyn>) -> [f64; MODEL_PARTS] {
        let inverse = factor.inverse();
        self.model.each_ref().map(|part| inverse.dot(part))
    }

    fn sum(&self, deviations: [f64; MODEL_PARTS]) -> DMatrix<f64> {
        let mut sum = self.noise.clone();
        for (part, deviation) in self.model.iter().zip(deviations) {
            sum.zip_apply(part, |entry, more| *entry += deviation * deviation * more);
        }
        sum
    }
}

impl Experiment {
    /// Relative standard deviations of what finite elements expect at `point`: of the force, of the slope
    /// where unloading begins, of the recovery; and the share of the scatter of all numbers that is left.
    pub fn model_deviations(&self, unknowns: &Unknowns, point: &[f64]) -> Option<[f64; MODEL_PARTS]> {
        let left = self.emulator.left(&self.design_point(unknowns, point)?, self.of_the_loading());
        let told = self.told_deviations();
        Some(std::array::from_fn(|i| told[i].hypot(left[i])))
    }

    /// The same at a computed metal: what finite elements are asked for can bring no less.
    pub fn least_deviations(&self) -> [f64; MODEL_PARTS] {
        let left = self.emulator.least_left(self.errors[0], self.is_imprint(), self.of_the_loading());
        let told = self.told_deviations();
        std::array::from_fn(|i| told[i].hypot(left[i]))
    }

    /// Those of finite elements by themselves.
    pub fn told_deviations(&self) -> [f64; MODEL_PARTS] {
        // the stated errors are 95 % bounds
        let [force, slope, recovery] = self.errors.map(|error| (0.5 * error).hypot(self.model_error));
        [force, slope, recovery, 0.0]
    }

    /// Growth of ln det C over that of a computed metal, by what the emulator leaves open at `point`.
    pub fn growth(&self, unknowns: &Unknowns, point: &[f64]) -> Option<f64> {
        let covariance = self.covariance(unknowns, point)?;
        let open = covariance.factor(self.model_deviations(unknowns, point)?)?;
        let least = covariance.factor(self.least_deviations())?;
        Some(log_determinant(&open) - log_determinant(&least))
    }

    /// Mean variance of the differences at `point` by what finite elements expect.
    pub fn variance_of_the_model(&self, unknowns: &Unknowns, point: &[f64]) -> Option<f64> {
        let model = self.covariance(unknowns, point)?.model;
        let deviations = self.model_deviations(unknowns, point)?;
        let count = model[0].nrows().max(1) as f64;
        let sum: f64 = model.iter().zip(deviations).map(|(part, d)| d * d * part.trace()).sum();
        Some(sum / count)
    }

    /// Covariance of the differences at `point`, in its parts.
    pub fn covariance(&self, unknowns: &Unknowns, point: &[f64]) -> Option<Covariance> {
        let expected = self.expected(unknowns, point, false)?;
        let mut covariance = match &self.data {
            Data::Features { loading_curvature, unloading_slope, plastic_work_ratio } => {
                let given = [
                    loading_curvature.map(|_| [1.0, 0.0, 0.0]),
                    unloading_slope.map(|_| [0.0, 1.0, 0.0]),
                    // what is said of the returned work is said of its complement, less
                    plastic_work_ratio.map(|data| [0.0, 0.0, (1.0 - data) / data]),
                ];
                let effects: Vec<[f64; 3]> = given.into_iter().flatten().collect();
                let count = effects.len();
                let part = |k: usize| {
                    DMatrix::from_fn(count, count, |i, j| if i == j { effects[i][k].powi(2) } else { 0.0 })
                };
                let noise = DMatrix::identity(count, count) * self.noise.powi(2);
                Covariance::of_three(noise, [part(0), part(1), part(2)])
            }
            Data::Curve(measured) => self.covariance_of_a_curve(measured),
            Data::Imprint(imprint) => {
                let radius = imprint::radius_over_depth(&expected.logarithms) * self.true_depth(&expected);
                let [noise, model] = imprint.covariances(radius, self.depth);
                Covariance::of_the_first(noise, model)
            }
            Data::ImprintNumbers(numbers) => {
                let given = [numbers.pile_up_height, numbers.residual_depth, numbers.rim_radius];
                let scales = [0, 1, 2].map(|k| given[k].map(|d| if k < 2 { d / self.depth } else { 1.0 }));
                let diagonal = |of: &dyn Fn(usize, f64) -> f64| {
                    let sizes = scales.iter().enumerate().filter_map(|(k, s)| Some(of(k, (*s)?).powi(2)));
                    DMatrix::from_diagonal(&sizes.collect::<Vec<_>>().into())
                };
                let noise = diagonal(&|_, scale| self.noise * scale);
                Covariance::of_the_first(noise, diagonal(&|k, _| imprint::ERRORS_OF_NUMBERS[k]))
            }
        };
        if let Some(scatter) = self.emulator.scatter_of_the_numbers() {
            let effects = self.effects_of_the_numbers(&expected)?;
            covariance.model[MODEL_PARTS - 1] = &effects * scatter * effects.transpose();
        }
        let Some(pyramid) = self.pyramid else { return Some(covariance) };
        // that of the metal at the point: where it grows with the metal, a fit would flee to where it is wide
        let [force, slope, recovery] = pyramid.correction(&self.design_point(unknowns, point)?).deviations;
        let corrected = [force, slope, recovery, 0.0];
        Some(Covariance { noise: covariance.sum(corrected), ..covariance })
    }

    /// Growth of each difference with each of the logarithms that are expected.
    fn effects_of_the_numbers(&self, expected: &Expected) -> Option<DMatrix<f64>> {
        let here = DVector::from_vec(self.differences_from(expected));
        let columns = (0..expected.logarithms.len()).map(|j| {
            let mut moved = expected.clone();
            moved.logarithms[j] += CHANGE;
            (DVector::from_vec(self.differences_from(&moved)) - &here) / CHANGE
        });
        let columns: Vec<DVector<f64>> = columns.collect();
        (!columns.is_empty()).then(|| DMatrix::from_columns(&columns))
    }

    fn covariance_of_a_curve(&self, measured: &Measured) -> Covariance {
        let load = measured.loading.len();
        let length = if self.is_similar() { f64::INFINITY } else { ALIKE_LOG_DEPTH };
        let shallow =
            |share: f64| if self.is_similar() { 1.0 } else { (STATED_DEPTH_SHARE / share).max(1.0) };
        // a force that is expected too large takes from each difference of the loading, and adds to each of
        // the way back
        let of_the_loading = measured.loading.iter().map(|p| {
            let depth = (p[0] / self.depth).abs().max(1e-3);
            let by_the_force = -shallow(depth);
            ErrorOfAPoint { place: depth.ln(), by_the_force, by_the_way: [0.0; 2], share: 1.0 }
        });
        let shares: Vec<f64> = measured.unloading.iter().map(|p| p[1] / measured.peak[1]).collect();
        // measured, not expected: deviations that change with the metal would change what fits best
        let parabola = UnloadingParabola::new(&measured.unloading, measured.peak[1]);
        let slopes: Vec<f64> =
            measured.unloading.iter().map(|p| parabola.growth(p[1]) / self.depth).collect();
        let of_the_unloading = measured.unloading.iter().zip(&slopes).zip(&shares).map(|((p, slope), s)| {
            let way = (measured.peak[0] - p[0]).max(0.0) / self.depth;
            // near the peak the way is the slope's, at the end the whole
            let by_the_way = [way * s, way * (1.0 - s)];
            ErrorOfAPoint { place: 0.0, by_the_force: *slope, by_the_way, share: *s }
        });
        let errors: Vec<ErrorOfAPoint> = of_the_loading.chain(of_the_unloading).collect();
        let count = errors.len();
        // of readings that scatter by themselves a mean of fewer scatters more than that of the loading, from
        // which the noise is
        let [of_the_loading, of_the_unloading] = measured.averaged;
        let by_themselves = !self.noise_given && self.noise_correlation == 0.0;
        let fewer = if by_themselves { of_the_loading / of_the_unloading } else { 1.0 };
        let scatter = fewer.max(1.0).sqrt();
        let of_the_force = |slope: &f64| (self.noise * scatter * slope.max(0.02)).max(1e-5);
        let own = self.noise_of_depths(measured, slopes.iter().map(of_the_force));
        let noise =
            |i: usize| i.checked_sub(load).map_or(self.noise, |back| of_the_force(&slopes[back]).hypot(own));
        let part = |of_a_pair: &dyn Fn(&ErrorOfAPoint, &ErrorOfAPoint) -> f64| {
            DMatrix::from_fn(count, count, |i, j| of_a_pair(&errors[i], &errors[j]))
        };
        let force = part(&|a, b| alike(a.place - b.place, length) * a.by_the_force * b.by_the_force);
        let slope = part(&|a, b| a.by_the_way[0] * b.by_the_way[0]);
        let whole = part(&|a, b| {
            let way = |e: &ErrorOfAPoint| e.by_the_way[0] + e.by_the_way[1];
            let shape = WAY_SHAPE_SHARE.powi(2) * alike(a.share - b.share, ALIKE_FORCE_SHARE);
            a.by_the_way[1] * b.by_the_way[1] + shape * way(a) * way(b)
        });
        let noise = DMatrix::from_fn(count, count, |i, j| {
            // readings of one stretch are off alike, those of loading and way back are not
            let of_one_stretch = (i < load) == (j < load);
            let steps = i.abs_diff(j) as i32;
            let together = if of_one_stretch { self.noise_correlation.powi(steps) } else { 0.0 };
            noise(i) * noise(j) * together
        });
        Covariance::of_three(noise, [force, slope, whole])
    }

    /// Standard deviation of the depth of a point of the unloading by noise of depths, over the depth of the
    /// curve: by what its readings scatter more than noise of forces, which is `of_the_forces`, lets them. In
    /// loading such noise is one of forces, in unloading, which is steep, it is all that counts.
    fn noise_of_depths(&self, measured: &Measured, of_the_forces: impl ExactSizeIterator<Item = f64>) -> f64 {
        if self.noise_given || measured.unloading.is_empty() {
            return 0.0;
        }
        let readings = if self.noise_correlation == 0.0 { measured.averaged[1] } else { 1.0 };
        let count = of_the_forces.len() as f64;
        let of_the_forces = of_the_forces.map(|deviation| deviation.powi(2)).sum::<f64>() / count;
        let all = (measured.scatter_of_the_unloading / self.depth).powi(2) / readings;
        (all - of_the_forces).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sum of squares and ln det C change with each variance of the model as differences of them say.
    #[test]
    fn growth_by_a_variance_is_the_derivative_by_differences() {
        let part = |k: usize| {
            let along = DVector::from_fn(4, |i, _| ((i + 1) as f64 * (k + 1) as f64).sin());
            &along * along.transpose()
        };
        let noise = DMatrix::from_fn(4, 4, |i, j| if i == j { 1.0 + 0.1 * i as f64 } else { 0.2 });
        let covariance = Covariance { noise, model: [part(0), part(1), part(2), part(3)] };
        let differences = DVector::from_vec(vec![0.7, -1.1, 0.4, 2.0]);
        let variances = [0.5, 1.5, 0.2, 0.7_f64];
        let factor = |variances: [f64; MODEL_PARTS]| covariance.factor(variances.map(f64::sqrt)).unwrap();
        let whitened = |variances: [f64; MODEL_PARTS]| {
            factor(variances).l_dirty().solve_lower_triangular(&differences).unwrap()
        };
        let here = factor(variances);
        let changes = covariance.growth_by_variances(&here, &whitened(variances));
        let logarithms = covariance.growth_of_the_logarithm(&here);
        for k in 0..MODEL_PARTS {
            let step = 1e-5;
            let moved = |by: f64| {
                let mut there = variances;
                there[k] += by;
                there
            };
            let slope =
                |of: &dyn Fn([f64; MODEL_PARTS]) -> f64| (of(moved(step)) - of(moved(-step))) / (2.0 * step);
            let of_the_sum = slope(&|v| whitened(v).norm_squared());
            let told = 2.0 * whitened(variances).dot(&changes[k]);
            assert!((told - of_the_sum).abs() < 1e-7, "{k} {told} {of_the_sum}");
            let of_the_logarithm = slope(&|v| log_determinant(&factor(v)));
            assert!((logarithms[k] - of_the_logarithm).abs() < 1e-7, "{k}");
        }
    }
}
