//! The answer of finite elements to one tool on one metal, as logarithms that vary smoothly with the metal.
//!
//! Everything is over the elastic modulus E, the deepest depth h_max and F/h²: loading F/(E h²) at shares of
//! h_max, the slope S/(E h_max) where unloading begins, the share of the work that is returned, and the way
//! back over h_max at the shares [`FORCES`] of the peak force. A sharp cone has one number for its loading.

use super::imprint;
use super::interpolation::{linear_between, smooth};
use super::parameters::Metal;
use asperity_calibration::indentation::{FORCES, Indentation, residual_surface, solve};
use asperity_material::units::{Length, Stress};
use asperity_material::{Elastic, StressMeasure};
use asperity_simulation::record::rows::{CurveRow, Phase};
use asperity_simulation::run::{Event, Outcome, Run};
use asperity_simulation::scene::{
    Accuracy, Asperity, Friction, Loading, Material, Output, Scene, Symmetry, Tool, ToolShape,
};
use asperity_simulation::setup::cone::Cone;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::body::fields::SurfacePoint;
use asperity_solver::contact::slip::Friction as Law;
use asperity_solver::point::material::Metal as Point;
use std::ops::ControlFlow;

/// Shares of the deepest depth at which loading is read.
pub const SHARES: [f64; 9] = [0.1, 0.15, 0.22, 0.32, 0.45, 0.6, 0.75, 0.88, 1.0];

/// Numbers after those of the loading: slope, work, recovery.
pub const NUMBERS_AFTER_LOADING: usize = 2 + FORCES.len();

/// The body and tool of a measurement; lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// A sharp cone indents a flat body: slope in degrees.
    Sharp {
        /// Angle between flank and surface, degrees.
        slope_deg: f64,
    },
    /// A cone with a rounded tip indents a flat body.
    Rounded {
        /// Angle between flank and surface, degrees.
        slope_deg: f64,
    },
    /// A ball indents a flat body.
    Ball {
        /// Its radius, m.
        radius: f64,
    },
    /// A plane crushes an asperity.
    Crush {
        /// The asperity.
        asperity: Asperity,
    },
}

impl Geometry {
    /// Shares of the deepest depth at which its loading is read.
    pub fn shares(&self) -> &'static [f64] {
        if matches!(self, Geometry::Sharp { .. }) { &SHARES[SHARES.len() - 1..] } else { &SHARES }
    }

    /// Radius of the contact at a depth without pile-up, m; `None` where no tool leaves an imprint of
    /// revolution in a flat body.
    pub fn plain_radius(&self, depth: f64) -> Option<f64> {
        match self {
            Geometry::Sharp { slope_deg } | Geometry::Rounded { slope_deg } => {
                Some(depth / slope_deg.to_radians().tan())
            }
            Geometry::Ball { radius } => Some((depth * (2.0 * radius - depth)).max(0.0).sqrt()),
            Geometry::Crush { .. } => None,
        }
    }

    /// Powers of the depth with which the force of its loading may grow: from plastic to elastic of a ball
    /// (Meyer's and Hertz's laws), 2 of a sharp cone by similarity, between the two where a tip is round.
    pub fn loading_powers(&self) -> [f64; 2] {
        match self {
            Geometry::Sharp { .. } => [2.0, 2.0],
            Geometry::Rounded { .. } => [1.5, 2.0],
            Geometry::Ball { .. } => [1.0, 1.5],
            Geometry::Crush { .. } => [1.0, 2.0],
        }
    }
}

/// Relative error of a run whose companion came to no end.
const UNKNOWN_ERROR: f64 = 0.05;

/// Inputs of a run of finite elements.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignPoint {
    /// Body and tool.
    pub geometry: Geometry,
    /// Deepest depth, m.
    pub depth: f64,
    /// The metal, the elasticity of the tool left out.
    pub metal: Metal,
    /// E of a body under a rigid tool that is as stiff as this one under this one.
    pub modulus: f64,
    /// Radius of the tip, m.
    pub tip_radius: f64,
    /// The stress that yields.
    pub stress_measure: StressMeasure,
    /// Friction of the tool.
    pub friction: Option<Friction>,
    /// True where the imprint is asked for, not the curve.
    pub imprint: bool,
}

impl DesignPoint {
    /// The law of its friction; `None` of a smooth tool.
    fn friction_law(&self) -> Option<Law> {
        self.friction.and_then(Friction::law)
    }

    /// True where one run of finite elements answers both: curve and imprint of a tool that is no sharp cone.
    /// (The curve of a sharp cone is extrapolated from two runs, its imprint needs one.)
    pub fn shares_the_run_of(&self, other: &DesignPoint) -> bool {
        let sharp = matches!(self.geometry, Geometry::Sharp { .. });
        !sharp && DesignPoint { imprint: other.imprint, ..self.clone() } == *other
    }
}

/// The answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// The logarithms: loading, slope, share of the work, recovery. Of an imprint its numbers.
    pub logarithms: Vec<f64>,
    /// Relative 95 % errors of the loading, of the slope, of what unloading returns.
    pub errors: [f64; 3],
    /// Share of the depth that was reached, below 1 where the path stopped.
    pub reached: f64,
}

/// Answers `questions` at `accuracy`, which are one or [share a run](DesignPoint::shares_the_run_of).
/// Questions of one search share `analyses` of their meshes. An error is the reason why there is no answer.
pub fn respond(
    questions: &[&DesignPoint],
    accuracy: Accuracy,
    analyses: &Analyses,
) -> Vec<Result<Response, String>> {
    let Some(first) = questions.first() else { return Vec::new() };
    if let Geometry::Sharp { slope_deg } = first.geometry {
        let of = |q: &&DesignPoint| {
            if q.imprint {
                imprint_of_a_cone(q, slope_deg, accuracy, analyses)
            } else {
                sharp(q, slope_deg, accuracy, analyses)
            }
        };
        return questions.iter().map(of).collect();
    }
    let mut surface = Vec::new();
    let outcome = run(first, accuracy, analyses, &mut |points| surface = points.to_vec());
    let of = |q: &&DesignPoint| match &outcome {
        Err(reason) => Err(reason.clone()),
        Ok(outcome) if q.imprint => imprint_of_a_body(q, outcome, &surface, accuracy),
        Ok(outcome) => body(q, outcome),
    };
    questions.iter().map(of).collect()
}

fn point(question: &DesignPoint) -> Point {
    Point {
        elastic: Elastic { youngs_modulus: 1.0, ..question.metal.elastic },
        hardening: Some(question.metal.hardening.in_units_of(question.modulus)),
        kinematic_share: 0.0,
        stress_measure: question.stress_measure,
    }
}

/// A sharp cone of this slope that indents the metal asked for.
fn indenting(question: &DesignPoint, slope_deg: f64) -> Cone {
    Cone { slope_deg, indents: true, metal: point(question), friction: question.friction_law() }
}

fn sharp(
    question: &DesignPoint,
    slope_deg: f64,
    accuracy: Accuracy,
    analyses: &Analyses,
) -> Result<Response, String> {
    let cone = indenting(question, slope_deg);
    let (found, errors) = solve(&cone, accuracy, analyses).map_err(|e| e.to_string())?;
    Ok(Response {
        logarithms: of_cone(&found),
        errors: [errors.loading_curvature, errors.stiffness, errors.elastic_share],
        reached: found.reached,
    })
}

fn of_cone(found: &Indentation) -> Vec<f64> {
    let numbers = [found.k_over_e, found.stiffness, found.elastic_share];
    numbers.iter().chain(&found.recovery).map(|x| x.max(1e-12).ln()).collect()
}

/// The scene of a tool that is no sharp cone, unloaded from its deepest depth.
fn scene(question: &DesignPoint, accuracy: Accuracy) -> Scene {
    let elastic = Material::elastic_body(Stress(question.modulus), question.metal.elastic.poissons_ratio);
    let strength = question.metal.hardening.yield_stress().min(0.19 * question.modulus);
    let exponent = question.metal.hardening.exponent(question.modulus).clamp(0.0, 0.99);
    let material = elastic.yielding(Stress(strength), exponent);
    let tip = Length(question.tip_radius);
    let (tool, asperity) = match &question.geometry {
        Geometry::Sharp { slope_deg } => (Tool::cone(*slope_deg), None),
        Geometry::Rounded { slope_deg } => {
            let tip_radius = Some(tip).filter(|t| t.0 > 0.0);
            (Tool { shape: ToolShape::Cone, tip_radius, ..Tool::cone(*slope_deg) }, None)
        }
        Geometry::Ball { radius } => (Tool::sphere(Length(*radius)), None),
        Geometry::Crush { asperity } => (Tool::plane(), Some(asperity.clone())),
    };
    let tool = Tool { friction: question.friction, ..tool };
    let loading = Loading::to_depth(Length(question.depth)).unloaded();
    let scene = Scene::new(Symmetry::Axisymmetric, material, tool, loading).with_accuracy(accuracy);
    asperity.into_iter().fold(scene, Scene::with)
}

/// Runs the scene of `question`, of which `last` hears the surface after unloading.
fn run(
    question: &DesignPoint,
    accuracy: Accuracy,
    analyses: &Analyses,
    last: &mut dyn FnMut(&[SurfacePoint]),
) -> Result<Outcome, String> {
    let output = Output { every: Some(usize::MAX), fields: None };
    let scene = Scene { output, ..scene(question, accuracy) };
    scene.validate().map_err(|e| e.to_string())?;
    // the scene stands for the mesh; the metal is this one exactly
    let metal = point(question);
    let run = Run { metal: Some(&metal), analyses: analyses.clone(), ..Run::new(&scene) };
    let outcome = run.run(&mut |event| {
        if let Event::Fields(frame) = event {
            last(&frame.fields.surface);
        }
        ControlFlow::Continue(())
    });
    let outcome = outcome.map_err(|e| e.to_string())?;
    match &outcome.stopped {
        Some(stopped) => {
            Err(format!("stopped at {:.2} of the depth: {}", stopped.depth / question.depth, stopped.reason))
        }
        None => Ok(outcome),
    }
}

/// The answer of the numbers of an imprint.
fn of_an_imprint(
    question: &DesignPoint,
    numbers: Option<Vec<f64>>,
    accuracy: Accuracy,
) -> Result<Response, String> {
    let similar = matches!(question.geometry, Geometry::Sharp { .. });
    let logarithms = numbers.ok_or("left no imprint")?;
    Ok(Response { logarithms, errors: imprint::errors(accuracy, similar), reached: 1.0 })
}

fn imprint_of_a_cone(
    question: &DesignPoint,
    slope_deg: f64,
    accuracy: Accuracy,
    analyses: &Analyses,
) -> Result<Response, String> {
    let cone = indenting(question, slope_deg);
    let left = residual_surface(&cone, accuracy, analyses).map_err(|e| e.to_string())?;
    of_an_imprint(question, imprint::numbers(left.points, left.contact_radius), accuracy)
}

fn imprint_of_a_body(
    question: &DesignPoint,
    outcome: &Outcome,
    surface: &[SurfacePoint],
    accuracy: Accuracy,
) -> Result<Response, String> {
    let radius = outcome.rows.iter().rfind(|r| r.phase == Phase::Load).map_or(0.0, |r| r.contact_radius);
    let points = surface.iter().map(|p| [p.r / question.depth, p.z / question.depth]).collect();
    of_an_imprint(question, imprint::numbers(points, radius / question.depth), accuracy)
}

fn body(question: &DesignPoint, outcome: &Outcome) -> Result<Response, String> {
    let summary = &outcome.summary;
    let stiffness = summary.unloading_stiffness.ok_or("no unloading stiffness")?;
    let share = summary.elastic_fraction.ok_or("no unloading")?;
    let (modulus, depth) = (question.modulus, question.depth);
    let loading = loading(&outcome.rows, modulus, depth);
    let back = recovery(&outcome.rows, depth);
    let after =
        [stiffness / (modulus * depth), share].into_iter().chain(back).map(|x: f64| x.max(1e-12).ln());
    let errors = summary.errors;
    // of the returned work, relative; an error that is not known is that which draft aims at
    let known = |error: Option<f64>| error.filter(|e| e.is_finite()).unwrap_or(UNKNOWN_ERROR);
    Ok(Response {
        logarithms: loading.into_iter().chain(after).collect(),
        errors: [
            known(Some(errors.force)),
            known(errors.unloading_stiffness),
            known(errors.elastic_fraction.map(|e| e / share.max(1e-12))),
        ],
        reached: 1.0,
    })
}

/// ln(F/(E h²)) at the shares of the depth, linear in ln h between rows.
fn loading(rows: &[CurveRow], modulus: f64, depth: f64) -> Vec<f64> {
    let points: Vec<[f64; 2]> = rows
        .iter()
        .filter(|r| r.phase == Phase::Load && r.depth > 0.0 && r.force > 0.0)
        .map(|r| [(r.depth / depth).ln(), (r.force / (modulus * r.depth * r.depth)).ln()])
        .collect();
    SHARES.iter().map(|share| linear_between(&points, share.ln())).collect()
}

/// Elastic recovery over the depth at each of [`FORCES`].
fn recovery(rows: &[CurveRow], depth: f64) -> Vec<f64> {
    let peak = rows.iter().rposition(|r| r.phase == Phase::Load).unwrap_or(0);
    let top = rows.get(peak).map_or(1.0, |r| r.force);
    // in F^(2/3) the way is nearly a straight line
    let bent = |share: f64| -share.max(0.0).powf(2.0 / 3.0);
    let points: Vec<[f64; 2]> =
        rows[peak..].iter().map(|r| [bent(r.force / top), 1.0 - r.depth / depth]).collect();
    FORCES.iter().map(|force| smooth(&points, bent(*force))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_material::{Hardening, HardeningLaw};

    fn question(geometry: Geometry, yield_stress: f64, imprint: bool) -> DesignPoint {
        let law = Hardening { law: HardeningLaw::Swift, yield_stress, exponent: 0.1, youngs_modulus: 120e9 };
        let elastic = Elastic { youngs_modulus: 120e9, poissons_ratio: 0.3 };
        DesignPoint {
            geometry,
            depth: 1e-6,
            metal: Metal { elastic, hardening: law.into() },
            modulus: 120e9,
            tip_radius: 0.0,
            stress_measure: StressMeasure::default(),
            friction: None,
            imprint,
        }
    }

    #[test]
    fn curve_and_imprint_of_a_ball_share_a_run_of_one_metal() {
        let ball = |yield_stress, imprint| question(Geometry::Ball { radius: 1e-5 }, yield_stress, imprint);
        let curve = ball(4e8, false);
        assert!(curve.shares_the_run_of(&ball(4e8, true)));
        assert!(!curve.shares_the_run_of(&ball(4.1e8, true)));
        let cone = |imprint| question(Geometry::Sharp { slope_deg: 19.7 }, 4e8, imprint);
        assert!(!cone(false).shares_the_run_of(&cone(true)));
    }
}
