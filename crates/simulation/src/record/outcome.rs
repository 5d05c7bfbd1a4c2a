//! The outcome of a run, and what an observer hears while it lasts.

use crate::load_path::{Path, Stop};
use crate::record::rows::{AsperityRow, CurveRow, CycleRow, GapRow, Phase, Summary};
use crate::setup::discretisation::Discretisation;
use asperity_mesh::Mesh;
use asperity_solver::body::fields::Fields;
use asperity_solver::body::islands::Island;
use asperity_solver::equilibrium::Counters;
use std::ops::ControlFlow;

/// News for an observer, in SI units.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// An increment converged.
    Increment {
        /// Its row of the curve.
        row: &'a CurveRow,
        /// Increments that the whole run will have, as far as is known.
        planned: usize,
    },
    /// Fields of the increment of the last row.
    Fields(&'a FieldFrame),
    /// The round of this number begins, from first touch: those before did not keep the promise of the
    /// accuracy.
    Round(usize),
}

/// Is told of a run, which it ends by breaking.
pub type Watcher<'w> = dyn FnMut(&Event<'_>) -> ControlFlow<()> + 'w;

/// Fields of one increment, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldFrame {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// The mesh before the crush, m: the places of the metal that is at the nodes now.
    pub mesh: Mesh,
    /// The fields.
    pub fields: Fields,
}

/// A run that ended before its target.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    /// The reason.
    pub reason: Stop,
    /// Depth of the last converged increment, m.
    pub depth: f64,
    /// Direction of the tool, advancing or retreating.
    pub phase: Phase,
}

/// The results of a run, complete or not.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The curve, from first touch.
    pub rows: Vec<CurveRow>,
    /// The share of each asperity in each increment; empty for a single one.
    pub asperities: Vec<AsperityRow>,
    /// The gaps between contacts in each increment.
    pub gaps: Vec<GapRow>,
    /// The loading and the reloads, each with its unloading, as far as they are complete.
    pub cycles: Vec<CycleRow>,
    /// Regions that never yielded among the asperities, at the peak; empty for an elastic body.
    pub elastic_islands: Vec<Island>,
    /// The summary.
    pub summary: Summary,
    /// `None` if the run reached its end.
    pub stopped: Option<Stopped>,
    /// Counts of the work.
    pub counters: Counters,
    /// Operations of the run, an estimate that is the same on every machine.
    pub operations: f64,
    /// The numbers of its discretisation.
    pub numbers: Discretisation,
    /// Number of this round, counted from 1.
    pub round: usize,
}

/// Operations of a cell in an assembly with tangent and in one without, for the account of the work.
const CELL_OPERATIONS: [f64; 2] = [2e4, 5e3];

/// Operations of a run that stands at the end of its `path`.
pub(super) fn operations(path: &Path<'_>, cells: usize) -> f64 {
    let (counters, solution) = (path.model.counters, path.model.operations());
    let [tangent, residual] = CELL_OPERATIONS.map(|operations| operations * cells as f64);
    counters.factorisations as f64 * solution.factor
        + path.counts.iterations as f64 * solution.solve
        + counters.assemblies as f64 * tangent
        + counters.residuals as f64 * residual
}
