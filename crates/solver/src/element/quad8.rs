//! Eight-node serendipity quadrilateral with reduced 2 × 2 integration.

use crate::element::kernel::{
    ElementContext, ElementOutput, GAUSS, POINTS, PointSlice, Triangle, force, next_columns,
    stiffness_of_nodes, stress_of_node,
};
use crate::point::failure::Failure;
use crate::point::j2::Tangent;
use crate::point::kinematics::{ShapePoint, motion};
use asperity_numerics::lanes::Lanes;

/// Corners, then mid-sides, of the reference square.
const NODES: [[f64; 2]; 8] =
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];

/// Shape functions at (ξ, η).
pub fn shape(xi: f64, eta: f64, weight: f64) -> ShapePoint<8> {
    let mut point = ShapePoint { value: [0.0; 8], slope: [[0.0; 2]; 8], weight };
    for (a, [s, t]) in NODES.into_iter().enumerate() {
        let (p, q) = (1.0 + s * xi, 1.0 + t * eta);
        if a < 4 {
            point.value[a] = 0.25 * p * q * (s * xi + t * eta - 1.0);
            point.slope[a] =
                [0.25 * s * q * (2.0 * s * xi + t * eta), 0.25 * t * p * (s * xi + 2.0 * t * eta)];
        } else if s == 0.0 {
            point.value[a] = 0.5 * (1.0 - xi * xi) * q;
            point.slope[a] = [-xi * q, 0.5 * t * (1.0 - xi * xi)];
        } else {
            point.value[a] = 0.5 * p * (1.0 - eta * eta);
            point.slope[a] = [0.5 * s * (1.0 - eta * eta), -eta * p];
        }
    }
    point
}

/// The four integration points, in the order of the corners.
pub fn points() -> [ShapePoint<8>; POINTS] {
    [[-GAUSS, -GAUSS], [GAUSS, -GAUSS], [GAUSS, GAUSS], [-GAUSS, GAUSS]].map(|[s, t]| shape(s, t, 1.0))
}

/// Internal forces, stiffness and new states. `start` are the points the increment starts from, `triangle` is
/// work space.
///
/// f_a = ∫ τ : ∇N_a dV₀, K = ∂f/∂u.
///
/// # Errors
/// A point that fails, an element that turns inside out.
#[inline(always)]
pub fn evaluate(
    context: &ElementContext<'_>,
    points: &ShapePoint<8, Lanes>,
    x: &[[f64; 2]; 8],
    du: &[[f64; 2]; 8],
    start: &PointSlice<'_>,
    triangle: &mut Triangle,
    out: &mut ElementOutput,
) -> Result<(), Failure> {
    let motion = motion(points, x, du, context.symmetry)?;
    let (stress, form) = context.update(start, &motion.increment, out)?;
    let weight = start.weights();
    out.sum_force(&force(&motion.rows, &stress, weight));
    if context.tangent != Tangent::None {
        let mut rest = &mut triangle[..];
        for b in 0..8 {
            let stress = stress_of_node(&form, &motion.rows[b], weight);
            let mut columns = next_columns(&mut rest, 8 - b);
            for a in b..8 {
                columns.put(a - b, &stiffness_of_nodes(&motion.rows[a], &stress));
            }
        }
        out.sum_stiffness::<8>(triangle);
    }
    Ok(())
}
