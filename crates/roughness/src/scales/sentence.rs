//! The verdicts together: the cut-off to use, and a sentence that a person can quote.

use super::follow::Scales;
use super::numbers::{By, Numbers};
use super::quantities::Quantity;
use super::verdict::{Class, FROM, Verdict};
use asperity_material::units::rounded;

/// The mean pressure of the limited half-space from this share of the limit on counts as ended by it.
const ENDED: f64 = 0.95;
/// Digits of a number in the sentence, and of a percentage.
const DIGITS: usize = 3;
const DIGITS_OF_SHARES: usize = 2;
/// Numbers below it are written with a power of ten.
const TINY: f64 = 1e-3;

/// Quantities of the sentence in words, with the unit in SI; of metal whose limit is known only the areas are
/// those of both half-spaces.
const WORDS: [(&str, Quantity, bool, f64); 6] = [
    ("the elastic contact area", Quantity::Area, false, 1.0),
    ("the contact area of this metal", Quantity::Area, true, 1.0),
    ("the 99th percentile of the contact pressure", Quantity::HighPressure, true, 1e6),
    ("the mean gap", Quantity::MeanGap, true, 1e-6),
    ("the leak along x", Quantity::LeakX, true, 1.0),
    ("the leak along y", Quantity::LeakY, true, 1.0),
];

fn micrometres(length: f64) -> f64 {
    rounded(length * 1e6, DIGITS)
}

/// A number to three digits; tiny ones, as leaks are, with their power of ten.
fn number(value: f64) -> String {
    let value = rounded(value, DIGITS);
    if value.abs() < TINY { format!("{value:e}") } else { value.to_string() }
}

fn percent(share: f64) -> f64 {
    rounded(100.0 * share, DIGITS_OF_SHARES)
}

impl Scales {
    /// The cut-off of the whole map, in metres.
    fn whole(&self) -> f64 {
        self.steps.last().map_or(f64::NAN, |step| step.cutoff)
    }

    /// The coarsest cut-off (m) from which on all that has converged holds: that which the program would use.
    pub fn cutoff(&self) -> f64 {
        let converged = self.verdicts.iter().map(|judged| judged.verdict);
        let from = converged.filter(|v| v.class == Class::Converged).map(|v| v.from.unwrap_or(self.whole()));
        from.reduce(f64::min).unwrap_or(self.whole())
    }

    /// The coarsest cut-off (m) at which the mean pressure is that of the limit; None where hardness does not
    /// end its growth.
    pub fn hardness_ends(&self) -> Option<f64> {
        let ended = |found: &Numbers| {
            found.corrected_pressure().zip(found.limit).is_some_and(|(p, limit)| p >= ENDED * limit)
        };
        self.contacts(By::Limited).find(|(_, found)| ended(found)).map(|(step, _)| step.cutoff)
    }

    /// The verdicts in words.
    pub fn sentence(&self) -> String {
        let (mut parts, mut small) = (Vec::new(), Vec::new());
        for (words, quantity, limited, unit) in WORDS {
            let of =
                |limited: bool| self.verdicts.iter().find(|j| j.quantity == quantity && j.limited == limited);
            let elastic = || of(false).filter(|_| quantity != Quantity::Area);
            let Some(judged) = of(limited).or_else(elastic) else { continue };
            match self.clause(words, &judged.verdict, unit) {
                Some(clause) => parts.push(clause),
                None => small.push(words),
            }
        }
        if !small.is_empty() {
            parts.push(format!("the map is too small for {}", small.join(", ")));
        }
        if let Some(ended) = self.hardness_ends() {
            parts.push(format!("from {} um on the hardness limits the pressure", micrometres(ended)));
        }
        let grows = if self.growth.goes_on() { "goes on below" } else { "ends above" };
        format!(
            "{} MPa: {}. The spectrum {grows} the pixel. Cut-off to use: {} um.",
            rounded(self.pressure * 1e-6, DIGITS),
            parts.join("; "),
            micrometres(self.cutoff())
        )
    }

    /// Remarks on a measurement that is to be trusted above the cut-off `trusted` (m) alone, and on the load.
    pub fn warnings(&self, trusted: Option<f64>) -> Vec<String> {
        let instrument = trusted.filter(|trusted| *trusted > self.cutoff()).map(|trusted| {
            format!(
                "below {} um the measurement itself is not to be trusted (tip or noise): what finer waves say is of the instrument",
                micrometres(trusted)
            )
        });
        let text = "the nominal pressure is beyond the limit of pressure of some scales, which have no row of the limited half-space";
        instrument.into_iter().chain(self.overloaded.then(|| text.into())).collect()
    }

    /// A verdict in words; None of a map that is too small.
    fn clause(&self, words: &str, found: &Verdict, unit: f64) -> Option<String> {
        let error = percent(found.error.unwrap_or(f64::NAN));
        match found.class {
            Class::MapTooSmall => None,
            Class::Converged => {
                let from = micrometres(found.from.unwrap_or(self.whole()));
                let within = percent(found.error.unwrap_or(0.0).max(FROM));
                Some(format!(
                    "{words} is decided by waves longer than {from} um (to {within} %; all waves give it to {error} %)"
                ))
            }
            Class::Converging => {
                let now = number(found.value / unit);
                let [low, high] = found.range?.map(|value| number(value / unit));
                Some(format!(
                    "{words} still changes, from {now} to between {low} and {high} with two finer octaves"
                ))
            }
            Class::NotConverging => {
                let octave = |end: f64| (end / found.value).sqrt() - 1.0;
                let mut changes = found.range?.map(octave);
                changes.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
                let falls = changes[1] < 0.0;
                // what may be of the other sign is none
                let least = if (changes[0] < 0.0) == falls { changes[0].abs() } else { 0.0 };
                let [least, most] = [least, changes[1].abs()].map(percent);
                let way = if falls { "falls" } else { "grows" };
                Some(format!("{words} {way} by {least} to {most} % with each finer octave"))
            }
        }
    }
}
