//! The paper's claims, each beside what was computed, and whether it is borne out.
//!
//! Numbers of the paper stand here as published; ours come from the results. A number is borne out where ours
//! lies within the paper's rounding plus our error.

use super::paper::{PEAKS, ROUGH, SETS, SYMMETRIES, TABLE2};
use super::results_reader::Results;
use crate::table1::{self, ClosureSeeds, Seeds};
use asperity::calibrate::{AngleFit, Fit};
use asperity::columns::Unit;
use asperity::crush::{Island, Summary};
use asperity::numbers::{Spread, listed, significant, with_deviation};
use asperity::roughness::{Closure, PUBLISHED_COEFFICIENT};
use asperity::units::MICROMETRE;
use serde::Serialize;

/// The fate of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Ours agrees.
    BorneOut,
    /// Ours does not.
    Contradicted,
    /// The paper prints no number, or computation cannot tell.
    CannotBeJudged,
}

impl Verdict {
    /// Every verdict.
    pub const ALL: [Verdict; 3] = [Verdict::BorneOut, Verdict::Contradicted, Verdict::CannotBeJudged];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::BorneOut => "borne out",
            Verdict::Contradicted => "contradicted",
            Verdict::CannotBeJudged => "cannot be judged",
        }
    }
}

/// A claim of the paper and its fate.
#[derive(Clone, Debug, Serialize)]
pub struct Claim {
    /// Figure or table it belongs to.
    pub item: &'static str,
    /// The place where the paper says it.
    pub place: &'static str,
    /// The claim itself.
    pub claim: String,
    /// The result of the computation.
    pub ours: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The reason, where there is more to say.
    pub why: String,
}

impl Claim {
    fn new(
        (item, place): (&'static str, &'static str),
        claim: impl Into<String>,
        ours: impl Into<String>,
        holds: bool,
        why: impl Into<String>,
    ) -> Claim {
        let verdict = if holds { Verdict::BorneOut } else { Verdict::Contradicted };
        Claim { item, place, claim: claim.into(), ours: ours.into(), verdict, why: why.into() }
    }
}

/// Every claim that the results can speak about.
pub(super) fn claims(results: &Results) -> Vec<Claim> {
    let mut claims = Vec::new();
    claims.extend(exponent(results));
    claims.extend(SYMMETRIES.iter().flat_map(|symmetry| elastic_areas(results, symmetry)));
    claims.extend(SYMMETRIES.iter().filter_map(|symmetry| sets(results, symmetry)).flatten());
    claims.extend(results.fit().iter().flat_map(strain));
    claims.extend(table1_rows(results));
    claims.extend(table1_trends(results));
    claims.extend(table2(results));
    claims
}

/// True where values go up, or down.
fn rises(values: &[f64]) -> bool {
    values.windows(2).all(|w| w[1] > w[0])
}

fn falls(values: &[f64]) -> bool {
    values.windows(2).all(|w| w[1] < w[0])
}

fn exponent(results: &Results) -> Option<Claim> {
    let exponent = results.force_exponent()?;
    Some(Claim::new(
        ("fig2", "eqs [2], [3]"),
        "the force grows with the cube of the depth",
        format!("exponent {exponent:.2} over the upper half of the depth"),
        (exponent - 3.0).abs() < 0.1,
        "A cone gives F = K h², K a pressure, as eq. [5] of the paper itself has it; the cube is a misprint. \
         The rounded tip keeps the exponent of this asperity below 2.",
    ))
}

fn elastic_areas(results: &Results, (end, symmetry): &(&str, &str)) -> Vec<Claim> {
    let of = ("fig5", "section 3.1");
    let Some(found) = results.islands(&format!("three-identical{end}")) else { return Vec::new() };
    let claim = format!("areas remain elastic even after the total crushing of the asperities ({symmetry})");
    let count = found.len();
    if count == 0 {
        let why = "Figure 5 of the paper draws a von Mises stress below the first yield stress, which is not the same: \
                   metal that has yielded may be elastic again, as the picture of the zones shows.";
        return vec![Claim::new(of, claim, "no region of the asperities that never yielded", false, why)];
    }
    let place = |island: &Island| {
        let [r, z] = island.place.map(|x| format!("{:.0}", x / MICROMETRE));
        format!("r = {r} µm, z = {z} µm")
    };
    let places = found.iter().map(place).collect::<Vec<_>>().join(", ");
    let regions = if count == 1 { "region" } else { "regions" };
    let pressed = found.iter().filter(|i| i.mean_pressure > 0.0).count();
    vec![
        Claim::new(of, claim, format!("{count} {regions} never yielded: at {places}"), true, ""),
        Claim::new(
            of,
            format!("these areas show hydrostatic compression ({symmetry})"),
            format!("{pressed} of {count} are in compression"),
            pressed == count,
            "",
        ),
    ]
}

fn sets(results: &Results, (end, symmetry): &(&str, &str)) -> Option<Vec<Claim>> {
    let of = |quantity: fn(Summary) -> Option<f64>| -> Option<Vec<f64>> {
        SETS.iter().map(|set| quantity(results.summary(&format!("{set}{end}"))?)).collect()
    };
    let (works, shares) = (of(|s| Some(s.written(s.total_work, Unit::Energy)))?, of(|s| s.elastic_fraction)?);
    let percent = listed(&shares, |s| format!("{:.1}", 100.0 * s));
    let unit = if end.is_empty() { "µJ" } else { "µJ/mm" };
    let claim = |claim: &str, ours: String, holds: bool, why: &str| {
        Claim::new(("fig6", "section 3.2"), format!("{claim} ({symmetry})"), ours, holds, why)
    };
    let elastic = shares.iter().all(|s| *s > 0.5);
    Some(vec![
        claim(
            "the more acute the asperities, the larger the plastic share of the work",
            format!("elastic share {percent} % for 1–4°, 5–8°, 9–12°"),
            falls(&shares),
            "",
        ),
        claim(
            "the total strain energy falls as the attack angles grow",
            format!("{} {unit}", listed(&works, significant)),
            falls(&works),
            "",
        ),
        claim(
            "elastic strain energy outweighs plastic",
            format!("elastic share {percent} %"),
            elastic,
            if elastic {
                ""
            } else {
                "It holds only where slopes are small; the paper's own sentence before it says that acute asperities are plastic."
            },
        ),
    ])
}

fn strain(fit: &Fit) -> Vec<Claim> {
    let mut claims = Vec::new();
    if let Some(worst) = fit.per_angle.iter().map(|a| a.scatter).filter(|s| s.is_finite()).reduce(f64::max) {
        claims.push(Claim::new(
            ("fig7", "eq. [7]"),
            "K/σr can be made independent of the hardening exponent",
            format!(
                "the curves of all exponents collapse to {:.2} % (rms) or better at every slope",
                100.0 * worst
            ),
            // the curves differ by tens of percent before they are mixed
            100.0 * worst < 5.0,
            "An assumption of the paper, not a consequence of the π theorem; what is left is the scatter.",
        ));
    }
    let [least, most] = [PUBLISHED_COEFFICIENT - 0.005, PUBLISHED_COEFFICIENT + 0.005];
    if let (Some(c), Some(mean), Some([low, high]), Some([least_c, most_c])) =
        (fit.coefficient_least_squares, fit.coefficient_mean_ratio, fit.ci95, fit.model_interval)
    {
        claims.push(Claim::new(
            ("fig8", "eq. [9]"),
            format!("εr = {PUBLISHED_COEFFICIENT} tan β"),
            format!(
                "c = {c:.4} by least squares, {mean:.4} as mean of εr/tan β, from {} cases; interval of the arithmetic {low:.3} to {high:.3}, of the choice of metals and slopes {least_c:.3} to {most_c:.3}",
                fit.cases
            ),
            most >= low && least <= high,
            "The paper does not print its 480 materials; ours are 10 slopes by 48 metals. The arithmetic draws other cases and shifts K by its error; the second interval leaves out metals or slopes.",
        ));
    }
    let ratio = |a: &AngleFit| {
        let tan = a.beta_deg.to_radians().tan();
        Some((a.beta_deg, a.representative_strain? / tan, a.low <= most * tan && a.high >= least * tan))
    };
    let ratios: Vec<(f64, f64, bool)> = fit.per_angle.iter().filter_map(ratio).collect();
    if let (Some(first), Some(last)) = (ratios.first(), ratios.last()) {
        let inside = ratios.iter().filter(|r| r.2).count();
        claims.push(Claim::new(
            ("fig8", "eq. [9]"),
            "one coefficient holds from 1° to 10°",
            format!(
                "εr/tan β goes from {:.3} at {}° to {:.3} at {}°; {PUBLISHED_COEFFICIENT} ± 0.005 meets our interval at {inside} of {} slopes",
                first.1, first.0, last.1, last.0, ratios.len()
            ),
            inside == ratios.len(),
            "At small slopes the contact is nearly elastic and K hardly depends on the hardening, so that a larger strain represents it.",
        ));
    }
    claims
}

/// The numbers of Table 1 and the largest pressures, row by row.
fn table1_rows(results: &Results) -> Vec<Claim> {
    const GENERATED: &str =
        "The surface is generated with the printed Ra and slope; the paper's own is not public.";
    let mut claims = Vec::new();
    for (((kind, row), part), peak) in table1::TABLE.iter().zip(ROUGH).zip(PEAKS) {
        let name = kind.name();
        let spread =
            |quantity: fn(&ClosureSeeds) -> &Seeds| results.rough(part, Closure::Published, quantity);
        let mut add =
            |name_of: &str, printed: f64, rounding: f64, unit: &str, s: Option<Spread>, why: String| {
                claims.extend(s.map(|s| {
                    Claim::new(
                        ("table1", "Table 1"),
                        format!("{name}: {name_of} = {printed}{unit}"),
                        format!("{}{unit}", with_deviation(s)),
                        (s.mean - printed).abs() <= rounding + 2.0 * s.deviation,
                        why,
                    )
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
        add("Pm", row.pressure, 0.5, " MPa", spread(|r| &r.pressure), why);
        add("Ar", row.area, 0.005, " %", spread(|r| &r.area), GENERATED.into());
        let why = "Eq. [13] with the printed E, ν, H and β gives ours; all three printed values are lower by the same 1.22 to 1.24.";
        add("ψ", row.index, 0.005, "", spread(|r| &r.index), why.into());
        claims.extend(spread(|r| &r.peak).map(|s| {
            Claim::new(
                ("fig12", "section 4.2"),
                format!("{name}: the largest pressure is {} times the nominal one", row.peak),
                format!("{:.1} ± {:.1} times", s.mean, s.deviation),
                s.mean + 2.0 * s.deviation >= peak[0] && s.mean - 2.0 * s.deviation <= peak[1],
                "The largest pressure is an extreme of the surface, not a mean: it changes from one surface to the next.",
            )
        }));
    }
    claims
}

/// A quantity of Table 1 over the three surfaces.
fn column(results: &Results, closure: Closure, quantity: fn(&ClosureSeeds) -> &Seeds) -> Option<Vec<f64>> {
    ROUGH.iter().map(|part| Some(results.rough(part, closure, quantity)?.mean)).collect()
}

/// The order of the three surfaces in Table 1.
fn table1_trends(results: &Results) -> Vec<Claim> {
    let column = |quantity| column(results, Closure::Published, quantity);
    let mut claims = Vec::new();
    if let (Some(area), Some(pressure)) = (column(|r| &r.area), column(|r| &r.pressure)) {
        claims.push(Claim::new(
            ("fig13", "section 4.2"),
            "the real contact area falls as the attack angle grows",
            format!("{} %", listed(&area, significant)),
            falls(&area),
            "",
        ));
        claims.push(Claim::new(
            ("table1", "section 4.2"),
            "the mean contact pressure rises with the attack angle",
            format!("{} MPa", listed(&pressure, significant)),
            rises(&pressure),
            "",
        ));
    }
    if let Some(index) = column(|r| &r.index) {
        let regime = |psi: &f64| match *psi {
            psi if psi < 0.6 => "elastic",
            psi if psi > 1.0 => "plastic",
            _ => "elastoplastic",
        };
        let regimes: Vec<&str> = index.iter().map(regime).collect();
        claims.push(Claim::new(
            ("table1", "section 4.2"),
            "the ground surface is elastic, the milled and the sanded one plastic",
            regimes.join(", "),
            regimes == ["elastic", "plastic", "plastic"],
            "With the printed E, ν and H the index of the ground surface lies just above the printed threshold of 0.6.",
        ));
    }
    claims
}

fn table2(results: &Results) -> Vec<Claim> {
    let [ground, milled, sanded] = TABLE2;
    let mut claims = Vec::new();
    if let Some(shares) = column(results, Closure::Johnson, |r| &r.elastic) {
        let most = shares.iter().copied().fold(0.0, f64::max);
        let cut = (most > 100.0).then(|| {
            format!(
                "100 % is a cut: on that surface the unloading law, a cone's, returns {most:.0} % of the work, and plastic work is not resolved."
            )
        });
        let shares: Vec<f64> = shares.iter().map(|s| s.min(100.0)).collect();
        let predicted = listed(&shares, |s| format!("{s:.0}"));
        claims.push(Claim::new(
            ("table2", "Table 2"),
            format!(
                "the elastic share of the energy is {}, {}, {} % for ground, milled, sanded",
                ground[1], milled[1], sanded[1]
            ),
            format!("predicted {predicted} %"),
            rises(&shares),
            "The printed share rises with the slope, while the text calls the ground surface quasi elastic: the two rows of the \
             table are probably exchanged. Exchanged they read 93, 85, 69 %, in the order that we find.",
        ));
        claims.push(Claim::new(
            ("fig15", "section 5"),
            "the ground surface is quasi elastic, the milled and sanded ones more plastic",
            format!("elastic share predicted {predicted} %"),
            shares[0] > 80.0 && falls(&shares),
            cut.unwrap_or_default(),
        ));
    }
    if let Some(residual) = column(results, Closure::Johnson, |r| &r.residual) {
        let claim = Claim::new(
            ("table2", "Table 2"),
            format!(
                "residual displacement of {}, {}, {} µm for ground, milled, sanded",
                ground[0], milled[0], sanded[0]
            ),
            format!("predicted {} µm", listed(&residual, |r| format!("{r:.2}"))),
            false,
            "An experiment on surfaces and a device that are not described; the prediction has no compliance of the device and no substrate.",
        );
        claims.push(Claim { verdict: Verdict::CannotBeJudged, ..claim });
    }
    claims
}
