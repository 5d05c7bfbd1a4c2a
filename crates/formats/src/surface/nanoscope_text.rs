//! The text that NanoScope exports: the header of its images (`\key: value`, some versions in quotes), then
//! heights as numbers, in a matrix or one below the other, with a column for each channel.
//! Source: Bruker, "NanoScope Analysis user manual", Export ASCII; header as in [`super::nanoscope`].

use super::measured::{Format, Measured, ReadError, Request};
use super::nanoscope::{self, Section};
use crate::dimension::Dimension;
use crate::text::{TextError, decode, read_grid};
use std::path::Path;

const FORMAT: Format = Format("NanoScope text");
/// The first line where each is in quotes.
pub(super) const QUOTED_MAGIC: &[u8] = b"\"\\*File list";
/// The end of a header, in small letters.
const END: &[u8] = b"\\*file list end";
/// Bytes behind a header that tell whether numbers follow as text.
const LOOKED_AT: usize = 64;

/// Reads a file that begins like one of NanoScope, of bytes or exported as text.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let sections = nanoscope::sections(&data);
    match begins(&data) {
        Some(at) => read_text(&decode(&data[at..])?.0, &sections, request),
        None => nanoscope::read(&data, &sections, request),
    }
}

/// Where the text behind the header of `data` begins; `None` of a file of bytes.
fn begins(data: &[u8]) -> Option<usize> {
    let start = &data[..data.len().min(nanoscope::LONGEST_HEADER)];
    let at = start.windows(END.len()).position(|bytes| bytes.eq_ignore_ascii_case(END))? + END.len();
    let behind = &data[at..data.len().min(at + LOOKED_AT)];
    let is_text = |byte: &u8| byte.is_ascii_graphic() || byte.is_ascii_whitespace() || *byte >= 0x80;
    let holds = behind.iter().any(u8::is_ascii_alphanumeric) && behind.iter().all(is_text);
    holds.then_some(at)
}

/// Reads the heights of a `text` from the header on, of an image of these `sections`.
fn read_text(
    text: &str,
    sections: &[(String, Section)],
    request: &Request<'_>,
) -> Result<Measured, ReadError> {
    // from the line behind that of the end
    let text = text.split_once('\n').map_or("", |(_, rest)| rest);
    let is_number = |line: &str| line.trim().starts_with(|c: char| c.is_ascii_digit() || c == '-');
    let first = text.lines().position(is_number).unwrap_or(0);
    let words: Vec<Vec<&str>> = text.lines().take(first).map(cells).collect();
    let numbers = text.lines().skip(first).collect::<Vec<_>>().join("\n");
    let grid = read_grid(&numbers, request.missing_value, request.decimal)
        .map_err(|error| TextError::whole(error.message))?;
    let counts = |image: &Section| {
        let count = |key: &str| image.get(key).and_then(|text| text.parse::<usize>().ok());
        Some([count("samps/line")?, count("number of lines")?])
    };
    let (columns, rows) = (grid.columns, grid.rows());
    let fits =
        |image: &&Section| counts(image).is_some_and(|[x, y]| [columns, rows] == [x, y] || rows == x * y);
    let Some((image, [x, y])) =
        nanoscope::images(sections).find(fits).and_then(|image| Some((image, counts(image)?)))
    else {
        let found = format!("{columns} columns and {rows} rows");
        return Err(FORMAT.header("Samps/line, Number of lines", found, "they must be those of the numbers"));
    };
    let is_matrix = [columns, rows] == [x, y];
    // several channels are told apart by the line of their names alone
    let (channel, unit) = if is_matrix || columns == 1 {
        (0, words.iter().flatten().find_map(|cell| unit_of(cell)))
    } else {
        let names = words.iter().rev().find(|cells| cells.len() == columns);
        let is_length = |cell: &&str| matches!(unit_of(cell), Some((_, Some(_))));
        let channel = names.and_then(|names| names.iter().position(is_length));
        let Some((channel, names)) = channel.zip(names) else {
            let found = format!("{columns} columns");
            let way = "export the Height channel alone, or in nm";
            return Err(FORMAT.header("names of the channels", found, way));
        };
        (channel, unit_of(names[channel]))
    };
    if let Some((unit, None)) = unit {
        return Err(FORMAT.header("unit", unit, "heights have a length: export the Height channel"));
    }
    let values: Vec<f64> = if is_matrix {
        grid.values
    } else {
        grid.values.into_iter().skip(channel).step_by(columns).collect()
    };
    let heights = values.chunks(x).rev().flatten().copied().collect();
    let pixel = nanoscope::pixel(image, [x as u64, y as u64])?;
    let mut map = Measured::in_metres(x as u64, y as u64, pixel, heights);
    map.height_unit = unit.and_then(|(_, scale)| scale);
    let what = if is_matrix { "a matrix".into() } else { format!("column {} of points", channel + 1) };
    map.notes.push(format!("text of NanoScope: {what}, size of the scan from its header"));
    Ok(map)
}

/// The words of a line, without quotes and the mark of a key.
fn cells(line: &str) -> Vec<&str> {
    let words = line.split(['\t', ',']);
    words
        .map(|word| word.trim().trim_matches('"').trim_start_matches('\\').trim())
        .filter(|word| !word.is_empty())
        .collect()
}

/// The unit of `Height(nm)`, or of `Exported image units: nm`, with its metres where it is a length.
fn unit_of(cell: &str) -> Option<(&str, Option<f64>)> {
    let unit = match cell.split_once(':') {
        Some((key, unit)) => key.to_ascii_lowercase().contains("units").then_some(unit)?,
        None => cell.strip_suffix(')')?.rsplit_once('(')?.1,
    };
    Some((unit.trim(), Dimension::Length.scale(unit.trim())))
}
