//! The start of an increment: the converged states of the integration points, with the last plastic increment extrapolated.

use crate::body::assembly::Response;
use crate::body::discrete_body::Body;
use crate::body::flow::Flows;
use crate::body::state::{Points, State, Trial};
use crate::point::bdf2::{PlasticIncrement, bounded, extrapolate, extrapolation_factor, share};
use crate::point::kinematic_hardening;
use crate::point::material::volume_ratio;

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
            let found = flows
                .find(self, trial, response, cell)
                .and_then(|()| flows.backward_euler(self, trial, cell));
            for (i, q) in range.enumerate() {
                let flowed = match &found {
                    Ok(euler) => share(trial.factor, &self.plastic[q], &flows.flow[i], &euler[i]),
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
