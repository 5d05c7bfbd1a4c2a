//! Properties of fits over twins by finite elements at `reference`, and the cones that these are made of.

use crate::book::{Book, identified};
use asperity_verification::report::Report;
use asperity_verification::twins::{Cone, Properties, Twin, properties};
use rayon::prelude::*;

/// Writes `count` cones by finite elements at `reference`, of which twins are made.
pub fn cones(report: &mut Report, count: usize) {
    report.table(&Cone::head());
    let rows: Vec<String> =
        (0..count).into_par_iter().with_max_len(1).filter_map(|i| Some(Cone::solved(i)?.row())).collect();
    rows.iter().for_each(|row| report.line(row));
}

/// Most that an added unknown may narrow an interval, of its width, and raise the minimised sum of squares.
const MOST: [f64; 2] = [0.02, 0.1];
/// Most of the median half width over the median absolute error.
const MOST_WIDTH: f64 = 5.0;
/// Least share of intervals that cover.
const LEAST_COVER: f64 = 0.9;

/// Writes the properties of the fits of `count` twins.
pub fn section(report: &mut Report, book: &Book, count: usize) {
    report.section("What holds whatever is sought beside the metal");
    if count == 0 {
        report.line("Not run.");
        return;
    }
    let cones = Cone::computed();
    let folder = std::env::temp_dir().join(concat!("asperity-properties-", env!("CARGO_PKG_VERSION")));
    std::fs::create_dir_all(&folder).expect("can be made");
    let one = |i: usize| {
        let twin = Twin::new(&cones, i)?;
        let file = format!("twin-{i}.csv");
        std::fs::write(folder.join(&file), twin.curve()).expect("can be written");
        properties(&twin, &file, &|fit| book.recall(fit, || identified(&file, fit, &folder)))
    };
    let found: Vec<Properties> = (0..count).into_par_iter().with_max_len(1).filter_map(one).collect();
    report.table("| property | of the twins | asked | reached |");
    let mut line = |what: &str, value: String, asked: &str, reached: bool| {
        report.line(&format!("| {what} | {value} | {asked} | {} |", if reached { "yes" } else { "no" }));
    };
    let all = found.len();
    let within = |pick: fn(&Properties) -> f64, most: f64| found.iter().filter(|p| pick(p) <= most).count();
    let largest = |pick: fn(&Properties) -> f64| found.iter().map(pick).fold(f64::NEG_INFINITY, f64::max);
    let fits = found.iter().filter(|p| p.fits).count();
    line("the right model fits", format!("{fits} of {all}"), "all", fits == all);
    for (k, name) in ["E", "σ_y", "n"].iter().enumerate() {
        let covers = found.iter().filter(|p| p.covers[k]).count();
        let reached = covers as f64 >= LEAST_COVER * all as f64;
        line(&format!("the interval of {name} covers"), format!("{covers} of {all}"), "90 %", reached);
    }
    let narrowed = |p: &Properties| p.narrowed;
    let value = format!("{} of {all}, worst {:.1} %", within(narrowed, MOST[0]), 100.0 * largest(narrowed));
    let reached = largest(narrowed) <= MOST[0];
    line("an added unknown narrows no interval by more than 2 % of its width", value, "all", reached);
    let raised = |p: &Properties| p.raised;
    let value = format!("{} of {all}, worst {:+.2}", within(raised, MOST[1]), largest(raised));
    line("an added unknown raises χ² by no more than 0.1", value, "all", largest(raised) <= MOST[1]);
    let median = |k: usize| {
        let mut all: Vec<f64> = found.iter().map(|p| p.of_the_yield_stress[k].abs()).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
    };
    let ratio = median(1) / median(0);
    let value = format!("{:.0} % over {:.0} %: {ratio:.1}", 100.0 * median(1), 100.0 * median(0));
    line("median half width of σ_y over its median error", value, "5", ratio <= MOST_WIDTH);
}
