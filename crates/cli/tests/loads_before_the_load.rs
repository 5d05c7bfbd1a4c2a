//! A body that was loaded before by another tool ends with a result or a reason, never by a panic, and its
//! loading never goes back.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use asperity::crush::{AsperityRow, CurveRow, Phase, read_rows};
use common::Place;

const STEEL: &str = r#"accuracy = "draft"
[material]
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
yield_stress = "400 MPa"
hardening_exponent = 0.2
"#;

fn ball_before(depth: &str) -> String {
    format!(
        "[[initial.load]]\ntool = {{ shape = \"sphere\", radius = \"40 um\" }}\nloading = {{ depth = \"{depth}\" }}\n"
    )
}

/// Asperities side by side, the gentlest first, of `count`.
fn row(symmetry: &str, slope: f64, count: usize) -> String {
    let one = |i: usize| {
        format!(
            "[[asperity]]\nheight = \"15 um\"\nslope_deg = {}\ntip_radius = \"8 um\"\n",
            slope + 1.5 * i as f64
        )
    };
    let asperities: String = (0..count).map(one).collect();
    format!(
        "symmetry = \"{symmetry}\"\n{STEEL}{asperities}[substrate]\nradius = \"20 mm\"\ndepth = \"5 mm\"\n\
         [tool]\nshape = \"plane\"\n[loading]\ndepth = \"4 um\"\n[numerics]\nelements_in_contact = 5\nsteps = 8\n{}",
        ball_before("0.8 um")
    )
}

/// A ball over the first asperity leaves the others as they were: the plane then meets their summits in one
/// node of a coarse mesh.
#[test]
fn a_plane_after_a_ball_meets_the_summits_that_the_ball_left() {
    for symmetry in ["plane-strain", "axisymmetric"] {
        for (slope, count) in [(5.0, 2), (5.0, 4), (9.0, 3), (16.0, 4)] {
            let place = Place::with_scene(row(symmetry, slope, count));
            let end = place.run(&["mesh", "scene.toml", "-o", "body.msh"]);
            assert_eq!(end.status, 0, "{symmetry} {slope} {count}: {}", end.err);
        }
    }
    let place = Place::with_scene(row("plane-strain", 5.0, 3));
    let end = place.run(&["crush", "scene.toml", "--out", "out"]);
    assert!(end.status == 0 || end.status == 1 && end.err.contains("stopped"), "{} {}", end.status, end.err);
}

/// The loads of a body share its coordinates: the ball dents the first summit also where a plane comes after
/// it, which then meets the second one alone.
#[test]
fn a_ball_before_a_plane_comes_down_on_the_first_ridge() {
    let dented = row("plane-strain", 9.0, 2);
    let virgin = dented.replace(&ball_before("0.8 um"), "");
    let bears = |scene: &str| {
        let place = Place::with_scene(scene);
        let end = place.run(&["crush", "scene.toml", "--out", "out", "--set", "numerics.refine=false"]);
        assert_eq!(end.status, 0, "{}", end.err);
        let rows: Vec<AsperityRow> = read_rows(&place.path("out/asperities.csv")).unwrap();
        // a quarter of the dent
        let early = || rows.iter().filter(|row| row.depth < 0.2e-6);
        [0, 1].map(|asperity| early().any(|row| row.asperity == asperity && row.force > 0.0))
    };
    assert_eq!((bears(&virgin), bears(&dented)), ([true, true], [false, true]));
}

/// A cone of 12° on the dent of a ball that went a thousand times as deep touches a few uneven nodes: force
/// and depth jumped between two states over a hundred increments. A hundredth of the dent is a smooth curve.
#[test]
fn a_load_too_light_for_its_surface_ends_with_that_reason() {
    let scene = |depth: &str| {
        format!(
            "symmetry = \"axisymmetric\"\n{STEEL}[tool]\nshape = \"cone\"\nslope_deg = 12\ntip_radius = \"1 um\"\n\
             [loading]\ndepth = \"{depth}\"\n\
             [numerics]\nelements_in_contact = 14\nsteps = 90\n{}",
            ball_before("1 um")
        )
    };
    for (depth, status) in [("1 nm", 1), ("100 nm", 0)] {
        let place = Place::with_scene(scene(depth));
        let end = place.run(&["crush", "scene.toml", "--out", "out"]);
        assert_eq!(end.status, status, "{depth}: {}", end.err);
        assert_eq!(end.err.contains("the depth fell while loading"), status == 1, "{depth}: {}", end.err);
        let rows: Vec<CurveRow> = read_rows(&place.path("out/curve.csv")).unwrap();
        let loading: Vec<f64> = rows.iter().filter(|r| r.phase == Phase::Load).map(|r| r.depth).collect();
        // to the tolerance of Newton's method at `draft`
        assert!(loading.windows(2).all(|w| w[1] >= w[0] * (1.0 - 1e-3)), "{depth}: {loading:?}");
    }
}
