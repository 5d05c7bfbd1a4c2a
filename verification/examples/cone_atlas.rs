//! The atlas of cones: sharp cones over slope, E/σ_y and n, loaded and unloaded at `standard`, ν 0.3, law `swift`, Cauchy's
//! stress. `identify` starts from it; its final answer is that of finite elements.
//!
//! `cargo run --release -p asperity-verification --example cone_atlas -- FILE.csv` adds the cones that the file lacks; the
//! committed file is `crates/calibration/data/cones.csv`.

// on committed cases
#![allow(clippy::expect_used, clippy::print_stderr)]

use asperity_calibration::atlas::{Cell, EXPONENTS, RATIOS, SLOPES};
use rayon::prelude::*;
use std::collections::HashSet;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::Path;
use std::sync::Mutex;

fn main() {
    let name = std::env::args().nth(1).expect("the file");
    let path = Path::new(&name);
    let known: HashSet<String> = std::fs::read_to_string(path)
        .unwrap_or_default()
        .lines()
        .map(|line| line.split(',').take(3).collect::<Vec<_>>().join(","))
        .collect();
    let mut file = OpenOptions::new().create(true).append(true).open(path).expect("can be written");
    if known.is_empty() {
        writeln!(file, "{}", Cell::HEADER).expect("can be written");
    }
    let file = Mutex::new(file);
    let mut open = Vec::new();
    for slope in SLOPES {
        for ratio in RATIOS {
            open.extend(EXPONENTS.map(|exponent| (slope, ratio, exponent)));
        }
    }
    open.retain(|(slope, ratio, exponent)| !known.contains(&format!("{slope},{ratio},{exponent}")));
    open.par_iter().with_max_len(1).for_each(|&(slope, ratio, exponent)| {
        match Cell::solve(slope, ratio, exponent) {
            Ok(cell) => writeln!(file.lock().expect("no panics"), "{}", cell.line()).expect("can be written"),
            Err(reason) => eprintln!("{slope} {ratio} {exponent}: {reason}"),
        }
    });
}
