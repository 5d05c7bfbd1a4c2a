//! Words of a factor or of a step of the heights: nothing tells whether they are multiplied by it already.

use super::measured::{ReadError, Request};
use super::remark::Remark;
use crate::dimension::Dimension;
use crate::text::{TextError, folded, uncommented};

/// A factor of the heights whose meaning is not known.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Factor {
    said: String,
    line: usize,
    /// True where it can be nothing else than a factor; a step may be that of whole numbers alone.
    is_factor: bool,
}

/// Names of a factor.
const FACTORS: [&str; 7] =
    ["scale", "factor", "faktor", "multiplier", "scaling", "calibration", "kalibrierung"];
/// Names of a step.
const STEPS: [&str; 5] = ["lsb", "resolution", "increment", "pitch", "auflosung"];
/// Words of what a whole number is worth, of heights unless of something else.
const WORTHS: [&str; 15] = [
    "gain",
    "sensitivity",
    "empfindlichkeit",
    "sensibilite",
    "factor",
    "faktor",
    "skalierungsfaktor",
    "facteur",
    "multiplier",
    "calibration",
    "kalibrierung",
    "digit",
    "zstep",
    "dz",
    "hohenauflosung",
];
/// Words of factors that are none of the heights.
const OTHERS: [&str; 8] = ["x", "y", "xy", "lateral", "pixel", "zoom", "magnification", "camera"];
/// Names of the heights.
const HEIGHTS: [&str; 12] = [
    "z", "digital", "data", "height", "heights", "hohe", "hohen", "wert", "werte", "value", "values",
    "vertical",
];
/// Names of a whole number.
const COUNTS: [&str; 9] = ["count", "counts", "digit", "digits", "lsb", "bit", "level", "code", "inkrement"];
/// Words that say what is to be done.
const ORDERS: [&str; 6] = ["multiply", "multiplied", "divide", "divided", "multiplizieren", "scaled"];

impl Factor {
    /// The factor of a title with a number: `Heights in 0.1 um`.
    pub fn of_title(line: usize, text: &str) -> Factor {
        Factor { said: text.trim().to_string(), line, is_factor: true }
    }

    /// The factor of a key and its value, which begins with `number`; `rest` stands behind it.
    pub fn of_key(remark: &Remark, number: f64, rest: &str) -> Option<Factor> {
        let key = remark.key.as_str();
        let has = |names: &[&str]| key.split(' ').any(|word| names.contains(&word));
        let is_unit = key == "unit" && number != 1.0 && Dimension::Length.scale(rest.trim()).is_some();
        // 1 nm/LSB may be another unit than is named; a step height is a result, a scale of 10 um a bar
        let is_step = key.ends_with(" step");
        let is_other_than_one = number != 1.0 || rest.contains('/') || is_step;
        let is_one = (has(&FACTORS) || has(&STEPS) || is_step) && has(&HEIGHTS) && is_other_than_one
            || ["bit2nm", "lsb"].contains(&key) && number != 1.0
            || ["scale", "scaling"].contains(&key) && number != 1.0 && rest.trim().is_empty()
            || has(&WORTHS) && !has(&OTHERS) && number != 1.0;
        // with a unit it may be a range or a step of the digits
        let is_factor = is_unit || has(&FACTORS) && has(&HEIGHTS) && rest.trim().is_empty();
        let said = format!("{key} = {}", remark.value);
        (is_one || is_unit).then_some(Factor { said, line: remark.line, is_factor })
    }

    /// The factor of a sentence: `Values x 0.5 nm`, `multiply by 0.5`, `0.5 nm per count`.
    pub fn of_sentence(line: usize, text: &str) -> Option<Factor> {
        let spaced = uncommented(text).replace('*', " * ").replace('×', " × ").replace('/', " per ");
        let number = |word: &str| word.replace(',', ".").parse::<f64>().ok().filter(|v| *v != 1.0);
        let words: Vec<(String, Option<f64>)> = spaced
            .split([' ', '\t', ':', '=', ';', '(', ')', '[', ']'])
            .filter(|word| !word.is_empty())
            .map(|word| (folded(word), number(word)))
            .collect();
        let among = |names: &[&str], word: &(String, _)| names.contains(&word.0.as_str());
        // the letter x parts whole numbers of points, too
        let is_times = |three: &[(String, Option<f64>)]| {
            let (sign, value) = (&three[1], three[2].1);
            let is_sign =
                among(&["*", "×"], sign) || sign.0 == "x" && value.is_some_and(|v| v.fract() != 0.0);
            among(&HEIGHTS, &three[0]) && is_sign && value.is_some()
        };
        let is_worth = |two: &[(String, Option<f64>)]| {
            let is_count = |word| among(&COUNTS, word);
            two[0].0 == "per" && is_count(&two[1]) || two[1].0 == "per" && is_count(&two[0])
        };
        let is_of_heights = || !words.iter().any(|word| among(&OTHERS, word));
        let has_number = || words.iter().any(|word| word.1.is_some());
        let is_order = || words.windows(3).any(|w| among(&ORDERS, &w[0]) && w[2].1.is_some());
        let is_factor = words.windows(3).any(is_times) || is_order() && is_of_heights();
        let is_step = || words.windows(2).any(is_worth) && has_number() && is_of_heights();
        let said = uncommented(text).trim().to_string();
        (is_factor || is_step()).then_some(Factor { said, line, is_factor })
    }

    /// Refuses heights beside a factor, and whole numbers beside a step.
    ///
    /// # Errors
    /// Such a factor.
    pub fn refuse(&self, heights: &[f64], request: &Request<'_>) -> Result<(), ReadError> {
        let is_whole = heights.iter().all(|z| !z.is_finite() || z.fract() == 0.0);
        if request.override_file || !self.is_factor && !is_whole {
            return Ok(());
        }
        let beside = if is_whole { " beside heights that are whole numbers" } else { "" };
        let problem = format!(
            "says \"{}\"{beside}, and not whether the heights are to be multiplied by it: export them in a unit of length, or \
             multiply them and delete this line, or set override = true if they are in their unit already",
            self.said
        );
        Err(TextError::new(self.line, problem).into())
    }
}
