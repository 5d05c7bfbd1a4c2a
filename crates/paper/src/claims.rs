//! The paper's claims, each beside what was computed, and whether it is borne out.
//!
//! Numbers of the paper stand here as published; ours come from the results. The rule is that of `verdict`.

use super::paper::{SETS, SYMMETRIES};
use super::results_reader::Results;
use super::rough_claims::rough_claims;
use super::verdict::{Claim, Measured, NEAR, Said, Verdict, falls, worst, zone_is_there};
use super::zones::{Zone, Zones, area};
use asperity::calibrate::{AngleFit, Fit};
use asperity::columns::Unit;
use asperity::crush::Summary;
use asperity::numbers::{listed, significant};
use asperity::roughness::PUBLISHED_COEFFICIENT;

/// Every claim that the results can speak about.
pub(super) fn claims(results: &Results) -> Vec<Claim> {
    let mut claims = Vec::new();
    claims.extend(exponent(results));
    claims.extend(SYMMETRIES.iter().filter_map(|symmetry| elastic_areas(results, symmetry)).flatten());
    claims.extend(SYMMETRIES.iter().filter_map(|symmetry| sets(results, symmetry)).flatten());
    claims.extend(results.fit().iter().flat_map(strain));
    claims.extend(rough_claims(results));
    claims
}

fn exponent(results: &Results) -> Option<Claim> {
    let exponent = results.force_exponent()?;
    // an error of the force at one end tilts the line over the upper half of the depth
    let error = results.summary("single-asperity")?.errors_along.force / 2.0_f64.ln();
    Some(Claim::new(
        ("fig2", "eqs [2], [3]"),
        "the force grows with the cube of the depth",
        format!("exponent {exponent:.2} ± {error:.2} over the upper half of the depth"),
        Said::Within([3.0, 3.0]).judge(Measured { value: exponent, error }),
        "A cone gives F = K h², K a pressure, as eq. [5] of the paper itself has it; the cube is a misprint. \
         The rounded tip keeps the exponent of this asperity below 2.",
    ))
}

/// Zones of all meshes as text: the area on each, and where and how large they are on the finest.
fn on_meshes(meshes: &[Vec<Zone>]) -> String {
    let areas: Vec<f64> = meshes.iter().map(|zones| area(zones)).collect();
    let place = |zone: &Zone| format!("r = {:.0} µm, z = {:.0} µm", zone.place[0], zone.place[1]);
    let mut finest = meshes.last().cloned().unwrap_or_default();
    finest.sort_by(|a, b| b.area.total_cmp(&a.area));
    let places: Vec<String> = finest.iter().take(4).map(place).collect();
    let at = if places.is_empty() { String::new() } else { format!(", at {}", places.join("; ")) };
    format!("{} µm² on three meshes{at}", listed(&areas, |a| format!("{a:.0}")))
}

fn elastic_areas(results: &Results, (end, symmetry): &(&str, &str)) -> Option<Vec<Claim>> {
    let of = ("fig5", "section 3.1");
    let meshes = results.zones_of_meshes(end);
    let finest = meshes.last()?;
    let judged = |zones: fn(&Zones) -> Vec<Zone>| {
        let large = |mesh: &Zones| zones(mesh).into_iter().filter(|zone| zone.area > mesh.least).collect();
        let on_each: Vec<Vec<Zone>> = meshes.iter().map(large).collect();
        let areas: Vec<f64> = on_each.iter().map(|zones| area(zones)).collect();
        (zone_is_there(&areas, finest.least), on_each)
    };
    let (verdict, zones) = judged(|zones| zones.never_yielded.clone());
    let mut claims = vec![Claim::new(
        of,
        format!("areas remain elastic even after the total crushing of the asperities ({symmetry})"),
        format!("enclosed metal that never yielded: {}", on_meshes(&zones)),
        verdict,
        match verdict {
            Verdict::BorneOut => String::new(),
            _ => "The paper draws a von Mises stress below the first yield stress, which is not the same: metal that has \
                  yielded may carry less and be elastic again."
                .into(),
        },
    )];
    let (drawn, below) = judged(|zones| zones.below_yield.clone());
    claims.push(Claim::new(
        of,
        format!("areas with a von Mises stress below 300 MPa, as Figure 5 draws them ({symmetry})"),
        format!("enclosed: {}", on_meshes(&below)),
        drawn,
        "",
    ));
    if drawn == Verdict::BorneOut {
        let pressures: Vec<f64> = below.iter().flatten().map(|zone| zone.pressure).collect();
        let shown = below.last().into_iter().flatten().map(|zone| format!("{:.0}", zone.pressure));
        // the pressure of a zone differs between meshes by far less than its area
        let compressed =
            worst(pressures.iter().map(|p| Said::Above(0.0).judge(Measured::known_to(*p, NEAR))));
        claims.push(Claim::new(
            of,
            format!("these areas show hydrostatic compression ({symmetry})"),
            format!("mean pressure {} MPa", shown.collect::<Vec<_>>().join(", ")),
            compressed,
            "",
        ));
    }
    let (verdict, zones) = judged(Zones::valley_zones);
    claims.push(Claim::new(
        of,
        format!("a similar area is localised between the asperities ({symmetry})"),
        format!("von Mises stress below 300 MPa between summits, near the valleys: {}", on_meshes(&zones)),
        verdict,
        "",
    ));
    Some(claims)
}

fn sets(results: &Results, (end, symmetry): &(&str, &str)) -> Option<Vec<Claim>> {
    let of = |quantity: fn(Summary) -> Option<Measured>| -> Option<Vec<Measured>> {
        SETS.iter().map(|set| quantity(results.summary(&format!("{set}{end}"))?)).collect()
    };
    // the work is a sum of forces over depths, whose errors are those of the force along the curve
    let works =
        of(|s| Some(Measured::known_to(s.written(s.total_work, Unit::Energy), s.errors_along.force)))?;
    let shares = of(|s| Some(Measured { value: s.elastic_fraction?, error: s.errors.elastic_fraction? }))?;
    let percent = shares.iter().map(|s| format!("{:.1} ± {:.1}", 100.0 * s.value, 100.0 * s.error));
    let percent = percent.collect::<Vec<_>>().join(", ");
    let unit = if end.is_empty() { "µJ" } else { "µJ/mm" };
    let claim = |claim: &str, ours: String, verdict: Verdict, why: &str| {
        Claim::new(("fig6", "section 3.2"), format!("{claim} ({symmetry})"), ours, verdict, why)
    };
    let outweighs = worst(shares.iter().map(|s| Said::Above(0.5).judge(*s)));
    let works_shown =
        works.iter().map(|w| format!("{} ± {}", significant(w.value), asperity::numbers::rounded(w.error)));
    Some(vec![
        claim(
            "the more acute the asperities, the larger the plastic share of the work",
            format!("elastic share {percent} % for 1–4°, 5–8°, 9–12°"),
            falls(&shares),
            "",
        ),
        claim(
            "the total strain energy falls as the attack angles grow",
            format!("{} {unit}", works_shown.collect::<Vec<_>>().join(", ")),
            falls(&works),
            "",
        ),
        claim(
            "elastic strain energy outweighs plastic",
            format!("elastic share {percent} %"),
            outweighs,
            match outweighs {
                Verdict::BorneOut => "",
                _ => {
                    "It holds only where slopes are small; the paper's own sentence before it says that acute asperities are plastic."
                }
            },
        ),
    ])
}

/// Scatter up to which curves of different exponents are one: they differ by tens of percent before they are
/// mixed.
const ONE_CURVE: f64 = 0.05;

fn strain(fit: &Fit) -> Vec<Claim> {
    let mut claims = Vec::new();
    if let Some(most) = fit.per_angle.iter().map(|a| a.scatter).filter(|s| s.is_finite()).reduce(f64::max) {
        claims.push(Claim::new(
            ("fig7", "eq. [7]"),
            "K/σr can be made independent of the hardening exponent",
            format!(
                "the curves of all exponents collapse to {:.2} % (rms) or better at every slope; up to {:.0} % counts as one curve",
                100.0 * most,
                100.0 * ONE_CURVE
            ),
            Said::Below(ONE_CURVE).judge(Measured::known_to(most, 0.0)),
            "An assumption of the paper, not a consequence of the π theorem; the remainder is the scatter.",
        ));
    }
    claims.extend(where_it_holds(fit));
    claims
}

/// ε_r = 0.13 tan β, slope by slope: one row that says from where to where it holds.
fn where_it_holds(fit: &Fit) -> Option<Claim> {
    let published = Said::printed(PUBLISHED_COEFFICIENT, 0.01);
    let judged = |a: &AngleFit| {
        let tan = a.beta_deg.to_radians().tan();
        let [low, high] = [a.low / tan, a.high / tan];
        let ours = Measured { value: 0.5 * (low + high), error: 0.5 * (high - low) };
        Some((a.beta_deg, a.representative_strain? / tan, published.judge(ours)))
    };
    let slopes: Vec<(f64, f64, Verdict)> = fit.per_angle.iter().filter_map(judged).collect();
    let ([first, ..], [.., last]) = (&slopes[..], &slopes[..]) else { return None };
    let meets = |slope: &(f64, f64, Verdict)| slope.2 != Verdict::Contradicted;
    let ranges: Vec<String> = slopes
        .chunk_by(|a, b| meets(a) == meets(b))
        .filter(|range| meets(&range[0]))
        .map(|range| match range {
            [one] => format!("at {}°", one.0),
            [from, .., to] => format!("from {}° to {}°", from.0, to.0),
            [] => String::new(),
        })
        .collect();
    let holds = match &ranges[..] {
        [] => "holds at no slope".to_string(),
        ranges => format!("holds {}", ranges.join(" and ")),
    };
    let whole = worst(slopes.iter().map(|s| s.2));
    let verdict = match whole {
        Verdict::Contradicted if !ranges.is_empty() => Verdict::BorneOutInPart,
        verdict => verdict,
    };
    let coefficient = |c: Option<f64>| c.map_or_else(|| "–".into(), |c| format!("{c:.3}"));
    let ends = |ends: Option<[f64; 2]>| ends.map_or_else(|| "–".into(), |[a, b]| format!("{a:.3} to {b:.3}"));
    Some(Claim::new(
        ("fig8", "eq. [9]"),
        format!("εr = {PUBLISHED_COEFFICIENT} tan β from 1° to 10°"),
        format!(
            "{holds}: there {PUBLISHED_COEFFICIENT} ± 0.005 meets our 95 % interval; εr/tan β goes from {:.3} at {}° to {:.3} at {}°; through all \
             slopes c = {} by least squares, {} as mean of εr/tan β (interval of the arithmetic {}, of the choice of metals and slopes {}), \
             from {} cases",
            first.1,
            first.0,
            last.1,
            last.0,
            coefficient(fit.coefficient_least_squares),
            coefficient(fit.coefficient_mean_ratio),
            ends(fit.ci95),
            ends(fit.model_interval),
            fit.cases
        ),
        verdict,
        "At small slopes the contact is nearly elastic and K hardly depends on the hardening, so that a larger strain represents it. \
         The paper does not print its 480 materials; ours are 10 slopes by 48 metals.",
    ))
}
