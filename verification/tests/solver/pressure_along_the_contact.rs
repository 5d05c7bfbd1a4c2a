//! Claim: the pressure along the contact does not alternate between the corners and the mid-side nodes of the
//! edges. Under an elastic ball it is that of Hertz to 1 % within three quarters of the contact radius; under
//! the paper's asperity a mid-side node lies within 2 % of the mean of its corners.
//!
//! Source: Hertz (Johnson 1985, eq. 4.22) p = p₀ √(1 - r²/a²), p₀ = 2 E* a/(π R). Tolerances: the penetration
//! at the nodes, which is not smoothed, gives 1.3 % and 14 %; the line over an edge cannot follow the
//! curvature of Hertz's pressure, which is 0.5 % over the edge at the axis.

use asperity_material::units::Length;
use asperity_simulation::run::{Event, Run};
use asperity_simulation::scene::{Accuracy, Scene, Tool};
use asperity_solver::body::fields::SurfacePoint;
use asperity_verification::contact::hertz_radius;
use asperity_verification::single_asperity::loaded;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// The surface at the end of loading.
fn surface(mut scene: Scene) -> Vec<SurfacePoint> {
    (scene.output.every, scene.output.fields) = (Some(1000), None);
    let mut last = Vec::new();
    Run::new(&scene)
        .run(&mut |event| {
            if let Event::Fields(frame) = event {
                last.clone_from(&frame.fields.surface);
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    last
}

#[test]
fn a_ball_presses_as_hertz() {
    let (ball, depth) = (1e-3, 0.2e-6);
    let mut scene = loaded(Accuracy::Standard).unwrap();
    (scene.material.yield_stress, scene.material.hardening_exponent) = (None, None);
    scene.asperity.clear();
    scene.tool = Tool::sphere(Length(ball));
    scene.loading.depth = Some(Length(depth));
    let a = hertz_radius(ball, depth);
    let largest = 2.0 * scene.material.elastic().reduced_modulus() * a / (PI * ball);
    let points = surface(scene);
    let inner = points.iter().filter(|point| point.r < 0.75 * a);
    for point in inner.clone() {
        let hertz = largest * (1.0 - (point.r / a).powi(2)).sqrt();
        assert!((point.pressure / hertz - 1.0).abs() < 0.01, "{:e} at {:e}", point.pressure, point.r);
    }
    assert!(inner.count() > 15);
}

#[test]
fn crushed_metal_presses_without_zigzag() {
    let points = surface(loaded(Accuracy::Standard).unwrap());
    let touching: Vec<f64> = points.iter().map(|point| point.pressure).take_while(|p| *p > 0.0).collect();
    // the last three edges hold the end of the contact
    let edges = (touching.len() - 1) / 2 - 3;
    assert!(edges > 10);
    for edge in touching.windows(3).step_by(2).take(edges) {
        let apart = edge[1] / (0.5 * (edge[0] + edge[2])) - 1.0;
        assert!(apart.abs() < 0.02, "{apart:+} beside a pressure of {:e}", edge[1]);
    }
}
