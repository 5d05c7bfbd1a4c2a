//! Samples of the posterior: flat in the coordinates within their bounds, by the stretch moves of Goodman and
//! Weare (Comm. App. Math. Comp. Sci. 5 (2010) 65).

use crate::levenberg_marquardt::{Minimum, Residuals, chi2};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Walkers.
const WALKERS: usize = 40;
/// Rounds before samples are kept.
const BURN_IN_ROUNDS: usize = 150;
/// Rounds between kept samples.
const THINNING_ROUNDS: usize = 4;

fn uniform(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// About `count` samples around `minima`, the best one first; `deviations` spread the walkers at first.
pub fn samples(
    residuals: &Residuals<'_>,
    minima: &[Minimum],
    deviations: &[f64],
    bounds: &[[f64; 2]],
    count: usize,
    seed: u64,
) -> Vec<Vec<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let inside = |p: &[f64]| p.iter().zip(bounds).all(|(x, [low, high])| x >= low && x <= high);
    let mut walkers: Vec<(Vec<f64>, f64)> = Vec::new();
    for walker in minima.iter().cycle().take(WALKERS) {
        let spread: Vec<f64> = walker
            .point
            .iter()
            .zip(deviations)
            .zip(bounds)
            .map(|((x, d), [low, high])| {
                let step = (uniform(&mut random) - 0.5) * d.min(0.2 * (high - low));
                (x + step).clamp(*low + 1e-9 * (high - low), *high - 1e-9 * (high - low))
            })
            .collect();
        let chi2 = chi2(residuals, &spread);
        walkers.push((spread, chi2));
    }
    let rounds = BURN_IN_ROUNDS + THINNING_ROUNDS * count.div_ceil(WALKERS);
    let mut kept = Vec::new();
    for round in 0..rounds {
        for i in 0..WALKERS {
            // a partner of the other half
            let half = WALKERS / 2;
            let j = (if i < half { half } else { 0 }) + (uniform(&mut random) * half as f64) as usize;
            let stretch = (1.0 + uniform(&mut random)).powi(2) / 2.0;
            let partner = walkers[j].0.clone();
            let moved: Vec<f64> =
                walkers[i].0.iter().zip(&partner).map(|(x, p)| p + stretch * (x - p)).collect();
            let least = uniform(&mut random).ln();
            if !inside(&moved) {
                continue;
            }
            let next = chi2(residuals, &moved);
            let gain = (moved.len() as f64 - 1.0) * stretch.ln() + 0.5 * (walkers[i].1 - next);
            if next.is_finite() && (gain >= least || !walkers[i].1.is_finite()) {
                walkers[i] = (moved, next);
            }
        }
        if round >= BURN_IN_ROUNDS && (round - BURN_IN_ROUNDS).is_multiple_of(THINNING_ROUNDS) {
            kept.extend(walkers.iter().map(|w| w.0.clone()));
        }
    }
    kept.truncate(count);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_have_the_mean_and_spread_of_a_normal_law() {
        let residuals = |p: &[f64]| Some(vec![(p[0] - 1.0) / 0.2, (p[1] - p[0]) / 0.1]);
        let best = Minimum { point: vec![1.0, 1.0], chi2: 0.0 };
        let found = samples(&residuals, std::slice::from_ref(&best), &[0.2, 0.2], &[[-9.0, 9.0]; 2], 4000, 3);
        let mean = found.iter().map(|p| p[0]).sum::<f64>() / 4000.0;
        let spread = (found.iter().map(|p| (p[0] - mean).powi(2)).sum::<f64>() / 4000.0).sqrt();
        // 4000 samples of which each third or so is new: 4 % of the spread
        assert!((mean - 1.0).abs() < 0.03 && (spread / 0.2 - 1.0).abs() < 0.1, "{mean} {spread}");
        assert_eq!(
            found,
            samples(&residuals, std::slice::from_ref(&best), &[0.2, 0.2], &[[-9.0, 9.0]; 2], 4000, 3)
        );
    }
}
