//! A key of a scene and the values that it takes: a list, or a range that is cut into steps or drawn from.

use crate::error::InputError;
use asperity_material::units::{Force, Length, Stress, rounded};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A key of a scene with its values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vary {
    /// The key, such as `loading.depth` or `asperity[0].slope_deg`.
    pub key: String,
    /// Its values.
    pub values: Values,
}

/// Values of a key, as the scene writes them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Values {
    /// One after the other.
    List(Vec<String>),
    /// From one end to the other.
    Range(Range),
}

/// Numbers of one unit between two ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// The two ends.
    pub ends: [f64; 2],
    /// Their unit, empty for a pure number.
    pub unit: String,
    /// The number of values, both ends among them; none where they are drawn.
    pub count: Option<usize>,
    /// True where steps are equal in the logarithm.
    pub logarithmic: bool,
}

/// The forms that values may take, for messages.
const FORMS: &str = "write KEY=V1,V2,… or KEY=A..B/N, for example \"loading.depth=1 um..5 um/5\"; \"log\" behind N makes the steps of a \
    range equal in the logarithm, and with --sample a range has no N";

impl Vary {
    /// Reads `KEY=V1,V2,…`, `KEY=A..B/N`, `KEY=A..B` or, with steps equal in the logarithm, `KEY=A..B/N log`.
    ///
    /// # Errors
    /// A text of another form, naming the key where there is one.
    ///
    /// # Examples
    /// ```
    /// use asperity::study::Vary;
    ///
    /// let depth = Vary::parse("loading.depth=1 um..2 um/3")?;
    /// assert_eq!((depth.count(), depth.level(1)), (Some(3), "1.5 um".to_string()));
    /// # Ok::<(), asperity::InputError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Vary, InputError> {
        let form = || InputError::new(format!("`{text}` varies nothing")).help(FORMS);
        let (key, values) = text.split_once('=').ok_or_else(form)?;
        let key = key.trim();
        if key.is_empty() {
            return Err(form());
        }
        Vary::of_text(key, values)
    }

    /// The values of a study file or of a program: a text as in [`Vary::parse`], a number, or a list.
    ///
    /// # Errors
    /// Values of another kind, naming the key.
    pub fn new(key: &str, values: &Value) -> Result<Vary, InputError> {
        match values {
            Value::String(text) => Vary::of_text(key, text),
            Value::Array(list) => Vary::of_list(key, list.iter().map(text_of).collect()),
            Value::Number(_) | Value::Bool(_) => Vary::of_list(key, vec![text_of(values)]),
            _ => Err(wrong(key, "is no list of values")),
        }
    }

    fn of_text(key: &str, text: &str) -> Result<Vary, InputError> {
        match Range::parse(text) {
            Some(Ok(range)) => Ok(Vary { key: key.into(), values: Values::Range(range) }),
            Some(Err(message)) => Err(wrong(key, &message)),
            None => Vary::of_list(key, split(text)),
        }
    }

    fn of_list(key: &str, values: Vec<String>) -> Result<Vary, InputError> {
        if values.iter().all(String::is_empty) {
            return Err(wrong(key, "no values are given"));
        }
        for (i, value) in values.iter().enumerate() {
            if value.is_empty() {
                return Err(wrong(key, "a value between two commas is missing"));
            }
            if values[..i].contains(value) {
                return Err(wrong(key, &format!("{value} is given twice")));
            }
        }
        Ok(Vary { key: key.into(), values: Values::List(values) })
    }

    /// The number of values; `None` of a range without a number of steps.
    pub fn count(&self) -> Option<usize> {
        match &self.values {
            Values::List(values) => Some(values.len()),
            Values::Range(range) => range.count,
        }
    }

    /// Value `i`, from 0 and below the number of values. No list is made of a range, which may be long.
    pub fn level(&self, i: usize) -> String {
        match &self.values {
            Values::List(values) => values[i].clone(),
            Values::Range(range) => {
                let last = range.count.map_or(1, |count| count - 1);
                range.value_at(i as f64 / last as f64)
            }
        }
    }

    /// The value at `share` (0 to 1) of the way through the values.
    pub(super) fn value_at(&self, share: f64) -> String {
        match &self.values {
            Values::Range(range) => range.value_at(share),
            Values::List(values) => {
                values[((share * values.len() as f64) as usize).min(values.len() - 1)].clone()
            }
        }
    }

    /// True where its values belong on a logarithmic axis.
    pub(super) fn logarithmic(&self) -> bool {
        matches!(&self.values, Values::Range(range) if range.logarithmic)
    }
}

/// An error about the values of `key`.
pub(super) fn wrong(key: &str, message: &str) -> InputError {
    InputError::new(format!("{key}: {message}")).help(FORMS)
}

/// A value as an override of a scene has it.
fn text_of(value: &Value) -> String {
    match value {
        Value::String(text) => text.trim().into(),
        other => other.to_string(),
    }
}

/// The pieces between the commas that stand in no brackets and no quotes.
fn split(text: &str) -> Vec<String> {
    let (mut pieces, mut depth, mut quoted) = (vec![String::new()], 0_usize, false);
    for c in text.chars() {
        match c {
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth = depth.saturating_sub(1),
            _ => {}
        }
        match (c, pieces.last_mut()) {
            (',', _) if depth == 0 && !quoted => pieces.push(String::new()),
            (_, Some(piece)) => piece.push(c),
            _ => {}
        }
    }
    pieces.iter().map(|piece| piece.trim().into()).collect()
}

/// The number at the start of `text` and the unit behind it.
fn quantity(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let numeric = text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    let ends = text.char_indices().map(|(i, c)| i + c.len_utf8()).rev();
    let mut found = ends
        .filter_map(|end| Some((text[..end].parse::<f64>().ok()?, text[end..].trim())))
        .filter(|_| numeric);
    found.next().filter(|(number, _)| number.is_finite())
}

/// `unit` over `other`, which must be of the same quantity.
fn ratio(unit: &str, other: &str) -> Option<f64> {
    if unit == other {
        return Some(1.0);
    }
    let size =
        |units: &[(&str, f64)], unit| units.iter().find(|(name, _)| *name == unit).map(|(_, size)| *size);
    let of = |units: &[(&str, f64)]| Some(size(units, unit)? / size(units, other)?);
    of(Length::UNITS).or_else(|| of(Stress::UNITS)).or_else(|| of(Force::UNITS))
}

/// Digits of the values of a range: those behind are left by arithmetic.
const DIGITS: usize = 12;

impl Range {
    /// Reads `A..B`, `A..B/N` or `A..B/N log`; `None` where the text is no range at all.
    fn parse(text: &str) -> Option<Result<Range, String>> {
        let (low, rest) = text.split_once("..")?;
        let low = quantity(low)?;
        Some(Range::of_parts(text.trim(), low, rest))
    }

    fn of_parts(text: &str, (low, low_unit): (f64, &str), rest: &str) -> Result<Range, String> {
        let (rest, logarithmic) = match rest.trim().strip_suffix("log") {
            Some(rest) => (rest, true),
            None => (rest, false),
        };
        // the unit of a force in plane strain holds a slash too
        let counted = rest.rsplit_once('/').map(|(end, count)| (end, count.trim().parse::<usize>(), count));
        let (end, count) = match counted {
            Some((end, Ok(count), _)) => (end, Some(count)),
            Some((_, Err(_), count))
                if count.trim().starts_with(|c: char| c.is_ascii_digit() || c == '-') =>
            {
                return Err(format!("{} is no number of values in `{text}`", count.trim()));
            }
            _ => (rest, None),
        };
        let (high, unit) =
            quantity(end).ok_or_else(|| format!("`{}` in `{text}` is no number", end.trim()))?;
        let (high, unit) = match low_unit {
            // 1..5 um
            "" => (high, unit),
            _ => {
                let ratio = ratio(unit, low_unit)
                    .ok_or_else(|| format!("the ends of `{text}` have units that do not go together"))?;
                (rounded(high * ratio, DIGITS), low_unit)
            }
        };
        if low == high {
            return Err(format!("the range `{text}` is empty: its ends are equal"));
        }
        if count.is_some_and(|n| n < 2) {
            return Err(format!("`{text}` needs at least 2 values: both ends are among them"));
        }
        if logarithmic && !(low > 0.0 && high > 0.0) {
            return Err(format!("`{text}` cannot be logarithmic: both ends must be above 0"));
        }
        Ok(Range { ends: [low, high], unit: unit.into(), count, logarithmic })
    }

    /// The value at `share` (0 to 1) of the way, to twelve digits.
    fn value_at(&self, share: f64) -> String {
        let [low, high] = self.ends;
        let value = match share {
            0.0 => low,
            1.0 => high,
            _ if self.logarithmic => low * (high / low).powf(share),
            _ => low + (high - low) * share,
        };
        format!("{} {}", rounded(value, DIGITS), self.unit).trim_end().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(text: &str) -> Vec<String> {
        all_levels(&Vary::parse(text).unwrap())
    }

    fn all_levels(vary: &Vary) -> Vec<String> {
        (0..vary.count().unwrap()).map(|i| vary.level(i)).collect()
    }

    #[test]
    fn lists_and_ranges_keep_their_units() {
        assert_eq!(levels("material.hardening_exponent=0, 0.1,0.2"), ["0", "0.1", "0.2"]);
        assert_eq!(levels("loading.depth=1 um..5 um/5"), ["1 um", "2 um", "3 um", "4 um", "5 um"]);
        assert_eq!(levels("loading.depth=0.1..0.3 um/3"), ["0.1 um", "0.2 um", "0.3 um"]);
        assert_eq!(levels("m.y=200 MPa..1 GPa/3"), ["200 MPa", "600 MPa", "1000 MPa"]);
        assert_eq!(levels("m.y=1..100/3 log"), ["1", "10", "100"]);
        assert_eq!(levels("loading.force=1 N/mm..3 N/mm/3"), ["1 N/mm", "2 N/mm", "3 N/mm"]);
        assert_eq!(levels("surface.pixels=[64, 64],[128, 128]"), ["[64, 64]", "[128, 128]"]);
        assert_eq!(levels("surface.file=../a.npy,../b.npy"), ["../a.npy", "../b.npy"]);
        assert_eq!(levels("m.n=-1e-3..1e-3/3"), ["-0.001", "0", "0.001"]);
        let list = serde_json::json!([0, 0.25, "5 um", [1, 2]]);
        assert_eq!(all_levels(&Vary::new("k", &list).unwrap()), ["0", "0.25", "5 um", "[1,2]"]);
    }

    #[test]
    fn wrong_values_are_errors_that_name_the_key() {
        for (text, said) in [
            ("loading.depth=", "no values"),
            ("loading.depth=1 um,,2 um", "missing"),
            ("loading.depth=1 um,1 um", "twice"),
            ("loading.depth=1 um..2 um/0", "at least 2"),
            ("loading.depth=1 um..2 um/1", "at least 2"),
            ("loading.depth=1 um..2 um/2.5", "2.5"),
            ("loading.depth=1 um..1 um/3", "empty"),
            ("loading.depth=1 um..2 MPa/3", "do not go together"),
            ("loading.depth=1..x/3", "`x`"),
            ("loading.depth=0..1/3 log", "above 0"),
        ] {
            let error = Vary::parse(text).unwrap_err().to_string();
            assert!(error.starts_with("loading.depth: ") && error.contains(said), "{text}: {error}");
        }
        assert!(Vary::parse("no values").is_err() && Vary::parse("=1").is_err());
    }
}
