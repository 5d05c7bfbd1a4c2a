//! Claim: whatever `identify` seeks beside the metal, an unknown more tells nothing, and a better curve
//! does not rule out the metal that it is of.
//!
//! Source: logic alone. Twins are curves of cones by finite elements at `reference`, with noise, of which
//! `results/reference-cones.md` holds the numbers. Of the many of `results/identify.md` a few are taken here.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity::{Fit, identify};
use asperity_calibration::fit::SplitMix;
use asperity_verification::twins::{Cone, Normal, Properties, Twin, properties};
use rayon::prelude::*;
use serde_json::Value;
use std::path::Path;

fn answer(folder: &Path, fit: &str) -> Option<Value> {
    let fit = Fit::from_toml(fit, folder).unwrap();
    serde_json::from_str(&identify(fit, &mut |_, _| true).ok()?.to_json().ok()?).ok()
}

fn properties_of(twins: &[Twin]) -> Vec<Properties> {
    let place = tempfile::tempdir().unwrap();
    let one = |(i, twin): (usize, &Twin)| {
        let file = format!("twin-{i}.csv");
        std::fs::write(place.path().join(&file), twin.curve()).unwrap();
        properties(twin, &file, &|fit| answer(place.path(), fit)).unwrap()
    };
    twins.par_iter().enumerate().with_max_len(1).map(one).collect()
}

/// The metal of `twin` fits, and the intervals of what was `found` hold it.
fn fits_and_covers(found: &Value, twin: &Twin) {
    assert_eq!(found["residual"]["fits"], true, "{twin:?}: {}", found["residual"]);
    for (name, truth) in twin.truth() {
        let end = |key: &str| found["parameters"][name][key].as_f64().unwrap();
        assert!(end("low") <= truth && truth <= end("high"), "{twin:?}: {}", found["parameters"]);
    }
}

/// First touch and compliance of the machine are 0 and not known to be. Two percent of a width is what the
/// steps of a profile leave of its end; 0.1 of a sum of squares is a thirtieth of what ends an interval.
#[test]
fn an_added_unknown_narrows_no_interval_and_fits_no_worse() {
    let cones = Cone::computed();
    let twins: Vec<Twin> = (1..=2).map(|i| Twin::new(&cones, i).unwrap()).collect();
    for (found, twin) in properties_of(&twins).iter().zip(&twins) {
        assert!(found.narrowed <= 0.02 && found.raised <= 0.1, "{twin:?}: {found:?}");
        assert!(found.fits, "{twin:?}: {found:?}");
        assert_eq!(found.covers, [true; 3], "{twin:?}: {found:?}");
    }
}

/// From 20 readings with noise of 2 % to 20,000 with 0.02 %, noise stated and not: the metal fits and its
/// interval holds it.
#[test]
fn a_better_curve_does_not_reject_its_metal() {
    let cones = Cone::computed();
    let place = tempfile::tempdir().unwrap();
    let ladder = [(20, 0.02), (200, 5e-3), (2000, 1e-3), (20_000, 2e-4)];
    let twin = Twin::new(&cones, 0).unwrap();
    let twins: Vec<Twin> = ladder
        .iter()
        .flat_map(|of| [true, false].map(|stated| (of, stated)))
        .map(|((points, noise), stated)| Twin { points: *points, noise: *noise, stated, ..twin.clone() })
        .collect();
    twins.par_iter().enumerate().with_max_len(1).for_each(|(k, twin)| {
        let file = format!("curve-{k}.csv");
        std::fs::write(place.path().join(&file), twin.curve()).unwrap();
        let found = answer(place.path(), &twin.fit(&file, 0, twin.stated.then_some(twin.noise))).unwrap();
        fits_and_covers(&found, twin);
    });
}

/// An instrument reads depths to half a nanometre or so, forces far better: on a steep unloading that is a
/// percent of the force. Depths of 2 µm with noise of 0.05 %, forces of 0.1 %, none of it stated.
#[test]
fn noise_of_depths_does_not_reject_a_metal() {
    let cones = Cone::computed();
    let place = tempfile::tempdir().unwrap();
    [200, 2000].into_par_iter().with_max_len(1).for_each(|points| {
        let twin = Twin { points, noise: 1e-3, ..Twin::new(&cones, 0).unwrap() };
        let mut normal = Normal(SplitMix(5));
        let mut noisy =
            |line: &str| match line.split_once(',').map(|(depth, rest)| (depth.parse::<f64>(), rest)) {
                Some((Ok(depth), force)) => format!("{:.6},{force}\n", depth + 1e-3 * normal.draw()),
                _ => format!("{line}\n"),
            };
        let curve: String = twin.curve().lines().map(&mut noisy).collect();
        let file = format!("curve-{points}.csv");
        std::fs::write(place.path().join(&file), curve).unwrap();
        let found = answer(place.path(), &twin.fit(&file, 0, None)).unwrap();
        fits_and_covers(&found, &twin);
    });
}
