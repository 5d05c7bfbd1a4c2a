//! Charts of a surface at all its scales, over the cut-off.

use crate::chart::{Chart, Dash, Series};
use crate::palette;
use asperity_roughness::Closure;
use asperity_roughness::scales::{By, Numbers, Scales};

/// A number of a contact over which a chart is drawn, and its unit in SI.
type Column = (fn(&Numbers) -> Option<f64>, f64);

/// Share of the largest density below which a wave is there by rounding alone.
const ROUNDED: f64 = 1e-20;

/// The charts of `found` with the names of their files; those without a point are left out.
pub fn scale_charts(found: &Scales) -> Vec<(&'static str, Chart)> {
    let largest = found.spectrum.iter().filter_map(|point| point.areal).fold(0.0, f64::max);
    let spectrum = found.spectrum.iter().filter_map(|point| {
        let density = point.areal.filter(|density| *density > ROUNDED * largest)?;
        Some([point.frequency * 1e-6, density * 1e24])
    });
    let spectrum = Series::line("mean over all directions", spectrum.collect());
    let slopes = found.steps.iter().map(|step| [step.cutoff * 1e6, step.slopes.rms]);
    let slopes = Series::line("rms slope", slopes.collect()).marked();
    let charts = [
        (
            "spectrum.svg",
            Chart::new("frequency (1/µm)", "density (µm⁴)", [spectrum])
                .titled("Power spectrum of the whole map")
                .logarithmic([true; 2]),
        ),
        ("slope.svg", over_cutoff("rms slope", "Rms slope of the waves above the cut-off", [slopes])),
        (
            "area.svg",
            by_scale(
                found,
                "contact area ratio",
                "Contact area by scale",
                (|one| one.area.map(|area| area.corrected).or(one.area_ratio), 1.0),
            ),
        ),
        (
            "pressure.svg",
            by_scale(found, "mean pressure (MPa)", "Mean pressure by scale", (|one| one.mean_pressure, 1e6)),
        ),
        ("gap.svg", by_scale(found, "mean gap (µm)", "Mean gap by scale", (|one| one.mean_gap, 1e-6))),
        ("leak.svg", by_scale(found, "leak along x (µm³)", "Leak by scale", (|one| one.leaks[0], 1e-18))),
        (
            "regimes.svg",
            by_scale(
                found,
                "share of the load",
                "Load on fully plastic patches by scale",
                (|one| one.by_load[2], 1.0),
            ),
        ),
    ];
    charts.into_iter().filter(|(_, chart)| !chart.is_empty()).collect()
}

fn over_cutoff(label: &str, title: &str, lines: impl IntoIterator<Item = Series>) -> Chart {
    Chart::new("cut-off (µm)", label, lines).titled(title).logarithmic([true, false])
}

/// Colour and dash of a contact: a closure has its colour of every chart, a theory that of the half-space
/// that it stands for.
fn look(by: By) -> (palette::Colour, Dash) {
    let (closure, dash) = match by {
        By::Elastic => (Closure::HalfSpace, Dash::Solid),
        By::Limited => (Closure::HalfSpacePlastic, Dash::Solid),
        By::LimitedBySlope => (Closure::HalfSpacePlastic, Dash::Long),
        By::Persson => (Closure::HalfSpace, Dash::Dotted),
        By::PerssonLimited => (Closure::HalfSpacePlastic, Dash::Dotted),
        By::Bearing => (Closure::HalfSpacePlastic, Dash::Dashed),
        By::Islands(name) => {
            let named = Closure::ALL.into_iter().find(|closure| closure.name() == name);
            (named.unwrap_or(Closure::Custom), Dash::Solid)
        }
    };
    (palette::closure(closure), dash)
}

fn by_scale(found: &Scales, label: &str, title: &str, (of, unit): Column) -> Chart {
    let mut names: Vec<By> = Vec::new();
    for (by, _) in found.steps.iter().flat_map(|step| &step.contacts) {
        if !names.contains(by) {
            names.push(*by);
        }
    }
    let series = names.into_iter().filter_map(|by| {
        let points = found.contacts(by).filter_map(|(step, one)| Some([step.cutoff * 1e6, of(one)? / unit]));
        let points: Vec<[f64; 2]> = points.collect();
        let (colour, dash) = look(by);
        let line = Series { colour: Some(colour), dash: Some(dash), ..Series::line(by.name(), points) };
        (!line.points.is_empty()).then(|| line.marked())
    });
    over_cutoff(label, title, series)
}
