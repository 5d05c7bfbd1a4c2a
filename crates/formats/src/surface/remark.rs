//! Remarks `key: value` among the words before the heights of a text file.

use crate::dimension::Dimension;
use crate::text::{Decimal, Grid, Separator, folded_name, names_above, uncommented};

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
    /// The whole line.
    pub text: String,
}

/// The numbers of a value.
#[derive(Default)]
pub(super) struct Numbers {
    /// Each with the word behind it; NaN where nothing tells which number it is.
    pub list: Vec<(f64, Option<String>)>,
    /// True of `10 to 74`.
    pub is_range: bool,
}

/// Words between the ends of a range.
const TO: [&str; 7] = ["to", "bis", "à", "-", "–", "…", "..."];
/// Words for numbers of points.
const PIXELS: [&str; 8] = ["px", "pix", "pixel", "pixels", "points", "pts", "pt", "samples"];

/// True of a word for numbers of points.
pub(super) fn is_pixels(word: &str) -> bool {
    PIXELS.contains(&word.to_lowercase().as_str())
}

impl Remark {
    /// The remarks of the lines before a table: of each line one, and of names above as many numbers one
    /// each.
    pub fn list(grid: &Grid<'_>) -> Vec<Remark> {
        let bare = |text: &str| uncommented(text).to_string();
        let lines: Vec<&(usize, &str)> = grid.before.iter().filter(|(_, text)| !text.is_empty()).collect();
        let of_pair = |pair: &[&(usize, &str)]| {
            let pairs = names_above(&grid.dialect, &bare(pair[0].1), &bare(pair[1].1)).unwrap_or_default();
            pairs
                .into_iter()
                .filter_map(|(name, number)| Remark::new(pair[1].0, &format!("{name}: {number}")))
                .collect::<Vec<_>>()
        };
        // where commas part columns, they part two numbers behind a name as well
        let is_parted = grid.dialect.separator == Separator::Mark(',');
        let of_lines = lines.iter().filter_map(|(line, text)| {
            let cells = is_parted.then(|| grid.dialect.cells(text).collect::<Vec<_>>().join("\t"));
            let remark = Remark::new(*line, cells.as_deref().unwrap_or(text))?;
            Some(Remark { text: uncommented(text).replace('"', "").trim().to_string(), ..remark })
        });
        of_lines.chain(lines.windows(2).flat_map(of_pair)).collect()
    }

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
        let (mut key, mut key_unit) = folded_name(&text[..end]);
        // Increment (x)
        if let Some(axis) = key_unit.take_if(|unit| ["x", "y", "z"].contains(&unit.to_lowercase().as_str())) {
            key = format!("{key} {}", axis.to_lowercase());
        }
        let value = text[start..].trim_matches([' ', '\t', ';', ',', '=', ':']).replace(['\t', ';'], " ");
        let text = text.to_string();
        (!key.is_empty() && !value.is_empty()).then_some(Remark { line, key, key_unit, value, text })
    }

    /// The numbers of the value with the words behind them, where decimals stand behind `decimal`.
    pub fn numbers(&self, decimal: Option<Decimal>) -> Numbers {
        let text = self.value.replace(['×', '*'], "x");
        let (mut rest, mut found, mut is_per) = (text.as_str(), Numbers::default(), false);
        loop {
            rest = rest.trim_start_matches([' ', ',', '(', ')', '[', ']', ':']);
            let Some(first) = rest.chars().next() else { break };
            if first == '/' {
                (rest, is_per) = (&rest[1..], true);
                continue;
            }
            let digits = rest.trim_start_matches(['-', '+', '.']);
            if digits.starts_with(|c: char| c.is_ascii_digit()) {
                let end = number_end(rest);
                found.list.extend(numbers_in(&rest[..end], decimal).into_iter().map(|number| (number, None)));
                (rest, is_per) = (&rest[end..], false);
                continue;
            }
            if first == 'x' && !rest[1..].starts_with(char::is_alphabetic) {
                rest = &rest[1..];
                continue;
            }
            let end = rest
                .find([' ', ',', '(', ')', '[', ']', '/', ':'])
                .unwrap_or(rest.len())
                .max(first.len_utf8());
            let word = &rest[..end];
            found.is_range |= TO.contains(&word);
            if let Some((_, unit)) = found.list.last_mut().filter(|(_, unit)| unit.is_none() && !is_per) {
                *unit = Some(word.into()).filter(|_| !TO.contains(&word));
            }
            (rest, is_per) = (&rest[end..], false);
        }
        // 3 x 1 um
        for i in (1..found.list.len()).rev() {
            if found.list[i - 1].1.is_none() {
                found.list[i - 1].1 = found.list[i].1.clone();
            }
        }
        found
    }

    /// Lengths of the value, in metres; `unit` where none stands with them. Numbers of pixels are none.
    pub fn lengths(&self, numbers: &Numbers, unit: Option<f64>) -> Vec<Option<f64>> {
        let of_key = self.key_unit.as_ref().and_then(|unit| Dimension::Length.scale(unit.split('/').next()?));
        let metres = |(number, own): &(f64, Option<String>)| {
            let scale = match own {
                Some(own) => Dimension::Length.scale(own),
                None => of_key.or(unit),
            };
            scale.map(|scale| number * scale).filter(|length| *length > 0.0)
        };
        let is_length = |own: &Option<String>| !own.as_deref().is_some_and(is_pixels);
        numbers.list.iter().filter(|(_, own)| is_length(own)).map(metres).collect()
    }

    /// Numbers above 0 without any unit; empty where the value is something else.
    pub fn bare_numbers(&self, numbers: &Numbers) -> Vec<f64> {
        let bare =
            |(number, unit): &(f64, Option<String>)| (*number > 0.0 && unit.is_none()).then_some(*number);
        let all: Option<Vec<f64>> = numbers.list.iter().map(bare).collect();
        all.filter(|_| self.key_unit.is_none()).unwrap_or_default()
    }
}

/// End of the number with which a text begins.
fn number_end(text: &str) -> usize {
    let end = text.find(|c: char| !(c.is_ascii_digit() || "+-.,".contains(c))).unwrap_or(text.len());
    let exponent = text[end..].strip_prefix(['e', 'E']).map_or(0, |rest| {
        1 + rest.find(|c: char| !(c.is_ascii_digit() || c == '-' || c == '+')).unwrap_or(rest.len())
    });
    if exponent > 1 { end + exponent } else { end }
}

/// True of a comma, or a point beside decimal commas, that may part thousands.
fn may_part_thousands(word: &str, mark: char) -> bool {
    let (whole, group) = word.rsplit_once(mark).unwrap_or(("", ""));
    let whole = whole.trim_start_matches(['-', '+']);
    group.len() == 3
        && group.bytes().all(|b| b.is_ascii_digit())
        && !whole.starts_with('0')
        && !whole.is_empty()
}

/// True of a number whose comma can only stand before decimals.
pub(super) fn has_decimal_comma(word: &str) -> bool {
    let word = word.trim_end_matches(',');
    word.matches(',').count() == 1 && !word.contains('.') && !may_part_thousands(word, ',')
}

/// The numbers of a word: `2.0,1.0` holds two. NaN where nothing tells which: `1,024` without `decimal`, or
/// against it.
fn numbers_in(word: &str, decimal: Option<Decimal>) -> Vec<f64> {
    let word = word.trim_end_matches([',', '.']);
    let parsed = |word: &str| word.parse().unwrap_or(f64::NAN);
    let is_comma = decimal == Some(Decimal::Comma);
    let commas = word.matches(',').count();
    if commas == 0 {
        let is_doubtful = is_comma && may_part_thousands(word, '.');
        return vec![if is_doubtful { f64::NAN } else { parsed(word) }];
    }
    let parts: Vec<&str> = word.split(',').collect();
    if commas > 0 && parts.iter().all(|part| part.contains('.')) {
        return parts.into_iter().map(parsed).collect();
    }
    if word.contains('.') {
        let groups = word.split('.').next().unwrap_or("");
        return vec![if may_part_thousands(groups, ',') { parsed(&word.replace(',', "")) } else { f64::NAN }];
    }
    let is_doubtful = commas > 1 || !is_comma && may_part_thousands(word, ',');
    vec![if is_doubtful { f64::NAN } else { parsed(&word.replace(',', ".")) }]
}

/// A number, with point or comma before its decimals, and the text behind it.
pub(super) fn number_and_unit(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let end = number_end(text);
    let number = text[..end].trim_end_matches(',').replace(',', ".");
    Some((number.parse().ok()?, &text[end..]))
}
