//! Hencky elasticity: an energy in the elastic logarithmic strain ½ ln b_e. Its stress is Kirchhoff's τ.
//!
//! The state keeps b_e - I, not ln b_e: the update then needs one spectral decomposition instead of two, and
//! tiny strains keep their digits.

use crate::point::failure::Failure;
use crate::point::tensor::{GradientForm, Sym, trace, with_geometric_term};
use asperity_material::{Elastic, HardeningCurve, HardeningPoint, StressMeasure};
use asperity_numerics::lanes::{Lanes, Real};

/// Elastic constants and, for a material that yields, its hardening curve; all in one unit of stress; a run
/// takes E = 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Metal {
    /// Elastic constants.
    pub elastic: Elastic,
    /// `None`: the body stays elastic and no return mapping runs.
    pub hardening: Option<HardeningCurve>,
    /// Share of the hardening that moves the yield surface; the rest makes it grow. 0: isotropic, 1:
    /// kinematic.
    pub kinematic_share: f64,
    /// The stress that the hardening curve speaks of.
    pub stress_measure: StressMeasure,
}

/// State of a material point, or of several side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointState<T = f64> {
    /// b_e - I of the elastic left Cauchy-Green tensor b_e, current frame.
    pub b_minus_i: Sym<T>,
    /// Accumulated plastic strain ε_p.
    pub plastic_strain: T,
    /// Yield stress at that strain, in the measure of the material.
    pub yield_stress: T,
    /// Ĵ: the Kirchhoff stress yields at Ĵ times the yield stress. Constant within an increment, which so
    /// keeps a potential; 1 where the yield stress is Kirchhoff's.
    pub yield_scale: T,
}

impl PointState<Lanes> {
    /// Four points side by side.
    #[inline(always)]
    pub fn side_by_side(points: &[PointState]) -> Self {
        let component = |i: usize| Lanes::each(|q| points[q].b_minus_i[i]);
        PointState {
            b_minus_i: [component(0), component(1), component(2), component(3)],
            plastic_strain: Lanes::each(|q| points[q].plastic_strain),
            yield_stress: Lanes::each(|q| points[q].yield_stress),
            yield_scale: Lanes::each(|q| points[q].yield_scale),
        }
    }

    /// The point in `lane`.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> PointState {
        let b = &self.b_minus_i;
        PointState {
            b_minus_i: [b[0].0[lane], b[1].0[lane], b[2].0[lane], b[3].0[lane]],
            plastic_strain: self.plastic_strain.0[lane],
            yield_stress: self.yield_stress.0[lane],
            yield_scale: self.yield_scale.0[lane],
        }
    }
}

impl Metal {
    /// True where points have history variables beside their state (see `kinematic_hardening`).
    pub fn has_back_stress(&self) -> bool {
        self.kinematic_share > 0.0
    }

    /// True where the yield stress is Cauchy's.
    pub fn yields_by_true_stress(&self) -> bool {
        self.stress_measure == StressMeasure::Cauchy
    }

    /// The same material without a yield stress: what a point does while it is elastic.
    pub fn elastic_part(&self) -> Metal {
        Metal { hardening: None, ..*self }
    }

    /// The stress-free virgin state.
    pub fn virgin(&self) -> PointState {
        let yield_stress = self.hardening.as_ref().map_or(f64::INFINITY, HardeningCurve::yield_stress);
        PointState { b_minus_i: [0.0; 4], plastic_strain: 0.0, yield_stress, yield_scale: 1.0 }
    }
}

/// A left Cauchy-Green tensor in its principal frame: b = I + Σ μ_A m_A.
#[derive(Clone, Copy, Debug)]
pub struct Spectral<T = f64> {
    /// Logarithmic strains ½ ln(1 + μ): two in the plane, then hoop.
    pub log_strain: [T; 3],
    /// (cos 2α, sin 2α) of the first in-plane direction.
    pub double_angle: [T; 2],
    /// atanh(x)/x, x the relative difference of the in-plane eigenvalues: 1 where they coincide.
    pub shear_factor: T,
}

impl<T: Real> Spectral<T> {
    /// Decomposes b - I.
    ///
    /// # Errors
    /// A tensor b that is not positive definite.
    #[inline(always)]
    pub fn new(b_minus_i: &Sym<T>) -> Result<Spectral<T>, Failure> {
        let (zero, one) = (T::splat(0.0), T::splat(1.0));
        let (mean, half) = ((b_minus_i[0] + b_minus_i[1]) * 0.5, (b_minus_i[0] - b_minus_i[1]) * 0.5);
        let radius = (half * half + b_minus_i[3] * b_minus_i[3]).sqrt();
        let x = radius / (mean + 1.0);
        let area = b_minus_i[0] + b_minus_i[1] + b_minus_i[0] * b_minus_i[1] - b_minus_i[3] * b_minus_i[3];
        let sound = mean.is_above(-one) & one.is_above(x) & b_minus_i[2].is_above(-one) & area.is_above(-one);
        if !T::all(sound & T::splat(f64::INFINITY).is_above(radius)) {
            return Err(Failure::NotPositive);
        }
        let turned = radius.is_above(zero);
        let double_angle =
            [T::select(turned, half / radius, one), T::select(turned, b_minus_i[3] / radius, zero)];
        // 2 atanh x = ln(1 + 2x/(1 - x)) loses nothing for small x, nor does its quotient by x
        let twice = (x * 2.0 / (one - x)).ln_1p();
        let shear_factor = T::select(turned, twice * 0.5 / x, one);
        let (middle, difference) = (area.ln_1p() * 0.25, twice * 0.25);
        Ok(Spectral {
            log_strain: [middle + difference, middle - difference, b_minus_i[2].ln_1p() * 0.5],
            double_angle,
            shear_factor,
        })
    }

    /// The tensor with principal values `v` in this frame.
    #[inline(always)]
    pub fn tensor(&self, v: &[T; 3]) -> Sym<T> {
        let (mean, half) = ((v[0] + v[1]) * 0.5, (v[0] - v[1]) * 0.5);
        let [c, s] = self.double_angle;
        [mean + half * c, mean - half * c, v[2], half * s]
    }

    /// ∂²W/∂∇u²: the spatial tangent with the geometric term, from principal stresses `tau`, the moduli
    /// `moduli` = ∂τ_A/∂ε_B, and `shear` = G times the share of the trial deviator that is left.
    ///
    /// a(g, g') = Σ_AB (D_AB - 2τ_A δ_AB) g_AA g'_BB + c_s γ γ' + Σ g_iA τ_A g'_iA, with the in-plane shear
    /// modulus c_s = (τ₁λ₂² - τ₂λ₁²)/(λ₁² - λ₂²) = G' atanh(x)/x - ½(τ₁ + τ₂) (Simo 1992; de Souza Neto et
    /// al., ch. 14).
    #[inline(always)]
    pub fn tangent(
        &self,
        tau: &[T; 3],
        moduli: &[[T; 3]; 3],
        shear: T,
        geometric: &Sym<T>,
    ) -> GradientForm<T> {
        let ([c, s], zero) = (self.double_angle, T::splat(0.0));
        let (ahead, aside, skew) = ((c + 1.0) * 0.5, (-c + 1.0) * 0.5, s * 0.5);
        let first = [ahead, skew, skew, aside];
        let second = [aside, -skew, -skew, ahead];
        let gamma = [-s, c, c, s];
        let c_s = shear * self.shear_factor - (tau[0] + tau[1]) * 0.5;
        let m11 = moduli[0][0] - tau[0] * 2.0;
        let (m22, m12) = (moduli[1][1] - tau[1] * 2.0, moduli[0][1]);
        let mut form = [[zero; 5]; 5];
        for i in 0..4 {
            let (p, q) = (m11 * first[i] + m12 * second[i], m12 * first[i] + m22 * second[i]);
            let t = c_s * gamma[i];
            for j in 0..=i {
                form[i][j] = p * first[j] + q * second[j] + t * gamma[j];
            }
            form[4][i] = moduli[0][2] * first[i] + moduli[1][2] * second[i];
        }
        form[4][4] = moduli[2][2] - tau[2] * 2.0;
        with_geometric_term(form, geometric)
    }
}

/// Elastic energy per reference volume, ½λ(tr ε)² + G ε:ε, of the state b_e - I.
#[inline(always)]
pub fn elastic_energy<T: Real>(elastic: &Elastic, b_minus_i: &Sym<T>) -> T {
    let Ok(spectral) = Spectral::new(b_minus_i) else { return T::splat(f64::NAN) };
    let e = spectral.log_strain;
    let volume = e[0] + e[1] + e[2];
    let (g, k) = (elastic.shear_modulus(), elastic.bulk_modulus());
    volume * volume * (0.5 * (k - 2.0 / 3.0 * g)) + (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) * g
}

/// Plastic work per reference volume from the state `old` to `new`, Ĵ∫σ_y dε_p.
pub fn plastic_work(hardening: &HardeningCurve, old: &PointState, new: &PointState) -> f64 {
    let work = |state: &PointState| {
        let PointState { plastic_strain, yield_stress, .. } = *state;
        hardening.plastic_work(&HardeningPoint { plastic_strain, yield_stress, slope: 0.0 })
    };
    new.yield_scale * (work(new) - work(old))
}

/// Kirchhoff stress of the state b_e - I.
pub fn stress(elastic: &Elastic, b_minus_i: &Sym) -> Sym {
    let Ok(spectral) = Spectral::new(b_minus_i) else { return [f64::NAN; 4] };
    let e = spectral.log_strain;
    let (g, k) = (elastic.shear_modulus(), elastic.bulk_modulus());
    let volume = (k - 2.0 / 3.0 * g) * (e[0] + e[1] + e[2]);
    spectral.tensor(&[volume + 2.0 * g * e[0], volume + 2.0 * g * e[1], volume + 2.0 * g * e[2]])
}

/// Elastic volume ratio J = det F (plastic flow keeps volume) of the state b_e - I.
pub fn volume_ratio(b_minus_i: &Sym) -> f64 {
    let plane = (1.0 + b_minus_i[0]) * (1.0 + b_minus_i[1]) - b_minus_i[3] * b_minus_i[3];
    (plane * (1.0 + b_minus_i[2])).sqrt()
}

/// Mean of the principal stresses, negative in compression.
pub fn hydrostatic(tau: &Sym) -> f64 {
    trace(tau) / 3.0
}
