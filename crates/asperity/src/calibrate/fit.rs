//! `fit.json`: the representative strain of every slope, the coefficient, and the force as a formula.

#![expect(non_snake_case, reason = "a name holds its symbols, as in the files")]

use crate::results::output::{nan_for_null, row};
use asperity_calibration::case::Tool;
use asperity_calibration::dimensionless::{Dimensionless, Formula};
use asperity_calibration::fit::{
    Angle, DEVELOPED_PLASTICITY, ModelChoice, StrainCoefficient, model_interval,
};
use asperity_calibration::row::Row;
use asperity_calibration::sweep::Sweep;
use asperity_calibration::unloading::{Unloaded, mean};
use asperity_material::HardeningLaw;
use asperity_roughness::PUBLISHED_COEFFICIENT;

row! {
    /// The content of `fit.json`.
    Fit(
        sweep: &Sweep, rows: &[Row], angles: &[Angle], all: Option<StrainCoefficient>, choices: &[ModelChoice],
        developed: Option<StrainCoefficient>, function: Option<&Dimensionless>, unloaded: &[Unloaded], reason: Option<String>
    ) {
        /// Hardening law of the sweep.
        law: HardeningLaw = sweep.hardening_law,
        /// Crush or indentation.
        tool: Tool = sweep.tool,
        /// Poisson's ratio of the sweep.
        poissons_ratio: f64 = sweep.poissons_ratio,
        /// c of ε_r = c tan β, by least squares; none where it cannot be determined.
        coefficient: Option<f64> = all.map(|a| a.c),
        /// c of the line through the origin that fits ε_r over tan β by least squares: steep cones count most.
        coefficient_least_squares: Option<f64> = all.map(|a| a.c),
        /// The mean of ε_r/tan β: all slopes count alike.
        coefficient_mean_ratio: Option<f64> = all.map(|a| a.mean_ratio),
        /// 95 % bootstrap interval of c: cases drawn again with replacement, K shifted by its error, the same choice of cases and law.
        ci95: Option<[f64; 2]> = all.map(|a| a.ci95),
        /// Interval of the model: least and largest c that other choices of metals and slopes give; the ends of what is searched, 0.005 and 1.2, where one of them determines no c.
        model_interval: Option<[f64; 2]> = all.map(|a| model_interval(a.c, choices)),
        /// Those choices and their c. No other law is among them: a sweep has one.
        model_choices: Vec<PartFit> = if all.is_some() { choices.iter().map(PartFit::new).collect() } else { Vec::new() },
        /// The reason why there is no coefficient.
        reason: Option<String> = reason,
        /// Every slope.
        per_angle: Vec<AngleFit> = angles.iter().map(AngleFit::new).collect(),
        /// The published c.
        published: f64 = PUBLISHED_COEFFICIENT,
        /// c of the developed cases alone.
        developed: Option<DevelopedFit> = developed.map(DevelopedFit::new),
        /// K/σ_r and contact ratio as formulas.
        dimensionless_function: Option<FunctionFit> = function.map(FunctionFit::new),
        /// Mean exponent of the cones that were unloaded.
        unloading_exponent: Option<f64> = mean(unloaded),
        /// Those cones.
        unloaded: Vec<UnloadedCone> = unloaded.iter().map(UnloadedCone::new).collect(),
        /// Cases of the sweep.
        cases: usize = rows.len(),
        /// Those without a K.
        failed: usize = rows.iter().filter(|r| r.outcome.is_err()).count(),
    }
}

row! {
    /// c of a part of the cases.
    PartFit(choice: &ModelChoice) {
        /// Name of the part.
        part: String = choice.part.clone(),
        /// Its c by least squares; none where it determines none.
        coefficient: Option<f64> = choice.c,
    }
}

row! {
    /// The representative strain of one slope.
    AngleFit(angle: &Angle) {
        /// Slope, degrees.
        beta_deg: f64 = angle.beta_deg,
        /// ε_r of least scatter; none where it is not determined.
        representative_strain: Option<f64> = angle.strain,
        /// Lower end of its 95 % interval; NaN (`null`) where there is none, as of the other end and the scatter.
        #[serde(deserialize_with = "nan_for_null")]
        low: f64 = angle.interval[0],
        /// Upper end.
        #[serde(deserialize_with = "nan_for_null")]
        high: f64 = angle.interval[1],
        /// Scatter of ln(K/σ_r) left at the minimum.
        #[serde(deserialize_with = "nan_for_null")]
        scatter: f64 = angle.scatter,
        /// Cases that took part.
        cases: usize = angle.cases,
        /// True where there is a representative strain.
        determined: bool = angle.strain.is_some(),
        /// ε_r of largest correlation.
        correlation_strain: Option<f64> = angle.correlation_strain,
        /// Weight of ε_r/tan β in c: tan²β, 0 where there is no representative strain.
        weight: f64 = angle.strain.map_or(0.0, |_| angle.beta_deg.to_radians().tan().powi(2)),
        /// ε_r, scatter and correlation over the strains that were tried.
        scatter_curve: Vec<[f64; 3]> = {
            let tan = angle.beta_deg.to_radians().tan();
            angle.curve.iter().map(|m| [m.share * tan, m.scatter, m.correlation]).collect()
        },
    }
}

row! {
    /// c of the cases in which plasticity is developed.
    #[derive(Copy)]
    DevelopedFit(developed: StrainCoefficient) {
        /// Least E* tan β/σ_r of these cases.
        least_modulus_tan_beta_over_stress: f64 = DEVELOPED_PLASTICITY,
        /// c.
        coefficient: f64 = developed.c,
        /// Its 95 % interval of the arithmetic.
        ci95: [f64; 2] = developed.ci95,
        /// Slopes that took part.
        slopes: usize = developed.angles,
    }
}

row! {
    /// The dimensionless function Π of eq. (7).
    FunctionFit(function: &Dimensionless) {
        /// The formula in words.
        form: String = FORM.into(),
        /// K tan²β/σ_r.
        force: Formula = function.force,
        /// a tan β/h.
        contact_ratio: Formula = function.contact_ratio,
    }
}

const FORM: &str = "ln(K tan^2(beta)/sigma_r) = a0 + a1 L + a2 L^2 + a3 L^3 + a4 L^4 + tan(beta) (b0 + b1 L + b2 L^2), L = ln(E* tan(beta)/sigma_r)";

row! {
    /// A cone that was unloaded, and its exponent m of F = F_j (1 - u/u_j)^m.
    #[derive(Copy)]
    UnloadedCone(unloaded: &Unloaded) {
        /// Slope, degrees.
        beta_deg: f64 = unloaded.case.beta_deg,
        /// Hardening exponent.
        n: Option<f64> = unloaded.case.yielding.map(|y| y.exponent),
        /// Young's modulus over yield stress.
        E_over_sy: Option<f64> = unloaded.case.yielding.map(|y| y.e_over_sy),
        /// m.
        exponent: f64 = unloaded.exponent,
    }
}
