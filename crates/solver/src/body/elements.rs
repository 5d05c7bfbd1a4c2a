//! The element loop: every element of a body evaluated, with the widest vector registers of the processor at
//! hand, on several threads where that pays. What the elements give is summed up in their order, so that the
//! bits depend on neither.

use crate::body::discrete_body::{Body, gather};
use crate::body::failure::Failure;
use crate::body::state::{Points, State};
use crate::element::kernel::{ENTRIES, ElementContext, ElementOutput, PointSlice};
use crate::element::{quad4, quad8};
use crate::point::j2::Linearisation;
use asperity_mesh::ElementKind;
use asperity_numerics::lanes::{Lanes, Real};
use pulp::{Simd, WithSimd};
use rayon::prelude::*;

/// Elements of one task.
const ELEMENTS_PER_TASK: usize = 48;

/// Elements that several threads evaluate while one sums up as many.
const ELEMENTS_PER_ROUND: usize = 384;

/// Elements from which several threads pay: for a thread of the pool, and for one outside, which sleeps until
/// a thread of the pool has woken it, round after round.
const ELEMENTS_WORTH_THREADS: [usize; 2] = [400, 4000];

/// Position of a node after the displacement from the converged state.
#[inline(always)]
pub(super) fn current(position: &[[f64; 2]], displacement: &[[f64; 2]], node: u32) -> [f64; 2] {
    let (x, du) = (position[node as usize], displacement[node as usize]);
    [x[0] + du[0], x[1] + du[1]]
}

/// Motion of the nodes in an increment, and the material.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<'a, 'm> {
    pub body: &'a Body<'m>,
    /// Node positions at the start of the increment.
    pub state: &'a State,
    /// Displacements of the nodes from there.
    pub displacement: &'a [[f64; 2]],
    pub context: ElementContext<'a>,
}

/// States of the points of all elements at the start of an increment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start<'a> {
    pub points: &'a Points,
    /// The response of the points of each element, if they have been updated by the same increment already;
    /// else nothing.
    pub updated: &'a [Linearisation<Lanes>],
}

/// Elements from `first` on, one for each output.
struct Evaluation<'a, 'm, F> {
    motion: &'a Motion<'a, 'm>,
    /// The points that an element starts from.
    start: F,
    first: usize,
    outputs: &'a mut [ElementOutput],
}

impl<'a, F: Fn(usize) -> PointSlice<'a>> WithSimd for Evaluation<'_, '_, F> {
    type Output = Result<(), Failure>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Result<(), Failure> {
        let Motion { body, state, displacement, context } = self.motion;
        let mut triangle = [Lanes::splat(0.0); ENTRIES];
        for (cell, output) in (self.first..).zip(self.outputs) {
            let nodes = body.mesh.cell(cell);
            let start = (self.start)(cell);
            match body.mesh.kind {
                ElementKind::Quad8 => {
                    let [x, du] = moved::<8>(&state.position, displacement, nodes);
                    quad8::evaluate(context, &body.points8, &x, &du, &start, &mut triangle, output)
                }
                ElementKind::Quad4 => {
                    let [x, du] = moved::<4>(&state.position, displacement, nodes);
                    quad4::evaluate(context, &body.points4, &x, &du, &start, &mut triangle, output)
                }
            }
            .map_err(|cause| Failure::Element { cell, cause })?;
        }
        Ok(())
    }
}

/// Current positions of the nodes of a cell, and their displacements.
#[inline(always)]
fn moved<const N: usize>(
    position: &[[f64; 2]],
    displacement: &[[f64; 2]],
    nodes: &[u32],
) -> [[[f64; 2]; N]; 2] {
    let mut x = [[0.0; 2]; N];
    for (x, &node) in x.iter_mut().zip(nodes) {
        *x = current(position, displacement, node);
    }
    [x, gather(displacement, nodes)]
}

impl Motion<'_, '_> {
    /// Evaluates the element `cell`, its points starting from `start`.
    ///
    /// # Errors
    /// An integration point that cannot be updated.
    pub fn evaluate(
        &self,
        start: &PointSlice<'_>,
        cell: usize,
        output: &mut ElementOutput,
    ) -> Result<(), Failure> {
        let outputs = std::slice::from_mut(output);
        self.body.arch.dispatch(Evaluation { motion: self, start: |_| *start, first: cell, outputs })
    }

    /// Evaluates the elements from `first` on, one for each of the `outputs`.
    fn evaluate_some(
        &self,
        start: &Start<'_>,
        first: usize,
        outputs: &mut [ElementOutput],
    ) -> Result<(), Failure> {
        let start =
            |cell| PointSlice { updated: start.updated.get(cell), ..start.points.slice(self.body, cell) };
        self.body.arch.dispatch(Evaluation { motion: self, start, first, outputs })
    }

    /// Evaluates all elements and hands each in its order to `take`. `buffers` are work space.
    ///
    /// # Errors
    /// The first element with an integration point that cannot be updated.
    pub fn evaluate_all(
        &self,
        start: &Start<'_>,
        buffers: &mut Buffers,
        mut take: impl FnMut(usize, &ElementOutput) + Send,
    ) -> Result<(), Failure> {
        let cells = self.body.mesh.cell_count();
        let outside = usize::from(rayon::current_thread_index().is_none());
        let threads = cells >= ELEMENTS_WORTH_THREADS[outside] && rayon::current_num_threads() > 1;
        let Buffers([now, before]) = buffers;
        if !threads {
            let outputs = &mut now[..ELEMENTS_PER_TASK];
            for first in (0..cells).step_by(ELEMENTS_PER_TASK) {
                let count = ELEMENTS_PER_TASK.min(cells - first);
                self.evaluate_some(start, first, &mut outputs[..count])?;
                (first..).zip(&outputs[..count]).for_each(|(cell, output)| take(cell, output));
            }
            return Ok(());
        }
        let mut evaluated = 0..0;
        for first in (0..cells).step_by(ELEMENTS_PER_ROUND) {
            let round = first..cells.min(first + ELEMENTS_PER_ROUND);
            let outputs = &mut now[..round.len()];
            let (_, outcome) = rayon::join(
                || evaluated.clone().zip(&*before).for_each(|(cell, output)| take(cell, output)),
                || {
                    let tasks = outputs.par_chunks_mut(ELEMENTS_PER_TASK).enumerate();
                    let outcomes = tasks.map(|(i, outputs)| {
                        self.evaluate_some(start, first + i * ELEMENTS_PER_TASK, outputs)
                    });
                    outcomes.reduce(|| Ok(()), Result::and)
                },
            );
            outcome?;
            std::mem::swap(now, before);
            evaluated = round;
        }
        evaluated.zip(&*before).for_each(|(cell, output)| take(cell, output));
        Ok(())
    }
}

/// Work space of the element loop.
#[derive(Clone, Debug)]
pub(super) struct Buffers([Vec<ElementOutput>; 2]);

impl Buffers {
    /// For the elements of `body`.
    pub fn new(body: &Body<'_>) -> Buffers {
        let length = if body.mesh.cell_count() < ELEMENTS_WORTH_THREADS[0] {
            [ELEMENTS_PER_TASK, 0]
        } else {
            [ELEMENTS_PER_ROUND; 2]
        };
        Buffers(length.map(|length| vec![ElementOutput::new(body.material.virgin()); length]))
    }
}
