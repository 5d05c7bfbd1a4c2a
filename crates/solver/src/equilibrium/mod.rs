//! The equilibrium of one increment after the other: the body as Newton sees it, with what a solver remembers
//! between iterates and increments (factors, secants, the contact that was kept), none of which belongs to
//! the body.

mod contact_set;
mod factorise;
mod factors;
mod line_search;
pub mod tool_stiffness;
mod unloading;

use crate::body::assembly::Response;
use crate::body::discrete_body::Body;
use crate::body::dofs::FIXED;
use crate::body::energy::contact_sums;
use crate::body::failure::Failure;
use crate::body::state::{State, Trial};
use crate::body::stiffness::Stiffness;
use crate::body::surface::Surface;
use crate::contact::edge::EdgeContact;
use crate::equilibrium::contact_set::ContactSet;
use crate::equilibrium::factors::{Factors, precision};
use crate::equilibrium::line_search::LineSearch;
use crate::equilibrium::tool_stiffness::{ToolStiffness, tool_stiffness};
use crate::point::j2::Tangent;
use crate::remesh::distortion::{Limits, is_distorted, smoothed_places};
use asperity_numerics::newton::{self, Assessment, System};
use asperity_numerics::sparse::cholesky::{Factor, Operations, Precision};
use asperity_numerics::vectors::norm;
use std::collections::BTreeSet;
use std::time::Instant;

/// Relative residual at which a displacement is good enough to tell which points stop yielding.
const YIELDING_KNOWN_AT: f64 = 0.1;

/// The reason why an increment has no equilibrium.
pub type SolveFailure = newton::NewtonError<Failure>;

/// Counters of the work done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counters {
    /// Element loops with tangent.
    pub assemblies: usize,
    /// Element loops without.
    pub residuals: usize,
    /// Factorisations.
    pub factorisations: usize,
    /// Seconds in assembly, contact included.
    pub assembly_s: f64,
    /// Those of the assemblies with tangent.
    pub tangent_s: f64,
    /// Seconds in factorisations.
    pub factor_s: f64,
    /// Seconds in triangular solves.
    pub solve_s: f64,
    /// Factorisations that lost a pivot.
    pub lost_pivots: usize,
    /// Points returned to the yield surface.
    pub returns: usize,
}

/// A body, its converged state, and the increment under way.
pub struct Equilibrium<'m> {
    body: Body<'m>,
    state: State,
    trial: Trial,
    response: Response,
    stiffness: Stiffness,
    /// Groups of nodes that the stiffness couples beside those of the elements.
    coupled: BTreeSet<Vec<u32>>,
    factors: Factors,
    search: LineSearch,
    contact_set: ContactSet,
    /// True where the stiffness is that of the last assessed iterate.
    has_tangent: bool,
    /// True where tangents that are far from definite are stiffened.
    stiffens: bool,
    /// True where the extrapolation of the points is still to be limited (see
    /// [`State::limit_extrapolation`]), and the relative residual at which it is.
    unlimited: bool,
    limited_at: f64,
    /// Work done so far.
    pub counters: Counters,
}

impl<'m> Equilibrium<'m> {
    /// The stress-free `body`.
    ///
    /// # Errors
    /// A stiffness pattern that cannot be analysed.
    pub fn new(body: Body<'m>) -> Result<Self, Failure> {
        let state = State::virgin(&body);
        Equilibrium::from_state(body, state)
    }

    /// The `body` in a `state` without a tool.
    ///
    /// # Errors
    /// As for [`Equilibrium::new`].
    pub fn from_state(body: Body<'m>, state: State) -> Result<Self, Failure> {
        let stiffness = body.analysis.stiffness.clone();
        let factors = Factors::new(body.analysis.fronts.clone(), precision(&body.material));
        let search = LineSearch::new(body.mesh.nodes.len(), body.analysis.dofs.count);
        Ok(Equilibrium {
            trial: state.trial(),
            response: Response::new(&body, &state),
            stiffness,
            coupled: BTreeSet::new(),
            factors,
            search,
            contact_set: ContactSet::new(state.edges.len()),
            has_tangent: false,
            stiffens: true,
            unlimited: false,
            limited_at: YIELDING_KNOWN_AT,
            counters: Counters::default(),
            body,
            state,
        })
    }

    /// The body.
    pub fn body(&self) -> &Body<'m> {
        &self.body
    }

    /// From now on without the vector registers of the processor, as a test on any processor.
    #[doc(hidden)]
    pub fn without_vector_registers(&mut self) {
        self.body.arch = pulp::Arch::Scalar;
        self.factors.factor.without_vector_registers();
    }

    /// The converged state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The response of the body at the last assessed iterate.
    pub fn response(&self) -> &Response {
        &self.response
    }

    /// The surface of the converged state.
    pub fn converged_surface(&self) -> Surface<'_> {
        Surface::of_state(&self.body, &self.state)
    }

    /// The surface at the last assessed iterate, until that is accepted.
    pub fn trial_surface(&self) -> Surface<'_> {
        Surface::of_trial(&self.body, &self.state, &self.trial, &self.response)
    }

    /// Contact of every surface edge at the last assessed iterate, in the order of the mesh.
    pub fn contacts(&self) -> &[EdgeContact] {
        &self.response.contact
    }

    /// Stiffness at the last assessed iterate with a tangent: lower triangle, by the numbers of the unknowns.
    pub fn stiffness(&self) -> &asperity_numerics::sparse::CsMat<f64> {
        &self.stiffness.matrix
    }

    /// True for each point that yields at the last assessed iterate.
    pub fn yielding_points(&self) -> impl Iterator<Item = bool> + '_ {
        self.response.yielding_points(&self.trial)
    }

    /// Operations of a factorisation of the stiffness and of a solve.
    pub fn operations(&self) -> Operations {
        self.factors.factor.operations()
    }

    /// Gives the stiffness the places of what the surface may press of itself in the increments to come.
    fn couple_what_faces(&mut self) {
        let state = &self.state;
        let mut grown = false;
        for (nodes, count) in state.facing.couplings(&state.edges) {
            let mut group = nodes[..count].to_vec();
            if !self.stiffness.couples(&group, &self.body.analysis.dofs) {
                group.sort_unstable();
                grown |= self.coupled.insert(group);
            }
        }
        if grown {
            let groups: Vec<Vec<u32>> = self.coupled.iter().cloned().collect();
            let mesh = self.body.mesh;
            self.stiffness =
                Stiffness::coupled(&mesh.cells, mesh.kind.nodes(), &groups, &self.body.analysis.dofs);
            self.factors.factor = Factor::new(&self.stiffness.matrix, self.factors.factor.precision());
            self.discard_factors();
        }
    }

    /// Starts an increment: see [`State::begin`]. Its first iterate keeps the contact of the converged state.
    pub fn begin(&mut self, tip: f64, ratio: f64, guess: impl Fn(usize) -> [f64; 2]) {
        self.couple_what_faces();
        self.state.begin(&self.body, tip, ratio, guess, &mut self.trial);
        self.keep_converged_contact();
        self.unlimited = self.trial.factor > 0.0 && !self.state.plastic.is_empty();
    }

    /// Contact pressure per penetration from the next increment on.
    pub fn press_with(&mut self, penalty: f64) {
        self.trial.penalty = penalty;
    }

    /// From now on increments are solved to the relative residual `tolerance`: the closer, the less what is
    /// frozen on the way may depend on that way.
    pub fn set_tolerance(&mut self, tolerance: f64) {
        self.limited_at = YIELDING_KNOWN_AT.min(1e3 * tolerance);
    }

    /// Moves the tool of the increment under way to `tip`. Its points start as they did, so that the response
    /// is a smooth function of `tip`; the iterate stays, and with it the contact.
    pub fn move_tool(&mut self, tip: f64) {
        self.trial.tip = tip;
        self.contact_set.set_keeping(false);
        self.search.restart();
    }

    /// The first iterate of an increment keeps the contact of the converged state, and is no step of the last
    /// increment.
    fn keep_converged_contact(&mut self) {
        let edges = if self.trial.tip == f64::INFINITY { 0 } else { self.state.edges.len() };
        self.contact_set.keep(self.state.parts().take(edges));
        self.search.restart();
    }

    /// The factors and the tangent are of another body.
    fn discard_factors(&mut self) {
        self.factors.discard();
        self.has_tangent = false;
    }

    /// Remeshes the distorted body under its surface and finds the equilibrium there by `solve`, while the
    /// tool stays. Whether it did: else all is as it was. It does not where all transfers so far would change
    /// the energies by more than `largest`.
    pub fn remesh(
        &mut self,
        largest: f64,
        solve: impl FnOnce(&mut Self) -> Result<(), SolveFailure>,
    ) -> bool {
        // back stresses are not carried over
        let carries = self.state.points.history.is_empty();
        let places =
            smoothed_places(&self.body, &self.state).filter(|_| carries && self.state.tip.is_finite());
        let Some((body, state)) = places.and_then(|places| self.state.moved_to(&self.body, places)) else {
            return false;
        };
        let before = (std::mem::replace(&mut self.body, body), std::mem::replace(&mut self.state, state));
        let flow =
            (self.state.plastic.clone(), self.state.volume_change.clone(), self.state.displacement.clone());
        self.discard_factors();
        self.begin(self.state.tip, 0.0, |_| [0.0; 2]);
        let mut done = solve(self).is_ok() && self.accept().is_ok();
        if done {
            // the flow of the last increment of the load is what the next one extrapolates
            (self.state.plastic, self.state.volume_change, self.state.displacement) = flow;
            self.state.note_transfer(&self.body, &before.1, &before.0);
            done = self.state.ledger.transferred.abs() <= largest;
        }
        if !done {
            (self.body, self.state) = before;
            self.discard_factors();
        }
        done
    }

    /// True where the mesh is more distorted than the `limits` allow.
    pub fn is_distorted(&self, limits: Limits) -> bool {
        is_distorted(&self.body, &self.state, limits)
    }

    /// Plastic work of the increment under way, from the converged state to the last assessed iterate.
    pub fn plastic_work(&self) -> f64 {
        self.state.plastic_work_to(&self.body, &self.response.points)
    }

    /// Elastic energy and energy of the contacts that the increment under way gives up; what grows counts as
    /// 0. What the change of a contact's area or penalty adds is not there to be given up.
    pub fn energy_released(&self) -> f64 {
        let Equilibrium { body, state, response, .. } = self;
        let elastic = state.points.elastic_energy(body) - response.points.elastic_energy(body);
        let pressed: f64 = response.pressed.iter().map(|point| point.energy).sum();
        let before = contact_sums(state.contact.iter(), body.symmetry).energy + state.ledger.self_contact;
        let after = contact_sums(response.contact.iter(), body.symmetry).energy + pressed;
        elastic.max(0.0) + (before - after).max(0.0)
    }

    /// Accepts the increment under way.
    ///
    /// # Errors
    /// See [`State::commit`].
    pub fn accept(&mut self) -> Result<(), Failure> {
        self.state.commit(&self.body, &self.trial, &mut self.response)
    }

    /// Sets whether tangents that are far from definite are stiffened, or fail.
    pub fn stiffen(&mut self, stiffens: bool) {
        self.stiffens = stiffens;
    }

    /// Answer of the force to the travel of the tool at the last assessed iterate.
    ///
    /// # Errors
    /// A stiffness that cannot be factorised.
    pub fn tool_stiffness(&mut self) -> Result<ToolStiffness, Failure> {
        self.renew()?;
        Ok(tool_stiffness(
            &self.body.analysis.dofs,
            self.state.edges.iter().zip(&self.response.contact),
            |rhs| self.factors.factor.solve_refined(&self.stiffness.matrix, rhs),
        ))
    }

    /// Factorises in double precision from now on. True where it did not before: an increment that failed may
    /// then be tried again.
    pub fn sharpen(&mut self) -> bool {
        let coarse = self.factors.factor.precision() == Precision::Single;
        if coarse {
            self.factors.factor.set_precision(Precision::Double);
            self.discard_factors();
        }
        coarse
    }

    /// Assembles the last assessed iterate once more, with the same contact.
    fn assemble_again(&mut self, tangent: Tangent) -> Result<(), Failure> {
        self.timed(tangent, |s| {
            s.body.assemble_again(&s.state, &s.trial, tangent, &mut s.response, &mut s.stiffness)
        })
    }

    /// Counts what `assemble` does for the `tangent`.
    fn timed(
        &mut self,
        tangent: Tangent,
        assemble: impl FnOnce(&mut Self) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let clock = Instant::now();
        self.has_tangent = tangent != Tangent::None;
        assemble(self)?;
        let seconds = clock.elapsed().as_secs_f64();
        let counters = &mut self.counters;
        counters.assemblies += usize::from(self.has_tangent);
        counters.residuals += usize::from(!self.has_tangent);
        counters.returns += self.response.returns;
        counters.assembly_s += seconds;
        counters.tangent_s += if self.has_tangent { seconds } else { 0.0 };
        Ok(())
    }

    /// Distance of the last assembled iterate from equilibrium.
    fn out_of_balance(&self, changed: bool) -> Assessment {
        let residual = norm(&self.response.residual);
        // forces of the fixed components and of the tool, and the largest load so far (the load itself goes
        // to 0)
        let mut reaction = 0.0;
        for (f, numbers) in self.response.internal.iter().zip(&self.body.analysis.dofs.number) {
            for i in 0..2 {
                if numbers[i] == FIXED {
                    reaction += f[i] * f[i];
                }
            }
        }
        for edge in &self.response.contact {
            reaction += edge.force.iter().flatten().map(|f| f * f).sum::<f64>();
        }
        let scale = reaction.sqrt().max(self.state.load_scale).max(f64::MIN_POSITIVE);
        Assessment { residual, scale, changed }
    }
}

impl System for Equilibrium<'_> {
    type Error = Failure;

    fn assess(&mut self, tangent: bool) -> Result<Assessment, Failure> {
        let tangent = if tangent { Tangent::Exact } else { Tangent::None };
        let touching = self.contact_set.next();
        self.timed(tangent, |s| {
            s.body.assemble(&s.state, &s.trial, tangent, touching, &mut s.response, &mut s.stiffness)
        })?;
        let changed = self.contact_set.note(&self.response.contact);
        let assessed = self.out_of_balance(changed);
        let is_far = assessed.residual > self.limited_at * assessed.scale;
        if !self.unlimited || self.contact_set.was_kept() || is_far {
            return Ok(assessed);
        }
        self.state.limit_extrapolation(&self.body, &mut self.trial, &self.response);
        self.response.forget_points();
        self.search.note_jump();
        self.unlimited = false;
        self.assemble_again(tangent)?;
        Ok(self.out_of_balance(changed))
    }

    fn renew(&mut self) -> Result<(), Failure> {
        if !self.has_tangent {
            self.assemble_again(Tangent::Exact)?;
        }
        self.factorise()
    }

    fn has_factors(&self) -> bool {
        self.factors.valid
    }

    fn factors_are_stale(&self) -> bool {
        self.factors.are_stale(self.yielding_points())
    }

    fn forget(&mut self) {
        self.factors.valid = false;
    }

    fn find_direction(&mut self) {
        let clock = Instant::now();
        let Factors { factor, correction, secants, .. } = &mut self.factors;
        let kept_contact = self.contact_set.was_kept();
        let (residual, displacement) = (&self.response.residual, &self.trial.displacement);
        self.search.find_direction(residual, displacement, kept_contact, secants, |rhs| {
            correction.solve(rhs, |rhs| factor.solve(rhs));
        });
        self.counters.solve_s += clock.elapsed().as_secs_f64();
    }

    fn slope(&self) -> f64 {
        self.search.slope(&self.response.residual)
    }

    fn advance(&mut self, fraction: f64) {
        if let Some(keep) = self.search.advance(fraction) {
            self.contact_set.set_keeping(keep);
        }
        let displacement = self.trial.displacement.iter_mut().enumerate();
        for ((node, du), numbers) in displacement.zip(&self.body.analysis.dofs.number) {
            for i in 0..2 {
                if numbers[i] != FIXED {
                    du[i] = self.search.displacement(node, i, numbers[i]);
                }
            }
        }
    }
}
