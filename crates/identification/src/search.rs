//! The search: from points all over the bounds, on what finite elements are expected to answer; then they are
//! asked at the best point, which changes what is expected, until the best point stays.

use super::branches::{FIRST_POINTS, allowed_minima, minima};
use super::emulator::{Emulator, features};
use super::experiment::Experiment;
use super::identifiability::{along_coordinate, deviations};
use super::objective::{Misfit, Objective, roughly};
use super::parameters::{Unknowns, far_apart, sobol_points};
use super::response::{DesignPoint, Response, respond};
use crate::levenberg_marquardt::{Minimum, ResidualFunction, Residuals, chi2, minimise};
use crate::profile_likelihood::Profile;
use asperity_material::range;
use asperity_simulation::scene::Accuracy;
use asperity_solver::body::analysis::Analyses;
use rayon::prelude::*;
use thiserror::Error;

/// The reason why a search found no metal.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SearchError {
    /// The observer ended it.
    #[error("the run was interrupted")]
    Interrupted,
    /// None within the bounds can be computed.
    #[error(
        "no metal within the bounds of [material] can be computed: youngs_modulus over yield_stress must be from {} to {:e}, and tables must not fall",
        range::MODULUS_OVER_YIELD[0],
        range::MODULUS_OVER_YIELD[1]
    )]
    NoMetal,
    /// The finite elements of an experiment have no answer where one is needed.
    #[error("{0}")]
    NoAnswer(String),
}

/// Most rounds of asking at the best point, and of asking at the level of the answer.
const ROUNDS: usize = 4;
const FINAL_ROUNDS: usize = 4;
/// Standard deviations of the best point within which it stays.
const SETTLED_DEVIATIONS: f64 = 0.25;
/// Relative error of a ball taken as a cone.
const BALL_AS_CONE_ERROR: f64 = 0.35;

/// Range below which a coordinate of an emulator counts as one value.
const SAME_COORDINATE: f64 = 1e-9;

/// Tells how far the search is, and whether it goes on.
pub type Observer<'a> = dyn FnMut(f64, &str) -> bool + 'a;

/// The best point and what is known around it.
#[derive(Clone, Debug)]
pub struct Found {
    /// The best point.
    pub minimum: Minimum,
    /// Runs of finite elements.
    pub runs: usize,
    /// Remarks on runs that stopped early.
    pub notes: Vec<String>,
}

/// Rounds of asking at the ends of a valley.
const VALLEY_ROUNDS: usize = 2;
/// Correlation with the nearest computed metal below which an end of a valley is asked.
const FAR_NEARNESS: f64 = 0.7;
/// Growth of ln det C of a measurement, by what its emulator does not know of a metal, below which nothing is
/// asked again: a twentieth of one standard deviation.
const TOLD_GROWTH: f64 = 0.1;
/// Other minima at which finite elements are asked as well.
const OTHER_MINIMA: usize = 2;

/// Searches; the emulators of the experiments learn on the way.
///
/// First touch and compliance that are sought are held at 0 at first and then set free from the metal found
/// there: so an unknown more never makes the best fit worse.
///
/// # Errors
/// No metal of the bounds that could be computed, or an observer that ended the search.
pub fn search(
    experiments: &mut [Experiment],
    unknowns: &Unknowns,
    accuracy: Accuracy,
    observer: &mut Observer<'_>,
) -> Result<Found, SearchError> {
    let mut found =
        Found { minimum: Minimum { point: Vec::new(), chi2: f64::INFINITY }, runs: 0, notes: Vec::new() };
    let analyses = &Analyses::for_threads(rayon::current_num_threads());
    let held = unknowns.without_nuisances();
    design(experiments, &held, analyses, &mut found, observer)?;
    let mut ask = Asking { accuracy, analyses, found };
    let mut best = everywhere(experiments, &held)?;
    ask.until_settled(experiments, &held, &mut best, [0.5, 0.9], observer)?;
    ask.other_minima(experiments, &held, &mut best, observer)?;
    if held.parameters != unknowns.parameters {
        let free = again(experiments, unknowns, &best.point)?;
        let other = everywhere(experiments, unknowns)?;
        best = if other.chi2 < free.chi2 - MUCH_LOWER { other } else { free };
        ask.until_settled(experiments, unknowns, &mut best, [0.9, 0.99], observer)?;
        ask.other_minima(experiments, unknowns, &mut best, observer)?;
    }
    ask.found.minimum = best;
    Ok(ask.found)
}

/// Sum of squares by which a minimum elsewhere must be lower than the one near by to be gone to.
const MUCH_LOWER: f64 = 0.1;

fn objective<'a>(
    experiments: &'a [Experiment],
    unknowns: &'a Unknowns,
    point: &[f64],
) -> Result<Objective<'a>, SearchError> {
    Objective::new(experiments, unknowns, point).ok_or(SearchError::NoMetal)
}

/// The asking of finite elements, and what came of it.
struct Asking<'a> {
    accuracy: Accuracy,
    analyses: &'a Analyses,
    found: Found,
}

impl Asking<'_> {
    fn ask_at(
        &mut self,
        experiments: &mut [Experiment],
        unknowns: &Unknowns,
        (points, needed): (&[Vec<f64>], bool),
        level: Accuracy,
    ) -> Result<(), SearchError> {
        // the atlas of sharp cones is as exact as `accuracy`, and coarser runs would only blur it; other
        // tools have coarse runs all about
        let finest = self.accuracy;
        let level = |e: &Experiment| if e.is_sharp() { finest } else { level };
        run_at(experiments, unknowns, (points, needed), level, self.analyses, &mut self.found)
    }

    /// Asks at `best`, which changes what is expected, until it stays. Tells of shares between `from` and
    /// `to`.
    fn until_settled(
        &mut self,
        experiments: &mut [Experiment],
        unknowns: &Unknowns,
        best: &mut Minimum,
        [from, to]: [f64; 2],
        observer: &mut Observer<'_>,
    ) -> Result<(), SearchError> {
        let share = |part: f64| from + part * (to - from);
        let mut asked = Vec::new();
        for round in 0..ROUNDS {
            go_on(observer, share(0.2 * round as f64), "asking finite elements at the best fit")?;
            self.ask_at(experiments, unknowns, (std::slice::from_ref(&best.point), true), Accuracy::Draft)?;
            asked.clone_from(&best.point);
            *best = again(experiments, unknowns, &asked)?;
            if moved(experiments, unknowns, &asked, &best.point) < SETTLED_DEVIATIONS {
                break;
            }
        }
        for _ in 0..VALLEY_ROUNDS {
            let ends = ends_of_the_valley(experiments, unknowns, best);
            if ends.is_empty() {
                break;
            }
            go_on(observer, share(0.8), "asking finite elements where the measurements see least")?;
            self.ask_at(experiments, unknowns, (&ends, false), Accuracy::Draft)?;
            *best = again(experiments, unknowns, &best.point)?;
        }
        let sharp = experiments.iter().all(Experiment::is_sharp);
        // the answer is that of finite elements at this point, or so near to it that they say the same
        let answered = sharp || self.accuracy == Accuracy::Draft;
        if answered && moved(experiments, unknowns, &asked, &best.point) < SETTLED_DEVIATIONS {
            return Ok(());
        }
        for _ in 0..FINAL_ROUNDS {
            go_on(observer, share(0.9), "the final answer")?;
            asked.clone_from(&best.point);
            self.ask_at(experiments, unknowns, (std::slice::from_ref(&asked), true), self.accuracy)?;
            // what a finer level says may lead to another valley
            *best = lowest_from(experiments, unknowns, &asked)?;
            if moved(experiments, unknowns, &asked, &best.point) < SETTLED_DEVIATIONS {
                break;
            }
        }
        Ok(())
    }

    /// Asks at other metals that the measurements allow; `best` goes to the one that fits better then.
    fn other_minima(
        &mut self,
        experiments: &mut [Experiment],
        unknowns: &Unknowns,
        best: &mut Minimum,
        observer: &mut Observer<'_>,
    ) -> Result<(), SearchError> {
        let found = objective(experiments, unknowns, &best.point)?.for_intervals();
        for other in allowed_minima(&found, unknowns, best).into_iter().take(OTHER_MINIMA) {
            go_on(observer, 0.99, "asking finite elements at another metal that fits")?;
            self.ask_at(experiments, unknowns, (std::slice::from_ref(&other.point), false), Accuracy::Draft)?;
            let there = again(experiments, unknowns, &other.point)?;
            *best = again(experiments, unknowns, &best.point)?;
            if there.chi2 < best.chi2 {
                *best = there;
            }
        }
        Ok(())
    }
}

fn go_on(observer: &mut Observer<'_>, share: f64, text: &str) -> Result<(), SearchError> {
    if observer(share, text) { Ok(()) } else { Err(SearchError::Interrupted) }
}

/// The lowest minimum from points all over the bounds.
fn everywhere(experiments: &[Experiment], unknowns: &Unknowns) -> Result<Minimum, SearchError> {
    let points = sobol_points(&unknowns.parameters, FIRST_POINTS);
    // covariances hang on the point weakly: those of the best rough point serve the first look
    let rough = roughly(experiments, unknowns, BALL_AS_CONE_ERROR);
    let first = least(&*rough, &points).ok_or(SearchError::NoMetal)?;
    minima(&objective(experiments, unknowns, &first)?, &points).into_iter().next().ok_or(SearchError::NoMetal)
}

fn least(residuals: &Residuals<'_>, points: &[Vec<f64>]) -> Option<Vec<f64>> {
    let ranked: Vec<(f64, &Vec<f64>)> = points.par_iter().map(|p| (chi2(residuals, p), p)).collect();
    let best = ranked.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
    best.0.is_finite().then(|| best.1.clone())
}

/// The minimum near `point` with what is expected now; twice, for the covariances move with it.
///
/// # Errors
/// No metal there that can be computed.
pub fn again(experiments: &[Experiment], unknowns: &Unknowns, point: &[f64]) -> Result<Minimum, SearchError> {
    let mut minimum = Minimum { point: point.to_vec(), chi2: f64::INFINITY };
    for _ in 0..2 {
        let objective = objective(experiments, unknowns, &minimum.point)?;
        minimum = minimise(&objective, &minimum.point, &objective.bounds());
    }
    Ok(minimum)
}

/// The lowest of the minima near `point` and elsewhere.
fn lowest_from(
    experiments: &[Experiment],
    unknowns: &Unknowns,
    point: &[f64],
) -> Result<Minimum, SearchError> {
    let near = again(experiments, unknowns, point)?;
    let points = sobol_points(&unknowns.parameters, FIRST_POINTS);
    let found = minima(&objective(experiments, unknowns, &near.point)?, &points);
    Ok(found.into_iter().find(|m| m.chi2 < near.chi2 - MUCH_LOWER).unwrap_or(near))
}

/// Distance between two points in standard deviations.
fn moved(experiments: &[Experiment], unknowns: &Unknowns, a: &[f64], b: &[f64]) -> f64 {
    let Some(objective) = Objective::new(experiments, unknowns, b) else { return f64::INFINITY };
    match (objective.residuals(a), objective.residuals(b)) {
        (Some(a), Some(b)) => a.iter().zip(&b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt(),
        _ => f64::INFINITY,
    }
}

/// The ends of the interval of the unknown of the metal that is seen least, where the computed metals tell
/// little: along a valley an end is none before finite elements were asked there.
fn ends_of_the_valley(experiments: &[Experiment], unknowns: &Unknowns, best: &Minimum) -> Vec<Vec<f64>> {
    let Some(objective) = Objective::new(experiments, unknowns, &best.point) else { return Vec::new() };
    let objective = objective.for_intervals();
    let Some(misfits) = objective.misfits(&best.point) else { return Vec::new() };
    let misfit = Misfit::sum(&misfits);
    if !misfit.fits(unknowns.parameters.len()) {
        // an interval of a model that is rejected says nothing
        return Vec::new();
    }
    let (deviations, correlation) = deviations(&objective, unknowns, &best.point);
    let share = |i: &usize| deviations[*i] / unknowns.parameters[*i].width();
    let metal = 0..unknowns.of_the_metal();
    let Some(i) = metal.max_by(|a, b| share(a).total_cmp(&share(b))) else { return Vec::new() };
    let bounds = objective.bounds();
    let profile = Profile { residuals: &objective, bounds: &bounds, lowest: misfit.chi2 };
    let along = along_coordinate(i, &deviations, &correlation);
    let ends = profile.ends_of_coordinate(std::slice::from_ref(best), i, deviations[i], &along);
    let is_far = |point: &Vec<f64>| {
        let of = |e: &Experiment| {
            !e.shifts_the_atlas()
                && nearness(e, unknowns, point) < FAR_NEARNESS
                && is_untold(e, unknowns, point)
        };
        experiments.iter().any(of)
    };
    ends.into_iter().map(|end| end.point).filter(is_far).collect()
}

/// Correlation of the metal at `point` with the computed one that is nearest to it.
fn nearness(e: &Experiment, unknowns: &Unknowns, point: &[f64]) -> f64 {
    e.design_point(unknowns, point).map_or(1.0, |question| e.emulator.nearness(&question))
}

/// True where finite elements would tell more of the metal at `point`: what the emulator does not know of it
/// widens the covariance.
fn is_untold(e: &Experiment, unknowns: &Unknowns, point: &[f64]) -> bool {
    let widens = || e.growth(unknowns, point).is_none_or(|growth| growth > TOLD_GROWTH);
    nearness(e, unknowns, point) == 0.0 || widens()
}

/// Asks the finite elements of every experiment at `points`, and the emulators learn the answers; no answer
/// at all is an error where it is `needed`.
fn run_at(
    experiments: &mut [Experiment],
    unknowns: &Unknowns,
    (points, needed): (&[Vec<f64>], bool),
    accuracy: impl Fn(&Experiment) -> Accuracy,
    analyses: &Analyses,
    found: &mut Found,
) -> Result<(), SearchError> {
    let levels: Vec<Accuracy> = experiments.iter().map(accuracy).collect();
    // what computed metals beside a point tell is not asked again, but for a finer level
    let open = |e: &Experiment, level: Accuracy, point: &[f64]| {
        if e.shifts_the_atlas() {
            // one shift belongs to one metal, the best
            return needed;
        }
        let finer = !e.is_sharp() && level != Accuracy::Draft;
        finer || is_untold(e, unknowns, point)
    };
    let at = |(i, e): (usize, &Experiment), p: &Vec<f64>| {
        open(e, levels[i], p).then(|| Some((i, e.design_point(unknowns, p)?))).flatten()
    };
    let questions: Vec<(usize, DesignPoint)> =
        experiments.iter().enumerate().flat_map(|of| points.iter().filter_map(move |p| at(of, p))).collect();
    let asked: Vec<bool> = (0..experiments.len()).map(|i| questions.iter().any(|(of, _)| *of == i)).collect();
    let answers = answered(&questions, &levels, analyses, found);
    let mut learned = vec![false; experiments.len()];
    for ((i, question), answer) in questions.iter().zip(answers) {
        let experiment = &mut experiments[*i];
        match answer {
            Ok(response) => {
                if response.reached < 0.98 {
                    found.notes.push(format!(
                        "{}: the finite elements reached {:.0} % of the depth, from which similarity gives the rest",
                        experiment.name,
                        100.0 * response.reached
                    ));
                }
                experiment.errors = response.errors;
                // what was asked of a body before was asked of the coarsest level
                let shifts =
                    experiment.shifts_the_atlas() || levels[*i] != Accuracy::Draft && !experiment.is_sharp();
                if !shifts {
                    experiment.emulator.add(question, &response);
                } else {
                    experiment.emulator.meet(question, &response);
                }
                learned[*i] = true;
            }
            Err(reason) => {
                found.notes.push(format!("{}: a run of finite elements {reason}", experiment.name))
            }
        }
    }
    let silent = learned.iter().zip(&asked).position(|(l, a)| *a && !l).filter(|_| needed);
    match silent {
        Some(i) => Err(SearchError::NoAnswer(format!(
            "{}: no answer of the finite elements near the best fit: {}",
            experiments[i].name,
            found.notes.last().cloned().unwrap_or_default()
        ))),
        None => Ok(()),
    }
}

/// The answers of finite elements to `questions`, each of an experiment whose level `levels` hold; those that
/// share a run are asked by one.
fn answered(
    questions: &[(usize, DesignPoint)],
    levels: &[Accuracy],
    analyses: &Analyses,
    found: &mut Found,
) -> Vec<Result<Response, String>> {
    let mut runs: Vec<Vec<usize>> = Vec::new();
    for (k, (of, question)) in questions.iter().enumerate() {
        let shared = |run: &&mut Vec<usize>| {
            let (other, asked) = &questions[run[0]];
            levels[*of] == levels[*other] && question.shares_the_run_of(asked)
        };
        match runs.iter_mut().find(shared) {
            Some(run) => run.push(k),
            None => runs.push(vec![k]),
        }
    }
    found.runs += runs.len();
    let of_a_run = |run: &Vec<usize>| {
        let together: Vec<&DesignPoint> = run.iter().map(|k| &questions[*k].1).collect();
        respond(&together, levels[questions[run[0]].0], analyses)
    };
    let answers: Vec<Vec<Result<Response, String>>> = runs.par_iter().with_max_len(1).map(of_a_run).collect();
    let mut placed: Vec<_> = runs.into_iter().flatten().zip(answers.into_iter().flatten()).collect();
    placed.sort_by_key(|(k, _)| *k);
    placed.into_iter().map(|(_, answer)| answer).collect()
}

/// Gives every tool that is no sharp cone runs at metals that may fit at all.
fn design(
    experiments: &mut [Experiment],
    unknowns: &Unknowns,
    analyses: &Analyses,
    found: &mut Found,
    observer: &mut Observer<'_>,
) -> Result<(), SearchError> {
    let bodies: Vec<usize> = (0..experiments.len()).filter(|&i| !experiments[i].is_sharp()).collect();
    if bodies.is_empty() {
        return Ok(());
    }
    let points = plausible(experiments, &bodies, unknowns)?;
    let levels = vec![Accuracy::Draft; experiments.len()];
    // curve and imprint of one test are asked together
    let tests: Vec<&[usize]> =
        bodies.chunk_by(|i, j| experiments[*i].curve == experiments[*j].curve).collect();
    for (k, test) in tests.iter().enumerate() {
        let share = 0.5 * k as f64 / tests.len() as f64;
        let name = experiments[test[0]].name.clone();
        go_on(observer, share, &format!("{name}: runs of finite elements over plausible metals"))?;
        let of = |i: usize| points.iter().map(move |p| (i, p));
        let questions: Vec<(usize, DesignPoint)> = test
            .iter()
            .flat_map(|&i| of(i))
            .filter_map(|(i, p)| Some((i, experiments[i].design_point(unknowns, p)?)))
            .collect();
        let answers = answered(&questions, &levels, analyses, found);
        let reason = answers.iter().find_map(|a| a.as_ref().err().cloned()).unwrap_or_default();
        for &i in *test {
            let own = questions.iter().zip(&answers).filter(|((of, _), _)| *of == i);
            let runs: Vec<(Vec<f64>, Response)> =
                own.filter_map(|((_, q), a)| Some((features(q), a.as_ref().ok()?.clone()))).collect();
            experiments[i].emulator = Emulator::fit(&runs, experiments[i].is_imprint()).ok_or_else(|| {
                SearchError::NoAnswer(format!(
                    "{}: too few runs of finite elements came to an end: {reason}",
                    experiments[i].name
                ))
            })?;
        }
    }
    Ok(())
}

/// Runs over plausible metals by the number of coordinates of the emulator in which these differ: enough for
/// a polynomial of the third degree in two of them, for one of the second in more.
const DESIGN_RUNS: [usize; 5] = [10, 12, 20, 32, 48];

/// Points far from each other among those that the rough look does not rule out: far in what the answers of
/// `bodies` depend on, and so many as that has coordinates.
fn plausible(
    experiments: &[Experiment],
    bodies: &[usize],
    unknowns: &Unknowns,
) -> Result<Vec<Vec<f64>>, SearchError> {
    let candidates = sobol_points(&unknowns.parameters, 8 * FIRST_POINTS);
    let rough = roughly(experiments, unknowns, BALL_AS_CONE_ERROR);
    let ranked: Vec<(f64, &Vec<f64>)> = candidates.par_iter().map(|p| (chi2(&*rough, p), p)).collect();
    let lowest = ranked.iter().map(|r| r.0).fold(f64::INFINITY, f64::min);
    if !lowest.is_finite() {
        return Err(SearchError::NoMetal);
    }
    let mut ranked: Vec<_> = ranked.into_iter().filter(|r| r.0.is_finite()).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let places_of = |p: &Vec<f64>| -> Option<Vec<Vec<f64>>> {
        bodies.iter().map(|&i| Some(features(&experiments[i].design_point(unknowns, p)?))).collect()
    };
    let placed: Vec<Option<Vec<Vec<f64>>>> = ranked.iter().map(|r| places_of(r.1)).collect();
    let coordinates = |body: usize| {
        let of = |k: usize| placed.iter().flatten().map(move |places| places[body][k]);
        let varies = |k: usize| of(k).fold(f64::NEG_INFINITY, f64::max) - of(k).fold(f64::INFINITY, f64::min);
        let count = placed.iter().flatten().next().map_or(0, |places| places[body].len());
        (0..count).filter(|&k| varies(k) > SAME_COORDINATE).count()
    };
    let varied = (0..bodies.len()).map(coordinates).max().unwrap_or(0);
    let wanted = DESIGN_RUNS[varied.min(DESIGN_RUNS.len() - 1)];
    let allowed =
        ranked.iter().take_while(|r| r.0 <= lowest + 12.0).count().max(4 * wanted).min(ranked.len());
    let open: Vec<(&Vec<f64>, Vec<f64>)> = ranked[..allowed]
        .iter()
        .zip(&placed)
        .filter_map(|(r, places)| Some((r.1, places.as_ref()?.concat())))
        .collect();
    let places: Vec<&[f64]> = open.iter().map(|(_, place)| place.as_slice()).collect();
    Ok(far_apart(&places, wanted).into_iter().map(|k| open[k].0.clone()).collect())
}
