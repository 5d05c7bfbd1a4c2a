//! The unloading exponent of a sweep, from a few of its cones.

use crate::case::Case;
use crate::collapse::distinct;
use crate::cone::unloading_exponent;
use crate::fit::DEVELOPED_PLASTICITY;
use crate::sweep::Sweep;
use asperity_simulation::scene::Accuracy;
use asperity_solver::body::analysis::Analyses;
use rayon::prelude::*;

/// A cone that was unloaded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unloaded {
    /// The cone.
    pub case: Case,
    /// m of F = F_j (1 - u/u_j)^m.
    pub exponent: f64,
}

/// Unloads the gentlest, the middle and the steepest cone of the sweep, of its middle stiffness over yield
/// stress, with its smallest and its largest hardening exponent, as far as plasticity is developed at ε_r =
/// `c` tan β: a nearly elastic cone goes back with the exponent 2. Those that do not come to an end are left
/// out.
pub fn unload(sweep: &Sweep, c: f64) -> Vec<Unloaded> {
    let mut cases = sweep.cases();
    if cases.is_empty() {
        return Vec::new();
    }
    let ratio = |c: &Case| c.yielding.map_or(f64::INFINITY, |y| y.e_over_sy);
    let exponent = |c: &Case| c.yielding.map_or(0.0, |y| y.exponent);
    let sorted = |value: &dyn Fn(&Case) -> f64| distinct(cases.iter().map(value));
    let middle = |values: &[f64]| values[values.len() / 2];
    let (ratios, exponents, slopes) = (sorted(&ratio), sorted(&exponent), sorted(&|c| c.beta_deg));
    let ends = |values: &[f64]| [values[0], values[values.len() - 1]];
    let (at, between) = (middle(&ratios), middle(&slopes));
    cases.retain(|c| {
        ratio(c) == at
            && ends(&exponents).contains(&exponent(c))
            && (ends(&slopes).contains(&c.beta_deg) || c.beta_deg == between)
    });
    cases.dedup();
    cases.retain(|case| {
        let t = case.tan_beta();
        let stress = case.hardening().map_or(f64::INFINITY, |h| h.representative_stress(c * t));
        case.elastic().reduced_modulus() * t / stress >= DEVELOPED_PLASTICITY
    });
    let analyses = Analyses::for_threads(rayon::current_num_threads());
    let solve = |case: &Case| {
        let exponent = unloading_exponent(case, &case.discretisation(Accuracy::Standard), &analyses).ok()?;
        Some(Unloaded { case: *case, exponent })
    };
    cases.par_iter().filter_map(solve).collect()
}

/// Their mean exponent; `None` without any.
pub fn mean(unloaded: &[Unloaded]) -> Option<f64> {
    let count = unloaded.len() as f64;
    (count > 0.0).then(|| unloaded.iter().map(|u| u.exponent).sum::<f64>() / count)
}
