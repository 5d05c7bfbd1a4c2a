//! The paper's asperity as a scene, and the quantities of its curve that are compared.

use asperity_solver::crush::{CrushError, Outcome, run};
use asperity_solver::record::{CurveRow, Phase};
use asperity_solver::scene::{Accuracy, Scene};
use std::ops::ControlFlow;

/// The scene of the first figure of the paper, at `accuracy`, without field output.
///
/// # Errors
/// The committed scene file does not read.
pub fn scene(accuracy: Accuracy) -> Result<Scene, toml::de::Error> {
    let mut scene: Scene = toml::from_str(include_str!("../../meshes/single-asperity.toml"))?;
    scene.accuracy = accuracy;
    scene.output.fields = Some(Vec::new());
    scene.output.every = Some(0);
    Ok(scene)
}

/// Runs `scene` without an observer.
///
/// # Errors
/// The run could not begin.
pub fn crush(scene: &Scene) -> Result<Outcome, CrushError> {
    run(scene, None, &mut |_| ControlFlow::Continue(()))
}

/// Force (N) at `depth` (m) while loading, from the loading curve `rows`.
///
/// √F is nearly linear in h for a cone: the cubic through the four nearest increments has an error far below the
/// curve's own. NaN outside the curve.
pub fn force_at(rows: &[CurveRow], depth: f64) -> f64 {
    let load: Vec<[f64; 2]> = rows
        .iter()
        .filter(|row| row.phase == Phase::Load && row.force >= 0.0)
        .map(|row| [row.depth, row.force.sqrt()])
        .collect();
    // 5 µm may be 5e-6 or 5 times 1e-6
    let end = load.last().map_or(0.0, |p| p[0]);
    let depth = if depth > end && depth <= end * (1.0 + 1e-9) { end } else { depth };
    let after = load.partition_point(|p| p[0] < depth);
    if load.len() < 4 || after == load.len() || depth < load[0][0] {
        return f64::NAN;
    }
    let first = after.saturating_sub(2).min(load.len() - 4);
    let points = &load[first..first + 4];
    let root: f64 = points
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let others = points.iter().enumerate().filter(|(j, _)| *j != i);
            p[1] * others.map(|(_, q)| (depth - q[0]) / (p[0] - q[0])).product::<f64>()
        })
        .sum();
    root * root
}

/// The largest relative difference of the force of `rows` from that of `reference`, over depths of 0.2 to 1 of
/// `peak` (m).
pub fn worst_force_error(rows: &[CurveRow], reference: impl Fn(f64) -> f64, peak: f64) -> f64 {
    (0..=160)
        .map(|i| peak * (0.2 + 0.8 * f64::from(i) / 160.0))
        .map(|h| (force_at(rows, h.min(rows_end(rows))) / reference(h) - 1.0).abs())
        .fold(0.0, f64::max)
}

fn rows_end(rows: &[CurveRow]) -> f64 {
    rows.iter().fold(0.0, |m, row| row.depth.max(m))
}

/// A smooth loading curve: ln F as a polynomial of the fourth degree in ln(h/h_peak).
///
/// The force of a mesh ripples with the period of an element as the contact front crosses it; a cone under a rounded tip
/// has no such period, and its ln F is nearly straight. The fit averages the ripple over some ten elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smooth {
    peak: f64,
    coefficients: [f64; TERMS],
}

const TERMS: usize = 5;

impl Smooth {
    /// Force (N) at `depth` (m).
    pub fn force(&self, depth: f64) -> f64 {
        let x = (depth / self.peak).ln();
        self.coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c).exp()
    }

    /// Geometric mean of curves of the same peak.
    pub fn mean(curves: &[Smooth]) -> Smooth {
        let share = 1.0 / curves.len() as f64;
        let coefficients =
            std::array::from_fn(|i| curves.iter().map(|curve| share * curve.coefficients[i]).sum());
        Smooth { peak: curves[0].peak, coefficients }
    }
}

/// Least squares over depths of 0.15 to 1 of `peak` (m), equally spaced in the logarithm.
pub fn smooth(rows: &[CurveRow], peak: f64) -> Smooth {
    let mut normal = [[0.0; TERMS + 1]; TERMS];
    let from = 0.15_f64.ln();
    for i in 0..=400 {
        let x = from * (1.0 - f64::from(i) / 400.0);
        let value = force_at(rows, (peak * x.exp()).min(rows_end(rows))).ln();
        let powers: [f64; TERMS] = std::array::from_fn(|k| x.powi(k as i32));
        for a in 0..TERMS {
            for b in 0..TERMS {
                normal[a][b] += powers[a] * powers[b];
            }
            normal[a][TERMS] += powers[a] * value;
        }
    }
    Smooth { peak, coefficients: eliminate(normal) }
}

/// Solves a small positive definite system, right side in the last column.
fn eliminate(mut a: [[f64; TERMS + 1]; TERMS]) -> [f64; TERMS] {
    for k in 0..TERMS {
        for i in 0..TERMS {
            if i != k {
                let factor = a[i][k] / a[k][k];
                for j in k..=TERMS {
                    a[i][j] -= factor * a[k][j];
                }
            }
        }
    }
    std::array::from_fn(|k| a[k][TERMS] / a[k][k])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cone with a rounded tip as its force would be without a mesh: F = 0.2 (h + 0.1)², h in µm.
    fn curve() -> Vec<CurveRow> {
        (0..60)
            .map(|i| {
                let h = 5e-6 * (f64::from(i) - 59.0).exp2().powf(0.1);
                CurveRow {
                    increment: i as usize,
                    phase: Phase::Load,
                    depth: h,
                    force: 0.2 * (h * 1e6 + 0.1).powi(2),
                    contact_area: 0.0,
                    contact_radius: 0.0,
                    mean_pressure: 0.0,
                    external_work: 0.0,
                    elastic_energy: 0.0,
                    plastic_work: 0.0,
                    contact_energy: 0.0,
                    penetration: 0.0,
                    newton_iterations: 0,
                }
            })
            .collect()
    }

    #[test]
    fn interpolation_and_fit_return_the_curve() {
        let rows = curve();
        let fit = smooth(&rows, 5e-6);
        for h in [1.0, 1.7, 3.3, 4.999] {
            let exact = 0.2 * (h + 0.1_f64).powi(2);
            assert!((force_at(&rows, h * 1e-6) / exact - 1.0).abs() < 1e-9);
            assert!((fit.force(h * 1e-6) / exact - 1.0).abs() < 1e-4);
        }
        assert!(force_at(&rows, 6e-6).is_nan());
        assert!(worst_force_error(&rows, |h| 1.01 * 0.2 * (h * 1e6 + 0.1).powi(2), 5e-6) < 0.0100);
    }
}
