//! Formulas through the loads of a joint.

use super::path::JointPoint;
use asperity_numerics::least_squares::solve;

/// Loads at which more of the area touches are left out of fits: the formulas are for contact in spots.
const MOST_AREA: f64 = 0.3;
/// Fewer loads are no fit.
const FEWEST: usize = 4;
/// A formula is given for no more loads than it meets so closely, in root mean square.
const LARGEST_RESIDUAL: f64 = 0.2;

/// A straight line ln y = a + b x through points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// a.
    pub constant: f64,
    /// b.
    pub slope: f64,
    /// Smallest and largest pressure of the loads that it goes through, in Pa.
    pub range: [f64; 2],
    /// Root mean square of the relative deviations of y.
    pub residual: f64,
}

/// p = p₀ exp(-g/l).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential {
    /// p₀, in Pa.
    pub pressure: f64,
    /// l, in m.
    pub length: f64,
    /// Its loads and residual.
    pub fit: Fit,
}

/// y = c (p/Pa)^m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    /// c, in the unit of y.
    pub factor: f64,
    /// m.
    pub exponent: f64,
    /// Its loads and residual.
    pub fit: Fit,
}

/// The formulas of a joint, each over the widest range of loads in spots that it meets to 20 %; none where
/// too few do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fits {
    /// Pressure over mean gap.
    pub pressure: Option<Exponential>,
    /// Elastic stiffness (Pa/m) over pressure; conductances have its exponent.
    pub stiffness: Option<Power>,
}

impl Fit {
    /// Through the widest range of neighbouring points (pressure, x, y), y > 0, that a line meets to
    /// [`LARGEST_RESIDUAL`]; of two as wide, that of higher pressures.
    fn new(points: &[[f64; 3]]) -> Option<Fit> {
        let n = points.len();
        let parts = (0..n).flat_map(|from| (from + FEWEST..=n).map(move |to| &points[from..to]));
        let close = parts.filter_map(Fit::of_all).filter(|fit| fit.residual <= LARGEST_RESIDUAL);
        close.max_by(|a, b| (a.range[1] / a.range[0]).total_cmp(&(b.range[1] / b.range[0])))
    }

    /// Through all of the points.
    fn of_all(points: &[[f64; 3]]) -> Option<Fit> {
        let rows: Vec<_> = points.iter().map(|[_, x, y]| ([1.0, *x], y.ln(), 1.0)).collect();
        let [constant, slope] = solve(&rows)?;
        let off = |[_, x, y]: &[f64; 3]| ((constant + slope * x).exp() / y - 1.0).powi(2);
        let residual = (points.iter().map(off).sum::<f64>() / points.len() as f64).sqrt();
        let range = [points[0][0], points[points.len() - 1][0]];
        Some(Fit { constant, slope, range, residual })
    }
}

impl Power {
    /// Through points (pressure in Pa, y), pressures rising; None where no four neighbours are near a power.
    pub fn new(points: impl IntoIterator<Item = [f64; 2]>) -> Option<Power> {
        let points: Vec<_> = points.into_iter().map(|[p, y]| [p, p.ln(), y]).collect();
        let fit = Fit::new(&points)?;
        Some(Power { factor: fit.constant.exp(), exponent: fit.slope, fit })
    }
}

impl Fits {
    /// Of the loads of `points` that touch in spots.
    pub fn new(points: &[JointPoint]) -> Fits {
        let spots = points.iter().filter(|p| p.area.ratio > 0.0 && p.area.ratio <= MOST_AREA);
        // lengths near 1, so that the rounding of the squares is none of the fit
        let unit = points.first().map_or(1.0, |touch| touch.mean_gap);
        let gaps: Vec<_> = spots.clone().map(|p| [p.pressure, p.mean_gap / unit, p.pressure]).collect();
        let falls = Fit::new(&gaps).filter(|fit| fit.slope < 0.0);
        let pressure =
            falls.map(|fit| Exponential { pressure: fit.constant.exp(), length: -unit / fit.slope, fit });
        let stiffness = Power::new(spots.filter_map(|p| Some([p.pressure, p.elastic?.gap])));
        Fits { pressure, stiffness }
    }
}
