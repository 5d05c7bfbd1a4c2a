//! Results of a run: one row per converged increment, and the summary. SI units throughout.
//!
//! In axisymmetry forces are in N, areas in m², energies in J, of the full body of revolution. In plane
//! strain they are per metre of ridge: N/m, m (contact width), J/m.

use asperity_solver::body::energy::work;
use serde::{Deserialize, Deserializer, Serialize};

/// Direction of the tool: it advances or retreats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// The tool advances.
    Load,
    /// The tool retreats.
    Unload,
    /// The tool advances again to where it has been: `load` in a file, where `cycles.csv` says so.
    #[serde(rename(serialize = "load"))]
    Reload,
}

impl Phase {
    /// True where the tool advances, for the first time or again.
    pub fn advances(self) -> bool {
        self != Phase::Unload
    }
}

/// One load and the unloading after it: a row of `cycles.csv`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CycleRow {
    /// 0: the first loading; then the reloads.
    pub cycle: usize,
    /// Increment of the peak.
    pub peak_increment: usize,
    /// Increment at which the tool is gone.
    pub end_increment: usize,
    /// Depth at the peak, m.
    pub peak_depth: f64,
    /// Force at the peak, N (N/m).
    pub peak_force: f64,
    /// Initial summit minus the highest point of the body in equilibrium without the tool; of an indent, the
    /// depth at which the tool touches again, m.
    pub residual_depth: f64,
    /// ∫F dh on the way in, over the corrected depth, J (J/m).
    pub work_in: f64,
    /// Work returned on the way out, J (J/m).
    pub work_out: f64,
    /// The difference of the two, J (J/m).
    pub hysteresis: f64,
    /// Plastic work of both ways, J (J/m).
    pub plastic_work: f64,
}

/// One converged increment in SI: what `curve.csv` has in its units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveRow {
    /// Counted from 0, the first touch.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// Tool travel from first touch, less the penalty correction, plus far field and deflection of tool and
    /// machine, m.
    pub depth: f64,
    /// Force on the tool, positive in compression, N (N/m). Once the run has ended without the ripple of the
    /// mesh and extrapolated with the companion, as are the contact area and what follows from the two; as
    /// they are for an observer.
    pub force: f64,
    /// Projected current area under pressure, m² (width, m).
    pub contact_area: f64,
    /// Radius of the disc of the area of the contact that holds the axis, m: its outer edge, where no gap is
    /// open in it (plane strain: half the contact width).
    pub contact_radius: f64,
    /// Force over contact area, Pa; 0 without contact.
    pub mean_pressure: f64,
    /// ∫F dh over the raw tool displacement, J (J/m).
    pub external_work: f64,
    /// Stored elastic energy, residual stress included, J (J/m).
    pub elastic_energy: f64,
    /// Σ∫σ_y dε_p, J (J/m).
    pub plastic_work: f64,
    /// Energy stored in the penalty, ½ε∫d² dA with the penetration d, J (J/m): an artefact of the method.
    pub contact_energy: f64,
    /// Work that friction has taken, J (J/m); `None` under a smooth tool.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction_work: Option<f64>,
    /// Change of the energies by all transfers to better meshes so far, J (J/m): no work of the tool.
    pub transfer_energy: f64,
    /// Pressure-weighted mean penetration, m.
    pub penetration: f64,
    /// Deflection of tool and machine frame, a part of the depth, m; no file has it.
    #[serde(skip, default = "unknown")]
    pub compliance_depth: f64,
    /// Newton iterations spent since the last row.
    pub newton_iterations: usize,
    /// Sum of the nodal forces, N (N/m), in equilibrium with the stresses: what energies and works are made
    /// of.
    pub force_nodal: f64,
    /// 95 % bound of the relative error of the force; `None` where it is not known or there is no force.
    pub force_error: Option<f64>,
    /// The same of the contact area.
    pub area_error: Option<f64>,
}

impl CurveRow {
    /// Work that none of the energies accounts for, J (J/m): what increments, Newton's method and the penalty
    /// leave.
    pub fn unaccounted_work(&self) -> f64 {
        let kept = self.elastic_energy + self.plastic_work + self.contact_energy - self.transfer_energy;
        self.external_work - kept - self.friction_work.unwrap_or(0.0)
    }
}

/// 95 % bounds of the errors of a run against its own converged limit, at the peak or of what they name; NaN
/// where they are not known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Of the force, relative.
    #[serde(deserialize_with = "nan_for_null")]
    pub force: f64,
    /// Of the contact area, relative.
    #[serde(deserialize_with = "nan_for_null")]
    pub contact_area: f64,
    /// Of the mean pressure, relative.
    #[serde(deserialize_with = "nan_for_null")]
    pub mean_pressure: f64,
    /// Of the depth at which a force was asked for, relative; `None` where a depth was.
    #[serde(default)]
    pub depth: Option<f64>,
    /// Of the residual depth, over the peak depth; `None` without unloading.
    pub residual_depth: Option<f64>,
    /// Of the elastic fraction, absolute; `None` without unloading.
    pub elastic_fraction: Option<f64>,
    /// Of the unloading stiffness, relative.
    pub unloading_stiffness: Option<f64>,
}

impl Errors {
    /// Nothing is known.
    pub const UNKNOWN: Errors = Errors {
        force: f64::NAN,
        contact_area: f64::NAN,
        mean_pressure: f64::NAN,
        depth: None,
        residual_depth: None,
        elastic_fraction: None,
        unloading_stiffness: None,
    };
}

/// The largest of the bounds along the curve, over 0.2 ≤ h/h_peak ≤ 1; NaN where they are not known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorsAlong {
    /// Of the force, relative.
    #[serde(deserialize_with = "nan_for_null")]
    pub force: f64,
    /// Of the contact area, relative.
    #[serde(deserialize_with = "nan_for_null")]
    pub contact_area: f64,
    /// Of the mean pressure, relative.
    #[serde(deserialize_with = "nan_for_null")]
    pub mean_pressure: f64,
}

impl ErrorsAlong {
    /// Nothing is known.
    pub const UNKNOWN: ErrorsAlong =
        ErrorsAlong { force: f64::NAN, contact_area: f64::NAN, mean_pressure: f64::NAN };
}

/// The share of one asperity in one increment: a row of `asperities.csv`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AsperityRow {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// Counted from 0, from the axis (left side) outward.
    pub asperity: usize,
    /// As in the curve, m.
    pub depth: f64,
    /// Force on this asperity, N (N/m).
    pub force: f64,
    /// Its contact area, m² (width, m).
    pub contact_area: f64,
    /// Innermost (leftmost) point of its contact, m; NaN without contact.
    #[serde(deserialize_with = "nan_for_null")]
    pub contact_left: f64,
    /// Outermost point of its contact, m; NaN without contact.
    #[serde(deserialize_with = "nan_for_null")]
    pub contact_right: f64,
    /// Largest contact pressure on it, Pa.
    pub max_pressure: f64,
}

/// An untouched stretch of surface between two contacts in one increment: a row of `gaps.csv`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GapRow {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// As in the curve, m.
    pub depth: f64,
    /// End of the contact before the gap, m.
    pub left: f64,
    /// Beginning of the contact after it, m.
    pub right: f64,
    /// Distance of the two, m.
    pub width: f64,
    /// Largest distance from the tool in between, m; from the lowest to the highest point of an enclosed gap.
    pub height: f64,
    /// True where flanks that press each other close it off from the tool.
    pub enclosed: bool,
}

/// The evaluation of the peak after Oliver and Pharr, and beside it what is true.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OliverPharr {
    /// A(h_c), m².
    pub contact_area: f64,
    /// h_c, m.
    pub contact_depth: f64,
    /// ε of the tool's shape.
    pub epsilon: f64,
    /// F/A(h_c), Pa.
    pub hardness: f64,
    /// (√π/2) S/√A(h_c), Pa.
    pub reduced_modulus: f64,
    /// Contact area at the peak, m².
    pub true_contact_area: f64,
    /// Mean pressure at the peak, Pa.
    pub true_hardness: f64,
    /// E/(1 - ν²), of an elastic tool in series with that of the tool, Pa.
    pub true_reduced_modulus: f64,
}

/// The numbers of a run. `None` where the scene did not ask for it (unloading) or the run did not reach it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Largest force, N (N/m).
    pub peak_force: f64,
    /// Depth at the peak, m.
    pub peak_depth: f64,
    /// Initial summit minus the highest point of the body in equilibrium without the tool; of an indent, the
    /// depth at which the tool touches again, m.
    pub residual_depth: Option<f64>,
    /// dF/dh at the peak from one elastic solve with the contact kept, N/m (N/m²).
    pub unloading_stiffness: Option<f64>,
    /// Contact area at the peak, m² (m).
    pub contact_area: f64,
    /// Contact radius at the peak, m.
    pub contact_radius: f64,
    /// ∫F dh to the peak, over the corrected depth, J (J/m).
    pub total_work: f64,
    /// Work returned on unloading to F = 0, J (J/m).
    pub elastic_work: Option<f64>,
    /// Plastic work at the end of loading, J (J/m).
    pub plastic_work: f64,
    /// Work that friction took to the end of loading, J (J/m); `None` under a smooth tool.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction_work: Option<f64>,
    /// The evaluation of the curve after Oliver and Pharr; `None` without unloading, under a plane, in plane
    /// strain.
    pub oliver_pharr: Option<OliverPharr>,
    /// elastic_work / total_work.
    pub elastic_fraction: Option<f64>,
    /// Largest |W - E_e - W_p - E_c - W_f + E_t| over the largest W up to the row, W_f what friction took and
    /// E_t what transfers to better meshes changed, from 1 % of the work at the peak on.
    #[serde(deserialize_with = "nan_for_null")]
    pub energy_balance_error: f64,
    /// That of the force among the errors.
    #[serde(deserialize_with = "nan_for_null")]
    pub estimated_error: f64,
    /// Bounds of the errors at the peak, where they are known.
    pub errors: Errors,
    /// Bounds of the errors along the curve, where they are known.
    pub errors_along: ErrorsAlong,
    /// True where the stated errors are what the accuracy promises: of the force along the curve (of several
    /// contacts at the peak), of the area at the peak. `None` of a run that did not reach its goal, or was
    /// made once.
    pub promise_kept: Option<bool>,
    /// Rounds that were made, each finer than the one before.
    pub rounds: usize,
    /// Number of elements.
    pub elements: usize,
    /// Number of unknowns.
    pub dofs: usize,
    /// Converged increments.
    pub increments: usize,
    /// Newton iterations of all rounds, failed ones included.
    pub newton_iterations: usize,
    /// Times an increment was halved.
    pub cutbacks: usize,
    /// Remeshings.
    pub meshed_anew: usize,
}

/// A number that may be unknown: files have no NaN.
fn nan_for_null<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}

fn unknown() -> f64 {
    f64::NAN
}

/// ∫F dh over corrected depths: the work over the travel less what the penetration took.
pub fn work_along(rows: &[CurveRow]) -> f64 {
    let step = |pair: &[CurveRow]| {
        let (from, to) = (pair[0], pair[1]);
        // the deflection of tool and machine is depth, but no travel
        let sunk = to.penetration - from.penetration - (to.compliance_depth - from.compliance_depth);
        let sunk = work([from.force_nodal, to.force_nodal], sunk);
        to.external_work - from.external_work - sunk
    };
    rows.windows(2).map(step).sum()
}

/// External work at the peak.
pub fn largest_work(rows: &[CurveRow]) -> f64 {
    rows.iter().fold(0.0, |largest: f64, row| largest.max(row.external_work))
}

/// The largest |W - E_e - W_p - E_c - W_f + E_t| over the largest W up to the row, of rows from which on that
/// is above 1 % of the peak: as a body springs back its work falls to nothing, and what is left of it says
/// nothing.
pub(super) fn balance_error(rows: &[CurveRow]) -> f64 {
    let peak = largest_work(rows);
    let mut largest: f64 = 0.0;
    rows.iter()
        .map(|row| {
            largest = largest.max(row.external_work);
            if largest > 0.01 * peak { row.unaccounted_work().abs() / largest } else { 0.0 }
        })
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(external_work: f64, elastic_energy: f64) -> CurveRow {
        let text = r#"{"increment": 0, "phase": "load", "depth": 0, "force": 0, "contact_area": 0,
            "contact_radius": 0, "mean_pressure": 0, "external_work": 0, "elastic_energy": 0, "plastic_work": 0,
            "contact_energy": 0, "transfer_energy": 0, "penetration": 0, "newton_iterations": 0,
            "force_nodal": 0, "force_error": null, "area_error": null}"#;
        CurveRow { external_work, elastic_energy, ..serde_json::from_str(text).unwrap() }
    }

    /// An elastic body that is unloaded: 1e-3 of the work is a tenth of what is left of it at the end.
    #[test]
    fn a_balance_is_relative_to_the_largest_work_so_far() {
        let there_and_back =
            [row(0.0, 0.0), row(0.006, 0.0048), row(0.5, 0.5), row(1.0, 1.0), row(0.01, 0.009)];
        assert!((balance_error(&there_and_back) - 1e-3).abs() < 1e-12);
        assert!((balance_error(&there_and_back[..3]) - 0.2).abs() < 1e-12);
    }
}
