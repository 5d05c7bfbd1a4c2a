//! Tables as instruments write them: comma, semicolon, tab or blanks between columns, decimal commas, a
//! preamble, units in the header or in the line below it, several tests side by side, below each other or
//! under a number.

/// Depth and force, m and N, as they were read, one after the other in time.
pub type Readings = Vec<[f64; 2]>;

/// A table with its tests.
#[derive(Clone, Debug, PartialEq)]
pub struct Tests {
    /// Name and readings of each test, SI.
    pub tests: Vec<(String, Readings)>,
}

/// The reason why a table cannot be read: the line (from 1) where it has one, and a sentence with a way out.
#[derive(Clone, Debug, PartialEq)]
pub struct TableError {
    /// Line, from 1.
    pub line: Option<usize>,
    /// The sentence.
    pub message: String,
}

const DEPTHS: [&str; 8] =
    ["depth", "displacement", "indentation depth", "penetration", "indentation", "travel", "disp", "h"];
const FORCES: [&str; 5] = ["force", "load", "p", "f", "normal force"];
const TESTS: [&str; 5] = ["test", "specimen", "indent", "run", "sample"];
/// Units of depth and of force with their SI values; micro is written in three ways.
const LENGTHS: [(&str, f64); 7] =
    [("pm", 1e-12), ("nm", 1e-9), ("um", 1e-6), ("µm", 1e-6), ("μm", 1e-6), ("mm", 1e-3), ("m", 1.0)];
const WEIGHTS: [(&str, f64); 9] = [
    ("nn", 1e-9),
    ("un", 1e-6),
    ("µn", 1e-6),
    ("μn", 1e-6),
    ("mn", 1e-3),
    ("n", 1.0),
    ("kn", 1e3),
    ("gf", 9.80665e-3),
    ("mgf", 9.80665e-6),
];

/// One pair of columns: number, and SI value of one unit.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair {
    depth: (usize, f64),
    force: (usize, f64),
}

/// A column of the header.
#[derive(Clone, Debug, PartialEq)]
enum Column {
    Depth(Option<f64>),
    Force(Option<f64>),
    Test,
    Other,
}

/// Reads the tests of `text`.
///
/// # Errors
/// No columns of depth and force, units that are missing or unknown, cells that are no numbers.
pub fn read(text: &str) -> Result<Tests, TableError> {
    let lines: Vec<(usize, &str)> = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim_start_matches('\u{feff}').trim()))
        .filter(|(_, line)| !line.starts_with(['#', '%']))
        .collect();
    let mut tests: Vec<(String, Readings)> = Vec::new();
    let mut rest = &lines[..];
    while let Some(head) = rest.iter().position(|(_, line)| is_header(line)) {
        let body = &rest[head + 1..];
        let end = body.iter().position(|(_, line)| is_header(line)).unwrap_or(body.len());
        block(rest[head], &body[..end], &mut tests)?;
        rest = &body[end..];
    }
    if tests.iter().all(|(_, readings)| readings.is_empty()) {
        if let Some((line, _)) = lines.iter().find(|(_, line)| is_header(line)) {
            return Err(TableError {
                line: Some(*line),
                message: "is a header without readings below it: give a row of numbers for each reading"
                    .into(),
            });
        }
        return Err(TableError {
            line: lines.iter().find(|(_, line)| !line.is_empty()).map(|(i, _)| *i),
            message: "has no header that names a depth and a force with their units: write a first line like depth_um,force_mN, or Depth (nm);Load (mN)".into(),
        });
    }
    tests.retain(|(_, readings)| !readings.is_empty());
    Ok(Tests { tests })
}

fn separator(line: &str) -> char {
    ['\t', ';', ','].into_iter().find(|s| line.contains(*s)).unwrap_or(' ')
}

fn cells(line: &str, separator: char) -> Vec<String> {
    let clean = |cell: &str| cell.trim().trim_matches('"').trim().to_string();
    if separator == ' ' {
        // a unit in brackets belongs to the name before it
        let mut cells: Vec<String> = Vec::new();
        for word in line.split_whitespace() {
            match cells.last_mut() {
                Some(last) if word.starts_with(['(', '[']) => *last += word,
                _ => cells.push(clean(word)),
            }
        }
        cells
    } else {
        line.split(separator).map(clean).collect()
    }
}

fn is_header(line: &str) -> bool {
    let columns: Vec<Column> = cells(line, separator(line)).iter().map(|cell| column(cell)).collect();
    columns.iter().any(|c| matches!(c, Column::Depth(_)))
        && columns.iter().any(|c| matches!(c, Column::Force(_)))
}

/// A name in lower case, and the unit that stands with it: `depth_um`, `Depth (nm)`, `Load [mN]`, `h/nm`.
fn split_unit(cell: &str) -> (String, String) {
    let cell = cell.trim();
    let open = cell.find(['(', '[']);
    let (name, unit) = match open {
        Some(i) => (&cell[..i], cell[i + 1..].trim_end_matches([')', ']'])),
        None => match cell.rfind(['_', '/']) {
            Some(i) if unit_of(&cell[i + 1..]).is_some() => (&cell[..i], &cell[i + 1..]),
            _ => (cell, ""),
        },
    };
    let name = name.trim().to_lowercase().replace('_', " ");
    // "Depth 2" is the depth of the second test
    let name = name.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.' || c == ' ').to_string();
    (name, unit.trim().to_string())
}

fn unit_of(unit: &str) -> Option<()> {
    (length(unit).is_some() || weight(unit).is_some()).then_some(())
}

fn length(unit: &str) -> Option<f64> {
    LENGTHS.iter().find(|(name, _)| *name == unit).map(|(_, scale)| *scale)
}

fn weight(unit: &str) -> Option<f64> {
    // MN and mN differ by their case alone: meganewtons are not measured so
    WEIGHTS.iter().find(|(name, _)| *name == unit.to_lowercase()).map(|(_, scale)| *scale)
}

fn column(cell: &str) -> Column {
    let (name, unit) = split_unit(cell);
    let exact = |names: &[&str]| names.contains(&name.as_str());
    let starts = |names: &[&str]| {
        names
            .iter()
            .any(|n| n.len() > 3 && name.starts_with(n) && !name.contains("rate") && !name.contains("nodal"))
    };
    if exact(&TESTS) {
        Column::Test
    } else if exact(&DEPTHS) || starts(&DEPTHS[..6]) {
        Column::Depth(length(&unit))
    } else if exact(&FORCES) || starts(&FORCES[..2]) {
        Column::Force(weight(&unit))
    } else {
        Column::Other
    }
}

/// Reads the lines below one header.
fn block(
    (at, header): (usize, &str),
    body: &[(usize, &str)],
    tests: &mut Vec<(String, Readings)>,
) -> Result<(), TableError> {
    let mark = separator(header);
    let names = cells(header, mark);
    let mut body = body;
    // units may have a line of their own
    let below: Option<Vec<String>> = body.first().map(|(_, line)| cells(line, mark));
    let units =
        below.filter(|cells| cells.iter().any(|c| unit_of(c.trim_matches(['(', ')', '[', ']'])).is_some()));
    if units.is_some() {
        body = &body[1..];
    }
    let columns: Vec<Column> = names
        .iter()
        .enumerate()
        .map(|(i, name)| {
            let unit = units.as_ref().and_then(|u| u.get(i)).map(|u| u.trim_matches(['(', ')', '[', ']']));
            match (column(name), unit) {
                (Column::Depth(None), Some(unit)) => Column::Depth(length(unit)),
                (Column::Force(None), Some(unit)) => Column::Force(weight(unit)),
                (other, _) => other,
            }
        })
        .collect();
    let pairs = pairs(at, &names, &columns)?;
    let test = columns.iter().position(|c| *c == Column::Test);
    let first = tests.len();
    for (line, text) in body {
        if text.is_empty() {
            continue;
        }
        let row = cells(text, mark);
        let more = row.get(names.len()..).filter(|more| mark == ',' && more.iter().any(|c| !c.is_empty()));
        if let Some(more) = more {
            return Err(TableError {
                line: Some(*line),
                message: format!(
                    "has {} cells below {} of the header: decimal commas need columns that semicolons or tabs separate; else give every column a name",
                    names.len() + more.len(),
                    names.len()
                ),
            });
        }
        for (k, pair) in pairs.iter().enumerate() {
            let Some(point) = point(*line, &row, pair, mark)? else { continue };
            let label = match test.and_then(|t| row.get(t)) {
                Some(label) => label.clone(),
                None => format!("{}", first + k + 1),
            };
            match tests[first..].iter_mut().find(|(name, _)| *name == label) {
                Some((_, readings)) => readings.push(point),
                None => tests.push((label, vec![point])),
            }
        }
    }
    Ok(())
}

/// The columns of `what`, those that `unit_of` knows, with their units. One without a unit, like the error of
/// a force, is left out beside one with.
fn of_known_unit(
    at: usize,
    names: &[String],
    what: &str,
    units: &str,
    unit_of: &dyn Fn(usize) -> Option<Option<f64>>,
) -> Result<Vec<(usize, f64)>, TableError> {
    let all: Vec<(usize, Option<f64>)> =
        (0..names.len()).filter_map(|i| unit_of(i).map(|unit| (i, unit))).collect();
    let known: Vec<(usize, f64)> = all.iter().filter_map(|(i, unit)| Some((*i, (*unit)?))).collect();
    match all.first() {
        Some((i, _)) if known.is_empty() => Err(TableError {
            line: Some(at),
            message: format!(
                "the {what} \"{}\" has no unit that is known: write it in the header, one of {units}, like {what}_{}",
                names[*i],
                units.split(", ").nth(2).unwrap_or(units)
            ),
        }),
        _ => Ok(known),
    }
}

/// The pairs of depth and force, each force with the depth before or after it.
fn pairs(at: usize, names: &[String], columns: &[Column]) -> Result<Vec<Pair>, TableError> {
    let depths = of_known_unit(at, names, "depth", "pm, nm, um, mm, m", &|i| match columns[i] {
        Column::Depth(unit) => Some(unit),
        _ => None,
    })?;
    let forces = of_known_unit(at, names, "force", "nN, uN, mN, N, kN, gf", &|i| match columns[i] {
        Column::Force(unit) => Some(unit),
        _ => None,
    })?;
    // one depth may serve several forces only where there are as many of both
    let count = if depths.len() == forces.len() { depths.len() } else { 1 };
    Ok(depths.into_iter().zip(forces).take(count).map(|(depth, force)| Pair { depth, force }).collect())
}

/// The point of a row; `None` where its cells are empty or the row is a note.
fn point(line: usize, row: &[String], pair: &Pair, mark: char) -> Result<Option<[f64; 2]>, TableError> {
    let cell = |(i, _): (usize, f64)| row.get(i).map_or("", String::as_str);
    let (depth, force) = (cell(pair.depth), cell(pair.force));
    if depth.is_empty() || force.is_empty() {
        return Ok(None);
    }
    let number = |text: &str| {
        let text = if mark == ',' { text.to_string() } else { text.replace(',', ".") };
        text.parse::<f64>().map_err(|_| TableError {
            line: Some(line),
            message: format!(
                "\"{text}\" is no number: leave out rows that are no readings, or begin them with #"
            ),
        })
    };
    Ok(Some([number(depth)? * pair.depth.1, number(force)? * pair.force.1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-12 * b.abs()
    }

    #[test]
    fn tables_of_many_makers_are_read() {
        for text in [
            "depth_um,force_mN\n0.1,2\n0.2,8\n",
            "Depth (nm),Load (mN)\n100,2\n200,8\n",
            "Instrument X\nDate;today\nDisplacement [nm];Load [uN]\n100,0;2000,0\n200,0;8000,0\n",
            "\u{feff}Time\tDepth\tForce\ns\tnm\tmN\n0\t100\t2\n1\t200\t8\n",
            "# a note\nh/nm P/mN\n100 2\n200 8\n",
            "increment,phase,depth_um,force_N,contact_area_um2,force_nodal_N,force_error\n1,load,0.1,0.002,1,3,0.01\n2,load,0.2,0.008,1,3,0.01\n",
        ] {
            let tests = read(text).unwrap().tests;
            assert_eq!(tests.len(), 1, "{text}");
            let [a, b] = [tests[0].1[0], tests[0].1[1]];
            assert!(
                is_near(a[0], 1e-7) && is_near(a[1], 2e-3) && is_near(b[0], 2e-7) && is_near(b[1], 8e-3),
                "{text} {tests:?}"
            );
        }
    }

    #[test]
    fn several_tests_are_told_apart() {
        for text in [
            "Depth 1 (nm),Load 1 (mN),Depth 2 (nm),Load 2 (mN)\n100,2,50,1\n200,8,,\n",
            "depth_nm,force_mN\n100,2\n200,8\n\ndepth_nm,force_mN\n50,1\n",
            "test,depth_nm,force_mN\n1,100,2\n1,200,8\n2,50,1\n",
        ] {
            let tests = read(text).unwrap().tests;
            assert_eq!(tests.iter().map(|t| t.1.len()).collect::<Vec<_>>(), [2, 1], "{text}");
        }
    }

    #[test]
    fn what_cannot_be_read_names_the_line_and_a_way_out() {
        for (text, line, word) in [
            ("depth,force\n1,2\n", 1, "unit"),
            ("a\nDepth (furlong),Load (mN)\n1,2\n", 2, "furlong"),
            ("depth_um,force_mN\n1,2\n1,x\n", 3, "no number"),
            ("1,2\n3,4\n", 1, "header"),
            ("depth_um,force_mN\n\n", 1, "without readings"),
            ("depth_um,force_mN\n0,1,0,2\n0,2,0,8\n", 2, "decimal commas"),
        ] {
            let fault = read(text).unwrap_err();
            assert!(fault.line == Some(line) && fault.message.contains(word), "{fault:?}");
        }
    }
}
