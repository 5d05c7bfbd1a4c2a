//! Ends of load steps: depths of loading, travels of unloading.

/// Division of loading into load steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// Three equal increments to this share of the depth, then geometric ones: the error of an increment
    /// depends on the ratio of the depths at its ends, and below that share the work is too small to matter.
    /// Up to 0.15 of the depth, below which no error is promised, they are three times as long in ln h as
    /// beyond it.
    Geometric {
        /// Beginning of the geometric increments, as a share of the peak.
        from: f64,
    },
    /// Longer equal increments to a share of the depth, then equal ones: the error of an equal increment is
    /// the same shift of the depth everywhere, which the slope of a curve does not notice.
    Equal {
        /// Number of those that lead to `from`.
        lead: usize,
        /// The share of the peak to which they lead.
        from: f64,
    },
}

/// Share of the depth up to which geometric increments are long. What they err there has faded before 0.2 of
/// the depth, from which on errors count.
const KNEE_DEPTH_SHARE: f64 = 0.15;

/// Length in ln h of a geometric increment below the knee over that of one beyond it.
const EARLY_STEP_RATIO: f64 = 3.0;

/// Depths at the ends of `steps` increments as shares of the peak, the last one 1.
pub fn loading(steps: usize, spacing: Spacing) -> Vec<f64> {
    let parts = |count: usize| (1..=count).map(move |i| i as f64 / count as f64);
    match spacing {
        Spacing::Geometric { .. } if steps < 8 => parts(steps).collect(),
        Spacing::Geometric { from } => {
            let uniform = 3;
            let geometric = steps - uniform;
            let first = (1..=uniform).map(|i| from * i as f64 / uniform as f64);
            // ln h from the last place up to the peak, below the knee counted in long increments
            let [early, late] = [(KNEE_DEPTH_SHARE / from).ln() / EARLY_STEP_RATIO, -KNEE_DEPTH_SHARE.ln()];
            let rest = (0..geometric).rev().map(|left| {
                let left = (early + late) * left as f64 / geometric as f64;
                let beyond = left - late;
                if beyond > 0.0 {
                    KNEE_DEPTH_SHARE * (-EARLY_STEP_RATIO * beyond).exp()
                } else {
                    (-left).exp()
                }
            });
            first.chain(rest).collect()
        }
        Spacing::Equal { lead, from } => {
            let rest = parts(steps.saturating_sub(lead)).map(|share| from + (1.0 - from) * share);
            parts(lead).map(|share| from * share).chain(rest).collect()
        }
    }
}

/// Ratio of the first slope of an unloading curve to the mean one: F ∝ (1 - u/u₀)^1.25, between a flat punch,
/// 1, and a cone, 2.
pub const UNLOADING_EXPONENT: f64 = 1.25;

/// Travels at the ends of `steps` increments back from `peak`, each of which removes the same force if
/// F ∝ (1 - u/u₀)^1.25 with u₀ = `recovery`. The last one leaves `rest` steps of force.
pub fn unloading(peak: f64, recovery: f64, steps: usize, rest: f64) -> impl Iterator<Item = f64> {
    (1..=steps).map(move |i| {
        let share = 1.0 - i as f64 / (steps as f64 + rest);
        peak - recovery * (1.0 - share.powf(1.0 / UNLOADING_EXPONENT))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_below_the_knee_are_three_times_as_long_and_the_last_one_is_the_peak() {
        let depths = loading(58, Spacing::Geometric { from: 0.05 });
        assert_eq!((depths.len(), depths[57]), (58, 1.0));
        assert!((depths[2] - 0.05).abs() < 1e-12 && depths.windows(2).all(|pair| pair[1] > pair[0]));
        let steps: Vec<[f64; 2]> =
            depths[2..].windows(2).map(|pair| [pair[0], (pair[1] / pair[0]).ln()]).collect();
        let late = steps[steps.len() - 1][1];
        for [from, length] in steps {
            let wanted = if from * (3.0 * late).exp() < KNEE_DEPTH_SHARE {
                3.0 * late
            } else if from >= KNEE_DEPTH_SHARE {
                late
            } else {
                continue; // over the knee
            };
            assert!((length / wanted - 1.0).abs() < 1e-9, "{length} at {from}, {wanted} wanted");
        }
    }
}
