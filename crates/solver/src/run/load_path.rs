//! The path of the tool: adaptive increments down to the peak, back to zero force, and the body left alone.

use crate::algebra::newton::{Failure, Settings, solve};
use crate::body::energy::{ContactSums, contact_sums, work, work_by_slopes, work_to_separation};
use crate::body::failure::Failure as BodyFailure;
use crate::contact::edge::EdgeContact;
use crate::contact::penalty_correction::Punches;
use crate::contact::self_contact::fold;
use crate::run::equilibrium::{Equilibrium, SolveFailure};
use crate::run::record::Phase;
use crate::run::tool_stiffness::ToolStiffness;

mod reload;
mod target;

/// Halvings of an increment after which the run stops.
const MAX_HALVINGS: u32 = 7;

/// An increment in which the contact area grows by more than this factor is halved, as long as halvings are left: flat
/// metal comes into contact all at once when an asperity vanishes into its base. The schedule of the draft level
/// grows it by 1.5.
const MAX_AREA_GROWTH: f64 = 2.5;

/// Share of the last increment that is a good first guess for the next: measured 0.5 to 0.9 save a fifth of the
/// iterations, 1 saves less because it overshoots where the contact front moves from element to element.
const GUESS: f64 = 0.7;

/// One converged increment, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increment {
    /// Loading or unloading.
    pub phase: Phase,
    /// Travel of the tool from first touch, penetration included.
    pub travel: f64,
    /// Sums over the contact.
    pub contact: ContactSums,
    /// ∫F d(travel).
    pub external_work: f64,
    /// Stored elastic energy.
    pub elastic_energy: f64,
    /// Plastic work.
    pub plastic_work: f64,
    /// Newton iterations since the last increment.
    pub newton_iterations: usize,
}

impl Increment {
    /// Travel less penetration.
    pub fn depth(&self) -> f64 {
        self.travel - self.contact.penetration
    }
}

/// Why a run ended before its target. The last converged increment is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Stop {
    /// Elements were distorted until one turned inside out.
    #[error("an element turned inside out: the metal is too distorted for its mesh")]
    Distorted,
    /// No equilibrium was found however small the increment.
    #[error("no equilibrium was found with the smallest increment")]
    NoEquilibrium,
    /// A force that the tool does not find as deep as it can go.
    #[error(
        "the force is larger than what this body bears as deep as the tool can go: ask for less force, or for a depth"
    )]
    ForceNotReached,
    /// A flank met another flank: contact of the metal with itself is not modelled.
    #[error("a flank met another flank: metal that touches itself is not modelled")]
    FlanksMeet,
    /// The observer asked for the end.
    #[error("the run was interrupted")]
    Interrupted,
}

/// Where loading ends, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// At this depth.
    Depth(f64),
    /// At this force; the depth is an estimate.
    Force {
        /// The force to reach.
        force: f64,
        /// Depth at which it is expected.
        expected_depth: f64,
        /// Depth beyond which the search is given up.
        limit: f64,
    },
}

/// Where an increment that is taken in parts need not go on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Enough {
    depth: f64,
    force: f64,
}

/// Every part is to be taken.
const NEVER: Enough = Enough { depth: f64::INFINITY, force: f64::INFINITY };

impl Enough {
    fn holds(&self, travel: f64, sums: &ContactSums) -> bool {
        travel - sums.penetration >= self.depth || sums.force >= self.force
    }
}

/// Called after every converged increment; `false` ends the run.
pub type Observer<'o> = dyn FnMut(&Equilibrium<'_>, &Increment) -> bool + 'o;

/// A model on its way, with the counts of the run.
pub struct Path<'m> {
    /// The mechanical system.
    pub model: Equilibrium<'m>,
    settings: Settings,
    augmented: bool,
    /// Travel at which the tool touches first, in the coordinates of the mesh.
    touch: f64,
    travel: f64,
    last_step: f64,
    force: f64,
    area: f64,
    penetration: f64,
    /// Share of the work that went into flow while the body was loaded first: see [`crate::contact::penalty_correction`].
    plastic_share: f64,
    /// dF per travel, known while unloading and reloading.
    slope: Option<f64>,
    /// Travels of the last unloading, from its peak on.
    way_back: Vec<f64>,
    external_work: f64,
    spent: usize,
    /// Newton iterations so far, failed ones included.
    pub iterations: usize,
    /// Times an increment was halved.
    pub cutbacks: usize,
}

impl<'m> Path<'m> {
    /// A path that starts where the tool touches `model` first.
    pub fn new(model: Equilibrium<'m>, settings: Settings, augmented: bool) -> Path<'m> {
        let touch = model.converged_surface().first_touch();
        Path {
            model,
            settings,
            augmented,
            touch,
            travel: 0.0,
            last_step: 0.0,
            force: 0.0,
            area: 0.0,
            penetration: 0.0,
            plastic_share: 0.0,
            slope: None,
            way_back: Vec::new(),
            external_work: 0.0,
            spent: 0,
            iterations: 0,
            cutbacks: 0,
        }
    }

    /// Solves, but does not accept, the increment to `travel` with the first guess `guess` times the scaled last one.
    fn attempt(&mut self, travel: f64, carry: bool, guess: f64) -> Result<ContactSums, SolveFailure> {
        let step = travel - self.travel;
        let ratio =
            if self.last_step != 0.0 && step / self.last_step > 0.0 { step / self.last_step } else { 0.0 };
        let scale = guess * ratio;
        let last = if scale > 0.0 { self.model.state().displacement.clone() } else { Vec::new() };
        let tip = -(self.touch + travel);
        self.model.begin(tip, if carry { ratio } else { 0.0 }, |node| {
            last.get(node).map_or([0.0; 2], |du| du.map(|u| scale * u))
        });
        self.iterate()?;
        if self.augmented {
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

    fn iterate(&mut self) -> Result<(), SolveFailure> {
        let outcome = solve(&mut self.model, &self.settings);
        let spent = match &outcome {
            Ok(done) => done.iterations,
            Err((_, spent)) => *spent,
        };
        self.iterations += spent;
        self.spent += spent;
        outcome.map(|_| ()).map_err(|(failure, _)| failure)
    }

    fn sums(&self) -> ContactSums {
        self.sums_under(self.model.trial_surface().under_punches())
    }

    /// [`Path::sums`], the contact under punches being known.
    fn sums_under(&self, punches: Punches) -> ContactSums {
        let mut sums = contact_sums(self.model.contacts().iter(), self.model.body().symmetry);
        sums.penetration =
            punches.penetration + self.plastic_share * (sums.penetration - punches.penetration);
        sums
    }

    /// Slope of the force over the travel: multipliers leave no penetration that would follow the force.
    fn follows(&self, stiffness: &ToolStiffness) -> f64 {
        if self.augmented { stiffness.depth } else { stiffness.travel }
    }

    /// Accepts the attempted increment to `travel`.
    fn accept(&mut self, travel: f64, phase: Phase, observer: &mut Observer<'_>) -> Result<Increment, Stop> {
        // loading is close to F = (a + b h)²; unloading bends less the flatter the contact has become, so there the
        // slope is asked for, which costs one solve
        let slope = match phase {
            Phase::Load => None,
            Phase::Unload | Phase::Reload => self.model.tool_stiffness().ok().map(|s| self.follows(&s)),
        };
        self.model.accept().map_err(|_| Stop::Distorted)?;
        let punches = self.model.converged_surface().under_punches();
        let contact = self.sums_under(punches);
        let step = travel - self.travel;
        self.external_work += match (self.slope, slope) {
            (_, Some(to)) if self.force <= 0.0 => -work_to_separation(contact.force, to, -step),
            (Some(from), _) if contact.force <= 0.0 => work_to_separation(self.force, from, step),
            (Some(from), Some(to)) => work_by_slopes([self.force, contact.force], [from, to], step),
            _ => work([self.force, contact.force], step),
        };
        self.slope = slope;
        (self.travel, self.last_step, self.force, self.area) = (travel, step, contact.force, contact.area);
        self.penetration = contact.penetration;
        let [elastic_energy, plastic_work] = self.model.state().energies(self.model.body());
        if phase == Phase::Load && plastic_work > 0.0 {
            let near = punches.energy / self.model.body().material.elastic.reduced_modulus();
            self.plastic_share = plastic_work / (near + plastic_work);
        }
        let increment = Increment {
            phase,
            travel,
            contact,
            external_work: self.external_work,
            elastic_energy,
            plastic_work,
            newton_iterations: std::mem::take(&mut self.spent),
        };
        if !observer(&self.model, &increment) {
            return Err(Stop::Interrupted);
        }
        if fold(&self.model.state().edges, &self.model.state().position).is_some() {
            Err(Stop::FlanksMeet)
        } else {
            Ok(increment)
        }
    }

    /// Goes to `travel` in as few increments as converge; accepts all but the last, which is left attempted. That may be one
    /// before `travel` that already is `enough`: where an asperity vanishes into its base the penetration falls, and
    /// the travel planned with the one before would crush the base itself.
    fn reach_depth(
        &mut self,
        travel: f64,
        enough: Enough,
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
                        && sums.area > MAX_AREA_GROWTH * self.area
                        && halvings < MAX_HALVINGS =>
                {
                    halvings += 1;
                    next = 0.5 * (self.travel + next);
                }
                Ok(sums) if next == travel || enough.holds(next, &sums) => return Ok((next, sums)),
                Ok(_) => {
                    self.accept(next, phase, observer)?;
                    // try to take the rest in steps as long as the one that went
                    let step = self.last_step;
                    next = if (travel - next).abs() <= 1.01 * step.abs() { travel } else { next + step };
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
                        return Err(match failure {
                            Failure::System(BodyFailure::Element { .. }) => Stop::Distorted,
                            _ => Stop::NoEquilibrium,
                        });
                    }
                    halvings += 1;
                    self.cutbacks += 1;
                    next = 0.5 * (self.travel + next);
                    guess = 0.0;
                }
            }
        }
    }

    /// [`Path::reach_depth`] all the way.
    fn reach(
        &mut self,
        travel: f64,
        phase: Phase,
        carry: bool,
        observer: &mut Observer<'_>,
    ) -> Result<ContactSums, Stop> {
        self.reach_depth(travel, NEVER, phase, carry, observer).map(|(_, sums)| sums)
    }

    /// Loads to `goal` along `fractions` (see [`schedule`]); `penetration` is the expected one at the peak.
    pub fn load(
        &mut self,
        goal: Goal,
        fractions: &[f64],
        penetration: f64,
        observer: &mut Observer<'_>,
    ) -> Result<(), Stop> {
        let (depth, limit, enough) = match goal {
            Goal::Depth(depth) => (depth, depth, Enough { depth, ..NEVER }),
            Goal::Force { force, expected_depth, limit } => {
                (expected_depth, limit, Enough { depth: limit, force })
            }
        };
        let mut expected = penetration;
        let growth =
            fractions.last().copied().unwrap_or(1.0) / fractions.iter().rev().nth(1).copied().unwrap_or(0.5);
        let mut index = 0;
        let mut fraction = 0.0;
        loop {
            fraction = fractions.get(index).copied().unwrap_or(fraction * growth);
            index += 1;
            let planned = (fraction * depth).min(limit) + expected;
            let (travel, sums) = self.reach_depth(planned, enough, Phase::Load, true, observer)?;
            let last = match goal {
                Goal::Depth(_) => index == fractions.len() || travel != planned,
                Goal::Force { force, .. } => sums.force >= force,
            };
            if last {
                let travel = self.home_in(goal, travel, sums)?;
                return self.accept(travel, Phase::Load, observer).map(|_| ());
            }
            expected = sums.penetration;
            self.accept(travel, Phase::Load, observer)?;
            if (fraction * depth >= limit || travel != planned) && matches!(goal, Goal::Force { .. }) {
                return Err(Stop::ForceNotReached);
            }
        }
    }

    /// Unloads to zero force in about `steps` increments, then removes the tool and finds the equilibrium of the body
    /// alone: there the force is zero and the depth that of its highest point. `stiffness` is that of the peak.
    ///
    /// Travels follow F ∝ (1 - u/u₀)^1.25 with u₀ = 1.25 F/S; the last few percent of the force are not chased.
    pub fn unload(
        &mut self,
        stiffness: ToolStiffness,
        steps: usize,
        observer: &mut Observer<'_>,
    ) -> Result<(), Stop> {
        let (peak_force, peak) = (self.force, self.travel);
        let compliance = 1.0 / stiffness.depth + self.sums().penetration / peak_force;
        let recovery = 1.25 * peak_force * compliance;
        self.slope = Some(self.follows(&stiffness));
        self.way_back = vec![peak];
        for i in 1..=steps {
            let share = 1.0 - i as f64 / (steps as f64 + 0.3);
            let travel = peak - recovery * (1.0 - share.powf(1.0 / 1.25));
            if travel >= self.travel || self.force < 0.03 * peak_force {
                continue;
            }
            let sums = self.reach(travel, Phase::Unload, false, observer)?;
            if sums.force <= 0.0 {
                break; // beyond separation: the equilibrium without the tool comes next
            }
            self.accept(travel, Phase::Unload, observer)?;
            self.way_back.push(travel);
        }
        if self.model.body().material.has_back_stress() {
            self.retreat_from_reverse_flow(0.03 * peak_force, steps, observer)?;
        }
        self.model.begin(f64::INFINITY, 0.0, |_| [0.0; 2]);
        self.iterate().map_err(|_| Stop::NoEquilibrium)?;
        let separation = self.model.trial_surface().first_touch() - self.touch;
        self.accept(separation, Phase::Unload, observer).map(|_| ())
    }

    /// Contact of each group of edges at the last converged increment.
    pub fn group_sums(model: &Equilibrium<'_>, groups: &[usize], group: usize) -> ContactSums {
        let edges = model.contacts().iter().zip(groups).filter(|(_, g)| **g == group);
        contact_sums(edges.map(|(edge, _): (&EdgeContact, _)| edge), model.body().symmetry)
    }
}

/// Depths of the increments as shares of the peak, the last one 1.
///
/// Three uniform increments to `start`, then geometric ones: the error of an increment depends on the ratio of the
/// depths at its ends, and below `start` the work is too small to matter.
pub fn schedule(steps: usize, start: f64) -> Vec<f64> {
    if steps < 8 {
        return (1..=steps).map(|i| i as f64 / steps as f64).collect();
    }
    let uniform = 3;
    let geometric = steps - uniform;
    let first = (1..=uniform).map(|i| start * i as f64 / uniform as f64);
    let rest = (1..=geometric).map(|i| start.powf(1.0 - i as f64 / geometric as f64));
    first.chain(rest).collect()
}
