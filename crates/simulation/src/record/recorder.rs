//! The recorder of a run: rows of the curve, what is told to the observer, and the summary.

use crate::load_path::{Increment, Path, Stop};
use crate::record::mesh_ripple::{Ends, ends, remove};
use crate::record::outcome::{Event, FieldFrame, Outcome, Stopped, Watcher, operations};
use crate::record::rows::{
    AsperityRow, CurveRow, CycleRow, Errors, ErrorsAlong, GapRow, Phase, Summary, balance_error, work_along,
};
use crate::setup::problem::{Goal, Problem};
use asperity_mesh::profile::Asperity;
use asperity_solver::body::energy::{ContactSums, contact_sums};
use asperity_solver::body::fields::{Fields, SurfacePoint, fields};
use asperity_solver::body::islands::{Island, extent, gaps, islands};
use asperity_solver::equilibrium::Equilibrium;
use asperity_solver::point::kinematics::Symmetry;
use std::ops::ControlFlow;

/// Collects rows and hands out events.
pub struct Recorder<'p> {
    problem: &'p Problem,
    interval: usize,
    planned: usize,
    unknowns: usize,
    /// The asperity to which each surface edge belongs.
    groups: Vec<usize>,
    rows: Vec<CurveRow>,
    /// Ends of the contact of each asperity, for each row.
    ends: Vec<Ends>,
    asperities: Vec<AsperityRow>,
    gaps: Vec<GapRow>,
    islands: Vec<Island>,
    peak: usize,
    /// Rows of each peak and of the end of the unloading after it.
    turns: Vec<[usize; 2]>,
    stiffness: Option<f64>,
    last_fields: Option<usize>,
}

impl<'p> Recorder<'p> {
    /// An empty recorder of a run of `problem`, which hands out fields every `interval` increments (0:
    /// never).
    pub fn new(problem: &'p Problem, interval: usize, unknowns: usize) -> Self {
        let unload = if problem.unload { problem.numbers.unload_steps + 1 } else { 0 };
        let unload = unload * (1 + 2 * problem.reloads);
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
            friction_work: problem.friction.map(|_| 0.0),
            transfer_energy: 0.0,
            penetration: 0.0,
            compliance_depth: 0.0,
            newton_iterations: 0,
            force_nodal: 0.0,
            force_error: None,
            area_error: None,
        };
        Recorder {
            problem,
            interval,
            planned: problem.numbers.steps + unload,
            unknowns,
            groups: groups(problem),
            rows: vec![first],
            ends: vec![[f64::NAN; 2]; problem.profile.asperities.len().max(1)],
            asperities: Vec::new(),
            gaps: Vec::new(),
            islands: Vec::new(),
            peak: 0,
            turns: Vec::new(),
            stiffness: None,
            last_fields: None,
        }
    }

    /// Increments so far.
    pub fn increments(&self) -> usize {
        self.rows.len() - 1
    }

    /// The unloading stiffness of a peak; that of the first one stays.
    pub fn note_stiffness(&mut self, stiffness: f64) {
        self.stiffness.get_or_insert(stiffness);
    }

    /// The unloading from the increment `peak` ended with the last one.
    pub fn note_turn(&mut self, peak: usize) {
        self.turns.push([peak, self.increments()]);
    }

    /// Takes down a converged increment and tells the observer; `false` where it breaks.
    pub fn record(
        &mut self,
        model: &Equilibrium<'_>,
        increment: &Increment,
        observer: &mut Watcher<'_>,
    ) -> bool {
        let (u, contact, state) = (self.problem.units, &increment.contact, model.state());
        let number = self.rows.len();
        let energies = &increment.energies;
        let row = CurveRow {
            increment: number,
            phase: increment.phase,
            depth: increment.depth * u.length,
            force: contact.force * u.force,
            contact_area: contact.area * u.area,
            contact_radius: self.radius(model, contact) * u.length,
            mean_pressure: if contact.area > 0.0 { contact.force / contact.area * u.stress } else { 0.0 },
            external_work: energies.external_work * u.energy,
            elastic_energy: energies.elastic * u.energy,
            plastic_work: energies.plastic * u.energy,
            contact_energy: (contact.energy + state.ledger.self_contact - state.remeasured_energy())
                * u.energy,
            friction_work: self.problem.friction.map(|_| state.ledger.friction_work * u.energy),
            transfer_energy: state.ledger.transferred * u.energy,
            penetration: contact.penetration * u.length,
            compliance_depth: increment.compliance_depth * u.length,
            newton_iterations: increment.newton_iterations,
            force_nodal: contact.force * u.force,
            force_error: None,
            area_error: None,
        };
        self.rows.push(row);
        let (edges, touching) = (&model.state().edges, &model.state().contact);
        for asperity in 0..self.problem.profile.asperities.len().max(1) {
            self.ends.push(ends(edges, touching, |edge| self.groups.get(edge) == Some(&asperity)));
        }
        if self.problem.profile.asperities.len() > 1 {
            for asperity in 0..self.problem.profile.asperities.len() {
                let sums = group_sums(model, &self.groups, asperity);
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
        self.gaps.extend(gaps(model.body(), model.state()).into_iter().map(|gap| {
            let [left, right, height] = [gap.left, gap.right, gap.height].map(|x| x * u.length);
            let (width, enclosed) = (right - left, gap.enclosed);
            GapRow {
                increment: number,
                phase: row.phase,
                depth: row.depth,
                left,
                right,
                width,
                height,
                enclosed,
            }
        }));
        let told = observer(&Event::Increment { row: &row, planned: self.planned.max(number) });
        if self.interval > 0 && number.is_multiple_of(self.interval) && told.is_continue() {
            return self.draw(model, observer).is_continue();
        }
        told.is_continue()
    }

    /// Radius of the disc of the area of the contact that holds the axis; half the width in plane strain. The
    /// outer edge of that contact is not told from that of another by gaps: it opens at the axis and
    /// elsewhere.
    fn radius(&self, model: &Equilibrium<'_>, contact: &ContactSums) -> f64 {
        match (self.problem.symmetry, self.on_axis()) {
            (Symmetry::Axisymmetric, Some(asperity)) => {
                (group_sums(model, &self.groups, asperity).area / std::f64::consts::PI).sqrt()
            }
            _ => contact.radius,
        }
    }

    /// The asperity whose contact holds the axis: the first one, or the flat body without asperities.
    fn on_axis(&self) -> Option<usize> {
        let first = self.problem.profile.asperities.first();
        let holds = first.is_none_or(|a| a.centre < a.feet()[0]);
        (self.problem.symmetry == Symmetry::Axisymmetric && holds).then_some(0)
    }

    /// Hands out the fields before the first increment, if any are wanted.
    pub fn draw_start(&mut self, model: &Equilibrium<'_>, observer: &mut Watcher<'_>) {
        if self.interval > 0 {
            // an observer that breaks here is asked again at the first increment
            let _ = self.draw(model, observer);
        }
    }

    /// Hands out the fields of the last row, once.
    fn draw(&mut self, model: &Equilibrium<'_>, observer: &mut Watcher<'_>) -> ControlFlow<()> {
        let Some(row) = self.rows.last() else { return ControlFlow::Continue(()) };
        if self.last_fields == Some(row.increment) {
            return ControlFlow::Continue(());
        }
        self.last_fields = Some(row.increment);
        let (l, e) = (self.problem.units.length, self.problem.units.stress);
        let mut mesh = self.problem.mesh.clone();
        mesh.nodes = model.state().origin.iter().map(|x| x.map(|x| x * l)).collect();
        let raw = fields(model.body(), model.state());
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
                first_yield: raw.first_yield,
                yield_function: raw.yield_function,
                plastic_zone: raw.plastic_zone,
                surface: raw
                    .surface
                    .into_iter()
                    .map(|p| SurfacePoint {
                        r: p.r * l,
                        z: p.z * l,
                        u_r: p.u_r * l,
                        u_z: p.u_z * l,
                        pressure: p.pressure * e,
                        shear_traction: p.shear_traction.map(|shear| shear * e),
                        ..p
                    })
                    .collect(),
            },
        };
        observer(&Event::Fields(&frame))
    }

    /// Lists what never yielded: enclosed by metal that did, or above the base of the asperities and half
    /// their height below it.
    fn find_islands(&mut self, model: &Equilibrium<'_>) {
        let profile = &self.problem.profile;
        let (Some(first), Some(last)) = (profile.asperities.first(), profile.asperities.last()) else {
            return;
        };
        if self.problem.metal.hardening.is_none() {
            return;
        }
        let feet = [first.centre - first.feet()[0], last.centre + last.feet()[1]];
        let found = islands(
            model.body(),
            model.state(),
            -1.5 * profile.height(),
            extent(self.problem.symmetry, feet),
        );
        let l = self.problem.units.length;
        self.islands = found
            .into_iter()
            .map(|island| Island {
                place: island.place.map(|x| x * l),
                area: island.area * l * l,
                mean_pressure: island.mean_pressure * self.problem.units.stress,
                mean_von_mises: island.mean_von_mises * self.problem.units.stress,
                ..island
            })
            .collect();
    }

    /// Notes the peak and draws its fields.
    pub fn peak_reached(&mut self, observer: &mut Watcher<'_>, model: &Equilibrium<'_>, complete: bool) {
        self.peak = self.rows.len() - 1;
        self.find_islands(model);
        if complete && matches!(self.problem.goal, Goal::Depth(_)) {
            self.planned = self.peak + self.planned.saturating_sub(self.problem.numbers.steps);
        }
        if self.interval > 0 {
            // an observer that breaks here is asked again at the next increment
            let _ = self.draw(model, observer);
        }
    }

    /// Every complete loading with its unloading.
    fn cycles(&self) -> Vec<CycleRow> {
        let mut start = 0;
        let row = |(cycle, &[peak, end]): (usize, &[usize; 2])| {
            let (from, top, last) = (&self.rows[start], &self.rows[peak], &self.rows[end]);
            let work_in = work_along(&self.rows[start..=peak]);
            let work_out = -work_along(&self.rows[peak..=end]);
            let row = CycleRow {
                cycle,
                peak_increment: peak,
                end_increment: end,
                peak_depth: top.depth,
                peak_force: top.force,
                residual_depth: last.depth,
                work_in,
                work_out,
                hysteresis: work_in - work_out,
                plastic_work: last.plastic_work - from.plastic_work,
            };
            start = end;
            row
        };
        self.turns.iter().enumerate().map(row).collect()
    }

    /// The outcome of a run that ended, `stopped` if before its goal.
    pub fn finish(mut self, path: &Path<'_>, stopped: Option<Stop>, observer: &mut Watcher<'_>) -> Outcome {
        if self.interval > 0 {
            let _ = self.draw(&path.model, observer);
        }
        let axis = self.on_axis();
        let nodal_area = self.rows[self.peak].contact_area;
        remove(&mut self.rows, &mut self.asperities, &self.ends, self.peak, self.problem.symmetry, axis);
        let (peak, last) = (self.rows[self.peak], self.rows[self.rows.len() - 1]);
        // of the first loading and unloading, whatever comes after
        let cycles = self.cycles();
        let first = cycles.first();
        let total_work = work_along(&self.rows[..=self.peak]);
        let elastic_work = first.map(|c| c.work_out);
        let u = self.problem.units;
        let stiffness_unit = u.force / u.length;
        // the stiffness is that of a contact whose end rippled, too
        let wider = if nodal_area > 0.0 {
            stiffer(self.problem.symmetry, peak.contact_area / nodal_area)
        } else {
            1.0
        };
        let summary = Summary {
            peak_force: peak.force,
            peak_depth: peak.depth,
            residual_depth: first.map(|c| c.residual_depth),
            unloading_stiffness: self.stiffness.map(|s| s * wider * stiffness_unit),
            contact_area: peak.contact_area,
            contact_radius: peak.contact_radius,
            total_work,
            elastic_work,
            plastic_work: peak.plastic_work,
            friction_work: peak.friction_work,
            oliver_pharr: None,
            elastic_fraction: elastic_work.map(|w| w / total_work),
            energy_balance_error: balance_error(&self.rows),
            estimated_error: f64::NAN,
            errors: Errors::UNKNOWN,
            errors_along: ErrorsAlong::UNKNOWN,
            promise_kept: None,
            rounds: 1,
            elements: self.problem.mesh.cell_count(),
            dofs: self.unknowns,
            increments: self.rows.len() - 1,
            newton_iterations: path.counts.iterations,
            cutbacks: path.counts.cutbacks,
            meshed_anew: path.model.state().ledger.transfers,
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
            operations: operations(path, self.problem.mesh.cell_count()),
            numbers: self.problem.numbers,
            round: 1,
        }
    }
}

/// The asperity of each surface edge: the one whose foot is nearest to the middle of the edge before the
/// crush.
fn groups(problem: &Problem) -> Vec<usize> {
    let mesh = &problem.mesh;
    mesh.sides
        .surface
        .iter()
        .map(|&edge| {
            let ([a, b], _) = mesh.edge_nodes(edge);
            let r = 0.5 * (mesh.nodes[a as usize][0] + mesh.nodes[b as usize][0]);
            let distance = |a: &Asperity| (r - a.centre).abs() - a.feet()[usize::from(r > a.centre)];
            let asperities = &problem.profile.asperities;
            (0..asperities.len())
                .min_by(|&i, &j| distance(&asperities[i]).total_cmp(&distance(&asperities[j])))
                .unwrap_or(0)
        })
        .collect()
}

/// Contact of one of the `groups` of edges at the last converged increment.
fn group_sums(model: &Equilibrium<'_>, groups: &[usize], group: usize) -> ContactSums {
    let edges = model.state().contact.iter().zip(groups).filter(|(_, g)| **g == group);
    contact_sums(edges.map(|(edge, _)| edge), model.body().symmetry)
}

/// Factor of the unloading stiffness where the area grows by the factor `wider`: 2 E* a of a punch. That of a
/// strip depends on its width by a logarithm.
pub(crate) fn stiffer(symmetry: Symmetry, wider: f64) -> f64 {
    match symmetry {
        Symmetry::Axisymmetric => wider.sqrt(),
        Symmetry::PlaneStrain => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Run;
    use crate::scene::{self, Loading, Material, Numerics, Scene, Tool};
    use asperity_material::units::{Length, Stress};

    /// The asperity of the paper, unloaded, and the force of each increment as the observer hears of it.
    fn crushed() -> (Outcome, Vec<f64>) {
        let steel = Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), 0.3);
        let loading = Loading { depth: Some(Length(5e-6)), force: None, unload: true, reloads: 0 };
        let cone = scene::Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6));
        let numerics = Numerics { elements_in_contact: Some(16), steps: Some(60), ..Numerics::default() };
        let scene = Scene::new(scene::Symmetry::Axisymmetric, steel, Tool::plane(), loading).with(cone);
        let mut live = vec![0.0];
        let outcome = Run::new(&Scene { numerics, ..scene }).run(&mut |event| {
            if let Event::Increment { row, .. } = event {
                live.push(row.force);
            }
            ControlFlow::Continue(())
        });
        (outcome.unwrap(), live)
    }

    #[test]
    fn the_curve_loses_its_ripple_and_keeps_its_nodal_force_and_its_work() {
        let (outcome, live) = crushed();
        assert!(outcome.rows.iter().zip(&live).all(|(row, live)| row.force_nodal == *live));
        let loading: Vec<&CurveRow> =
            outcome.rows.iter().filter(|r| r.phase == Phase::Load && r.depth > 1e-6).collect();
        // the exponent of F(h) from increment to increment, against the mean of its neighbours
        let roughness = |force: fn(&CurveRow) -> f64| {
            let exponent =
                |p: &[&CurveRow]| (force(p[1]) / force(p[0])).ln() / (p[1].depth / p[0].depth).ln();
            let exponents: Vec<f64> = loading.windows(2).map(exponent).collect();
            exponents.windows(3).map(|e| (e[1] - 0.5 * (e[0] + e[2])).powi(2)).sum::<f64>().sqrt()
        };
        let [nodal, corrected] = [roughness(|r| r.force_nodal), roughness(|r| r.force)];
        assert!(corrected < 0.1 * nodal, "{corrected} {nodal}");
        let peak = loading[loading.len() - 1];
        assert!((peak.force / peak.force_nodal - 1.0).abs() < 0.02);
        assert_eq!(outcome.summary.peak_force, peak.force);
        assert!((peak.mean_pressure * peak.contact_area / peak.force - 1.0).abs() < 1e-12);
        assert_eq!(outcome.summary.total_work, work_along(&outcome.rows[..=peak.increment]));
    }

    #[test]
    fn the_contact_radius_is_that_of_the_area_where_the_contact_opens_at_the_axis_too() {
        let (outcome, _) = crushed();
        for row in &outcome.rows {
            let disc = std::f64::consts::PI * row.contact_radius.powi(2);
            assert!((disc - row.contact_area).abs() <= 1e-9 * row.contact_area, "{row:?}");
        }
    }
}
