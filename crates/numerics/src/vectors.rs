//! Products of vectors of unknowns.

/// Partial sums of a product: one after the other a processor would wait for each.
const SUMS: usize = 8;

/// a · b, summed in the same order on every processor.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; SUMS];
    let (tiles, others) = (a.chunks_exact(SUMS), b.chunks_exact(SUMS));
    let rest: f64 = tiles.remainder().iter().zip(others.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in tiles.zip(others) {
        for i in 0..SUMS {
            sums[i] += a[i] * b[i];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// Adds `factor` times `what` to `to`.
pub(crate) fn add(to: &mut [f64], factor: f64, what: &[f64]) {
    to.iter_mut().zip(what).for_each(|(to, what)| *to += factor * what);
}

/// √(a · a).
pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_counts_once_whatever_the_length() {
        for length in [0, 1, 7, 8, 9, 31] {
            let a: Vec<f64> = (1..=length).map(f64::from).collect();
            let squares = f64::from(length * (length + 1) * (2 * length + 1)) / 6.0;
            assert_eq!(dot(&a, &a), squares);
            assert_eq!(norm(&a), squares.sqrt());
        }
    }
}
