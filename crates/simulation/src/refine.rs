//! A run that is refined until it keeps the promise of its accuracy.
//!
//! A round is a run with its companion. What it states is compared with what the accuracy promises; where it
//! is more, the next round has finer numbers, as many times as the order asks for by which the stated errors
//! fall: 3/2 of the force and 1 of the area at first (`error_estimate`), and then the order that two rounds
//! have shown. Where the area alone is stated with more, the steps stay: it does not hang on them. Where all
//! numbers are just twice as fine, the round before is the companion of the next one.
//! Work is counted in operations, never in seconds, so that the bits are those of every machine.

use crate::record::outcome::{Event, Outcome, Watcher};
use crate::record::rows::Summary;
use crate::run::{CrushError, Run};
use crate::scene::Scene;
use crate::setup::discretisation::Discretisation;

/// Rounds at most.
const MOST_ROUNDS: usize = 3;

/// Work of all rounds at most, over that of the first.
const MOST_WORK_RATIO: f64 = 12.0;

/// Orders by which stated errors of force and area are expected to fall.
const EXPECTED_ORDERS: [f64; 2] = [1.5, 1.0];

/// Range of an order that two rounds show: chance may make it anything.
const ORDERS: [f64; 2] = [0.5, 2.0];

/// Power of the fineness with which the work grows: 2 of the elements, and 1 of the steps where they are
/// finer too.
const WORK_EXPONENT: [f64; 2] = [2.0, 3.0];

/// Work of a companion over that of its run.
const COMPANION_WORK: f64 = 0.2;

/// Factors of fineness from one round to the next: less is no new round, more than twice goes by two rounds.
const FACTORS: [f64; 2] = [1.15, 2.0];

/// Factor from which the round is made twice as fine, so that the round before is its companion.
const NEARLY_TWICE: f64 = 1.7;

/// Margin over the refinement that is just enough: the stated error of a finer run scatters.
const MARGIN: f64 = 1.2;

/// Smallest error of the area that an accuracy promises.
const FINEST_AREA_PROMISE: f64 = 0.005;

impl Scene {
    /// Errors that `summary` states, and promises, of the force (along the curve, of several contacts at the
    /// peak) and of the area (at the peak): each as [stated, promised]; stated NaN where it is not known.
    pub fn stated_and_promised(&self, summary: &Summary) -> [[f64; 2]; 2] {
        let promise = self.accuracy.promise();
        let force = if self.asperity_count() > 1 { summary.errors.force } else { summary.errors_along.force };
        [[force, promise], [summary.errors.contact_area, promise.max(FINEST_AREA_PROMISE)]]
    }

    /// True where a run of it may be made again with finer numbers: the user gave neither the elements nor a
    /// mesh, nor asked for one run.
    pub fn may_refine(&self) -> bool {
        self.numerics.refine != Some(false)
            && self.numerics.elements_in_contact.is_none()
            && self.mesh.is_none()
    }
}

/// The stated errors of force and area over what is promised; infinite where none is stated.
fn misses(scene: &Scene, outcome: &Outcome) -> [f64; 2] {
    scene
        .stated_and_promised(&outcome.summary)
        .map(|[stated, promised]| if stated.is_nan() { f64::INFINITY } else { stated / promised })
}

/// Work of a run whose stated errors are just the promised ones, over that of one which states `over` times
/// as much of force and area.
pub fn work_to_keep(over: [f64; 2]) -> f64 {
    Finer::wanted(over, EXPECTED_ORDERS).work()
}

fn largest(misses: [f64; 2]) -> f64 {
    misses[0].max(misses[1])
}

/// The numbers of a round over those of the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Finer {
    /// Factor of elements, penalty and substrate.
    factor: f64,
    /// True where the steps are as many times as short.
    steps: bool,
}

impl Finer {
    /// The numbers that the next round wants after these `misses`, with the orders by which errors fall.
    fn wanted(misses: [f64; 2], orders: [f64; 2]) -> Finer {
        let finer = |i: usize| (MARGIN * misses[i]).powf(orders[i].recip());
        let factor = finer(0).max(finer(1));
        // an infinite miss of the area leaves the force unknown too
        let steps = misses[0] > 1.0 || !factor.is_finite();
        Finer { factor: if factor.is_finite() { factor } else { FACTORS[1] }, steps }
    }

    /// Work over that of the round before, without companions.
    fn work(self) -> f64 {
        self.factor.powf(self.exponent())
    }

    fn exponent(self) -> f64 {
        WORK_EXPONENT[usize::from(self.steps)]
    }

    /// True where the round before is its companion: all numbers are twice as good.
    fn is_double(self) -> bool {
        self.factor == FACTORS[1] && self.steps
    }

    /// The numbers that come of it after rounds that took `spent` times the work of the first, the last of
    /// them `before` times that; `None` where the work that is left brings nothing.
    fn affordable(self, before: f64, spent: f64) -> Option<Finer> {
        let factor = if self.factor > NEARLY_TWICE { FACTORS[1] } else { self.factor.max(FACTORS[0]) };
        let wanted = Finer { factor, ..self };
        let companion = if wanted.is_double() { 0.0 } else { COMPANION_WORK };
        let left = MOST_WORK_RATIO - spent;
        if before * wanted.work() * (1.0 + companion) / (1.0 + COMPANION_WORK) <= left {
            return Some(wanted);
        }
        let factor = (left / before).powf(self.exponent().recip());
        (factor >= FACTORS[0]).then_some(Finer { factor: factor.min(NEARLY_TWICE), ..self })
    }
}

/// The orders that two rounds show, the second `factor` times as fine.
fn observed(before: [f64; 2], after: [f64; 2], factor: f64) -> [f64; 2] {
    std::array::from_fn(|i| {
        let order = (before[i] / after[i]).ln() / factor.ln();
        if order.is_finite() { order.clamp(ORDERS[0], ORDERS[1]) } else { EXPECTED_ORDERS[i] }
    })
}

impl Run<'_> {
    /// [`Run::run`], and where it does not keep the promise of its accuracy further rounds with finer
    /// numbers, three at most and with twelve times the work of the first. Rows, fields and errors are those
    /// of the best round, iterations those of all; `summary.promise_kept` and `summary.rounds` tell how it
    /// went. The observer hears of each round by [`Event::Round`]; where it ends a later one, what the round
    /// before gave is the outcome. Numbers that the scene gives stay, as do meshes.
    ///
    /// # Errors
    /// As for [`Run::run`].
    pub fn run_refined(self, observer: &mut Watcher<'_>) -> Result<Outcome, CrushError> {
        self.refined(observer).map(|(outcome, _)| outcome)
    }

    /// [`Run::run_refined`], and the work of all rounds that came to their end over that of the first.
    fn refined(self, observer: &mut Watcher<'_>) -> Result<(Outcome, f64), CrushError> {
        let scene = self.scene;
        let run = self.begin()?;
        let first = run.round(Discretisation::new(scene), None, observer)?;
        let (mut best, mut before, mut work, mut rounds) = (first.outcome, first.main, first.work, 1);
        // the work of the last round, as it was expected
        let (mut miss, mut orders, mut expected) = (misses(scene, &best), EXPECTED_ORDERS, 1.0);
        let (mut least, mut iterations) = (largest(miss), best.summary.newton_iterations);
        let refines = scene.may_refine() && best.stopped.is_none();
        while refines && least > 1.0 && rounds < MOST_ROUNDS {
            let wanted = Finer::wanted(miss, orders);
            let Some(finer) = wanted.affordable(expected, work / first.work) else { break };
            if observer(&Event::Round(rounds + 1)).is_break() {
                break;
            }
            let numbers = before.numbers.finer(finer.factor, finer.steps, &scene.numerics);
            let coarser = finer.is_double().then_some(&before);
            let mut interrupted = false;
            let told = &mut |event: &Event<'_>| {
                let told = observer(event);
                interrupted |= told.is_break();
                told
            };
            let Ok(found) = run.round(numbers, coarser, told) else { break };
            if interrupted {
                break;
            }
            rounds += 1;
            work += found.work;
            iterations += found.outcome.summary.newton_iterations;
            if found.outcome.stopped.is_some() {
                break;
            }
            let now = misses(scene, &found.outcome);
            orders = observed(miss, now, finer.factor);
            (expected, miss, before) = (expected * finer.work(), now, found.main);
            if largest(now) < least {
                (least, best) = (largest(now), Outcome { round: rounds, ..found.outcome });
            }
        }
        best.summary.newton_iterations = iterations;
        best.summary.rounds = rounds;
        best.summary.promise_kept = best.stopped.is_none().then_some(least <= 1.0);
        Ok((best, work / first.work))
    }
}

#[cfg(test)]
mod tests {
    //! Claims: a run whose first round states more than its accuracy promises goes on with finer numbers
    //! until it keeps the promise, in three rounds and at most twelve times the first one's work, with the
    //! same bits on any number of threads; what the user gave stays, and an interrupt keeps the last round
    //! that came to its end. Source: [`Run::run_refined`] says so. Tolerance: none.
    use super::*;
    use crate::scene::{Accuracy, Asperity, Loading, Material, MeshFile, Symmetry, Tool};
    use asperity_material::units::{Length, Stress};
    use asperity_mesh::Mesh;
    use std::ops::ControlFlow;

    const TWICE: Finer = Finer { factor: 2.0, steps: true };

    #[test]
    fn a_miss_of_the_area_by_a_third_asks_for_a_third_more_and_double_goes_by_the_round_before() {
        let next = |misses| Finer::wanted(misses, EXPECTED_ORDERS).affordable(1.0, 1.0).unwrap();
        let finer = next([0.5, 1.3]);
        assert!((finer.factor - 1.3 * MARGIN).abs() < 1e-12 && !finer.steps && !finer.is_double());
        assert_eq!(next([4.0, 1.0]), TWICE);
        assert_eq!(next([f64::INFINITY; 2]), TWICE);
        assert_eq!(next([0.9, 4.0]), Finer { steps: false, ..TWICE });
    }

    #[test]
    fn work_is_bounded() {
        assert_eq!(TWICE.affordable(1.0, 11.5), None);
        // a second doubling would cost 64 times the first round
        assert_eq!(TWICE.affordable(8.0, 8.0), None);
        for steps in [true, false] {
            let finer = Finer { steps, ..TWICE };
            let cut = finer.affordable(1.0, MOST_WORK_RATIO - 0.6 * finer.work()).unwrap();
            assert!(cut.factor > 1.5 && cut.factor <= NEARLY_TWICE && cut.steps == steps, "{cut:?}");
        }
    }

    #[test]
    fn orders_are_those_that_two_rounds_show() {
        let [force, area] = observed([4.0, 3.0], [1.0, 3.2], 2.0);
        assert_eq!([force, area], [2.0, ORDERS[0]]);
        assert_eq!(observed([f64::INFINITY; 2], [1.0; 2], 2.0), EXPECTED_ORDERS);
    }

    /// Sharp cone of steel of 300 MPa on a half space at `draft`: slope in degrees, exponent, depth in µm.
    fn crushed([slope, exponent, depth]: [f64; 3]) -> Scene {
        let steel = Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), exponent);
        let loading = Loading::to_depth(Length(depth * 1e-6));
        let mut scene = Scene::new(Symmetry::Axisymmetric, steel, Tool::plane(), loading)
            .with(Asperity::cone(Length(20e-6), slope))
            .with_accuracy(Accuracy::Draft);
        scene.output.every = Some(0);
        scene
    }

    /// Perfectly plastic: the first round states 1.5 times the area's promise.
    const MISSES: [f64; 3] = [10.0, 0.0, 5.0];

    fn go_on(_: &Event<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// The scene so refined: its outcome and the work of all rounds over that of the first.
    fn refined(scene: &Scene) -> (Outcome, f64) {
        Run::new(scene).refined(&mut go_on).unwrap()
    }

    /// Of one round.
    fn single(scene: &Scene) -> Outcome {
        let outcome = Run::new(scene).run(&mut go_on).unwrap();
        assert_eq!((outcome.summary.promise_kept, outcome.summary.rounds), (None, 1));
        outcome
    }

    /// Twice as fine, by the round before, and by less, with a companion of its own.
    #[test]
    fn a_run_that_misses_its_promise_goes_on_until_it_keeps_it() {
        for (numbers, by_the_round_before) in [(MISSES, true), ([20.0, 0.05, 2.0], false)] {
            let scene = crushed(numbers);
            let first = single(&scene);
            assert!(largest(misses(&scene, &first)) > 1.0, "{numbers:?}");
            let (outcome, work) = refined(&scene);
            let summary = &outcome.summary;
            assert!((2..=MOST_ROUNDS).contains(&summary.rounds), "{numbers:?}: {} rounds", summary.rounds);
            assert_eq!((outcome.round, summary.promise_kept), (summary.rounds, Some(true)), "{numbers:?}");
            assert!(largest(misses(&scene, &outcome)) <= 1.0, "{numbers:?}");
            assert!(work > 2.0 && work <= MOST_WORK_RATIO, "{numbers:?}: {work} times the work of the first");
            assert!(summary.newton_iterations > first.summary.newton_iterations);
            let elements = outcome.numbers.elements_in_contact;
            assert_eq!(elements == 2 * first.numbers.elements_in_contact, by_the_round_before, "{elements}");
        }
    }

    /// Eight steps lose more force than any mesh gives back: a round of more elements comes out worse.
    #[test]
    fn a_promise_that_is_out_of_reach_leaves_the_best_round() {
        let mut scene = crushed(MISSES);
        scene.numerics.steps = Some(8);
        let (outcome, work) = refined(&scene);
        let summary = &outcome.summary;
        assert_eq!((summary.promise_kept, outcome.numbers.steps), (Some(false), 8));
        assert!((2..=MOST_ROUNDS).contains(&summary.rounds) && work <= MOST_WORK_RATIO, "{work}");
        let first = single(&scene);
        assert_eq!((outcome.round, &outcome.rows), (1, &first.rows));
        assert!(summary.newton_iterations > first.summary.newton_iterations);
    }

    #[test]
    fn a_refined_run_has_the_same_bits_on_one_and_two_threads() {
        let scene = crushed(MISSES);
        let bits = [1, 2].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let text = format!("{:#?}", pool.install(|| refined(&scene)));
            // but for the seconds
            text.lines().filter(|line| !line.contains("_s: ")).collect::<Vec<_>>().join("\n")
        });
        assert!(bits[0].contains("rounds: 2"));
        assert!(bits[0] == bits[1]);
    }

    #[test]
    fn numbers_and_meshes_that_are_given_stay() {
        let scene = crushed(MISSES);
        let once = |change: &dyn Fn(&mut Scene), mesh: Option<Mesh>| {
            let mut scene = scene.clone();
            change(&mut scene);
            let run = Run { mesh, ..Run::new(&scene) };
            let (outcome, work) = run.refined(&mut go_on).unwrap();
            assert_eq!((outcome.summary.rounds, work), (1, 1.0));
            // one round says too whether it keeps the promise
            let kept = largest(misses(&scene, &outcome)) <= 1.0;
            assert_eq!(outcome.summary.promise_kept, Some(kept));
            outcome
        };
        let given = once(&|s| s.numerics.elements_in_contact = Some(10), None);
        assert_eq!((given.numbers.elements_in_contact, given.summary.promise_kept), (10, Some(false)));
        let told = once(&|s| s.numerics.refine = Some(false), None);
        assert_eq!(told.summary.promise_kept, Some(false));
        let problem = Run::new(&scene).problem().unwrap();
        let cells = problem.mesh.cell_count();
        let mesh = problem.mesh.scaled(problem.units.length);
        let file = MeshFile { file: "cone.msh".into(), unit: None };
        let imported = once(&|s| s.mesh = Some(file.clone()), Some(mesh));
        assert_eq!(imported.summary.elements, cells);
    }

    /// On the way of the second round, or before it begins.
    #[test]
    fn an_interrupt_in_a_later_round_keeps_the_one_before() {
        let scene = crushed(MISSES);
        let first = single(&scene);
        for increments in [0, 5] {
            let mut left = None;
            let outcome = Run::new(&scene).run_refined(&mut |event| {
                match event {
                    Event::Round(round) => {
                        assert_eq!((*round, left), (2, None));
                        left = Some(increments);
                    }
                    Event::Increment { .. } => left = left.map(|count: usize| count.saturating_sub(1)),
                    Event::Fields(_) => {}
                }
                if left == Some(0) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            let outcome = outcome.unwrap();
            assert_eq!(left, Some(0));
            assert_eq!((outcome.stopped, outcome.round, outcome.summary.rounds), (None, 1, 1));
            assert_eq!((outcome.summary.promise_kept, outcome.rows), (Some(false), first.rows.clone()));
        }
    }
}
