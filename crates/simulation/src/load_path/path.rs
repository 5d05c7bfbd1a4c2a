//! A body on its path: one attempted increment, and halved ones where it does not converge.

use super::increment::{Energies, Increment, Observer, Stop};
use crate::load_path::checkpoint::{Journal, solve_or_recall};
use crate::record::rows::Phase;
use crate::scene::ContactMethod;
use crate::setup::problem::{Problem, Rules};
use asperity_numerics::newton::{FACTOR_KEPT_BELOW, Settings};
use asperity_solver::body::energy::{
    ContactSums, PARTING, TOUCHING, contact_sums, work, work_by_parabola, work_by_power, work_by_slopes,
};
use asperity_solver::body::failure::Failure as BodyFailure;
use asperity_solver::contact::penalty_correction::Punches;
use asperity_solver::equilibrium::tool_stiffness::ToolStiffness;
use asperity_solver::equilibrium::{Equilibrium, SolveFailure};
use asperity_solver::remesh::distortion::LOADED;

/// Halvings of an increment after which the run stops.
const MAX_HALVINGS: u32 = 7;

/// Halvings of an increment after which a new mesh is tried.
const HALVINGS_OF_A_MESH: u32 = 3;

/// Elastic logarithmic strain up to which Hencky's law is elliptic (Bruhns, Xiao, Meyers: J. Elasticity 64 (2001)).
const ELLIPTIC: f64 = 1.0 / 3.0;

/// Growth of the travel before a better mesh is looked for again where there was none: each look costs.
const FARTHER: f64 = 1.1;

/// Share of the last increment that is a good first guess for the next: measured 0.5 to 0.9 save a fifth of the
/// iterations, 1 saves less because it overshoots where the contact front moves from element to element.
pub(super) const GUESS: f64 = 0.7;

/// How far the end of loading may be from the depth or from the root of the force that was asked for, relative to it.
pub(super) const MET: f64 = 1e-9;

/// Depth and force at which an increment that is taken in parts ends early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StopAt {
    pub depth: f64,
    pub force: f64,
    /// Whether the depth is that of the body, without the deflection of tool and machine.
    pub of_body: bool,
}

/// Every part is to be taken.
pub(super) const NEVER: StopAt = StopAt { depth: f64::INFINITY, force: f64::INFINITY, of_body: false };

/// Penetration, force and area of the contact: all that the depth depends on beside the travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ContactLoad {
    pub penetration: f64,
    pub force: f64,
    pub area: f64,
}

impl ContactLoad {
    pub fn of(sums: &ContactSums) -> ContactLoad {
        ContactLoad { penetration: sums.penetration, force: sums.force, area: sums.area }
    }
}

/// A body on its way, with the counts of the run.
pub struct Path<'p> {
    /// The mechanical system.
    pub model: Equilibrium<'p>,
    /// How each increment is solved.
    pub settings: Settings,
    /// The solves of this path on disk.
    pub(crate) journal: Option<Journal<'p>>,
    pub(super) problem: &'p Problem,
    /// Place of the tool at the travel 0, in the coordinates of the mesh: it touches there, or above a tip that the mesh cuts off.
    pub(super) touch: f64,
    pub(super) travel: f64,
    /// Largest travel so far.
    deepest: f64,
    last_step: f64,
    pub(super) force: f64,
    area: f64,
    /// Correction of the travel for the penetration.
    pub(super) penetration: f64,
    /// Share of the work that went into flow while the body was loaded first: see [`asperity_solver::contact::penalty_correction`].
    pub(super) plastic_share: f64,
    /// dF per travel, known while unloading and reloading.
    pub(super) slope: Option<f64>,
    /// Travels of the last unloading, from its peak on.
    pub(super) unloading_travels: Vec<f64>,
    /// The depth that was asked for.
    pub(super) asked: Option<f64>,
    external_work: f64,
    /// Elastic energy that earlier loads left.
    stored_before: f64,
    /// Force at the start of the last increment, and its length.
    earlier: Option<[f64; 2]>,
    spent: usize,
    /// Increments before the last remeshing.
    meshed_after: usize,
    /// Travel at which no better mesh was found last.
    in_vain: f64,
    /// Newton iterations so far, failed ones included.
    pub iterations: usize,
    /// Converged increments so far.
    pub increments: usize,
    /// Times an increment was halved.
    pub cutbacks: usize,
}

impl<'p> Path<'p> {
    /// A path that starts where the tool of `problem` touches its body first.
    ///
    /// # Errors
    /// An element of the mesh is inside out.
    pub fn new(problem: &'p Problem) -> Result<Path<'p>, BodyFailure> {
        let model = problem.equilibrium()?;
        let tolerance = problem.numbers.newton_tolerance;
        let cut_off = if problem.start.is_none() { problem.cut_off } else { 0.0 };
        Ok(Path {
            touch: model.converged_surface().first_touch() - cut_off,
            settings: Settings { tolerance, max_iterations: 40, keep: FACTOR_KEPT_BELOW },
            journal: None,
            problem,
            travel: cut_off,
            deepest: 0.0,
            last_step: 0.0,
            force: 0.0,
            area: 0.0,
            penetration: 0.0,
            plastic_share: 0.0,
            slope: None,
            unloading_travels: Vec::new(),
            asked: None,
            external_work: 0.0,
            stored_before: model.state().energies(model.body())[0],
            earlier: None,
            spent: 0,
            meshed_after: 0,
            in_vain: 0.0,
            iterations: 0,
            increments: 0,
            cutbacks: 0,
            model,
        })
    }

    pub(super) fn rules(&self) -> &'p Rules {
        &self.problem.rules
    }

    fn augmented(&self) -> bool {
        self.problem.numbers.contact == ContactMethod::Augmented
    }

    /// Travel of the tool at the last converged increment, from first touch.
    pub fn travel(&self) -> f64 {
        self.travel
    }

    /// Depth of the body at a `travel` of which a `penetration` is to be taken off, under a `force`.
    fn body_depth(&self, travel: f64, penetration: f64, force: f64) -> f64 {
        travel - penetration + self.rules().far_field * force
    }

    /// Depth at a `travel` under what the contact bears: that of the body and the deflection of tool and machine.
    pub(super) fn depth(&self, travel: f64, contact_load: ContactLoad) -> f64 {
        let deflection = self.rules().compliance.deflection(contact_load.force, contact_load.area);
        self.body_depth(travel, contact_load.penetration, contact_load.force) + deflection
    }

    /// Penetration, force and area of the contact at the last converged increment.
    pub(super) fn contact_load(&self) -> ContactLoad {
        ContactLoad { penetration: self.penetration, force: self.force, area: self.area }
    }

    /// Contact area at the last converged increment.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The depth that is compared with that of `stop_at`.
    fn measured_for(&self, stop_at: &StopAt, travel: f64, sums: &ContactSums) -> f64 {
        if stop_at.of_body {
            self.body_depth(travel, sums.penetration, sums.force)
        } else {
            self.depth(travel, ContactLoad::of(sums))
        }
    }

    /// Solves, but does not accept, the increment to `travel` with the first guess `guess` times the scaled last one.
    pub(super) fn attempt(
        &mut self,
        travel: f64,
        carry: bool,
        guess: f64,
    ) -> Result<ContactSums, SolveFailure> {
        let ratio = self.ratio(travel);
        let guess = self.scaled(guess * ratio);
        if travel > self.deepest {
            self.model.press_with(self.problem.penalty_at(travel));
        }
        self.model.begin(-(self.touch + travel), if carry { ratio } else { 0.0 }, guess);
        self.solve_attempted()
    }

    /// Solves the increment that was attempted last to a `travel` nearby, from where that stands.
    pub(super) fn attempt_again(&mut self, travel: f64) -> Result<ContactSums, SolveFailure> {
        self.model.move_tool(-(self.touch + travel));
        self.solve_attempted()
    }

    /// Length of the increment to `travel` over that of the last one; 0 where the tool turns.
    fn ratio(&self, travel: f64) -> f64 {
        let step = travel - self.travel;
        if self.last_step != 0.0 { (step / self.last_step).max(0.0) } else { 0.0 }
    }

    /// The displacement of the last increment times `scale`.
    fn scaled(&self, scale: f64) -> impl Fn(usize) -> [f64; 2] + use<> {
        let last = if scale > 0.0 { self.model.state().displacement.clone() } else { Vec::new() };
        move |node| last.get(node).map_or([0.0; 2], |du| du.map(|u| scale * u))
    }

    fn solve_attempted(&mut self) -> Result<ContactSums, SolveFailure> {
        self.iterate()?;
        if self.augmented() {
            // λ ← max(0, λ + ε d) until the penetration is a thousandth of what the penalty alone leaves
            let first = self.sums().penetration;
            for _ in 0..20 {
                self.model.augment();
                self.iterate()?;
                if self.sums().penetration.abs() <= 1e-3 * first {
                    break;
                }
            }
        }
        Ok(self.sums())
    }

    pub(super) fn iterate(&mut self) -> Result<(), SolveFailure> {
        self.model.set_tolerance(self.settings.tolerance);
        let outcome = solve_or_recall(&mut self.model, &self.settings, &mut self.journal);
        let (Ok(spent) | Err((_, spent))) = outcome;
        self.iterations += spent;
        self.spent += spent;
        outcome.map(|_| ()).map_err(|(failure, _)| failure)
    }

    pub(super) fn sums(&self) -> ContactSums {
        self.corrected(&self.model.trial_surface().under_punches())
    }

    /// The sums over the contact, their penetration that to be taken off the travel.
    fn corrected(&self, punches: &Punches) -> ContactSums {
        let mut sums = contact_sums(self.model.contacts().iter(), self.model.body().symmetry);
        sums.penetration =
            punches.penetration + self.plastic_share * (sums.penetration - punches.penetration);
        sums
    }

    /// Slope of the force over the travel: multipliers leave no penetration that would follow the force.
    pub(super) fn follows(&self, stiffness: &ToolStiffness) -> f64 {
        if self.augmented() { stiffness.depth } else { stiffness.travel }
    }

    /// Accepts the attempted increment to `travel`.
    pub(super) fn accept(
        &mut self,
        travel: f64,
        phase: Phase,
        observer: &mut Observer<'_>,
    ) -> Result<Increment, Stop> {
        let before = (self.force, self.slope);
        // loading is close to a parabola but at its start, whose power only the slope tells (1 of a ridge, 2 of a cone); unloading
        // bends less the flatter the contact has become; so there the slope is asked for, which costs one solve
        let asked = before.0 <= 0.0 || phase != Phase::Load;
        self.slope = asked.then(|| self.model.tool_stiffness().ok().map(|s| self.follows(&s))).flatten();
        self.model.accept().map_err(|_| Stop::Distorted)?;
        let punches = self.model.converged_surface().under_punches();
        let contact = self.corrected(&punches);
        let step = travel - self.travel;
        (self.travel, self.last_step, self.force, self.area) = (travel, step, contact.force, contact.area);
        self.penetration = contact.penetration;
        self.deepest = self.deepest.max(travel);
        self.increments += 1;
        let energies = self.count(before, step, phase, &punches);
        self.earlier = Some([before.0, step]);
        let depth = self.depth(travel, ContactLoad::of(&contact));
        let met = |asked: &f64| (depth / asked - 1.0).abs() < 2.0 * MET;
        let increment = Increment {
            phase,
            travel,
            depth: self.asked.filter(met).unwrap_or(depth),
            contact,
            compliance_depth: self.rules().compliance.deflection(contact.force, contact.area),
            energies,
            newton_iterations: std::mem::take(&mut self.spent),
        };
        if !observer(&self.model, &increment) {
            return Err(Stop::Interrupted);
        }
        let state = self.model.state();
        // a fold that lies on the flank of the tool is one of the mesh, not of the metal
        if state.facing.fold(&state.edges, &state.position).is_some() && !self.remesh() {
            return Err(self.because(Stop::FlanksMeet));
        }
        let looks = phase == Phase::Load && self.travel > FARTHER * self.in_vain;
        if looks && self.model.is_distorted(LOADED) && !self.remesh() {
            self.in_vain = self.travel;
        }
        Ok(increment)
    }

    /// Remeshes where the tool stands, and records the contact there. Whether it did.
    pub fn remesh(&mut self) -> bool {
        if self.meshed_after == self.increments {
            return false;
        }
        self.meshed_after = self.increments;
        let tolerance = self.settings.tolerance;
        let (settings, journal, mut spent) = (self.settings, &mut self.journal, 0);
        let done = self.model.remesh(|model| {
            model.set_tolerance(tolerance);
            let outcome = solve_or_recall(model, &settings, journal);
            let (Ok(iterations) | Err((_, iterations))) = outcome;
            spent = iterations;
            outcome.map(|_| ()).map_err(|(failure, _)| failure)
        });
        self.iterations += spent;
        self.spent += spent;
        if done {
            self.earlier = None;
            let contact = self.corrected(&self.model.converged_surface().under_punches());
            (self.force, self.area, self.penetration) = (contact.force, contact.area, contact.penetration);
        }
        done
    }

    /// Energies at the end of an accepted increment over `step` from a force and its slope, and what the next one needs of them.
    fn count(
        &mut self,
        (force, slope): (f64, Option<f64>),
        step: f64,
        phase: Phase,
        punches: &Punches,
    ) -> Energies {
        self.external_work += match (slope, self.slope) {
            (_, Some(to)) if force <= 0.0 => work_by_power(self.force, to, step, TOUCHING),
            (Some(from), _) if self.force <= 0.0 => work_by_power(force, from, step, PARTING),
            (Some(from), Some(to)) => work_by_slopes([force, self.force], [from, to], step),
            _ => match self.earlier {
                Some([earlier, last]) if last * step > 0.0 => {
                    work_by_parabola([earlier, force, self.force], [last, step])
                }
                _ => work([force, self.force], step),
            },
        };
        let [elastic, plastic] = self.model.state().energies(self.model.body());
        if phase == Phase::Load && plastic > 0.0 {
            let near = punches.energy / self.model.body().material.elastic.reduced_modulus();
            self.plastic_share = plastic / (near + plastic);
        }
        Energies { external_work: self.external_work, elastic: elastic - self.stored_before, plastic }
    }

    /// Goes to `travel` in as few increments as converge; accepts all but the last, which is left attempted. That may be one
    /// before `travel` that already reaches `stop_at`: where an asperity vanishes into its base the penetration falls, and
    /// the travel planned with the one before would crush the base itself.
    pub(super) fn reach_depth(
        &mut self,
        travel: f64,
        stop_at: StopAt,
        phase: Phase,
        carry: bool,
        observer: &mut Observer<'_>,
    ) -> Result<(f64, ContactSums), Stop> {
        let mut halvings = 0;
        let mut stiffens = true;
        self.model.stiffen(true);
        let mut next = travel;
        let mut guess = if carry { GUESS } else { 0.0 };
        loop {
            match self.attempt(next, carry, guess) {
                Ok(sums)
                    if self.area > 0.0
                        && sums.area > self.rules().area_growth * self.area
                        && halvings < MAX_HALVINGS =>
                {
                    halvings += 1;
                    next = 0.5 * (self.travel + next);
                }
                Ok(sums)
                    if next == travel
                        || self.measured_for(&stop_at, next, &sums) >= stop_at.depth
                        || sums.force >= stop_at.force =>
                {
                    return Ok((next, sums));
                }
                Ok(_) => {
                    self.accept(next, phase, observer)?;
                    // try to take the rest in steps as long as the one that went
                    let step = self.last_step;
                    next = if (travel - next).abs() <= 1.01 * step.abs() { travel } else { next + step };
                }
                Err(_) if halvings == HALVINGS_OF_A_MESH && self.remesh() => {
                    self.cutbacks += 1;
                    halvings = 0;
                    next = travel;
                    guess = 0.0;
                }
                Err(_) if halvings >= MAX_HALVINGS && stiffens => {
                    // a stiffer tangent converges slowly, and can end in a place that no smaller increment leads out of
                    stiffens = false;
                    self.model.stiffen(false);
                    halvings = 0;
                    next = travel;
                }
                Err(failure) => {
                    if halvings >= MAX_HALVINGS {
                        return Err(self.stop(&failure));
                    }
                    halvings += 1;
                    self.cutbacks += 1;
                    next = 0.5 * (self.travel + next);
                    guess = 0.0;
                }
            }
        }
    }

    /// Why the path ends where the smallest increment has no equilibrium.
    fn stop(&self, failure: &SolveFailure) -> Stop {
        self.because(match failure {
            SolveFailure::System(BodyFailure::Element { .. }) => Stop::Distorted,
            _ => Stop::NoEquilibrium,
        })
    }

    /// The `stop`, or what led to it: beyond its limit the law of elasticity lets metal fold and turn inside out.
    fn because(&self, stop: Stop) -> Stop {
        if self.model.state().largest_elastic_strain() > ELLIPTIC { Stop::ElasticStrain } else { stop }
    }

    /// [`Path::reach_depth`] all the way.
    pub(super) fn reach(
        &mut self,
        travel: f64,
        phase: Phase,
        carry: bool,
        observer: &mut Observer<'_>,
    ) -> Result<ContactSums, Stop> {
        self.reach_depth(travel, NEVER, phase, carry, observer).map(|(_, sums)| sums)
    }
}
