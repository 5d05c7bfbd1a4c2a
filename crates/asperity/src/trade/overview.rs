//! The few lines of a trade that a person reads.

use super::row::TradeRow;
use super::settings::Knob;
use crate::results::numbers::if_any;
use asperity_simulation::scene::ElementChoice;

fn percent(share: Option<f64>) -> String {
    if_any(share.map(|share| format!("{:.2}", 100.0 * share)))
}

/// The numbers of a setting in words.
fn setting(row: &TradeRow) -> String {
    let element = if row.element == Some(ElementChoice::Q4) { "q4" } else { "q8r" };
    format!(
        "front: {element}, {} elements, {} steps, penetration {}, tolerance {}, domain {}",
        if_any(row.elements_in_contact),
        if_any(row.steps),
        if_any(row.penetration),
        if_any(row.newton_tolerance),
        if_any(row.domain)
    )
}

/// The levels, then the Pareto front of the force, cheapest first, as a Markdown table that reads well as
/// text too.
pub fn overview(rows: &[TradeRow]) -> String {
    let mut sorted: Vec<&TradeRow> = rows.iter().filter(|row| row.core_s.is_some()).collect();
    sorted.sort_by(|a, b| a.core_s.unwrap_or(0.0).total_cmp(&b.core_s.unwrap_or(0.0)));
    let (levels, others): (Vec<&TradeRow>, _) = sorted.into_iter().partition(|row| row.knob == Knob::Level);
    let line = |row: &TradeRow| {
        let level = row.around.filter(|_| row.knob == Knob::Level);
        [
            level.map_or_else(|| setting(row), |level| format!("`{level}`")),
            percent(row.force_error),
            percent(row.estimated_error),
            if_any(row.core_s.map(|s| format!("{s:.2}"))),
            if_any(row.newton_iterations),
            if_any(row.dofs),
        ]
    };
    let mut cells =
        vec![["setting", "error of F, %", "stated, %", "core s", "iterations", "unknowns"].map(String::from)];
    cells.extend(levels.into_iter().chain(others.into_iter().filter(|row| row.on_front)).map(line));
    let widths: [usize; 6] =
        std::array::from_fn(|i| cells.iter().map(|row| row[i].chars().count()).max().unwrap_or(0));
    let padded = |row: &[String; 6]| {
        let padded = row.iter().zip(widths).enumerate().map(|(i, (text, width))| match i {
            0 => format!("{text:<width$}"),
            _ => format!("{text:>width$}"),
        });
        format!("| {} |", padded.collect::<Vec<_>>().join(" | "))
    };
    let mut lines: Vec<String> = cells.iter().map(padded).collect();
    let rule = widths.iter().enumerate().map(|(i, width)| match i {
        0 => "-".repeat(*width),
        _ => format!("{}:", "-".repeat(width - 1)),
    });
    lines.insert(1, format!("| {} |", rule.collect::<Vec<_>>().join(" | ")));
    lines.join("\n")
}
