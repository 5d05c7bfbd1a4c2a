//! Plastic flow of the points of an element from the converged state to a trial: as the trial has it, which
//! takes the elastic trial of the increment, and as backward Euler would have it.

use crate::body::assembly::Response;
use crate::body::discrete_body::Body;
use crate::body::elements::Motion;
use crate::body::failure::Failure;
use crate::body::state::{State, Trial};
use crate::element::kernel::{ElementContext, ElementOutput, POINTS, PointSlice};
use crate::point::bdf2::{PlasticIncrement, backward_euler, plastic_increment};
use crate::point::failure::Failure as PointFailure;
use crate::point::j2::Tangent;
use crate::point::kinematic_hardening::{self, History};
use crate::point::material::{Metal, PointState, plastic_work};
use crate::point::tensor::Sym;
use asperity_numerics::lanes::Lanes;
use pulp::{Simd, WithSimd};

/// Work space and results for one element after the other.
pub(super) struct Flows<'b, 'm> {
    body: &'b Body<'m>,
    elastic: Metal,
    output: ElementOutput,
    /// Plastic increment of each point.
    pub flow: [PlasticIncrement; POINTS],
    /// Its work per reference volume.
    pub work: [f64; POINTS],
}

impl<'b, 'm> Flows<'b, 'm> {
    pub fn new(body: &'b Body<'m>) -> Self {
        Flows {
            body,
            elastic: body.material.elastic_part(),
            output: ElementOutput::new(body.material.virgin()),
            flow: [PlasticIncrement::NONE; POINTS],
            work: [0.0; POINTS],
        }
    }

    /// Finds the flow of the points of `cell` from `state` to `trial`, of which `response` is the answer.
    ///
    /// # Errors
    /// A point whose elastic trial fails.
    pub fn find(
        &mut self,
        state: &State,
        trial: &Trial,
        response: &Response,
        cell: usize,
    ) -> Result<(), Failure> {
        let Flows { body, elastic, output, flow, work } = self;
        let Some(hardening) = &body.material.hardening else { return Ok(()) };
        let start = state.points.slice(body, cell);
        if start.history.is_empty() {
            let context = ElementContext { symmetry: body.symmetry, metal: elastic, tangent: Tangent::None };
            let motion = Motion { body, state, displacement: &trial.displacement, context };
            motion.evaluate(&start, cell, output)?;
        }
        let end = response.points.slice(body, cell);
        if let (Some(before), Some(after)) =
            (start.history.first_chunk(), end.history.first_chunk::<POINTS>())
        {
            let before: &[History; POINTS] = before;
            for i in 0..POINTS {
                let (old, new) = ((&start.states[i], &before[i]), (&end.states[i], &after[i]));
                (flow[i], work[i]) = kinematic_hardening::plastic_increment(&body.material, old, new);
            }
            return Ok(());
        }
        let [trial, old, new] = [&output.states[..], start.states, end.states].map(PointState::side_by_side);
        let found = body
            .arch
            .dispatch(Found { trial: trial.b_minus_i, old, new })
            .map_err(|cause| Failure::Element { cell, cause })?;
        for i in 0..POINTS {
            flow[i] = found.lane(i);
            work[i] = plastic_work(hardening, &start.states[i], &end.states[i]);
        }
        Ok(())
    }

    /// Plastic strain of backward Euler, from the converged states with the yield stress of the increment;
    /// after [`Flows::find`] of the same element.
    ///
    /// # Errors
    /// A point that cannot be updated.
    pub fn backward_euler(
        &mut self,
        state: &State,
        trial: &Trial,
        cell: usize,
    ) -> Result<[Sym; POINTS], Failure> {
        let Flows { body, output, .. } = self;
        let range = Body::points_of(cell);
        let states: [PointState; POINTS] = std::array::from_fn(|i| PointState {
            yield_scale: trial.start.states[range.start + i].yield_scale,
            ..state.points.states[range.start + i]
        });
        let mut euler = [[0.0; 4]; POINTS];
        if let Some(before) = state.points.history.get(range) {
            let context =
                ElementContext { symmetry: body.symmetry, metal: &body.material, tangent: Tangent::None };
            let start = PointSlice { states: &states, ..state.points.slice(body, cell) };
            let motion = Motion { body, state, displacement: &trial.displacement, context };
            motion.evaluate(&start, cell, output)?;
            for i in 0..POINTS {
                euler[i] = std::array::from_fn(|k| output.history[i].plastic[k] - before[i].plastic[k]);
            }
        } else {
            let [old, trial] = [&states, &output.states].map(|of| PointState::side_by_side(of));
            let found = body
                .arch
                .dispatch(Euler { metal: &body.material, old, trial: trial.b_minus_i })
                .map_err(|cause| Failure::Element { cell, cause })?;
            for (i, euler) in euler.iter_mut().enumerate() {
                *euler = found.map(|e| e.0[i]);
            }
        }
        Ok(euler)
    }
}

/// [`plastic_increment`] of the points of an element.
struct Found {
    trial: Sym<Lanes>,
    old: PointState<Lanes>,
    new: PointState<Lanes>,
}

impl WithSimd for Found {
    type Output = Result<PlasticIncrement<Lanes>, PointFailure>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        plastic_increment(&self.trial, &self.old, &self.new)
    }
}

/// [`backward_euler`] of the points of an element.
struct Euler<'a> {
    metal: &'a Metal,
    old: PointState<Lanes>,
    trial: Sym<Lanes>,
}

impl WithSimd for Euler<'_> {
    type Output = Result<Sym<Lanes>, PointFailure>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        backward_euler(self.metal, &self.old, &self.trial)
    }
}
