use crate::output::nan_for_null;
use asperity_calibration::case::Tool;
use asperity_calibration::dimensionless::{Dimensionless, Formula};
use asperity_calibration::fit::{Angle, DEVELOPED, Slope};
use asperity_calibration::sweep::Sweep;
use asperity_calibration::unloading::{Unloaded, mean};
use asperity_law::HardeningLaw;
use asperity_roughness::PUBLISHED;
use serde::{Deserialize, Serialize};

/// The content of `fit.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// Hardening law of the sweep.
    pub law: HardeningLaw,
    /// Crush or indentation.
    pub tool: Tool,
    /// Poisson's ratio of the sweep.
    pub poissons_ratio: f64,
    /// c of ε_r = c tan β; none where it cannot be determined.
    pub coefficient: Option<f64>,
    /// Its 95 % interval.
    pub ci95: Option<[f64; 2]>,
    /// Why there is no coefficient.
    pub reason: Option<String>,
    /// Every slope.
    pub per_angle: Vec<AngleFit>,
    /// The published c.
    pub published: f64,
    /// c of the developed cases alone.
    pub developed: Option<DevelopedFit>,
    /// K/σ_r and contact ratio as formulas.
    pub dimensionless_function: Option<FunctionFit>,
    /// Mean exponent of the cones that were unloaded.
    pub unloading_exponent: Option<f64>,
    /// Those cones.
    pub unloaded: Vec<UnloadedCone>,
    /// Cases of the sweep.
    pub cases: usize,
    /// Those without a K.
    pub failed: usize,
}

/// The representative strain of one slope.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AngleFit {
    /// Slope, degrees.
    pub beta_deg: f64,
    /// ε_r of least scatter; none where it is not determined.
    pub representative_strain: Option<f64>,
    /// Lower end of its 95 % interval; NaN (`null`) where there is none, as of the other end and the scatter.
    #[serde(deserialize_with = "nan_for_null")]
    pub low: f64,
    /// Upper end.
    #[serde(deserialize_with = "nan_for_null")]
    pub high: f64,
    /// Scatter of ln(K/σ_r) left at the minimum.
    #[serde(deserialize_with = "nan_for_null")]
    pub scatter: f64,
    /// Cases that took part.
    pub cases: usize,
    /// Whether there is a representative strain.
    pub determined: bool,
    /// ε_r of largest correlation.
    pub correlation_strain: Option<f64>,
    /// Weight in c.
    pub weight: f64,
    /// ε_r, scatter and correlation over the strains that were tried.
    pub scatter_curve: Vec<[f64; 3]>,
}

impl From<&Angle> for AngleFit {
    fn from(a: &Angle) -> AngleFit {
        let tan = a.beta_deg.to_radians().tan();
        AngleFit {
            beta_deg: a.beta_deg,
            representative_strain: a.strain,
            low: a.interval[0],
            high: a.interval[1],
            scatter: a.scatter,
            cases: a.cases,
            determined: a.strain.is_some(),
            correlation_strain: a.correlation_strain,
            weight: a.weight,
            scatter_curve: a.curve.iter().map(|m| [m.share * tan, m.scatter, m.correlation]).collect(),
        }
    }
}

/// c of the cases in which plasticity is developed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DevelopedFit {
    /// Least E* tan β/σ_r of these cases.
    pub least_modulus_tan_beta_over_stress: f64,
    /// c.
    pub coefficient: f64,
    /// Its 95 % interval.
    pub ci95: [f64; 2],
    /// Slopes that took part.
    pub slopes: usize,
}

/// The dimensionless function Π of eq. (7).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FunctionFit {
    /// The formula in words.
    pub form: String,
    /// K tan²β/σ_r.
    pub force: Formula,
    /// a tan β/h.
    pub contact_ratio: Formula,
}

/// A cone that was unloaded, and its exponent m of F = F_j (1 - u/u_j)^m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnloadedCone {
    /// Slope, degrees.
    pub beta_deg: f64,
    /// Hardening exponent.
    pub n: Option<f64>,
    /// Young's modulus over yield stress.
    #[serde(rename = "E_over_sy")]
    pub e_over_sy: Option<f64>,
    /// m.
    pub exponent: f64,
}

impl From<&Unloaded> for UnloadedCone {
    fn from(u: &Unloaded) -> UnloadedCone {
        let y = u.case.yielding;
        UnloadedCone {
            beta_deg: u.case.beta_deg,
            n: y.map(|y| y.exponent),
            e_over_sy: y.map(|y| y.e_over_sy),
            exponent: u.exponent,
        }
    }
}

const FORM: &str = "ln(K tan^2(beta)/sigma_r) = a0 + a1 L + a2 L^2 + a3 L^3 + a4 L^4 + tan(beta) (b0 + b1 L + b2 L^2), L = ln(E* tan(beta)/sigma_r)";

impl Fit {
    /// The fit of a sweep; cases and failures are counted by the caller.
    pub(super) fn of(
        sweep: &Sweep,
        angles: &[Angle],
        [slope, developed]: [Option<Slope>; 2],
        function: Option<&Dimensionless>,
        unloaded: &[Unloaded],
    ) -> Fit {
        Fit {
            law: sweep.hardening_law,
            tool: sweep.tool,
            poissons_ratio: sweep.poissons_ratio,
            coefficient: slope.map(|s| s.c),
            ci95: slope.map(|s| s.ci95),
            reason: None,
            per_angle: angles.iter().map(AngleFit::from).collect(),
            published: PUBLISHED,
            developed: developed.map(|s| DevelopedFit {
                least_modulus_tan_beta_over_stress: DEVELOPED,
                coefficient: s.c,
                ci95: s.ci95,
                slopes: s.angles,
            }),
            dimensionless_function: function.map(|f| FunctionFit {
                form: FORM.into(),
                force: f.force,
                contact_ratio: f.contact_ratio,
            }),
            unloading_exponent: mean(unloaded),
            unloaded: unloaded.iter().map(UnloadedCone::from).collect(),
            cases: 0,
            failed: 0,
        }
    }
}
