//! Shape functions at integration points, current gradients, and the increment of deformation.
//!
//! Axisymmetry enters here and nowhere else: the hoop row N_a/r and the weight 2πr. In plane strain the hoop
//! row is zero and the weight is 1.

use crate::point::failure::Failure;
use crate::point::tensor::Gradient;
use asperity_numerics::lanes::{Lanes, Real};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The two planar idealisations: body of revolution about r = 0, or prismatic body of unit thickness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Symmetry {
    /// Full body of revolution, hoop stretch r/R, weight 2πr: the first asperity is a cone, the others are rings.
    Axisymmetric,
    /// Straight ridges, nothing mirrored, hoop stretch 1, weight 1: results are per length of ridge.
    PlaneStrain,
}

impl Symmetry {
    /// Out-of-plane measure at radius `r`: circumference 2πr, or thickness 1.
    pub fn weight(self, r: f64) -> f64 {
        match self {
            Symmetry::Axisymmetric => 2.0 * std::f64::consts::PI * r,
            Symmetry::PlaneStrain => 1.0,
        }
    }
}

/// Shape functions of an N-node element at one integration point, or at several side by side.
#[derive(Clone, Copy, Debug)]
pub struct ShapePoint<const N: usize, T = f64> {
    /// N_a.
    pub value: [T; N],
    /// ∂N_a/∂(ξ, η).
    pub slope: [[T; 2]; N],
    /// Weight of the quadrature.
    pub weight: T,
}

impl<const N: usize> ShapePoint<N, Lanes> {
    /// Four points side by side.
    pub fn side_by_side(points: &[ShapePoint<N>; 4]) -> Self {
        ShapePoint {
            value: std::array::from_fn(|a| Lanes::each(|q| points[q].value[a])),
            slope: std::array::from_fn(|a| [0, 1].map(|i| Lanes::each(|q| points[q].slope[a][i]))),
            weight: Lanes::each(|q| points[q].weight),
        }
    }
}

/// Motion of an integration point, or of several side by side, in one increment.
#[derive(Clone, Copy, Debug)]
pub struct PointMotion<const N: usize, T = f64> {
    /// Rows (∂N_a/∂r, ∂N_a/∂z, N_a/r) in the current configuration.
    pub rows: [[T; 3]; N],
    /// f - I, f = ∂x_{n+1}/∂x_n.
    pub increment: Gradient<T>,
    /// Current volume of the point: weight × det J × 2πr.
    pub volume: T,
    /// Current radius.
    pub radius: T,
}

/// The motion at one point, or at several, from current node positions `x` and the displacement increments
/// `du` that led there.
///
/// k = ∂Δu/∂x_{n+1} needs only current gradients; f = (I - k)⁻¹ and f - I = f k keep the digits of tiny
/// strains.
///
/// # Errors
/// An element that is, or that the increment would turn, inside out.
#[inline(always)]
pub fn motion<T: Real, const N: usize>(
    point: &ShapePoint<N, T>,
    x: &[[f64; 2]; N],
    du: &[[f64; 2]; N],
    symmetry: Symmetry,
) -> Result<PointMotion<N, T>, Failure> {
    let (zero, one) = (T::splat(0.0), T::splat(1.0));
    let (mut j, mut r, mut ur) = ([[zero; 2]; 2], zero, zero);
    for a in 0..N {
        for i in 0..2 {
            j[i][0] += point.slope[a][0] * x[a][i];
            j[i][1] += point.slope[a][1] * x[a][i];
        }
        r += point.value[a] * x[a][0];
        ur += point.value[a] * du[a][0];
    }
    let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    let axisymmetric = symmetry == Symmetry::Axisymmetric;
    let off_axis = !axisymmetric || T::all(r.is_above(zero) & (r - ur).is_above(zero));
    if !(off_axis && T::all(det.is_above(zero))) {
        return Err(Failure::Inverted);
    }
    let inverse_r = if axisymmetric { one / r } else { zero };
    let inverse = [[j[0][0] / det, j[0][1] / det], [j[1][0] / det, j[1][1] / det]];
    let (mut rows, mut k) = ([[zero; 3]; N], [zero; 4]);
    for a in 0..N {
        let [s, t] = point.slope[a];
        let dr = s * inverse[1][1] - t * inverse[1][0];
        let dz = t * inverse[0][0] - s * inverse[0][1];
        rows[a] = [dr, dz, point.value[a] * inverse_r];
        k[0] += dr * du[a][0];
        k[1] += dz * du[a][0];
        k[2] += dr * du[a][1];
        k[3] += dz * du[a][1];
    }
    let shrink = (one - k[0]) * (one - k[3]) - k[1] * k[2]; // det(I - k) = 1/det f
    if !T::all(shrink.is_above(zero)) {
        return Err(Failure::Inverted);
    }
    let area = k[0] * k[3] - k[1] * k[2];
    let hoop = if axisymmetric { ur / (r - ur) } else { zero };
    let increment = [(k[0] - area) / shrink, k[1] / shrink, k[2] / shrink, (k[3] - area) / shrink, hoop];
    let weight = if axisymmetric { r * (2.0 * std::f64::consts::PI) } else { one };
    Ok(PointMotion { rows, increment, volume: point.weight * det * weight, radius: r })
}
