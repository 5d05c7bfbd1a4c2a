//! Four-node quadrilateral with mean dilatation (Q1/P0 of Simo, Taylor, Pister 1985) in variational form.
//!
//! The points see f̄ = s f with s = (θ/j)^{1/3}, θ = v/v_n the volume ratio of the whole element and j = det f that of
//! the point, hoop stretch included. The residual is the derivative of ∫ W(F̄) dV₀, and so the tangent is symmetric.

use crate::element::kernel::{
    ElementContext, ElementOutput, GAUSS, POINTS, PointSlice, Rows, add_force, add_stiffness, response_of,
};
use crate::point::failure::Failure;
use crate::point::j2::Tangent;
use crate::point::kinematics::{PointMotion, ShapePoint, motion};
use crate::point::tensor::{trace, volume_change};
use asperity_law::real::{Lanes, Real};

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

/// Internal forces, stiffness and new states. `start` are the points the increment starts from.
///
/// With b_a = div N_a, b̄_a its volume average and m_a = (b̄_a - b_a)/3, a virtual displacement of node a changes f̄
/// by l̄_a = ∇N_a + m_a I: f_a = ∫ τ : l̄_a dV₀, and the tangent adds the second variation of s (see `add_volume_stiffness`).
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
    out: &mut ElementOutput,
) -> Result<(), Failure> {
    out.clear(context.tangent);
    let m = motion(points, x, du, context.symmetry)?;
    let j = volume_change(&m.increment);
    let current = sum(m.volume); // v_{n+1}
    let change = sum(m.volume * j / (j + 1.0)); // v_{n+1} - v_n
    // b̄
    let mean = [0, 1]
        .map(|i| m.rows.map(|row| sum(m.volume * if i == 0 { row[0] + row[2] } else { row[1] }) / current));
    // f̄ - I = s (f - I) + (s - 1) I
    let theta = (change / (current - change)).ln_1p();
    let s1 = ((-j.ln_1p() + theta) / 3.0).exp_m1();
    let mut increment = m.increment.map(|g| g + s1 * g);
    for i in [0, 3, 4] {
        increment[i] += s1;
    }
    let end = context.update(start, &increment, out)?;
    let mut total_pressure = 0.0; // ∫ ⅓ tr τ dV₀
    for q in 0..POINTS {
        let rows = Rows::new(&m.rows, q);
        let (stress, form) = response_of(&end, q);
        let mut shift = [[0.0; 8]; 2]; // m_a
        for a in 0..4 {
            shift[0][a] = (mean[0][a] - rows.r[a] - rows.hoop[a]) / 3.0;
            shift[1][a] = (mean[1][a] - rows.z[a]) / 3.0;
        }
        add_force(&mut out.force, &rows, &stress, start.weight[q]);
        let pressure3 = trace(&stress) * start.weight[q];
        for i in 0..2 {
            for a in 0..4 {
                out.force[i][a] += pressure3 * shift[i][a];
            }
        }
        total_pressure += pressure3 / 3.0;
        if context.tangent != Tangent::None {
            add_point_stiffness(out, &rows, &shift, &form, &stress, start.weight[q]);
        }
    }
    if context.tangent != Tangent::None {
        add_volume_stiffness(out, &m, &mean, current, total_pressure);
    }
    Ok(())
}

/// The sum over the points.
#[inline(always)]
fn sum(of: Lanes) -> f64 {
    of.0.iter().sum()
}

/// Adds l̄ᵀ A l̄ and the part of τ f̄ᵀ : δδf̄ that belongs to one point:
/// p (∇N_a : ∇N_bᵀ) + 3p m_a m_b + m_a (τ:∇N_b) + (τ:∇N_a) m_b, p = ⅓ tr τ.
#[inline(always)]
fn add_point_stiffness(
    out: &mut ElementOutput,
    rows: &Rows,
    shift: &[[f64; 8]; 2],
    form: &[[f64; 5]; 5],
    stress: &[f64; 4],
    weight: f64,
) {
    add_stiffness(&mut out.stiffness, 4, rows, form, weight);
    // A I and I A I, I = (1, 0, 0, 1, 1)
    let ai: [f64; 5] = std::array::from_fn(|i| form[i][0] + form[i][3] + form[i][4]);
    let iai = ai[0] + ai[3] + ai[4];
    let three_p = trace(stress);
    let mut cross = [[0.0; 8]; 2]; // (A I) : ∇N_a + τ : ∇N_a
    for a in 0..4 {
        cross[0][a] = (ai[0] + stress[0]) * rows.r[a]
            + (ai[1] + stress[3]) * rows.z[a]
            + (ai[4] + stress[2]) * rows.hoop[a];
        cross[1][a] = (ai[2] + stress[3]) * rows.r[a] + (ai[3] + stress[1]) * rows.z[a];
    }
    for b in 0..4 {
        for j in 0..2 {
            for i in 0..2 {
                for a in 0..4 {
                    let transposed = transposed_product(rows, i, a, j, b);
                    out.stiffness[2 * b + j][i][a] += weight
                        * (shift[i][a] * cross[j][b]
                            + cross[i][a] * shift[j][b]
                            + (iai + three_p) * shift[i][a] * shift[j][b]
                            + three_p / 3.0 * transposed);
                }
            }
        }
    }
}

/// ∇N : ∇Nᵀ of unit displacements (node a along i) and (node b along j).
#[inline(always)]
fn transposed_product(rows: &Rows, i: usize, a: usize, j: usize, b: usize) -> f64 {
    match (i, j) {
        (0, 0) => rows.r[a] * rows.r[b] + rows.hoop[a] * rows.hoop[b],
        (0, _) => rows.z[a] * rows.r[b],
        (_, 0) => rows.r[a] * rows.z[b],
        _ => rows.z[a] * rows.z[b],
    }
}

/// Adds P (δδv/v - b̄_a b̄_b), P = ∫⅓ tr τ dV₀ and δδv = ∫ (b_a b_b - ∇N_a : ∇N_bᵀ) dv: the second variation of ln θ.
#[inline(always)]
fn add_volume_stiffness(
    out: &mut ElementOutput,
    motion: &PointMotion<4, Lanes>,
    mean: &[[f64; 4]; 2],
    current: f64,
    total_pressure: f64,
) {
    for q in 0..POINTS {
        let rows = Rows::new(&motion.rows, q);
        let w = total_pressure * motion.volume.0[q] / current;
        let b = |i: usize, a: usize| if i == 0 { rows.r[a] + rows.hoop[a] } else { rows.z[a] };
        for n in 0..4 {
            for j in 0..2 {
                for i in 0..2 {
                    for a in 0..4 {
                        out.stiffness[2 * n + j][i][a] +=
                            w * (b(i, a) * b(j, n) - transposed_product(&rows, i, a, j, n));
                    }
                }
            }
        }
    }
    for n in 0..4 {
        for j in 0..2 {
            for i in 0..2 {
                for a in 0..4 {
                    out.stiffness[2 * n + j][i][a] -= total_pressure * mean[i][a] * mean[j][n];
                }
            }
        }
    }
}
