//! The correction of a pyramid that is taken as a cone: its formulas fitted to published simulations of
//! Berkovich's pyramid over the program's cones, what they leave out, and fits of pyramids with and without.

use crate::Book;
use crate::beside::indented;
use crate::book::Solved;
use crate::cases::{Case, DEPTH, material, of_aluminium, rows};
use crate::score::{ANY, Bound, HEAD, Row, line};
use asperity_simulation::scene::Accuracy;
use asperity_verification::report::Report;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Answers: loading curvature over E, unloading slope over E h, returned share of the work.
type Answers = [f64; 3];

const NAMES: [&str; 3] = ["loading curvature", "unloading slope", "returned work"];

/// Plastic strain of the stress in the formulas.
const STRAIN: f64 = 0.033;

/// A published simulation.
struct Simulation {
    youngs_modulus: f64,
    yield_stress: f64,
    exponent: f64,
    answers: Answers,
    /// Answers of the program under the cone of the same section, at `reference`.
    cone: Answers,
    /// Numbers of that cone that were published with it.
    published_cone: Option<Answers>,
}

impl Simulation {
    /// ln(E/(100 σ_y)) and ln(σ/σ_y).
    fn place(&self) -> [f64; 2] {
        let ratio = self.youngs_modulus / self.yield_stress;
        [(ratio / 100.0).ln(), self.exponent * (1.0 + STRAIN * ratio).ln()]
    }

    /// Terms of the formula of number `i`.
    fn terms(&self, i: usize) -> Vec<f64> {
        let [elastic, hardening] = self.place();
        if i == 0 { vec![1.0, elastic, hardening] } else { vec![1.0, elastic - hardening] }
    }
}

/// Hardening exponent of a row; that of case 1002 is printed with a zero too many, as its cones show.
fn exponent(row: &HashMap<String, f64>) -> f64 {
    row["n"] * if row["Case"] == 1002.0 { 10.0 } else { 1.0 }
}

fn answers(row: &HashMap<String, f64>) -> Answers {
    let modulus = row["E (GPa)"];
    // GPa times µm is kN/m
    [row["C (GPa)"] / modulus, 1e-3 * row["dP/dh (N/m)"] / (modulus * DEPTH), 1.0 - row["Wp/Wt"]]
}

fn simulations(folder: &Path, book: &Book) -> Vec<Simulation> {
    let cones = folder.join("FEM_70deg.csv");
    let cones = if cones.exists() { rows(&cones) } else { Vec::new() };
    let one = |row: &HashMap<String, f64>| {
        let (modulus, stress, exponent) = (row["E (GPa)"], row["sy (GPa)"], exponent(row));
        let like = |cone: &&HashMap<String, f64>| cone["Case"] == row["Case"];
        Some(Simulation {
            youngs_modulus: modulus,
            yield_stress: stress,
            exponent,
            answers: answers(row),
            cone: indented(book, modulus / stress, exponent, 19.7, Accuracy::Reference)?,
            published_cone: cones.iter().find(like).map(answers),
        })
    };
    rows(&folder.join("Berkovich.csv")).par_iter().with_max_len(1).filter_map(one).collect()
}

/// A formula through all simulations.
struct Fitted {
    coefficients: DVector<f64>,
    /// Measured less expected at each simulation by the formula fitted without it.
    left_out: DVector<f64>,
    /// Expectation of the formula of all less that of the formula without each.
    moved: DVector<f64>,
}

impl Fitted {
    /// Through `goal` by least squares; a residual over what the others determine is that of leaving it out.
    fn new(terms: &[Vec<f64>], goal: &DVector<f64>) -> Option<Fitted> {
        let matrix = DMatrix::from_fn(terms.len(), terms[0].len(), |i, j| terms[i][j]);
        let inverse = matrix.tr_mul(&matrix).try_inverse()?;
        let coefficients = &inverse * matrix.tr_mul(goal);
        let rest = goal - &matrix * &coefficients;
        let own = (&matrix * inverse * matrix.transpose()).diagonal();
        let left_out = rest.zip_map(&own, |rest, own| rest / (1.0 - own));
        Some(Fitted { coefficients, moved: &left_out - &rest, left_out })
    }

    fn rms(&self) -> f64 {
        (self.left_out.norm_squared() / self.left_out.len() as f64).sqrt()
    }
}

/// Writes the formulas of pyramids over the program's cones and over the published ones.
fn formulas(report: &mut Report, all: &[Simulation]) -> Option<[Fitted; 3]> {
    report.section("Pyramids over cones");
    report.line(
        "100 ln(pyramid/cone) = a + b ln(E/(100 σ_y)) + c ln(σ/σ_y), σ at a plastic strain of 0.033.\n",
    );
    report.table("| number | over cones | simulations | a | b | c | left out, rms | worst | by a constant alone, rms | mean |");
    let own: Vec<Fitted> = (0..3).filter_map(|i| formula(report, all, i, false)).collect();
    if all.iter().all(|s| s.published_cone.is_some()) {
        (0..3).for_each(|i| drop(formula(report, all, i, true)));
        report.section("Published cones over the program's");
        report.table("| number | mean, % | from | to |");
        for (i, name) in NAMES.iter().enumerate() {
            let over = |s: &Simulation| Some(100.0 * (s.published_cone?[i] / s.cone[i]).ln());
            let over: Vec<f64> = all.iter().filter_map(over).collect();
            let ends =
                over.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |e, x| [e[0].min(*x), e[1].max(*x)]);
            let mean = over.iter().sum::<f64>() / over.len() as f64;
            report.line(&format!("| {name} | {mean:+.2} | {:+.2} | {:+.2} |", ends[0], ends[1]));
        }
    }
    own.try_into().ok()
}

/// Fits number `i` over the program's cones or the `published` ones, and writes its row.
fn formula(report: &mut Report, all: &[Simulation], i: usize, published: bool) -> Option<Fitted> {
    let cone = |s: &Simulation| if published { s.published_cone.unwrap_or(s.cone) } else { s.cone };
    let ratios: Vec<f64> = all.iter().map(|s| 100.0 * (s.answers[i] / cone(s)[i]).ln()).collect();
    let goal = DVector::from_vec(ratios);
    let fitted = Fitted::new(&all.iter().map(|s| s.terms(i)).collect::<Vec<_>>(), &goal)?;
    let constant = Fitted::new(&vec![vec![1.0]; all.len()], &goal)?;
    let [a, b] = [fitted.coefficients[0], fitted.coefficients[1]];
    // E over the stress at the strain has one coefficient for both
    let c = fitted.coefficients.get(2).copied().unwrap_or(-b);
    report.line(&format!(
        "| {} | {} | {} | {a:+.2} | {b:+.2} | {c:+.2} | {:.2} | {:.2} | {:.2} | {:+.2} |",
        NAMES[i],
        if published { "published" } else { "the program's" },
        all.len(),
        fitted.rms(),
        fitted.left_out.amax(),
        constant.rms(),
        goal.mean()
    ));
    Some(fitted)
}

/// Input of a fit of a simulation.
#[derive(Clone, Copy, PartialEq)]
struct Given {
    slope: bool,
    modulus: bool,
}

/// A fit of simulation `s`, whose logarithms are `moved` by what the correction owes to it.
fn case(s: &Simulation, given: Given, tool: &str, moved: [f64; 3]) -> Case {
    let (e, sy) = (s.youngs_modulus, 1e3 * s.yield_stress);
    let [curvature, slope, share]: [f64; 3] = std::array::from_fn(|i| s.answers[i] * moved[i].exp());
    let known = format!("\"{e} GPa\"");
    let modulus = if given.modulus { known.as_str() } else { "[\"5 GPa\", \"500 GPa\"]" };
    let slope = if given.slope {
        format!("unloading_slope = \"{} N/m\", ", 1e3 * slope * e * DEPTH)
    } else {
        String::new()
    };
    let fit = material(modulus, 0.3, ["10 MPa", "10 GPa"])
        + &format!(
            "[[curve]]\nfeatures = {{ loading_curvature = \"{} GPa\", {slope}plastic_work_ratio = {}, max_depth = \"{DEPTH} um\" }}\n{tool}noise = \"0.5 %\"\n",
            curvature * e,
            1.0 - share
        );
    Case {
        name: format!("E {e} GPa, σ_y {sy} MPa, n {}", s.exponent),
        youngs_modulus: e,
        yield_stress: sy,
        exponent: s.exponent,
        stresses: Vec::new(),
        fit,
        folder: PathBuf::new(),
    }
}

const PYRAMID: &str = "tool = { shape = \"berkovich\" }\n";
/// The tool without the correction, with a model error in its place.
const CONE: &str = "tool = { shape = \"cone\", half_apex_deg = 70.3 }\nmodel_error = \"4 %\"\n";

/// Writes the formulas, and fits of the simulations and of indents with and without them.
pub fn section(report: &mut Report, folder: &Path, book: &Book) {
    let all = simulations(folder, book);
    let Some(fitted) = formulas(report, &all) else { return };
    report.section("Metals of the published simulations");
    report.table(HEAD);
    let best = |solved: &[Solved]| -> Vec<Row> { solved.iter().map(Solved::best_identified).collect() };
    for (slope, modulus, given) in [
        (false, true, "curvature and work, E known"),
        (true, true, "curvature, work, slope, E known"),
        (true, false, "curvature, work, slope, E sought"),
    ] {
        let given_numbers = Given { slope, modulus };
        let moved = |k: usize| fitted.each_ref().map(|f| 0.01 * f.moved[k]);
        let cases = |tool: &str, corrected: bool| -> Vec<Case> {
            let moved = |k| if corrected { moved(k) } else { [0.0; 3] };
            all.iter().enumerate().map(|(k, s)| case(s, given_numbers, tool, moved(k))).collect()
        };
        let bound = Bound { mean: 2.0, covers: [90.0, 100.0], asked: "2 mean, covers 90", ..ANY };
        let what = "the stress told best";
        line(
            report,
            &format!("cone with 4 %, {given}"),
            what,
            &best(&book.solve(cases(CONE, false))),
            all.len(),
            &ANY,
        );
        let solved = book.solve(cases(PYRAMID, true));
        line(report, &format!("corrected without it, {given}"), what, &best(&solved), all.len(), &bound);
    }
    aluminium(report, folder, book);
}

/// Writes fits of indents in aluminium, which have no part in the formulas.
fn aluminium(report: &mut Report, folder: &Path, book: &Book) {
    report.section("Berkovich indents in aluminium");
    report.table(HEAD);
    for metal in ["Al6061", "Al7075"] {
        let file = folder.join(format!("{metal}.csv"));
        if !file.exists() {
            continue;
        }
        for (name, tool, with_slope) in [
            ("cone with 4 %", CONE, true),
            ("corrected", PYRAMID, true),
            ("cone with 4 %, without slope", CONE, false),
            ("corrected, without slope", PYRAMID, false),
        ] {
            let solved = book.solve(of_aluminium(&file, tool, with_slope));
            let work = format!("{metal}, {name}");
            for strain in [0.033, 0.1] {
                let rows: Vec<Row> =
                    solved.iter().map(|s| (s.case.stress(strain), s.stress(strain))).collect();
                line(report, &work, &format!("stress at ε_p {strain}"), &rows, solved.len(), &ANY);
            }
            let yields: Vec<Row> =
                solved.iter().map(|s| (s.case.yield_stress, s.parameter("yield_stress"))).collect();
            line(report, &work, "σ_y", &yields, solved.len(), &ANY);
        }
    }
}
