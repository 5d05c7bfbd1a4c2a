//! A run whose goal was a force, moved to where its force is, and the peak of a curve.

use super::bound::longer;
use crate::record::curve::Curve;
use crate::record::outcome::Outcome;
use crate::record::rows::{CurveRow, Phase, Summary};
use asperity_solver::point::kinematics::Symmetry;

/// Curve of a quantity over the first loading, both over their values in the row `top`.
pub(super) fn loading_curve(rows: &[CurveRow], top: &CurveRow, of: impl Fn(&CurveRow) -> f64) -> Curve {
    let loading = rows.iter().filter(|row| row.phase == Phase::Load);
    Curve::new(loading.map(|row| [row.depth / top.depth, of(row) / of(top)]))
}

/// The last row of the first loading.
pub(super) fn last_loaded(rows: &[CurveRow]) -> Option<&CurveRow> {
    rows.iter().take_while(|row| row.phase == Phase::Load).last()
}

/// The `summary` with the peak of the curve.
pub(super) fn note_peak(summary: Summary, rows: &[CurveRow]) -> Summary {
    match last_loaded(rows) {
        Some(top) => Summary {
            peak_force: top.force,
            peak_depth: top.depth,
            contact_area: top.contact_area,
            contact_radius: top.contact_radius,
            ..summary
        },
        None => summary,
    }
}

/// A `run` that ended where the sum of its nodal forces was `asked`, its curve moved along itself to where
/// its force is: a power of the depth near the peak.
pub(crate) fn rescale_to_force(mut run: Outcome, asked: f64, symmetry: Symmetry) -> Outcome {
    let Some(&last) = last_loaded(&run.rows).filter(|row| row.force > 0.0 && row.contact_area > 0.0) else {
        return run;
    };
    let exponent = |of: fn(&CurveRow) -> f64| {
        -loading_curve(&run.rows, &last, of).logarithm_at(0.9) / (1.0_f64 / 0.9).ln()
    };
    let (force, area) = (exponent(|row| row.force), exponent(|row| row.contact_area));
    if !(force > 0.0 && area > 0.0) {
        return run;
    }
    let stronger = asked / last.force;
    let deeper = stronger.powf(1.0 / force);
    let wider = deeper.powf(area);
    for row in &mut run.rows {
        row.force *= stronger;
        row.depth *= deeper;
        row.contact_area *= wider;
        row.contact_radius *= longer(symmetry, wider);
        row.mean_pressure *= stronger / wider;
    }
    for share in &mut run.asperities {
        share.force *= stronger;
        share.depth *= deeper;
        share.contact_area *= wider;
    }
    for gap in &mut run.gaps {
        gap.depth *= deeper;
    }
    for cycle in &mut run.cycles {
        cycle.peak_force *= stronger;
        cycle.peak_depth *= deeper;
        cycle.residual_depth *= deeper;
    }
    // the force is what was asked for: what is not known of it is a depth
    run.summary.errors.depth = Some(run.summary.errors.force / force).filter(|error| error.is_finite());
    run.summary.residual_depth = run.summary.residual_depth.map(|depth| depth * deeper);
    run.summary = note_peak(run.summary, &run.rows);
    run
}
