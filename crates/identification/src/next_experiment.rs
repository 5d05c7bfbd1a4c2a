//! The experiment that would narrow an interval most beside those that were made: a sharp cone, a ball, or
//! the imprint of a curve.

use super::emulator::by_the_atlas;
use super::experiment::{Data, Experiment};
use super::objective::Objective;
use super::parameters::Unknowns;
use super::response::{DesignPoint, Geometry};
use crate::levenberg_marquardt::jacobian;
use nalgebra::DMatrix;
use schemars::JsonSchema;
use serde::Serialize;

/// Another experiment and what it would do.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct NextExperiment {
    /// The experiment in words.
    pub text: String,
    /// Half apex angle of the sharp cone, degrees; absent of a ball and of an imprint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub half_apex_deg: Option<f64>,
    /// Quantities to be measured.
    pub features: Vec<String>,
    /// The unknown that it is for.
    pub parameter: String,
    /// Width of the interval of that unknown with it, over that without.
    pub interval_ratio: f64,
    /// The best experiments of the other kinds, the better one first.
    pub others: Vec<OtherExperiment>,
}

/// The best experiment of another kind.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct OtherExperiment {
    /// The experiment in words.
    pub text: String,
    /// Width of the interval with it, over that without.
    pub interval_ratio: f64,
}

/// Half apex angles that are looked at.
const ANGLES: [f64; 8] = [45.0, 50.0, 55.0, 60.0, 65.0, 75.0, 80.0, 85.0];
/// Noise of a next experiment where no measurement states its own.
const NOISE: f64 = 0.01;
/// Angles nearer than this to one that was measured are no other experiment, degrees.
const MIN_ANGLE_DISTANCE: f64 = 4.0;
/// Contact radii over that of a ball at which it is taken for a cone that meets the surface as steeply: from
/// first plastic flow to where its curve would end.
const BALL_CONTACTS: [f64; 3] = [0.1, 0.2, 0.4];
/// Standard deviation of the height of a pile-up over the depth: of a polished metal, by a profile.
const PILE_UP_ERROR: f64 = 0.01;

/// Names of the quantities of a curve, those that an experiment like the given ones would measure.
const FEATURES: [&str; 3] = ["loading_curvature", "unloading_slope", "plastic_work_ratio"];

/// Those of [`FEATURES`] that `experiments` measured: a next experiment is expected to measure no more.
fn measured_features(experiments: &[Experiment]) -> [bool; 3] {
    let of = |e: &Experiment| match &e.data {
        Data::Features { loading_curvature, unloading_slope, plastic_work_ratio } => {
            [loading_curvature.is_some(), unloading_slope.is_some(), plastic_work_ratio.is_some()]
        }
        Data::Curve(curve) => [true, !curve.unloading.is_empty(), !curve.unloading.is_empty()],
        Data::Imprint(_) | Data::ImprintNumbers(_) => [false; 3],
    };
    let all = experiments.iter().map(of).fold([false; 3], |a, b| [0, 1, 2].map(|k| a[k] || b[k]));
    if all == [false; 3] { [true; 3] } else { all }
}

/// An experiment that may be next.
enum Candidate<'a> {
    /// A sharp cone of this half apex angle, degrees.
    Cone(f64),
    /// A ball.
    Ball,
    /// The imprint of a curve that was measured under a tool which meets the surface at this slope (tan).
    Imprint(&'a Experiment, f64),
}

impl Candidate<'_> {
    fn text(&self) -> String {
        match self {
            Candidate::Cone(angle) => format!("a sharp cone of {angle:.0} degrees half apex angle"),
            Candidate::Ball => format!("a ball to a contact of {} radii", BALL_CONTACTS[2]),
            Candidate::Imprint(of, _) => format!("the imprint of {}", of.name),
        }
    }

    fn is_of_the_kind_of(&self, other: &Candidate<'_>) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }

    /// The quantities that it would measure where curves tell `features`, over their standard deviations of
    /// which that of a force is `error`.
    fn measures(&self, question: &DesignPoint, features: [bool; 3], error: f64) -> Vec<f64> {
        let by_a_cone = |slope_deg: f64, features: [bool; 3]| {
            let question = DesignPoint { geometry: Geometry::Sharp { slope_deg }, ..question.clone() };
            let logs = by_the_atlas(&question);
            let modulus = question.modulus.ln();
            let all =
                [(logs[0] + modulus) / error, (logs[1] + modulus) / (2.0 * error), logs[2] / (3.0 * error)];
            all.into_iter().zip(features).filter(|(_, has)| *has).map(|(x, _)| x).collect::<Vec<_>>()
        };
        match self {
            Candidate::Cone(angle) => by_a_cone(90.0 - angle, features),
            Candidate::Ball => {
                let at = |contact: &f64| {
                    // unloading begins at the peak alone
                    let last = *contact == BALL_CONTACTS[2];
                    by_a_cone(contact.atan().to_degrees(), [true, last && features[1], last && features[2]])
                };
                BALL_CONTACTS.iter().flat_map(at).collect()
            }
            Candidate::Imprint(_, slope) => vec![pile_up(question, *slope) / PILE_UP_ERROR],
        }
    }

    /// Their names.
    fn features(&self, features: [bool; 3]) -> Vec<String> {
        match self {
            Candidate::Cone(_) => {
                let told = FEATURES.iter().zip(features).filter(|(_, has)| *has);
                told.map(|(name, _)| name.to_string()).collect()
            }
            Candidate::Ball => vec!["curve".into()],
            Candidate::Imprint(..) => vec!["imprint".into()],
        }
    }
}

/// Height of the pile-up over the depth, about: least squares through 64 sharp cones by finite elements at
/// `draft` (slopes of 10 to 40°, E/σ_y 40 to 700, n to 0.45, ν 0.3), which it meets to 0.013 rms. It serves
/// to plan an experiment, not to judge one. Beyond those cones it stays.
fn pile_up(question: &DesignPoint, slope: f64) -> f64 {
    let law = &question.metal.hardening;
    let strength = law.yield_stress().min(question.modulus);
    let x = (question.modulus * slope / strength).ln().clamp(PILE_UP_KNOWN[0], PILE_UP_KNOWN[1]);
    let n = law.exponent(question.modulus).clamp(0.0, PILE_UP_KNOWN[2]);
    let terms = [1.0, x, n, x * x, x * n, n * n, slope, slope * x, slope * n];
    PILE_UP.iter().zip(terms).map(|(c, term)| c * term).sum()
}

/// Coefficients of 1, x, n, x², x n, n², t, t x and t n with x = ln(E t/σ_y) and the slope t.
const PILE_UP: [f64; 9] = [-0.109, 0.065, -0.025, -0.0017, -0.130, 0.658, 0.057, 0.002, -0.113];
/// Least and largest x, and largest n, of the cones behind them.
const PILE_UP_KNOWN: [f64; 3] = [1.95, 6.38, 0.45];

/// Those that the given measurements leave to be made.
fn candidates(experiments: &[Experiment]) -> Vec<Candidate<'_>> {
    let measured = |angle: f64| {
        experiments.iter().any(|e| match e.geometry {
            Geometry::Sharp { slope_deg } => (90.0 - slope_deg - angle).abs() < MIN_ANGLE_DISTANCE,
            _ => false,
        })
    };
    let cones = ANGLES.iter().copied().filter(|angle| !measured(*angle)).map(Candidate::Cone);
    let has_ball = experiments.iter().any(|e| matches!(e.geometry, Geometry::Ball { .. }));
    let ball = Some(Candidate::Ball).filter(|_| !has_ball);
    let has_imprint = |curve: usize| experiments.iter().any(|e| e.is_imprint() && e.curve == curve);
    let imprint =
        experiments.iter().filter(|e| !has_imprint(e.curve) && e.pyramid.is_none()).filter_map(|e| {
            let slope = match e.geometry {
                Geometry::Sharp { slope_deg } | Geometry::Rounded { slope_deg } => {
                    slope_deg.to_radians().tan()
                }
                Geometry::Ball { radius } => e.geometry.plain_radius(e.depth)? / radius,
                Geometry::Crush { .. } => return None,
            };
            Some(Candidate::Imprint(e, slope))
        });
    cones.chain(ball).chain(imprint).collect()
}

/// The experiment that would narrow the interval of unknown `of` most by the quantities that the given
/// measurements have, by the atlas of cones.
pub fn next_experiment(
    objective: &Objective<'_>,
    experiments: &[Experiment],
    unknowns: &Unknowns,
    point: &[f64],
    of: usize,
) -> Option<NextExperiment> {
    let bounds = objective.bounds();
    let slopes = jacobian(objective, point, &bounds)?;
    // the bounds themselves are a weak measurement, without which nothing that is not seen had a width
    let mut normal = slopes.tr_mul(&slopes);
    for (i, parameter) in unknowns.parameters.iter().enumerate() {
        normal[(i, i)] += 12.0 / parameter.width().powi(2).max(1e-12);
    }
    let width = |matrix: &DMatrix<f64>| Some(matrix.clone().try_inverse()?[(of, of)].sqrt());
    let now = width(&normal)?;
    let features = measured_features(experiments);
    let first = experiments.first()?.design_point(unknowns, point)?;
    let error = experiments.iter().map(|e| e.noise).fold(NOISE, f64::max).hypot(0.01);
    let ratio = |candidate: &Candidate<'_>| {
        let at = |point: &[f64]| {
            let metal = unknowns.metal(point)?;
            let modulus = metal.elastic.youngs_modulus;
            let question = DesignPoint { imprint: false, friction: None, modulus, metal, ..first.clone() };
            Some(candidate.measures(&question, features, error))
        };
        let more = jacobian(&at, point, &bounds)?;
        Some(width(&(&normal + more.tr_mul(&more)))? / now)
    };
    let mut ranked: Vec<(Candidate<'_>, f64)> =
        candidates(experiments).into_iter().filter_map(|c| ratio(&c).map(|r| (c, r))).collect();
    ranked.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut best: Vec<(Candidate<'_>, f64)> = Vec::new();
    for (candidate, ratio) in ranked {
        if !best.iter().any(|(other, _)| other.is_of_the_kind_of(&candidate)) {
            best.push((candidate, ratio));
        }
    }
    let mut best = best.into_iter();
    let (candidate, interval_ratio) = best.next()?;
    let other = |(candidate, interval_ratio): (Candidate<'_>, f64)| OtherExperiment {
        text: candidate.text(),
        interval_ratio,
    };
    Some(NextExperiment {
        text: candidate.text(),
        half_apex_deg: if let Candidate::Cone(angle) = candidate { Some(angle) } else { None },
        features: candidate.features(features),
        parameter: unknowns.parameters[of].name.clone(),
        interval_ratio,
        others: best.map(other).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::Metal;
    use asperity_material::{Elastic, Hardening, HardeningLaw, StressMeasure};

    /// Three metals of one loading curvature under a cone of 70.3°, E 120 GPa, whose pile-up by finite
    /// elements at `standard` is 0.158, 0.096 and 0.053 of the depth: an imprint parts them.
    #[test]
    fn pile_up_parts_metals_of_one_loading_curvature() {
        for (yield_stress, exponent, computed) in
            [(499e6, 0.05, 0.158), (400e6, 0.15, 0.096), (291e6, 0.25, 0.053)]
        {
            let law = Hardening { law: HardeningLaw::Swift, yield_stress, exponent, youngs_modulus: 120e9 };
            let question = DesignPoint {
                geometry: Geometry::Sharp { slope_deg: 19.7 },
                depth: 1e-6,
                metal: Metal {
                    elastic: Elastic { youngs_modulus: 120e9, poissons_ratio: 0.3 },
                    hardening: law.into(),
                },
                modulus: 120e9,
                tip_radius: 0.0,
                stress_measure: StressMeasure::Cauchy,
                friction: None,
                imprint: false,
            };
            let about = pile_up(&question, 19.7_f64.to_radians().tan());
            assert!((about - computed).abs() < 0.02, "{yield_stress} {about} {computed}");
        }
    }
}
