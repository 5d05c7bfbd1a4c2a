//! Growth of one Newton iteration, its memory and a whole loading with the number of unknowns, on the single
//! asperity.
//!
//! `cargo run --release -p asperity-verification --example scaling [-- --out FILE]`; the table is
//! `verification/results/scaling.md`. Each mesh runs in a process of its own, so that its peak memory is its
//! own.
#![allow(clippy::print_stdout, reason = "the child tells its parent")]

use asperity_numerics::least_squares::Line;
use asperity_numerics::newton::System;
use asperity_simulation::load_path::Path;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::report::{Report, timed};
use asperity_verification::single_asperity::{FRACTION, STEPS, finely_meshed};
use std::error::Error;
use std::process::Command;

/// Elements across the contact, for 3,000 to 300,000 unknowns and once beyond.
const ELEMENTS: [usize; 8] = [40, 64, 104, 168, 272, 440, 580, 710];

/// Peak resident memory of this process, MB.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kilobytes| kilobytes / 1024.0)
}

/// Prints unknowns, operations of a factorisation, seconds of assembly, factorisation and solution of one
/// iteration at the peak, seconds and iterations of the whole loading, and memory, separated by blanks.
fn one(elements: usize) -> Result<(), Box<dyn Error + Send + Sync>> {
    let problem = finely_meshed(elements)?;
    let mut path = Path::new(&problem, &Analyses::default())?;
    path.settings.tolerance = 1e-5;
    let (end, whole) = timed(|| path.load(&mut |_, _| true));
    end?;
    let iterations = path.counts.iterations;
    let model = &mut path.model;
    let before = model.state().displacement.to_vec();
    let travel = FRACTION * problem.depth * (1.0 + problem.numbers.penetration);
    model.begin(-travel, 0.0, |node| before[node].map(|u| 0.1 * u));
    let repeats = 5;
    let mut least = [f64::INFINITY; 3];
    for _ in 0..repeats {
        let c = model.counters;
        let (assembly, factor, solution) = (c.assembly_s, c.factor_s, c.solve_s);
        model.assess(true)?;
        model.renew()?;
        model.find_direction();
        let c = model.counters;
        for (least, seconds) in
            least.iter_mut().zip([c.assembly_s - assembly, c.factor_s - factor, c.solve_s - solution])
        {
            *least = least.min(seconds);
        }
    }
    let memory = peak_memory().unwrap_or(f64::NAN);
    let unknowns = model.body().analysis.dofs.count;
    let operations = model.operations().factor;
    println!("{unknowns} {operations} {} {} {} {whole} {iterations} {memory}", least[0], least[1], least[2]);
    Ok(())
}

/// Exponent of `y` in `x` between two rows.
fn exponent(x: [f64; 2], y: [f64; 2]) -> f64 {
    (y[1] / y[0]).ln() / (x[1] / x[0]).ln()
}

/// Least-squares slope of the logarithm of column `column` over that of the first one.
fn slope(rows: &[[f64; 3]], column: usize) -> f64 {
    let points: Vec<[f64; 2]> = rows.iter().map(|row| [row[0].ln(), row[column].ln()]).collect();
    Line::fit(&points).slope
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let (mut report, words) = Report::of_example("scaling", "reference, on one core");
    if let Some(elements) = words.first() {
        return one(elements.parse()?);
    }
    report.table(
        &format!("| unknowns | operations of factorising | assembly ms | factorise ms | solve ms | iteration ms | exponent | {STEPS} steps s | iterations | memory MB | exponent |"),
    );
    let mut rows: Vec<[f64; 3]> = Vec::new();
    for elements in ELEMENTS {
        let output = Command::new(std::env::current_exe()?).arg(elements.to_string()).output()?;
        let text = String::from_utf8(output.stdout)?;
        let numbers: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
        let [unknowns, operations, assembly, factor, solution, whole, iterations, memory] = numbers[..]
        else {
            return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
        };
        let iteration = assembly + factor + solution;
        let row = [unknowns, iteration, memory];
        let [time, space] = match rows.last() {
            Some(last) => [1, 2].map(|i| format!("{:.2}", exponent([last[0], row[0]], [last[i], row[i]]))),
            None => [String::new(), String::new()],
        };
        report.line(&format!(
            "| {unknowns} | {operations:.2e} | {:.2} | {:.2} | {:.2} | {:.2} | {time} | {whole:.2} | {iterations} | {memory:.0} | {space} |",
            1e3 * assembly,
            1e3 * factor,
            1e3 * solution,
            1e3 * iteration
        ));
        rows.push(row);
    }
    for count in [rows.len() - 1, rows.len()] {
        let rows = &rows[..count];
        report.line(&format!(
            "\nFrom {} to {} unknowns, by least squares: an iteration costs unknowns^{:.2}, memory unknowns^{:.2}.",
            rows[0][0],
            rows[count - 1][0],
            slope(rows, 1),
            slope(rows, 2)
        ));
    }
    Ok(report.finish()?)
}
