//! Eight-node serendipity quadrilateral with reduced 2 × 2 integration.

use crate::element::kernel::{
    ElementContext, ElementOutput, GAUSS, POINTS, PointSlice, Rows, add_force, add_stiffness, response_of,
};
use crate::point::failure::Failure;
use crate::point::j2::Tangent;
use crate::point::kinematics::{ShapePoint, motion};
use asperity_law::real::Lanes;

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

/// Internal forces, stiffness and new states. `start` are the points the increment starts from.
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
    out: &mut ElementOutput,
) -> Result<(), Failure> {
    out.clear(context.tangent);
    let motion = motion(points, x, du, context.symmetry)?;
    let end = context.update(start, &motion.increment, out)?;
    for q in 0..POINTS {
        let rows = Rows::new(&motion.rows, q);
        let (stress, form) = response_of(&end, q);
        add_force(&mut out.force, &rows, &stress, start.weight[q]);
        if context.tangent != Tangent::None {
            add_stiffness(&mut out.stiffness, 8, &rows, &form, start.weight[q]);
        }
    }
    Ok(())
}
