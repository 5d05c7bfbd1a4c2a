//! Assembly of a trial: internal forces, contact, out-of-balance forces, new point states, stiffness.

use crate::algebra::assemble::Stiffness;
use crate::algebra::dofs::FIXED;
use crate::body::discrete_body::{Body, gather};
use crate::body::failure::Failure;
use crate::body::state::{Points, State, Trial};
use crate::contact::edge::{EdgeContact, NOTHING};
use crate::element::kernel::{ElementContext, ElementOutput, PointSlice};
use crate::element::{quad4, quad8};
use crate::point::j2::Tangent;
use crate::point::material::Metal;
use asperity_mesh::ElementKind;

/// Which part of the surface is taken to touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touching {
    /// That of the converged state, which may pull: the first iterate of an increment.
    Kept,
    /// That where the pressure is not negative.
    Found,
}

/// The body's answer to a trial. Its arrays are filled anew by each assembly.
#[derive(Clone, Debug)]
pub struct Response {
    /// Integration points at the end of the increment.
    pub points: Points,
    /// Whether each element yields.
    pub yielding: Vec<bool>,
    /// Points returned to the yield surface.
    pub returns: usize,
    /// Contact of each edge; empty without a tool.
    pub contact: Vec<EdgeContact>,
    /// Internal nodal forces: reactions where a component is fixed.
    pub internal: Vec<[f64; 2]>,
    /// Out-of-balance forces, by the numbers of the unknowns.
    pub residual: Vec<f64>,
    output: ElementOutput,
}

impl Response {
    /// Arrays for the responses of `body` from `state`.
    pub fn new(body: &Body<'_>, state: &State) -> Response {
        Response {
            points: state.points.clone(),
            yielding: vec![false; body.mesh.cell_count()],
            returns: 0,
            contact: Vec::with_capacity(state.edges.len()),
            internal: vec![[0.0; 2]; body.mesh.nodes.len()],
            residual: vec![0.0; body.dofs.count],
            output: ElementOutput::new(body.material.virgin()),
        }
    }

    /// Force on the tool along z, positive in compression.
    pub fn load(&self) -> f64 {
        self.contact.iter().map(|e| e.load).sum()
    }
}

impl Body<'_> {
    /// Assembles `trial` from `state` into `response`, and the stiffness into `stiffness` if `tangent` is one.
    ///
    /// # Errors
    /// An integration point that cannot be updated.
    pub fn assemble(
        &self,
        state: &State,
        trial: &Trial,
        tangent: Tangent,
        touching: Touching,
        response: &mut Response,
        stiffness: &mut Stiffness,
    ) -> Result<(), Failure> {
        self.assemble_elements(&self.material, state, trial, tangent, response, stiffness)?;
        self.integrate_contact(state, trial, touching, response);
        self.add_contact(state, tangent, response, stiffness);
        Ok(())
    }

    /// Assembles with the contact that `response` holds: another tangent of the same trial.
    ///
    /// # Errors
    /// An integration point that cannot be updated.
    pub fn assemble_again(
        &self,
        state: &State,
        trial: &Trial,
        tangent: Tangent,
        response: &mut Response,
        stiffness: &mut Stiffness,
    ) -> Result<(), Failure> {
        self.assemble_elements(&self.material, state, trial, tangent, response, stiffness)?;
        self.add_contact(state, tangent, response, stiffness);
        Ok(())
    }

    /// Assembles the stiffness of unloading: every point responds elastically, the contact of the converged state is kept.
    ///
    /// # Errors
    /// An integration point that cannot be updated.
    pub fn assemble_elastic(
        &self,
        state: &State,
        trial: &Trial,
        response: &mut Response,
        stiffness: &mut Stiffness,
    ) -> Result<(), Failure> {
        let elastic = self.material.elastic_part();
        self.assemble_elements(&elastic, state, trial, Tangent::Exact, response, stiffness)?;
        self.integrate_contact(state, trial, Touching::Kept, response);
        self.add_contact(state, Tangent::Exact, response, stiffness);
        Ok(())
    }

    /// Element loop: internal forces, new states, stiffness.
    fn assemble_elements(
        &self,
        material: &Metal,
        state: &State,
        trial: &Trial,
        tangent: Tangent,
        response: &mut Response,
        stiffness: &mut Stiffness,
    ) -> Result<(), Failure> {
        if tangent != Tangent::None {
            stiffness.clear();
        }
        let Response { points, yielding, returns, internal, residual, output, .. } = response;
        residual.fill(0.0);
        internal.fill([0.0; 2]);
        *returns = 0;
        let context = ElementContext { symmetry: self.symmetry, metal: material, tangent };
        for (cell, yields) in yielding.iter_mut().enumerate() {
            let start = trial.start.slice(self, cell);
            evaluate_cell(self, state, &trial.displacement, &start, cell, &context, output)?;
            *yields = output.flowing > 0;
            *returns += output.flowing;
            let range = Body::points_of(cell);
            points.states[range.clone()].copy_from_slice(&output.states);
            if let Some(history) = points.history.get_mut(range) {
                history.copy_from_slice(&output.history);
            }
            if tangent != Tangent::None {
                stiffness.add(cell, &output.stiffness);
            }
            for (a, &node) in self.mesh.cell(cell).iter().enumerate() {
                let f = &mut internal[node as usize];
                f[0] += output.force[0][a];
                f[1] += output.force[1][a];
            }
        }
        for (f, numbers) in internal.iter().zip(&self.dofs.number) {
            for i in 0..2 {
                if numbers[i] != FIXED {
                    residual[numbers[i] as usize] += f[i];
                }
            }
        }
        Ok(())
    }

    /// Contact loop over the surface edges.
    fn integrate_contact(&self, state: &State, trial: &Trial, touching: Touching, response: &mut Response) {
        response.contact.clear();
        let Some(contact) = self.contact.as_ref().filter(|_| trial.tip.is_finite()) else { return };
        let context = contact.at(trial.tip, trial.penalty, self.symmetry);
        for (edge, kept) in state.edges.iter().zip(state.parts()) {
            let x = edge.nodes.map(|node| current(&state.position, &trial.displacement, node));
            let multiplier = edge.nodes.map(|node| trial.multiplier[node as usize]);
            let parts = match touching {
                Touching::Kept => kept,
                Touching::Found => edge.touching(&context, &x, &multiplier),
            };
            response.contact.push(edge.integrate(&context, parts, &x, &multiplier));
        }
    }

    /// Adds the contact of `response` to its residual, and to the stiffness if `tangent` is one.
    fn add_contact(
        &self,
        state: &State,
        tangent: Tangent,
        response: &mut Response,
        stiffness: &mut Stiffness,
    ) {
        let Response { contact, residual, .. } = response;
        for (edge, share) in state.edges.iter().zip(contact).filter(|(_, s)| s.parts != NOTHING) {
            let nodes = &edge.nodes[..edge.node_count()];
            for (a, &node) in nodes.iter().enumerate() {
                let row = self.dofs.number[node as usize];
                for i in 0..2 {
                    if row[i] != FIXED {
                        residual[row[i] as usize] += share.force[a][i];
                    }
                }
                if tangent == Tangent::None {
                    continue;
                }
                for (b, &other) in nodes.iter().enumerate() {
                    let col = self.dofs.number[other as usize];
                    for i in 0..2 {
                        for j in 0..2 {
                            stiffness.add_entry(row[i], col[j], share.stiffness[a][i][b][j]);
                        }
                    }
                }
            }
        }
    }
}

/// Position of a node after the displacement from the converged state.
pub fn current(position: &[[f64; 2]], displacement: &[[f64; 2]], node: u32) -> [f64; 2] {
    let (x, du) = (position[node as usize], displacement[node as usize]);
    [x[0] + du[0], x[1] + du[1]]
}

/// Evaluates one element after `displacement`, its points starting from `start`.
pub fn evaluate_cell(
    body: &Body<'_>,
    state: &State,
    displacement: &[[f64; 2]],
    start: &PointSlice<'_>,
    cell: usize,
    context: &ElementContext<'_>,
    output: &mut ElementOutput,
) -> Result<(), Failure> {
    let nodes = body.mesh.cell(cell);
    let x = |a: usize| current(&state.position, displacement, nodes[a]);
    match body.mesh.kind {
        ElementKind::Quad8 => {
            let du = gather::<8>(displacement, nodes);
            let x = std::array::from_fn(x);
            quad8::evaluate(context, &body.points8, &x, &du, start, output)
        }
        ElementKind::Quad4 => {
            let du = gather::<4>(displacement, nodes);
            let x = std::array::from_fn(x);
            quad4::evaluate(context, &body.points4, &x, &du, start, output)
        }
    }
    .map_err(|cause| Failure::Element { cell, cause })
}
