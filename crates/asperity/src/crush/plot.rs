//! `curve.svg`: force against depth, loading and unloading.

use super::{MICROMETRE, force_unit};
use crate::draw::chart::{Chart, Dash, Series, svg};
use crate::draw::palette::LINES;
use asperity_solver::run::record::{CurveRow, Phase};
use asperity_solver::scene::Symmetry;

/// The largest prefix whose numbers are not all below 1: (its SI value, its symbol before the unit).
fn prefix(largest: f64, prefixes: &[(f64, &'static str)]) -> (f64, &'static str) {
    let fits = |p: &&(f64, &str)| largest >= p.0;
    prefixes.iter().find(fits).or(prefixes.last()).copied().unwrap_or((1.0, ""))
}

/// Draws the curve as SVG; unloading starts at the last point of loading, reloads at the last one of unloading.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub fn plot(symmetry: Symmetry, rows: &[CurveRow]) -> Result<String, String> {
    let force = force_unit(symmetry);
    let largest = |value: fn(&CurveRow) -> f64| rows.iter().map(value).fold(0.0, f64::max);
    let (length, length_name) =
        prefix(largest(|r| r.depth) / MICROMETRE, &[(1e3, "mm"), (1.0, "µm"), (1e-3, "nm")]);
    let (newton, newton_name) =
        prefix(largest(|r| r.force) / force.scale, &[(1e3, "kN"), (1.0, "N"), (1e-3, "mN"), (1e-6, "µN")]);
    let per = if symmetry == Symmetry::PlaneStrain { "/mm" } else { "" };

    let point = |r: &CurveRow| [r.depth / MICROMETRE / length, r.force / force.scale / newton];
    let again = rows.iter().position(|r| r.phase == Phase::Reload).unwrap_or(rows.len());
    let branch = |phase: Phase| rows[..again].iter().filter(move |r| r.phase == phase);
    let line = |label: &str, dash: Dash, points: Vec<[f64; 2]>| Series {
        colour: Some(LINES[0]),
        dash: Some(dash),
        ..Series::line(label, points)
    };
    let mut series = vec![line("loading", Dash::Solid, branch(Phase::Load).map(point).collect()).marked()];
    if branch(Phase::Unload).next().is_some() {
        let peak = branch(Phase::Load).next_back();
        let points = peak.into_iter().chain(branch(Phase::Unload)).map(point).collect();
        series.push(line("unloading", Dash::Dashed, points));
    }
    if again < rows.len() {
        let points = rows[again.saturating_sub(1)..].iter().map(point).collect();
        series.push(line("again", Dash::Dotted, points));
    }
    svg(&Chart {
        x_label: format!("Depth h ({length_name})"),
        y_label: format!("Force F ({newton_name}{per})"),
        series,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plot_names_its_axes_and_both_branches() {
        let row = |increment, phase, depth: f64, force: f64| CurveRow {
            increment,
            phase,
            depth,
            force,
            contact_area: 0.0,
            contact_radius: 0.0,
            mean_pressure: 0.0,
            external_work: 0.0,
            elastic_energy: 0.0,
            plastic_work: 0.0,
            contact_energy: 0.0,
            penetration: 0.0,
            newton_iterations: 4,
        };
        let mut rows: Vec<_> = (0..=24)
            .map(|i| {
                let h = f64::from(i) / 24.0;
                row(i as usize, Phase::Load, 5e-6 * h, 5.52 * h * h)
            })
            .collect();
        rows.extend((1..=10).map(|i| {
            let s = 1.0 - f64::from(i) / 10.0;
            row(24 + i as usize, Phase::Unload, 4.475e-6 + 0.525e-6 * s.sqrt(), 5.52 * s)
        }));
        let axisymmetric = plot(Symmetry::Axisymmetric, &rows).unwrap();
        assert!(!axisymmetric.contains("again"));
        let mut cycled = rows.clone();
        cycled.push(row(35, Phase::Reload, 5e-6, 5.52));
        assert!(plot(Symmetry::Axisymmetric, &cycled).unwrap().contains("again"));
        for text in ["Depth h (µm)", "Force F (N)", "loading", "unloading"] {
            assert!(axisymmetric.contains(text), "{text}");
        }
        assert!(plot(Symmetry::PlaneStrain, &rows).unwrap().contains("Force F (mN/mm)"));
        let start = plot(Symmetry::Axisymmetric, &rows[..1]).unwrap();
        assert!(!start.contains("unloading") && !start.contains("NaN"));
    }
}
