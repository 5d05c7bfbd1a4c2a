//! The atlas of cones: sharp cones drawn by the rule of `asperity_calibration::cones`, loaded and unloaded at
//! `standard`.
//!
//! `cargo run --release -p asperity-verification --example cone_atlas -- COMMAND`:
//! * `grow FOLDER COUNT [--shard K/N] [--seconds S]`: solves those of the first COUNT cones that neither the
//!   committed file nor a journal of FOLDER holds, each a line of a journal, so that a killed run goes on
//!   where it was. After S seconds no cone is begun.
//! * `pack FOLDER`: joins the committed file and the journals of FOLDER to the committed file,
//!   `verification/results/atlas.csv.gz`.
//! * `check FOLDER COUNT [--shard K/N] [--seconds S]`: the same as `grow` for cones between those of the
//!   atlas, at `reference`; `pack-check FOLDER` joins them to `verification/results/atlas-check.csv.gz`.
//! * `renew --out FILE`: fits the formula of `asperity_material::cone_atlas` to the committed file, writes
//!   its coefficients, and the tables of `verification/results/atlas.md`: cones left out of the fit, and
//!   those of `check` against it.

// on committed cases
#![allow(clippy::expect_used, clippy::print_stderr)]

use asperity::batch::journal::Journal;
use asperity_calibration::cones::Row;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::atlas::{self, Set};
use asperity_verification::report::{Report, replace};
use asperity_verification::{atlas_fit, atlas_table};
use std::path::Path;
use std::time::{Duration, Instant};

fn main() {
    let (report, words) = Report::of_example("cone_atlas", "standard");
    let word = |i: usize| words.get(i).map(String::as_str);
    let folder = || Path::new(word(1).expect("a folder"));
    let count = || word(2).and_then(|count| count.parse().ok()).expect("how many cones");
    match word(0) {
        Some("grow") => grow(Set::Atlas, folder(), count(), &words),
        Some("check") => grow(Set::Fresh, folder(), count(), &words),
        Some("pack") => pack(Set::Atlas, folder()),
        Some("pack-check") => pack(Set::Fresh, folder()),
        Some("renew") => renew(report),
        _ => panic!("grow, pack, check, pack-check or renew"),
    }
}

/// The value behind `flag`.
fn flag<'a>(words: &'a [String], flag: &str) -> Option<&'a str> {
    words.iter().position(|word| word == flag).and_then(|i| words.get(i + 1)).map(String::as_str)
}

fn grow(set: Set, folder: &Path, count: usize, words: &[String]) {
    let (part, parts) = flag(words, "--shard").map_or((1, 1), |shard| {
        let (part, parts) = shard.split_once('/').expect("K/N");
        (part.parse().expect("K"), parts.parse().expect("N"))
    });
    let seconds = flag(words, "--seconds").map_or(u64::MAX, |s| s.parse().expect("seconds"));
    let clock = Instant::now();
    std::fs::create_dir_all(folder).expect("the folder");
    let mut rows = atlas::committed(set);
    rows.extend(atlas::journals(set, folder));
    let mut known = vec![false; count];
    rows.iter().filter(|row| row.index < count).for_each(|row| known[row.index] = true);
    let path = folder.join(set.journal(part, parts));
    let mut journal = Journal::open(&path, set.identity()).expect("the journal").journal;
    let analyses = Analyses::default();
    for index in (part - 1..count).step_by(parts).filter(|&index| !known[index]) {
        if clock.elapsed() > Duration::from_secs(seconds) {
            break;
        }
        let begun = Instant::now();
        let row = Row::solve(index, &set.cone(index), set.accuracy(), &analyses);
        journal.append(&row.line()).expect("room on the disk");
        eprintln!("{:.2} s {}", begun.elapsed().as_secs_f64(), row.line());
    }
}

fn renew(mut report: Report) {
    let rows = atlas::committed(Set::Atlas);
    let cones = atlas_fit::solved(&rows);
    let fit = atlas_fit::fit(&cones).expect("enough cones");
    atlas_table::write(&mut report, &rows, &cones, &fit);
    replace(Path::new(FORMULA), fit.atlas.text()).expect("can be written");
    report.finish().expect("can be written");
}

/// The coefficients that are compiled in.
const FORMULA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/material/data/atlas.txt");

fn pack(set: Set, folder: &Path) {
    let mut rows = atlas::committed(set);
    rows.extend(atlas::journals(set, folder));
    rows.sort_by_key(|row| row.index);
    rows.dedup_by_key(|row| row.index);
    atlas::write(set, &rows).expect("can be written");
    let failed = rows.iter().filter(|row| row.outcome.is_err()).count();
    eprintln!("{} cones, {failed} of them without a result", rows.len());
}
