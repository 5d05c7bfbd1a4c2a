//! Charts of all closures at once.

use crate::draw::chart::{Chart, Dash, Series};
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::closure_contact::{Body, ClosureContact};
use asperity_roughness::{Closure, CurvePoint};

/// File names and charts of all closures at once, without those that show nothing; `mean_gradient` is that of
/// the surface.
pub(super) fn all(
    contacts: &[ClosureContact],
    mean_gradient: f64,
) -> impl Iterator<Item = (&'static str, Chart)> {
    let charts = [
        ("load_curve.svg", load_curves(contacts)),
        ("closures.svg", closures(contacts, mean_gradient)),
        ("pressure_histogram.svg", histogram(contacts)),
    ];
    charts.into_iter().filter(|(_, chart)| !chart.is_empty())
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
    let curves = contacts.iter().map(|one| {
        let first = one.curve().first().map_or(0.0, |p| p.separation);
        let points = |curve: &[CurvePoint]| {
            curve.iter().map(|p| [(first - p.separation) / MICROMETRE, p.pressure / MEGAPASCAL]).collect()
        };
        let back = if one.returns_everything() { &[][..] } else { one.unloading_curve() };
        (one.closure, [points(one.curve()), points(back)])
    });
    travel_chart(curves)
}

/// Excess of unloading over loading, relative to the largest pressure, that a picture would show.
const VISIBLE_EXCESS: f64 = 0.01;

/// True where the unloading carries more than the loading at the same travel, both as points (travel,
/// pressure): it would give work from nothing.
fn lies_above(unloading: &[[f64; 2]], loading: &[[f64; 2]]) -> bool {
    let peak = loading.iter().map(|point| point[1]).fold(0.0, f64::max);
    let loaded = |travel: f64| {
        let pair = loading.windows(2).find(|pair| (pair[0][0]..=pair[1][0]).contains(&travel))?;
        let [[x, p], [to, p_to]] = [pair[0], pair[1]];
        Some(if to > x { p + (p_to - p) * (travel - x) / (to - x) } else { p.max(p_to) })
    };
    unloading.iter().any(|&[travel, p]| loaded(travel).is_some_and(|l| p > l + VISIBLE_EXCESS * peak))
}

/// [`lies_above`] of the curves of a closure, by their separations.
pub(super) fn unloading_lies_above(loading: &[CurvePoint], back: &[CurvePoint]) -> bool {
    let points = |curve: &[CurvePoint]| curve.iter().map(|p| [-p.separation, p.pressure]).collect::<Vec<_>>();
    lies_above(&points(back), &points(loading))
}

/// Points alone, for nothing is known between them: a line would be read as the curve.
fn ends_only(series: Series) -> Series {
    Series { dash: Some(Dash::Hidden), ..series.marked() }
}

/// A chart of nominal pressure against the travel of the plane: of each closure its loading and unloading, as
/// points (travel, pressure) in the units of the axes. An unloading that lies above its loading is not drawn,
/// and the title says so.
pub fn travel_chart(curves: impl IntoIterator<Item = (Closure, [Vec<[f64; 2]>; 2])>) -> Chart {
    let (mut series, mut left_out) = (Vec::new(), Vec::new());
    for (closure, [loading, unloading]) in curves {
        let drawn = if lies_above(&unloading, &loading) {
            left_out.push(closure.name());
            vec![(false, loading)]
        } else {
            vec![(false, loading), (true, unloading)]
        };
        let with_points = drawn.into_iter().filter(|(_, points)| !points.is_empty());
        series.extend(with_points.map(|(back, points)| Series::of_closure(closure, back, points)));
    }
    let series = series.into_iter().map(|one| if one.points.len() > 2 { one } else { ends_only(one) });
    let mut title = "Load curve: nominal pressure over the travel of the plane".to_string();
    if !left_out.is_empty() {
        let names = left_out.join(", ");
        title += &format!("; not drawn: the unloading of {names}, which its law puts above the loading");
    }
    Chart::new("travel of the plane from first touch (µm)", "nominal pressure (MPa)", series).titled(title)
}

/// Share of the contact area that the histogram shows of each closure at least: the few pixels beyond it at
/// either end would leave the rest one spike.
const SHOWN_AREA: f64 = 0.99;

/// Logarithm of pressure over nominal pressure of each pixel in contact, with its contact area.
fn pressures(one: &ClosureContact) -> Vec<(f64, f64)> {
    let ratio = |pressure: f32| (f64::from(pressure) / one.nominal).log10();
    let mut found: Vec<(f64, f64)> = match &one.body {
        Body::Islands(one) => {
            one.field.pixels.iter().map(|p| (ratio(p.pressure), f64::from(p.contact))).collect()
        }
        Body::HalfSpace(one) => one.contact.pressures.iter().map(|p| (ratio(*p), 1.0)).collect(),
        Body::Failed(_) => Vec::new(),
    };
    found.retain(|(ratio, area)| ratio.is_finite() && *area > 0.0);
    found
}

/// Contact area in each of `N` steps of `width` from `start` on.
fn areas<const N: usize>(pressures: &[(f64, f64)], start: f64, width: f64) -> [f64; N] {
    let mut steps = [0.0; N];
    for (ratio, area) in pressures.iter().filter(|(ratio, _)| *ratio >= start) {
        if let Some(step) = steps.get_mut(((ratio - start) / width) as usize) {
            *step += area;
        }
    }
    steps
}

/// The ends between which [`SHOWN_AREA`] of the contact lies, as much below as above them, to a thousandth of
/// the range.
fn shown_ends(pressures: &[(f64, f64)]) -> [f64; 2] {
    const FINE_STEPS: usize = 1024;
    let ends = |[low, high]: [f64; 2], (ratio, _): &(f64, f64)| [low.min(*ratio), high.max(*ratio)];
    let [low, high] = pressures.iter().fold([f64::INFINITY, f64::NEG_INFINITY], ends);
    let width = ((high - low) / (FINE_STEPS as f64 - 1.0)).max(f64::EPSILON);
    let steps = areas::<FINE_STEPS>(pressures, low - 0.5 * width, width);
    let total: f64 = steps.iter().sum();
    [0.5 * (1.0 - SHOWN_AREA), 0.5 * (1.0 + SHOWN_AREA)].map(|share| {
        let mut below = 0.0;
        let before = steps.iter().take_while(|area| {
            below += **area;
            below < share * total
        });
        low + width * before.count() as f64
    })
}

/// Share of the contact area per step of the logarithm of pressure, against pressure over nominal pressure:
/// closures differ in their pressures by factors.
fn histogram(contacts: &[ClosureContact]) -> Chart {
    const STEPS: usize = 60;
    let loaded = contacts.iter().filter(|one| one.nominal > 0.0).map(|one| (one.closure, pressures(one)));
    let found: Vec<_> = loaded.filter(|(_, pressures)| !pressures.is_empty()).collect();
    let ends = found.iter().map(|(_, pressures)| shown_ends(pressures));
    let [low, high] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    // a step at either end holds what lies on it
    let width = if high > low { (high - low) / (STEPS as f64 - 1.0) } else { 0.1 };
    let series = found.iter().map(|(closure, pressures)| {
        let total: f64 = pressures.iter().map(|(_, area)| area).sum();
        let steps = areas::<STEPS>(pressures, low - 0.5 * width, width);
        let place = |i: usize| 10_f64.powf(low + i as f64 * width);
        let points = steps.iter().enumerate().map(|(i, area)| [place(i), 100.0 * area / total]);
        Series::of_closure(*closure, false, points.collect())
    });
    Chart::new("pressure over nominal pressure", "contact area per step (%)", series)
        .titled("Distribution of the pressure over the contact; of each closure at least 99 % of its area")
        .logarithmic([true, false])
}
