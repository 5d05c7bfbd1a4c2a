//! Secant pairs that correct an older factorisation: limited-memory BFGS with the factors as the first
//! matrix.
//!
//! After a step s the residual changed by y ≈ K s, whatever the tangent does in between (yielding, new
//! contact). The two loops of Nocedal & Wright (Numerical Optimization, 2nd ed., algorithm 7.4) give the
//! direction of the tangent that satisfies the last pairs; Matthies & Strang (1979) brought it to finite
//! elements. A pair costs four products of vectors, where new factors cost an assembly and a factorisation.

use crate::vectors::{add, dot};

/// Pairs kept: older ones tell of another tangent.
const PAIRS: usize = 6;

/// A pair whose curvature is below this share of |s||y| says nothing, or that the potential bends down.
const LEAST_CURVATURE: f64 = 1e-8;

/// The last steps and what the residual did in them. The arrays are allocated once.
#[derive(Clone, Debug, Default)]
pub struct Secants {
    /// Steps s and changes y of the residual, oldest first.
    pairs: Vec<(Vec<f64>, Vec<f64>)>,
    /// 1/(s·y) of each pair.
    inverse_curvature: Vec<f64>,
    /// Pairs that count.
    count: usize,
}

impl Secants {
    /// Forgets all pairs.
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Notes that the step `fraction` · `direction` changed the residual from `before` to `after`.
    pub fn note(&mut self, fraction: f64, direction: &[f64], before: &[f64], after: &[f64]) {
        if self.count == PAIRS {
            self.pairs.rotate_left(1);
            self.inverse_curvature.rotate_left(1);
            self.count -= 1;
        }
        if self.pairs.len() == self.count {
            self.pairs.push((vec![0.0; direction.len()], vec![0.0; direction.len()]));
            self.inverse_curvature.push(0.0);
        }
        let (s, y) = &mut self.pairs[self.count];
        s.iter_mut().zip(direction).for_each(|(s, d)| *s = fraction * d);
        y.iter_mut().zip(after).zip(before).for_each(|((y, a), b)| *y = a - b);
        let curvature = dot(s, y);
        if curvature > LEAST_CURVATURE * (dot(s, s) * dot(y, y)).sqrt() {
            self.inverse_curvature[self.count] = 1.0 / curvature;
            self.count += 1;
        }
    }

    /// Replaces the right-hand side `rhs` by the solution; `solve` does so with the factors alone.
    pub fn solve(&self, rhs: &mut [f64], solve: impl FnOnce(&mut [f64])) {
        let mut shares = [0.0; PAIRS];
        for (i, (s, y)) in self.pairs[..self.count].iter().enumerate().rev() {
            shares[i] = self.inverse_curvature[i] * dot(s, rhs);
            add(rhs, -shares[i], y);
        }
        solve(rhs);
        for (i, (s, y)) in self.pairs[..self.count].iter().enumerate() {
            let share = self.inverse_curvature[i] * dot(y, rhs);
            add(rhs, shares[i] - share, s);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Any first matrix: with the pairs of a quadratic potential the last one is met exactly, and in two
    /// dimensions two conjugate steps give its inverse.
    #[test]
    fn the_last_pair_is_met() {
        let k = [[4.0, 1.0], [1.0, 3.0]];
        let times = |s: &[f64]| vec![k[0][0] * s[0] + k[0][1] * s[1], k[1][0] * s[0] + k[1][1] * s[1]];
        let mut secants = Secants::default();
        for step in [[1.0, 0.0], [-0.25, 1.0]] {
            let y = times(&step);
            secants.note(0.5, &step, &[0.0; 2], &y.iter().map(|y| 0.5 * y).collect::<Vec<_>>());
            let mut solution = y;
            secants.solve(&mut solution, |rhs| rhs.iter_mut().for_each(|r| *r *= 0.1));
            assert!((solution[0] - step[0]).abs() < 1e-14 && (solution[1] - step[1]).abs() < 1e-14);
        }
        // both pairs: the inverse, as the steps are conjugate
        let mut solution = times(&[0.3, -0.7]);
        secants.solve(&mut solution, |rhs| rhs.iter_mut().for_each(|r| *r *= 0.1));
        assert!((solution[0] - 0.3).abs() < 1e-14 && (solution[1] + 0.7).abs() < 1e-14);
    }

    #[test]
    fn a_pair_that_bends_down_is_left_out() {
        let mut secants = Secants::default();
        for _ in 0..10 {
            secants.note(1.0, &[1.0], &[0.0], &[-1.0]);
            secants.note(1.0, &[1.0], &[0.0], &[2.0]);
        }
        assert!(secants.pairs.len() <= PAIRS && secants.count <= PAIRS);
        let mut solution = [4.0];
        secants.solve(&mut solution, |_| ());
        assert!((solution[0] - 2.0).abs() < 1e-15);
    }
}
