//! A matrix that is not symmetric, solved with the factors of a symmetric one that is close to it.

use crate::vectors::{add, dot, norm};

/// Directions of a solve at most.
const MOST_DIRECTIONS: usize = 12;

/// Residual over right-hand side at which a solve is done: what it leaves is less than what Newton's method
/// leaves in a step.
const TOLERANCE: f64 = 1e-2;

/// The entries of a matrix beside those of the one whose factors are known.
#[derive(Clone, Debug, Default)]
pub struct Correction {
    entries: Vec<(u32, u32, f64)>,
}

impl Correction {
    /// Nothing.
    pub fn clear(&mut self) {
        self.entries.clear();
    }

    /// Adds `value` at (row, column).
    pub fn add_entry(&mut self, row: u32, column: u32, value: f64) {
        if value != 0.0 {
            self.entries.push((row, column, value));
        }
    }

    /// Replaces `rhs` by (K + C)⁻¹ times it, C this correction; `solve` replaces a vector by K⁻¹ times it.
    ///
    /// Generalised minimal residuals (Saad, Schultz: SIAM J. Sci. Stat. Comput. 7 (1986)) with K⁻¹ on the
    /// right: as C has few rows, few directions hold the solution.
    pub fn solve(&self, rhs: &mut [f64], mut solve: impl FnMut(&mut [f64])) {
        if self.entries.is_empty() {
            return solve(rhs);
        }
        let size = norm(rhs);
        if size == 0.0 || !size.is_finite() {
            return solve(rhs);
        }
        let mut basis = vec![rhs.iter().map(|r| r / size).collect::<Vec<f64>>()];
        let mut solved: Vec<Vec<f64>> = Vec::new();
        // columns of the triangle that rotations make of Hessenberg's matrix, and its right-hand side
        let (mut triangle, mut rotations): (Vec<Vec<f64>>, Vec<[f64; 2]>) = Default::default();
        let mut left = vec![size];
        for j in 0..MOST_DIRECTIONS {
            let mut z = basis[j].clone();
            solve(&mut z);
            let mut w = basis[j].clone();
            for &(row, column, value) in &self.entries {
                w[row as usize] += value * z[column as usize];
            }
            solved.push(z);
            let mut column: Vec<f64> = Vec::with_capacity(j + 2);
            for v in &basis {
                let share = dot(v, &w);
                add(&mut w, -share, v);
                column.push(share);
            }
            let next = norm(&w);
            for (i, [c, s]) in rotations.iter().enumerate() {
                (column[i], column[i + 1]) =
                    (c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]);
            }
            let length = column[j].hypot(next);
            let [c, s] = [column[j] / length, next / length];
            column[j] = length;
            rotations.push([c, s]);
            triangle.push(column);
            left.push(-s * left[j]);
            left[j] *= c;
            if left[j + 1].abs() <= TOLERANCE * size || next == 0.0 {
                break;
            }
            basis.push(w.iter().map(|w| w / next).collect());
        }
        rhs.fill(0.0);
        let mut shares = left;
        for j in (0..solved.len()).rev() {
            shares[j] /= triangle[j][j];
            for i in 0..j {
                shares[i] -= triangle[j][i] * shares[j];
            }
            add(rhs, shares[j], &solved[j]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three unknowns, K diagonal, C of two entries: the solution satisfies (K + C) x = r.
    #[test]
    fn the_corrected_matrix_is_solved() {
        let diagonal = [2.0, 3.0, 4.0];
        let mut correction = Correction::default();
        correction.add_entry(0, 2, 1.5);
        correction.add_entry(1, 0, -0.7);
        let rhs = [1.0, -2.0, 0.5];
        let mut x = rhs;
        correction.solve(&mut x, |v| v.iter_mut().zip(diagonal).for_each(|(v, d)| *v /= d));
        let left = [2.0 * x[0] + 1.5 * x[2] - rhs[0], 3.0 * x[1] - 0.7 * x[0] - rhs[1], 4.0 * x[2] - rhs[2]];
        assert!(norm(&left) <= TOLERANCE * norm(&rhs), "{left:?}");
        correction.clear();
        let mut x = rhs;
        correction.solve(&mut x, |v| v.iter_mut().zip(diagonal).for_each(|(v, d)| *v /= d));
        assert_eq!(x, [0.5, -2.0 / 3.0, 0.125]);
    }
}
