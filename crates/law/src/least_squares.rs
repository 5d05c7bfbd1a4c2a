//! Weighted linear least squares with a few columns.

use nalgebra::{SMatrix, SVector};

/// A pivot below this share of its diagonal entry is rounding: the columns depend on each other.
const DEPENDENT: f64 = 1e-12;

/// Coefficients that minimise Σ w (y - Σ_k c_k b_k)², `columns` numbers b per row; `None` if the columns are dependent.
pub fn solve<const N: usize>(rows: &[([f64; N], f64, f64)]) -> Option<[f64; N]> {
    let mut normal = SMatrix::<f64, N, N>::zeros();
    let mut rhs = SVector::<f64, N>::zeros();
    for (basis, y, weight) in rows {
        let basis = SVector::from(*basis);
        normal += *weight * basis * basis.transpose();
        rhs += *weight * *y * basis;
    }
    let factor = normal.cholesky()?;
    let independent = (0..N).all(|i| factor.l_dirty()[(i, i)].powi(2) > DEPENDENT * normal[(i, i)]);
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
    pub fn through(points: &[[f64; 2]]) -> Line {
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
