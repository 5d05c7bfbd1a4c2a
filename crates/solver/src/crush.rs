//! One crush from a scene to its records: the entry point of the solver.

use crate::discretise::{PROBED, Problem, mirror, prepare};
use crate::fields::{Fields, SurfacePoint, fields};
use crate::indentation::{OliverPharr, Peak, oliver_pharr};
use crate::islands::{extent, gaps, islands};
use crate::kinematics::Symmetry;
use crate::model::{Counters, Model, ToolContact};
use crate::newton::{KEEP, Settings};
use crate::record::{AsperityRow, CurveRow, CycleRow, GapRow, IslandRow, Phase, Summary};
use crate::scene::{ContactMethod, Scene, SceneError, Target};
use crate::stepping::{Goal, Increment, Path, Stop, schedule};
use asperity_mesh::Mesh;
use std::ops::ControlFlow;

/// What an observer is told, in SI units.
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
}

/// Fields of one increment, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldFrame {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// The mesh before the crush, m.
    pub mesh: Mesh,
    /// The fields.
    pub fields: Fields,
}

/// A run that ended before its target.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    /// Why.
    pub reason: Stop,
    /// Depth of the last converged increment, m.
    pub depth: f64,
    /// Whether the tool was advancing or retreating.
    pub phase: Phase,
}

/// What a run leaves, complete or not.
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
    /// What never yielded among the asperities, at the peak; empty for an elastic body.
    pub elastic_islands: Vec<IslandRow>,
    /// The summary.
    pub summary: Summary,
    /// `None` if the run reached its end.
    pub stopped: Option<Stopped>,
    /// Where the work went.
    pub counters: Counters,
}

/// Why a run could not begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CrushError {
    /// The scene makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An element of the mesh is inside out.
    #[error("the mesh has an element that is inside out or degenerate")]
    Mesh,
}

/// Runs `scene`. `mesh` (in metres) replaces the mesh that would be built.
///
/// The observer hears of every increment, and of fields every `output.every` increments and at the peak and the end
/// (if `output.every` is not 0); it ends the run by breaking.
///
/// # Errors
/// Only if the run cannot begin: what stops it later is in the outcome, with all that was reached.
pub fn run(
    scene: &Scene,
    mesh: Option<Mesh>,
    observer: &mut dyn FnMut(&Event<'_>) -> ControlFlow<()>,
) -> Result<Outcome, CrushError> {
    scene.validate()?;
    let problem = prepare(scene, mesh)?;
    let contact = ToolContact { tool: problem.tool, penalty: problem.penalty };
    let model = Model::new(
        &problem.mesh,
        problem.symmetry,
        problem.metal.clone(),
        |node| problem.held[node],
        Some(contact),
    )
    .map_err(|_| CrushError::Mesh)?;
    let settings = Settings { tolerance: problem.numbers.newton_tolerance, max_iterations: 40, keep: KEEP };
    let mut path = Path::new(model, settings, problem.numbers.contact == ContactMethod::Augmented);
    let mut log = Log::new(scene, &problem, path.model.unknowns());
    let goal = match scene.loading.target()? {
        Target::Depth(depth) => Goal::Depth(depth / problem.length),
        Target::Force(force) => Goal::Force {
            force: force / log.units.force,
            expected_depth: problem.depth,
            limit: (PROBED * problem.depth).min(scene.deepest() / problem.length),
        },
    };
    let numbers = problem.numbers;
    let expected = if numbers.contact == ContactMethod::Augmented {
        0.0
    } else {
        0.9 * numbers.penetration * problem.depth
    };
    let mut stopped = path
        .load(goal, &schedule(numbers.steps, numbers.geometric_from), expected, &mut |model, increment| {
            log.record(model, increment, observer)
        })
        .err();
    log.peak_reached(&goal, &problem, observer, &path.model, stopped.is_none());
    if stopped.is_none() {
        stopped = unload_and_reload(scene, &goal, &mut path, &mut log, observer).err();
    }
    Ok(log.finish(&path, stopped, observer))
}

/// What comes after the peak: the stiffness there, and unloading and reloading as often as the scene asks.
fn unload_and_reload(
    scene: &Scene,
    goal: &Goal,
    path: &mut Path<'_>,
    log: &mut Log<'_>,
    observer: &mut dyn FnMut(&Event<'_>) -> ControlFlow<()>,
) -> Result<(), Stop> {
    let unload = scene.loading.unload;
    for cycle in 0..=scene.loading.reloads {
        if cycle > 0 {
            path.reload(*goal, &mut |model, increment| log.record(model, increment, observer))?;
        }
        let peak = log.rows.len() - 1;
        let stiffness = match path.model.unloading_stiffness() {
            Ok(stiffness) => stiffness,
            Err(_) if unload => return Err(Stop::NoEquilibrium),
            Err(_) => return Ok(()),
        };
        log.stiffness.get_or_insert(stiffness.depth);
        if unload {
            let steps = log.problem.numbers.unload_steps;
            path.unload(stiffness, steps, &mut |model, increment| log.record(model, increment, observer))?;
            log.turns.push([peak, log.rows.len() - 1]);
        }
    }
    Ok(())
}

/// Values of 1 in SI.
#[derive(Clone, Copy, Debug)]
struct Units {
    length: f64,
    stress: f64,
    /// N, or N/m in plane strain.
    force: f64,
    /// m², or m.
    area: f64,
    /// J, or J/m.
    energy: f64,
}

impl Units {
    fn new(problem: &Problem) -> Units {
        let (l, e) = (problem.length, problem.modulus);
        match problem.symmetry {
            Symmetry::Axisymmetric => {
                Units { length: l, stress: e, force: e * l * l, area: l * l, energy: e * l * l * l }
            }
            Symmetry::PlaneStrain => Units { length: l, stress: e, force: e * l, area: l, energy: e * l * l },
        }
    }
}

/// Collects rows and hands out events.
struct Log<'p> {
    problem: &'p Problem,
    /// Whether the program sized the substrate.
    automatic: bool,
    units: Units,
    interval: usize,
    planned: usize,
    unknowns: usize,
    /// Which asperity each surface edge belongs to.
    groups: Vec<usize>,
    increments: Vec<Increment>,
    rows: Vec<CurveRow>,
    asperities: Vec<AsperityRow>,
    gaps: Vec<GapRow>,
    islands: Vec<IslandRow>,
    peak: usize,
    /// Rows of each peak and of the end of the unloading after it.
    turns: Vec<[usize; 2]>,
    stiffness: Option<f64>,
    last_fields: Option<usize>,
}

impl<'p> Log<'p> {
    fn new(scene: &Scene, problem: &'p Problem, unknowns: usize) -> Self {
        let units = Units::new(problem);
        let unload = if scene.loading.unload { problem.numbers.unload_steps + 1 } else { 0 };
        let unload = unload * (1 + 2 * scene.loading.reloads);
        let first = CurveRow {
            increment: 0,
            phase: Phase::Load,
            depth: 0.0,
            force: 0.0,
            contact_area: 0.0,
            contact_radius: 0.0,
            mean_pressure: 0.0,
            external_work: 0.0,
            elastic_energy: 0.0,
            plastic_work: 0.0,
            contact_energy: 0.0,
            penetration: 0.0,
            newton_iterations: 0,
        };
        Log {
            problem,
            automatic: scene.mesh.is_none() && scene.substrate.as_ref().is_none_or(|s| s.depth.is_none()),
            units,
            interval: scene.output.interval(),
            planned: problem.numbers.steps + unload,
            unknowns,
            groups: groups(problem),
            increments: Vec::new(),
            rows: vec![first],
            asperities: Vec::new(),
            gaps: Vec::new(),
            islands: Vec::new(),
            peak: 0,
            turns: Vec::new(),
            stiffness: None,
            last_fields: None,
        }
    }

    fn record(
        &mut self,
        model: &Model<'_>,
        increment: &Increment,
        observer: &mut dyn FnMut(&Event<'_>) -> ControlFlow<()>,
    ) -> bool {
        let (u, contact) = (self.units, &increment.contact);
        let number = self.rows.len();
        let mut depth = increment.depth();
        // a depth that was asked for is met to 1e-9: write it as asked
        if (depth / self.problem.depth - 1.0).abs() < 2e-9 {
            depth = self.problem.depth;
        }
        let row = CurveRow {
            increment: number,
            phase: increment.phase,
            depth: depth * u.length,
            force: contact.force * u.force,
            contact_area: contact.area * u.area,
            contact_radius: contact.radius * u.length,
            mean_pressure: if contact.area > 0.0 { contact.force / contact.area * u.stress } else { 0.0 },
            external_work: increment.external_work * u.energy,
            elastic_energy: increment.elastic_energy * u.energy,
            plastic_work: increment.plastic_work * u.energy,
            contact_energy: (contact.energy - model.remeasured_energy()) * u.energy,
            penetration: contact.penetration * u.length,
            newton_iterations: increment.newton_iterations,
        };
        self.rows.push(row);
        self.increments.push(*increment);
        if self.problem.profile.asperities.len() > 1 {
            for asperity in 0..self.problem.profile.asperities.len() {
                let sums = Path::group_sums(model, &self.groups, asperity);
                self.asperities.push(AsperityRow {
                    increment: number,
                    phase: row.phase,
                    asperity,
                    depth: row.depth,
                    force: sums.force * u.force,
                    contact_area: sums.area * u.area,
                    contact_left: sums.reach[0] * u.length,
                    contact_right: sums.reach[1] * u.length,
                    max_pressure: sums.max_pressure * u.stress,
                });
            }
        }
        self.gaps.extend(gaps(model).into_iter().map(|gap| GapRow {
            increment: number,
            phase: row.phase,
            depth: row.depth,
            left: gap.left * u.length,
            right: gap.right * u.length,
            height: gap.height * u.length,
        }));
        let told = observer(&Event::Increment { row: &row, planned: self.planned.max(number) });
        if self.interval > 0 && number.is_multiple_of(self.interval) && told.is_continue() {
            return self.draw(model, observer).is_continue();
        }
        told.is_continue()
    }

    /// Hands out the fields of the last row, once.
    fn draw(
        &mut self,
        model: &Model<'_>,
        observer: &mut dyn FnMut(&Event<'_>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Some(row) = self.rows.last().filter(|row| row.increment > 0) else {
            return ControlFlow::Continue(());
        };
        if self.last_fields == Some(row.increment) {
            return ControlFlow::Continue(());
        }
        self.last_fields = Some(row.increment);
        let (l, e) = (self.units.length, self.units.stress);
        let mut mesh = self.problem.mesh.clone();
        for node in &mut mesh.nodes {
            *node = node.map(|x| x * l);
        }
        let raw = fields(model);
        let scaled = |values: Vec<f64>| values.into_iter().map(|v| v * e).collect();
        let frame = FieldFrame {
            increment: row.increment,
            phase: row.phase,
            mesh,
            fields: Fields {
                displacement: raw.displacement.into_iter().map(|d| d.map(|d| d * l)).collect(),
                stress: raw.stress.into_iter().map(|s| s.map(|s| s * e)).collect(),
                von_mises: scaled(raw.von_mises),
                pressure: scaled(raw.pressure),
                contact_pressure: scaled(raw.contact_pressure),
                plastic_strain: raw.plastic_strain,
                plastic_zone: raw.plastic_zone,
                surface: raw
                    .surface
                    .into_iter()
                    .map(|p| SurfacePoint {
                        position: p.position.map(|x| x * l),
                        displacement: p.displacement.map(|x| x * l),
                        pressure: p.pressure * e,
                        yielded: p.yielded,
                    })
                    .collect(),
            },
        };
        observer(&Event::Fields(&frame))
    }

    /// Lists what never yielded: enclosed by metal that did, or above the base of the asperities and half their height
    /// below it.
    fn find_islands(&mut self, model: &Model<'_>) {
        let profile = &self.problem.profile;
        let (Some(first), Some(last)) = (profile.asperities.first(), profile.asperities.last()) else {
            return;
        };
        if self.problem.metal.hardening.is_none() {
            return;
        }
        let feet =
            [first.centre - first.half_width(first.height), last.centre + last.half_width(last.height)];
        let found = islands(model, -1.5 * profile.height(), extent(self.problem.symmetry, feet));
        let l = self.units.length;
        self.islands = found
            .into_iter()
            .map(|island| IslandRow {
                place: island.place.map(|x| x * l),
                area: island.area * l * l,
                mean_pressure: island.mean_pressure * self.units.stress,
                mean_von_mises: island.mean_von_mises * self.units.stress,
                reaches_substrate: island.reaches_substrate,
                reaches_surface: island.reaches_surface,
            })
            .collect();
    }

    /// Notes the peak and draws its fields.
    fn peak_reached(
        &mut self,
        goal: &Goal,
        problem: &Problem,
        observer: &mut dyn FnMut(&Event<'_>) -> ControlFlow<()>,
        model: &Model<'_>,
        complete: bool,
    ) {
        self.peak = self.rows.len() - 1;
        self.find_islands(model);
        if complete && matches!(goal, Goal::Depth(_)) && problem.depth > 0.0 {
            self.planned = self.peak + self.planned.saturating_sub(problem.numbers.steps);
        }
        if self.interval > 0 {
            // an observer that breaks here is asked again at the next increment
            let _ = self.draw(model, observer);
        }
    }

    /// The peak as an instrument evaluates it that knows force, depth and stiffness (dimensionless), in SI.
    fn as_an_instrument(&self, peak: &CurveRow, stiffness: f64) -> Option<OliverPharr> {
        let (problem, u) = (self.problem, self.units);
        let tool = mirror(&problem.tool).filter(|_| problem.symmetry == Symmetry::Axisymmetric)?;
        let peak = Peak { force: peak.force / u.force, depth: peak.depth / u.length, stiffness };
        let read = oliver_pharr(&problem.tool, |height| tool.half_width(height), &peak)?;
        Some(OliverPharr {
            geometry_factor: read.geometry_factor,
            contact_depth: read.contact_depth * u.length,
            contact_area: read.contact_area * u.area,
            hardness: read.hardness * u.stress,
            reduced_modulus: read.reduced_modulus * u.stress,
        })
    }

    /// Every complete loading with its unloading.
    fn cycles(&self) -> Vec<CycleRow> {
        let mut start = 0;
        let row = |(cycle, &[peak, end]): (usize, &[usize; 2])| {
            let (from, top, last) = (&self.rows[start], &self.rows[peak], &self.rows[end]);
            let row = CycleRow {
                cycle,
                peak_increment: peak,
                end_increment: end,
                peak_depth: top.depth,
                peak_force: top.force,
                residual_depth: last.depth,
                work_in: work_along(&self.rows[start..=peak]),
                work_out: -work_along(&self.rows[peak..=end]),
                plastic_work: last.plastic_work - from.plastic_work,
            };
            start = end;
            row
        };
        self.turns.iter().enumerate().map(row).collect()
    }

    fn finish(
        mut self,
        path: &Path<'_>,
        stopped: Option<Stop>,
        observer: &mut dyn FnMut(&Event<'_>) -> ControlFlow<()>,
    ) -> Outcome {
        if self.interval > 0 {
            let _ = self.draw(&path.model, observer);
        }
        let (peak, last) = (self.rows[self.peak], self.rows[self.rows.len() - 1]);
        // of the first loading and unloading, whatever comes after
        let cycles = self.cycles();
        let first = cycles.first();
        let total_work = work_along(&self.rows[..=self.peak]);
        let elastic_work = first.map(|c| c.work_out);
        let u = self.units;
        let stiffness_unit = u.force / u.length;
        let summary = Summary {
            peak_force: peak.force,
            peak_depth: peak.depth,
            residual_depth: first.map(|c| c.residual_depth),
            unloading_stiffness: self.stiffness.map(|s| s * stiffness_unit),
            contact_area: peak.contact_area,
            contact_radius: peak.contact_radius,
            total_work,
            elastic_work,
            plastic_work: peak.plastic_work,
            oliver_pharr: self
                .stiffness
                .filter(|_| first.is_some())
                .and_then(|s| self.as_an_instrument(&peak, s)),
            reduced_modulus: self.problem.metal.elastic.reduced_modulus() * u.stress,
            elastic_fraction: elastic_work.map(|w| w / total_work),
            energy_balance_error: balance_error(&self.rows),
            estimated_error: crate::estimate::force_error(
                self.problem,
                &self.rows[..=self.peak],
                [peak.force / u.force, peak.depth / u.length],
                self.automatic,
            ),
            elements: self.problem.mesh.cell_count(),
            dofs: self.unknowns,
            increments: self.rows.len() - 1,
            newton_iterations: path.iterations,
            cutbacks: path.cutbacks,
        };
        let stopped = stopped.map(|reason| Stopped { reason, depth: last.depth, phase: last.phase });
        Outcome {
            rows: self.rows,
            asperities: self.asperities,
            gaps: self.gaps,
            cycles,
            elastic_islands: self.islands,
            summary,
            stopped,
            counters: path.model.counters,
        }
    }
}

/// ∫F dh over corrected depths: the work over the travel less what the penetration took.
fn work_along(rows: &[CurveRow]) -> f64 {
    let step = |pair: &[CurveRow]| {
        let (from, to) = (pair[0], pair[1]);
        let sunk = crate::energy::work([from.force, to.force], to.penetration - from.penetration);
        to.external_work - from.external_work - sunk
    };
    rows.windows(2).map(step).sum()
}

/// The largest |W - E_e - W_p - E_c|/W over increments with W above 1 % of its peak.
fn balance_error(rows: &[CurveRow]) -> f64 {
    let peak = rows.iter().fold(0.0, |m: f64, r| m.max(r.external_work));
    rows.iter()
        .filter(|r| r.external_work > 0.01 * peak)
        .map(|r| {
            (r.external_work - r.elastic_energy - r.plastic_work - r.contact_energy).abs() / r.external_work
        })
        .fold(0.0, f64::max)
}

/// The asperity of each surface edge: the one whose foot is nearest to the middle of the edge before the crush.
fn groups(problem: &Problem) -> Vec<usize> {
    let mesh = &problem.mesh;
    mesh.sides
        .surface
        .iter()
        .map(|&edge| {
            let ([a, b], _) = mesh.edge_nodes(edge);
            let r = 0.5 * (mesh.nodes[a as usize][0] + mesh.nodes[b as usize][0]);
            let distance =
                |a: &asperity_mesh::profile::Asperity| (r - a.centre).abs() - a.half_width(a.height);
            let asperities = &problem.profile.asperities;
            (0..asperities.len())
                .min_by(|&i, &j| distance(&asperities[i]).total_cmp(&distance(&asperities[j])))
                .unwrap_or(0)
        })
        .collect()
}
