//! `trade.csv`, and the few lines of it that a person reads.

use super::errors::Row;
use super::settings::Knob;
use asperity_solver::scene::{ContactMethod, ElementChoice, Numerics};
use std::io::{self, Write};

/// The columns of `trade.csv`.
const HEADER: &str = "knob,around,element,elements_in_contact,steps,contact,penetration,newton_tolerance,domain,force_error,area_error,residual_depth_error,elastic_fraction_error,wall_s,core_s,newton_iterations,dofs,peak_memory_MB,estimated_error,on_front,status";

/// A number, or nothing.
fn cell<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(String::new, |v| v.to_string())
}

/// The numbers of a setting, in the order of the columns.
fn numbers(n: &Numerics) -> String {
    let element = n.element.map(|e| match e {
        ElementChoice::Q8r => "q8r",
        ElementChoice::Q4 => "q4",
    });
    let contact = n.contact.map(|c| match c {
        ContactMethod::Penalty => "penalty",
        ContactMethod::Augmented => "augmented",
    });
    [
        cell(element),
        cell(n.elements_in_contact),
        cell(n.steps),
        cell(contact),
        cell(n.penetration),
        cell(n.newton_tolerance),
        cell(n.domain),
    ]
    .join(",")
}

/// Writes `trade.csv`: errors relative, times in seconds; `status` is `ok` or the reason why there are no errors.
///
/// # Errors
/// A full disk.
pub fn write(out: &mut dyn Write, rows: &[Row]) -> io::Result<()> {
    writeln!(out, "{HEADER}")?;
    for row in rows {
        let around =
            if row.setting.knob == Knob::Mixed { String::new() } else { row.setting.around.to_string() };
        write!(out, "{},{around},{}", row.setting.knob.name(), numbers(&row.setting.numerics))?;
        match &row.outcome {
            Ok((run, errors)) => writeln!(
                out,
                ",{},{},{},{},{},{},{},{},{},{},{},ok",
                errors.force,
                errors.area,
                cell(errors.residual_depth),
                cell(errors.elastic_fraction),
                run.wall_s,
                run.core_s,
                run.newton_iterations,
                run.dofs,
                cell(run.peak_memory_mb),
                cell(run.estimated_error),
                row.on_front,
            )?,
            // a comma or a line break would end the column
            Err(reason) => writeln!(out, ",,,,,,,,,,,false,{}", reason.replace([',', '\n', '"'], ";"))?,
        }
    }
    Ok(())
}

/// The rows of `trade.csv` as a JSON array of objects, its columns as keys; an empty cell is null.
///
/// # Errors
/// None that a table in memory has.
pub fn json(rows: &[Row]) -> io::Result<String> {
    let mut text = Vec::new();
    write(&mut text, rows)?;
    let value = |cell: &str| match cell {
        "" => serde_json::Value::Null,
        "true" | "false" => (cell == "true").into(),
        _ => cell.parse::<f64>().map_or_else(|_| cell.into(), serde_json::Value::from),
    };
    let columns: Vec<&str> = HEADER.split(',').collect();
    let mut objects: Vec<serde_json::Map<String, serde_json::Value>> = Vec::new();
    for record in csv::Reader::from_reader(text.as_slice()).records() {
        let record = record.map_err(io::Error::other)?;
        objects.push(columns.iter().zip(record.iter()).map(|(k, v)| ((*k).into(), value(v))).collect());
    }
    Ok(serde_json::to_string_pretty(&objects)?)
}

/// The levels, then the front of the force, cheapest first, as a Markdown table that reads well as text too.
pub fn overview(rows: &[Row]) -> String {
    let mut cells = vec![
        ["setting", "error of F, %", "stated, %", "core s", "iterations", "unknowns"].map(String::from),
        std::array::from_fn(|_| "-".into()),
    ];
    let mut add = |name: String, row: &Row| {
        if let Ok((run, errors)) = &row.outcome {
            cells.push([
                name,
                format!("{:.2}", 100.0 * errors.force),
                run.estimated_error.map_or(String::new(), |stated| format!("{:.2}", 100.0 * stated)),
                format!("{:.2}", run.core_s),
                run.newton_iterations.to_string(),
                run.dofs.to_string(),
            ]);
        }
    };
    let cost = |row: &&Row| row.outcome.as_ref().map_or(f64::INFINITY, |(run, _)| run.core_s);
    let sorted = |chosen: &dyn Fn(&Row) -> bool| {
        let mut chosen: Vec<&Row> = rows.iter().filter(|r| chosen(r)).collect();
        chosen.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        chosen
    };
    for row in sorted(&|r| r.setting.knob == Knob::Level) {
        add(format!("`{}`", row.setting.around), row);
    }
    for row in sorted(&|r| r.on_front && r.setting.knob != Knob::Level) {
        let n = &row.setting.numerics;
        let element = if n.element == Some(ElementChoice::Q4) { "q4" } else { "q8r" };
        // the penalty goes without saying
        let contact = match n.contact {
            Some(ContactMethod::Augmented) => ", augmented Lagrange",
            _ => "",
        };
        let name = format!(
            "front: {element}{contact}, {} elements, {} steps, penetration {}, tolerance {}, domain {}",
            cell(n.elements_in_contact),
            cell(n.steps),
            cell(n.penetration),
            cell(n.newton_tolerance),
            cell(n.domain)
        );
        add(name, row);
    }
    let widths: [usize; 6] =
        std::array::from_fn(|i| cells.iter().map(|row| row[i].chars().count()).max().unwrap_or(0));
    let line = |row: &[String; 6]| {
        let padded = row.iter().zip(widths).enumerate().map(|(i, (text, width))| match (text.as_str(), i) {
            ("-", 0) => "-".repeat(width),
            ("-", _) => format!("{}:", "-".repeat(width - 1)),
            (_, 0) => format!("{text:<width$}"),
            _ => format!("{text:>width$}"),
        });
        format!("| {} |", padded.collect::<Vec<_>>().join(" | "))
    };
    cells.iter().map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::super::case::Measured;
    use super::super::errors::Errors;
    use super::super::settings::Setting;
    use super::*;
    use asperity_solver::scene::Accuracy;

    #[test]
    fn a_run_and_a_failure_fill_the_same_columns() {
        let setting = Setting { knob: Knob::Mesh, around: Accuracy::Draft, numerics: Numerics::default() };
        let run = Measured {
            loading: Vec::new(),
            residual_depth: None,
            elastic_fraction: None,
            estimated_error: Some(0.04),
            newton_iterations: 7,
            dofs: 9,
            wall_s: 0.5,
            core_s: 0.25,
            peak_memory_mb: None,
        };
        let errors = Errors { force: 0.03, area: 0.1, residual_depth: None, elastic_fraction: None };
        let outcomes = [Ok((run, errors)), Err("stopped, \"inside out\"".to_string())];
        let rows = outcomes.map(|outcome| Row { setting, outcome, on_front: false });
        let mut text = Vec::new();
        write(&mut text, &rows).unwrap();
        let text = String::from_utf8(text).unwrap();
        let columns = HEADER.split(',').count();
        assert!(text.lines().all(|line| line.split(',').count() == columns), "{text}");
        assert!(text.ends_with("stopped; ;inside out;\n"), "{text}");
    }
}
