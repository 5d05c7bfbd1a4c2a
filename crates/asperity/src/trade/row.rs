//! Rows of `trade.csv`.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use super::case::{Finished, Measured};
use super::converged::{Converged, Errors};
use super::pareto_front::pareto_front;
use super::settings::{Knob, Setting};
use crate::results::output::row;
use asperity_simulation::scene::{Accuracy, ElementChoice};

row! {
    /// One setting with its cost and its errors, relative to the converged values of the scene. Fields are
    /// named as the columns; those of a run without a result are absent.
    TradeRow(setting: &Setting, run: Option<&Measured>, errors: Option<Errors>, failure: Option<&String>) {
        /// The number that was changed.
        knob: Knob = setting.knob,
        /// The level around which it was changed; absent where everything was.
        around: Option<Accuracy> = Some(setting.around).filter(|_| setting.knob != Knob::Mixed),
        /// Quadrilateral.
        element: Option<ElementChoice> = setting.numerics.element,
        /// Elements across the contact.
        elements_in_contact: Option<usize> = setting.numerics.elements_in_contact,
        /// Load steps.
        steps: Option<usize> = setting.numerics.steps,
        /// Penetration over depth, which sets the penalty.
        penetration: Option<f64> = setting.numerics.penetration,
        /// Tolerance of Newton's method.
        newton_tolerance: Option<f64> = setting.numerics.newton_tolerance,
        /// Size of the substrate in contact radii.
        domain: Option<f64> = setting.numerics.domain,
        /// Largest error of the force for 0.2 ≤ h/h_peak ≤ 1.
        force_error: Option<f64> = errors.map(|e| e.force),
        /// Largest error of the contact area over the same depths.
        area_error: Option<f64> = errors.map(|e| e.area),
        /// Error of the residual depth over the peak depth; absent without unloading.
        residual_depth_error: Option<f64> = errors.and_then(|e| e.residual_depth),
        /// Error of the elastic fraction, absolute; absent without unloading.
        elastic_fraction_error: Option<f64> = errors.and_then(|e| e.elastic_fraction),
        /// Seconds on the clock.
        wall_s: Option<f64> = run.map(|r| r.wall_s),
        /// Seconds of the core.
        core_s: Option<f64> = run.map(|r| r.core_s),
        /// Newton iterations, failed ones included.
        newton_iterations: Option<usize> = run.map(|r| r.newton_iterations),
        /// Unknowns.
        dofs: Option<usize> = run.map(|r| r.dofs),
        /// Largest resident memory of the process, MB of 10⁶ bytes; absent where the system does not say.
        peak_memory_MB: Option<f64> = run.and_then(|r| r.peak_memory_mb),
        /// The error of the force that the run states itself.
        estimated_error: Option<f64> = run.and_then(|r| r.estimated_error),
        /// True where no other setting has a smaller error of the force at no higher cost.
        on_front: bool = false,
        /// `ok`, or the reason why there is no result, without commas: readers that split at them find every column.
        status: String = failure.map_or_else(|| "ok".into(), |reason| reason.replace([',', '\n', '"'], ";")),
    }
}

/// The rows of a trade, in the order of `finished`, the runs of the converged values left out.
pub fn rows(finished: &[Finished], converged: &Converged) -> Vec<TradeRow> {
    let compared = finished.iter().filter(|f| f.setting.knob != Knob::Converged);
    let row = |f: &Finished| {
        let run = f.outcome.as_ref().ok();
        TradeRow::new(&f.setting, run, run.map(|run| converged.errors(run)), f.outcome.as_ref().err())
    };
    let mut rows: Vec<TradeRow> = compared.map(row).collect();
    let points: Vec<_> = rows.iter().map(|row| Some([row.core_s?, row.force_error?])).collect();
    for index in pareto_front(&points) {
        rows[index].on_front = true;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_simulation::scene::Numerics;

    #[test]
    fn a_run_and_a_failure_fill_the_same_columns_and_read_back() {
        let setting = Setting { knob: Knob::Mesh, around: Accuracy::Draft, numerics: Numerics::default() };
        let run = Measured {
            loading: Vec::new(),
            residual_depth: None,
            elastic_fraction: None,
            estimated_error: Some(0.04),
            newton_iterations: 7,
            dofs: 9,
            wall_s: 0.5,
            core_s: 0.25,
            peak_memory_mb: None,
        };
        let errors = Errors { force: 0.03, area: 0.1, residual_depth: None, elastic_fraction: None };
        let reason = "stopped, \"inside out\"".to_string();
        let rows = [
            TradeRow::new(&setting, Some(&run), Some(errors), None),
            TradeRow::new(&setting, None, None, Some(&reason)),
        ];
        let mut writer = csv::Writer::from_writer(Vec::new());
        rows.iter().for_each(|row| writer.serialize(row).unwrap());
        let text = String::from_utf8(writer.into_inner().unwrap()).unwrap();
        assert!(text.lines().all(|line| line.split(',').count() == 20), "{text}");
        assert!(text.starts_with("knob,around,element,") && text.contains(",peak_memory_MB,"), "{text}");
        assert!(text.ends_with("stopped; ;inside out;\n"), "{text}");
        let back: Result<Vec<TradeRow>, _> =
            csv::Reader::from_reader(text.as_bytes()).deserialize().collect();
        assert_eq!(back.unwrap(), rows);
    }
}
