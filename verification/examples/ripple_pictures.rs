//! Pictures of what the ripple of the mesh does to the curve of the paper's asperity at `standard`, and what
//! is left of it:
//! `cargo run --release -p asperity-verification --example ripple_pictures -- [FOLDER] [--out FILE]`. FILE
//! gets a table of the same, FOLDER the pictures; without them the table is printed.
//!
//! "As found" is an increment before the run has ended: the sum of the nodal forces over the depth, and that
//! force over the area.

// a scene that is committed
#![allow(clippy::expect_used)]

use asperity::crush::{Crush, CurveRow, Phase, SurfacePoint, titled_plot};
use asperity::draw::chart::{Chart, Dash, Series, svg};
use asperity::simulation::record::curve::Curve;
use asperity::tables::Accuracy;
use asperity::units::{MEGAPASCAL, MICROMETRE};
use asperity::{Scene, crush};
use asperity_verification::report::Report;
use asperity_verification::single_asperity::scene;
use std::path::Path;

/// Depth in µm from which curves are compared: a fifth of the peak.
const FROM: f64 = 1.0;

/// A column of the curve.
type Column = fn(&CurveRow) -> f64;

/// A run with its increments as they were found and its surface at the peak.
struct Run {
    found: Vec<CurveRow>,
    result: Crush,
    surface: Vec<SurfacePoint>,
}

/// The asperity of the paper, without fields but the surface at the peak.
fn run(accuracy: Accuracy) -> Run {
    let mut tables = scene(accuracy).expect("the committed scene reads");
    tables.output.every = Some(1000);
    let scene = Scene::new(&tables).expect("a scene without contradictions");
    let (mut found, mut surface) = (Vec::new(), Vec::new());
    let result = crush(&scene, &mut |reached| {
        let Some(news) = reached.news else { return true };
        if let Some(frame) = news.frame {
            // of those before first touch, at the peak and at the end, the one under pressure
            if frame.surface.iter().any(|point| point.pressure > 0.0) {
                surface.clone_from(&frame.surface);
            }
        } else {
            found.push(*news.row);
        }
        true
    })
    .expect("the asperity of the paper can be crushed");
    Run { found, result, surface }
}

fn loading(rows: &[CurveRow]) -> impl Iterator<Item = &CurveRow> {
    rows.iter().filter(|row| row.phase == Phase::Load && row.depth > 0.0)
}

/// Depth in µm.
fn depth(row: &CurveRow) -> f64 {
    row.depth / MICROMETRE
}

/// A column over the depth while loading; NaN beyond its last row.
fn curve(rows: &[CurveRow], column: Column) -> Curve {
    Curve::new(loading(rows).map(|row| [depth(row), column(row)]))
}

/// Deviation of a column from that of the fine curve in percent, over the depth.
fn deviation(rows: &[CurveRow], fine: &[CurveRow], column: Column) -> Vec<[f64; 2]> {
    let fine = curve(fine, column);
    let counted = loading(rows).filter(|row| depth(row) >= FROM);
    let points =
        counted.map(|row| [depth(row), 100.0 * (column(row) / fine.logarithm_at(depth(row)).exp() - 1.0)]);
    points.filter(|point| point[1].is_finite()).collect()
}

/// Deviation in percent of the slope dF/dh from that of the fine curve, of the chord between two depths
/// around each row.
fn slopes(rows: &[CurveRow], fine: &[CurveRow], around: impl Fn(&[f64], usize) -> [f64; 2]) -> Vec<[f64; 2]> {
    let [own, fine] = [rows, fine].map(|rows| curve(rows, |row| row.force));
    let chord = |curve: &Curve, [low, high]: [f64; 2]| {
        (curve.logarithm_at(high).exp() - curve.logarithm_at(low).exp()) / (high - low)
    };
    let depths: Vec<f64> = loading(rows).map(depth).collect();
    let counted = (1..depths.len()).filter(|&i| depths[i - 1] >= FROM);
    let points = counted.map(|i| {
        let ends = around(&depths, i);
        [depths[i], 100.0 * (chord(&own, ends) / chord(&fine, ends) - 1.0)]
    });
    points.filter(|point| point[1].is_finite()).collect()
}

/// The same of unloading between 95 and 20 % of the peak, between each row and the next, at the forces of
/// both.
fn slopes_back(rows: &[CurveRow], fine: &[CurveRow]) -> Vec<[f64; 2]> {
    let back = |rows: &[CurveRow]| -> Vec<[f64; 2]> {
        let from = rows.iter().position(|row| row.phase == Phase::Unload).unwrap_or(rows.len()) - 1;
        rows[from..].iter().map(|row| [row.force, depth(row)]).collect()
    };
    let (fine, rows) = (back(fine), back(rows));
    let peak = fine[0][0];
    let depth = |force: f64| {
        let after = fine.iter().position(|[f, _]| *f <= force)?.max(1);
        let ([f, h], [g, k]) = (fine[after - 1], fine[after]);
        Some(h + (k - h) * (force - f) / (g - f))
    };
    let deviation = |pair: &[[f64; 2]]| {
        let [[f, h], [g, k]] = [pair[0], pair[1]];
        // a chord of the same share of the peak, however the peaks differ
        let scale = peak / rows[0][0];
        let theirs = (depth(f * scale)? - depth(g * scale)?) / scale;
        Some([k, 100.0 * (theirs / (h - k) - 1.0)])
    };
    let inside = |pair: &&[[f64; 2]]| pair.iter().all(|[f, _]| (0.2..=0.95).contains(&(f / rows[0][0])));
    rows.windows(2).filter(inside).filter_map(deviation).collect()
}

fn rms(points: &[[f64; 2]]) -> f64 {
    (points.iter().map(|[_, y]| y * y).sum::<f64>() / points.len() as f64).sqrt()
}

fn largest(points: &[[f64; 2]]) -> f64 {
    points.iter().fold(0.0, |most, [_, y]| most.max(y.abs()))
}

/// A row of the table: deviations as found and in the result.
fn row(name: &str, [before, after]: [&[[f64; 2]]; 2]) -> String {
    let cells = [rms(before), largest(before), rms(after), largest(after)];
    format!("| {name} | {} |", cells.map(|percent| format!("{percent:.2} %")).join(" | "))
}

fn save(folder: Option<&String>, name: &str, picture: &str) {
    if let Some(folder) = folder {
        std::fs::write(Path::new(folder).join(name), picture).expect("the folder can be written");
    }
}

/// Deviations of a column as found and in the result; only the force states an error in every row.
fn deviation_chart(name: &str, [before, after]: [Vec<[f64; 2]>; 2], stated: &[[f64; 2]]) -> String {
    let lower = stated.iter().rev().map(|[x, y]| [*x, -y]);
    let band: Vec<_> = stated.iter().copied().chain(lower).collect();
    let end = if band.is_empty() { "" } else { "; band: stated error" };
    let series = [
        Series { dash: Some(Dash::Dashed), ..Series::line("as found", before) }.marked(),
        Series { band, dash: Some(Dash::Solid), ..Series::line("result", after) }.marked(),
    ];
    let title = format!("{name} at standard, beside reference{end}");
    svg(&Chart::new("Depth h (µm)", "Deviation (%)", series).titled(title)).expect("a chart of numbers")
}

fn main() {
    let (mut report, words) = Report::of_example("ripple_pictures", "standard beside reference");
    let folder = words.first();
    let [standard, fine] = [Accuracy::Standard, Accuracy::Reference].map(run);
    let (found, result) = (&standard.found, &standard.result.curve);
    let force = titled_plot(&standard.result.summary, result).expect("a chart of numbers");
    save(folder, "single-force.svg", &force);

    let stated = loading(result)
        .filter(|row| depth(row) >= FROM)
        .filter_map(|row| Some([depth(row), 100.0 * row.force_error?]));
    let stated: Vec<[f64; 2]> = stated.collect();
    let columns: [(&str, Column, &[[f64; 2]]); 3] = [
        ("Force", |row| row.force, &stated),
        ("Contact area", |row| row.contact_area, &[]),
        ("Mean pressure", |row| row.mean_pressure, &[]),
    ];
    report.table("| at standard, beside reference | as found: root mean square | largest | result: root mean square | largest |");
    for (name, column, stated) in columns {
        let [before, after] = [found, result].map(|rows| deviation(rows, &fine.result.curve, column));
        report.line(&row(&name.to_lowercase(), [&before, &after]));
        let file = format!("single-ripple-{}.svg", name.to_lowercase().replace(' ', "-"));
        save(folder, &file, &deviation_chart(name, [before, after], stated));
    }

    let reference = &fine.result.curve;
    let single = |rows: &[CurveRow]| slopes(rows, reference, |depths, i| [depths[i - 1], depths[i]]);
    let around = |rows: &[CurveRow]| {
        slopes(rows, reference, |depths, i| {
            [0.97 * depths[i], (1.03 * depths[i]).min(depths[depths.len() - 1])]
        })
    };
    let back = |rows: &[CurveRow]| slopes_back(rows, reference);
    report.line(&row("slope dF/dh of single increments", [&single(found), &single(result)]));
    report.line(&row("slope over ±3 % of the depth", [&around(found), &around(result)]));
    report.line(&row("slope of unloading, 95 to 20 % of the peak", [&back(found), &back(result)]));

    let along = |run: &Run| {
        let off = run.surface.iter().position(|point| point.pressure <= 0.0).unwrap_or(run.surface.len());
        let touching = run.surface.iter().take(off + 1);
        touching.map(|point| [point.r / MICROMETRE, point.pressure / MEGAPASCAL]).collect::<Vec<_>>()
    };
    let series =
        [Series::line("standard", along(&standard)).marked(), Series::line("reference", along(&fine))];
    let chart = Chart::new("Radius r (µm)", "Contact pressure (MPa)", series)
        .titled("Pressure along the contact at the peak");
    save(folder, "single-pressure.svg", &svg(&chart).expect("a chart of numbers"));
    report.finish().expect("the file can be written");
}
