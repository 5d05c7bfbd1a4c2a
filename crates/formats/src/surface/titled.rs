//! Text files that are known by their first line, whose header says by place what its numbers mean.

use super::measured::{Format, Measured, ReadError, Request, Spacing};
use super::points::onto_grid;
use crate::text::{Grid, TextError, read_grid};

/// Metres per unit of the numbers of these files.
const NANOMETRE: f64 = 1e-9;
const MICROMETRE: f64 = 1e-6;
const MILLIMETRE: f64 = 1e-3;

/// The map of a text whose first line is known; `None` for every other text.
pub(super) fn read(text: &str, request: &Request<'_>) -> Option<Result<Measured, ReadError>> {
    let first = bare(text.lines().next()?);
    if first.starts_with("Zygo XYZ Data File") {
        Some(zygo(text, request))
    } else if first.starts_with("Wyko ASCII Data File Format") {
        Some(wyko(text, request))
    } else if first == "DSAA" {
        Some(surfer(text, request))
    } else {
        refused(text).map(|(line, problem)| Err(TextError::new(line, problem).into()))
    }
}

/// Lines among which a format says what it is.
const LINES_OF_A_HEADER: usize = 40;

/// The line and the reason, with a way out, of formats whose numbers are no table.
fn refused(text: &str) -> Option<(usize, &'static str)> {
    const ZEMAX: &str = "looks like a grid sag of Zemax, nx ny dx dy and a point in each line below them: write it as a map of ny \
                         lines with nx heights, and say pixel_size and height_unit";
    const CODE_V: &str = "is of an interferogram of CODE V, whose heights are its numbers times WVL/SSZ um, and missing where they \
                          are NDA: export it as .xyz or .asc, or write them so in a table";
    const TECPLOT: &str = "is a zone of Tecplot packed by variables: export it packed by points (F=POINT), a point in each line";
    const IGOR: &str = "is Igor Text, whose waves have a line for each x: transpose the wave (MatrixTranspose) and export it as a \
                        table, or export it as .gwy or .sur";
    if bare(text.lines().next().unwrap_or("")) == "IGOR" {
        return Some((1, IGOR));
    }
    let numbers = |line: &str| -> Vec<f64> {
        line.split_whitespace().map(|word| word.parse().unwrap_or(f64::NAN)).collect()
    };
    let mut rows = text.lines().map(numbers);
    if let (Some([x, y, _, _, unit, _, _]), Some([_] | [_, _, _, _])) =
        (rows.next().as_deref(), rows.next().as_deref())
        && [x, y].into_iter().all(|count| *count >= 2.0 && count.fract() == 0.0)
        && [0.0, 1.0, 2.0, 3.0].contains(unit)
    {
        return Some((1, ZEMAX));
    }
    text.lines().take(LINES_OF_A_HEADER).enumerate().find_map(|(i, line)| {
        let words: Vec<String> = line.split([' ', ',', '=', '\t']).map(str::to_uppercase).collect();
        let has = |word: &str| words.iter().any(|w| w == word);
        if words[0] == "GRD" && has("WVL") {
            Some((i + 1, CODE_V))
        } else {
            (has("BLOCK") && (has("F") || has("DATAPACKING"))).then_some((i + 1, TECPLOT))
        }
    })
}

/// A line without the sign of a comment.
fn bare(line: &str) -> &str {
    line.trim_start_matches(['\u{feff}', '#', ' ']).trim()
}

/// The rows of numbers in `body` lines behind the first `skipped` ones.
fn rows<'t>(
    kept: &'t mut String,
    text: &str,
    [skipped, body]: [usize; 2],
    request: &Request<'_>,
) -> Result<Grid<'t>, ReadError> {
    // empty lines in the place of the header keep the numbers of the others
    *kept = "\n".repeat(skipped);
    for line in text.lines().skip(skipped).take(body) {
        kept.push_str(line);
        kept.push('\n');
    }
    Ok(read_grid(kept, request.missing_value, request.decimal)?)
}

/// Zygo MetroPro and Mx: x and y number the pixels of the camera, z is in micrometres; the seventh word of
/// line 8 is the pixel in metres; a line of # ends the header.
fn zygo(text: &str, request: &Request<'_>) -> Result<Measured, ReadError> {
    const LINE_OF_PIXEL: usize = 8;
    let header: Vec<&str> =
        text.lines().take_while(|line| !bare(line).is_empty() || !line.contains('#')).collect();
    if header.len() < LINE_OF_PIXEL || header.len() == text.lines().count() {
        let problem =
            "says Zygo XYZ Data File, but its header has no end, which is a line of #: export it again";
        return Err(TextError::new(1, problem).into());
    }
    let word = bare(header[LINE_OF_PIXEL - 1]).split_whitespace().nth(6);
    let pixel: f64 = word
        .and_then(|word| word.parse().ok())
        .filter(|p: &f64| p.is_finite() && *p >= 0.0)
        .ok_or_else(|| {
            TextError::new(
                LINE_OF_PIXEL,
                "has no pixel size in metres as its seventh word: export the file again",
            )
        })?;
    let mut kept = String::new();
    let grid = rows(&mut kept, text, [header.len() + 1, usize::MAX], request)?;
    if grid.columns != 3 {
        let problem = format!("{} numbers, a point of a Zygo XYZ file has 3: x y z", grid.columns);
        return Err(TextError::new(grid.lines[0], problem).into());
    }
    let points: Vec<[f64; 3]> = grid.values.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    let placed = onto_grid(&points).map_err(|problem| TextError::new(grid.lines[0], problem))?;
    let mut notes =
        vec!["text of Zygo MetroPro: x and y count pixels, z is in um, No Data is missing".to_string()];
    notes.extend(placed.note);
    let spacing = if pixel > 0.0 {
        Spacing::Metres(placed.step.map(|step| step * pixel))
    } else {
        notes.push("its places along the surface were not calibrated".into());
        Spacing::Unknown
    };
    Ok(Measured {
        columns: placed.columns,
        rows: placed.rows,
        heights: placed.heights,
        spacing,
        spacing_error: placed.error,
        height_unit: Some(MICROMETRE),
        notes,
    })
}

/// Wyko and Veeco Vision: a line for each x, from the largest y down; the second flag of the first line says
/// whether heights are nanometres (1) or waves (0).
fn wyko(text: &str, request: &Request<'_>) -> Result<Measured, ReadError> {
    const FORMAT: Format = Format("Wyko ASCII");
    const HEIGHTS: [&str; 4] = ["RAW_DATA", "RAW DATA", "OPD", "SAMPLE_DATA"];
    let cells = |line: &str| line.split('\t').map(|cell| cell.trim().to_string()).collect::<Vec<String>>();
    let is_start = |line: &str| HEIGHTS.contains(&line.split('\t').next().unwrap_or("").trim());
    let header: Vec<Vec<String>> = text.lines().take_while(|line| !is_start(line)).map(cells).collect();
    if header.len() == text.lines().count() {
        let allowed =
            "one must hold heights (RAW_DATA, OPD, SAMPLE_DATA): export the heights as .opd or ASCII";
        return Err(FORMAT.header("blocks", "none of heights", allowed));
    }
    let named = |name: &str, cell: usize| {
        header.iter().find(|line| line[0] == name).and_then(|line| line.get(cell)).cloned()
    };
    let number = |name: &'static str, cell: usize| -> Result<Option<f64>, ReadError> {
        let Some(value) = named(name, cell) else { return Ok(None) };
        let parsed: Option<f64> = value.replace(',', ".").parse().ok();
        parsed
            .ok_or_else(|| FORMAT.header(name, &value, "it must be a number"))
            .and_then(|value| FORMAT.positive(name, value).map(Some))
    };
    let flag = header[0].join(" ").split_whitespace().nth(6).map(str::to_string);
    let unit = match flag.as_deref() {
        Some("1") => NANOMETRE,
        Some("0") => {
            let wavelength = number("Wavelength", 3)?.ok_or_else(|| {
                FORMAT.header("Wavelength", "nothing", "heights are parts of it: export them in nanometres")
            })?;
            wavelength * NANOMETRE / number("Mult", 3)?.unwrap_or(1.0)
        }
        other => {
            let allowed =
                "the second flag of the first line is 0 (waves) or 1 (nanometres): export .opd instead";
            return Err(FORMAT.header("unit of heights", other.unwrap_or("nothing"), allowed));
        }
    };
    let size = |name, other: usize| number(name, 1).map(|said| said.map_or(other, |count| count as usize));
    let mut kept = String::new();
    let lines = number("X Size", 1)?.map_or(usize::MAX, |count| count as usize);
    let grid = rows(&mut kept, text, [header.len() + 1, lines], request)?;
    let (columns, rows) = (size("X Size", grid.rows())?, size("Y Size", grid.columns)?);
    if (columns, rows) != (grid.rows(), grid.columns) {
        let found =
            format!("{columns} x {rows}, but {} lines of {} heights follow", grid.rows(), grid.columns);
        let allowed =
            "there is a line for each x with a height for each y: export the file again, or as .opd";
        return Err(FORMAT.header("X Size x Y Size", found, allowed));
    }
    let place = |i: usize| i % columns * rows + rows - 1 - i / columns;
    let heights = (0..columns * rows).map(|i| grid.values[place(i)]).collect();
    let aspect = number("Aspect", 3)?.unwrap_or(1.0);
    let pixel = number("Pixel_size", 3)?.map(|size| [size * MILLIMETRE, size * MILLIMETRE * aspect]);
    let spacing = pixel.map_or(Spacing::Unknown, Spacing::Metres);
    let unit_said = if unit == NANOMETRE { "nm" } else { "waves" };
    let notes = vec![format!(
        "text of Wyko Vision: a line for each x, heights in {unit_said}, pixels from Pixel_size and Aspect"
    )];
    Ok(Measured { columns, rows, heights, spacing, spacing_error: 0.0, height_unit: Some(unit), notes })
}

/// Surfer's text grid: numbers of nodes, ranges of x, y and z, then the heights, from the lowest y up, in
/// lines of any length.
fn surfer(text: &str, request: &Request<'_>) -> Result<Measured, ReadError> {
    const FORMAT: Format = Format("Surfer DSAA");
    let mut words = text.split_whitespace().skip(1);
    let mut number = |name: &'static str| {
        let word = words.next().unwrap_or("nothing");
        word.parse::<f64>()
            .ok()
            .filter(|v| v.is_finite())
            .ok_or_else(|| FORMAT.header(name, word, "it must be a number"))
    };
    let counts = [number("columns")?, number("rows")?];
    let ranges = [[number("lowest x")?, number("highest x")?], [number("lowest y")?, number("highest y")?]];
    let _range_of_heights = [number("lowest z")?, number("highest z")?];
    if let Some(count) = counts.iter().find(|count| **count < 2.0 || count.fract() != 0.0) {
        return Err(FORMAT.header("number of nodes", count, "it must be a whole number above 1"));
    }
    let count = FORMAT.nodes_within(counts[0] as u64, counts[1] as u64, 8, request)?;
    // blanked nodes are 1.70141e38
    let is_missing = |z: f64| !z.is_finite() || z.abs() >= 1e37 || Some(z) == request.missing_value;
    let heights: Result<Vec<f64>, ReadError> = words
        .map(|word| {
            let z: f64 = word.parse().map_err(|_| FORMAT.header("a height", word, "it must be a number"))?;
            Ok(if is_missing(z) { f64::NAN } else { z })
        })
        .collect();
    let heights = heights?;
    if heights.len() != count {
        let found = format!("{} x {}, but {} heights follow", counts[0], counts[1], heights.len());
        return Err(FORMAT.header("columns x rows", found, "each node has a height: export the grid again"));
    }
    let step =
        |k: usize| FORMAT.positive("range of x or y", (ranges[k][1] - ranges[k][0]) / (counts[k] - 1.0));
    Ok(Measured {
        columns: counts[0] as usize,
        rows: counts[1] as usize,
        heights,
        spacing: Spacing::HeightUnits([step(0)?, step(1)?]),
        spacing_error: 0.0,
        height_unit: None,
        notes: vec!["text grid of Surfer, x and y taken in the unit of the heights".into()],
    })
}
