//! The formula of `asperity_material::cone_atlas` through the cones of the atlas: least squares, and what is
//! left of cones that are left out.

use asperity_calibration::cones::Row;
use asperity_material::cone_atlas::{Atlas, ERRORS, OUTPUTS, Place, SharpCone};
use nalgebra::{DMatrix, DVector};

/// A cone with a result.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The cone.
    pub cone: SharpCone,
    /// K/E, contact ratio, S/(E h), elastic share, recovery.
    pub answer: [f64; OUTPUTS],
    /// Stated errors of the first four.
    pub errors: [f64; ERRORS],
}

/// The cones of `rows` that have a result which the formula can hold: one goes back as the tool retreats, and
/// a metal without hardening that sinks in once more as it does has no logarithm.
pub fn solved(rows: &[Row]) -> Vec<Solved> {
    let of = |row: &Row| row.answer().map(|(cone, answer, errors)| Solved { cone, answer, errors });
    rows.iter().filter_map(of).filter(|solved| solved.answer.iter().all(|value| *value > 0.0)).collect()
}

/// Least errors of the formula, in the order of [`Solved::errors`]. Chosen on the first 200 cones of
/// [`asperity_calibration::cones::fresh`], held against `reference`: beyond what the companions of the
/// committed cones show, K of metal that hardens is off by up to 0.6 %, the radius of coarse companions is
/// uneven, S has what is left of both, and the work of unloading is 0.5 % too large.
const MIN_ERRORS: [f64; ERRORS] = [0.0065, 0.01, 0.01, 0.009];

/// Parts that are left out in turn.
pub const FOLDS: usize = 5;

/// Added to the diagonal of the normal equations, over its mean: rounding, not smoothing.
const RIDGE: f64 = 1e-9;

/// The formula, and its errors.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Through all cones.
    pub atlas: Atlas,
    /// ln of each cone's K, contact ratio, S and elastic share over those that the formula through the other
    /// four fifths has.
    pub left_out: Vec<[f64; ERRORS]>,
}

/// Fits the formula; `None` with too few cones.
pub fn fit(cones: &[Solved]) -> Option<Fit> {
    let places: Vec<Place> = cones.iter().map(|c| c.cone.place()).collect();
    let logarithms: Vec<[f64; OUTPUTS]> = cones.iter().map(|c| c.cone.logarithms(c.answer)).collect();
    let equations = Equations::new(cones, &places, &logarithms);
    let no_errors = vec![vec![0.0; places.first()?.terms_of_errors().len()]; ERRORS];
    let mut left_out = vec![[0.0; ERRORS]; cones.len()];
    for fold in 0..FOLDS {
        let part = Atlas::new(equations.solve(|i| i % FOLDS != fold)?, no_errors.clone(), [0.0; ERRORS])?;
        for i in (fold..cones.len()).step_by(FOLDS) {
            left_out[i] = differences(&cones[i], &part);
        }
    }
    let errors = (0..ERRORS).map(|k| errors(&places, &left_out, k)).collect::<Option<Vec<_>>>()?;
    let atlas = Atlas::new(equations.solve(|_| true)?, errors, MIN_ERRORS)?;
    Some(Fit { atlas, left_out })
}

/// ln of the four numbers of `cone` over those of `atlas`.
pub fn differences(cone: &Solved, atlas: &Atlas) -> [f64; ERRORS] {
    let found = atlas.nearest(&cone.cone);
    let values = [found.k_over_e, found.contact_ratio, found.stiffness, found.elastic_share].map(|e| e.value);
    std::array::from_fn(|k| (cone.answer[k] / values[k]).ln())
}

/// Weighted least squares, one for each output with weights of its own.
struct Equations {
    terms: DMatrix<f64>,
    logarithms: Vec<[f64; OUTPUTS]>,
    weights: Vec<[f64; OUTPUTS]>,
}

impl Equations {
    fn new(cones: &[Solved], places: &[Place], logarithms: &[[f64; OUTPUTS]]) -> Equations {
        let rows: Vec<Vec<f64>> = places.iter().map(Place::terms).collect();
        let terms = DMatrix::from_fn(rows.len(), rows.first().map_or(0, Vec::len), |i, j| rows[i][j]);
        // the root of the usual weight: stated errors are bounds, and a cone with a small one is not worth
        // hundreds of others
        let weights = cones.iter().map(|cone| std::array::from_fn(|k| 1.0 / cone.errors[k.min(ERRORS - 1)]));
        Equations { terms, logarithms: logarithms.to_vec(), weights: weights.collect() }
    }

    /// The coefficients of each output, of the cones whose number is `used`.
    fn solve(&self, used: impl Fn(usize) -> bool) -> Option<Vec<Vec<f64>>> {
        let rows: Vec<usize> = (0..self.terms.nrows()).filter(|&i| used(i)).collect();
        let count = self.terms.ncols();
        if rows.len() < 2 * count {
            return None;
        }
        let terms = self.terms.select_rows(&rows);
        let coefficients = |k: usize| {
            let weight = DVector::from_fn(rows.len(), |i, _| self.weights[rows[i]][k]);
            let mut weighted = terms.clone();
            for mut column in weighted.column_iter_mut() {
                column.component_mul_assign(&weight);
            }
            let mut normal = weighted.tr_mul(&terms);
            let ridge = RIDGE * normal.trace() / count as f64;
            (0..count).for_each(|i| normal[(i, i)] += ridge);
            let values = DVector::from_fn(rows.len(), |i, _| self.logarithms[rows[i]][k]);
            Some(normal.cholesky()?.solve(&weighted.tr_mul(&values)).iter().copied().collect())
        };
        (0..OUTPUTS).map(coefficients).collect()
    }
}

/// Summand before the logarithm of a residual is taken: below it a residual says nothing.
const NOTHING_ERROR: f64 = 1e-4;

/// Share of the cones left out that lie within the error.
const COVERED_SHARE: f64 = 0.95;

/// Coefficients of the error of number `k`: the logarithm of the residual goes with the place, and 95 % lie
/// below.
fn errors(places: &[Place], left: &[[f64; ERRORS]], k: usize) -> Option<Vec<f64>> {
    let rows: Vec<Vec<f64>> = places.iter().map(Place::terms_of_errors).collect();
    let terms = DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]);
    let logarithms = DVector::from_fn(rows.len(), |i, _| (left[i][k].abs() + NOTHING_ERROR).ln());
    let mut fitted = terms.tr_mul(&terms).cholesky()?.solve(&terms.tr_mul(&logarithms));
    let mut over: Vec<f64> =
        (&terms * &fitted).iter().zip(left).map(|(fitted, left)| left[k].abs().ln() - fitted).collect();
    over.sort_by(f64::total_cmp);
    fitted[0] += over[(COVERED_SHARE * over.len() as f64) as usize];
    Some(fitted.iter().copied().collect())
}
