//! Shared by both quadrilaterals: the arrays they fill and the kernels that fill them, all four points side
//! by side. The sum over the points comes last.

use crate::point::failure::Failure;
use crate::point::j2::{self, Linearisation, PointUpdate, Tangent};
use crate::point::kinematic_hardening::{self, History};
use crate::point::kinematics::Symmetry;
use crate::point::material::{Metal, PointState};
use crate::point::tensor::{Gradient, GradientForm, Sym};
use asperity_numerics::lanes::{Lanes, Mask, Real};

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
    /// The tangent that is wanted.
    pub tangent: Tangent,
}

impl ElementContext<'_> {
    /// Stress and tangent of the points of the element, updated from their `start` by f - I = `increment`;
    /// what they are then goes to `out`. Points that have been updated by this increment already only give
    /// the tangent that is wanted now.
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

impl PointSlice<'_> {
    /// The weights side by side.
    #[inline(always)]
    pub fn weights(&self) -> Lanes {
        Lanes::each(|q| self.weight[q])
    }
}

/// Numbers of the lower triangle of the stiffness of eight nodes.
pub const ENTRIES: usize = 16 * 17 / 2;

/// The lower triangle of the stiffness of an element, point by point, before it is summed: work space.
pub type Triangle = [Lanes; ENTRIES];

/// Forces, stiffness and states of one element, with room for eight nodes.
#[derive(Clone, Debug)]
pub struct ElementOutput {
    /// Internal nodal forces f_r, f_z.
    pub force: [[f64; 8]; 2],
    /// Column by column of its lower triangle, ∂f_i,a/∂u_j,b with row 2a + i and column 2b + j.
    pub stiffness: [f64; ENTRIES],
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
            stiffness: [0.0; ENTRIES],
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

    /// Takes the forces of the first N nodes, summed over the points.
    #[inline(always)]
    pub fn sum_force<const N: usize>(&mut self, force: &[[Lanes; N]; 2]) {
        for (sums, force) in self.force.iter_mut().zip(force) {
            sum_points(force, sums);
        }
    }

    /// Takes the stiffness of N nodes, summed over the points.
    #[inline(always)]
    pub fn sum_stiffness<const N: usize>(&mut self, triangle: &Triangle) {
        sum_points(&triangle[..entries(N)], &mut self.stiffness);
    }
}

/// Numbers of the lower triangle of the stiffness of so many nodes.
pub const fn entries(nodes: usize) -> usize {
    nodes * (2 * nodes + 1)
}

/// The sums over the points of a multiple of four numbers.
#[inline(always)]
fn sum_points(of: &[Lanes], sums: &mut [f64]) {
    for (of, sums) in of.chunks_exact(4).zip(sums.chunks_exact_mut(4)) {
        sums.copy_from_slice(&Lanes::sums([of[0], of[1], of[2], of[3]]).0);
    }
}

/// Rows ∂N/∂r, ∂N/∂z, N/r (0 in plane strain) of each node, at one point or at several side by side.
pub type Rows<T, const N: usize> = [[T; 3]; N];

/// w τ : ∇N_a: the nodal forces f_r, f_z of one point, or of several side by side.
#[inline(always)]
pub fn force<T: Real, const N: usize>(rows: &Rows<T, N>, stress: &Sym<T>, weight: T) -> [[T; N]; 2] {
    let [rr, zz, tt, rz] = [stress[0] * weight, stress[1] * weight, stress[2] * weight, stress[3] * weight];
    let mut force = [[T::splat(0.0); N]; 2];
    for a in 0..N {
        let [r, z, hoop] = rows[a];
        force[0][a] = rr * r + rz * z + tt * hoop;
        force[1][a] = rz * r + zz * z;
    }
    force
}

/// w A G_b: what a displacement of the node with `row` along r, along z, makes of the five components of the
/// stress that do work on gradients.
#[inline(always)]
pub fn stress_of_node<T: Real>(form: &GradientForm<T>, row: &[T; 3], weight: T) -> [[T; 5]; 2] {
    let (d, e, h) = (weight * row[0], weight * row[1], weight * row[2]);
    let mut stress = [[T::splat(0.0); 5]; 2];
    for i in 0..5 {
        stress[0][i] = form[i][0] * d + form[i][1] * e + form[i][4] * h;
        stress[1][i] = form[i][2] * d + form[i][3] * e;
    }
    stress
}

/// G_aᵀ t of the node with `row`, for both `stress` t of another node: ∂f_i,a/∂u_j,b at \[i\]\[j\].
#[inline(always)]
pub fn stiffness_of_nodes<T: Real>(row: &[T; 3], stress: &[[T; 5]; 2]) -> [[T; 2]; 2] {
    let ([r, z, hoop], [s, t]) = (*row, stress);
    [
        [r * s[0] + z * s[1] + hoop * s[4], r * t[0] + z * t[1] + hoop * t[4]],
        [r * s[2] + z * s[3], r * t[2] + z * t[3]],
    ]
}

/// The columns of one node in the lower triangle of a stiffness: of its displacements along r and along z.
/// (Not a closure for each pair of nodes: it would not be inlined into code for other registers than the
/// program's.)
pub struct NodeColumns<'a, T> {
    along_r: &'a mut [T],
    along_z: &'a mut [T],
}

/// Takes the columns of the next node off the `rest` of a triangle; with it there are so many `nodes` left.
#[inline(always)]
pub fn next_columns<'a, T>(rest: &mut &'a mut [T], nodes: usize) -> NodeColumns<'a, T> {
    let (along_r, others) = std::mem::take(rest).split_at_mut(2 * nodes);
    let (along_z, others) = others.split_at_mut(2 * nodes - 1);
    *rest = others;
    NodeColumns { along_r, along_z }
}

impl<T: Copy> NodeColumns<'_, T> {
    /// Puts the `block` \[i\]\[j\] of the node that comes so many nodes `after` into its place.
    #[inline(always)]
    pub fn put(&mut self, after: usize, block: &[[T; 2]; 2]) {
        let [[rr, rz], [zr, zz]] = *block;
        (self.along_r[2 * after], self.along_r[2 * after + 1]) = (rr, zr);
        if after > 0 {
            self.along_z[2 * after - 1] = rz;
        }
        self.along_z[2 * after] = zz;
    }
}
