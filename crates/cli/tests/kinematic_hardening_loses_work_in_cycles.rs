//! A scene may say how much of the hardening moves the yield surface and how often the body is loaded again:
//! the records show each cycle, the loss in it, and the mode; what goes with no metal is refused at its line.
//!
//! Bounds: the signs alone, which Bauschinger's effect fixes (Lemaitre & Chaboche, Mechanics of Solid
//! Materials, 1990, section 5.4): a surface that moves yields earlier in reverse, so a cycle loses more.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};

/// The scene with one reload and these lines more in its material.
fn scene(material: &str) -> String {
    SCENE.replacen("unload = true", "unload = true\nreloads = 1", 1).replacen(
        "[[asperity]]",
        &format!("{material}[[asperity]]"),
        1,
    )
}

/// Work lost in the second cycle as a share of what was put in.
fn loss(material: &str) -> f64 {
    let place = Place::with_scene(scene(material));
    let end = place.run(&["crush", "scene.toml", "--out", "out", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    let cycles = place.text("out/cycles.csv");
    let mut lines = cycles.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|h| h.starts_with(name)).unwrap();
    let rows: Vec<Vec<f64>> = lines.map(|l| l.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 2, "{cycles}");
    1.0 - rows[1][column("work_out")] / rows[1][column("work_in")]
}

#[test]
fn kinematic_hardening_loses_more_work_in_a_cycle_than_isotropic() {
    let isotropic = loss("");
    let kinematic = loss("hardening_mode = \"kinematic\"\nkinematic_share = 0.5\n");
    assert!(kinematic > 2.0 * isotropic.abs(), "{kinematic} beside {isotropic}");
}

#[test]
fn a_wrong_hardening_mode_is_refused_at_its_line() {
    for (material, words) in [
        (
            "kinematic_share = 0.5\n",
            &["scene.toml:9:", "kinematic_share", "hardening_mode = \"kinematic\""][..],
        ),
        (
            "hardening_mode = \"kinematic\"\nkinematic_share = 0\n",
            &["scene.toml:10:", "above 0 and at most 1, not 0"],
        ),
        ("hardening_mode = \"kinematic\"\nkinematic_share = 1.5\n", &["scene.toml:10:", "not 1.5"]),
        ("hardening_mode = \"mixed\"\n", &["scene.toml:9:", "mixed", "isotropic", "kinematic"]),
    ] {
        let place = Place::with_scene(scene(material));
        let end = place.run(&["crush", "scene.toml", "--out", "out"]);
        assert_eq!(end.status, 2, "{material}\n{}", end.err);
        for word in words {
            assert!(end.err.contains(word), "{material}: {word} is not in\n{}", end.err);
        }
        assert!(!place.path("out").exists());
    }
}
