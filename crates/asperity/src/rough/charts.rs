//! Charts of all closures at once.

use crate::draw::chart::{Chart, Dash, Series};
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::closure_contact::{Body, ClosureContact};
use asperity_roughness::CurvePoint;

/// File names and charts of all closures at once, those that show something; `mean_gradient` is that of the
/// surface.
pub(super) fn all(contacts: &[ClosureContact], mean_gradient: f64) -> Vec<(&'static str, Chart)> {
    let charts = [
        ("load_curve.svg", load_curves(contacts)),
        ("closures.svg", closures(contacts, mean_gradient)),
        ("pressure_histogram.svg", histogram(contacts)),
    ];
    let seen = |(_, chart): &(&str, Chart)| chart.series.iter().any(|series| !series.points.is_empty());
    charts.into_iter().filter(seen).collect()
}

/// The closures themselves: pressure on the contact of an island against its slope, to three times the mean
/// slope.
fn closures(contacts: &[ClosureContact], mean_gradient: f64) -> Chart {
    const STEPS: u32 = 120;
    let series = contacts.iter().filter_map(ClosureContact::islands).map(|one| {
        let point = |step| {
            let tan = 3.0 * mean_gradient * f64::from(step) / f64::from(STEPS);
            let response = one.law.respond(tan);
            [tan.atan().to_degrees(), response.island_pressure / response.area_ratio / MEGAPASCAL]
        };
        Series::of_closure(one.law.closure, false, (0..=STEPS).map(point).collect())
    });
    Chart::new("slope of an island (degrees)", "mean pressure on its contact (MPa)", series)
        .titled("What each closure gives an island")
}

/// Pressure against the travel of the plane from first touch.
fn load_curves(contacts: &[ClosureContact]) -> Chart {
    let mut series = Vec::new();
    for one in contacts {
        let first = one.curve().first().map_or(0.0, |p| p.separation);
        let points = |curve: &[CurvePoint]| {
            curve.iter().map(|p| [(first - p.separation) / MICROMETRE, p.pressure / MEGAPASCAL]).collect()
        };
        let series_of = |unloading, curve| {
            let series = Series::of_closure(one.closure, unloading, points(curve));
            if curve.len() > 2 { series } else { ends_only(series) }
        };
        series.push(series_of(false, one.curve()));
        let gains = unloading_lies_above(one.curve(), one.unloading_curve());
        if !one.returns_everything() && !one.unloading_curve().is_empty() && !gains {
            series.push(series_of(true, one.unloading_curve()));
        }
    }
    travel_chart(series)
}

/// True where a way back carries more than the way there at the same separation: energy from nothing, that
/// the unloading law of closures gives where asperities are flatter than the cones it was made for.
pub(super) fn unloading_lies_above(loading: &[CurvePoint], back: &[CurvePoint]) -> bool {
    /// What points of a curve leave between them, of the largest pressure.
    const MARGIN: f64 = 0.02;
    let most = loading.iter().map(|p| p.pressure).fold(0.0, f64::max);
    let loaded = |separation: f64| {
        let after = loading.iter().position(|p| p.separation <= separation)?;
        let [a, b] = [&loading[after.saturating_sub(1)], &loading[after]];
        let whole = a.separation - b.separation;
        let share = if whole > 0.0 { (a.separation - separation) / whole } else { 1.0 };
        Some(a.pressure + share * (b.pressure - a.pressure))
    };
    back.iter().any(|p| loaded(p.separation).is_some_and(|there| p.pressure > there + MARGIN * most))
}

/// Points alone, for nothing is known between them: a line would be read as the curve.
fn ends_only(series: Series) -> Series {
    Series { dash: Some(Dash::Hidden), ..series.marked() }
}

/// A chart of nominal pressure against the travel of the plane.
pub fn travel_chart(series: Vec<Series>) -> Chart {
    Chart::new("travel of the plane from first touch (µm)", "nominal pressure (MPa)", series)
        .titled("Load curve: nominal pressure over the travel of the plane")
}

/// Share of the contact area per step of pressure, against pressure over nominal pressure.
fn histogram(contacts: &[ClosureContact]) -> Chart {
    const STEPS: usize = 60;
    let most = contacts.iter().filter_map(ClosureContact::peak_ratio).fold(0.0, f64::max);
    let width = if most > 0.0 { most / STEPS as f64 } else { 1.0 };
    let series = contacts.iter().filter(|one| one.nominal > 0.0).map(|one| {
        let mut bins = [0.0; STEPS];
        let mut count = |pressure: f32, contact: f32| {
            let ratio = f64::from(pressure) / one.nominal;
            bins[((ratio / width) as usize).min(STEPS - 1)] += f64::from(contact);
        };
        match &one.body {
            Body::Islands(one) => one.field.pixels.iter().for_each(|p| count(p.pressure, p.contact)),
            Body::HalfSpace(one) => {
                one.contact.pressures.iter().filter(|p| **p > 0.0).for_each(|p| count(*p, 1.0));
            }
            Body::Failed(_) => {}
        }
        let total: f64 = bins.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        let points = bins.iter().enumerate().map(|(i, b)| [(i as f64 + 0.5) * width, 100.0 * b / total]);
        Series::of_closure(one.closure, false, points.collect())
    });
    Chart::new("pressure over nominal pressure", format!("contact area per step of {width:.2} (%)"), series)
        .titled("Distribution of the pressure over the contact")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A way back above the way there gains energy and is not drawn; a chart without curves is not written.
    #[test]
    fn what_gains_energy_or_shows_nothing_is_left_out() {
        let curve = |points: &[[f64; 2]]| -> Vec<CurvePoint> {
            let point = |[separation, pressure]: &[f64; 2]| CurvePoint {
                separation: *separation,
                pressure: *pressure,
                area_ratio: 0.0,
            };
            points.iter().map(point).collect()
        };
        let loading = curve(&[[3.0, 0.0], [2.0, 10.0], [1.0, 40.0]]);
        assert!(!unloading_lies_above(&loading, &curve(&[[1.0, 40.0], [1.5, 12.0], [2.0, 0.0]])));
        assert!(unloading_lies_above(&loading, &curve(&[[1.0, 40.0], [2.0, 20.0], [2.5, 0.0]])));
        assert!(all(&[], 0.1).is_empty());
    }
}
