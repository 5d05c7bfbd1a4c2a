//! Shared by both quadrilaterals: the arrays they fill and the two kernels that fill them.

use crate::point::failure::Failure;
use crate::point::j2::{self, Linearisation, PointUpdate, Tangent};
use crate::point::kinematic_hardening::{self, History};
use crate::point::kinematics::Symmetry;
use crate::point::material::{Metal, PointState};
use crate::point::tensor::{Gradient, GradientForm, Sym};
use asperity_law::real::{Lanes, Mask, Real};

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
    /// Stress and tangent of the points of the element, updated from their `start` by f - I = `increment`; what they are then goes to
    /// `out`. Points that have been updated by this increment already only give the tangent that is wanted now.
    ///
    /// # Errors
    /// A strain without a logarithm.
    #[inline(always)]
    pub fn update(
        &self,
        start: &PointSlice<'_>,
        increment: &Gradient<Lanes>,
        out: &mut ElementOutput,
    ) -> Result<(Sym<Lanes>, GradientForm<Lanes>), Failure> {
        if self.metal.has_back_stress() {
            let end = self.update_by_point(start, increment, &mut out.history)?;
            out.note(&end.state, end.plastic);
            return Ok((end.stress, end.tangent));
        }
        let response = match start.updated {
            Some(updated) => *updated,
            None => {
                let end =
                    j2::return_to_yield(self.metal, &PointState::side_by_side(start.states), increment)?;
                out.note(&end.state, end.plastic);
                out.response = Some(end.response);
                end.response
            }
        };
        Ok((response.stress(), response.tangent(self.metal, self.tangent)))
    }

    /// The points one after the other: kinematic hardening.
    #[inline(never)]
    fn update_by_point(
        &self,
        start: &PointSlice<'_>,
        increment: &Gradient<Lanes>,
        after: &mut [History; POINTS],
    ) -> Result<PointUpdate<Lanes>, Failure> {
        let update = |q: usize| {
            let increment = increment.map(|g| g.0[q]);
            let (state, history) = (&start.states[q], &start.history[q]);
            kinematic_hardening::update(self.metal, state, history, &increment, self.tangent)
        };
        let ends = [update(0)?, update(1)?, update(2)?, update(3)?];
        *after = ends.map(|(_, history)| history);
        Ok(PointUpdate {
            state: PointState::side_by_side(&ends.map(|(end, _)| end.state)),
            stress: std::array::from_fn(|i| Lanes::each(|q| ends[q].0.stress[i])),
            plastic: Lanes::mask(|q| ends[q].0.plastic),
            tangent: std::array::from_fn(|i| {
                std::array::from_fn(|j| Lanes::each(|q| ends[q].0.tangent[i][j]))
            }),
        })
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
    /// Their response, if they have been updated by the same increment already.
    pub updated: Option<&'a Linearisation<Lanes>>,
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
    /// Their response; `None` for a material with a back stress.
    pub response: Option<Linearisation<Lanes>>,
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
            response: None,
        }
    }

    /// Takes the states at the end of the increment.
    #[inline(always)]
    fn note(&mut self, state: &PointState<Lanes>, plastic: Mask) {
        for q in 0..POINTS {
            self.states[q] = state.lane(q);
        }
        self.flowing = (0..POINTS).filter(|q| Lanes::holds(plastic, *q)).count();
    }

    /// Zeroes what is summed up for `tangent`.
    pub fn clear(&mut self, tangent: Tangent) {
        self.force = [[0.0; 8]; 2];
        if tangent != Tangent::None {
            self.stiffness = [[[0.0; 8]; 2]; 16];
        }
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
    /// Regroups the rows of the point in lane `q` of a motion; places beyond N stay zero.
    #[inline(always)]
    pub fn new<T: Real, const N: usize>(rows: &[[T; 3]; N], q: usize) -> Rows {
        let mut out = Rows { r: [0.0; 8], z: [0.0; 8], hoop: [0.0; 8] };
        for a in 0..N {
            let [r, z, hoop] = &rows[a];
            (out.r[a], out.z[a], out.hoop[a]) = (r.lane(q), z.lane(q), hoop.lane(q));
        }
        out
    }
}

/// The stress and the tangent of the point `q`.
#[inline(always)]
pub fn response_of(
    (stresses, tangents): &(Sym<Lanes>, GradientForm<Lanes>),
    q: usize,
) -> (Sym, GradientForm) {
    let (mut stress, mut form) = ([0.0; 4], [[0.0; 5]; 5]);
    for i in 0..4 {
        stress[i] = stresses[i].0[q];
    }
    for i in 0..5 {
        for j in 0..5 {
            form[i][j] = tangents[i][j].0[q];
        }
    }
    (stress, form)
}

/// f_a += w τ : ∇N_a.
#[inline(always)]
pub fn add_force(force: &mut [[f64; 8]; 2], rows: &Rows, stress: &Sym, weight: f64) {
    let [rr, zz, tt, rz] = stress.map(|s| s * weight);
    for a in 0..8 {
        force[0][a] += rr * rows.r[a] + rz * rows.z[a] + tt * rows.hoop[a];
        force[1][a] += rz * rows.r[a] + zz * rows.z[a];
    }
}

/// K += w Gᵀ A G with G_a the gradient of a unit displacement of node a: the entries of node b with the nodes of its half of the
/// element and beyond, of which only those from b on are read.
#[inline(always)]
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
            let t = &t[j];
            let [along_r, along_z] = &mut stiffness[2 * b + j];
            let mut add = |from: usize| {
                for a in from..from + 4 {
                    let (r, z, hoop) = (rows.r[a], rows.z[a], rows.hoop[a]);
                    along_r[a] += r * t[0] + z * t[1] + hoop * t[4];
                    along_z[a] += r * t[2] + z * t[3];
                }
            };
            if b < 4 {
                add(0);
            }
            if nodes > 4 {
                add(4);
            }
        }
    }
}
