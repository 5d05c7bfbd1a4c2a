//! Least squares with a narrow band: the normal equations of a spline and their solution.

/// Entries of a row from the diagonal on.
pub const BAND: usize = 3;

/// A symmetric positive definite band matrix with its right-hand side.
pub struct Bands {
    /// Upper band: entry (i, i + k) at `[i][k]`.
    rows: Vec<[f64; BAND]>,
    rhs: Vec<f64>,
}

impl Bands {
    /// Of `count` unknowns, all 0.
    pub fn new(count: usize) -> Bands {
        Bands { rows: vec![[0.0; BAND]; count], rhs: vec![0.0; count] }
    }

    /// Adds `weight` times the square of Σ entries - value; columns of a row may repeat and lie less than
    /// [`BAND`] apart.
    pub fn add(&mut self, row: &[(usize, f64)], value: f64, weight: f64) {
        for &(i, a) in row {
            self.rhs[i] += weight * a * value;
            for &(j, b) in row {
                if j >= i {
                    self.rows[i][j - i] += weight * a * b;
                }
            }
        }
    }

    /// Makes the right-hand side 1 in row `i`, where nothing else was added to it.
    pub fn load(&mut self, i: usize) {
        self.rhs[i] = 1.0;
    }

    /// Largest entry of the diagonal.
    pub fn scale(&self) -> f64 {
        self.rows.iter().fold(0.0, |m: f64, row| m.max(row[0]))
    }

    /// The unknowns, by Cholesky's method; `None` where a pivot is lost.
    pub fn solve(mut self) -> Option<Vec<f64>> {
        let n = self.rows.len();
        for i in 0..n {
            let pivot = self.rows[i][0];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            let row = self.rows[i];
            for k in 1..BAND.min(n - i) {
                let factor = row[k] / pivot;
                for m in k..BAND {
                    self.rows[i + k][m - k] -= factor * row[m];
                }
                self.rhs[i + k] -= factor * self.rhs[i];
            }
        }
        let mut x = vec![0.0; n];
        for i in (0..n).rev() {
            let known: f64 = (1..BAND.min(n - i)).map(|k| self.rows[i][k] * x[i + k]).sum();
            x[i] = (self.rhs[i] - known) / self.rows[i][0];
        }
        Some(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_equations_give_back_what_the_rows_were_made_of() {
        let truth = [1.0, -2.0, 0.5, 3.0, 4.0];
        let mut bands = Bands::new(5);
        for i in 0..5 {
            let row: Vec<(usize, f64)> = (i..5.min(i + 3)).map(|j| (j, 1.0 + (i * j) as f64)).collect();
            let value = row.iter().map(|(j, a)| a * truth[*j]).sum();
            bands.add(&row, value, 1.0 + i as f64);
        }
        for (x, y) in bands.solve().unwrap().iter().zip(truth) {
            assert!((x - y).abs() < 1e-9, "{x} {y}");
        }
        assert!(Bands::new(2).solve().is_none());
    }
}
