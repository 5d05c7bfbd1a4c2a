//! Linear least squares: weighted with a few columns, and with columns that are added one by one.

use crate::vectors::dot;
use nalgebra::{SMatrix, SVector};

/// A pivot below this share of its diagonal entry is rounding: the columns depend on each other.
const DEPENDENT_PIVOT: f64 = 1e-12;

/// Coefficients that minimise Σ w (y - Σ_k c_k b_k)², `columns` numbers b per row; `None` if the columns are
/// dependent.
pub fn solve<const N: usize>(rows: &[([f64; N], f64, f64)]) -> Option<[f64; N]> {
    let mut normal = SMatrix::<f64, N, N>::zeros();
    let mut rhs = SVector::<f64, N>::zeros();
    for (basis, y, weight) in rows {
        let basis = SVector::from(*basis);
        normal += *weight * basis * basis.transpose();
        rhs += *weight * *y * basis;
    }
    let factor = normal.cholesky()?;
    let independent = (0..N).all(|i| factor.l_dirty()[(i, i)].powi(2) > DEPENDENT_PIVOT * normal[(i, i)]);
    independent.then(|| factor.solve(&rhs).into())
}

/// A straight line through points, with the standard error of its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// dy/dx.
    pub slope: f64,
    /// Standard error of the slope, from the scatter about the line; NaN of two points.
    pub slope_error: f64,
}

impl Line {
    /// Through points (x, y), all with the same weight; NaN of fewer than two different x.
    pub fn fit(points: &[[f64; 2]]) -> Line {
        let n = points.len() as f64;
        let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / n;
        let (x, y) = (mean(0), mean(1));
        let sxx: f64 = points.iter().map(|p| (p[0] - x).powi(2)).sum();
        let slope = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum::<f64>() / sxx;
        let rest: f64 = points.iter().map(|p| (p[1] - y - slope * (p[0] - x)).powi(2)).sum();
        Line { slope, slope_error: (rest / (n - 2.0) / sxx).sqrt() }
    }
}

/// Σ c_k b_k.
pub fn value<const N: usize>(coefficients: &[f64; N], basis: &[f64; N]) -> f64 {
    coefficients.iter().zip(basis).map(|(c, b)| c * b).sum()
}

/// 1, u, u², …
pub fn powers<const N: usize>(u: f64) -> [f64; N] {
    let mut basis = [1.0; N];
    for k in 1..N {
        basis[k] = basis[k - 1] * u;
    }
    basis
}

/// A column of which a smaller share than this is left beside the earlier ones is rounding.
const ROUNDING_NORM: f64 = 1e-12;
/// A rest above this share of a sum of squares is orthogonal to rounding.
const SMALL_REST: f64 = 0.01;

/// A least-squares problem to which columns are added one after the other, each made orthogonal to those
/// before it: a column that depends on them is refused, and what an added one gains is known without solving
/// anew.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    own: Vec<Vec<f64>>,
    orthonormal: Vec<Vec<f64>>,
}

impl Columns {
    /// No column.
    pub fn new() -> Columns {
        Columns::default()
    }

    /// Number of columns.
    pub fn count(&self) -> usize {
        self.own.len()
    }

    /// The part of `y` that the columns do not explain.
    pub fn remainder(&self, y: &[f64]) -> Vec<f64> {
        self.reduced(y.to_vec(), 0)
    }

    /// The part of `rest` that the columns from the index `from` on do not explain.
    fn reduced(&self, mut rest: Vec<f64>, from: usize) -> Vec<f64> {
        let mut size = dot(&rest, &rest);
        loop {
            for q in &self.orthonormal[from..] {
                take_away(&mut rest, q);
            }
            let left = dot(&rest, &rest);
            // a pass leaves rounding of the size of what it took away
            if left.is_nan() || left >= SMALL_REST * size {
                return rest;
            }
            size = left;
        }
    }

    /// The fit of `y`.
    pub fn fitted(&self, y: &[f64]) -> Vec<f64> {
        self.remainder(y).iter().zip(y).map(|(rest, y)| y - rest).collect()
    }

    /// Adds `column` if more than the share `least` of its sum of squares is independent of the others.
    pub fn add(&mut self, column: Vec<f64>, least: f64) -> bool {
        let rest = self.remainder(&column);
        self.add_rest(column, rest, least)
    }

    /// The same where `remainder` is what the first `known` columns leave of it.
    pub fn add_beyond(&mut self, known: usize, column: &[f64], remainder: &[f64], least: f64) -> bool {
        let rest = self.reduced(remainder.to_vec(), known);
        self.add_rest(column.to_vec(), rest, least)
    }

    fn add_rest(&mut self, column: Vec<f64>, mut rest: Vec<f64>, least: f64) -> bool {
        let (left, all) = (dot(&rest, &rest), dot(&column, &column));
        if left.is_nan() || left <= least.max(ROUNDING_NORM) * all {
            return false;
        }
        rest.iter_mut().for_each(|r| *r /= left.sqrt());
        self.orthonormal.push(rest);
        self.own.push(column);
        true
    }

    /// The part that the columns from the index `from` on contribute to the fit of `y`.
    pub fn contribution(&self, y: &[f64], from: usize) -> Vec<f64> {
        let mut sum = vec![0.0; y.len()];
        // the last coefficient first: each column is what is left of it plus a sum of those before
        for j in (from..self.count()).rev() {
            let (q, column) = (&self.orthonormal[j], &self.own[j]);
            let coefficient = (dot(q, y) - dot(q, &sum)) / dot(q, column);
            sum.iter_mut().zip(column).for_each(|(s, c)| *s += coefficient * c);
        }
        sum
    }
}

/// How well a fit predicts `y`, kept up while columns are added to it.
#[derive(Clone, Debug)]
pub struct LeftOut {
    rest: Vec<f64>,
    leverage: Vec<f64>,
    columns: usize,
}

impl LeftOut {
    /// That of `y` without a column.
    pub fn new(y: &[f64]) -> LeftOut {
        LeftOut { rest: y.to_vec(), leverage: vec![0.0; y.len()], columns: 0 }
    }

    /// Mean square of the error with which each row is predicted by the fit of `columns` to all other rows
    /// (Allen's PRESS): unlike the residual, it grows again where columns fit what is chance. The first ones
    /// of `columns` are those of the last call.
    pub fn error(&mut self, columns: &Columns) -> f64 {
        for q in &columns.orthonormal[self.columns..] {
            take_away(&mut self.rest, q);
            self.leverage.iter_mut().zip(q).for_each(|(sum, q)| *sum += q * q);
        }
        self.columns = columns.count();
        let error = |(rest, leverage): (&f64, &f64)| (rest / (1.0 - leverage).max(1e-3)).powi(2);
        self.rest.iter().zip(&self.leverage).map(error).sum::<f64>() / self.rest.len() as f64
    }
}

/// Takes from `rest` what lies along the column `q` of length 1.
fn take_away(rest: &mut [f64], q: &[f64]) {
    let along = dot(q, rest);
    rest.iter_mut().zip(q).for_each(|(r, q)| *r -= along * q);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(f: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..40).map(|i| f(0.1 * f64::from(i))).collect()
    }

    #[test]
    fn columns_return_what_each_contributes_and_refuse_what_depends_on_others() {
        let mut columns = Columns::new();
        assert!(columns.add(column(|_| 1.0), 0.0) && columns.add(column(|x| x), 0.0));
        assert!(!columns.add(column(|x| 3.0 - 2.0 * x), 0.0) && !columns.add(column(|_| 0.0), 0.0));
        assert!(!columns.add(column(|_| f64::NAN), 0.0));
        assert!(columns.add(column(f64::cos), 0.0) && columns.add(column(f64::sin), 0.0));
        let y = column(|x| 5.0 - x + 0.3 * x.cos() + 0.2 * x.sin());
        let periodic = columns.contribution(&y, 2);
        for (got, expected) in periodic.iter().zip(column(|x| 0.3 * x.cos() + 0.2 * x.sin())) {
            assert!((got - expected).abs() < 1e-12);
        }
        assert!(LeftOut::new(&y).error(&columns) < 1e-24 && columns.count() == 4);
        let rest = columns.remainder(&column(|x| 1.0 + x));
        assert!(dot(&rest, &rest) < 1e-20);
    }

    #[test]
    fn the_left_out_error_is_that_of_a_fit_without_the_row() {
        let y = column(|x| x.exp());
        let fit = |left_out: usize| {
            let rows: Vec<([f64; 2], f64, f64)> = (0..40)
                .map(|i| (powers(0.1 * i as f64), y[i], if i == left_out { 0.0 } else { 1.0 }))
                .collect();
            value(&solve(&rows).unwrap(), &powers(0.1 * left_out as f64)) - y[left_out]
        };
        let expected = (0..40).map(|i| fit(i).powi(2)).sum::<f64>() / 40.0;
        let mut columns = Columns::new();
        let mut left_out = LeftOut::new(&y);
        columns.add(column(|_| 1.0), 0.0);
        let constant = left_out.error(&columns);
        columns.add(column(|x| x), 0.0);
        let line = left_out.error(&columns);
        assert!((line / expected - 1.0).abs() < 1e-9 && line < constant);
        assert_eq!(line, LeftOut::new(&y).error(&columns));
    }
}
