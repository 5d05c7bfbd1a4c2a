//! Where increments end: depths on the way to the peak, travels on the way back.

/// How loading is divided into increments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// Three equal increments to this share of the depth, then geometric ones: the error of an increment
    /// depends on the ratio of the depths at its ends, and below that share the work is too small to matter.
    Geometric {
        /// Where geometric increments begin, as a share of the peak.
        from: f64,
    },
    /// Longer equal increments to a share of the depth, then equal ones: the error of an equal increment is
    /// the same shift of the depth everywhere, which the slope of a curve does not notice.
    Equal {
        /// How many lead to `from`.
        lead: usize,
        /// The share of the peak to which they lead.
        from: f64,
    },
}

/// Depths at the ends of `steps` increments as shares of the peak, the last one 1.
pub fn loading(steps: usize, spacing: Spacing) -> Vec<f64> {
    let parts = |count: usize| (1..=count).map(move |i| i as f64 / count as f64);
    match spacing {
        Spacing::Geometric { .. } if steps < 8 => parts(steps).collect(),
        Spacing::Geometric { from } => {
            let uniform = 3;
            let geometric = steps - uniform;
            let first = (1..=uniform).map(|i| from * i as f64 / uniform as f64);
            let rest = (1..=geometric).map(|i| from.powf(1.0 - i as f64 / geometric as f64));
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

/// Travels at the ends of `steps` increments back from `peak`, each of which takes off the same force if F ∝
/// (1 - u/u₀)^1.25 with u₀ = `recovery`. The last one leaves `rest` steps of force.
pub fn unloading(peak: f64, recovery: f64, steps: usize, rest: f64) -> impl Iterator<Item = f64> {
    (1..=steps).map(move |i| {
        let share = 1.0 - i as f64 / (steps as f64 + rest);
        peak - recovery * (1.0 - share.powf(1.0 / UNLOADING_EXPONENT))
    })
}
