//! Shape functions at integration points, current gradients, and the increment of deformation.
//!
//! Axisymmetry enters here and nowhere else: the hoop row N_a/r and the weight 2πr. In plane strain the hoop row
//! is zero and the weight is 1.

use crate::point::failure::Failure;
use crate::point::tensor::Gradient;
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

/// Shape functions of an N-node element at one integration point.
#[derive(Clone, Copy, Debug)]
pub struct ShapePoint<const N: usize> {
    /// N_a.
    pub value: [f64; N],
    /// ∂N_a/∂(ξ, η).
    pub slope: [[f64; 2]; N],
    /// Weight of the quadrature.
    pub weight: f64,
}

/// Motion of an integration point in one increment.
#[derive(Clone, Copy, Debug)]
pub struct PointMotion<const N: usize> {
    /// Rows (∂N_a/∂r, ∂N_a/∂z, N_a/r) in the current configuration.
    pub rows: [[f64; 3]; N],
    /// f - I, f = ∂x_{n+1}/∂x_n.
    pub increment: Gradient,
    /// Current volume of the point: weight × det J × 2πr.
    pub volume: f64,
    /// Current radius.
    pub radius: f64,
}

/// The motion at one point from current node positions `x` and the displacement increments `du` that led there.
///
/// k = ∂Δu/∂x_{n+1} needs only current gradients; f = (I - k)⁻¹ and f - I = f k keep the digits of tiny strains.
///
/// # Errors
/// An element that is, or that the increment would turn, inside out.
#[inline]
pub fn motion<const N: usize>(
    point: &ShapePoint<N>,
    x: &[[f64; 2]; N],
    du: &[[f64; 2]; N],
    symmetry: Symmetry,
) -> Result<PointMotion<N>, Failure> {
    let (mut j, mut r, mut ur) = ([[0.0; 2]; 2], 0.0, 0.0);
    for a in 0..N {
        for i in 0..2 {
            j[i][0] += x[a][i] * point.slope[a][0];
            j[i][1] += x[a][i] * point.slope[a][1];
        }
        r += point.value[a] * x[a][0];
        ur += point.value[a] * du[a][0];
    }
    let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    let axisymmetric = symmetry == Symmetry::Axisymmetric;
    if det.is_nan() || det <= 0.0 || (axisymmetric && (r <= 0.0 || r - ur <= 0.0)) {
        return Err(Failure::Inverted);
    }
    let inverse_r = if axisymmetric { 1.0 / r } else { 0.0 };
    let (mut rows, mut k) = ([[0.0; 3]; N], [0.0; 4]);
    for a in 0..N {
        let [s, t] = point.slope[a];
        let dr = (s * j[1][1] - t * j[1][0]) / det;
        let dz = (t * j[0][0] - s * j[0][1]) / det;
        rows[a] = [dr, dz, point.value[a] * inverse_r];
        k[0] += du[a][0] * dr;
        k[1] += du[a][0] * dz;
        k[2] += du[a][1] * dr;
        k[3] += du[a][1] * dz;
    }
    let shrink = (1.0 - k[0]) * (1.0 - k[3]) - k[1] * k[2]; // det(I - k) = 1/det f
    if shrink.is_nan() || shrink <= 0.0 {
        return Err(Failure::Inverted);
    }
    let area = k[0] * k[3] - k[1] * k[2];
    let hoop = if axisymmetric { ur / (r - ur) } else { 0.0 };
    let increment = [(k[0] - area) / shrink, k[1] / shrink, k[2] / shrink, (k[3] - area) / shrink, hoop];
    Ok(PointMotion { rows, increment, volume: point.weight * det * symmetry.weight(r), radius: r })
}
