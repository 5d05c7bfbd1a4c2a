//! The two figures: curves of all exponents mixed into one, and the representative strain over the slope.

use super::fit::{AngleFit, Fit};
use crate::draw::chart::{Chart, Dash, Series};
use crate::draw::palette::{LINES, VIRIDIS, interpolated};
use asperity_calibration::collapse::{Sample, distinct};
use asperity_calibration::fit::Data;
use asperity_roughness::PUBLISHED_COEFFICIENT;

/// File names, charts and what they show; none where nothing was fitted.
pub(super) fn all(data: &Data, fit: &Fit, shown: Option<f64>) -> Vec<(&'static str, Chart, &'static str)> {
    let Some(c) = fit.coefficient else { return Vec::new() };
    let mut pictures = Vec::new();
    let distance = |beta: f64| shown.map_or(-beta, |wish| (beta - wish).abs());
    let nearest = fit.per_angle.iter().min_by(|a, b| distance(a.beta_deg).total_cmp(&distance(b.beta_deg)));
    if let Some(angle) = nearest {
        let tan = angle.beta_deg.to_radians().tan();
        let share = angle.representative_strain.map_or(c, |s| s / tan);
        let seen = "Curves of all hardening exponents at one slope, at the representative strain that makes them one";
        pictures.push(("collapse.svg", mixed(data, angle.beta_deg, share), seen));
    }
    let seen = "Loading curvature of all slopes and metals over the stiffness of the metal, both dimensionless: near one curve";
    pictures.push(("collapse_all.svg", master(data, c), seen));
    let seen =
        "Representative strain of every slope with its interval, beside the fitted and the published line";
    pictures.push(("representative_strain.svg", strains(&fit.per_angle, c), seen));
    pictures
}

/// E*/σ_r and K/σ_r of a sample at ε_r = `share` tan β.
fn point(data: &Data, tan: f64, sample: &Sample, share: f64) -> [f64; 2] {
    let stress = sample.hardening.representative_stress(share * tan);
    [data.reduced_modulus / stress, sample.k_over_e / stress]
}

fn sorted(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points
}

/// Fig. 7 at one slope: a curve for every hardening exponent.
fn mixed(data: &Data, beta_deg: f64, share: f64) -> Chart {
    let tan = beta_deg.to_radians().tan();
    let samples = data.slopes.iter().find(|s| s.0 == beta_deg).map_or(&[][..], |s| &s.1);
    let exponents = distinct(samples.iter().map(|s| s.hardening.exponent));
    let series = exponents.iter().map(|n| {
        let of_n = samples.iter().filter(|s| s.hardening.exponent == *n);
        let points = sorted(of_n.map(|s| point(data, tan, s, share)).collect());
        Series::line(format!("n = {n}"), points).marked()
    });
    Chart::new(format!("E*/σᵣ, σᵣ at εᵣ = {share:.3} tan β (β = {beta_deg}°)"), "K/σᵣ", series)
        .titled("Loading curvature at one slope: one curve for all hardening exponents")
}

/// All slopes: Y = K tan²β/σ_r against X = E* tan β/σ_r at ε_r = c tan β.
fn master(data: &Data, c: f64) -> Chart {
    // points alone: a line would join one metal with another
    let share = |i: usize| 0.9 * i as f64 / data.slopes.len().saturating_sub(1).max(1) as f64;
    let series = data.slopes.iter().enumerate().map(|(i, (beta, samples))| {
        let tan = beta.to_radians().tan();
        let scaled = |s: &Sample| {
            let [x, y] = point(data, tan, s, c);
            [x * tan, y * tan * tan]
        };
        let points = Series::line(format!("β = {beta}°"), samples.iter().map(scaled).collect()).marked();
        Series { colour: Some(interpolated(&VIRIDIS, share(i))), dash: Some(Dash::Hidden), ..points }
    });
    Chart::new(format!("E* tan β/σᵣ, σᵣ at εᵣ = {c:.3} tan β"), "K tan²β/σᵣ", series)
        .titled("Loading curvature of all slopes and metals")
}

/// Fig. 8: ε_r of every slope with its interval, the fit, and the published line.
fn strains(angles: &[AngleFit], c: f64) -> Chart {
    let last = angles.last().map_or(10.0, |a| a.beta_deg);
    let line = |c: f64| {
        let slopes = (0..=20).map(|i| last * f64::from(i) / 20.0);
        slopes.map(|beta| [beta, c * beta.to_radians().tan()]).collect::<Vec<[f64; 2]>>()
    };
    let bound = |of: fn(&AngleFit) -> f64| {
        let ends = angles.iter().filter(|a| a.determined).map(|a| [a.beta_deg, of(a)]).collect();
        Series { colour: Some(LINES[5]), dash: Some(Dash::Dashed), ..Series::line("95 % interval", ends) }
    };
    let found = angles.iter().filter_map(|a| a.representative_strain.map(|s| [a.beta_deg, s])).collect();
    let lines = [
        Series::line("least scatter", found).marked(),
        bound(|a| a.low),
        bound(|a| a.high),
        Series::line(format!("fit: {c:.4} tan β"), line(c)),
        Series::line(format!("published: {PUBLISHED_COEFFICIENT} tan β"), line(PUBLISHED_COEFFICIENT)),
    ];
    Chart::new("slope β, degrees", "representative strain εᵣ", lines)
        .titled("Representative strain of every slope")
}
