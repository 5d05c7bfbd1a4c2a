//! The mechanical system: a body of elements, held sides, and a rigid tool; one increment of it is what Newton solves.

use crate::algebra::assemble::Stiffness;
use crate::algebra::cholesky::Factor;
use crate::algebra::dofs::{Dofs, FIXED};
use crate::algebra::fill_ordering::elimination_order;
use crate::algebra::lbfgs::Secants;
use crate::algebra::newton::Failure;
use crate::contact::edge::{ContactContext, ContactEdge, EdgeContact, NOTHING, Parts};
use crate::contact::tool::Tool;
use crate::element::kernel::{ElementContext, ElementOutput, POINTS};
use crate::element::quad4;
use crate::element::quad8;
use crate::point::bdf2::{Flowed, carry_factor, carry_on, flow};
use crate::point::j2::Tangent;
use crate::point::kinematics::{ShapePoint, Symmetry, motion};
use crate::point::material::{Metal, PointState, volume_ratio};
use asperity_mesh::{ElementKind, Mesh};

mod back_stress;
mod contact_loop;
mod factorise;
mod system;
mod tool_stiffness;
mod view;

use back_stress::BackStress;
pub use tool_stiffness::ToolStiffness;

/// A tool in contact with the surface of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolContact {
    /// Its shape.
    pub tool: Tool,
    /// Pressure per penetration.
    pub penalty: f64,
}

impl ToolContact {
    /// The contact with the tool's tip at height `tip`.
    fn at(&self, tip: f64, symmetry: Symmetry) -> ContactContext<'_> {
        ContactContext { tool: &self.tool, tip, penalty: self.penalty, symmetry }
    }
}

/// Counters of the work done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counters {
    /// Element loops with tangent.
    pub assemblies: usize,
    /// Element loops without.
    pub residuals: usize,
    /// Factorisations.
    pub factorisations: usize,
    /// Seconds in element loops.
    pub assembly_s: f64,
    /// Seconds in factorisations.
    pub factor_s: f64,
    /// Seconds in triangular solves.
    pub solve_s: f64,
    /// Factorisations that lost a pivot.
    pub lost_pivots: usize,
    /// Points returned to the yield surface.
    pub returns: usize,
}

/// The body with its converged state and the increment under way. Lengths are the scene's own, stresses in units of E.
pub struct Model<'m> {
    mesh: &'m Mesh,
    symmetry: Symmetry,
    metal: Metal,
    dofs: Dofs,
    stiffness: Stiffness,
    factor: Factor,
    points8: [ShapePoint<8>; POINTS],
    points4: [ShapePoint<4>; POINTS],
    /// Reference volume of every integration point.
    volume: Vec<f64>,
    /// Weight of every integration point in the internal forces: its reference volume.
    weight: Vec<f64>,
    edges: Vec<ContactEdge>,
    contact: Option<ToolContact>,
    // converged state
    position: Vec<[f64; 2]>,
    old: Vec<PointState>,
    /// Flow of the last increment at every integration point; nothing is kept of elastic metal.
    flowed: Vec<Flowed>,
    back_stress: Option<BackStress>,
    parts: Vec<Parts>,
    /// Augmented Lagrange multipliers at the nodes.
    multiplier: Vec<f64>,
    trial_multiplier: Vec<f64>,
    accepted: Vec<[f64; 2]>,
    accepted_multiplier: Vec<f64>,
    accepted_tip: f64,
    accepted_flowing: Vec<bool>,
    // increment under way
    tip: f64,
    increment: Vec<[f64; 2]>,
    base: Vec<[f64; 2]>,
    start: Vec<PointState>,
    new: Vec<PointState>,
    flowing: Vec<bool>,
    touching: Vec<Parts>,
    edge_contact: Vec<EdgeContact>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    /// Residual where the direction was found, and the share of the direction that was gone since.
    residual_before: Vec<f64>,
    fraction: f64,
    secants: Secants,
    /// Whether the factors are of the tangent of some iterate of this body.
    has_factors: bool,
    /// Whether the stiffness is that of the last assessed iterate.
    has_tangent: bool,
    internal: Vec<[f64; 2]>,
    keep_contact: bool,
    /// Whether the last contact loop kept the contact, and whether the one did where the direction was found.
    kept_contact: bool,
    base_kept_contact: bool,
    load_scale: f64,
    /// What the contact energy has changed by because its area did, up to the start of the last accepted increment, and since.
    remeasured_energy: f64,
    next_remeasured: f64,
    /// Whether the increment under way has been accepted.
    settled: bool,
    stiffens: bool,
    output: ElementOutput,
    /// Work done so far.
    pub counters: Counters,
}

impl<'m> Model<'m> {
    /// A stress-free body whose displacement components named by `held(node)` are kept.
    ///
    /// Fails if an element is inside out in the mesh.
    pub fn new(
        mesh: &'m Mesh,
        symmetry: Symmetry,
        metal: Metal,
        held: impl Fn(usize) -> [bool; 2],
        contact: Option<ToolContact>,
    ) -> Result<Self, Failure> {
        let nodes = mesh.nodes.len();
        // nodes that no element uses have no stiffness and are held
        let mut used = vec![false; nodes];
        for &node in &mesh.cells {
            used[node as usize] = true;
        }
        let held = |node: usize| if used[node] { held(node) } else { [true, true] };
        let free: Vec<bool> = (0..nodes).map(|node| held(node) != [true, true]).collect();
        // numbered in the order of elimination, the matrix is never permuted again
        let order =
            elimination_order(&mesh.cells, mesh.kind.nodes(), &free).map_err(|_| Failure::Singular)?;
        let dofs = Dofs::new(nodes, &order, held);
        let stiffness = Stiffness::new(&mesh.cells, mesh.kind.nodes(), &dofs);
        let factor = Factor::new(&stiffness.matrix).map_err(|_| Failure::Singular)?;
        let count = mesh.cell_count() * POINTS;
        let (points8, points4) = (quad8::points(), quad4::points());
        let mut volume = Vec::with_capacity(count);
        for cell in 0..mesh.cell_count() {
            for q in 0..POINTS {
                let v = match mesh.kind {
                    ElementKind::Quad8 => motion(
                        &points8[q],
                        &gather::<8>(&mesh.nodes, mesh.cell(cell)),
                        &[[0.0; 2]; 8],
                        symmetry,
                    )
                    .map(|m| m.volume),
                    ElementKind::Quad4 => motion(
                        &points4[q],
                        &gather::<4>(&mesh.nodes, mesh.cell(cell)),
                        &[[0.0; 2]; 4],
                        symmetry,
                    )
                    .map(|m| m.volume),
                };
                volume.push(v.ok_or(Failure::Inverted)?);
            }
        }
        let edges: Vec<ContactEdge> = match contact {
            None => Vec::new(),
            Some(_) => mesh
                .sides
                .surface
                .iter()
                .map(|&edge| {
                    let (corners, middle) = mesh.edge_nodes(edge);
                    ContactEdge::new(corners, middle, |node| mesh.nodes[node as usize], symmetry)
                })
                .collect(),
        };
        let virgin = metal.virgin();
        let yields = metal.hardening.is_some();
        let back_stress = metal.has_back_stress().then(|| BackStress::new(count));
        let still = Flowed { strain: [0.0; 4], accumulated: 0.0 };
        Ok(Model {
            residual: vec![0.0; dofs.count],
            direction: vec![0.0; dofs.count],
            residual_before: vec![0.0; dofs.count],
            fraction: 0.0,
            secants: Secants::default(),
            has_factors: false,
            has_tangent: false,
            mesh,
            symmetry,
            metal,
            dofs,
            stiffness,
            factor,
            points8,
            points4,
            weight: volume.clone(),
            volume,
            parts: vec![NOTHING; edges.len()],
            touching: vec![NOTHING; edges.len()],
            edge_contact: Vec::with_capacity(edges.len()),
            edges,
            contact,
            position: mesh.nodes.clone(),
            old: vec![virgin; count],
            flowed: vec![still; if yields { count } else { 0 }],
            back_stress,
            multiplier: vec![0.0; nodes],
            trial_multiplier: vec![0.0; nodes],
            accepted_multiplier: vec![0.0; nodes],
            accepted_tip: f64::INFINITY,
            accepted_flowing: vec![false; mesh.cell_count()],
            accepted: vec![[0.0; 2]; nodes],
            tip: f64::INFINITY,
            increment: vec![[0.0; 2]; nodes],
            base: vec![[0.0; 2]; nodes],
            start: vec![virgin; count],
            new: vec![virgin; count],
            flowing: vec![false; mesh.cell_count()],
            internal: vec![[0.0; 2]; nodes],
            keep_contact: false,
            kept_contact: false,
            base_kept_contact: false,
            load_scale: 0.0,
            remeasured_energy: 0.0,
            next_remeasured: 0.0,
            settled: true,
            stiffens: true,
            output: ElementOutput::new(virgin),
            counters: Counters::default(),
        })
    }

    /// Starts an increment: the tool's lowest point at `tip`, prescribed components moved by `prescribed(node)`, the
    /// first guess of the displacement `guess` (zero if absent), and the last flow carried on as for a step
    /// `ratio` times the last one (0: not at all, as at the start of unloading). A tip at infinity removes the tool.
    pub fn begin(&mut self, tip: f64, ratio: f64, guess: impl Fn(usize) -> [f64; 2]) {
        self.settled = false;
        self.tip = tip;
        self.multiplier.clone_from(&self.accepted_multiplier);
        for (node, du) in self.increment.iter_mut().enumerate() {
            *du = guess(node);
        }
        let factor = carry_factor(ratio);
        if self.flowed.is_empty() {
            self.start.clone_from(&self.old);
        } else if !self.carry_back_stress_on(factor) {
            for ((start, old), flowed) in self.start.iter_mut().zip(&self.old).zip(&self.flowed) {
                *start = carry_on(&self.metal, old, flowed, factor);
            }
        }
        let free = tip == f64::INFINITY;
        self.keep_contact = !free && self.parts.iter().any(|p| *p != NOTHING);
        if free {
            self.touching.fill(NOTHING);
            self.multiplier.fill(0.0);
        } else {
            self.touching.clone_from(&self.parts);
        }
        // what follows is no step of the last increment
        self.fraction = 0.0;
    }

    /// Accepts the increment under way: the only place where the state of the body changes.
    pub fn accept(&mut self) -> Result<(), Failure> {
        let still = Flowed { strain: [0.0; 4], accumulated: 0.0 };
        let cells = if self.settle_back_stress() { 0 } else { self.flowing.len() };
        for cell in 0..cells {
            let points = cell * POINTS..(cell + 1) * POINTS;
            if !self.flowing[cell] {
                if let Some(flowed) = self.flowed.get_mut(points) {
                    flowed.fill(still);
                }
                continue;
            }
            // the elastic trial from the last converged state: what the increment would have been without flow
            let elastic = Metal { hardening: None, ..self.metal };
            let context = ElementContext {
                symmetry: self.symmetry,
                metal: &elastic,
                tangent: Tangent::None,
                memory: None,
            };
            self.start[points.clone()].copy_from_slice(&self.old[points.clone()]);
            evaluate_cell(self, cell, &context)?;
            for (i, q) in points.enumerate() {
                self.flowed[q] = still;
                if self.new[q].plastic_strain > self.old[q].plastic_strain {
                    let flowed =
                        flow(&self.output.states[i].stretch, &self.new[q]).ok_or(Failure::Inverted)?;
                    let plastic_strain = self.old[q].plastic_strain + flowed.accumulated;
                    self.new[q].plastic_strain = plastic_strain;
                    if let Some(hardening) = &self.metal.hardening {
                        self.new[q].yield_stress = hardening.flow(plastic_strain).yield_stress;
                    }
                    self.flowed[q] = flowed;
                }
            }
        }
        for (x, du) in self.position.iter_mut().zip(&self.increment) {
            x[0] += du[0];
            x[1] += du[1];
        }
        self.measure_contact_anew();
        self.settled = true;
        self.accepted.clone_from(&self.increment);
        self.accepted_multiplier.clone_from(&self.multiplier);
        self.accepted_tip = self.tip;
        self.accepted_flowing.clone_from(&self.flowing);
        self.old.clone_from(&self.new);
        self.parts.clone_from(&self.touching);
        self.load_scale = self.load_scale.max(self.load().abs());
        Ok(())
    }

    /// Goes back from an increment that was not accepted: tool, contact and flowing cells are those of the converged state
    /// again, for those who look at it.
    pub fn recall(&mut self) {
        if self.settled {
            return;
        }
        self.tip = self.accepted_tip;
        self.increment.fill([0.0; 2]);
        self.multiplier.clone_from(&self.accepted_multiplier);
        self.touching.clone_from(&self.parts);
        self.flowing.clone_from(&self.accepted_flowing);
        self.keep_contact = true;
        self.assemble_contact();
        self.settled = true;
    }

    /// Takes the stress of the law as Cauchy's instead of Kirchhoff's from here to the next call, with the
    /// volume change of the last converged state: what codes that read the yield stress so would find. Where metal is
    /// squeezed hard (steep indenters, E/σ_y below 100) that is a few percent of the force.
    pub fn weigh_by_current_volume(&mut self) {
        for (q, state) in self.old.iter().enumerate() {
            self.weight[q] = self.volume[q] * volume_ratio(&state.stretch);
        }
    }

    /// Element loop: internal forces and new states at the iterate, and its stiffness if `tangent` is one.
    fn assemble_elements(&mut self, tangent: Tangent) -> Result<(), Failure> {
        let clock = std::time::Instant::now();
        self.has_tangent = tangent != Tangent::None;
        if self.has_tangent {
            self.stiffness.clear();
        }
        self.residual.fill(0.0);
        self.internal.fill([0.0; 2]);
        let metal = self.metal.clone();
        let context = ElementContext { symmetry: self.symmetry, metal: &metal, tangent, memory: None };
        for cell in 0..self.mesh.cell_count() {
            evaluate_cell(self, cell, &context)?;
            self.flowing[cell] = self.output.flowing > 0;
            self.counters.returns += self.output.flowing;
            self.new[cell * POINTS..(cell + 1) * POINTS].copy_from_slice(&self.output.states);
            if let Some(back) = &mut self.back_stress {
                back.new[cell * POINTS..(cell + 1) * POINTS].copy_from_slice(&self.output.memory);
            }
            if self.has_tangent {
                self.stiffness.add(cell, &self.output.stiffness);
            }
            for (a, &node) in self.mesh.cell(cell).iter().enumerate() {
                let f = &mut self.internal[node as usize];
                f[0] += self.output.force[0][a];
                f[1] += self.output.force[1][a];
            }
        }
        for (f, numbers) in self.internal.iter().zip(&self.dofs.number) {
            for i in 0..2 {
                if numbers[i] != FIXED {
                    self.residual[numbers[i] as usize] += f[i];
                }
            }
        }
        self.counters.assemblies += usize::from(self.has_tangent);
        self.counters.residuals += usize::from(!self.has_tangent);
        self.counters.assembly_s += clock.elapsed().as_secs_f64();
        Ok(())
    }

    /// Assembles the iterate; returns whether the contact changed.
    fn assemble(&mut self, tangent: Tangent) -> Result<bool, Failure> {
        self.assemble_elements(tangent)?;
        let changed = self.assemble_contact();
        if self.has_tangent {
            self.add_contact_stiffness();
        }
        Ok(changed)
    }

    /// Assembles another tangent at the last assembled iterate, with the same contact.
    fn assemble_again(&mut self, tangent: Tangent) -> Result<(), Failure> {
        self.assemble_elements(tangent)?;
        self.add_contact_forces();
        self.add_contact_stiffness();
        Ok(())
    }
}

/// Current position of a node.
fn current(position: &[[f64; 2]], increment: &[[f64; 2]], node: u32) -> [f64; 2] {
    let (x, du) = (position[node as usize], increment[node as usize]);
    [x[0] + du[0], x[1] + du[1]]
}

/// The node values of a cell.
fn gather<const N: usize>(values: &[[f64; 2]], cell: &[u32]) -> [[f64; 2]; N] {
    std::array::from_fn(|a| values[cell[a] as usize])
}

/// Evaluates one cell at the iterate into `model.output`.
fn evaluate_cell(model: &mut Model<'_>, cell: usize, context: &ElementContext<'_>) -> Result<(), Failure> {
    let nodes = model.mesh.cell(cell);
    let points = cell * POINTS..(cell + 1) * POINTS;
    let (start, volume) = (&model.start[points.clone()], &model.weight[points.clone()]);
    let context =
        &ElementContext { memory: model.back_stress.as_ref().map(|b| &b.start[points]), ..*context };
    let outcome = match model.mesh.kind {
        ElementKind::Quad8 => {
            let x: [[f64; 2]; 8] =
                std::array::from_fn(|a| current(&model.position, &model.increment, nodes[a]));
            let du = gather::<8>(&model.increment, nodes);
            quad8::evaluate(context, &model.points8, &x, &du, start, volume, &mut model.output)
        }
        ElementKind::Quad4 => {
            let x: [[f64; 2]; 4] =
                std::array::from_fn(|a| current(&model.position, &model.increment, nodes[a]));
            let du = gather::<4>(&model.increment, nodes);
            quad4::evaluate(context, &model.points4, &x, &du, start, volume, &mut model.output)
        }
    };
    outcome.ok_or(Failure::Inverted)
}
