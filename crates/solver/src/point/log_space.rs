//! The space of Lagrangian logarithmic strains E = ½ ln C, C = FᵀF, in closed form for the (2 × 2) + 1 of a
//! section.
//!
//! A law that is written for small strains there, W(E) with T = ∂W/∂E, is a law for large ones (Miehe, Apel,
//! Lambrecht 2002, Comput. Methods Appl. Mech. Engrg. 191, 3383-3425): it is objective because E does not see
//! rotations, and its tangent is symmetric because it is the second derivative of W. What is needed is E',
//! T:E' and T:E''.
//!
//! **Derivation.** In the frame of the principal directions N_A of C, with n_A = R N_A, a displacement
//! gradient g of the current configuration with symmetric part d changes C by X = 2Fᵀ d F, X_AB = 2 λ_A λ_B
//! d_AB (d in the frame n_A). The derivatives of ½ ln are divided differences of f(c) = ½ ln c,
//!   `E'[X]_AB = f[c_A, c_B] X_AB,   E''[X, X']_AB = Σ_K f[c_A, c_K, c_B] (X_AK X'_KB + X'_AK X_KB)`.
//! With y = E₁ - E₂ all that is left depends on y alone:
//!   E'₁₁ = d₁₁, E'₂₂ = d₂₂, E'₃₃ = d₃₃, E'₁₂ = θ d₁₂,   θ = y/sinh y,
//! so that Kirchhoff's stress is τ_AA = T_AA, τ₁₂ = θ T₁₂ in the frame n_A; and with γ = 2 d₁₂,
//!   T : E'' = - 2 Σ T_AA d_AA d'_AA + ½ γ γ' {μ (T₁₁ - T₂₂) - T₁₁ - T₂₂}
//!             - T₁₂ {(θ (d₁₁ + d₂₂) + κ (d₁₁ - d₂₂)) γ' + (θ (d'₁₁ + d'₂₂) + κ (d'₁₁ - d'₂₂)) γ},
//!   κ = (y cosh y - sinh y)/sinh² y,   μ = (sinh y cosh y - y)/sinh² y.
//! The second variation of C itself, Fᵀ(gᵀg' + g'ᵀg)F, adds the geometric term τ_ij g_ki g'_kj. For a coaxial
//! T = ∂W/∂E the coefficient of γγ' is G y coth y - ½(τ₁ + τ₂), that of `material::Spectral::tangent`.

use crate::point::failure::Failure;
use crate::point::material::Spectral;
use crate::point::tensor::{Gradient, GradientForm, Sym, with_geometric_term};

/// Components 11, 22, 33, 12 in a principal frame.
pub type Framed = [f64; 4];

/// F - I of f F, from f - I and F - I.
pub fn compose(f: &Gradient, d: &Gradient) -> Gradient {
    [
        f[0] + d[0] + f[0] * d[0] + f[1] * d[2],
        f[1] + d[1] + f[0] * d[1] + f[1] * d[3],
        f[2] + d[2] + f[2] * d[0] + f[3] * d[2],
        f[3] + d[3] + f[2] * d[1] + f[3] * d[3],
        f[4] + d[4] + f[4] * d[4],
    ]
}

/// The logarithmic strain of a deformation, with the frames it is diagonal in.
#[derive(Clone, Copy, Debug)]
pub struct LogStrain {
    /// Principal strains: two in the plane, then hoop.
    pub principal: [f64; 3],
    /// (cos 2α, sin 2α) of N₁, before the rotation.
    lagrangian: [f64; 2],
    /// The same of n₁, after it.
    current: [f64; 2],
    theta: f64,
    kappa: f64,
    mu: f64,
}

impl LogStrain {
    /// Of F - I.
    ///
    /// # Errors
    /// C that is not positive definite.
    pub fn new(d: &Gradient) -> Result<LogStrain, Failure> {
        let [rr, rz, zr, zz, tt] = *d;
        let c_minus_one = [
            2.0 * rr + rr * rr + zr * zr,
            2.0 * zz + rz * rz + zz * zz,
            2.0 * tt + tt * tt,
            rz + zr + rr * rz + zr * zz,
        ];
        let spectral = Spectral::new(&c_minus_one)?;
        // F = R U: F_zr - F_rz = sin ω tr U, F_rr + F_zz = cos ω tr U in the plane
        let (sine, cosine) = (zr - rz, 2.0 + rr + zz);
        let length = sine.hypot(cosine);
        let (s, c) = (sine / length, cosine / length);
        let twice = [(c - s) * (c + s), 2.0 * s * c];
        let lagrangian = spectral.double_angle;
        let current = [
            lagrangian[0] * twice[0] - lagrangian[1] * twice[1],
            lagrangian[1] * twice[0] + lagrangian[0] * twice[1],
        ];
        let principal = spectral.log_strain;
        let [theta, kappa, mu] = shear_functions(principal[0] - principal[1]);
        Ok(LogStrain { principal, lagrangian, current, theta, kappa, mu })
    }

    /// The components of a Lagrangian tensor in the frame N_A.
    pub fn into_frame(&self, a: &Sym) -> Framed {
        let [c, s] = self.lagrangian;
        let (mean, half) = (0.5 * (a[0] + a[1]), 0.5 * (a[0] - a[1]));
        let along = half * c + a[3] * s;
        [mean + along, mean - along, a[2], a[3] * c - half * s]
    }

    /// The Lagrangian tensor with these components in the frame N_A.
    pub fn out_of_frame(&self, a: &Framed) -> Sym {
        turned(a, self.lagrangian)
    }

    /// Kirchhoff's stress that does the work of T (in the frame N_A), in the frame n_A.
    pub fn kirchhoff(&self, t: &Framed) -> Framed {
        [t[0], t[1], t[2], self.theta * t[3]]
    }

    /// The tensor of the current configuration with these components in the frame n_A.
    pub fn to_current(&self, a: &Framed) -> Sym {
        turned(a, self.current)
    }

    /// ∂²W/∂∇u² with the geometric term of `geometric` (Kirchhoff's stress), from T in the frame N_A and
    /// moduli ∂T/∂E = K 1⊗1 + `shear` 2G (I - ⅓1⊗1) - `drop` N⊗N given as [K, 2G·shear, drop] and N.
    pub fn tangent(&self, t: &Framed, moduli: [f64; 3], n: &Framed, geometric: &Sym) -> GradientForm {
        let [bulk, shear, drop] = moduli;
        let (theta, kappa, mu) = (self.theta, self.kappa, self.mu);
        // the form on (d₁₁, d₂₂, d₃₃, γ)
        let flow = [n[0], n[1], n[2], theta * n[3]];
        let mut inner = [[0.0; 4]; 4];
        for a in 0..4 {
            for b in 0..4 {
                if a < 3 && b < 3 {
                    inner[a][b] = bulk - shear / 3.0;
                }
                inner[a][b] -= drop * flow[a] * flow[b];
            }
            if a < 3 {
                inner[a][a] += shear - 2.0 * t[a];
            }
        }
        inner[3][3] += 0.5 * (theta * theta * shear + mu * (t[0] - t[1]) - t[0] - t[1]);
        for (a, factor) in [(0, theta + kappa), (1, theta - kappa)] {
            inner[a][3] -= t[3] * factor;
            inner[3][a] -= t[3] * factor;
        }
        // (d₁₁, d₂₂, d₃₃, γ) of the unit gradients rr, rz, zr, zz, θθ
        let [c, s] = self.current;
        let rows = [
            [0.5 * (1.0 + c), 0.5 * s, 0.5 * s, 0.5 * (1.0 - c), 0.0],
            [0.5 * (1.0 - c), -0.5 * s, -0.5 * s, 0.5 * (1.0 + c), 0.0],
            [0.0, 0.0, 0.0, 0.0, 1.0],
            [-s, c, c, s, 0.0],
        ];
        let mut form = [[0.0; 5]; 5];
        for i in 0..5 {
            let half: [f64; 4] = std::array::from_fn(|b| (0..4).map(|a| rows[a][i] * inner[a][b]).sum());
            for j in 0..=i {
                form[i][j] = (0..4).map(|b| half[b] * rows[b][j]).sum();
            }
        }
        with_geometric_term(form, geometric)
    }
}

/// The tensor with components `a` in the frame of a double angle.
fn turned(a: &Framed, [c, s]: [f64; 2]) -> Sym {
    let (mean, half) = (0.5 * (a[0] + a[1]), 0.5 * (a[0] - a[1]));
    let along = half * c - a[3] * s;
    [mean + along, mean - along, a[2], half * s + a[3] * c]
}

/// θ, κ and μ of the module's derivation at y ≥ 0.
fn shear_functions(y: f64) -> [f64; 3] {
    if y == 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (sinh, cosh) = (y.sinh(), y.cosh());
    let square = sinh * sinh;
    let (of_kappa, of_mu) = if y < 0.1 {
        // Taylor series to y⁹, where the differences would lose their digits
        let z = y * y;
        let cube = y * z;
        (
            cube * (1.0 / 3.0 + z * (1.0 / 30.0 + z * (1.0 / 840.0 + z / 45_360.0))),
            cube * (2.0 / 3.0 + z * (2.0 / 15.0 + z * (4.0 / 315.0 + z * (2.0 / 2_835.0)))),
        )
    } else {
        (y * cosh - sinh, sinh * cosh - y)
    };
    [y / sinh, of_kappa / square, of_mu / square]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_closed_form_meet() {
        let (below, above) = (shear_functions(0.1 - 1e-12), shear_functions(0.1 + 1e-12));
        for (a, b) in below.into_iter().zip(above) {
            assert!((a / b - 1.0).abs() < 1e-10, "{a} {b}");
        }
        // θ' = -κ
        let step = 1e-5;
        for y in [0.02, 0.5, 2.0] {
            let slope = (shear_functions(y + step)[0] - shear_functions(y - step)[0]) / (2.0 * step);
            assert!((slope + shear_functions(y)[1]).abs() < 1e-9);
        }
    }

    #[test]
    fn frames_turn_there_and_back() {
        let d = [0.3, -0.2, 0.5, 0.1, 0.2];
        let strain = LogStrain::new(&d).unwrap();
        let a = [0.3, -0.4, 0.2, 0.7];
        let back = strain.out_of_frame(&strain.into_frame(&a));
        assert!((0..4).all(|i| (a[i] - back[i]).abs() < 1e-15));
        // the current frame is that of b = F Fᵀ, whose logarithm has the same principal values
        let b = crate::point::tensor::push_forward(&d, &[0.0; 4]);
        let left = Spectral::new(&b).unwrap();
        let [e1, e2, e3] = strain.principal;
        let (ours, theirs) = (strain.to_current(&[e1, e2, e3, 0.0]), left.tensor(&left.log_strain));
        assert!((0..4).all(|i| (ours[i] - theirs[i]).abs() < 1e-14), "{ours:?} {theirs:?}");
    }
}
