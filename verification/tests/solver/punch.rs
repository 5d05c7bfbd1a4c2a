//! Claim: neither element locks. The mean pressure of a smooth circular punch on perfectly plastic metal
//! comes to rest at 3.01 ± 0.06 σ_y with both; with a fully integrated four-node element it passes that and
//! goes on rising.
//!
//! Source: the limit lies between 2.845 σ_y (R. T. Shield 1955, Tresca) and 3.285 σ_y (nested yield
//! surfaces); 3.01 ± 0.02 is the value of quadratic elements at small strain extrapolated to elements of size
//! zero. The pressure is too high by the share of the element at the punch edge, first order in its size, so
//! that two meshes are extrapolated here too: measured 3.147 and 3.085 with 9 and 18 quadratic elements
//! across, 3.129 and 3.073 with 18 and 36 linear ones. The limit is one of small strain and the solver knows
//! no other than large: at E/σ_y = 2000 and 0.03 a its pressure over the current area is 4 % above the
//! plateau, because the metal flows out from under the punch and its edge sinks. Hence E/σ_y = 2e6, and
//! depths of as many yield strains. Tolerance: that of the source and of the extrapolation.

use crate::full_quad::FullQuad;
use asperity_mesh::{ElementKind, Mesh};
use asperity_numerics::newton::{Settings, solve};
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{hollomon, model, reaction, travel};
use asperity_verification::test_meshes::{nodes_of, punch_block};
use std::f64::consts::PI;

const YIELD: f64 = 1.0 / 2e6;
const SETTINGS: Settings = Settings { tolerance: 1e-6, max_iterations: 40, keep: 0.0 };
/// Depths over σ_y/E times the punch radius: fine around first yield, coarse on the plateau.
const DEPTHS: [f64; 12] = [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 18.0, 26.0, 36.0, 48.0, 60.0];

/// Punch nodes, and what is held: base, axis, u_z under the punch.
fn hold(mesh: &Mesh) -> (Vec<usize>, Vec<[bool; 2]>) {
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    nodes_of(mesh, &mesh.sides.base).iter().for_each(|&n| held[n] = [true; 2]);
    nodes_of(mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
    let mut punch = nodes_of(mesh, &mesh.sides.surface);
    punch.retain(|&n| mesh.nodes[n][0] < 1.0 + 1e-9);
    punch.iter().for_each(|&n| held[n][1] = true);
    (punch, held)
}

/// Mean pressures over σ_y at the depths.
fn pressures(kind: ElementKind, across: usize) -> Vec<f64> {
    let mesh = punch_block(kind, across, 5.0);
    let (punch, held) = hold(&mesh);
    let mut model = model(&mesh, Symmetry::Axisymmetric, hollomon(YIELD, 0.0), &held, None).unwrap();
    let mut last = 0.0;
    DEPTHS
        .iter()
        .map(|&strains| {
            let depth = strains * YIELD;
            let step = depth - last;
            last = depth;
            travel(
                &mut model,
                &SETTINGS,
                &held,
                |node| {
                    if punch.contains(&node) { [0.0, -step] } else { [0.0; 2] }
                },
            )
            .unwrap();
            -reaction(&model, &punch, |_| [0.0, 1.0]) / (PI * YIELD)
        })
        .collect()
}

/// `p` of two meshes, the second twice as fine, extrapolated to elements of size zero.
fn comes_to_rest(kind: ElementKind, across: usize) {
    let [coarse, fine] = [across, 2 * across].map(|n| pressures(kind, n));
    let last = fine.len() - 1;
    assert!(fine[last] - fine[last - 1] < 0.005, "{kind:?} still rises: {fine:?}");
    let limit = 2.0 * fine[last] - coarse[last];
    assert!((limit - 3.01).abs() < 0.06, "{kind:?}: {limit} from {coarse:?} {fine:?}");
}

#[test]
fn quad8_comes_to_rest_at_the_limit_pressure() {
    comes_to_rest(ElementKind::Quad8, 9);
}

#[test]
fn quad4_comes_to_rest_at_the_limit_pressure() {
    comes_to_rest(ElementKind::Quad4, 18);
}

/// The same mesh, every strain integrated at all four points: the pressure passes the
/// limit and goes on rising.
#[test]
fn quad4_fully_integrated_locks() {
    let mesh = punch_block(ElementKind::Quad4, 18, 5.0);
    let (punch, held) = hold(&mesh);
    let mut full = FullQuad::new(&mesh, hollomon(YIELD, 0.0), &held);
    let mut last = 0.0;
    let mut pressures = Vec::new();
    for strains in DEPTHS {
        let depth = strains * YIELD;
        full.begin(|node| if punch.contains(&node) { [0.0, last - depth] } else { [0.0; 2] });
        solve(&mut full, &SETTINGS).unwrap();
        full.accept();
        last = depth;
        let force: f64 = punch.iter().map(|&n| -full.internal[n][1]).sum();
        pressures.push(force / (PI * YIELD));
    }
    let (before, end) = (pressures[pressures.len() - 2], pressures[pressures.len() - 1]);
    assert!(end > 3.01 + 0.06 && end - before > 0.05, "{pressures:?}");
}
