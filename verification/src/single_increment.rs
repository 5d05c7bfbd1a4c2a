//! One increment of a model, solved and accepted.

use crate::test_meshes::{mapped, nodes_of};
use asperity_material::{Elastic, Hardening, HardeningLaw, StressMeasure};
use asperity_mesh::{ElementKind, Mesh};
use asperity_numerics::newton::{Converged, Settings, solve};
use asperity_solver::body::analysis::Analyses;
use asperity_solver::body::discrete_body::{Body, ToolContact};
use asperity_solver::equilibrium::{Equilibrium, SolveFailure};
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::{Metal, stress};
use asperity_solver::point::tensor::Sym;

/// Tight enough that only rounding is left: the claims are about the equations, not about when Newton stops.
pub const TIGHT_SETTINGS: Settings = Settings { tolerance: 1e-12, max_iterations: 40, keep: 0.0 };

/// E = 1, ν = 0.3, never yields.
pub const ELASTIC_METAL: Metal = Metal {
    elastic: Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 },
    hardening: None,
    kinematic_share: 0.0,
    stress_measure: StressMeasure::Kirchhoff,
};

/// E = 1, ν = 0.3, eq. (1) with σ_y = `yield_stress` and exponent `exponent`.
pub fn hollomon(yield_stress: f64, exponent: f64) -> Metal {
    let hardening = Hardening { law: HardeningLaw::Hollomon, yield_stress, exponent, youngs_modulus: 1.0 };
    Metal { hardening: Some(hardening.into()), ..ELASTIC_METAL }
}

/// A stress-free model with the components `held` kept.
///
/// # Errors
/// An element of the mesh is inside out.
pub fn model<'m>(
    mesh: &'m Mesh,
    symmetry: Symmetry,
    metal: Metal,
    held: &[[bool; 2]],
    contact: Option<ToolContact>,
) -> Result<Equilibrium<'m>, SolveFailure> {
    let mut model = Body::new(&Analyses::default(), mesh, symmetry, metal, |node| held[node], contact)
        .and_then(Equilibrium::new)?;
    // what is exact is looked at to the last digits
    model.sharpen();
    Ok(model)
}

/// Solves the increment with the tool at `tip` (infinite: none) from `guess`, whose held components are kept,
/// and accepts it. Backward Euler: no flow is extrapolated.
///
/// # Errors
/// Newton did not converge.
pub fn increment(
    model: &mut Equilibrium<'_>,
    tip: f64,
    settings: &Settings,
    guess: impl Fn(usize) -> [f64; 2],
) -> Result<Converged, SolveFailure> {
    model.begin(tip, 0.0, guess);
    let done = solve(model, settings).map_err(|(failure, _)| failure)?;
    model.accept()?;
    Ok(done)
}

/// Moves the held components by `whole(node)` in as few increments as converge: an increment that fails is
/// halved. Each starts from the last one, scaled. Backward Euler.
///
/// # Errors
/// The failure of an increment of less than a hundredth of the whole.
pub fn travel(
    model: &mut Equilibrium<'_>,
    settings: &Settings,
    held: &[[bool; 2]],
    whole: impl Fn(usize) -> [f64; 2],
) -> Result<(), SolveFailure> {
    let (mut done, mut share) = (0.0_f64, 1.0_f64);
    let mut last: Option<f64> = None;
    while done < 1.0 - 1e-12 {
        let step = share.min(1.0 - done);
        let before = model.state().displacement.to_vec();
        let scale = last.map_or(0.0, |l| step / l);
        let outcome = increment(model, f64::INFINITY, settings, |node| {
            let to = whole(node);
            [0, 1].map(|i| if held[node][i] { step * to[i] } else { scale * before[node][i] })
        });
        match outcome {
            Ok(_) => {
                done += step;
                last = Some(step);
            }
            Err(failure) if share < 0.01 => return Err(failure),
            Err(_) => {
                share *= 0.5;
                last = None;
            }
        }
    }
    Ok(())
}

/// Kirchhoff stress at every point of the converged state.
pub fn stresses(model: &Equilibrium<'_>) -> Vec<Sym> {
    model
        .state()
        .points
        .states
        .iter()
        .map(|state| stress(&model.body().material.elastic, &state.b_minus_i))
        .collect()
}

/// Axial Kirchhoff stress of a bar of one element at each of the total logarithmic strains it is stretched
/// to, one increment each.
///
/// # Errors
/// Newton did not converge.
pub fn stretch_bar(kind: ElementKind, metal: &Metal, strains: &[f64]) -> Result<Vec<f64>, SolveFailure> {
    // one element: a longer bar would neck
    let mesh = mapped(kind, [1, 1], |x| x);
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    let ends = [&mesh.sides.surface, &mesh.sides.base].map(|side| nodes_of(&mesh, side));
    ends.iter().flatten().for_each(|&node| held[node][1] = true);
    nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&node| held[node][0] = true);
    let mut model = model(&mesh, Symmetry::Axisymmetric, metal.clone(), &held, None)?;
    let mut last = 0.0_f64;
    let mut axial = Vec::with_capacity(strains.len());
    for &strain in strains {
        let x = model.state().position.to_vec();
        increment(&mut model, f64::INFINITY, &TIGHT_SETTINGS, |node| {
            let [r, z] = x[node];
            // as incompressible: nearly right
            [r * (0.5 * (last - strain)).exp_m1(), z * (strain - last).exp_m1()]
        })?;
        last = strain;
        axial.push(stresses(&model)[0][1]);
    }
    Ok(axial)
}

/// Sum over `nodes` of the internal force along `direction(node)`: the reaction that holds them.
pub fn reaction(model: &Equilibrium<'_>, nodes: &[usize], direction: impl Fn(usize) -> [f64; 2]) -> f64 {
    nodes
        .iter()
        .map(|&node| {
            let (f, d) = (model.response().internal[node], direction(node));
            f[0] * d[0] + f[1] * d[1]
        })
        .sum()
}
