//! Prints, as markdown tables, what the calibration of `asperity calibrate` was held against: itself at `reference`, sharp
//! cones of another code, the elastic cone, the other lengths of a cone, and steep indentation. The tables of
//! `verification/CALIBRATION.md` are this output.
//!
//! `cargo run --release -p asperity-verification --example calibration [random|peers|elastic|lengths|indentation]`

// a program whose output is the point, on committed cases
#![allow(clippy::print_stdout, clippy::expect_used)]

use asperity_calibration::case::{Case, Tool};
use asperity_calibration::fit::SplitMix;
use asperity_calibration::kick::{self, Kick};
use asperity_calibration::resolution::Resolution;
use asperity_calibration::row::Row;
use asperity_calibration::run::run;
use asperity_calibration::sweep::Sweep;
use asperity_law::HardeningLaw;
use asperity_solver::scene::Accuracy;
use asperity_verification::calibration::{PEERS, metal, peer_case};

fn all(cases: &[Case], accuracy: Accuracy) -> Vec<Kick> {
    let told = |row: &Row| {
        eprintln_row(row);
        Ok::<(), std::convert::Infallible>(())
    };
    let rows = run(cases, accuracy, Vec::new(), 0, told).expect("nothing can refuse");
    rows.into_iter().map(|row| row.outcome.expect("committed cases run")).collect()
}

/// Progress of long tables.
#[allow(clippy::print_stderr)]
fn eprintln_row(row: &Row) {
    eprintln!("{} in {:.1} s", Row::key(&row.case), row.wall_s);
}

/// 24 of the 480 cases, drawn with a fixed seed, at both levels.
fn random() {
    let mut cases = Sweep::default().cases();
    let mut draw = SplitMix(24);
    let drawn: Vec<Case> =
        (0..24).map(|_| cases.swap_remove((draw.bits() % cases.len() as u64) as usize)).collect();
    let (standard, reference) = (all(&drawn, Accuracy::Standard), all(&drawn, Accuracy::Reference));
    println!("| β | n | E/σ_y | K/E standard | K/E reference | difference, % | stated, % |\n|-|-|-|-|-|-|-|");
    let mut within = 0;
    for ((case, s), r) in drawn.iter().zip(&standard).zip(&reference) {
        let difference = s.k_over_e / r.k_over_e - 1.0;
        within += usize::from(difference.abs() <= s.error);
        let y = case.yielding.expect("the default sweep yields");
        println!(
            "| {} | {} | {:.1} | {:.4} | {:.4} | {:+.2} | {:.2} |",
            case.beta_deg,
            y.exponent,
            y.e_over_sy,
            s.k_over_e,
            r.k_over_e,
            100.0 * difference,
            100.0 * s.error
        );
    }
    println!("\n{within} of {} within the stated error.", drawn.len());
}

/// The ten cones of CalculiX.
fn peers() {
    let cases: Vec<Case> = PEERS.iter().map(peer_case).collect();
    let (standard, reference) = (all(&cases, Accuracy::Standard), all(&cases, Accuracy::Reference));
    println!(
        "| β | n | E/σ_y | K/E standard | reference | CalculiX | difference, % | allowed, % | reference, % |"
    );
    println!("|-|-|-|-|-|-|-|-|-|");
    for ((p, s), r) in PEERS.iter().zip(&standard).zip(&reference) {
        let case = peer_case(p);
        let resolution = Resolution { cauchy: true, ..Resolution::of(&case, Accuracy::Standard) };
        let cauchy = kick::solve(&case, &resolution).expect("committed cases run");
        let off = |k: &Kick| 100.0 * (k.k_over_e / p.k_over_e - 1.0);
        println!(
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
        );
    }
}

/// Elastic cones against Sneddon.
fn elastic() {
    println!("| tool | E/σ_y | K/E | over Sneddon, % | a tan β/h over 2/π, % |\n|-|-|-|-|-|");
    for tool in [Tool::Plane, Tool::Cone] {
        for yielding in [None, Some(metal(HardeningLaw::Hollomon, 0.3, 10.0))] {
            let case = Case { beta_deg: 1.0, yielding, poissons_ratio: 0.3, tool };
            let k = kick::solve(&case, &Resolution::of(&case, Accuracy::Standard)).expect("runs");
            let sneddon = std::f64::consts::FRAC_2_PI * case.elastic().reduced_modulus() / case.tan_beta();
            println!(
                "| {tool:?} | {} | {:.3} | {:+.2} | {:+.2} |",
                if yielding.is_some() { "10" } else { "elastic" },
                k.k_over_e,
                100.0 * (k.k_over_e / sneddon - 1.0),
                100.0 * (k.contact_ratio / std::f64::consts::FRAC_2_PI - 1.0)
            );
        }
    }
}

/// K against the lengths that a sharp cone on a half space does not have.
fn lengths() {
    let cases = [(3.0, 0.1, 300.0), (10.0, 0.5, 1050.0)].map(|(beta_deg, n, ratio)| Case {
        beta_deg,
        yielding: Some(metal(HardeningLaw::Hollomon, n, ratio)),
        poissons_ratio: 0.3,
        tool: Tool::Plane,
    });
    type Change = fn(&mut Resolution);
    let changes: [(&str, Change); 10] = [
        ("as standard", |_| ()),
        ("summit rounded over 0.1 a", |r| r.rounding = 0.1),
        ("summit rounded over 0.2 a", |r| r.rounding = 0.2),
        ("height: base radius 2 a", |r| r.foot = 2.0),
        ("height: base radius 4 a", |r| r.foot = 4.0),
        ("height: base radius 16 a", |r| r.foot = 16.0),
        ("substrate 50 a", |r| r.domain = 50.0),
        ("substrate 200 a", |r| r.domain = 200.0),
        ("substrate 400 a", |r| r.domain = 400.0),
        ("substrate 1600 a", |r| r.domain = 1600.0),
    ];
    println!("| | K, 3°, n 0.1, E/σ_y 300, % | K, 10°, n 0.5, E/σ_y 1050, % |\n|-|-|-|");
    let k = |case: &Case, change: fn(&mut Resolution)| {
        let mut resolution = Resolution::of(case, Accuracy::Standard);
        change(&mut resolution);
        kick::solve(case, &resolution).expect("runs").k_over_e
    };
    for (name, change) in changes {
        let off = cases.each_ref().map(|case| 100.0 * (k(case, change) / k(case, |_| ()) - 1.0));
        println!("| {name} | {:+.2} | {:+.2} |", off[0], off[1]);
    }
}

/// Steep cones, with the stress of the law as Kirchhoff's (what the program computes) and as Cauchy's.
fn indentation() {
    let ratios = [100.0 / 3.0, 100.0, 1000.0 / 3.0];
    println!("| β | n | E/σ_y | K/E | K_error, % | with Cauchy's stress, % |\n|-|-|-|-|-|-|");
    for beta_deg in [19.7, 30.0, 40.0] {
        for exponent in [0.0, 0.1, 0.3, 0.5] {
            for ratio in ratios {
                let case = Case {
                    beta_deg,
                    yielding: Some(metal(HardeningLaw::Swift, exponent, ratio)),
                    poissons_ratio: 0.3,
                    tool: Tool::Cone,
                };
                let resolution = Resolution::of(&case, Accuracy::Standard);
                let k = kick::solve(&case, &resolution).expect("runs");
                let cauchy =
                    kick::solve(&case, &Resolution { cauchy: true, ..resolution }).expect("runs").k_over_e;
                println!(
                    "| {beta_deg} | {exponent} | {ratio:.1} | {:.4} | {:.2} | {:+.2} |",
                    k.k_over_e,
                    100.0 * k.error,
                    100.0 * (cauchy / k.k_over_e - 1.0)
                );
            }
        }
    }
}

fn main() {
    let wish = std::env::args().nth(1);
    let tables: [(&str, fn()); 5] = [
        ("random", random),
        ("peers", peers),
        ("elastic", elastic),
        ("lengths", lengths),
        ("indentation", indentation),
    ];
    for (name, table) in tables {
        if wish.as_deref().is_none_or(|w| w == name) {
            println!("\n### {name}\n");
            table();
        }
    }
}
