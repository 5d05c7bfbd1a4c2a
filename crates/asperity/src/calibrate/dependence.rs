//! `asperity calibrate --dependence`: c for both laws, both tools and parts of the range of metals.

use crate::cli::calibrate::{Calibrate, solve};
use crate::cli::folder::Folder;
use crate::cli::progress::Progress;
use crate::cli::terminal;
use crate::error::Error;
use crate::output::SinkExt;
use asperity_calibration::case::Tool;
use asperity_calibration::fit::{DEVELOPED, Slope};
use asperity_calibration::row::{HEADER, Row};
use asperity_calibration::sensitivity::{Line, lines, sweeps};
use asperity_calibration::sweep::Sweep;
use asperity_roughness::PUBLISHED;
use serde_json::json;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Runs the four sweeps, each with a journal of its own, and writes `dependence.csv` and their rows.
///
/// # Errors
/// A disk that refuses; finished cases stay in the journals.
pub fn run(args: &Calibrate) -> Result<(), Error> {
    let accuracy = args.scene_flags.accuracy.unwrap_or_default();
    let target = args.run.out.clone().unwrap_or_else(|| PathBuf::from("out/dependence"));
    let mut folder = Folder::create(&target, "calibrate", args.run.force)?;
    let threads = args.run.threads.map_or(0, usize::from);
    let (mut table, mut journals) = (Vec::new(), Vec::new());
    for sweep in sweeps(accuracy) {
        let name = name_of(&sweep);
        let path = journal_of(&target.join(&name), &target);
        let rows = match solve(
            &sweep.cases(),
            &sweep,
            &path,
            threads,
            args.run.quiet,
            Progress::new(args.run.quiet),
        ) {
            Ok(rows) => rows,
            Err(failure) => {
                folder.abandon();
                return Err(failure);
            }
        };
        write_rows(&mut folder, &format!("cases-{name}.csv"), &rows)?;
        table.push((sweep, lines(&rows)));
        journals.push(path);
    }
    let csv = csv(&table);
    folder.write("dependence.csv", |out| out.write_all(csv.as_bytes()))?;
    folder.publish()?;
    for path in journals {
        let _ = std::fs::remove_file(path);
    }
    if args.run.json {
        let text = serde_json::to_string_pretty(&json(&table));
        terminal::say(&text.map_err(|e| Error::Unfinished(e.to_string()))?);
    } else if !args.run.quiet {
        terminal::say(text(&table).trim_end());
        terminal::say(&format!("results   {}", target.display()));
    }
    Ok(())
}

fn tool_name(tool: Tool) -> &'static str {
    match tool {
        Tool::Plane => "crush",
        Tool::Cone => "indentation",
    }
}

fn name_of(sweep: &Sweep) -> String {
    format!("{}-{}", tool_name(sweep.tool), sweep.hardening_law.name())
}

/// Beside the results: `<folder>.<sweep>.journal`.
fn journal_of(sweep: &Path, target: &Path) -> PathBuf {
    let mut name = target.file_name().unwrap_or_default().to_os_string();
    name.push(".");
    name.push(sweep.file_name().unwrap_or_default());
    crate::cli::folder::journal_beside(&target.with_file_name(name))
}

fn write_rows(folder: &mut Folder, name: &str, rows: &[Row]) -> Result<(), Error> {
    let mut table = format!("{HEADER}\n");
    for row in rows {
        let _ = writeln!(table, "{}", row.to_csv());
    }
    folder.write(name, |out| out.write_all(table.as_bytes()))
}

fn csv(table: &[(Sweep, Vec<Line>)]) -> String {
    let mut text = String::from(
        "tool,hardening_law,n_least,n_largest,E_over_sy_least,E_over_sy_largest,c,low,high,c_developed,low_developed,high_developed\n",
    );
    let columns = |s: Option<Slope>| {
        s.map_or(",,".to_string(), |s| format!("{:.5},{:.5},{:.5}", s.c, s.ci95[0], s.ci95[1]))
    };
    for (sweep, lines) in table {
        for line in lines {
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{},{}",
                tool_name(sweep.tool),
                sweep.hardening_law.name(),
                line.exponents[0],
                line.exponents[1],
                line.ratios[0],
                line.ratios[1],
                columns(line.all),
                columns(line.developed)
            );
        }
    }
    text
}

fn json(table: &[(Sweep, Vec<Line>)]) -> serde_json::Value {
    let slope = |s: Option<Slope>| s.map(|s| json!({ "coefficient": s.c, "ci95": s.ci95 }));
    let lines = table.iter().flat_map(|(sweep, lines)| {
        lines.iter().map(move |line| {
            json!({
                "tool": sweep.tool,
                "law": sweep.hardening_law,
                "hardening_exponent": line.exponents,
                "modulus_over_yield_stress": line.ratios,
                "all": slope(line.all),
                "developed": slope(line.developed),
            })
        })
    });
    json!({ "published": PUBLISHED, "lines": lines.collect::<Vec<_>>() })
}

/// The table as markdown.
fn text(table: &[(Sweep, Vec<Line>)]) -> String {
    let mut text =
        format!("| tool, law | n | E/σ_y | c (95 %) | c where E* tan β/σ_r ≥ {DEVELOPED} |\n|-|-|-|-|-|\n");
    let slope = |s: Option<Slope>| {
        s.map_or("not determined".to_string(), |s| format!("{:.3} ({:.3}-{:.3})", s.c, s.ci95[0], s.ci95[1]))
    };
    for (sweep, lines) in table {
        for line in lines {
            let _ = writeln!(
                text,
                "| {}, {} | {}-{} | {}-{} | {} | {} |",
                tool_name(sweep.tool),
                sweep.hardening_law.name(),
                line.exponents[0],
                line.exponents[1],
                line.ratios[0],
                line.ratios[1],
                slope(line.all),
                slope(line.developed)
            );
        }
    }
    let indentation = "published: Tabor and Johnson 0.2, Bucaille 0.105 (indentation)";
    let _ = writeln!(text, "{indentation}, Jourani {PUBLISHED} (crush)");
    text
}
