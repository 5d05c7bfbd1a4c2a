//! Assembly of a trial: internal forces, contact, out-of-balance forces, new point states, stiffness.

use crate::body::discrete_body::Body;
use crate::body::dofs::FIXED;
use crate::body::elements::{Buffers, Motion, Start, current};
use crate::body::failure::Failure;
use crate::body::state::{Points, State, Trial};
use crate::body::stiffness::Stiffness;
use crate::contact::edge::EdgeContact;
use crate::contact::parts::{NOTHING, Parts};
use crate::contact::self_contact::Pressed;
use crate::element::kernel::ElementContext;
use crate::point::j2::{Linearisation, Tangent};
use crate::point::material::Metal;
use asperity_numerics::lanes::Lanes;

/// The part of the surface that is taken to touch.
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
    /// True for each element that yields.
    pub yielding: Vec<bool>,
    /// Points returned to the yield surface.
    pub returns: usize,
    /// Contact of each edge; empty without a tool.
    pub contact: Vec<EdgeContact>,
    /// Contact of the surface with itself, point by point.
    pub pressed: Vec<Pressed>,
    /// Internal nodal forces: reactions where a component is fixed.
    pub internal: Vec<[f64; 2]>,
    /// Out-of-balance forces, by the numbers of the unknowns.
    pub residual: Vec<f64>,
    /// Response of the points of each element to the trial; empty where they have to be updated again.
    linearised: Vec<Linearisation<Lanes>>,
    buffers: Buffers,
}

impl Response {
    /// True for each point that yields, which started as in `trial`.
    pub fn yielding_points<'a>(&'a self, trial: &'a Trial) -> impl Iterator<Item = bool> + use<'a> {
        let started = &trial.start.states;
        self.points.states.iter().zip(started).map(|(new, start)| new.plastic_strain > start.plastic_strain)
    }

    /// Arrays for the responses of `body` from `state`.
    pub fn new(body: &Body<'_>, state: &State) -> Response {
        Response {
            points: state.points.clone(),
            yielding: vec![false; body.mesh.cell_count()],
            returns: 0,
            contact: Vec::with_capacity(state.edges.len()),
            pressed: Vec::new(),
            internal: vec![[0.0; 2]; body.mesh.nodes.len()],
            residual: vec![0.0; body.analysis.dofs.count],
            linearised: Vec::with_capacity(body.mesh.cell_count()),
            buffers: Buffers::new(body),
        }
    }

    /// Forgets the response of the points, which start elsewhere than they did.
    pub fn forget_points(&mut self) {
        self.linearised.clear();
    }
}

impl Body<'_> {
    /// Assembles `trial` from `state` into `response`, and the stiffness into `stiffness` if `tangent` is
    /// one.
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
        self.integrate_contact(state, trial, touching, state.parts(), None, response);
        self.balance(state, tangent, response, stiffness);
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
        if response.linearised.is_empty() {
            self.assemble_elements(&self.material, state, trial, tangent, response, stiffness)?;
        } else {
            self.assemble_tangent(state, trial, tangent, response, stiffness)?;
        }
        self.balance(state, tangent, response, stiffness);
        Ok(())
    }

    /// Assembles the stiffness of unloading: every point responds elastically, and the `kept` parts of the
    /// edges stay in contact, held by springs that are `stiffer` than the penalty; with friction they stick.
    ///
    /// # Errors
    /// An integration point that cannot be updated.
    pub fn assemble_elastic(
        &self,
        state: &State,
        trial: &Trial,
        (kept, stiffer): (&[Parts], f64),
        response: &mut Response,
        stiffness: &mut Stiffness,
    ) -> Result<(), Failure> {
        let elastic = self.material.elastic_part();
        self.assemble_elements(&elastic, state, trial, Tangent::Exact, response, stiffness)?;
        self.integrate_contact(state, trial, Touching::Kept, kept.iter().copied(), Some(stiffer), response);
        self.balance(state, Tangent::Exact, response, stiffness);
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
        let Response { points, yielding, returns, internal, linearised, buffers, .. } = response;
        linearised.clear();
        internal.fill([0.0; 2]);
        *returns = 0;
        let context = ElementContext { symmetry: self.symmetry, metal: material, tangent };
        let motion = Motion { body: self, state, displacement: &trial.displacement, context };
        let start = Start { points: &trial.start, updated: &[] };
        motion.evaluate_all(&start, buffers, |cell, output| {
            yielding[cell] = output.flowing > 0;
            *returns += output.flowing;
            let range = Body::points_of(cell);
            points.states[range.clone()].copy_from_slice(&output.states);
            if let Some(history) = points.history.get_mut(range) {
                history.copy_from_slice(&output.history);
            }
            linearised.extend(output.response);
            if tangent != Tangent::None {
                stiffness.add(cell, &output.stiffness);
            }
            for (a, &node) in self.mesh.cell(cell).iter().enumerate() {
                let f = &mut internal[node as usize];
                f[0] += output.force[0][a];
                f[1] += output.force[1][a];
            }
        })
    }

    /// Element loop over points that have been updated: stiffness.
    fn assemble_tangent(
        &self,
        state: &State,
        trial: &Trial,
        tangent: Tangent,
        response: &mut Response,
        stiffness: &mut Stiffness,
    ) -> Result<(), Failure> {
        stiffness.clear();
        let Response { linearised, buffers, returns, .. } = response;
        *returns = 0;
        let context = ElementContext { symmetry: self.symmetry, metal: &self.material, tangent };
        let motion = Motion { body: self, state, displacement: &trial.displacement, context };
        let start = Start { points: &trial.start, updated: linearised };
        motion.evaluate_all(&start, buffers, |cell, output| stiffness.add(cell, &output.stiffness))
    }

    /// Contact loop over the surface edges, of which the `kept` parts touch where they are not found anew.
    /// With `springs` over the penalty what touches sticks.
    fn integrate_contact(
        &self,
        state: &State,
        trial: &Trial,
        touching: Touching,
        kept: impl Iterator<Item = Parts>,
        springs: Option<f64>,
        response: &mut Response,
    ) {
        response.contact.clear();
        response.pressed.clear();
        if !state.facing.is_empty() {
            let x = |node| current(&state.position, &trial.displacement, node);
            response.pressed.extend(state.facing.press(&state.edges, trial.penalty, x));
        }
        let Some(contact) = self.contact.as_ref().filter(|_| trial.tip.is_finite()) else { return };
        let mut context = contact.context_from(trial.tip_before, trial.tip, trial.penalty, self.symmetry);
        context.spring = springs.unwrap_or(1.0) * trial.penalty;
        if let Some(rubbing) = &mut context.rubbing {
            rubbing.holds = springs.is_some();
        }
        for ((edge, kept), last) in state.edges.iter().zip(kept).zip(state.parts()) {
            let x = edge.nodes.map(|node| current(&state.position, &trial.displacement, node));
            response.contact.push(match touching {
                Touching::Found => edge.integrate(&context, edge.touching(&context, &x), &x),
                Touching::Kept => edge.integrate_widened(&context, kept, last, &x),
            });
        }
    }

    /// Makes the residual of the internal forces and the contact of `response`, and adds the contact to the
    /// stiffness if `tangent` is one.
    fn balance(&self, state: &State, tangent: Tangent, response: &mut Response, stiffness: &mut Stiffness) {
        let Response { contact, pressed, internal, residual, .. } = response;
        residual.fill(0.0);
        for (f, numbers) in internal.iter().zip(&self.analysis.dofs.number) {
            for i in 0..2 {
                if numbers[i] != FIXED {
                    residual[numbers[i] as usize] += f[i];
                }
            }
        }
        let stiffness = &mut Some(stiffness).filter(|_| tangent != Tangent::None);
        for (edge, share) in state.edges.iter().zip(contact).filter(|(_, s)| s.parts != NOTHING) {
            self.add_nodal(
                &edge.nodes[..edge.node_count()],
                &share.force,
                &share.stiffness,
                residual,
                stiffness,
            );
        }
        for share in pressed {
            self.add_nodal(&share.nodes[..share.count], &share.force, &share.stiffness, residual, stiffness);
        }
    }

    /// Adds the forces at `nodes`, and their derivatives where a stiffness is wanted.
    fn add_nodal<const N: usize>(
        &self,
        nodes: &[u32],
        force: &[[f64; 2]; N],
        derivative: &[[[[f64; 2]; N]; 2]; N],
        residual: &mut [f64],
        stiffness: &mut Option<&mut Stiffness>,
    ) {
        for (a, &node) in nodes.iter().enumerate() {
            let row = self.analysis.dofs.number[node as usize];
            for i in 0..2 {
                if row[i] != FIXED {
                    residual[row[i] as usize] += force[a][i];
                }
            }
            let Some(stiffness) = stiffness else { continue };
            for (b, &other) in nodes.iter().enumerate() {
                let col = self.analysis.dofs.number[other as usize];
                for i in 0..2 {
                    for j in 0..2 {
                        stiffness.add_entry(row[i], col[j], derivative[a][i][b][j]);
                    }
                }
            }
        }
    }
}
