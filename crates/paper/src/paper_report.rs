//! The report: one self-contained page, its claims as JSON, and its overview as a table for a page of text.

use super::claims::claims;
use super::figures;
use super::plan::{Item, Part, Work, parts};
use super::results_reader::Results;
use super::verdict::{Claim, RULE, Verdict};
use asperity::crush::Summary;
use asperity::page::document;
use asperity::simulation::scene::Accuracy;
use asperity::units::MICROMETRE;
use maud::{Markup, html};
use std::collections::BTreeMap;
use std::fmt::Write;

const PAPER: &str = "Jourani, Dellaleau, Dursapt, Hamdi, Sidoroff, Zahouani: Effect of local slopes of roughness during contact between solids";

/// The files of the report.
#[derive(Clone, Debug)]
pub struct Report {
    /// index.html.
    pub html: String,
    /// claims.json.
    pub claims_json: String,
    /// claims.md.
    pub claims_markdown: String,
    /// numbers.md.
    pub numbers_markdown: String,
    /// A few lines for the terminal.
    pub overview: String,
}

/// The report on `items`.
///
/// # Errors
/// A text for a person where a chart cannot be drawn.
pub(super) fn report(results: &Results, items: &[Item], accuracy: Accuracy) -> Result<Report, String> {
    let level = accuracy.to_string();
    let wanted = |claim: &Claim| items.iter().any(|item| item.name == claim.item);
    let claims: Vec<Claim> = claims(results).into_iter().filter(wanted).collect();
    let count = |verdict: Verdict| claims.iter().filter(|c| c.verdict == verdict).count();
    let tally = Verdict::ALL.map(|v| format!("{} {}", count(v), v.words())).join(", ");
    let numbers = numbers(results);
    let by_name: BTreeMap<&str, f64> = numbers.iter().map(|n| (n.name, n.value)).collect();
    let value = serde_json::json!({
        "accuracy": level, "version": env!("CARGO_PKG_VERSION"), "numbers": by_name, "claims": claims,
    });
    Ok(Report {
        html: page(results, items, &claims, &level)?,
        claims_json: format!("{value:#}\n"),
        claims_markdown: markdown(&claims, &level),
        numbers_markdown: numbers_markdown(&numbers, &level),
        overview: format!("claims    {tally}"),
    })
}

/// A result in figures.
struct Number {
    /// Its key in claims.json.
    name: &'static str,
    /// Its name on a page of text.
    words: &'static str,
    value: f64,
    /// Digits after the point on a page of text.
    decimals: usize,
}

/// The numbers that pages of text quote; those of parts that were not asked for are left out.
fn numbers(results: &Results) -> Vec<Number> {
    let single = "single-asperity";
    let summary = results.summary(single);
    let summary = |quantity: fn(&Summary) -> Option<f64>| summary.as_ref().and_then(quantity);
    let percent = |quantity| summary(quantity).map(|share| 100.0 * share);
    let fit = results.fit();
    let coefficient = fit.as_ref().and_then(|fit| fit.coefficient);
    let mean = fit.as_ref().and_then(|fit| fit.coefficient_mean_ratio);
    let interval = fit.as_ref().and_then(|fit| fit.ci95);
    let model = fit.as_ref().and_then(|fit| fit.model_interval);
    let all = [
        ("force_at_1_um_N", "force at 1 µm, N", results.force_at(single, 1.0), 3),
        ("force_at_2_um_N", "force at 2 µm, N", results.force_at(single, 2.0), 3),
        ("force_at_5_um_N", "force at 5 µm, N", results.force_at(single, 5.0), 3),
        ("force_error_percent", "error of the force, stated, %", percent(|s| Some(s.estimated_error)), 2),
        ("residual_depth_um", "residual depth, µm", summary(|s| s.residual_depth.map(|h| h / MICROMETRE)), 3),
        ("elastic_share_percent", "elastic share of the work, %", percent(|s| s.elastic_fraction), 1),
        ("unknowns", "unknowns", summary(|s| Some(s.dofs as f64)), 0),
        ("newton_iterations", "Newton iterations", summary(|s| Some(s.newton_iterations as f64)), 0),
        ("coefficient", "c of ε_r = c tan β, from 480 sharp cones, by least squares", coefficient, 3),
        ("coefficient_mean_ratio", "the same as mean of ε_r/tan β", mean, 3),
        (
            "coefficient_low",
            "95 % interval of the arithmetic (other cases drawn, K shifted by its error), from",
            interval.map(|i| i[0]),
            3,
        ),
        ("coefficient_high", "to", interval.map(|i| i[1]), 3),
        (
            "coefficient_model_low",
            "interval of the model (over parts of the metals and slopes), from",
            model.map(|i| i[0]),
            3,
        ),
        ("coefficient_model_high", "to", model.map(|i| i[1]), 3),
    ];
    let known = |(name, words, value, decimals): (_, _, Option<f64>, _)| {
        Some(Number { name, words, value: value.filter(|v| v.is_finite())?, decimals })
    };
    all.into_iter().filter_map(known).collect()
}

/// The numbers as a table for a page of text.
fn numbers_markdown(numbers: &[Number], level: &str) -> String {
    let mut text = format!("| | ours at `{level}` |\n|-|-|\n");
    for Number { words, value, decimals, .. } in numbers {
        let _ = writeln!(text, "| {words} | {value:.decimals$} |");
    }
    text
}

/// A sign beside the colour.
fn sign(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::BorneOut => "✓",
        Verdict::BorneOutInPart => "◐",
        Verdict::Contradicted => "✗",
        Verdict::CannotBeJudged => "?",
    }
}

fn verdict(verdict: Verdict) -> Markup {
    let class = verdict.words().replace(' ', "-");
    html! { span class={ "verdict " (class) } { (sign(verdict)) " " (verdict.words()) } }
}

fn page(results: &Results, items: &[Item], claims: &[Claim], level: &str) -> Result<String, String> {
    let sections = items.iter().map(|item| section(*item, results, claims, level));
    let sections = sections.collect::<Result<Vec<Markup>, String>>()?;
    let parts = parts(items);
    let promise = match level {
        "draft" => "5 %",
        "standard" => "1 %",
        "reference" => "0.2 %",
        percentage => percentage,
    };
    let body = html! {
        header {
            h1 { "The paper, computed" }
            p { (PAPER) ". What its text and figures claim, beside what this program computes from the data it prints; accuracy "
                strong { (level) } " (forces of the finite elements to " (promise) "), version " (env!("CARGO_PKG_VERSION")) "." }
        }
        nav aria-label="Contents" {
            a href="#claims" { "Claims" }
            @for item in items { a href={ "#" (item.name) } { (short(item)) } }
            a href="#scenes" { "Scenes" }
        }
        main {
            h2 id="claims" { "Claims of the paper" }
            (tally(claims))
            div class="wide" { table id="overview" {
                caption { "Each claim of the paper beside what was computed." }
                thead { tr { th scope="col" { "verdict" } th scope="col" { "claim of the paper" } th scope="col" { "ours" } th scope="col" { "where" } } }
                tbody { @for claim in claims { tr {
                    td { (verdict(claim.verdict)) }
                    td { (claim.claim) }
                    td {
                        (claim.ours)
                        @if claim.verdict != Verdict::BorneOut && !claim.why.is_empty() { p class="cause" { (claim.why) } }
                    }
                    td class="place" { a href={ "#" (claim.item) } { (claim.place) } }
                } } }
            } }
            p { (RULE) }
            @for section in &sections { (section) }
            h2 id="scenes" { "Scenes" }
            p { "Everything above was computed from these files and nothing else; " code { "asperity crush" } " and "
                code { "asperity rough" } " run them one by one." }
            @for part in &parts { (scene(part, results)) }
        }
    };
    Ok(document("The paper, computed", &body))
}

fn tally(claims: &[Claim]) -> Markup {
    html! {
        div class="tally" {
            @for v in Verdict::ALL {
                span { strong { (claims.iter().filter(|c| c.verdict == v).count()) } " " (verdict(v)) }
            }
        }
    }
}

/// "Figure 1" of "Figure 1. Geometry of an asperity".
fn short(item: &Item) -> &'static str {
    item.title.split('.').next().unwrap_or(item.title)
}

fn section(item: Item, results: &Results, claims: &[Claim], level: &str) -> Result<Markup, String> {
    let body = figures::body(item, results)?;
    let own: Vec<&Claim> = claims.iter().filter(|claim| claim.item == item.name).collect();
    let parts = parts(&[item]);
    Ok(html! {
        section {
            h2 id=(item.name) { (item.title) }
            (body)
            @if !own.is_empty() {
                h3 { "What the paper says of it" }
                ul { @for claim in own { li {
                    (verdict(claim.verdict)) " " (claim.place) ": " (claim.claim) ". Ours: " (claim.ours) ". " (claim.why)
                } } }
            }
            @for part in &parts {
                @if let Some(why) = results.stamp(part.name).and_then(|stamp| stamp.stopped.as_ref()) {
                    p class="missing" { (part.name) " " (why) "; what it reached is shown." }
                }
            }
            p class="again" {
                "Again: " code { "asperity reproduce --accuracy " (level) " --only " (item.name) }
                "; scenes: "
                @for (i, part) in parts.iter().enumerate() {
                    @if i > 0 { ", " }
                    a href={ "#scene-" (part.name) } { (part.name) }
                }
            }
        }
    })
}

/// A scene as it stands in its file, how to run it alone, and how long it took.
fn scene(part: &Part, results: &Results) -> Markup {
    let sets = |changes: &[&str]| changes.iter().map(|c| format!(" --set \"{c}\"")).collect::<String>();
    let (text, command) = match part.work {
        Work::Crush { scene, changes, .. } => {
            let file = part.name.replace("-finest", "").replace("-finer", "");
            (scene, format!("asperity crush meshes/{file}.toml{}", sets(changes)))
        }
        Work::Rough { scene, changes, .. } => {
            let name = part.name;
            let alone = format!("asperity rough meshes/{name}.toml{}", sets(changes));
            (scene, format!("{alone}, and asperity rough --table1"))
        }
        Work::Scales { scene, changes } => {
            let file = part.name.replace("scales", "rough");
            (scene, format!("asperity scales meshes/{file}.toml{}", sets(changes)))
        }
        Work::Calibrate => (
            "# the defaults: 10 slopes, 3 moduli, 4 yield stresses, 4 exponents",
            "asperity calibrate".into(),
        ),
    };
    let time = results.stamp(part.name).map(|stamp| format!("took {:.1} s", stamp.wall_s));
    html! {
        details id={ "scene-" (part.name) } {
            summary { (part.name) @if let Some(time) = time { " (" (time) ")" } }
            p { code { (command) } }
            pre { (text) }
        }
    }
}

fn markdown(claims: &[Claim], level: &str) -> String {
    let mut text = format!("| claim of the paper | where | ours at `{level}` | verdict |\n|-|-|-|-|\n");
    for claim in claims {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} |",
            claim.claim,
            claim.place,
            claim.ours,
            claim.verdict.words()
        );
    }
    text
}
