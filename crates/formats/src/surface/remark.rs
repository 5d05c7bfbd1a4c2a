//! Remarks `key: value` among the words before the heights of a text file.

use crate::dimension::Dimension;
use crate::text::folded_name;

/// A remark `key: value`.
pub(super) struct Remark {
    /// Its line, from 1.
    pub line: usize,
    /// The key, in small letters without accents, words apart by blanks.
    pub key: String,
    /// Unit that stands with the key.
    pub key_unit: Option<String>,
    /// The rest of the line.
    pub value: String,
}

impl Remark {
    /// The remark in a line, if it is one.
    pub fn new(line: usize, text: &str) -> Option<Remark> {
        let text = text.trim_start_matches(['#', '%', '/', ';', '!', '*', ' ']).replace('"', "");
        let text = text.trim();
        let cut =
            text.find([':', '=']).or_else(|| text.find(['\t', ';', ','])).map(|i| (i, i + 1)).or_else(|| {
                let i = text.find(|c: char| c.is_ascii_digit() || c == '-')?;
                (i > 0).then_some((i, i))
            });
        let (end, start) = cut?;
        let (key, key_unit) = folded_name(&text[..end]);
        let value = text[start..].trim_matches([' ', '\t', ';', ',', '=', ':']).replace(['\t', ';'], " ");
        (!key.is_empty() && !value.is_empty()).then_some(Remark { line, key, key_unit, value })
    }

    /// One or two lengths of the value, in metres; `unit` where none stands with them.
    pub fn lengths(&self, unit: Option<f64>) -> Vec<Option<f64>> {
        let value = self.value.replace(['×', '*'], "x");
        let parts: Vec<(f64, Option<f64>)> = value
            .split('x')
            .filter_map(|part| {
                let (number, unit) = number_and_unit(part)?;
                let unit = unit.trim_start_matches([' ', ',', '(', '[']);
                let unit = unit.split(['/', ')', ']', ' ']).next().unwrap_or("");
                Some((number, Dimension::Length.scale(unit).filter(|_| !unit.is_empty())))
            })
            .collect();
        let of_key = self.key_unit.as_ref().and_then(|unit| Dimension::Length.scale(unit.split('/').next()?));
        let last = parts.last().and_then(|(_, unit)| *unit);
        let metres = |(number, own): &(f64, Option<f64>)| Some(number * own.or(last).or(of_key).or(unit)?);
        parts.iter().map(|part| metres(part).filter(|length| *length > 0.0)).collect()
    }

    /// One or two numbers above 0 without any unit; empty where the value is something else.
    pub fn bare_numbers(&self) -> Vec<f64> {
        let bare = |part: &str| {
            let (number, unit) = number_and_unit(part)?;
            (number > 0.0 && unit.trim().is_empty()).then_some(number)
        };
        let value = self.value.replace(['×', '*'], "x");
        let numbers: Option<Vec<f64>> = value.split('x').map(bare).collect();
        numbers.filter(|_| self.key_unit.is_none()).unwrap_or_default()
    }
}

/// A number, with point or comma before its decimals, and the text behind it.
pub(super) fn number_and_unit(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let is_part = |c: char| c.is_ascii_digit() || "+-.,".contains(c);
    let mut end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    let exponent = text[end..].strip_prefix(['e', 'E']).map_or(0, |rest| {
        1 + rest.find(|c: char| !(c.is_ascii_digit() || c == '-' || c == '+')).unwrap_or(rest.len())
    });
    if exponent > 1 {
        end += exponent;
    }
    let number = text[..end].trim_end_matches(',').replace(',', ".");
    Some((number.parse().ok()?, &text[end..]))
}
