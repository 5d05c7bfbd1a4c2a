//! All that the measurements say at the best fit: numbers with their intervals, the stress-strain curve with
//! its band, the residual, the verdict.

use crate::accord::accords;
use crate::branches::{allowed_minima, branches};
use crate::experiment::{Data, Experiment};
use crate::identifiability::{
    Decided, NullDirection, along_coordinate, decided, deviations, identified, null_direction,
};
use crate::levenberg_marquardt::{Minimum, minimise};
use crate::next_experiment::{NextExperiment, next_experiment};
use crate::numbers::{Branch, CurveResidual, Found, Residual, StressAt};
use crate::objective::{Misfit, Objective};
use crate::parameters::{Parameter, Slot, Unknowns};
use crate::posterior;
use crate::profile_likelihood::{Interval, Profile};
use crate::verdict::verdict;
use indexmap::IndexMap;
use nalgebra::DVector;
use rayon::prelude::*;

/// All that is inferred.
#[derive(Clone, Debug)]
pub struct Inference {
    /// The unknowns, by their names.
    pub parameters: IndexMap<String, Found>,
    /// Their intervals, in their coordinates.
    pub intervals: Vec<Interval>,
    /// Correlations of the unknowns in their order, by the curvature at the best fit.
    pub correlation: Vec<Vec<f64>>,
    /// In words: what the measurements tell and what they do not.
    pub verdict: String,
    /// The direction in which they see least.
    pub blind_direction: Option<NullDirection>,
    /// The experiment that would narrow the widest interval most; none where everything is told.
    pub next_experiment: Option<NextExperiment>,
    /// Narrowing of the intervals by each of several measurements.
    pub decided: Vec<Decided>,
    /// The stress-strain curve.
    pub stress_strain: Vec<StressAt>,
    /// The stress that is determined best.
    pub representative: Option<StressAt>,
    /// The residual.
    pub residual: Residual,
    /// Samples of the posterior, in the units of the parameters.
    pub samples: Vec<Vec<f64>>,
}

/// Plastic strains of the stress-strain curve.
const STRAINS: [f64; 13] = [0.0, 0.002, 0.005, 0.01, 0.02, 0.033, 0.05, 0.066, 0.1, 0.15, 0.2, 0.25, 0.3];

/// Samples of the posterior that are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// Number of samples; 0: none.
    pub count: usize,
    /// Seed of their random numbers.
    pub seed: u64,
}

/// All that `experiments` say of `unknowns` at the `best` fit; `None` where there is no metal. While there
/// are `doubts` of the model nothing counts as determined.
pub fn infer(
    experiments: &[Experiment],
    unknowns: &Unknowns,
    best: &Minimum,
    doubts: &[String],
    sampling: Sampling,
) -> Option<Inference> {
    let objective = Objective::new(experiments, unknowns, &best.point)?.for_intervals();
    let best = &Minimum { chi2: objective.misfit(&best.point)?, ..best.clone() };
    let bounds = objective.bounds();
    let (deviations, correlation) = deviations(&objective, unknowns, &best.point);
    let others = allowed_minima(&objective, unknowns, best);
    let metals = branches(&objective, &bounds, best, &others);
    let all: Vec<Minimum> = std::iter::once(best).chain(&others).cloned().collect();
    let lowest = lowest_without_nuisances(&objective, unknowns, best);
    let profile = Profile { residuals: &objective, bounds: &bounds, lowest };
    let interval = |minima: &[Minimum], i: usize| {
        let along = along_coordinate(i, &deviations, &correlation);
        Interval::from_ends(&profile.ends_of_coordinate(minima, i, deviations[i], &along))
    };
    let intervals: Vec<Interval> = (0..bounds.len()).into_par_iter().map(|i| interval(&all, i)).collect();
    let branch = |minimum: &Minimum, i: usize| {
        let (p, ends) = (&unknowns.parameters[i], interval(std::slice::from_ref(minimum), i).ends);
        let [low, high] = ends.map(|x| p.shown(x));
        Branch { value: p.shown(minimum.point[i]), low, high, chi2: minimum.chi2 }
    };
    let branches_of = |i: usize| match &metals[..] {
        [_] => Vec::new(),
        several => several.iter().map(|metal| branch(metal, i)).collect(),
    };
    let residual = residual(&objective, experiments, unknowns, best)?;
    let identified = identified(&unknowns.parameters, &best.point, &intervals, &correlation);
    let trusted = residual.fits && doubts.is_empty();
    let parameters: IndexMap<String, Found> = unknowns
        .parameters
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let found = found(p, &intervals[i], best.point[i], trusted && identified[i]);
            (p.name.clone(), Found { branches: branches_of(i), ..found })
        })
        .collect();
    let stress_strain = band(&profile, unknowns, &all, &correlation, &deviations);
    let blind_direction = null_direction(&objective, unknowns, &best.point);
    let widest = widest(unknowns, &intervals, &identified);
    let next_experiment =
        widest.and_then(|of| next_experiment(&objective, experiments, unknowns, &best.point, of));
    let width = |s: &StressAt| (s.high_MPa / s.low_MPa).ln();
    let representative = stress_strain.iter().copied().min_by(|a, b| width(a).total_cmp(&width(b)));
    let samples =
        posterior::samples(&objective, &metals, &deviations, &bounds, sampling.count, sampling.seed);
    let shown = |point: &Vec<f64>| point.iter().zip(&unknowns.parameters).map(|(x, p)| p.shown(*x)).collect();
    let mut verdict = verdict(
        &parameters,
        representative.as_ref(),
        blind_direction.as_ref(),
        next_experiment.as_ref(),
        &residual,
        doubts,
    );
    if let Some(decides) = friction_decides(unknowns, &correlation, &identified) {
        verdict = format!("{verdict}; {decides}");
    }
    Some(Inference {
        parameters,
        intervals,
        correlation,
        verdict,
        blind_direction,
        next_experiment,
        decided: decided(&objective, experiments, unknowns, &best.point).unwrap_or_default(),
        stress_strain,
        representative,
        residual,
        samples: samples.iter().map(shown).collect(),
    })
}

/// Growth of the sum of squares by which measurements that know no first touch or compliance would need one
/// of them in 1 of 1,000 cases, for each that is sought.
const NEEDED_GROWTH: f64 = 10.828;

/// The sum of squares from which it grows to the end of an interval: while first touch and compliance may be
/// 0, that of the fit that holds them there. Growth from the lower sum with them free would take metals out
/// of an interval for no more than an unknown that was added.
fn lowest_without_nuisances(objective: &Objective<'_>, unknowns: &Unknowns, best: &Minimum) -> f64 {
    let held = unknowns.without_nuisances();
    if held.parameters == unknowns.parameters {
        return best.chi2;
    }
    let bounds: Vec<[f64; 2]> = held.parameters.iter().map(|p| p.bounds).collect();
    let without = minimise(objective, &best.point, &bounds).chi2;
    let freed = held.parameters.iter().zip(&unknowns.parameters).filter(|(h, u)| h != u).count();
    if without <= best.chi2 + freed as f64 * NEEDED_GROWTH { without.max(best.chi2) } else { best.chi2 }
}

/// Correlation of an unknown of the metal with friction from which friction decides it.
const DECIDED_BY_FRICTION: f64 = 0.8;

/// The sentence on unknowns of the metal that are open because friction is; `None` of none.
fn friction_decides(unknowns: &Unknowns, correlation: &[Vec<f64>], identified: &[bool]) -> Option<String> {
    let all = &unknowns.parameters;
    let frictions: Vec<usize> =
        (0..all.len()).filter(|&j| matches!(all[j].slot, Slot::Friction(_))).collect();
    let decided = |i: &usize| {
        !identified[*i] && frictions.iter().any(|&j| correlation[*i][j].abs() > DECIDED_BY_FRICTION)
    };
    let names: Vec<&str> =
        (0..unknowns.of_the_metal()).filter(decided).map(|i| all[i].name.as_str()).collect();
    (!names.is_empty()).then(|| format!("friction, not the metal, decides {}", names.join(", ")))
}

fn found(parameter: &Parameter, interval: &Interval, best: f64, identifiable: bool) -> Found {
    Found {
        value: parameter.shown(best),
        low: parameter.shown(interval.ends[0].min(best)),
        high: parameter.shown(interval.ends[1].max(best)),
        unit: parameter.unit,
        identifiable,
        at_bound: interval.bounded,
        branches: Vec::new(),
    }
}

/// The unknown of the metal with the widest interval among those that are not told.
fn widest(unknowns: &Unknowns, intervals: &[Interval], identified: &[bool]) -> Option<usize> {
    let size = |i: &usize| {
        let half = 0.5 * (intervals[*i].ends[1] - intervals[*i].ends[0]);
        let scale = if unknowns.parameters[*i].slot == Slot::HardeningExponent { 3.0 } else { 1.0 };
        half * scale
    };
    (0..unknowns.of_the_metal()).filter(|&i| !identified[i]).max_by(|a, b| size(a).total_cmp(&size(b)))
}

/// The stress-strain curve with its band.
fn band(
    profile: &Profile<'_>,
    unknowns: &Unknowns,
    minima: &[Minimum],
    correlation: &[Vec<f64>],
    deviations: &[f64],
) -> Vec<StressAt> {
    let bounds = profile.bounds;
    let at = |strain: &f64| {
        let best = minima.first()?;
        let number = |point: &[f64]| Some(unknowns.metal(point)?.stress_at(*strain).ln());
        let here = number(&best.point)?;
        let gradient = DVector::from_fn(bounds.len(), |i, _| {
            let mut moved = best.point.clone();
            let step = 1e-4 * (bounds[i][1] - bounds[i][0]);
            moved[i] += if moved[i] + step > bounds[i][1] { -step } else { step };
            number(&moved).map_or(0.0, |y| (y - here) / (moved[i] - best.point[i]))
        });
        let count = bounds.len();
        let variance: f64 = (0..count * count)
            .map(|k| (k / count, k % count))
            .map(|(i, j)| gradient[i] * gradient[j] * deviations[i] * deviations[j] * correlation[i][j])
            .sum();
        let interval = profile.of_number(minima, &number, variance.max(1e-8).sqrt())?;
        let [low_mpa, high_mpa] = interval.ends.map(|x| 1e-6 * x.exp());
        Some(StressAt {
            plastic_strain: *strain,
            value_MPa: 1e-6 * here.exp(),
            low_MPa: low_mpa,
            high_MPa: high_mpa,
        })
    };
    STRAINS.par_iter().filter_map(at).collect()
}

fn residual(
    objective: &Objective<'_>,
    experiments: &[Experiment],
    unknowns: &Unknowns,
    best: &Minimum,
) -> Option<Residual> {
    let misfits = objective.misfits(&best.point)?;
    let all = Misfit::sum(&misfits);
    let curves = experiments.iter().zip(&misfits).map(|(e, misfit)| {
        let differences = e.differences(unknowns, &best.point, false)?;
        let loading = match &e.data {
            Data::Curve(measured) => measured.loading.len(),
            Data::Features { .. } | Data::Imprint(_) | Data::ImprintNumbers(_) => differences.len(),
        };
        let square = differences[..loading].iter().map(|d| d * d).sum::<f64>() / loading.max(1) as f64;
        let noise = match &e.data {
            Data::Imprint(imprint) => imprint.deviation() / e.depth,
            _ => e.noise,
        };
        let (name, rms) = (e.name.clone(), square.sqrt());
        Some(CurveResidual { name, rms, noise, chi2: misfit.chi2, chi2_limit: misfit.limit(0) })
    });
    let curves = curves.collect::<Option<_>>()?;
    // a measurement that does not fit is not hidden by others that fit well
    let each = misfits.iter().all(|misfit| misfit.fits(0));
    let sought = unknowns.parameters.len();
    let accords = accords(experiments, unknowns, &best.point);
    Some(Residual {
        chi2: all.chi2,
        chi2_limit: all.limit(sought),
        fits: each && all.fits(sought) && accords.iter().all(|accord| accord.holds),
        degrees_of_freedom: all.count as i64 - sought as i64,
        curves,
        accords,
    })
}
