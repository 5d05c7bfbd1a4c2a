//! Claim: Newton converges quadratically: the observed order is at least 1.8, median over the increments of
//! the single asperity whose plastic set and touching edges rest in the last three iterations.
//!
//! Source: p = ln(r₃/r₂)/ln(r₂/r₁) of the last three residuals above 1e-12 of their scale, below which
//! rounding rules. 1.8 and not 2: the three residuals are not yet infinitesimal.

use asperity_numerics::newton::{Assessment, Settings, System, solve};
use asperity_simulation::scene::Accuracy;
use asperity_simulation::setup::schedule::{Spacing, loading};
use asperity_solver::body::analysis::Analyses;
use asperity_solver::body::failure::Failure;
use asperity_solver::contact::parts::{NOTHING, Parts};
use asperity_solver::equilibrium::Equilibrium;
use asperity_verification::single_asperity::{prepared, scene};

/// Residual over scale, flowing points and touching edges of an iterate.
type Iterate = (f64, Vec<bool>, Vec<[bool; 2]>);

/// A model that notes, at each assessed iterate, the residual and what is discrete.
struct Watched<'w, 'm> {
    model: &'w mut Equilibrium<'m>,
    seen: Vec<Iterate>,
}

impl System for Watched<'_, '_> {
    type Error = Failure;
    fn assess(&mut self, tangent: bool) -> Result<Assessment, Failure> {
        let assessment = self.model.assess(tangent)?;
        let touching = |parts: &Parts| parts.map(|p| p.is_some());
        self.seen.push((
            assessment.residual / assessment.scale,
            self.model.yielding_points().collect(),
            self.model.contacts().iter().map(|c| touching(&c.parts)).collect(),
        ));
        Ok(assessment)
    }
    fn renew(&mut self) -> Result<(), Failure> {
        self.model.renew()
    }
    fn has_factors(&self) -> bool {
        self.model.has_factors()
    }
    fn factors_are_stale(&self) -> bool {
        self.model.factors_are_stale()
    }
    fn forget(&mut self) {
        self.model.forget()
    }
    fn find_direction(&mut self) {
        self.model.find_direction()
    }
    fn slope(&self) -> f64 {
        self.model.slope()
    }
    fn advance(&mut self, fraction: f64) {
        self.model.advance(fraction)
    }
}

/// Order from the last three iterates above rounding, if the discrete sets rest in them.
fn order(seen: &[Iterate]) -> Option<f64> {
    let above = seen.iter().take_while(|s| s.0 > 1e-12).count();
    let last = &seen[above.checked_sub(3)?..above];
    let rests = last.iter().all(|s| s.1 == last[0].1 && s.2 == last[0].2);
    // a step of less than a decade is not yet convergence
    let converging = last[1].0 < 0.1 * last[0].0;
    (rests && converging).then(|| (last[2].0 / last[1].0).ln() / (last[1].0 / last[0].0).ln())
}

#[test]
fn quadratic_where_the_discrete_sets_rest() {
    let scene = scene(Accuracy::Draft).unwrap();
    let problem = prepared(&scene).unwrap();
    let mut model = problem.equilibrium(&Analyses::default()).unwrap();
    let settings = Settings { tolerance: 1e-13, max_iterations: 40, keep: 0.0 };
    let mut orders = Vec::new();
    let mut last = [0.0; 2];
    for share in loading(64, Spacing::Geometric { from: 0.02 }) {
        let travel = share * problem.depth;
        let step = travel - last[0];
        let ratio = if last[1] > 0.0 { step / last[1] } else { 0.0 };
        let before = model.state().displacement.clone();
        model.begin(-travel, ratio, |node| before[node].map(|u| 0.7 * ratio * u));
        let mut watched = Watched { model: &mut model, seen: Vec::new() };
        let _ = solve(&mut watched, &settings);
        orders.extend(order(&watched.seen));
        model.accept().unwrap();
        last = [travel, step];
    }
    assert!(model.contacts().iter().any(|c| c.parts != NOTHING));
    orders.sort_by(f64::total_cmp);
    assert!(orders.len() >= 10, "only {} increments rest", orders.len());
    let median = orders[orders.len() / 2];
    assert!(median >= 1.8, "{orders:?}");
}
