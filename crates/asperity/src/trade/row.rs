//! Rows of `trade.csv`.

use super::case::{Finished, Measured};
use super::converged::{Converged, Errors};
use super::pareto_front::pareto_front;
use super::settings::{Knob, Setting};
use asperity_solver::scene::{Accuracy, ContactMethod, ElementChoice};
use serde::{Deserialize, Serialize};

/// One setting with its cost and its errors, relative to the converged values of the scene. Fields are named as the
/// columns; those of a run without a result are absent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TradeRow {
    /// The number that was changed.
    pub knob: Knob,
    /// The level around which it was changed; absent where everything was.
    pub around: Option<Accuracy>,
    /// Quadrilateral.
    pub element: Option<ElementChoice>,
    /// Elements across the contact.
    pub elements_in_contact: Option<usize>,
    /// Load steps.
    pub steps: Option<usize>,
    /// Contact method.
    pub contact: Option<ContactMethod>,
    /// Penetration over depth, which sets the penalty.
    pub penetration: Option<f64>,
    /// Tolerance of Newton's method.
    pub newton_tolerance: Option<f64>,
    /// Size of the substrate in contact radii.
    pub domain: Option<f64>,
    /// Largest error of the force for 0.2 ≤ h/h_peak ≤ 1.
    pub force_error: Option<f64>,
    /// Largest error of the contact area over the same depths.
    pub area_error: Option<f64>,
    /// Error of the residual depth over the peak depth; absent without unloading.
    pub residual_depth_error: Option<f64>,
    /// Error of the elastic fraction, absolute; absent without unloading.
    pub elastic_fraction_error: Option<f64>,
    /// Seconds on the clock.
    pub wall_s: Option<f64>,
    /// Seconds of the core.
    pub core_s: Option<f64>,
    /// Newton iterations, failed ones included.
    pub newton_iterations: Option<usize>,
    /// Unknowns.
    pub dofs: Option<usize>,
    /// Largest resident memory of the process, MB of 10⁶ bytes; absent where the system does not say.
    #[serde(rename = "peak_memory_MB")]
    pub peak_memory_mb: Option<f64>,
    /// The error of the force that the run states itself.
    pub estimated_error: Option<f64>,
    /// Whether no other setting has a smaller error of the force at no higher cost.
    pub on_front: bool,
    /// `ok`, or the reason why there is no result.
    pub status: String,
}

impl TradeRow {
    fn new(setting: &Setting, outcome: Result<(&Measured, Errors), &String>) -> TradeRow {
        let n = &setting.numerics;
        let (run, errors) =
            outcome.as_ref().ok().map_or((None, None), |(run, errors)| (Some(*run), Some(errors)));
        TradeRow {
            knob: setting.knob,
            around: Some(setting.around).filter(|_| setting.knob != Knob::Mixed),
            element: n.element,
            elements_in_contact: n.elements_in_contact,
            steps: n.steps,
            contact: n.contact,
            penetration: n.penetration,
            newton_tolerance: n.newton_tolerance,
            domain: n.domain,
            force_error: errors.map(|e| e.force),
            area_error: errors.map(|e| e.area),
            residual_depth_error: errors.and_then(|e| e.residual_depth),
            elastic_fraction_error: errors.and_then(|e| e.elastic_fraction),
            wall_s: run.map(|r| r.wall_s),
            core_s: run.map(|r| r.core_s),
            newton_iterations: run.map(|r| r.newton_iterations),
            dofs: run.map(|r| r.dofs),
            peak_memory_mb: run.and_then(|r| r.peak_memory_mb),
            estimated_error: run.and_then(|r| r.estimated_error),
            on_front: false,
            // readers that split at commas find every column
            status: outcome.map_or_else(|reason| reason.replace([',', '\n', '"'], ";"), |_| "ok".into()),
        }
    }
}

/// The rows of a trade, in the order of `finished`, the runs of the converged values left out.
pub fn rows(finished: &[Finished], converged: &Converged) -> Vec<TradeRow> {
    let compared = finished.iter().filter(|f| f.setting.knob != Knob::Converged);
    let mut rows: Vec<TradeRow> = compared
        .map(|f| TradeRow::new(&f.setting, f.outcome.as_ref().map(|run| (run, converged.errors(run)))))
        .collect();
    let points: Vec<_> = rows.iter().map(|row| Some([row.core_s?, row.force_error?])).collect();
    for index in pareto_front(&points) {
        rows[index].on_front = true;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_solver::scene::Numerics;

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
        let rows = [TradeRow::new(&setting, Ok((&run, errors))), TradeRow::new(&setting, Err(&reason))];
        let mut writer = csv::Writer::from_writer(Vec::new());
        rows.iter().for_each(|row| writer.serialize(row).unwrap());
        let text = String::from_utf8(writer.into_inner().unwrap()).unwrap();
        assert!(text.lines().all(|line| line.split(',').count() == 21), "{text}");
        assert!(text.starts_with("knob,around,element,") && text.contains(",peak_memory_MB,"), "{text}");
        assert!(text.ends_with("stopped; ;inside out;\n"), "{text}");
        let back: Result<Vec<TradeRow>, _> =
            csv::Reader::from_reader(text.as_bytes()).deserialize().collect();
        assert_eq!(back.unwrap(), rows);
    }
}
