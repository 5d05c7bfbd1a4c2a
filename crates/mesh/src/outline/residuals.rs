//! True where what a smooth curve leaves of its points is scatter: their means over stretches of every length
//! are as small as those of independent errors (the multiresolution criterion of Davies and Kovac, Annals of
//! Statistics 29 (2001) 1).

/// Standard errors within which the mean of a long stretch may lie, and that of one or two points, of which
/// there are more.
const MAX_STANDARD_ERRORS: [f64; 2] = [3.5, 4.5];

/// Stretches (first and last point) whose mean is too far from 0 for scatter of the standard deviation
/// `scatter`.
pub fn stretches_too_far(residuals: &[f64], scatter: f64) -> Vec<[usize; 2]> {
    let mut sums = vec![0.0];
    for r in residuals {
        sums.push(sums[sums.len() - 1] + r);
    }
    let (n, mut length, mut found) = (residuals.len(), 1, Vec::new());
    while length <= n {
        let limit = MAX_STANDARD_ERRORS[usize::from(length <= 2)] * scatter * (length as f64).sqrt();
        for start in (0..=n - length).step_by((length / 2).max(1)) {
            if (sums[start + length] - sums[start]).abs() > limit {
                found.push([start, start + length - 1]);
            }
        }
        length *= 2;
    }
    found
}

/// Standard deviation of the scatter of points about a smooth curve: from what a parabola through three
/// points misses of the fourth, in the median, so that kinks and outliers do not count.
pub fn scatter(points: &[[f64; 2]]) -> f64 {
    let miss = |p: &[[f64; 2]]| {
        let weight = |i: usize| {
            let others = (0..4).filter(|&j| j != i);
            others.map(|j| p[i][0] - p[j][0]).product::<f64>().recip()
        };
        let weights = [0, 1, 2, 3].map(weight);
        let norm = weights.iter().map(|w| w * w).sum::<f64>().sqrt();
        (weights.iter().zip(p).map(|(w, p)| w * p[1]).sum::<f64>() / norm).abs()
    };
    let mut misses: Vec<f64> = points.windows(4).map(miss).filter(|m| m.is_finite()).collect();
    if misses.len() < 5 {
        return 0.0;
    }
    misses.sort_by(f64::total_cmp);
    // the median of |N(0, 1)|
    misses[misses.len() / 2] / 0.6745
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent errors of standard deviation 1, nearly normal.
    pub fn errors(count: usize) -> Vec<f64> {
        let mut state = 11_u64;
        let mut next = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..count).map(|_| (0..12).map(|_| next()).sum::<f64>() - 6.0).collect()
    }

    #[test]
    fn scatter_is_told_from_shape() {
        let errors = errors(2000);
        assert_eq!(stretches_too_far(&errors, 1.0), [[0; 2]; 0]);
        let bumped: Vec<f64> = errors
            .iter()
            .enumerate()
            .map(|(i, e)| e + if (500..600).contains(&i) { 0.8 } else { 0.0 })
            .collect();
        let found = stretches_too_far(&bumped, 1.0);
        assert!(!found.is_empty() && found.iter().all(|s| s[1] > 450 && s[0] < 650), "{found:?}");
        let points: Vec<[f64; 2]> = errors
            .iter()
            .enumerate()
            .map(|(i, e)| (1e-2 * i as f64, e))
            .map(|(x, e)| [x, 20.0 * (0.5 * x).sin() + 0.1 * e])
            .collect();
        assert!((scatter(&points) / 0.1 - 1.0).abs() < 0.06, "{}", scatter(&points));
    }
}
