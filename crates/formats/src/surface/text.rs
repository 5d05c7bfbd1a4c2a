//! Text: `.xyz` lists points x y z of a regular grid in any order, `.csv` holds one row of heights per line.

use super::measured::{MOST_NODES, Measured, ReadError, Spacing};
use std::path::Path;

/// A missing point in a text file.
fn is_missing(word: &str) -> bool {
    word.is_empty() || ["nan", "bad", "-", "na", "***"].contains(&word.to_ascii_lowercase().as_str())
}

fn number(word: &str, line: usize) -> Result<f64, ReadError> {
    if is_missing(word) {
        return Ok(f64::NAN);
    }
    word.parse().map_err(|_| {
        let hint = match word.split_once(',') {
            Some(_) => "decimals stand behind a point, not a comma",
            None => "begin lines that hold no heights with #",
        };
        ReadError::text(line, format!("\"{}\" is not a number ({hint})", shortened(word)))
    })
}

/// The beginning of a long word.
fn shortened(word: &str) -> String {
    const SHOWN_CHARACTERS: usize = 40;
    let start: String = word.chars().take(SHOWN_CHARACTERS).collect();
    if start.len() < word.len() { format!("{start}…") } else { start }
}

/// True where a line names the columns of a list of points.
fn is_title(line: &str) -> bool {
    let names: Vec<String> = words(line.trim()).iter().map(|w| w.to_ascii_lowercase()).collect();
    names == ["x", "y", "z"]
}

fn is_comment(line: &str) -> bool {
    line.is_empty() || line.starts_with(['#', '%', '"'])
}

fn words(line: &str) -> Vec<&str> {
    let separator = [';', '\t', ','].into_iter().find(|s| line.contains(*s));
    match separator {
        Some(s) => line.split(s).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}

/// Reads a table of heights, or points if its first line says x, y, z.
pub(super) fn read_table(path: &Path) -> Result<Measured, ReadError> {
    let data = std::fs::read(path)?;
    let text = text_of(&data)?;
    if text.lines().next().is_some_and(is_title) {
        return points(text);
    }
    let mut table: Vec<Vec<f64>> = Vec::new();
    let mut ends_empty = true;
    for (i, line) in text.lines().enumerate().map(|(i, l)| (i + 1, l.trim())).filter(|(_, l)| !is_comment(l))
    {
        let words = words(line);
        let columns = table.first().map_or(words.len(), Vec::len);
        if words.len() != columns {
            let problem = format!("{} heights, but the lines before have {columns}", words.len());
            return Err(ReadError::text(i, problem));
        }
        ends_empty &= words.last() == Some(&"");
        table.push(words.into_iter().map(|word| number(word, i)).collect::<Result<_, _>>()?);
    }
    if ends_empty {
        // a separator at the end of every line makes no further column
        for row in &mut table {
            row.pop();
        }
    }
    let (columns, rows) = (table.first().map_or(0, Vec::len), table.len());
    let heights = table.concat();
    if heights.is_empty() {
        return Err(ReadError::text(1, "the file holds no heights"));
    }
    Ok(Measured { columns, rows, heights, spacing: Spacing::Unknown, height_unit: None })
}

/// Reads points x y z, one a line.
pub(super) fn read_points(path: &Path) -> Result<Measured, ReadError> {
    let data = std::fs::read(path)?;
    points(text_of(&data)?)
}

fn text_of(data: &[u8]) -> Result<&str, ReadError> {
    let text = std::str::from_utf8(data).map_err(|e| ReadError::Unknown {
        found: format!("byte {} is no text: this file is not a list of numbers", e.valid_up_to()),
    })?;
    Ok(text.trim_start_matches('\u{feff}'))
}

/// A first line that names the columns is passed over.
fn points(text: &str) -> Result<Measured, ReadError> {
    let skip = usize::from(text.lines().next().is_some_and(is_title));
    let mut points: Vec<[f64; 3]> = Vec::new();
    for (i, line) in text.lines().enumerate().skip(skip).map(|(i, l)| (i + 1, l.trim())) {
        if is_comment(line) {
            continue;
        }
        let words = words(line);
        let &[x, y, z] = words.as_slice() else {
            return Err(ReadError::text(i, format!("{} numbers, a point has 3: x y z", words.len())));
        };
        let point = [number(x, i)?, number(y, i)?, number(z, i)?];
        if !(point[0].is_finite() && point[1].is_finite()) {
            return Err(ReadError::text(i, "x and y must be finite numbers"));
        }
        points.push(point);
    }
    let (x, y) = (Axis::from_points(&points, 0)?, Axis::from_points(&points, 1)?);
    let count = x.count as u64 * y.count as u64;
    // a grid with most of its nodes absent is a cloud of points
    if count >= MOST_NODES || count > 8 * points.len() as u64 {
        return Err(cloud(format!("{} points would make a grid of {} x {}", points.len(), x.count, y.count)));
    }
    let mut heights = vec![f64::NAN; count as usize];
    for p in &points {
        let node = y.node(p[1])? * x.count + x.node(p[0])?;
        if !heights[node].is_nan() && heights[node] != p[2] {
            return Err(cloud(format!("two heights at x = {}, y = {}", p[0], p[1])));
        }
        heights[node] = p[2];
    }
    let spacing = Spacing::HeightUnits([x.step, y.step]);
    Ok(Measured { columns: x.count, rows: y.count, heights, spacing, height_unit: None })
}

fn cloud(why: String) -> ReadError {
    ReadError::text(
        1,
        format!("the points do not form a regular grid along x and y ({why}): resample them first"),
    )
}

/// Equally spaced coordinates.
struct Axis {
    low: f64,
    step: f64,
    count: usize,
}

impl Axis {
    fn from_points(points: &[[f64; 3]], axis: usize) -> Result<Axis, ReadError> {
        let mut values: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        values.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (values.first(), values.last()) else {
            return Err(ReadError::text(1, "the file holds no points"));
        };
        // coordinates are printed with few digits: what differs by less than 1e-6 of the whole is the same
        let same = 1e-6 * (high - low);
        let count = 1 + values.windows(2).filter(|w| w[1] - w[0] > same).count();
        if count < 2 || !(high - low).is_finite() {
            let problem = "all points lie on one line: this is a profile, a map has at least 2 x 2 points";
            return Err(ReadError::text(1, problem));
        }
        Ok(Axis { low, step: (high - low) / (count - 1) as f64, count })
    }

    fn node(&self, value: f64) -> Result<usize, ReadError> {
        let place = (value - self.low) / self.step;
        let node = place.round();
        if (place - node).abs() > 0.05 {
            return Err(cloud(format!("{value} is no multiple of the spacing {}", self.step)));
        }
        Ok((node as usize).min(self.count - 1))
    }
}
