//! Each figure and table of the paper: ours, beside what the paper prints.

use super::paper::{ROUGH, SETS, SYMMETRIES, TABLE2};
use super::plan::Item;
use super::profile::ProfilePoint;
use super::results_reader::Results;
use super::zones::area;
use crate::table1::{self, ClosureSeeds, Seeds};
use asperity::columns::Unit;
use asperity::crush::Summary;
use asperity::draw::chart::{self, Chart, Series};
use asperity::numbers::{Spread, shown, significant, spread};
use asperity::page;
use asperity::rough::charts::travel_chart;
use asperity::rough::{LoadPoint, Phase};
use asperity::roughness::Closure;
use asperity::units::MICROMETRE;
use maud::{Markup, html};

/// The closures of Tables 1 and 2, and what they are.
const CLOSURES: [(Closure, &str); 5] = [
    (Closure::Published, "0.13 E* tan β (eq. [11])"),
    (Closure::Fitted, "the same with our c"),
    (Closure::Johnson, "eqs [18]–[20], mended, capped at H"),
    (Closure::Sneddon, "exact elastic cone"),
    (Closure::Calibrated, "our elastoplastic cones"),
];

/// The figures and tables of a section.
pub fn body(item: Item, results: &Results) -> Result<Markup, String> {
    let body = match item.name {
        "fig1" => geometry(results),
        "fig2" => single(results),
        "fig3" => file(
            results,
            "rough-milled",
            "load_curve.svg",
            "A generated milled surface with the printed Ra and slope, pressed and released; every closure. The paper's curve is measured and prints no number, so this is a prediction.",
        ),
        "fig4" => sketch(
            results,
            "three-identical",
            "elements",
            "Three asperities of 20 µm and 10° at the end of the crush: the elements in the section of a body of revolution, a cone and two rings. The paper does not say whether its model is axisymmetric; both idealisations are computed.",
        ),
        "fig5" => zones(results),
        "fig6" => sets(results)?,
        "fig7" => html! {
            (file(results, "calibrate", "collapse.svg", "K/σr of all metals at one slope, at the representative strain that mixes the curves best: one curve for every exponent n, as in the paper's figure."))
            (file(results, "calibrate", "collapse_all.svg", "All slopes in one: K tan²β/σr against E* tan β/σr."))
        },
        "fig8" => html! {
            (file(results, "calibrate", "representative_strain.svg", "The representative strain of every slope with its 95 % interval, our line and the published one."))
            (strains(results))
        },
        "fig9" => profile(results)?,
        "fig11" => maps(
            results,
            "topography.png",
            "Map of the heights",
            "Heights in µm; surfaces generated with the printed Ra and mean slope, 2 mm a side. The paper's own surfaces are not public.",
        ),
        "fig12" => maps(
            results,
            "pressure-published.png",
            "Map of the contact pressure",
            "Pressure under a nominal 200 MPa by the paper's closure; colours end where 99 % of the loaded pixels do.",
        ),
        "fig13" => maps(
            results,
            "contact-published.png",
            "Map of the contact, coloured by regime",
            "Contact areas by regime, by the paper's closure and its thresholds.",
        ),
        "table1" => numbers(results),
        "fig15" => unloading(results)?,
        "table2" => energies(results),
        "outlook" => outlook(results),
        _ => html! {},
    };
    Ok(body)
}

/// A drawing, or that there is none.
fn drawing(svg: Option<String>, caption: &str) -> Markup {
    match svg {
        Some(svg) => page::drawing(&svg, caption, caption),
        None => html! {
            figure {
                p class="missing" { "This part is not there: it was not asked for, or could not be done." }
                figcaption { (caption) }
            }
        },
    }
}

fn file(results: &Results, part: &str, name: &str, caption: &str) -> Markup {
    drawing(results.text(part, name), caption)
}

fn sketch(results: &Results, part: &str, start: &str, caption: &str) -> Markup {
    drawing(results.sketch(part, start), caption)
}

fn table(caption: &str, head: &[&str], rows: &[Vec<String>]) -> Markup {
    let rows: Vec<Vec<Markup>> =
        rows.iter().map(|row| row.iter().map(|cell| html! { (cell) }).collect()).collect();
    page::table(caption, head, &rows)
}

fn percent(value: Option<f64>) -> Option<f64> {
    value.map(|v| 100.0 * v)
}

fn geometry(results: &Results) -> Markup {
    html! {
        (sketch(results, "single-asperity", "elements", "The asperity at the end of the crush with its elements: height 20 µm, attack angle 10°, tip radius 10 µm, as printed; the base radius follows."))
    }
}

fn single(results: &Results) -> Markup {
    let part = "single-asperity";
    let force = |depth: f64| results.force_at(part, depth);
    let summary = results.summary(part);
    let of = |quantity: fn(&Summary) -> Option<f64>| summary.as_ref().and_then(quantity);
    let rows = [
        ("force at 1 µm, N", force(1.0)),
        ("force at 2 µm, N", force(2.0)),
        ("force at 5 µm, N", force(5.0)),
        ("estimated error of the force, %", percent(of(|s| Some(s.estimated_error)))),
        ("residual depth, µm", of(|s| s.residual_depth.map(|h| h / MICROMETRE))),
        ("stiffness of unloading, N/µm", of(|s| Some(s.written(s.unloading_stiffness?, Unit::Stiffness)))),
        ("elastic share of the work, %", percent(of(|s| s.elastic_fraction))),
        ("contact radius at 5 µm, µm", of(|s| Some(s.contact_radius / MICROMETRE))),
        ("exponent of F over h, upper half", results.force_exponent()),
    ];
    let rows = rows.map(|(name, value)| vec![name.into(), shown(value)]);
    html! {
        (file(results, part, "curve.svg", "Force against depth of the paper's asperity, loading and unloading."))
        (table("The paper's asperity in numbers; the paper prints none of them", &["quantity", "ours"], &rows))
        (sketch(results, part, "section", "The peak: pressure of the tool, von Mises stress, plastic strain and hydrostatic pressure on the deformed section."))
    }
}

fn zones(results: &Results) -> Markup {
    let mut rows = Vec::new();
    for (end, symmetry) in SYMMETRIES {
        let meshes = results.zones_of_meshes(end);
        for (mesh, zones) in ["coarse", "finer", "finest"].iter().zip(&meshes) {
            for (what, found) in [
                ("never yielded", &zones.never_yielded),
                ("von Mises stress below 300 MPa", &zones.below_yield),
            ] {
                let places = found.iter().map(|zone| zone.place.map(significant).join(", "));
                let pressures = found.iter().map(|zone| significant(zone.pressure));
                rows.push(vec![
                    symmetry.to_string(),
                    what.to_string(),
                    mesh.to_string(),
                    significant(area(found)),
                    places.collect::<Vec<_>>().join("; "),
                    pressures.collect::<Vec<_>>().join("; "),
                ]);
            }
        }
    }
    html! {
        p { "The tool has come down by the whole height of the asperities. The paper draws where the von Mises stress is below "
            "the first yield stress; below are the line of that stress, and what the material itself says: where it never yielded, "
            "where it has yielded but is elastic now, and where it yields. All are contours of continuous quantities on the finest of "
            "three meshes; a zone is judged where its area on the three agrees to 10 %." }
        @for (end, symmetry) in SYMMETRIES {
            h3 { (symmetry) }
            (sketch(results, &format!("three-identical-finest{end}"), "zones", "Elastic zones and hydrostatic pressure at the end of the crush."))
        }
        (table("Zones that yielding metal encloses, on three meshes", &["symmetry", "zone", "mesh", "area (µm²)", "places r, z (µm)", "mean pressure (MPa)"], &rows))
        h3 { "The state of the whole row" }
        (sketch(results, "three-identical", "section", "Body of revolution: pressure of the tool and fields of the row."))
    }
}

fn sets(results: &Results) -> Result<Markup, String> {
    let labels = ["1–4° (ground)", "5–8° (milled)", "9–12° (sanded)"];
    let (mut figures, mut rows) = (Vec::new(), Vec::new());
    for (end, symmetry) in SYMMETRIES {
        let unit = if end.is_empty() { "N" } else { "N/mm" };
        let mut series = Vec::new();
        for (set, label) in SETS.iter().zip(labels) {
            let part = format!("{set}{end}");
            let (Some(curve), Some(summary)) = (results.curve(&part), results.summary(&part)) else {
                continue;
            };
            let points =
                curve.iter().map(|row| [row.depth / MICROMETRE, summary.written(row.force, Unit::Force)]);
            series.push(Series::line(label, points.collect()));
            rows.push(vec![
                format!("{label}, {symmetry}"),
                format!("{} {unit}", significant(summary.written(summary.peak_force, Unit::Force))),
                shown(percent(Some(summary.estimated_error))),
                significant(summary.written(summary.total_work, Unit::Energy)),
                shown(percent(summary.elastic_fraction)),
                shown(summary.residual_depth.map(|h| h / MICROMETRE)),
            ]);
        }
        let chart = Chart::new("Depth h (µm)", format!("Force F ({unit})"), series);
        let svg = if chart.series.is_empty() { None } else { Some(chart::svg(&chart)?) };
        figures.push((svg, symmetry));
    }
    Ok(html! {
        @for (svg, symmetry) in figures {
            (drawing(svg, &format!("Four asperities of 20 µm, loading to 5 µm and unloading, {symmetry}. The paper's curves carry no numbers in its text.")))
        }
        (table("The three sets in numbers", &["set", "peak force", "error of the force, %", "total work, µJ or µJ/mm", "elastic share, %", "residual depth, µm"], &rows))
    })
}

fn strains(results: &Results) -> Markup {
    let fit = results.fit();
    let strain =
        |v: Option<f64>| v.filter(|v| v.is_finite()).map_or_else(|| "–".into(), |v| format!("{v:.5}"));
    let rows: Vec<Vec<String>> = fit
        .iter()
        .flat_map(|fit| fit.per_angle.iter().map(|angle| (fit.published, angle)))
        .map(|(published, angle)| {
            let tan = angle.beta_deg.to_radians().tan();
            let (published, ours) = (published * tan, angle.representative_strain);
            vec![
                format!("{}°", angle.beta_deg),
                strain(ours),
                format!("{} … {}", strain(Some(angle.low)), strain(Some(angle.high))),
                strain(Some(published)),
                // what rounds to -0 is 0
                ours.map_or_else(
                    || "–".into(),
                    |v| format!("{:+.0} %", (100.0 * (v / published - 1.0)).round() + 0.0),
                ),
                ours.map_or_else(|| "–".into(), |v| format!("{:.4}", v / tan)),
            ]
        })
        .collect();
    table(
        "Representative strain of each slope",
        &["slope", "εr, ours", "95 %", "0.13 tan β (published)", "ours over published", "εr/tan β"],
        &rows,
    )
}

fn profile(results: &Results) -> Result<Markup, String> {
    let Some(rows) = results.rows::<ProfilePoint>("rough-milled", "profile.csv") else {
        return Ok(drawing(None, ""));
    };
    let points = |what: &str| -> Vec<[f64; 2]> {
        rows.iter().filter(|p| p.what == what).map(|p| [p.x_um, p.z_um]).collect()
    };
    let (surface, cones) = (points("surface"), points("cones"));
    // the part about the widest cone
    let widest = cones.windows(3).filter(|w| w[1][1] > w[0][1] && w[1][1] > w[2][1]);
    let centre =
        widest.max_by(|a, b| (a[2][0] - a[0][0]).total_cmp(&(b[2][0] - b[0][0]))).map_or(0.0, |w| w[1][0]);
    let part = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let start = (centre - 300.0).max(0.0);
        points
            .iter()
            .filter(|p| p[0] >= start && p[0] <= start + 600.0)
            .map(|p| [p[0] - start, p[1]])
            .collect()
    };
    let lines =
        [Series::line("milled surface", part(&surface)), Series::line("plane and cones", part(&cones))];
    let chart = Chart::new("x (µm)", "height (µm)", lines);
    Ok(drawing(
        Some(chart::svg(&chart)?),
        "A line across the generated milled surface under 200 MPa, the height of the plane, and the cone that stands for each island \
         above it: of the island's area and of its mean slope. The height is exaggerated.",
    ))
}

fn maps(results: &Results, name: &str, seen: &str, caption: &str) -> Markup {
    html! {
        div class="row" {
            @for (part, letter) in ROUGH.iter().zip(["(a)", "(b)", "(c)"]) {
                figure {
                    @match results.png(part, name) {
                        Some(uri) => { img src=(uri) alt={ (seen) " of the " (part.trim_start_matches("rough-")) " surface" }; }
                        None => { p class="missing" { "not there" } }
                    }
                    figcaption { (letter) " " (part.trim_start_matches("rough-")) " surface" }
                }
            }
        }
        p { (caption) }
    }
}

fn numbers(results: &Results) -> Markup {
    let mut rows = Vec::new();
    let mut against_itself = Vec::new();
    for ((kind, row), part) in table1::TABLE.iter().zip(ROUGH) {
        let name = kind.name();
        rows.push(vec![
            format!("{name}, paper"),
            format!("{}", row.pressure),
            format!("{}", row.area),
            format!("{}", row.index),
            row.peak.to_string(),
        ]);
        for (closure, source) in CLOSURES {
            let of = |quantity: fn(&ClosureSeeds) -> &Seeds, digits: usize| {
                spread(results.rough(part, closure, quantity), digits)
            };
            rows.push(vec![
                format!("{name}, {}: {source}", closure.name()),
                of(|r| &r.pressure, 0),
                of(|r| &r.area, 2),
                of(|r| &r.index, 3),
                of(|r| &r.peak, 1),
            ]);
        }
        if let Some(row) = results.table1(part) {
            let text = row.against_itself.trim_start_matches("the paper against itself: ");
            against_itself.push(format!("{name}: {text}"));
        }
    }
    html! {
        p { "Steel of 210 GPa, ν = 0.3, H = 1280 MPa under 200 MPa; ours are means and standard deviations of five generated surfaces." }
        (table("Table 1: the paper's line, then each closure's", &["surface, closure", "Pm, MPa", "Ar, %", "ψ", "largest over nominal pressure"], &rows))
        @if !against_itself.is_empty() {
            h3 { "The printed table against itself" }
            ul { @for line in against_itself { li { (line) } } }
        }
    }
}

fn unloading(results: &Results) -> Result<Markup, String> {
    let mut figures = Vec::new();
    for part in ROUGH {
        let Some(curve) = results.rows::<LoadPoint>(part, "load_curve.csv") else { continue };
        let travel = |closure: Closure| {
            let of = |phase: Phase| {
                curve.iter().filter(move |p: &&LoadPoint| p.closure == closure && p.phase == phase)
            };
            let first = of(Phase::Load).next()?.separation_um;
            let points = |phase| of(phase).map(|p| [first - p.separation_um, p.pressure_MPa]).collect();
            Some((closure, [points(Phase::Load), points(Phase::Unload)]))
        };
        let chart = travel_chart([Closure::Johnson, Closure::Calibrated].into_iter().filter_map(travel));
        if !chart.is_empty() {
            figures.push((chart::svg(&chart)?, part.trim_start_matches("rough-")));
        }
    }
    Ok(html! {
        p { "The paper's curves are measured with a device of its own and carry no numbers; these are predictions by the closures that yield." }
        @for (svg, name) in figures { (drawing(Some(svg), &format!("{name} surface, to 200 MPa and back."))) }
    })
}

fn energies(results: &Results) -> Markup {
    let mut rows = Vec::new();
    for (((kind, _), part), [residual, elastic]) in table1::TABLE.iter().zip(ROUGH).zip(TABLE2) {
        let name = kind.name();
        rows.push(vec![
            format!("{name}, paper (measured)"),
            format!("{residual}"),
            format!("{elastic}"),
            format!("{}", 100.0 - elastic),
        ]);
        for closure in [Closure::Johnson, Closure::Calibrated] {
            let share =
                results.rough(part, closure, |r| &r.elastic).map(|s| Spread { mean: s.mean.min(100.0), ..s });
            rows.push(vec![
                format!("{name}, {} (predicted)", closure.name()),
                spread(results.rough(part, closure, |r| &r.residual), 2),
                spread(share, 1),
                spread(share.map(|s| Spread { mean: 100.0 - s.mean, ..s }), 1),
            ]);
        }
    }
    html! {
        (table("Table 2: measured by the paper, predicted by the closures that yield", &["surface", "residual displacement, µm", "elastic energy, %", "plastic energy, %"], &rows))
        p { "Where the law of unloading returns more than the work done, on islands that are shallower than their cones, the share is cut at 100 %." }
    }
}

fn outlook(results: &Results) -> Markup {
    let kinds = table1::TABLE.map(|(kind, _)| kind.name());
    let part = |kind: &str| format!("scales-{kind}");
    let summaries = kinds.map(|kind| results.scales(&part(kind)));
    let rows: Vec<Vec<String>> = kinds
        .iter()
        .zip(&summaries)
        .filter_map(|(kind, found)| {
            let found = found.as_ref()?;
            Some(vec![
                (*kind).into(),
                shown(found.hurst.map(|h| h.value)),
                shown(percent(found.singular_pressure_share)),
                shown(found.hardness_ends_um),
                significant(found.cutoff_um),
            ])
        })
        .collect();
    let charts = [
        ("area.svg", "Contact area as ever finer waves are let in"),
        ("pressure.svg", "Mean pressure"),
        ("regimes.svg", "Share of the load on slopes too steep for an elastic pressure"),
    ];
    html! {
        p { "The paper ends with its next step: the spectral analysis of the slopes of roughness, and the scales that make singular "
            "pressures. Here each surface (1 mm a side, 200 MPa) is pressed at ever finer cut-offs, by an elastic half-space and by one "
            "whose pressure the metal limits. A pressure is singular where the slope of its patch is so steep that a cone of the metal "
            "is fully plastic." }
        (table("Singular pressures of the three surfaces", &["surface", "Hurst exponent", "singular share of the elastic load, %", "hardness ends the growth of pressure from, µm", "cut-off to use, µm"], &rows))
        @for (kind, found) in kinds.iter().zip(&summaries) {
            h3 { (kind) }
            @if let Some(found) = found { p { (found.verdict) } }
            @for (name, caption) in charts { (file(results, &part(kind), name, &format!("{caption}, {kind} surface."))) }
        }
    }
}
