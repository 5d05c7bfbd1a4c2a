//! Plastic flow of the points of an element from the converged state to a trial: as the trial has it, which takes the elastic trial of
//! the increment, and as backward Euler would have it.

use crate::body::assembly::{Response, evaluate_cell};
use crate::body::discrete_body::Body;
use crate::body::failure::Failure;
use crate::body::state::{State, Trial};
use crate::element::kernel::{ElementContext, ElementOutput, POINTS, PointSlice};
use crate::point::bdf2::{PlasticIncrement, backward_euler, plastic_increment};
use crate::point::j2::Tangent;
use crate::point::kinematic_hardening;
use crate::point::material::{Metal, PointState, plastic_work};
use crate::point::tensor::Sym;

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
            evaluate_cell(body, state, &trial.displacement, &start, cell, &context, output)?;
        }
        for (i, q) in Body::points_of(cell).enumerate() {
            let (old, new) = (&state.points.states[q], &response.points.states[q]);
            (flow[i], work[i]) = match (state.points.history.get(q), response.points.history.get(q)) {
                (Some(before), Some(after)) => {
                    kinematic_hardening::plastic_increment(&body.material, (old, before), (new, after))
                }
                _ => {
                    let flow = plastic_increment(&output.states[i].stretch, old, new)
                        .map_err(|cause| Failure::Element { cell, cause })?;
                    (flow, plastic_work(hardening, old, new))
                }
            };
        }
        Ok(())
    }

    /// Plastic strain of backward Euler, from the converged states with the yield stress of the increment; after [`Flows::find`] of
    /// the same element.
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
            evaluate_cell(body, state, &trial.displacement, &start, cell, &context, output)?;
            for i in 0..POINTS {
                euler[i] = std::array::from_fn(|k| output.history[i].plastic[k] - before[i].plastic[k]);
            }
        } else {
            for i in 0..POINTS {
                euler[i] = backward_euler(&body.material, &states[i], &output.states[i].stretch)
                    .map_err(|cause| Failure::Element { cell, cause })?;
            }
        }
        Ok(euler)
    }
}
