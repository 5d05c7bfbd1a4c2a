//! `curve.svg`: force against depth, loading and unloading.

use crate::draw::chart::{Chart, Dash, Series, svg};
use crate::draw::palette::LINES;
use crate::results::columns::Unit;
use crate::results::crush_summary::Summary;
use crate::results::units::{MICROMETRE, per_length};
use asperity_simulation::record::rows::CurveRow;
use asperity_simulation::scene::Symmetry;

/// The largest prefix whose numbers are not all below 1: (its SI value, its symbol before the unit).
fn prefix(largest: f64, prefixes: &[(f64, &'static str)]) -> (f64, &'static str) {
    let fits = |p: &&(f64, &str)| largest >= p.0;
    prefixes.iter().find(fits).or(prefixes.last()).copied().unwrap_or((1.0, ""))
}

/// Draws the curve as SVG; unloading starts at the last point of loading, reloads at the last one of
/// unloading.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub fn plot(symmetry: Symmetry, rows: &[CurveRow]) -> Result<String, String> {
    svg(&chart(symmetry, rows))
}

/// The same under a title that says accuracy and stated error.
///
/// # Errors
/// Those of [`plot`].
pub fn titled_plot(summary: &Summary, rows: &[CurveRow]) -> Result<String, String> {
    svg(&titled_chart(summary, rows))
}

/// The force over the depth under that title.
pub(super) fn titled_chart(summary: &Summary, rows: &[CurveRow]) -> Chart {
    let scene = &summary.scene;
    let error = match summary.errors.force {
        force if force.is_finite() => format!("; band: stated error, {:.2} %", 100.0 * force),
        _ => String::new(),
    };
    let title = format!("Force over depth, accuracy {}{error}", scene.accuracy);
    chart(scene.symmetry, rows).titled(title)
}

/// A quantity over the depth: its name, its column with the unit in the file, and units with their values in
/// that one.
struct Quantity {
    name: &'static str,
    column: fn(&CurveRow) -> f64,
    unit: Unit,
    units: &'static [(f64, &'static str)],
    /// True where `force_error` is its error.
    band: bool,
}

const LENGTHS: &[(f64, &str)] = &[(1e3, "mm"), (1.0, "µm"), (1e-3, "nm")];
const FORCE: Quantity = Quantity {
    name: "Force F",
    column: |r| r.force,
    unit: Unit::Force,
    units: &[(1e3, "kN"), (1.0, "N"), (1e-3, "mN"), (1e-6, "µN")],
    band: true,
};
const AREA: Quantity = Quantity {
    name: "Contact area A",
    column: |r| r.contact_area,
    unit: Unit::Contact,
    units: &[(1e6, "mm²"), (1.0, "µm²"), (1e-6, "nm²")],
    band: false,
};
const WIDTH: Quantity = Quantity { name: "Contact width", units: LENGTHS, ..AREA };
const PRESSURE: Quantity = Quantity {
    name: "Mean pressure",
    column: |r| r.mean_pressure,
    unit: Unit::Pressure,
    units: &[(1e3, "GPa"), (1.0, "MPa"), (1e-3, "kPa")],
    band: false,
};

fn chart(symmetry: Symmetry, rows: &[CurveRow]) -> Chart {
    over_depth(&FORCE, symmetry, rows)
}

/// The contact, and the pressure on it, over the depth.
pub(super) fn contact_charts(symmetry: Symmetry, rows: &[CurveRow]) -> [Chart; 2] {
    let contact = if symmetry == Symmetry::PlaneStrain { WIDTH } else { AREA };
    [contact, PRESSURE].map(|quantity| over_depth(&quantity, symmetry, rows))
}

fn over_depth(quantity: &Quantity, symmetry: Symmetry, rows: &[CurveRow]) -> Chart {
    let written = quantity.unit.value(symmetry);
    let values = |r: &CurveRow| [r.depth / MICROMETRE, (quantity.column)(r) / written];
    let largest = |i: usize| rows.iter().map(|row| values(row)[i]).fold(0.0, f64::max);
    let (length, length_name) = prefix(largest(0), LENGTHS);
    let (unit, unit_name) = prefix(largest(1), quantity.units);
    let per = if quantity.unit == Unit::Force { per_length(symmetry) } else { "" };
    let point = |r: &CurveRow| {
        let [depth, value] = values(r);
        [depth / length, value / unit]
    };
    let next = |from: usize, advances: bool| {
        rows[from..].iter().position(|r| r.phase.advances() == advances).map_or(rows.len(), |i| from + i)
    };
    let peak = next(0, false);
    let again = next(peak, true);
    // each branch begins where the one before it ends
    let edge = |r: &CurveRow, side: f64| {
        let [depth, force] = point(r);
        r.force_error.filter(|_| quantity.band).map(|error| [depth, force * (1.0 + side * error)])
    };
    // up along the upper edge of the stated error, back along the lower one
    let band = |rows: &[CurveRow]| -> Vec<[f64; 2]> {
        let upper = rows.iter().filter_map(|r| edge(r, 1.0));
        upper.chain(rows.iter().rev().filter_map(|r| edge(r, -1.0))).collect()
    };
    let branch = |label: &str, dash: Dash, from: usize, to: usize| Series {
        colour: Some(LINES[0]),
        dash: Some(dash),
        band: band(&rows[from.saturating_sub(1)..to]),
        ..Series::line(label, rows[from.saturating_sub(1)..to].iter().map(point).collect::<Vec<_>>())
    };
    let mut series = vec![branch("loading", Dash::Solid, 0, peak).marked()];
    if peak < again {
        series.push(branch("unloading", Dash::Dashed, peak, again));
    }
    if again < rows.len() {
        series.push(branch("reloading", Dash::Dotted, again, rows.len()));
    }
    let name = format!("{} ({unit_name}{per})", quantity.name);
    Chart::new(format!("Depth h ({length_name})"), name, series)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_simulation::record::rows::Phase;

    #[test]
    fn the_plot_names_its_axes_and_both_branches() {
        let row = |increment, phase, depth_um: f64, force: f64| CurveRow {
            increment,
            phase,
            depth: depth_um * MICROMETRE,
            force,
            contact_area: 0.0,
            contact_radius: 0.0,
            mean_pressure: 0.0,
            external_work: 0.0,
            elastic_energy: 0.0,
            plastic_work: 0.0,
            contact_energy: 0.0,
            friction_work: None,
            penetration: 0.0,
            compliance_depth: 0.0,
            newton_iterations: 4,
            force_nodal: force,
            force_error: None,
            area_error: None,
            transfer_energy: 0.0,
        };
        let mut rows: Vec<_> = (0..=24)
            .map(|i| {
                let h = f64::from(i) / 24.0;
                row(i as usize, Phase::Load, 5.0 * h, 5.52 * h * h)
            })
            .collect();
        rows.extend((1..=10).map(|i| {
            let s = 1.0 - f64::from(i) / 10.0;
            row(24 + i as usize, Phase::Unload, 4.475 + 0.525 * s.sqrt(), 5.52 * s)
        }));
        let axisymmetric = plot(Symmetry::Axisymmetric, &rows).unwrap();
        assert!(!axisymmetric.contains("reloading"));
        let mut cycled = rows.clone();
        cycled.push(row(35, Phase::Reload, 5.0, 5.52));
        assert!(plot(Symmetry::Axisymmetric, &cycled).unwrap().contains("reloading"));
        for text in ["Depth h (µm)", "Force F (N)", "loading", "unloading"] {
            assert!(axisymmetric.contains(text), "{text}");
        }
        // 5.52 N/m
        assert!(plot(Symmetry::PlaneStrain, &rows).unwrap().contains("Force F (mN/mm)"));
        let start = plot(Symmetry::Axisymmetric, &rows[..1]).unwrap();
        assert!(!start.contains("unloading") && !start.contains("NaN"));
    }
}
