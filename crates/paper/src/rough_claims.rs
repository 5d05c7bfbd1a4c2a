//! The claims on rough surfaces: Tables 1 and 2, and the figures between them.

use super::paper::{PEAKS, ROUGH, TABLE2};
use super::results_reader::Results;
use super::verdict::{Claim, Measured, Said, Verdict, falls, rises, worst};
use crate::table1::{self, ClosureSeeds, Seeds};
use asperity::numbers::{rounded, significant};
use asperity::roughness::Closure;

/// A quantity of the table.
type Quantity = fn(&ClosureSeeds) -> &Seeds;

/// Every claim on rough surfaces that the results can speak about.
pub(super) fn rough_claims(results: &Results) -> Vec<Claim> {
    let mut claims = Vec::new();
    claims.extend(table1_rows(results));
    claims.extend(table1_trends(results));
    claims.extend(table2(results));
    claims
}

fn text(ours: Measured) -> String {
    match ours.error {
        error if error < 1e-4 * ours.value.abs() => significant(ours.value),
        error => format!("{} ± {}", significant(ours.value), rounded(error)),
    }
}

fn texts(ours: &[Measured]) -> String {
    ours.iter().map(|one| text(*one)).collect::<Vec<_>>().join(", ")
}

/// The numbers of Table 1 and the largest pressures, row by row.
fn table1_rows(results: &Results) -> Vec<Claim> {
    const GENERATED: &str =
        "The surface is generated with the printed Ra and slope; the paper's own is not public.";
    let mut claims = Vec::new();
    for (((kind, row), part), peak) in table1::TABLE.iter().zip(ROUGH).zip(PEAKS) {
        let name = kind.name();
        let ours = |quantity: Quantity| results.of_surface(part, Closure::Published, quantity);
        let mut add =
            |name_of: &str, printed: f64, digit: f64, unit: &str, s: Option<Measured>, why: String| {
                claims.extend(s.map(|s| {
                    let verdict = Said::printed(printed, digit).judge(s);
                    let claim = format!("{name}: {name_of} = {printed}{unit}");
                    Claim::new(("table1", "Table 1"), claim, format!("{}{unit}", text(s)), verdict, why)
                }));
            };
        let balance = row.pressure * row.area / 100.0;
        let lost = if row.pressure > 2e4 {
            format!(" The printed number has lost its decimal point: {:.1}.", row.pressure / 10.0)
        } else {
            String::new()
        };
        let why =
            format!("Printed Pm times Ar is {balance:.1} MPa where the load is 200 MPa.{lost} {GENERATED}");
        add("Pm", row.pressure, 1.0, " MPa", ours(|r| &r.pressure), why);
        add("Ar", row.area, 0.01, " %", ours(|r| &r.area), GENERATED.into());
        let why = "Eq. [13] with the printed E, ν, H and β gives ours; all three printed values are lower by the same 1.22 to 1.24.";
        add("ψ", row.index, 0.01, "", index(results, part, row.beta), why.into());
        claims.extend(ours(|r| &r.peak).map(|s| {
            Claim::new(
                ("fig12", "section 4.2"),
                format!("{name}: the largest pressure is {} times the nominal one", row.peak),
                format!("{} times", text(s)),
                Said::Within(peak).judge(s),
                "The largest pressure is an extreme of the surface, not a mean: it changes from one surface to the next.",
            )
        }));
    }
    claims
}

/// The index of eq. [13], which depends on the mean slope alone: it is as exact as the printed slope.
fn index(results: &Results, part: &str, beta: f64) -> Option<Measured> {
    let ours = results.of_surface(part, Closure::Published, |r| &r.index)?;
    let rounding = 0.005 / beta * ours.value;
    Some(Measured { error: ours.error.hypot(rounding), ..ours })
}

/// A quantity of Table 1 over the three surfaces.
fn column(results: &Results, closure: Closure, quantity: Quantity) -> Option<Vec<Measured>> {
    ROUGH.iter().map(|part| results.of_surface(part, closure, quantity)).collect()
}

/// The order of the three surfaces in Table 1.
fn table1_trends(results: &Results) -> Vec<Claim> {
    let column = |quantity| column(results, Closure::Published, quantity);
    let mut claims = Vec::new();
    if let (Some(area), Some(pressure)) = (column(|r| &r.area), column(|r| &r.pressure)) {
        claims.push(Claim::new(
            ("fig13", "section 4.2"),
            "the real contact area falls as the attack angle grows",
            format!("{} %", texts(&area)),
            falls(&area),
            "",
        ));
        claims.push(Claim::new(
            ("table1", "section 4.2"),
            "the mean contact pressure rises with the attack angle",
            format!("{} MPa", texts(&pressure)),
            rises(&pressure),
            "",
        ));
    }
    let indices = table1::TABLE.into_iter().zip(ROUGH).map(|((_, row), part)| index(results, part, row.beta));
    if let Some(indices) = indices.collect::<Option<Vec<Measured>>>() {
        let regime = |psi: &Measured| match psi.value {
            psi if psi < 0.6 => "elastic",
            psi if psi > 1.0 => "plastic",
            _ => "elastoplastic",
        };
        let regimes: Vec<&str> = indices.iter().map(regime).collect();
        let said = [Said::Below(0.6), Said::Above(1.0), Said::Above(1.0)];
        claims.push(Claim::new(
            ("table1", "section 4.2"),
            "the ground surface is elastic, the milled and the sanded one plastic",
            format!("ψ = {}: {}", texts(&indices), regimes.join(", ")),
            worst(said.into_iter().zip(&indices).map(|(said, psi)| said.judge(*psi))),
            "With the printed E, ν and H the index of the ground surface lies just above the printed threshold of 0.6.",
        ));
    }
    claims
}

/// Share of elastic energy from which a surface is quasi elastic, %.
const QUASI_ELASTIC: f64 = 80.0;

fn table2(results: &Results) -> Vec<Claim> {
    let [ground, milled, sanded] = TABLE2;
    let mut claims = Vec::new();
    if let Some(shares) = column(results, Closure::Johnson, |r| &r.elastic) {
        let most = shares.iter().map(|s| s.value).fold(0.0, f64::max);
        let cut = (most > 100.0).then(|| {
            format!(
                "100 % is a cut: on that surface the unloading law, a cone's, returns {most:.0} % of the work, and plastic work is not resolved."
            )
        });
        let shares: Vec<Measured> =
            shares.iter().map(|s| Measured { value: s.value.min(100.0), ..*s }).collect();
        let predicted = shares.iter().map(|s| format!("{:.0} ± {:.0}", s.value, s.error));
        let predicted = predicted.collect::<Vec<_>>().join(", ");
        let numbers = TABLE2.iter().zip(&shares).map(|(row, share)| Said::printed(row[1], 1.0).judge(*share));
        claims.push(Claim::new(
            ("table2", "Table 2"),
            format!(
                "the elastic share of the energy is {}, {}, {} % for ground, milled, sanded",
                ground[1], milled[1], sanded[1]
            ),
            format!("predicted {predicted} %"),
            worst(numbers),
            "The printed share rises with the slope, while the text calls the ground surface quasi elastic: the two rows of the \
             table are probably exchanged. Exchanged they read 93, 85, 69 %, in the order that we find.",
        ));
        claims.push(Claim::new(
            ("fig15", "section 5"),
            "the ground surface is quasi elastic, the milled and sanded ones more plastic",
            format!("elastic share predicted {predicted} %; from {QUASI_ELASTIC} % on it is quasi elastic"),
            worst([Said::Above(QUASI_ELASTIC).judge(shares[0]), falls(&shares)]),
            cut.unwrap_or_default(),
        ));
    }
    if let Some(residual) = column(results, Closure::Johnson, |r| &r.residual) {
        claims.push(Claim::new(
            ("table2", "Table 2"),
            format!(
                "residual displacement of {}, {}, {} µm for ground, milled, sanded",
                ground[0], milled[0], sanded[0]
            ),
            format!("predicted {} µm", texts(&residual)),
            Verdict::CannotBeJudged,
            "An experiment on surfaces and a device that are not described; the prediction has no compliance of the device and no substrate.",
        ));
    }
    claims
}
