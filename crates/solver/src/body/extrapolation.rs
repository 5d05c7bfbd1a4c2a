//! The start of an increment: the converged states of the integration points, with the last plastic increment
//! extrapolated.

use crate::body::assembly::Response;
use crate::body::discrete_body::Body;
use crate::body::flow::Flows;
use crate::body::state::{Points, State, Trial};
use crate::body::surface::Surface;
use crate::element::kernel::POINTS;
use crate::point::bdf2::{PlasticIncrement, bounded, extrapolate, extrapolation_factor, share};
use crate::point::kinematic_hardening;
use crate::point::material::{Metal, PointState, volume_ratio};
use asperity_numerics::lanes::Lanes;
use pulp::{Simd, WithSimd};

/// Ĵ is kept within this share of J: an increment that overturns the volume change of the last one is no
/// smooth path.
const LARGEST_VOLUME_CHANGE: f64 = 0.1;

impl State {
    /// Begins the trial with the tool's lowest point at `tip` (infinite: without a tool) and the first guess
    /// `guess` of the displacement, which fixed components keep. The last plastic increment and volume change
    /// are extrapolated as for a step `ratio` times the last one (0: not at all, as at the start of
    /// unloading).
    pub fn begin(
        &self,
        body: &Body<'_>,
        tip: f64,
        ratio: f64,
        guess: impl Fn(usize) -> [f64; 2],
        trial: &mut Trial,
    ) {
        trial.tip = tip;
        trial.tip_before = self.tip;
        if body.contact.as_ref().is_some_and(|contact| contact.friction.is_some())
            && self.tip == f64::INFINITY
        {
            trial.tip_before = -Surface::of_state(body, self).first_touch();
        }
        trial.displacement.iter_mut().enumerate().for_each(|(node, du)| *du = guess(node));
        trial.factor = extrapolation_factor(ratio);
        trial.start.clone_from(&self.points);
        for ((start, state), change) in
            trial.start.states.iter_mut().zip(&self.points.states).zip(&self.volume_change)
        {
            let now = volume_ratio(&state.b_minus_i);
            start.yield_scale = now
                + (bounded(ratio) * change).clamp(-LARGEST_VOLUME_CHANGE * now, LARGEST_VOLUME_CHANGE * now);
        }
        for (cell, last) in self.plastic.chunks_exact(POINTS).enumerate() {
            let flowed = std::array::from_fn(|i| last[i].times(trial.factor));
            self.extrapolate_cell(body, cell, &flowed, &mut trial.start);
        }
    }

    /// Takes back what the nearly converged `trial`, of which `response` is the answer, extrapolates beyond
    /// backward Euler (see `point::bdf2`), and freezes the rest.
    pub fn limit_extrapolation(&self, body: &Body<'_>, trial: &mut Trial, response: &Response) {
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
            let flowed = std::array::from_fn(|i| match &found {
                Ok(euler) => share(trial.factor, &last[i], &flows.flow[i], &euler[i]),
                Err(_) => PlasticIncrement::NONE,
            });
            self.extrapolate_cell(body, cell, &flowed, &mut trial.start);
        }
    }

    /// Starts the points of `cell` from the converged state with `flowed` added.
    fn extrapolate_cell(
        &self,
        body: &Body<'_>,
        cell: usize,
        flowed: &[PlasticIncrement; POINTS],
        start: &mut Points,
    ) {
        let range = Body::points_of(cell);
        let (old, new) = (&self.points.states[range.clone()], &mut start.states[range.clone()]);
        let Some(history) = self.points.history.get(range.clone()) else {
            let from = PointState::side_by_side(old);
            let flowed = PlasticIncrement::side_by_side(flowed);
            let end = body.arch.dispatch(Extrapolation { metal: &body.material, from, flowed });
            for (i, new) in new.iter_mut().enumerate() {
                *new = PointState { yield_scale: new.yield_scale, ..end.lane(i) };
            }
            return;
        };
        for (i, q) in range.enumerate() {
            let scale = new[i].yield_scale;
            (new[i], start.history[q]) =
                kinematic_hardening::extrapolate(&body.material, &old[i], &history[i], &flowed[i]);
            new[i].yield_scale = scale;
        }
    }
}

/// [`extrapolate`] of the points of an element. (A closure would not be inlined into code for the registers
/// at hand.)
struct Extrapolation<'a> {
    metal: &'a Metal,
    from: PointState<Lanes>,
    flowed: PlasticIncrement<Lanes>,
}

impl WithSimd for Extrapolation<'_> {
    type Output = PointState<Lanes>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> PointState<Lanes> {
        extrapolate(self.metal, &self.from, &self.flowed)
    }
}
