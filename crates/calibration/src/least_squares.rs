//! Weighted linear least squares with a few columns.

/// Coefficients that minimise Σ w (y - Σ_k c_k b_k)², `columns` numbers b per row; `None` if the columns are dependent.
pub fn solve<const N: usize>(rows: &[([f64; N], f64, f64)]) -> Option<[f64; N]> {
    let mut a = [[0.0; N]; N];
    let mut rhs = [0.0; N];
    for (basis, y, weight) in rows {
        for i in 0..N {
            rhs[i] += weight * basis[i] * y;
            for j in 0..=i {
                a[i][j] += weight * basis[i] * basis[j];
            }
        }
    }
    // Cholesky in place, lower triangle
    for i in 0..N {
        for j in 0..=i {
            let s: f64 = a[i][j] - (0..j).map(|k| a[i][k] * a[j][k]).sum::<f64>();
            if i == j {
                if s.is_nan() || s <= 1e-12 * a[i][i] {
                    return None;
                }
                a[i][i] = s.sqrt();
            } else {
                a[i][j] = s / a[j][j];
            }
        }
    }
    let mut c = rhs;
    for i in 0..N {
        c[i] = (c[i] - (0..i).map(|k| a[i][k] * c[k]).sum::<f64>()) / a[i][i];
    }
    for i in (0..N).rev() {
        c[i] = (c[i] - (i + 1..N).map(|k| a[k][i] * c[k]).sum::<f64>()) / a[i][i];
    }
    Some(c)
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
