//! A crush that was interrupted or killed goes on from its checkpoint and ends with the bytes of one that nothing stopped.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use asperity::Progress;
use asperity::Scene;
use asperity::crush::{Checkpoints, Increment, crush_with};
use asperity::output::Directory;
use common::{Place, SCENE};
use std::fs;
use std::path::Path;
use std::time::Duration;

/// Crushes `text` into the folder `name` with checkpoints in `kept`; the observer ends it by `false`. Returns Newton's iterations.
fn crush(
    place: &Place,
    text: &str,
    name: &str,
    kept: &str,
    observer: &mut dyn FnMut(&Progress<'_, Increment<'_>>) -> bool,
) -> usize {
    let scene = Scene::from_toml(text, "".as_ref()).unwrap();
    let checkpoints = Checkpoints { folder: place.path(kept), every: Duration::ZERO, largest: u64::MAX };
    let mut sink = Directory::create(&place.path(name)).unwrap();
    crush_with(&scene, Some(&checkpoints), &mut sink, &[], observer).unwrap().summary.newton_iterations
}

fn copy(from: &Path, to: &Path) {
    let _ = fs::remove_dir_all(to);
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
}

/// Loaded, unloaded and loaded again; hardening by back stress, which keeps a history; augmented contact, which solves an increment
/// several times; a force that is looked for.
fn scenes() -> Vec<String> {
    let base = SCENE.replace("every = 0", "every = 4");
    let reloaded = base.replace("unload = true", "unload = true\nreloads = 1");
    assert_ne!(reloaded, base);
    let kinematic =
        base.replace("[material]", "[material]\nhardening_mode = \"kinematic\"\nkinematic_share = 0.5");
    let augmented = base.replace("[numerics]", "[numerics]\ncontact = \"augmented\"");
    assert_ne!(augmented, base);
    let forced = base.replace("depth = \"5 um\"", "force = \"2 N\"");
    assert_ne!(forced, base);
    vec![reloaded, kinematic, augmented, forced]
}

#[test]
fn an_interrupted_crush_ends_with_the_same_bytes() {
    for text in scenes() {
        let place = Place::with_scene(&text);
        let iterations = crush(&place, &text, "whole", "whole.journal", &mut |_| true);
        let increments = place.text("whole/curve.csv").lines().count() - 1;
        for stop in [1, increments / 3, increments / 2, increments - 2] {
            crush(&place, &text, "out", "kept", &mut |progress| progress.done < stop);
            assert!(place.path("kept/solver").exists());
        }
        assert_eq!(crush(&place, &text, "out", "kept", &mut |_| true), iterations);
        for name in ["curve.csv", "surface_0004.csv", "fields_0004.vtu"] {
            let [whole, out] = ["whole", "out"].map(|dir| fs::read(place.path(dir).join(name)).unwrap());
            assert!(whole == out, "{name} of {text}");
        }
    }
}

#[test]
fn a_journal_that_may_not_grow_is_taken_up_from_where_it_ended() {
    let text = &scenes()[0];
    let place = Place::with_scene(text);
    let scene = Scene::from_toml(text, "".as_ref()).unwrap();
    let limit = 50_000;
    for name in ["whole", "again"] {
        let checkpoints = Checkpoints { folder: place.path("kept"), every: Duration::ZERO, largest: limit };
        let mut sink = Directory::create(&place.path(name)).unwrap();
        crush_with(&scene, Some(&checkpoints), &mut sink, &[], &mut |_| true).unwrap();
        let length = fs::metadata(place.path("kept/solves")).unwrap().len();
        // at most one solve past the limit
        assert!((limit..2 * limit).contains(&length), "{length}");
    }
    let [whole, again] = ["whole", "again"].map(|dir| fs::read(place.path(dir).join("curve.csv")).unwrap());
    assert!(whole == again);
}

#[test]
fn what_a_killed_crush_left_at_any_moment_is_enough() {
    let text = &scenes()[0];
    let place = Place::with_scene(text);
    crush(&place, text, "whole", "kept", &mut |progress| {
        let increment = progress.done;
        if increment % 5 == 2 && place.path("kept/solver").exists() {
            copy(&place.path("kept"), &place.path(&format!("left-{increment}")));
        }
        true
    });
    let mut resumed = 0;
    for increment in (2..100).step_by(5) {
        let left = format!("left-{increment}");
        if place.path(&left).exists() {
            // cut short in the middle of a solve that the checkpoint does not count yet
            let solves = place.path(&left).join("solves");
            let bytes = [fs::read(&solves).unwrap(), vec![1; 1000]].concat();
            fs::write(&solves, bytes).unwrap();
            crush(&place, text, "out", &left, &mut |_| true);
            assert_eq!(place.text("out/curve.csv"), place.text("whole/curve.csv"), "{left}");
            resumed += 1;
        }
    }
    assert!(resumed > 2);
}

#[test]
fn checkpoints_of_another_scene_or_damaged_ones_change_nothing() {
    let text = &scenes()[0];
    let place = Place::with_scene(text);
    let other = text.replace("yield_stress = \"300 MPa\"", "yield_stress = \"310 MPa\"");
    assert_ne!(&other, text);
    crush(&place, text, "whole", "none", &mut |_| true);
    crush(&place, &other, "out", "kept", &mut |progress| progress.done < 6);
    crush(&place, text, "out", "kept", &mut |_| true);
    assert_eq!(place.text("out/curve.csv"), place.text("whole/curve.csv"));
    // a solve that is none of this body is found by its residual, and solved
    crush(&place, text, "out", "bad", &mut |progress| progress.done < 6);
    let mut bytes = fs::read(place.path("bad/solves")).unwrap();
    let half = bytes.len() / 2;
    bytes[half] ^= 0x10;
    fs::write(place.path("bad/solves"), bytes).unwrap();
    crush(&place, text, "out", "bad", &mut |_| true);
    let [whole, out] = ["whole", "out"].map(|dir| place.text(&format!("{dir}/curve.csv")).lines().count());
    assert_eq!(whole, out);
}
