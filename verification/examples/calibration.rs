//! The calibration of `asperity calibrate` beside itself at `reference`, sharp cones of another code, the
//! elastic cone, the other lengths of a cone, and steep indentation.
//!
//! `cargo run --release -p asperity-verification --example calibration --
//! random|peers|elastic|lengths|indentation [--out FILE]`, or `-- published FILE.csv SLOPE_DEG` for a file of
//! published indentations by a cone of that slope. The tables are `verification/results/calibration-*.md`,
//! one a word.

// on committed cases
#![allow(clippy::expect_used)]

use asperity_calibration::case::{Case, Tool};
use asperity_calibration::fit::SplitMix;
use asperity_calibration::loading_curvature::{self, LoadingCurvature};
use asperity_calibration::row::Row;
use asperity_calibration::solve_case::solve;
use asperity_calibration::sweep::Sweep;
use asperity_material::{HardeningLaw, StressMeasure};
use asperity_simulation::scene::Accuracy;
use asperity_simulation::setup::discretisation::ConeDiscretisation;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::calibration::{PEERS, metal, peer_case};
use asperity_verification::report::Report;
use rayon::prelude::*;

fn all(cases: &[Case], accuracy: Accuracy) -> Vec<LoadingCurvature> {
    let one = |case: &Case| {
        let row = solve(case, accuracy, &Analyses::default());
        tell(&row);
        row.outcome.expect("committed cases run")
    };
    cases.par_iter().with_max_len(1).map(one).collect()
}

/// Progress of long tables.
#[allow(clippy::print_stderr)]
fn tell(row: &Row) {
    eprintln!("{} in {:.1} s", Row::key(&row.case), row.wall_s);
}

/// 24 of the 480 cases, drawn with a fixed seed, at both levels.
fn random(report: &mut Report) {
    for (tool, title) in [(Tool::Plane, "Crushed by a plane"), (Tool::Cone, "As a tool in a flat body")] {
        report.section(title);
        let mut cases = Sweep { tool, ..Sweep::default() }.cases();
        let mut draw = SplitMix(24);
        let drawn: Vec<Case> =
            (0..36).map(|_| cases.swap_remove((draw.bits() % cases.len() as u64) as usize)).collect();
        let (standard, reference) = (all(&drawn, Accuracy::Standard), all(&drawn, Accuracy::Reference));
        report.table("| β | n | E/σ_y | K/E standard | K/E reference | difference, % | stated, % |");
        let (mut within, mut sum) = (0, 0.0);
        for ((case, s), r) in drawn.iter().zip(&standard).zip(&reference) {
            let difference = s.k_over_e / r.k_over_e - 1.0;
            within += usize::from(difference.abs() <= s.error);
            sum += difference;
            let y = case.yielding.expect("the default sweep yields");
            report.line(&format!(
                "| {} | {} | {:.1} | {:.4} | {:.4} | {:+.2} | {:.2} |",
                case.beta_deg,
                y.exponent,
                y.e_over_sy,
                s.k_over_e,
                r.k_over_e,
                100.0 * difference,
                100.0 * s.error
            ));
        }
        report.line(&format!(
            "\n{within} of {} within the stated error, mean difference {:+.2} %.",
            drawn.len(),
            100.0 * sum / drawn.len() as f64
        ));
    }
}

/// The ten cones of CalculiX.
fn peers(report: &mut Report) {
    let cases: Vec<Case> = PEERS.iter().map(peer_case).collect();
    let (standard, reference) = (all(&cases, Accuracy::Standard), all(&cases, Accuracy::Reference));
    report.table(
        "| β | n | E/σ_y | K/E standard | reference | CalculiX | difference, % | allowed, % | reference, % | Cauchy's stress, % |",
    );
    for ((p, s), r) in PEERS.iter().zip(&standard).zip(&reference) {
        let case = peer_case(p);
        let resolution = case.discretisation(Accuracy::Standard);
        let cauchy = loading_curvature::solve(
            &Case { stress_measure: StressMeasure::Cauchy, ..case },
            &resolution,
            &Analyses::default(),
        )
        .expect("committed cases run");
        let off = |k: &LoadingCurvature| 100.0 * (k.k_over_e / p.k_over_e - 1.0);
        report.line(&format!(
            "| {} | {} | {} | {:.4} | {:.4} | {:.4} | {:+.2} | {:.2} | {:+.2} | {:+.2} |",
            p.beta_deg,
            p.exponent,
            p.e_over_sy,
            s.k_over_e,
            r.k_over_e,
            p.k_over_e,
            off(s),
            100.0 * (s.error + p.error + 0.005),
            off(r),
            off(&cauchy)
        ));
    }
}

/// Elastic cones against Sneddon.
fn elastic(report: &mut Report) {
    report.table("| tool | E/σ_y | K/E | over Sneddon, % | a tan β/h over 2/π, % |");
    for tool in [Tool::Plane, Tool::Cone] {
        for yielding in [None, Some(metal(HardeningLaw::Hollomon, 0.3, 10.0))] {
            let case = Case {
                beta_deg: 1.0,
                yielding,
                poissons_ratio: 0.3,
                tool,
                stress_measure: StressMeasure::Kirchhoff,
                friction: None,
            };
            let k = loading_curvature::solve(
                &case,
                &case.discretisation(Accuracy::Standard),
                &Analyses::default(),
            )
            .expect("runs");
            let sneddon = std::f64::consts::FRAC_2_PI * case.elastic().reduced_modulus() / case.tan_beta();
            report.line(&format!(
                "| {tool:?} | {} | {:.3} | {:+.2} | {:+.2} |",
                if yielding.is_some() { "10" } else { "elastic" },
                k.k_over_e,
                100.0 * (k.k_over_e / sneddon - 1.0),
                100.0 * (k.contact_ratio / std::f64::consts::FRAC_2_PI - 1.0)
            ));
        }
    }
}

/// K against the lengths that a sharp cone on a half space does not have.
fn lengths(report: &mut Report) {
    let cases = [(3.0, 0.1, 300.0), (10.0, 0.5, 1050.0)].map(|(beta_deg, n, ratio)| Case {
        beta_deg,
        yielding: Some(metal(HardeningLaw::Hollomon, n, ratio)),
        poissons_ratio: 0.3,
        tool: Tool::Plane,
        stress_measure: StressMeasure::Kirchhoff,
        friction: None,
    });
    type Change = fn(&mut ConeDiscretisation);
    let changes: [(&str, Change); 10] = [
        ("as standard", |_| ()),
        ("summit rounded over 0.1 a", |r| r.sizes.rounding = 0.1),
        ("summit rounded over 0.2 a", |r| r.sizes.rounding = 0.2),
        ("height: base radius 2 a", |r| r.sizes.foot = 2.0),
        ("height: base radius 4 a", |r| r.sizes.foot = 4.0),
        ("height: base radius 16 a", |r| r.sizes.foot = 16.0),
        ("substrate 50 a", |r| r.numbers.domain = 50.0),
        ("substrate 200 a", |r| r.numbers.domain = 200.0),
        ("substrate 400 a", |r| r.numbers.domain = 400.0),
        ("substrate 1600 a", |r| r.numbers.domain = 1600.0),
    ];
    report.table("| | K, 3°, n 0.1, E/σ_y 300, % | K, 10°, n 0.5, E/σ_y 1050, % |");
    let k = |case: &Case, change: Change| {
        let mut resolution = case.discretisation(Accuracy::Standard);
        change(&mut resolution);
        loading_curvature::solve(case, &resolution, &Analyses::default()).expect("runs").k_over_e
    };
    for (name, change) in changes {
        let off = cases.each_ref().map(|case| 100.0 * (k(case, change) / k(case, |_| ()) - 1.0));
        report.line(&format!("| {name} | {:+.2} | {:+.2} |", off[0], off[1]));
    }
}

/// Steep cones, with the stress of the law as Kirchhoff's (what the program computes) and as Cauchy's.
fn indentation(report: &mut Report) {
    let ratios = [100.0 / 3.0, 100.0, 1000.0 / 3.0];
    report.table("| β | n | E/σ_y | K/E | K_error, % | with Cauchy's stress, % |");
    for beta_deg in [19.7, 30.0, 40.0] {
        for exponent in [0.0, 0.1, 0.3, 0.5] {
            for ratio in ratios {
                let case = Case {
                    beta_deg,
                    yielding: Some(metal(HardeningLaw::Swift, exponent, ratio)),
                    poissons_ratio: 0.3,
                    tool: Tool::Cone,
                    stress_measure: StressMeasure::Kirchhoff,
                    friction: None,
                };
                let resolution = case.discretisation(Accuracy::Standard);
                let k = loading_curvature::solve(&case, &resolution, &Analyses::default()).expect("runs");
                let cauchy = loading_curvature::solve(
                    &Case { stress_measure: StressMeasure::Cauchy, ..case },
                    &resolution,
                    &Analyses::default(),
                )
                .expect("runs")
                .k_over_e;
                report.line(&format!(
                    "| {beta_deg} | {exponent} | {ratio:.1} | {:.4} | {:.2} | {:+.2} |",
                    k.k_over_e,
                    100.0 * k.error,
                    100.0 * (cauchy / k.k_over_e - 1.0)
                ));
            }
        }
    }
}

/// Mean and standard deviation of the difference of K from a file of published indentations, in percent, with
/// either stress: columns `Case,n,E (GPa),sy (GPa),C (GPa)`, C the curvature F/h².
fn published(report: &mut Report, file: &str, beta_deg: f64) {
    let text = std::fs::read_to_string(file).expect("the file named can be read");
    let number = |field: &str| field.trim().parse::<f64>().ok();
    let metals: Vec<[f64; 3]> = text
        .lines()
        .filter_map(|line| {
            let fields: Vec<f64> = line.split(',').skip(1).map_while(number).collect();
            // n, E/σ_y, K/E
            (fields.len() >= 4).then(|| [fields[0], fields[1] / fields[2], fields[3] / fields[1]])
        })
        .collect();
    let difference = |[exponent, ratio, k_over_e]: &[f64; 3], stress_measure: StressMeasure| {
        let yielding = Some(metal(HardeningLaw::Swift, *exponent, *ratio));
        let case = Case {
            beta_deg,
            yielding,
            poissons_ratio: 0.3,
            tool: Tool::Cone,
            stress_measure,
            friction: None,
        };
        let resolution = case.discretisation(Accuracy::Standard);
        100.0
            * (loading_curvature::solve(&case, &resolution, &Analyses::default()).expect("runs").k_over_e
                / k_over_e
                - 1.0)
    };
    let half = metals.len().div_ceil(2);
    let differences: Vec<[f64; 2]> = std::thread::scope(|scope| {
        let threads: Vec<_> = metals
            .chunks(half)
            .map(|part| {
                let solve = |m: &[f64; 3]| {
                    [difference(m, StressMeasure::Kirchhoff), difference(m, StressMeasure::Cauchy)]
                };
                scope.spawn(move || part.iter().map(solve).collect::<Vec<_>>())
            })
            .collect();
        threads.into_iter().flat_map(|t| t.join().expect("no case panics")).collect()
    });
    report.table("| n | metals | Kirchhoff's stress, % | Cauchy's stress, % |");
    for exponent in [None, Some(0.0), Some(0.1), Some(0.3), Some(0.5)] {
        let own = || {
            let pairs = metals.iter().zip(&differences);
            pairs.filter(|(m, _)| exponent.is_none_or(|n| m[0] == n)).map(|(_, d)| *d)
        };
        let count = own().count() as f64;
        let [kirchhoff, cauchy] = [0, 1].map(|i| {
            let mean = own().map(|d| d[i]).sum::<f64>() / count;
            let variance = own().map(|d| (d[i] - mean).powi(2)).sum::<f64>() / (count - 1.0);
            format!("{mean:+.1} ± {:.1}", variance.sqrt())
        });
        let name = exponent.map_or("all".to_string(), |n| n.to_string());
        report.line(&format!("| {name} | {count} | {kirchhoff} | {cauchy} |"));
    }
}

fn main() {
    let (mut report, words) = Report::of_example("calibration", "standard");
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["random"] => random(&mut report),
        ["peers"] => peers(&mut report),
        ["elastic"] => elastic(&mut report),
        ["lengths"] => lengths(&mut report),
        ["indentation"] => indentation(&mut report),
        ["published", file, slope] => {
            published(&mut report, file, slope.parse().expect("the slope is a number of degrees"));
        }
        _ => panic!("one of random, peers, elastic, lengths, indentation, or published FILE.csv SLOPE_DEG"),
    }
    report.finish().expect("the file named can be written");
}
