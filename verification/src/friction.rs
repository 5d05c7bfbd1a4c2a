//! An elastic half-space under a tool to which it sticks, in closed form; scenes with friction and what came
//! of them.

use crate::single_asperity::crush;
use asperity_material::units::{Length, Stress};
use asperity_simulation::run::{CrushError, Event, Outcome, Run};
use asperity_simulation::scene::{Accuracy, Friction, Loading, Material, Scene, Substrate, Symmetry, Tool};
use std::error::Error;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// The ratio of Dundurs of an elastic half-space under a rigid tool.
fn coupling(poissons_ratio: f64) -> f64 {
    (1.0 - 2.0 * poissons_ratio) / (2.0 * (1.0 - poissons_ratio))
}

/// C: stiffness of a contact that sticks over that of a smooth one of the same radius, 2E*a (Mossakovskii
/// 1963, Spence 1968).
pub fn stiffness_ratio(poissons_ratio: f64) -> f64 {
    let beta = coupling(poissons_ratio);
    if beta < 1e-6 { 1.0 } else { 0.5 * (3.0 - 4.0 * poissons_ratio).ln() / beta }
}

/// Share of the travel by which the surface at the edge of contact sinks before it touches, under a tool of
/// the outline x^`power` (1: a cone, 2: a ball) pressed into a half-space that sticks (`sticks`) or not.
///
/// A punch of radius a that goes down by 1 moves the surface outside of it by ∫ χ(t)/√(r² - t²) dt over 0 ≤ t
/// ≤ a, with χ = 2/π under a smooth one and (2/π)/√(1 - β²) cos(θ ln((a + t)/(a - t))), tanh πθ = β, under
/// one that sticks: shear inside of the contact moves nothing outside of it. Contacts of self-similar tools
/// are sums of such punches with the travel h ∝ a^power.
fn sunk(poissons_ratio: f64, power: u32, sticks: bool) -> f64 {
    let beta = coupling(poissons_ratio);
    let theta = if sticks { beta.atanh() / PI } else { 0.0 };
    let strength = if sticks { 2.0 / PI / (1.0 - beta * beta).sqrt() } else { 2.0 / PI };
    // ∫ n sⁿ/√(1 - s² t²) ds over 0 ≤ s ≤ 1
    let sum = |t: f64| match power {
        1 => (1.0 - (1.0 - t * t).sqrt()) / (t * t),
        _ if t < 1e-3 => 2.0 / 3.0,
        _ => (t.asin() - t * (1.0 - t * t).sqrt()) / t.powi(3),
    };
    let count = 4000;
    let share = |i: i32| {
        // points crowd to the edge, where the cosine turns ever faster
        let from_end = 1.0 - (f64::from(i) + 0.5) / f64::from(count);
        let t = 1.0 - from_end.powi(3);
        let turn = (theta * ((1.0 + t) / (1.0 - t)).ln()).cos();
        3.0 * from_end * from_end / f64::from(count) * strength * turn * sum(t)
    };
    (0..count).map(share).sum()
}

/// Force under a cone (`power` 1) or a ball (2) that sticks over that under a smooth one: at equal contact
/// radius, and at equal depth.
pub fn force_ratios(poissons_ratio: f64, power: u32) -> [f64; 2] {
    let stiffer = stiffness_ratio(poissons_ratio);
    let [smooth, sticking] = [false, true].map(|sticks| 1.0 - sunk(poissons_ratio, power, sticks));
    // dF/dh = C 2E*a, and F ∝ h^(1 + 1/power)
    let at_radius = stiffer * smooth / sticking;
    let n = f64::from(power);
    [at_radius, stiffer * (stiffer / at_radius).powf(1.0 / n)]
}

/// A gentle cone, 0.3°, or a ball at a/R = 0.006, with this friction on an elastic body.
pub fn elastic(poissons_ratio: f64, power: u32, friction: Option<Friction>) -> Scene {
    let material = Material::elastic_body(Stress(150e9), poissons_ratio);
    let (tool, depth) = match power {
        1 => (Tool::cone(0.3), Length(1e-7)),
        _ => (Tool::sphere(Length(60e-6)), Length(2e-9)),
    };
    with_friction(Scene::new(Symmetry::Axisymmetric, material, tool, Loading::to_depth(depth)), friction)
}

/// The scene with this friction, without fields.
pub fn with_friction(mut scene: Scene, friction: Option<Friction>) -> Scene {
    scene.tool.friction = friction;
    scene.output.every = Some(0);
    scene
}

/// E/σ_y of [`rigid_plastic`] metal under a punch, and E tan β/σ_y under a wedge of the slope β.
pub const STIFF: [f64; 2] = [10_000.0, 2_000.0];

/// Yield stress of [`rigid_plastic`] metal, Pa.
pub const STRENGTH: f64 = 200e6;

/// Metal that does not harden, so stiff that nearly all of it flows, under this tool.
pub fn rigid_plastic(
    symmetry: Symmetry,
    stiffness: f64,
    poissons_ratio: f64,
    tool: Tool,
    depth: f64,
) -> Scene {
    let metal = Material::elastic_body(Stress(stiffness * STRENGTH), poissons_ratio);
    let loading = Loading::to_depth(Length(depth));
    let mut scene = Scene::new(symmetry, metal.yielding(Stress(STRENGTH), 0.0), tool, loading);
    if symmetry == Symmetry::PlaneStrain {
        let size = Some(Length(400e-6));
        scene.substrate = Some(Substrate { radius: size, depth: size });
    }
    scene
}

/// Mean over the second half of the depth of force over width and shear yield stress, under a wedge of this
/// slope (degrees) with friction.
///
/// # Errors
/// The run could not begin, or stopped.
pub fn computed_wedge(slope: f64, friction: f64, accuracy: Accuracy) -> Result<f64, Box<dyn Error>> {
    let stiffness = STIFF[1] / slope.to_radians().tan();
    let scene = rigid_plastic(Symmetry::PlaneStrain, stiffness, 0.49, Tool::cone(slope), 2e-6)
        .with_accuracy(accuracy);
    let friction = (friction > 0.0).then_some(Friction::Coefficient(friction));
    let outcome = crush(&with_friction(scene, friction))?;
    if let Some(stopped) = outcome.stopped {
        return Err(format!("the wedge of {slope}° stopped: {}", stopped.reason).into());
    }
    let half = 0.5 * outcome.summary.peak_depth;
    let deep: Vec<f64> =
        outcome.rows.iter().filter(|row| row.depth >= half).map(|row| row.mean_pressure).collect();
    Ok(deep.iter().sum::<f64>() / deep.len() as f64 * 3_f64.sqrt() / STRENGTH)
}

/// Force (N) of the run at this share of its depth, on the way in.
pub fn force_at(outcome: &Outcome, share: f64) -> f64 {
    let depth = share * outcome.summary.peak_depth;
    let pair = outcome.rows.windows(2).find(|pair| pair[1].depth >= depth);
    pair.map_or(f64::NAN, |pair| {
        let part = (depth - pair[0].depth) / (pair[1].depth - pair[0].depth);
        pair[0].force + part * (pair[1].force - pair[0].force)
    })
}

/// Force under a tool that sticks over that under a smooth one at equal depth, as computed.
///
/// # Errors
/// A run could not begin.
pub fn computed_force_ratio(poissons_ratio: f64, power: u32) -> Result<f64, CrushError> {
    let force =
        |friction| crush(&elastic(poissons_ratio, power, friction)).map(|outcome| force_at(&outcome, 0.98));
    Ok(force(Some(Friction::Sticking))? / force(None)?)
}

/// Radius of the part of the contact that sticks over that of the contact, at each of the field frames of a
/// run that touches, every tenth increment. Where sticking ends the traction is small, and so is the elastic
/// slip that the penalty is to hold it with: the penetration is a quarter of that of `standard`.
///
/// # Errors
/// The run could not begin.
pub fn sticking_shares(mut scene: Scene) -> Result<Vec<f64>, CrushError> {
    scene.output.every = Some(10);
    scene.numerics.elements_in_contact = Some(60);
    scene.numerics.penetration = Some(1e-3);
    let mut shares = Vec::new();
    Run::new(&scene).run(&mut |event| {
        if let Event::Fields(frame) = event {
            let farthest = |holds: &dyn Fn(f64, bool) -> bool| {
                let points = frame.fields.surface.iter();
                let counted = points.filter(|p| holds(p.pressure, p.sticks == Some(true)));
                counted.fold(0.0, |most: f64, p| most.max(p.r))
            };
            let (stuck, touching) = (farthest(&|_, sticks| sticks), farthest(&|pressure, _| pressure > 0.0));
            shares.extend((touching > 0.0).then(|| stuck / touching));
        }
        ControlFlow::Continue(())
    })?;
    Ok(shares)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mossakovskii 1963 and Spence 1968, to the digits in which they are quoted.
    #[test]
    fn the_closed_forms_are_the_published_ones() {
        let close = |nu: f64, power, [at_radius, at_depth]: [f64; 2]| {
            let [radius, depth] = force_ratios(nu, power);
            assert!((radius - at_radius).abs() < 6e-4 && (depth - at_depth).abs() < 6e-4, "{radius} {depth}");
        };
        close(0.0, 2, [1.196, 1.053]);
        close(0.0, 1, [1.155, 1.045]);
        close(0.3, 2, [1.054, 1.016]);
        close(0.3, 1, [1.044, 1.014]);
        close(0.5, 2, [1.0, 1.0]);
        assert!((stiffness_ratio(0.2) - 1.0513).abs() < 5e-5 && (stiffness_ratio(0.0) - 1.0986).abs() < 5e-5);
    }
}
