//! Shared by both quadrilaterals: the arrays they fill and the two kernels that fill them.

use crate::point::failure::Failure;
use crate::point::j2::{self, PointUpdate, Tangent};
use crate::point::kinematic_hardening::{self, History};
use crate::point::kinematics::Symmetry;
use crate::point::material::{Metal, PointState};
use crate::point::tensor::{Gradient, GradientForm, Sym};

/// Integration points of every element: 2 × 2.
pub const POINTS: usize = 4;

/// Gauss abscissa 1/√3.
pub const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Inputs of an element from the scene and the increment.
#[derive(Clone, Copy, Debug)]
pub struct ElementContext<'a> {
    /// Axisymmetric or plane strain.
    pub symmetry: Symmetry,
    /// The material.
    pub metal: &'a Metal,
    /// Which tangent is wanted.
    pub tangent: Tangent,
}

impl ElementContext<'_> {
    /// Updates point `q` of the element from its `start` by f - I = `increment`; its history variables go to `after`.
    ///
    /// # Errors
    /// A strain without a logarithm.
    #[inline]
    pub fn update(
        &self,
        q: usize,
        start: &PointSlice<'_>,
        increment: &Gradient,
        after: &mut [History; POINTS],
    ) -> Result<PointUpdate, Failure> {
        let (metal, state) = (self.metal, &start.states[q]);
        if !metal.has_back_stress() {
            return j2::update(metal, state, increment, self.tangent);
        }
        let (end, history) =
            kinematic_hardening::update(metal, state, &start.history[q], increment, self.tangent)?;
        after[q] = history;
        Ok(end)
    }
}

/// The points that an element starts from.
#[derive(Clone, Copy, Debug)]
pub struct PointSlice<'a> {
    /// Their states.
    pub states: &'a [PointState],
    /// Their history variables; empty for a material without back stress.
    pub history: &'a [History],
    /// Their weights: reference volumes.
    pub weight: &'a [f64],
}

/// Forces, stiffness and states of one element, with room for eight nodes.
#[derive(Clone, Debug)]
pub struct ElementOutput {
    /// Internal nodal forces f_r, f_z.
    pub force: [[f64; 8]; 2],
    /// ∂f_i,a/∂u_j,b as `stiffness[2b + j][i][a]`: the inner index runs over nodes so that it vectorises.
    pub stiffness: [[[f64; 8]; 2]; 16],
    /// States at the end of the increment.
    pub states: [PointState; POINTS],
    /// History variables then, for a material with a back stress.
    pub history: [History; POINTS],
    /// Number of points that yield.
    pub flowing: usize,
}

impl ElementOutput {
    /// An empty output; `state` fills the places of the point states.
    pub fn new(state: PointState) -> Self {
        ElementOutput {
            force: [[0.0; 8]; 2],
            stiffness: [[[0.0; 8]; 2]; 16],
            states: [state; POINTS],
            history: [History::default(); POINTS],
            flowing: 0,
        }
    }

    /// Zeroes what is summed up.
    pub fn clear(&mut self) {
        self.force = [[0.0; 8]; 2];
        self.stiffness = [[[0.0; 8]; 2]; 16];
        self.flowing = 0;
    }
}

/// Gradient operator rows of all nodes, node index innermost: ∂N/∂r, ∂N/∂z, N/r.
#[derive(Clone, Copy, Debug)]
pub struct Rows {
    /// ∂N_a/∂r.
    pub r: [f64; 8],
    /// ∂N_a/∂z.
    pub z: [f64; 8],
    /// N_a/r, or 0 in plane strain.
    pub hoop: [f64; 8],
}

impl Rows {
    /// Regroups the rows of `motion`; places beyond N stay zero.
    pub fn new<const N: usize>(rows: &[[f64; 3]; N]) -> Rows {
        let mut out = Rows { r: [0.0; 8], z: [0.0; 8], hoop: [0.0; 8] };
        for a in 0..N {
            [out.r[a], out.z[a], out.hoop[a]] = rows[a];
        }
        out
    }
}

/// f_a += w τ : ∇N_a.
#[inline]
pub fn add_force(force: &mut [[f64; 8]; 2], rows: &Rows, stress: &Sym, weight: f64) {
    let [rr, zz, tt, rz] = stress.map(|s| s * weight);
    for a in 0..8 {
        force[0][a] += rr * rows.r[a] + rz * rows.z[a] + tt * rows.hoop[a];
        force[1][a] += rz * rows.r[a] + zz * rows.z[a];
    }
}

/// K += w Gᵀ A G with G_a the gradient of a unit displacement of node a.
pub fn add_stiffness(
    stiffness: &mut [[[f64; 8]; 2]; 16],
    nodes: usize,
    rows: &Rows,
    form: &GradientForm,
    weight: f64,
) {
    for b in 0..nodes {
        let (d, e, h) = (weight * rows.r[b], weight * rows.z[b], weight * rows.hoop[b]);
        let mut t = [[0.0; 5]; 2]; // A G_b for a displacement of b along r, along z
        for i in 0..5 {
            t[0][i] = form[i][0] * d + form[i][1] * e + form[i][4] * h;
            t[1][i] = form[i][2] * d + form[i][3] * e;
        }
        for j in 0..2 {
            let column = &mut stiffness[2 * b + j];
            let t = &t[j];
            for a in 0..8 {
                column[0][a] += rows.r[a] * t[0] + rows.z[a] * t[1] + rows.hoop[a] * t[4];
                column[1][a] += rows.r[a] * t[2] + rows.z[a] * t[3];
            }
        }
    }
}
