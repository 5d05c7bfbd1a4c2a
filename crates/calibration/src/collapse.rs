//! The representative strain of one slope: the ε_r for which K/σ_r against E*/σ_r is one curve for all
//! materials.
//!
//! The measure is the scatter: the root mean square of what a cubic in ln(E*/σ_r), fitted to all materials at
//! once, leaves of ln(K/σ_r). The second measure is the paper's, "the maximum of correlation": the share of
//! the variance of ln(K/σ_r) that the cubic explains. Where the crush is nearly elastic K hardly depends on
//! σ_r: the scatter is then the same for every ε_r, and says so.

use asperity_material::Hardening;
use asperity_numerics::least_squares::{powers, solve, value};

/// One material crushed at one slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The material, the same number for every slope.
    pub material: usize,
    /// Its hardening, E = 1.
    pub hardening: Hardening,
    /// K/E.
    pub k_over_e: f64,
    /// Relative 95 % bound of K.
    pub error: f64,
    /// a tan β/h.
    pub contact_ratio: f64,
}

/// Range of the trial strains, in units of tan β.
pub const SEARCHED: [f64; 2] = [0.005, 1.2];

/// Their number.
const TRIALS: usize = 72;

/// Least ratio of the largest to the least scatter over the trial strains for which there is a minimum at
/// all.
const CONTRAST: f64 = 1.2;

/// Scatter below this is rounding.
const ROUNDING_SCATTER: f64 = 1e-9;

/// The samples of a slope at every trial strain, ready for many weightings.
#[derive(Clone, Debug)]
pub struct Collapse {
    /// ln of the trial strains over tan β.
    trials: Vec<f64>,
    /// For every trial: powers of the scaled ln(E*/σ_r), and ln(K/σ_r), of every sample.
    points: Vec<Vec<([f64; 4], f64)>>,
    materials: Vec<usize>,
    errors: Vec<f64>,
}

/// Scatter and correlation at one trial strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// ε_r/tan β.
    pub share: f64,
    /// Root mean square deviation of ln(K/σ_r) from the common curve.
    pub scatter: f64,
    /// R² of the common curve.
    pub correlation: f64,
}

impl Collapse {
    /// Prepares the samples of the slope `tan_beta` for the reduced modulus `reduced_modulus` (E = 1).
    pub fn new(samples: &[Sample], tan_beta: f64, reduced_modulus: f64) -> Collapse {
        let ([low, high], last) = (SEARCHED, (TRIALS - 1) as f64);
        let trials: Vec<f64> = (0..TRIALS).map(|i| low.ln() + (high / low).ln() * i as f64 / last).collect();
        let points = trials.iter().map(|t| {
            let raw: Vec<(f64, f64)> = samples
                .iter()
                .map(|s| {
                    let stress = s.hardening.representative_stress(t.exp() * tan_beta);
                    ((reduced_modulus / stress).ln(), (s.k_over_e / stress).ln())
                })
                .collect();
            let (min, max) = raw.iter().fold((f64::MAX, f64::MIN), |(a, b), p| (a.min(p.0), b.max(p.0)));
            let scaled = |x: f64| if max > min { 2.0 * (x - min) / (max - min) - 1.0 } else { 0.0 };
            raw.iter().map(|&(x, y)| (powers(scaled(x)), y)).collect()
        });
        let points = points.collect();
        Collapse {
            trials,
            points,
            materials: samples.iter().map(|s| s.material).collect(),
            errors: samples.iter().map(|s| s.error).collect(),
        }
    }

    /// The measure at every trial strain with `draw(material)` for every sample: its weight, and by how many
    /// times its 95 % bound K is shifted.
    ///
    /// `None` if there are too few samples for a cubic.
    pub fn measures(&self, draw: impl Fn(usize) -> [f64; 2]) -> Option<Vec<Measure>> {
        let (weights, shifts): (Vec<f64>, Vec<f64>) = self
            .materials
            .iter()
            .zip(&self.errors)
            .map(|(&m, error)| {
                let [weight, shift] = draw(m);
                (weight, shift * error)
            })
            .unzip();
        let used = weights.iter().filter(|w| **w > 0.0).count();
        let total: f64 = weights.iter().sum();
        if used < 6 {
            return None;
        }
        let measure = |(trial, points): (&f64, &Vec<([f64; 4], f64)>)| {
            let rows: Vec<([f64; 4], f64, f64)> =
                points.iter().zip(&weights).zip(&shifts).map(|((&(b, y), &w), s)| (b, y + s, w)).collect();
            let mean = rows.iter().map(|(_, y, w)| w * y).sum::<f64>() / total;
            let variance = rows.iter().map(|(_, y, w)| w * (y - mean).powi(2)).sum::<f64>();
            let cubic = solve(&rows)?;
            let rest: f64 = rows.iter().map(|(b, y, w)| w * (y - value(&cubic, b)).powi(2)).sum();
            let free = total * (1.0 - 4.0 / used as f64);
            Some(Measure {
                share: trial.exp(),
                scatter: (rest / free).sqrt(),
                correlation: 1.0 - rest / variance.max(f64::MIN_POSITIVE),
            })
        };
        self.trials.iter().zip(&self.points).map(measure).collect()
    }
}

/// The trial strain at which `f` is least, refined by a parabola in ln ε; `None` at an end of the range.
fn least(measures: &[Measure], f: impl Fn(&Measure) -> f64) -> Option<f64> {
    let i = (0..measures.len()).min_by(|&i, &j| f(&measures[i]).total_cmp(&f(&measures[j])))?;
    if i == 0 || i + 1 >= measures.len() {
        return None;
    }
    let [a, b, c] = [i - 1, i, i + 1].map(|k| f(&measures[k]));
    let step = (measures[i + 1].share / measures[i].share).ln();
    let curvature = a - 2.0 * b + c;
    let shift = if curvature > 0.0 { 0.5 * (a - c) / curvature } else { 0.0 };
    Some(measures[i].share * (shift.clamp(-0.5, 0.5) * step).exp())
}

/// ε_r/tan β of least scatter; `None` where the scatter is flat or falls to an end of the range.
pub fn least_scatter(measures: &[Measure]) -> Option<f64> {
    let (min, max) =
        measures.iter().fold((f64::MAX, 0.0_f64), |(a, b), m| (a.min(m.scatter), b.max(m.scatter)));
    if max < ROUNDING_SCATTER || max < CONTRAST * min {
        return None;
    }
    least(measures, |m| m.scatter * m.scatter)
}

/// ε_r/tan β of largest correlation; `None` at an end of the range.
pub fn largest_correlation(measures: &[Measure]) -> Option<f64> {
    least(measures, |m| -m.correlation)
}

/// The scatter at the strain of least scatter.
pub fn scatter_left(measures: &[Measure]) -> f64 {
    measures.iter().map(|m| m.scatter).fold(f64::INFINITY, f64::min)
}

/// The values in ascending order, each once.
pub fn distinct(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}
