//! Four-node quadrilateral with mean dilatation (Q1/P0 of Simo, Taylor, Pister 1985) in variational form.
//!
//! The points see f̄ = s f with s = (θ/j)^{1/3}, θ = v/v_n the volume ratio of the whole element and j = det
//! f that of the point, hoop stretch included. The residual is the derivative of ∫ W(F̄) dV₀, and so the
//! tangent is symmetric.

use crate::element::kernel::{
    ElementContext, ElementOutput, GAUSS, POINTS, PointSlice, Triangle, force, next_columns,
    stiffness_of_nodes, stress_of_node,
};
use crate::point::failure::Failure;
use crate::point::j2::Tangent;
use crate::point::kinematics::{ShapePoint, motion};
use crate::point::tensor::{trace, volume_change};
use asperity_numerics::lanes::{Lanes, Real};

/// Shape functions at (ξ, η).
pub fn shape(xi: f64, eta: f64, weight: f64) -> ShapePoint<4> {
    let mut point = ShapePoint { value: [0.0; 4], slope: [[0.0; 2]; 4], weight };
    for (a, [s, t]) in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].into_iter().enumerate() {
        let (p, q) = (1.0 + s * xi, 1.0 + t * eta);
        point.value[a] = 0.25 * p * q;
        point.slope[a] = [0.25 * s * q, 0.25 * t * p];
    }
    point
}

/// The four integration points, in the order of the corners.
pub fn points() -> [ShapePoint<4>; POINTS] {
    [[-GAUSS, -GAUSS], [GAUSS, -GAUSS], [GAUSS, GAUSS], [-GAUSS, GAUSS]].map(|[s, t]| shape(s, t, 1.0))
}

/// Internal forces, stiffness and new states. `start` are the points the increment starts from, `triangle` is
/// work space.
///
/// With b_a = div N_a, b̄_a its volume average and m_a = (b̄_a - b_a)/3, a virtual displacement of node a
/// changes f̄ by l̄_a = ∇N_a + m_a I: f_a = ∫ τ : l̄_a dV₀. With p = ⅓ tr τ and P = ∫ p dV₀ the tangent is
/// the sum over the points of
///   l̄_aᵀ A l̄_b + p (∇N_a : ∇N_bᵀ) + 3p m_a m_b + m_a (τ:∇N_b) + (τ:∇N_a) m_b
/// and of the second variation of ln θ, P (δδv/v - b̄_a b̄_b) with δδv = ∫ (b_a b_b - ∇N_a : ∇N_bᵀ) dv.
///
/// # Errors
/// A point that fails, an element that turns inside out.
#[inline(always)]
pub fn evaluate(
    context: &ElementContext<'_>,
    points: &ShapePoint<4, Lanes>,
    x: &[[f64; 2]; 4],
    du: &[[f64; 2]; 4],
    start: &PointSlice<'_>,
    triangle: &mut Triangle,
    out: &mut ElementOutput,
) -> Result<(), Failure> {
    let m = motion(points, x, du, context.symmetry)?;
    let j = volume_change(&m.increment);
    let current = sum(m.volume); // v_{n+1}
    let change = sum(m.volume * j / (j + 1.0)); // v_{n+1} - v_n
    let (mut divergence, mut mean) = ([[Lanes::splat(0.0); 2]; 4], [[0.0; 2]; 4]); // b, b̄
    for a in 0..4 {
        divergence[a] = [m.rows[a][0] + m.rows[a][2], m.rows[a][1]];
        for i in 0..2 {
            mean[a][i] = sum(m.volume * divergence[a][i]) / current;
        }
    }
    let increment = with_mean_dilatation(m.increment, j, change / (current - change));
    let (stress, form) = context.update(start, &increment, out)?;
    let weight = start.weights();
    let mut shift = [[Lanes::splat(0.0); 2]; 4]; // m_a
    for a in 0..4 {
        for i in 0..2 {
            shift[a][i] = (-divergence[a][i] + mean[a][i]) / 3.0;
        }
    }
    let mut forces = force(&m.rows, &stress, weight);
    let three_p = trace(&stress);
    for a in 0..4 {
        for i in 0..2 {
            forces[i][a] += weight * three_p * shift[a][i];
        }
    }
    out.sum_force(&forces);
    if context.tangent == Tangent::None {
        return Ok(());
    }
    let total = sum(weight * three_p) / 3.0; // P
    let of_volume = m.volume * (total / current);
    let of_gradients = weight * three_p / 3.0 - of_volume;
    let ai = times_identity(&form); // and I A I
    let of_shifts = ai[0] + ai[3] + ai[4] + three_p;
    let mut cross = [[Lanes::splat(0.0); 2]; 4];
    for a in 0..4 {
        cross[a] = cross_terms(&ai, &stress, &m.rows[a]);
    }
    let mut rest = &mut triangle[..];
    for b in 0..4 {
        let of_node = stress_of_node(&form, &m.rows[b], weight);
        let mut columns = next_columns(&mut rest, 4 - b);
        for a in b..4 {
            let mut block = stiffness_of_nodes(&m.rows[a], &of_node);
            let transposed = transposed_product(&m.rows[a], &m.rows[b]);
            for i in 0..2 {
                for j in 0..2 {
                    let mixed = cross[b][j] + of_shifts * shift[b][j];
                    block[i][j] += weight * (shift[a][i] * mixed + cross[a][i] * shift[b][j])
                        + of_gradients * transposed[i][j]
                        + of_volume * divergence[a][i] * divergence[b][j]
                        - 0.25 * total * mean[a][i] * mean[b][j];
                }
            }
            columns.put(a - b, &block);
        }
    }
    out.sum_stiffness::<4>(triangle);
    Ok(())
}

/// f̄ - I = s (f - I) + (s - 1) I of the increment f - I, whose volume changes by `j` at the points and by
/// `mean` in the element.
#[inline(always)]
fn with_mean_dilatation(mut increment: [Lanes; 5], j: Lanes, mean: f64) -> [Lanes; 5] {
    let theta = mean.ln_1p();
    let s1 = ((-j.ln_1p() + theta) / 3.0).exp_m1();
    for i in 0..5 {
        increment[i] += s1 * increment[i];
    }
    for i in [0, 3, 4] {
        increment[i] += s1;
    }
    increment
}

/// A I, I = (1, 0, 0, 1, 1).
#[inline(always)]
fn times_identity(form: &[[Lanes; 5]; 5]) -> [Lanes; 5] {
    let mut ai = [Lanes::splat(0.0); 5];
    for i in 0..5 {
        ai[i] = form[i][0] + form[i][3] + form[i][4];
    }
    ai
}

/// (A I) : ∇N_a + τ : ∇N_a of unit displacements of the node with these rows.
#[inline(always)]
fn cross_terms(ai: &[Lanes; 5], stress: &[Lanes; 4], [r, z, hoop]: &[Lanes; 3]) -> [Lanes; 2] {
    [
        (ai[0] + stress[0]) * *r + (ai[1] + stress[3]) * *z + (ai[4] + stress[2]) * *hoop,
        (ai[2] + stress[3]) * *r + (ai[3] + stress[1]) * *z,
    ]
}

/// The sum over the points.
#[inline(always)]
fn sum(of: Lanes) -> f64 {
    of.0.iter().sum()
}

/// ∇N_a : ∇N_bᵀ of unit displacements of the nodes with rows `a` along i and `b` along j.
#[inline(always)]
fn transposed_product(a: &[Lanes; 3], b: &[Lanes; 3]) -> [[Lanes; 2]; 2] {
    [[a[0] * b[0] + a[2] * b[2], a[1] * b[0]], [a[0] * b[1], a[1] * b[1]]]
}
