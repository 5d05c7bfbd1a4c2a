//! Each figure and table of the paper: ours, beside what the paper prints.

use super::claims::{ROUGH, SETS, SYMMETRIES, TABLE2, islands, kick_exponent, significant};
use super::evidence::{Evidence, Spread};
use super::plan::Item;
use crate::draw::chart::{self, Chart, Series};
use crate::press::table1;
use maud::{Markup, PreEscaped, html};

/// The closures of Tables 1 and 2, and what they are.
const CLOSURES: [(&str, &str); 5] = [
    ("published", "0.13 E* tan β (eq. [11])"),
    ("fitted", "the same with our c"),
    ("johnson", "eqs [18]–[20], mended, capped at H"),
    ("sneddon", "exact elastic cone"),
    ("calibrated", "our elastoplastic cones"),
];

/// What a section shows.
pub fn body(item: Item, evidence: &Evidence) -> Result<Markup, String> {
    let body = match item.name {
        "fig1" => geometry(evidence),
        "fig2" => single(evidence),
        "fig3" => load_curve(
            evidence,
            "rough-milled",
            "A generated milled surface with the printed Ra and slope, pressed and released; every closure. The paper's curve is measured and prints no number, so this is a prediction.",
        ),
        "fig4" => sketch(
            evidence,
            "three-identical",
            "elements",
            "Three asperities of 20 µm and 10° at the end of the crush: the elements in the section of a body of revolution, a cone and two rings. The paper does not say whether its model is axisymmetric; both idealisations are computed.",
        ),
        "fig5" => return zones(evidence),
        "fig6" => return sets(evidence),
        "fig7" => html! {
            (file(evidence, "calibrate", "collapse.svg", "K/σr of all metals at one slope, at the representative strain that mixes the curves best: one curve for every exponent n, as in the paper's figure."))
            (file(evidence, "calibrate", "collapse_all.svg", "All slopes in one: K tan²β/σr against E* tan β/σr."))
        },
        "fig8" => html! {
            (file(evidence, "calibrate", "representative_strain.svg", "The representative strain of every slope with its 95 % interval, our line and the published one."))
            (strains(evidence))
        },
        "fig9" => return profile(evidence),
        "fig11" => maps(
            evidence,
            "topography.png",
            "Heights in µm; surfaces generated with the printed Ra and mean slope, 2 mm a side. The paper's own surfaces are not public.",
        ),
        "fig12" => maps(
            evidence,
            "pressure-published.png",
            "Pressure under a nominal 200 MPa by the paper's closure; colours end where 99 % of the loaded pixels do.",
        ),
        "fig13" => maps(
            evidence,
            "contact-published.png",
            "Contact areas by regime, by the paper's closure and its thresholds.",
        ),
        "table1" => numbers(evidence),
        "fig15" => unloading(evidence)?,
        "table2" => energies(evidence),
        _ => html! {},
    };
    Ok(body)
}

/// A drawing, or that there is none.
fn drawing(svg: Option<String>, caption: &str) -> Markup {
    html! {
        figure {
            @match svg {
                Some(svg) => { div class="drawing" { (PreEscaped(svg)) } }
                None => { p class="missing" { "This part is not there: it was not asked for, or could not be done." } }
            }
            figcaption { (caption) }
        }
    }
}

fn file(evidence: &Evidence, part: &str, name: &str, caption: &str) -> Markup {
    drawing(evidence.text(part, name), caption)
}

fn sketch(evidence: &Evidence, part: &str, start: &str, caption: &str) -> Markup {
    drawing(evidence.sketch(part, start), caption)
}

fn load_curve(evidence: &Evidence, part: &str, caption: &str) -> Markup {
    file(evidence, part, "load_curve.svg", caption)
}

/// A table of a head and rows; the first column is text, the others are numbers.
fn table(head: &[&str], rows: &[Vec<String>]) -> Markup {
    html! {
        div class="wide" { table {
            thead { tr { @for (i, cell) in head.iter().enumerate() { th class=[(i > 0).then_some("number")] { (cell) } } } }
            tbody { @for row in rows { tr {
                @for (i, cell) in row.iter().enumerate() { td class=[(i > 0).then_some("number")] { (cell) } }
            } } }
        } }
    }
}

/// A number with its unit scale, or a dash.
fn shown(value: Option<f64>) -> String {
    value.map_or_else(|| "–".into(), significant)
}

fn spread(value: Option<Spread>, digits: usize) -> String {
    value.map_or_else(
        || "–".into(),
        |s| {
            let deviation = format!("{:.digits$}", s.deviation);
            let seen = !deviation.trim_matches(['0', '.']).is_empty();
            if seen { format!("{:.digits$} ± {deviation}", s.mean) } else { format!("{:.digits$}", s.mean) }
        },
    )
}

fn percent(value: Option<f64>) -> Option<f64> {
    value.map(|v| 100.0 * v)
}

fn geometry(evidence: &Evidence) -> Markup {
    html! {
        (sketch(evidence, "single-asperity", "elements", "The asperity at the end of the crush with its elements: height 20 µm, attack angle 10°, tip radius 10 µm, as printed; the base radius follows."))
    }
}

fn single(evidence: &Evidence) -> Markup {
    let part = "single-asperity";
    let force = |depth: f64| shown(evidence.force_at(part, depth));
    let error = percent(evidence.summary(part, "estimated_error"));
    let rows = [
        ("force at 1 µm, N", force(1.0)),
        ("force at 2 µm, N", force(2.0)),
        ("force at 5 µm, N", force(5.0)),
        ("estimated error of the force, %", shown(error)),
        ("residual depth, µm", shown(evidence.summary(part, "residual_depth"))),
        ("stiffness of unloading, N/µm", shown(evidence.summary(part, "unloading_stiffness"))),
        ("elastic share of the work, %", shown(percent(evidence.summary(part, "elastic_fraction")))),
        ("contact radius at 5 µm, µm", shown(evidence.summary(part, "contact_radius"))),
        ("exponent of F over h, upper half", shown(kick_exponent(evidence))),
    ];
    let rows: Vec<Vec<String>> =
        rows.into_iter().map(|(name, value)| vec![name.into(), value, "not printed".into()]).collect();
    html! {
        (file(evidence, part, "curve.svg", "Force against depth of the paper's asperity, loading and unloading."))
        (table(&["", "ours", "paper"], &rows))
        (sketch(evidence, part, "section", "The peak: pressure of the tool, von Mises stress, plastic strain and hydrostatic pressure on the deformed section."))
    }
}

fn zones(evidence: &Evidence) -> Result<Markup, String> {
    let rows: Vec<Vec<String>> = SYMMETRIES
        .iter()
        .flat_map(|(end, symmetry)| {
            let part = format!("three-identical{end}");
            let found = islands(evidence, &part).unwrap_or_default();
            found
                .into_iter()
                .map(|island| {
                    let number = |key: &str| shown(island[key].as_f64());
                    let place = [0, 1].map(|k| shown(island["place_um"][k].as_f64()));
                    vec![
                        (*symmetry).to_string(),
                        place.join(", "),
                        number("area_um2"),
                        number("mean_pressure_MPa"),
                    ]
                })
                .collect::<Vec<_>>()
        })
        .collect();
    Ok(html! {
        p { "The tool has come down by the whole height of the asperities. The paper draws where the von Mises stress is below "
            "the first yield stress; below are the line of that stress, and what the metal itself says: where it never yielded, "
            "where it has yielded but is elastic now, and where it flows." }
        @for (end, symmetry) in SYMMETRIES {
            h3 { (symmetry) }
            (sketch(evidence, &format!("three-identical{end}"), "zones", "Elastic zones and hydrostatic pressure at the end of the crush."))
        }
        @if rows.is_empty() {
            p { "No region of the asperities stays without any plastic strain." }
        } @else {
            (table(&["symmetry", "place r, z (µm)", "area (µm²)", "mean pressure (MPa)"], &rows))
        }
        h3 { "The state of the whole row" }
        (sketch(evidence, "three-identical", "section", "Body of revolution: pressure of the tool and fields of the row."))
    })
}

fn sets(evidence: &Evidence) -> Result<Markup, String> {
    let labels = ["1–4° (rectified)", "5–8° (milled)", "9–12° (sanded)"];
    let mut figures = Vec::new();
    let mut rows = Vec::new();
    for (end, symmetry) in SYMMETRIES {
        let unit = if end.is_empty() { "N" } else { "N/mm" };
        let mut series = Vec::new();
        for (set, label) in SETS.iter().zip(labels) {
            let part = format!("{set}{end}");
            let Some(curve) = evidence.table(&part, "curve.csv") else { continue };
            series.push(Series {
                label: label.into(),
                points: curve.points("depth_um", "force_", &[]),
                marks: false,
            });
            rows.push(vec![
                format!("{label}, {symmetry}"),
                format!("{} {unit}", shown(evidence.summary(&part, "peak_force"))),
                shown(percent(evidence.summary(&part, "estimated_error"))),
                shown(evidence.summary(&part, "total_work")),
                shown(percent(evidence.summary(&part, "elastic_fraction"))),
                shown(evidence.summary(&part, "residual_depth")),
            ]);
        }
        let chart = Chart { x_label: "Depth h (µm)".into(), y_label: format!("Force F ({unit})"), series };
        let svg = if chart.series.is_empty() { None } else { Some(chart::svg(&chart)?) };
        figures.push((svg, symmetry));
    }
    Ok(html! {
        @for (svg, symmetry) in figures {
            (drawing(svg, &format!("Four asperities of 20 µm, loading to 5 µm and unloading, {symmetry}. The paper's curves carry no numbers in its text.")))
        }
        (table(&["set", "peak force", "error of the force, %", "total work, µJ or µJ/mm", "elastic share, %", "residual depth, µm"], &rows))
    })
}

fn strains(evidence: &Evidence) -> Markup {
    let fit = evidence.json("calibrate", "fit.json").unwrap_or_default();
    let rows: Vec<Vec<String>> = fit["per_angle"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|angle| {
            let number = |key: &str| angle[key].as_f64();
            let beta = number("beta_deg")?;
            let tan = beta.to_radians().tan();
            let published = fit["published"].as_f64()? * tan;
            let ours = number("representative_strain");
            let strain = |v: Option<f64>| v.map_or_else(|| "–".into(), |v| format!("{v:.5}"));
            Some(vec![
                format!("{beta}°"),
                strain(ours),
                format!("{} … {}", strain(number("low")), strain(number("high"))),
                strain(Some(published)),
                ours.map_or_else(|| "–".into(), |v| format!("{:+.0} %", 100.0 * (v / published - 1.0))),
                ours.map_or_else(|| "–".into(), |v| format!("{:.4}", v / tan)),
            ])
        })
        .collect();
    table(&["slope", "εr, ours", "95 %", "0.13 tan β (published)", "ours over published", "εr/tan β"], &rows)
}

fn profile(evidence: &Evidence) -> Result<Markup, String> {
    let Some(rows) = evidence.table("rough-milled", "profile.csv") else { return Ok(drawing(None, "")) };
    let points = |what: &str| rows.points("x_um", "z_um", &[("what", what)]);
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
    let series =
        |label: &str, points: &[[f64; 2]]| Series { label: label.into(), points: part(points), marks: false };
    let chart = Chart {
        x_label: "x (µm)".into(),
        y_label: "height (µm)".into(),
        series: vec![series("milled surface", &surface), series("plane and cones", &cones)],
    };
    Ok(drawing(
        Some(chart::svg(&chart)?),
        "A line across the generated milled surface under 200 MPa, the height of the plane, and the cone that stands for each island \
         above it: of the island's area and of its mean slope. The height is exaggerated.",
    ))
}

fn maps(evidence: &Evidence, name: &str, caption: &str) -> Markup {
    html! {
        div class="row" {
            @for (part, letter) in ROUGH.iter().zip(["(a)", "(b)", "(c)"]) {
                figure {
                    @match evidence.png(part, name) {
                        Some(uri) => { img src=(uri) alt={ (letter) " " (part) ", " (name) }; }
                        None => { p class="missing" { "not there" } }
                    }
                    figcaption { (letter) " " (part.trim_start_matches("rough-")) " surface" }
                }
            }
        }
        p { (caption) }
    }
}

fn numbers(evidence: &Evidence) -> Markup {
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
        for (closure, what) in CLOSURES {
            let of = |quantity: &str, digits: usize| spread(evidence.rough(part, closure, quantity), digits);
            rows.push(vec![
                format!("{name}, {closure}: {what}"),
                of("pressure", 0),
                of("area", 2),
                of("index", 3),
                of("peak", 1),
            ]);
        }
        if let Some(text) =
            evidence.json(part, "table1.json").as_ref().and_then(|t| t["against_itself"].as_str())
        {
            against_itself.push(format!("{name}: {}", text.trim_start_matches("the paper against itself: ")));
        }
    }
    html! {
        p { "Steel of 210 GPa, ν = 0.3, H = 1280 MPa under 200 MPa; ours are means and standard deviations of five generated surfaces." }
        (table(&["surface, closure", "Pm, MPa", "Ar, %", "ψ", "largest over nominal pressure"], &rows))
        @if !against_itself.is_empty() {
            h3 { "The printed table against itself" }
            ul { @for line in against_itself { li { (line) } } }
        }
    }
}

fn unloading(evidence: &Evidence) -> Result<Markup, String> {
    let mut figures = Vec::new();
    for part in ROUGH {
        let Some(curve) = evidence.table(part, "load_curve.csv") else { continue };
        let mut series = Vec::new();
        for closure in ["johnson", "calibrated"] {
            let both = |phase: &str| {
                curve.points("separation_um", "pressure_MPa", &[("closure", closure), ("phase", phase)])
            };
            let loading = both("load");
            let Some(first) = loading.first().map(|p| p[0]) else { continue };
            for (name, points) in [("loading", loading), ("unloading", both("unload"))] {
                let travel = points.iter().map(|p| [first - p[0], p[1]]).collect();
                series.push(Series { label: format!("{closure}, {name}"), points: travel, marks: false });
            }
        }
        if !series.is_empty() {
            let chart = Chart {
                x_label: "travel of the plane from first touch (µm)".into(),
                y_label: "nominal pressure (MPa)".into(),
                series,
            };
            figures.push((chart::svg(&chart)?, part.trim_start_matches("rough-")));
        }
    }
    Ok(html! {
        p { "The paper's curves are measured with a device of its own and carry no numbers; these are predictions by the closures that yield." }
        @for (svg, name) in figures { (drawing(Some(svg), &format!("{name} surface, to 200 MPa and back."))) }
    })
}

fn energies(evidence: &Evidence) -> Markup {
    let mut rows = Vec::new();
    for (((kind, _), part), [residual, elastic]) in table1::TABLE.iter().zip(ROUGH).zip(TABLE2) {
        let name = kind.name();
        rows.push(vec![
            format!("{name}, paper (measured)"),
            format!("{residual}"),
            format!("{elastic}"),
            format!("{}", 100.0 - elastic),
        ]);
        for closure in ["johnson", "calibrated"] {
            let share =
                evidence.rough(part, closure, "elastic").map(|s| Spread { mean: s.mean.min(100.0), ..s });
            rows.push(vec![
                format!("{name}, {closure} (predicted)"),
                spread(evidence.rough(part, closure, "residual"), 2),
                spread(share, 1),
                spread(share.map(|s| Spread { mean: 100.0 - s.mean, ..s }), 1),
            ]);
        }
    }
    html! {
        (table(&["surface", "residual displacement, µm", "elastic energy, %", "plastic energy, %"], &rows))
        p { "Where the law of unloading returns more than the work done, on islands that are shallower than their cones, the share is cut at 100 %." }
    }
}
