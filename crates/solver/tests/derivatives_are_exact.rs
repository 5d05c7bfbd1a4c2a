//! Claim: every tangent is the derivative of its force. Material, both elements and contact against central
//! differences, at large strain, elastic and flowing, in both symmetries.
//!
//! Tolerance 1e-6 of the largest entry: central differences with step 1e-6 carry an error of about 1e-9 here.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use asperity_material::{Elastic, Hardening, HardeningLaw, HardeningTable, StressMeasure};
use asperity_mesh::outline::{Outline, Parabola};
use asperity_numerics::lanes::{Lanes, Real};
use asperity_solver::contact::edge::{ContactContext, ContactEdge};
use asperity_solver::contact::slip::{Friction, Rubbing, SLIP_PLACES};
use asperity_solver::contact::tool::Tool;
use asperity_solver::element::kernel::{ENTRIES, ElementContext, ElementOutput, PointSlice, Triangle};
use asperity_solver::element::quad4;
use asperity_solver::element::quad8;
use asperity_solver::point::failure::Failure;
use asperity_solver::point::j2;
use asperity_solver::point::j2::{PointUpdate, Tangent};
use asperity_solver::point::kinematic_hardening::{self, History};
use asperity_solver::point::kinematics::{ShapePoint, Symmetry, motion};
use asperity_solver::point::material::{Metal, PointState};

const STEP: f64 = 1e-6;
const TOLERANCE: f64 = 1e-6;

fn metal(law: Option<(HardeningLaw, f64)>) -> Metal {
    let hardening = law
        .map(|(law, exponent)| Hardening { law, yield_stress: 0.02, exponent, youngs_modulus: 1.0 }.into());
    Metal {
        elastic: Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 },
        hardening,
        kinematic_share: 0.0,
        stress_measure: StressMeasure::Kirchhoff,
    }
}

/// A table whose kinks none of the states below comes to lie on.
fn tabulated() -> Metal {
    let table = HardeningTable::new(&[[0.0, 0.02], [0.03, 0.03], [0.5, 0.04]]).unwrap();
    Metal { hardening: Some(table.into()), ..metal(None) }
}

fn metals() -> [Metal; 8] {
    let kinematic = |metal: Metal| Metal { kinematic_share: 1.0, ..metal };
    [
        kinematic(metal(Some((HardeningLaw::Hollomon, 0.3)))),
        kinematic(metal(Some((HardeningLaw::Swift, 0.0)))),
        Metal { kinematic_share: 0.4, ..tabulated() },
        tabulated(),
        metal(None),
        metal(Some((HardeningLaw::Hollomon, 0.3))),
        metal(Some((HardeningLaw::Swift, 0.1))),
        metal(Some((HardeningLaw::Hollomon, 0.0))),
    ]
}

/// The update that belongs to the metal.
fn update(
    metal: &Metal,
    (state, memory): &(PointState, History),
    g: &[f64; 5],
    tangent: Tangent,
) -> (PointUpdate, History) {
    if metal.has_back_stress() {
        kinematic_hardening::update(metal, state, memory, g, tangent).unwrap()
    } else {
        (j2::update(metal, state, g, tangent).unwrap(), *memory)
    }
}

/// A state with prior plastic strain, general stretches, and a back stress that is coaxial with none of them.
fn strained(metal: &Metal) -> (PointState, History) {
    let mut old = (metal.virgin(), History::default());
    for g in [[0.02, 0.05, -0.03, -0.04, 0.01], [0.1, 0.3, 0.2, 0.05, -0.1], [-0.03, 0.02, 0.06, 0.02, 0.01]]
    {
        let (end, memory) = update(metal, &old, &g, Tangent::None);
        old = (end.state, memory);
    }
    old
}

/// The quadratic form is the derivative of P = τ f⁻ᵀ pushed forward: d(τ:l δ)/dl with δf = l f, for all l.
#[test]
fn material() {
    for metal in metals() {
        let old = strained(&metal);
        for g in [
            [0.3, -0.2, 0.4, -0.1, 0.15],
            [1e-3, 5e-4, -2e-3, 1e-3, -1e-3],
            [-2e-3, -4e-3, 3e-3, 3e-3, -1e-3],
            [-0.4, 0.0, 0.0, 0.9, -0.3],
        ] {
            let here = update(&metal, &old, &g, Tangent::Exact).0;
            let scale = here.tangent.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
            let stress = |l: &[f64; 5]| {
                // f' = (I + l) f; P: δf in terms of l' : nominal stress S = τ' (I + l)⁻ᵀ
                let [a, b, c, d, e] = *l;
                let f = [1.0 + g[0], g[1], g[2], 1.0 + g[3], 1.0 + g[4]];
                let next = [
                    (1.0 + a) * f[0] + b * f[2] - 1.0,
                    (1.0 + a) * f[1] + b * f[3],
                    c * f[0] + (1.0 + d) * f[2],
                    c * f[1] + (1.0 + d) * f[3] - 1.0,
                    (1.0 + e) * f[4] - 1.0,
                ];
                let t = update(&metal, &old, &next, Tangent::None).0.stress;
                let det = (1.0 + a) * (1.0 + d) - b * c;
                // rows of (I + l)⁻ᵀ
                let inverse = [(1.0 + d) / det, -c / det, -b / det, (1.0 + a) / det];
                [
                    t[0] * inverse[0] + t[3] * inverse[2],
                    t[0] * inverse[1] + t[3] * inverse[3],
                    t[3] * inverse[0] + t[1] * inverse[2],
                    t[3] * inverse[1] + t[1] * inverse[3],
                    t[2] / (1.0 + e),
                ]
            };
            for j in 0..5 {
                let mut l = [0.0; 5];
                l[j] = STEP;
                let up = stress(&l);
                l[j] = -STEP;
                let down = stress(&l);
                for i in 0..5 {
                    let difference = (up[i] - down[i]) / (2.0 * STEP);
                    let error = (difference - here.tangent[i][j]).abs() / scale;
                    assert!(
                        error < TOLERANCE,
                        "{metal:?} g {g:?} ({i}, {j}): {difference} {}",
                        here.tangent[i][j]
                    );
                }
            }
        }
    }
}

fn element<const N: usize>(
    reference: [[f64; 2]; N],
    volume: impl Fn(Symmetry) -> Vec<f64>,
    evaluate: impl Fn(
        &ElementContext<'_>,
        &[[f64; 2]; N],
        &[[f64; 2]; N],
        &PointSlice<'_>,
        &mut Triangle,
        &mut ElementOutput,
    ) -> Result<(), Failure>,
) {
    for metal in metals() {
        for symmetry in [Symmetry::Axisymmetric, Symmetry::PlaneStrain] {
            for amplitude in [1e-3, 0.15] {
                let (old, remembered) = strained(&metal);
                let context = ElementContext { symmetry, metal: &metal, tangent: Tangent::Exact };
                let mut du: [[f64; 2]; N] =
                    std::array::from_fn(|a| [0, 1].map(|i| amplitude * ((3 * a + 5 * i) as f64).sin()));
                let weight = volume(symmetry);
                let start = PointSlice {
                    updated: None,
                    states: &[old; 4],
                    history: &[remembered; 4],
                    weight: &weight,
                };
                let run = |du: &[[f64; 2]; N]| {
                    let x = std::array::from_fn(|a| [reference[a][0] + du[a][0], reference[a][1] + du[a][1]]);
                    let mut out = ElementOutput::new(old);
                    let mut triangle = [Lanes::splat(0.0); ENTRIES];
                    evaluate(&context, &x, du, &start, &mut triangle, &mut out).unwrap();
                    out
                };
                let here = run(&du);
                let scale = here.stiffness.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                for b in 0..N {
                    for j in 0..2 {
                        let keep = du[b][j];
                        du[b][j] = keep + STEP;
                        let up = run(&du).force;
                        du[b][j] = keep - STEP;
                        let down = run(&du).force;
                        du[b][j] = keep;
                        for a in 0..N {
                            for i in 0..2 {
                                let difference = (up[i][a] - down[i][a]) / (2.0 * STEP);
                                // the lower triangle stands for both, so that an unsymmetric derivative is
                                // caught
                                let ([row, m], [column, n]) =
                                    if (a, i) < (b, j) { ([b, j], [a, i]) } else { ([a, i], [b, j]) };
                                let (row, column) = (2 * row + m, 2 * column + n);
                                let exact = here.stiffness[column * (4 * N - column - 1) / 2 + row];
                                assert!(
                                    (difference - exact).abs() < TOLERANCE * scale,
                                    "{metal:?} {symmetry:?} {amplitude} ({a},{i}) ({b},{j}): {difference} {exact}"
                                );
                            }
                        }
                    }
                }
            }
        }
    }
}

const CORNERS: [[f64; 2]; 4] = [[1.0, 0.1], [2.1, -0.1], [2.3, 1.2], [0.9, 1.0]];

#[test]
fn quad4_with_mean_dilatation() {
    let points = ShapePoint::side_by_side(&quad4::points());
    let volume = |symmetry| motion(&points, &CORNERS, &[[0.0; 2]; 4], symmetry).unwrap().volume.0.to_vec();
    element(CORNERS, volume, |c, x, du, start, triangle, out| {
        quad4::evaluate(c, &points, x, du, start, triangle, out)
    });
}

#[test]
fn quad8_with_reduced_integration() {
    let points = ShapePoint::side_by_side(&quad8::points());
    let reference: [[f64; 2]; 8] = std::array::from_fn(|a| {
        if a < 4 {
            CORNERS[a]
        } else {
            let (p, q) = (CORNERS[a - 4], CORNERS[(a - 3) % 4]);
            [0.5 * (p[0] + q[0]) + 0.02 * a as f64 - 0.1, 0.5 * (p[1] + q[1]) + 0.03]
        }
    });
    let volume = |symmetry| motion(&points, &reference, &[[0.0; 2]; 8], symmetry).unwrap().volume.0.to_vec();
    element(reference, volume, |c, x, du, start, triangle, out| {
        quad8::evaluate(c, &points, x, du, start, triangle, out)
    });
}

/// A parabola that goes on as another one, whose half curvature is `bend`, at a place between the nodes of
/// the edge.
fn measured_tip(bend: f64) -> std::sync::Arc<Outline> {
    let arcs = vec![
        Parabola { x: 0.0, drop: 0.0, slope: 0.0, bend: 0.05 },
        Parabola { x: 1.35, drop: 0.05 * 1.35 * 1.35, slope: 0.135, bend },
    ];
    Outline::new(arcs, 4.0, true).unwrap().shared()
}

/// Contact force and stiffness are the first and second derivative of the contact energy, clipped at one end,
/// in the middle, and at both ends. The energy is exact for a plane (polynomial of degree 6); for curved
/// tools it is a quadrature whose own clip derivative is about 1e-5 of the force, wherever a curvature jumps
/// in the edge.
#[test]
fn contact() {
    let reference = [[2.0, 0.0], [1.0, 0.1], [1.5, 0.04]];
    let tools = [
        (Tool::Plane, TOLERANCE),
        (Tool::Sphere { radius: 6.0 }, 1e-4),
        (Tool::Cone { tan_slope: 0.2, tip_radius: 0.0 }, TOLERANCE),
        (Tool::Measured(measured_tip(0.05)), 1e-4),
        (Tool::Measured(measured_tip(0.02)), 1e-4),
        (Tool::Cone { tan_slope: 0.2, tip_radius: 7.0 }, 1e-4),
        (Tool::Cone { tan_slope: 0.2, tip_radius: 6.1 }, 1e-4),
    ];
    for symmetry in [Symmetry::Axisymmetric, Symmetry::PlaneStrain] {
        for (tool, tolerance) in tools.clone() {
            for (tip, middle) in [(0.03, 0.04), (0.03, 0.12), (-0.3, -0.2), (-0.5, 0.04), (0.02, -0.1)] {
                for quadratic in [true, false] {
                    let context = ContactContext {
                        tool: &tool,
                        tip,
                        penalty: 3.0,
                        spring: 3.0,
                        symmetry,
                        rubbing: None,
                    };
                    let edge =
                        ContactEdge::new([0, 1], quadratic.then_some(2), |n| reference[n as usize], symmetry);
                    let mut x = reference;
                    x[2][1] = middle;
                    let run = |x: &[[f64; 2]; 3]| edge.integrate(&context, edge.touching(&context, x), x);
                    let here = run(&x);
                    let scale = here
                        .stiffness
                        .iter()
                        .flatten()
                        .flatten()
                        .flatten()
                        .fold(1e-3_f64, |m, v| m.max(v.abs()));
                    for b in 0..edge.node_count() {
                        for j in 0..2 {
                            let keep = x[b][j];
                            x[b][j] = keep + STEP;
                            let up = run(&x);
                            x[b][j] = keep - STEP;
                            let down = run(&x);
                            x[b][j] = keep;
                            let force = (up.energy - down.energy) / (2.0 * STEP);
                            assert!(
                                (force - here.force[b][j]).abs() < tolerance * scale,
                                "{tool:?} {tip} {middle} {force} {}",
                                here.force[b][j]
                            );
                            for a in 0..edge.node_count() {
                                for i in 0..2 {
                                    let difference = (up.force[a][i] - down.force[a][i]) / (2.0 * STEP);
                                    let exact = here.stiffness[a][i][b][j];
                                    assert!(
                                        (difference - exact).abs() < tolerance * scale,
                                        "{tool:?} {tip} {middle}"
                                    );
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The derivative of the forces of friction is the stiffness and what that lacks of symmetry: where all
/// slips, up to an end of contact too; where all sticks, on an edge that has touched before or touches now as
/// a whole.
#[test]
fn friction() {
    let reference = [[2.0, 0.0], [1.0, 0.1], [1.5, 0.04]];
    // with how much lower each stands
    let tools = [
        (Tool::Plane, 0.0, TOLERANCE),
        (Tool::Sphere { radius: 60.0 }, 0.0, 1e-4),
        (Tool::Cone { tan_slope: 0.2, tip_radius: 0.0 }, 0.3, TOLERANCE),
    ];
    // law, height of the tool now and before
    let ways = [
        (Friction::Coulomb(0.3), 0.03, 0.04),
        (Friction::Coulomb(0.3), -0.5, -0.4),
        (Friction::Sticking, -0.5, -0.4),
        (Friction::Sticking, -0.5, -0.6),
        (Friction::Sticking, -0.6, 1.0),
    ];
    for symmetry in [Symmetry::Axisymmetric, Symmetry::PlaneStrain] {
        for (tool, lower, tolerance) in &tools {
            for (law, tip, tip_before) in ways {
                let [tip, tip_before] = [tip - lower, tip_before - lower];
                let rubbing = Some(Rubbing { friction: law, tip_before, holds: false });
                let context = ContactContext { tool, tip, penalty: 3.0, spring: 3.0, symmetry, rubbing };
                let mut edge = ContactEdge::new([0, 1], Some(2), |n| reference[n as usize], symmetry);
                edge.slip = [0.002; SLIP_PLACES];
                let mut x = reference.map(|[r, z]| [1.3 * r, z]);
                let run = |x: &[[f64; 2]; 3]| edge.integrate(&context, edge.touching(&context, x), x);
                let here = run(&x);
                let whole = |a: usize, i: usize, b: usize, j: usize| {
                    here.stiffness[a][i][b][j] + here.unsymmetric[a][i][b][j]
                };
                for b in 0..3 {
                    for j in 0..2 {
                        let keep = x[b][j];
                        let [up, down] = [STEP, -STEP].map(|step| {
                            x[b][j] = keep + step;
                            run(&x)
                        });
                        x[b][j] = keep;
                        for a in 0..3 {
                            for i in 0..2 {
                                let difference = (up.force[a][i] - down.force[a][i]) / (2.0 * STEP);
                                let (exact, scale) = (whole(a, i, b, j), here.stiffness[0][1][0][1]);
                                assert!(
                                    (difference - exact).abs() < tolerance * scale,
                                    "{tool:?} {law:?} {tip} ({a}, {i}, {b}, {j}): {difference} {exact}"
                                );
                            }
                        }
                    }
                }
                assert!(here.friction_work > 0.0 || law == Friction::Sticking);
            }
        }
    }
}
