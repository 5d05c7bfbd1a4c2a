//! Seconds in which a tangent of the single asperity is factorised and solved, and the tangent itself for
//! another program.
//!
//! `RAYON_NUM_THREADS=1 cargo run --release -p asperity-verification --example factorisation -- ELEMENTS
//! FOLDER` prints unknowns, and the least seconds of a factorisation and of a solve in double and in single
//! precision, separated by blanks. FOLDER then holds the lower triangle in little-endian numbers: `rows` and
//! `columns` of 64-bit integers, `values` and the right-hand side `rhs` of doubles. `scripts/renew
//! factorisation` sets it beside CHOLMOD.
#![allow(clippy::print_stdout, reason = "the program tells its parent")]

use asperity_numerics::newton::System;
use asperity_numerics::sparse::CsMat;
use asperity_numerics::sparse::cholesky::{Factor, Precision};
use asperity_simulation::load_path::Path;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::report::timed;
use asperity_verification::single_asperity::finely_meshed;
use std::error::Error;

/// Repetitions, of which the least seconds count.
const REPEATS: usize = 9;

/// Writes 8 bytes of each number.
fn write<T>(
    folder: &str,
    name: &str,
    numbers: impl Iterator<Item = T>,
    bytes: fn(T) -> [u8; 8],
) -> std::io::Result<()> {
    std::fs::write(std::path::Path::new(folder).join(name), numbers.flat_map(bytes).collect::<Vec<u8>>())
}

/// Least seconds of a factorisation and of a solve.
fn least(matrix: &CsMat<f64>, rhs: &[f64], precision: Precision) -> Result<[f64; 2], Box<dyn Error>> {
    let mut factor = Factor::new(matrix, precision);
    let mut least = [f64::INFINITY; 2];
    for _ in 0..REPEATS {
        let (done, factorised) = timed(|| factor.cholesky(matrix));
        done?;
        let mut solution = rhs.to_vec();
        let ((), solved) = timed(|| factor.solve(&mut solution));
        least = [least[0].min(factorised), least[1].min(solved)];
    }
    Ok(least)
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [elements, folder] = &words[..] else {
        return Err("give a number of elements and a folder".into());
    };
    let problem = finely_meshed(elements.parse()?).map_err(|e| e.to_string())?;
    let mut path = Path::new(&problem, &Analyses::default())?;
    path.load(&mut |_, _| true)?;
    path.model.assess(true)?;
    let matrix = path.model.stiffness();
    let triplets: Vec<(f64, (usize, usize))> = matrix.iter().map(|(v, at)| (*v, at)).collect();
    // any right-hand side: a solve takes the same time for all
    let rhs: Vec<f64> = (0..matrix.rows()).map(|row| 1.0 + (row % 7) as f64).collect();
    write(folder, "rows", triplets.iter().map(|(_, (row, _))| *row as u64), u64::to_le_bytes)?;
    write(folder, "columns", triplets.iter().map(|(_, (_, column))| *column as u64), u64::to_le_bytes)?;
    write(folder, "values", triplets.iter().map(|(value, _)| *value), f64::to_le_bytes)?;
    write(folder, "rhs", rhs.iter().copied(), f64::to_le_bytes)?;
    let [factor, solve] = least(matrix, &rhs, Precision::Double)?;
    let [single_factor, single_solve] = least(matrix, &rhs, Precision::Single)?;
    println!("{} {factor} {solve} {single_factor} {single_solve}", matrix.rows());
    Ok(())
}
