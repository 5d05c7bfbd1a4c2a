//! The verdict on a quantity: whether finer waves still change it.
//!
//! Let t = ln h' be the logarithm of the rms slope that is let in, and y that of the quantity. Over the
//! finest octaves y changes by e = Δy/Δt of the slope's change: e keeps its value where the quantity follows
//! the slope for ever (the elastic area, e = -1) and falls from octave to octave where longer waves decide.
//! The spectrum says between which bounds t goes on below the pixel, and Σ e ρ^k Δt_k is what is still to
//! come, ρ being the fall of e by an octave.

use super::numbers::Step;
use super::slope_power::Growth;

/// The change by two finer octaves that a quantity may have which counts as converged, and where the spectrum
/// has ended.
const CONVERGED: f64 = 0.15;
const CONVERGED_AT_END: f64 = 0.2;
/// Fall of e by an octave from which on it counts as steady.
const STEADY: f64 = 0.7;
/// Times that what is to come may be off, and that e may fall by.
const DOUBT: f64 = 1.5;
const LEAST_FALL: f64 = 0.5;
/// Share of the change by the finest octave that may come once more, and of it that may go back: waves of two
/// to four pixels are seen by half.
const HALF_SEEN: f64 = 0.5;
const BACK: f64 = 0.25;
/// Error by the pixels beyond which a map says nothing of a quantity.
const LARGEST_ERROR: f64 = 0.5;
/// Octaves from the pixel up that a verdict is made of.
const OCTAVES: usize = 3;
/// Values within this share of the last count as that from which on the quantity has converged.
pub(super) const FROM: f64 = 0.05;

/// The class of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Two finer octaves change it by its error at most.
    Converged,
    /// It changes still, by less with every octave.
    Converging,
    /// It changes by the same factor with every octave.
    NotConverging,
    /// The map holds too few waves to say, or too few of the longest that decide it, or its pixels leave half
    /// of the value open.
    MapTooSmall,
}

impl Class {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Class::Converged => "converged",
            Class::Converging => "converging",
            Class::NotConverging => "not converging",
            Class::MapTooSmall => "map too small",
        }
    }
}

/// The effect of finer waves on a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Its class.
    pub class: Class,
    /// The coarsest cut-off (m) from which on every value lies within 5 % of the last, or within the error
    /// where that is more; None where only the whole map does.
    pub from: Option<f64>,
    /// Relative bound of what two finer octaves change of the last value, or of the extrapolated one where it
    /// is converging; None where it is not, or where nothing is known.
    pub error: Option<f64>,
    /// The values between which two finer octaves leave it; None where nothing is known.
    pub range: Option<[f64; 2]>,
    /// log2 of the factor by which an octave of finer waves changes it, of the last octave or of the next.
    pub exponent: Option<f64>,
    /// The value on the whole map.
    pub value: f64,
    /// The value that two finer octaves are expected to give.
    pub extrapolated: Option<f64>,
}

/// The shortest waves of the scales and their slopes, from the finest octaves up.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Octaves {
    /// Places of the whole map and of the scales one, two and three octaves coarser.
    places: Option<[usize; OCTAVES + 1]>,
    /// ln of the rms slope of all scales.
    slopes: Vec<f64>,
    cutoffs: Vec<f64>,
    growth: Growth,
}

/// A quantity by scale.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Series {
    /// Its values from the coarsest cut-off to the whole map; none where it has none.
    pub values: Vec<Option<f64>>,
    /// Their relative errors by the pixels.
    pub error: f64,
    /// True where the longest waves decide it, so that a map shorter than its roll-off says little.
    pub of_long_waves: bool,
    /// The values that it lies between whatever waves there are.
    pub range: [f64; 2],
}

impl Octaves {
    /// Of `steps` from the coarsest to the whole map, whose slopes go on by `growth`.
    pub(super) fn new(steps: &[Step], growth: Growth) -> Octaves {
        let finest = steps.last().map_or(f64::NAN, |step| step.wave);
        let octave = |k: usize| {
            let wave = finest * 2f64.powf(k as f64);
            steps.iter().position(|step| (step.wave / wave - 1.0).abs() < 1e-6)
        };
        let places = (0..=OCTAVES).map(octave).collect::<Option<Vec<_>>>();
        Octaves {
            places: places.and_then(|places| places.try_into().ok()),
            slopes: steps.iter().map(|step| step.slopes.rms.ln()).collect(),
            cutoffs: steps.iter().map(|step| step.cutoff).collect(),
            growth,
        }
    }

    /// The verdict on `series`; None of one without a value on the whole map. `has_rolloff` says that the
    /// map is longer than its roll-off.
    pub(super) fn verdict(&self, series: &Series, has_rolloff: bool) -> Option<Verdict> {
        let value = series.values.last().copied().flatten().filter(|value| *value > 0.0)?;
        let known = |place: usize| series.values[place].filter(|v| *v > 0.0).map(f64::ln);
        let few = Verdict {
            class: Class::MapTooSmall,
            from: None,
            error: None,
            range: None,
            exponent: None,
            value,
            extrapolated: None,
        };
        let Some(y) = self.places.and_then(|places| {
            let found = places.iter().map(|place| known(*place)).collect::<Option<Vec<_>>>()?;
            Some([0, 1, 2].map(|k| found[k] - found[k + 1]))
        }) else {
            return Some(few);
        };
        let places = self.places?;
        let t = [0, 1, 2].map(|k| self.slopes[places[k]] - self.slopes[places[k + 1]]);
        let steps = Steps { y, t, noise: series.error };
        let mut found = self.judge(value, &steps, series);
        found.from = self.from(series, value, found.error.unwrap_or(0.0).max(FROM));
        if series.of_long_waves && !has_rolloff || series.error > LARGEST_ERROR {
            found = Verdict { exponent: found.exponent, ..few };
        }
        Some(found)
    }

    fn judge(&self, value: f64, steps: &Steps, series: &Series) -> Verdict {
        let (fall, noise, goes_on) = (steps.fall(), series.error, self.growth.goes_on());
        let come = |times: f64, fall: f64, growth: [f64; 2]| {
            times * (1..).zip(growth).map(|(k, growth)| steps.follows() * fall.powi(k) * growth).sum::<f64>()
        };
        let [least, most] = series.range.map(|end| (end / value).ln());
        let possible = |change: f64| change.max(least.min(0.0)).min(most.max(0.0));
        let expected = come(1.0, fall, self.growth.expected);
        // finer waves without end change what no longer ones decide, and no limit
        let steady = goes_on && fall >= STEADY && !series.of_long_waves;
        let steady = steady && expected > least && expected < most;
        let expected = possible(expected);
        let ends = [
            come(1.0, LEAST_FALL * fall, self.growth.least),
            come(DOUBT, fall.max(steps.steepest_fall()).min(1.0), self.growth.most),
            expected,
        ];
        let (more, back) = (HALF_SEEN * steps.y[0], -BACK * HALF_SEEN * steps.y[0]);
        let low = possible(ends.into_iter().fold(f64::INFINITY, f64::min) + more.min(back));
        let high = possible(ends.into_iter().fold(f64::NEG_INFINITY, f64::max) + more.max(back));
        // points that were picked hold the heights of finer waves already
        let [low, high] = if series.of_long_waves { [low.min(0.0), high.max(0.0)] } else { [low, high] };
        let bound = high.max(-low).exp_m1();
        let [low, high] = [low - noise.ln_1p(), high + noise.ln_1p()];
        let found = Verdict {
            class: Class::Converged,
            from: None,
            error: Some(bound.hypot(noise)),
            range: Some([low, high].map(|change| value * change.exp())),
            exponent: Some(
                possible(steps.follows() * fall * self.growth.expected[0]) / std::f64::consts::LN_2,
            ),
            value,
            extrapolated: Some(value * expected.exp()),
        };
        if bound <= if goes_on { CONVERGED } else { CONVERGED_AT_END } {
            found
        } else if steady && expected.abs() > CONVERGED {
            Verdict { class: Class::NotConverging, error: None, ..found }
        } else {
            let left = (high - expected).exp_m1().max(-(low - expected).exp_m1());
            Verdict { class: Class::Converging, error: Some(left), ..found }
        }
    }

    /// The coarsest cut-off from which on all values lie within `share` of the last.
    fn from(&self, series: &Series, last: f64, share: f64) -> Option<f64> {
        let near = |value: &Option<f64>| value.is_some_and(|v| (v / last - 1.0).abs() <= share);
        let count = series.values.iter().rev().take_while(|value| near(value)).count();
        let place = series.values.len() - count;
        (count > 1).then(|| self.cutoffs[place])
    }
}

/// Changes of a quantity and of the slope over the finest octaves, the finest first.
struct Steps {
    y: [f64; 3],
    t: [f64; 3],
    noise: f64,
}

impl Steps {
    /// e of the finest octave, of two where the slope hardly grows.
    fn follows(&self) -> f64 {
        self.y[0] / self.t[0].max(1e-3)
    }

    /// Fall of e by an octave: that of two octaves to the two before, as single ones scatter.
    fn fall(&self) -> f64 {
        let part = |k: usize| self.y[k].abs() / self.t[k].max(1e-3);
        let (near, far) = (part(0) + part(1), part(1) + part(2));
        if far > 0.0 { (near / far).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The least favourable fall of single octaves, as far as it is more than noise.
    fn steepest_fall(&self) -> f64 {
        let part = |k: usize| self.y[k].abs() / self.t[k].max(1e-3);
        if self.y[1].abs() <= 2.0 * self.noise || part(1) == 0.0 { 0.0 } else { part(0) / part(1) }
    }
}
