//! The tables of `results/atlas.md`: cones of the atlas, errors of its formula, and what it shows.

use crate::atlas::{self, Set};
use crate::atlas_fit::{Fit, Solved, differences, solved};
use crate::report::{Report, quantile};
use asperity_calibration::case::Tool;
use asperity_calibration::cones::Row;
use asperity_material::cone_atlas::{Atlas, Contact, ERRORS, SharpCone};
use asperity_material::{Elastic, Hardening, HardeningLaw};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_2_PI, PI};

/// The numbers of a cone that have errors of their own.
const NUMBERS: [&str; ERRORS] = ["K", "contact ratio", "S", "elastic share"];

/// Slope beyond which an indented body has linear elements, degrees.
const STEEP_SLOPE_DEG: f64 = 11.0;

/// Writes all of them.
pub fn write(report: &mut Report, rows: &[Row], cones: &[Solved], fit: &Fit) {
    held(report, rows, cones);
    left_out(report, rows, cones, fit);
    fresh(report, &fit.atlas);
    plateau(report, &fit.atlas);
    representative_strain(report, &fit.atlas);
}

fn held(report: &mut Report, rows: &[Row], cones: &[Solved]) {
    report.line(&format!(
        "{} cones at `standard`, {} of them without a result; {} of the rest stopped before their depth, after 0.65 of it or more.",
        rows.len(),
        rows.len() - cones.len(),
        rows.iter().filter(|row| row.outcome.as_ref().is_ok_and(|(found, _)| found.reached < 0.99)).count(),
    ));
    let mut reasons = BTreeMap::<&str, usize>::new();
    for row in rows {
        if let Err(reason) = &row.outcome {
            *reasons.entry(reason).or_default() += 1;
        }
    }
    reasons.iter().for_each(|(reason, count)| report.line(&format!("* {count}: {reason}")));
    let left = rows.iter().filter(|row| row.outcome.is_ok()).count() - cones.len();
    if left > 0 {
        report.line(&format!(
            "* {left}: sank in once more as the tool retreated, which the formula cannot hold"
        ));
    }
    report.line("");
    report.line("Errors that the cones state of themselves (95 %):\n");
    report.table("| | median | 95 % of the cones below |");
    for (k, name) in NUMBERS.iter().enumerate() {
        let of = |share| 100.0 * quantile(cones.iter().map(|c| c.errors[k]), share);
        report.line(&format!("| {name} | {:.2} % | {:.2} % |", of(0.5), of(0.95)));
    }
}

/// The cones of a line of the second table.
type Kind = (&'static str, fn(&Row) -> bool);

fn left_out(report: &mut Report, rows: &[Row], cones: &[Solved], fit: &Fit) {
    report.section("Cones left out");
    report.line(
        "Every fifth cone is predicted by the formula through the other four fifths: root mean square of the residual / 95 % of \
         the cones below. The residual holds the scatter of the cone itself.\n",
    );
    report.table("| cones | | K | contact ratio | S | elastic share |");
    let kinds: [Kind; 4] = [
        ("all", |_| true),
        ("crushed", |row| row.case.tool == Tool::Plane),
        ("under a cone to 11°", |row| row.case.tool == Tool::Cone && row.case.beta_deg <= STEEP_SLOPE_DEG),
        ("under a cone above 11°", |row| row.case.tool == Tool::Cone && row.case.beta_deg > STEEP_SLOPE_DEG),
    ];
    let solved: Vec<&Row> = rows.iter().filter(|row| row.outcome.is_ok()).collect();
    for (name, kind) in kinds {
        let left: Vec<&[f64; ERRORS]> =
            solved.iter().zip(&fit.left_out).filter(|(row, _)| kind(row)).map(|(_, left)| left).collect();
        let of = |k: usize| {
            let rms = (left.iter().map(|l| l[k] * l[k]).sum::<f64>() / left.len() as f64).sqrt();
            let most = quantile(left.iter().map(|l| l[k].abs()), 0.95);
            format!("{:.2} / {:.2} %", 100.0 * rms, 100.0 * most)
        };
        report.line(&format!("| {name} | {} | {} | {} | {} | {} |", left.len(), of(0), of(1), of(2), of(3)));
    }
    let stated = cones.iter().map(|c| fit.atlas.nearest(&c.cone).k_over_e.error);
    report.line(&format!(
        "\nThe error of K that the formula states is {:.2} % in the median and at most {:.1} %.",
        100.0 * quantile(stated.clone(), 0.5),
        100.0 * stated.fold(0.0, f64::max)
    ));
}

/// Cones on which the least errors of the formula were chosen.
const CHOSEN_ON: usize = 200;

/// Share of the cones that a stated error should cover.
const COVERED_SHARE: f64 = 0.95;

fn fresh(report: &mut Report, atlas: &Atlas) {
    report.section("Fresh cones at reference");
    let rows = atlas::committed(Set::Fresh);
    let cones = solved(&rows);
    report.line(&format!(
        "{} cones between those of the atlas, computed at `reference`, {} of them without a result, against the formula. The least errors were \
         chosen on the first {CHOSEN_ON} of them; the table counts the others, which no choice has seen.\n",
        rows.len(),
        rows.len() - cones.len()
    ));
    report.table(
        "| | within the stated error | mean | root mean square | largest | largest over its stated error |",
    );
    let unseen: Vec<Row> = rows.iter().filter(|row| row.index >= CHOSEN_ON).cloned().collect();
    let found: Vec<([f64; ERRORS], [f64; ERRORS])> = solved(&unseen)
        .iter()
        .map(|cone| {
            let a = atlas.nearest(&cone.cone);
            let errors = [a.k_over_e, a.contact_ratio, a.stiffness, a.elastic_share].map(|e| e.error);
            (differences(cone, atlas), errors)
        })
        .collect();
    let count = found.len() as f64;
    let mut short = Vec::new();
    for (k, name) in NUMBERS.iter().enumerate() {
        let within = found.iter().filter(|(d, e)| d[k].abs() <= e[k]).count();
        if (within as f64) < COVERED_SHARE * count {
            short.push(*name);
        }
        let mean = found.iter().map(|(d, _)| d[k]).sum::<f64>() / count;
        let rms = (found.iter().map(|(d, _)| d[k] * d[k]).sum::<f64>() / count).sqrt();
        let largest = found.iter().map(|(d, _)| d[k].abs()).fold(0.0, f64::max);
        let over = found.iter().map(|(d, e)| d[k].abs() / e[k]).fold(0.0, f64::max);
        report.line(&format!(
            "| {name} | {within} of {} ({:.1} %) | {:+.2} % | {:.2} % | {:.1} % | {over:.1} |",
            found.len(),
            100.0 * within as f64 / count,
            100.0 * mean,
            100.0 * rms,
            100.0 * largest
        ));
    }
    if short.is_empty() {
        report.line("\nNo error that is stated covers fewer than the 95 % of these cones that it should.");
    } else {
        report.line(&format!("\nFewer than 95 % lie within the stated error of: {}.", short.join(", ")));
    }
}

const ELASTIC: Elastic = Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };

fn metal(law: HardeningLaw, e_over_sy: f64, exponent: f64) -> Hardening {
    Hardening { law, yield_stress: 1.0 / e_over_sy, exponent, youngs_modulus: 1.0 }
}

/// Mean pressure on the contact of perfectly plastic metal over its yield stress.
fn plateau(report: &mut Report, atlas: &Atlas) {
    report.section("Plateau");
    report.line("Mean pressure on the contact over σ_y, ν 0.3, n 0, and in brackets the share K tan²β/(π σ_y) of the island:\n");
    let ratios = [30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0];
    let head: String = ratios.iter().map(|ratio| format!(" E/σ_y {ratio} |")).collect();
    report.table(&format!("| β | contact |{head}"));
    for slope in [1.0_f64, 3.0, 10.0, 20.0, 30.0, 40.0] {
        for contact in [Contact::Crushed, Contact::Indenting] {
            let cell = |ratio: &f64| {
                let cone = SharpCone::new(slope, &ELASTIC, metal(HardeningLaw::Swift, *ratio, 0.0), contact);
                let found = atlas.nearest(&cone);
                let island = found.k_over_e.value * slope.to_radians().tan().powi(2) * ratio / PI;
                format!(" {:.2} ({island:.2}) |", island / found.contact_ratio.value.powi(2))
            };
            let cells: String = ratios.iter().map(cell).collect();
            report.line(&format!("| {slope}° | {} |{cells}", word(contact)));
        }
    }
}

fn word(contact: Contact) -> &'static str {
    match contact {
        Contact::Crushed => "plane",
        Contact::Indenting => "cone",
    }
}

/// Share of the elastic K above which a cone says nothing of its metal.
const TOO_ELASTIC: f64 = 0.9;

/// ε_r/tan β: the strain at which the metal has the stress of the perfectly plastic metal of the same K.
fn strain_over_tan(atlas: &Atlas, slope: f64, law: HardeningLaw, ratio: f64, exponent: f64) -> Option<f64> {
    let tan = slope.to_radians().tan();
    let k = |hardening| {
        atlas.answer(&SharpCone::new(slope, &ELASTIC, hardening, Contact::Crushed)).map(|a| a.k_over_e.value)
    };
    let own = k(metal(law, ratio, exponent))?;
    if own > TOO_ELASTIC * FRAC_2_PI * ELASTIC.reduced_modulus() / tan {
        return None;
    }
    let (mut low, mut high) = (5_f64.ln(), 10_000_f64.ln());
    if own > k(metal(law, low.exp(), 0.0))? || own < k(metal(law, high.exp(), 0.0))? {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if k(metal(law, middle.exp(), 0.0))? > own { low = middle } else { high = middle }
    }
    let hardened = ratio / low.exp();
    Some((hardened.powf(1.0 / exponent) - 1.0) / ratio / tan)
}

fn representative_strain(report: &mut Report, atlas: &Atlas) {
    report.section("Representative strain");
    report.line(
        "ε_r/tan β of crushed cones, ν 0.3: the metal has the stress σ_r = σ_y (1 + E ε_r/σ_y)ⁿ of the perfectly plastic metal with the \
         same K. No number: elastic beyond 0.9 of the elastic K, or no such metal in the atlas. Bold: within a tenth of 0.13. An error of 1 % in K is one of about 1/n % in ε_r and more where elasticity counts.\n",
    );
    let ratios = [30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0];
    let head: String = ratios.iter().map(|ratio| format!(" E/σ_y {ratio} |")).collect();
    report.table(&format!("| β | law | n |{head}"));
    for slope in [1.0, 3.0, 10.0, 20.0, 40.0] {
        for law in [HardeningLaw::Hollomon, HardeningLaw::Swift] {
            for exponent in [0.1, 0.3, 0.5] {
                let cell = |ratio: &f64| match strain_over_tan(atlas, slope, law, *ratio, exponent) {
                    Some(c) if (c / 0.13 - 1.0).abs() <= 0.1 => format!(" **{c:.3}** |"),
                    Some(c) => format!(" {c:.3} |"),
                    None => " – |".into(),
                };
                let cells: String = ratios.iter().map(cell).collect();
                report.line(&format!("| {slope}° | {} | {exponent} |{cells}", law.name()));
            }
        }
    }
}
