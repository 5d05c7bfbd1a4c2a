//! A body on its path: one attempted increment, and what follows when it is taken.

use super::energy_account::EnergyAccount;
use super::increment::{Increment, Observer, Stop};
use crate::record::rows::Phase;
use crate::setup::problem::{Problem, Rules};
use asperity_numerics::newton::{KEPT_FACTORS_REDUCTION, Settings, solve};
use asperity_solver::body::analysis::Analyses;
use asperity_solver::body::energy::{ContactSums, contact_sums};
use asperity_solver::body::failure::Failure as BodyFailure;
use asperity_solver::contact::depth_correction::Punches;
use asperity_solver::equilibrium::{Equilibrium, SolveFailure};
use asperity_solver::remesh::distortion::LIMITS_WHILE_LOADING;

/// Elastic logarithmic strain up to which Hencky's law is elliptic (Bruhns, Xiao, Meyers: J. Elasticity 64
/// (2001)).
const LARGEST_ELASTIC_STRAIN: f64 = 1.0 / 3.0;

/// The reason why an attempted increment cannot be accepted.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Miss {
    /// It has no equilibrium that was found.
    Failure(SolveFailure),
    /// It is a leap to another state.
    Leap,
}

impl From<SolveFailure> for Miss {
    fn from(failure: SolveFailure) -> Miss {
        Miss::Failure(failure)
    }
}

/// Growth of the travel before a better mesh is looked for again where there was none: each look costs.
const REMESHING_TRAVEL_RATIO: f64 = 1.1;

/// Energy that all transfers to better meshes may take, over the plastic work and [`TRANSFERABLE_WORK`] of
/// the largest work: where the path could go on with its mesh, and where it could not. Transfers of metal
/// that flows take a thousandth of it; of a body that is elastic but for a little they took twice its plastic
/// work.
const TRANSFER_SHARES: [f64; 2] = [0.1, 1.0];

/// Share of the work that counts beside the plastic work: of a body that hardly yields.
const TRANSFERABLE_WORK: f64 = 0.01;

/// Share of the last increment that is a good first guess for the next: measured 0.5 to 0.9 save a fifth of
/// the iterations, 1 saves less because it overshoots where the contact front moves from element to element.
pub(super) const FIRST_GUESS_SHARE: f64 = 0.7;

/// Largest distance of the end of loading from the depth or from the root of the force that was asked for,
/// relative to it.
pub(super) const GOAL_DISTANCE: f64 = 1e-9;

/// Penetration, force and area of the contact: all that the depth depends on beside the travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ContactLoad {
    pub penetration: f64,
    pub force: f64,
    pub area: f64,
}

impl ContactLoad {
    pub fn from_sums(sums: &ContactSums) -> ContactLoad {
        ContactLoad { penetration: sums.penetration, force: sums.force, area: sums.area }
    }
}

/// The tool at the last converged increment: its travel and its load.
pub(super) struct Stand {
    pub travel: f64,
    /// Largest travel so far.
    deepest: f64,
    /// Length of the last increment.
    pub last_step: f64,
    /// Load of the contact; its penetration is the correction of the travel.
    pub contact: ContactLoad,
    /// dF per travel, known while unloading and reloading.
    pub slope: Option<f64>,
}

impl Stand {
    /// At a `travel` before first touch.
    fn new(travel: f64) -> Stand {
        let contact = ContactLoad { penetration: 0.0, force: 0.0, area: 0.0 };
        Stand { travel, deepest: 0.0, last_step: 0.0, contact, slope: None }
    }

    /// Goes on to `travel`. Returns the length of the increment.
    fn go_to(&mut self, travel: f64, contact: ContactLoad) -> f64 {
        let step = travel - self.travel;
        (self.travel, self.last_step, self.contact) = (travel, step, contact);
        self.deepest = self.deepest.max(travel);
        step
    }

    /// Length of the increment to `travel` over that of the last one; 0 where the tool turns.
    fn ratio(&self, travel: f64) -> f64 {
        let step = travel - self.travel;
        if self.last_step != 0.0 { (step / self.last_step).max(0.0) } else { 0.0 }
    }
}

/// Work of a path so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    /// Newton iterations, failed ones included.
    pub iterations: usize,
    /// Converged increments.
    pub increments: usize,
    /// Times an increment was halved.
    pub cutbacks: usize,
    /// Newton iterations since the last converged increment.
    spent: usize,
}

impl Counts {
    /// Counts the iterations of a solve.
    fn add_iterations(&mut self, iterations: usize) {
        self.iterations += iterations;
        self.spent += iterations;
    }
}

/// The last search for a better mesh.
struct Remeshing {
    /// Increments before that.
    after: usize,
    /// Travel at which there was none.
    in_vain: f64,
}

/// A body on its way, with the counts of the run.
pub struct Path<'p> {
    /// The mechanical system.
    pub model: Equilibrium<'p>,
    /// Settings of the solution of each increment.
    pub settings: Settings,
    pub(super) problem: &'p Problem,
    /// Place of the tool at the travel 0, in the coordinates of the mesh: it touches there, or above a tip
    /// that the mesh cuts off.
    pub(super) touch: f64,
    pub(super) stand: Stand,
    pub(super) account: EnergyAccount,
    remeshing: Remeshing,
    /// Travels of the last unloading, from its peak on.
    pub(super) unloading_travels: Vec<f64>,
    /// The depth that was asked for.
    pub(super) asked: Option<f64>,
    /// The counts so far.
    pub counts: Counts,
}

impl<'p> Path<'p> {
    /// A path that starts where the tool of `problem` touches its body first. The mesh is analysed unless it
    /// is one of `analyses`.
    ///
    /// # Errors
    /// An element of the mesh is inside out.
    pub fn new(problem: &'p Problem, analyses: &Analyses) -> Result<Path<'p>, BodyFailure> {
        let model = problem.equilibrium(analyses)?;
        let tolerance = problem.numbers.newton_tolerance;
        let specimen = &problem.specimen;
        let cut_off = if specimen.earlier.is_none() { specimen.cut_off } else { 0.0 };
        Ok(Path {
            touch: model.converged_surface().first_touch() - cut_off,
            settings: Settings { tolerance, max_iterations: 40, keep: KEPT_FACTORS_REDUCTION },
            problem,
            stand: Stand::new(cut_off),
            account: EnergyAccount::new(model.state().energies(model.body())[0]),
            remeshing: Remeshing { after: 0, in_vain: 0.0 },
            unloading_travels: Vec::new(),
            asked: None,
            counts: Counts::default(),
            model,
        })
    }

    pub(super) fn rules(&self) -> &'p Rules {
        &self.problem.rules
    }

    /// Travel of the tool at the last converged increment, from first touch.
    pub fn travel(&self) -> f64 {
        self.stand.travel
    }

    /// Depth of the body at a `travel` less a `penetration`, under a `force`.
    pub(super) fn body_depth(&self, travel: f64, penetration: f64, force: f64) -> f64 {
        travel - penetration + self.rules().far_field * force
    }

    /// Depth at a `travel` under the load of the contact: that of the body and the deflection of tool and
    /// machine.
    pub(super) fn depth(&self, travel: f64, contact_load: ContactLoad) -> f64 {
        let deflection = self.rules().compliance.deflection(contact_load.force, contact_load.area);
        self.body_depth(travel, contact_load.penetration, contact_load.force) + deflection
    }

    /// Contact area at the last converged increment.
    pub fn area(&self) -> f64 {
        self.stand.contact.area
    }

    /// True where the increment to `travel` that was solved is a leap to another state: see
    /// [`EnergyAccount::leaps`].
    fn leaps(&self, travel: f64) -> bool {
        let force = self.model.contacts().iter().map(|contact| contact.load).sum();
        let forces = [(self.stand.contact.force, self.stand.slope), (force, None)];
        let step = travel - self.stand.travel;
        self.account.leaps(self.model.plastic_work(), || self.model.energy_released(), forces, step)
    }

    /// Solves, but does not accept, the increment to `travel` with the first guess `guess` times the scaled
    /// last one.
    pub(super) fn attempt(&mut self, travel: f64, carry: bool, guess: f64) -> Result<ContactSums, Miss> {
        let ratio = self.stand.ratio(travel);
        let guess = self.scaled(guess * ratio);
        if travel > self.stand.deepest {
            self.model.press_with(self.problem.penalty_at(travel));
        }
        self.model.begin(-(self.touch + travel), if carry { ratio } else { 0.0 }, guess);
        self.solve_attempted(travel)
    }

    /// Solves the increment that was attempted last to a `travel` nearby, from where that stands.
    pub(super) fn attempt_again(&mut self, travel: f64) -> Result<ContactSums, Miss> {
        self.model.move_tool(-(self.touch + travel));
        self.solve_attempted(travel)
    }

    /// The displacement of the last increment times `scale`.
    fn scaled(&self, scale: f64) -> impl Fn(usize) -> [f64; 2] + use<> {
        let last = if scale > 0.0 { self.model.state().displacement.clone() } else { Vec::new() };
        move |node| last.get(node).map_or([0.0; 2], |du| du.map(|u| scale * u))
    }

    fn solve_attempted(&mut self, travel: f64) -> Result<ContactSums, Miss> {
        self.iterate()?;
        if self.leaps(travel) { Err(Miss::Leap) } else { Ok(self.sums()) }
    }

    fn iterate(&mut self) -> Result<(), SolveFailure> {
        self.model.set_tolerance(self.settings.tolerance);
        let outcome = solve(&mut self.model, &self.settings).map(|done| done.iterations);
        let (Ok(spent) | Err((_, spent))) = outcome;
        self.counts.add_iterations(spent);
        outcome.map(|_| ()).map_err(|(failure, _)| failure)
    }

    /// Solves, but does not accept, the body without its tool. Returns the travel at which that parts from
    /// it.
    pub(super) fn take_away(&mut self) -> Result<f64, Miss> {
        self.model.begin(f64::INFINITY, 0.0, |_| [0.0; 2]);
        self.iterate()?;
        let separation = self.model.trial_surface().first_touch() - self.touch;
        if self.leaps(separation) { Err(Miss::Leap) } else { Ok(separation) }
    }

    pub(super) fn sums(&self) -> ContactSums {
        self.corrected(&self.model.trial_surface().under_punches())
    }

    /// The sums over the contact, with the penetration that is to be subtracted from the travel.
    fn corrected(&self, punches: &Punches) -> ContactSums {
        let mut sums = contact_sums(self.model.contacts().iter(), self.model.body().symmetry);
        sums.penetration =
            punches.penetration + self.account.plastic_share() * (sums.penetration - punches.penetration);
        sums
    }

    /// True where the attempted increment to `travel` of a body that earlier loads left is less deep than the
    /// last one, by more than Newton's method leaves open. At first touch of a virgin body the penetration
    /// that is subtracted may grow by more than the travel, once.
    fn goes_back(&self, travel: f64) -> bool {
        let before = self.depth(self.stand.travel, self.stand.contact);
        let after = self.depth(travel, ContactLoad::from_sums(&self.sums()));
        let is_formed = self.problem.specimen.earlier.is_some();
        is_formed
            && self.stand.contact.force > 0.0
            && after < (1.0 - self.problem.numbers.newton_tolerance) * before
    }

    /// Accepts the attempted increment to `travel`, unless loading would go back.
    pub(super) fn accept(
        &mut self,
        travel: f64,
        phase: Phase,
        observer: &mut Observer<'_>,
    ) -> Result<Increment, Stop> {
        if phase == Phase::Load && self.goes_back(travel) {
            return Err(Stop::DepthFell);
        }
        let before = (self.stand.contact.force, self.stand.slope);
        // loading is close to a parabola but at its start, whose power only the slope tells (1 of a ridge, 2
        // of a cone); unloading bends less the flatter the contact has become; so there the slope is asked
        // for, which costs one solve
        let asked = before.0 <= 0.0 || phase != Phase::Load;
        self.stand.slope = asked.then(|| self.model.tool_stiffness().ok().map(|s| s.travel)).flatten();
        self.model.accept().map_err(|_| Stop::Distorted)?;
        let punches = self.model.converged_surface().under_punches();
        let contact = self.corrected(&punches);
        let step = self.stand.go_to(travel, ContactLoad::from_sums(&contact));
        self.counts.increments += 1;
        self.account.add_work([before, (contact.force, self.stand.slope)], step);
        let body = self.model.body();
        let near = punches.energy / body.material.elastic.reduced_modulus();
        let energies = self.account.balance(self.model.state().energies(body), near, phase);
        let depth = self.depth(travel, ContactLoad::from_sums(&contact));
        let met = |asked: &f64| (depth / asked - 1.0).abs() < 2.0 * GOAL_DISTANCE;
        let increment = Increment {
            phase,
            travel,
            depth: self.asked.filter(met).unwrap_or(depth),
            contact,
            compliance_depth: self.rules().compliance.deflection(contact.force, contact.area),
            energies,
            newton_iterations: std::mem::take(&mut self.counts.spent),
        };
        if !observer(&self.model, &increment) {
            return Err(Stop::Interrupted);
        }
        let state = self.model.state();
        // a fold that lies on the flank of the tool is one of the mesh, not of the metal
        if state.facing.fold(&state.edges, &state.position).is_some() && !self.remesh() {
            return Err(self.because(Stop::FlanksMeet));
        }
        let looks =
            phase == Phase::Load && self.stand.travel > REMESHING_TRAVEL_RATIO * self.remeshing.in_vain;
        if looks && self.model.is_distorted(LIMITS_WHILE_LOADING) && !self.remesh_for_the_better() {
            self.remeshing.in_vain = self.stand.travel;
        }
        Ok(increment)
    }

    /// Remeshes where the tool stands, and records the contact there. Whether it did: where the body did not
    /// move since it was tried last, or too much energy would go, it does not.
    pub fn remesh(&mut self) -> bool {
        if self.remeshing.after == self.counts.increments {
            return false;
        }
        self.remeshing.after = self.counts.increments;
        self.remesh_within(TRANSFER_SHARES[1])
    }

    /// [`Path::remesh`] where the path could go on as it is: with less energy to lose.
    pub(super) fn remesh_for_the_better(&mut self) -> bool {
        if self.remeshing.after == self.counts.increments {
            return false;
        }
        let done = self.remesh_within(TRANSFER_SHARES[0]);
        if done {
            self.remeshing.after = self.counts.increments;
        }
        done
    }

    /// Remeshes unless that takes more than a `share` of what may be counted on.
    fn remesh_within(&mut self, share: f64) -> bool {
        let plastic = self.model.state().ledger.plastic_work;
        let largest = share * (plastic + TRANSFERABLE_WORK * self.account.largest_work());
        let tolerance = self.settings.tolerance;
        let (settings, mut spent) = (self.settings, 0);
        let done = self.model.remesh(largest, |model| {
            model.set_tolerance(tolerance);
            let outcome = solve(model, &settings).map(|done| done.iterations);
            let (Ok(iterations) | Err((_, iterations))) = outcome;
            spent = iterations;
            outcome.map(|_| ()).map_err(|(failure, _)| failure)
        });
        self.counts.add_iterations(spent);
        if done {
            self.account.forget_earlier();
            let contact = self.corrected(&self.model.converged_surface().under_punches());
            self.stand.contact = ContactLoad::from_sums(&contact);
        }
        done
    }

    /// The `stop`, or what led to it: beyond its limit the law of elasticity lets metal fold and turn inside
    /// out.
    pub(super) fn because(&self, stop: Stop) -> Stop {
        if self.model.state().largest_elastic_strain() > LARGEST_ELASTIC_STRAIN {
            Stop::ElasticStrain
        } else {
            stop
        }
    }
}
