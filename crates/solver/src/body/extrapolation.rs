//! What the integration points of an increment start from: the converged states, with the last plastic increment extrapolated.

use crate::body::assembly::{Response, evaluate_cell};
use crate::body::discrete_body::Body;
use crate::body::failure::Failure;
use crate::body::state::{Points, State, Trial};
use crate::element::kernel::{ElementContext, ElementOutput, POINTS, PointSlice};
use crate::point::bdf2::{
    PlasticIncrement, backward_euler, bounded, extrapolate, extrapolation_factor, plastic_increment, share,
};
use crate::point::j2::Tangent;
use crate::point::kinematic_hardening;
use crate::point::material::{Metal, PointState, volume_ratio};
use crate::point::tensor::Sym;

/// Ĵ is kept within this share of J: an increment that overturns the volume change of the last one is no smooth path.
const LARGEST_CHANGE: f64 = 0.1;

impl State {
    /// Begins the trial with the tool's lowest point at `tip` (infinite: without a tool) and the first guess `guess` of the
    /// displacement, which fixed components keep. The last plastic increment and volume change are extrapolated as for a step
    /// `ratio` times the last one (0: not at all, as at the start of unloading).
    pub fn begin(
        &self,
        body: &Body<'_>,
        tip: f64,
        ratio: f64,
        guess: impl Fn(usize) -> [f64; 2],
        trial: &mut Trial,
    ) {
        self.begin_again(tip, guess, trial);
        trial.factor = extrapolation_factor(ratio);
        trial.start.clone_from(&self.points);
        for ((start, state), change) in
            trial.start.states.iter_mut().zip(&self.points.states).zip(&self.volume_change)
        {
            let now = volume_ratio(&state.stretch);
            start.yield_scale =
                now + (bounded(ratio) * change).clamp(-LARGEST_CHANGE * now, LARGEST_CHANGE * now);
        }
        for q in 0..self.plastic.len() {
            self.extrapolate_point(body, q, &self.plastic[q].times(trial.factor), &mut trial.start);
        }
    }

    /// Begins the trial once more, with another `tip` and `guess`: its points start as they did.
    pub fn begin_again(&self, tip: f64, guess: impl Fn(usize) -> [f64; 2], trial: &mut Trial) {
        trial.tip = tip;
        trial.multiplier.clone_from(&self.multiplier);
        if tip == f64::INFINITY {
            trial.multiplier.fill(0.0);
        }
        trial.displacement.iter_mut().enumerate().for_each(|(node, du)| *du = guess(node));
    }

    /// Takes back what the nearly converged `trial`, of which `response` is the answer, extrapolates beyond backward Euler (see
    /// `point::bdf2`), and freezes the rest.
    pub fn guard(&self, body: &Body<'_>, trial: &mut Trial, response: &Response) {
        let mut flows = Flows::new(body);
        for cell in 0..self.yielding.len() {
            let range = Body::points_of(cell);
            let last = self.plastic.get(range.clone()).unwrap_or_default();
            if last.iter().all(|flow| flow.accumulated == 0.0) {
                continue;
            }
            let found = flows.evaluate(self, trial, response, cell);
            for (i, q) in range.enumerate() {
                let flowed = match found {
                    Ok(()) => share(trial.factor, &self.plastic[q], &flows.flow[i], &flows.euler[i]),
                    Err(_) => PlasticIncrement::NONE,
                };
                self.extrapolate_point(body, q, &flowed, &mut trial.start);
            }
        }
    }

    fn extrapolate_point(&self, body: &Body<'_>, q: usize, flowed: &PlasticIncrement, start: &mut Points) {
        let scale = start.states[q].yield_scale;
        let state = &self.points.states[q];
        match self.points.history.get(q) {
            None => start.states[q] = extrapolate(&body.material, state, flowed),
            Some(history) => {
                (start.states[q], start.history[q]) =
                    kinematic_hardening::extrapolate(&body.material, state, history, flowed);
            }
        }
        start.states[q].yield_scale = scale;
    }
}

/// Plastic flow of the points of an element from the converged state, as a trial has it and as backward Euler would have it.
struct Flows<'b, 'm> {
    body: &'b Body<'m>,
    elastic: Metal,
    output: ElementOutput,
    flow: [PlasticIncrement; POINTS],
    euler: [Sym; POINTS],
}

impl<'b, 'm> Flows<'b, 'm> {
    fn new(body: &'b Body<'m>) -> Self {
        Flows {
            body,
            elastic: body.material.elastic_part(),
            output: ElementOutput::new(body.material.virgin()),
            flow: [PlasticIncrement::NONE; POINTS],
            euler: [[0.0; 4]; POINTS],
        }
    }

    fn evaluate(
        &mut self,
        state: &State,
        trial: &Trial,
        response: &Response,
        cell: usize,
    ) -> Result<(), Failure> {
        let Flows { body, elastic, output, flow, euler } = self;
        let fails = |cause| Failure::Element { cell, cause };
        let kinematic = body.material.has_back_stress();
        let metal = if kinematic { &body.material } else { elastic };
        let context = ElementContext { symmetry: body.symmetry, metal, tangent: Tangent::None };
        // backward Euler starts from the converged states, with the yield stress of the increment
        let range = Body::points_of(cell);
        let states: [PointState; POINTS] = std::array::from_fn(|i| PointState {
            yield_scale: trial.start.states[range.start + i].yield_scale,
            ..state.points.states[range.start + i]
        });
        let start = PointSlice { states: &states, ..state.points.slice(body, cell) };
        evaluate_cell(body, state, &trial.displacement, &start, cell, &context, output)?;
        for (i, q) in range.enumerate() {
            let (old, new, end) = (&states[i], &response.points.states[q], &output.states[i]);
            if kinematic {
                let (before, after) = (&state.points.history[q], &response.points.history[q]);
                flow[i] =
                    kinematic_hardening::plastic_increment(&body.material, (old, before), (new, after)).0;
                euler[i] = std::array::from_fn(|k| output.history[i].plastic[k] - before.plastic[k]);
            } else {
                flow[i] = plastic_increment(&end.stretch, old, new).map_err(fails)?;
                euler[i] = backward_euler(&body.material, old, &end.stretch).map_err(fails)?;
            }
        }
        Ok(())
    }
}
