//! Help, scenes to start from, completions and manual work.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Place;

#[test]
fn every_new_scene_runs() {
    let place = Place::with_scene("");
    let kinds = [
        ("single", "crush"),
        ("multi", "crush"),
        ("cone", "crush"),
        ("ball", "crush"),
        ("plane-strain", "crush"),
        ("rough", "rough"),
        ("sweep", "calibrate"),
        ("study", "study"),
        ("fit", "identify"),
    ];
    for (kind, command) in kinds {
        let end = place.run(&["new", kind]);
        assert_eq!(end.status, 0, "{}", end.err);
        let file = format!("{kind}.toml");
        assert!(end.out.contains(&format!("asperity {command} {file}")), "{}", end.out);
        let quick: &[&str] = match command {
            "crush" => &["--accuracy", "draft", "--set", "output.every=0", "--set", "loading.depth=2 um"],
            "calibrate" | "study" | "identify" => &[],
            _ => &["--set", "surface.generate.pixels=[128, 128]", "--set", "closure=published"],
        };
        let out = format!("out-{kind}");
        let end = place.run(&[&[command, file.as_str(), "--out", &out, "--quiet"], quick].concat());
        assert_eq!((end.status, end.err.as_str()), (0, ""), "{kind}");
    }
    assert!(place.path("out-sweep/coefficient.toml").exists(), "the sweep finds its coefficient");
    let fit = std::fs::read_to_string(place.path("out-fit/fit.json")).unwrap();
    let fit: serde_json::Value = serde_json::from_str(&fit).unwrap();
    assert!(fit["verdict"].as_str().unwrap().starts_with("identifiable"), "{}", fit["verdict"]);
    // a file is not overwritten unless asked
    let end = place.run(&["new", "single"]);
    assert_eq!(end.status, 2);
    assert!(end.err.contains("--force"), "{}", end.err);
    assert_eq!(place.run(&["new", "single", "--force"]).status, 0);
}

#[test]
fn a_missing_scene_file_is_answered_with_a_way_out() {
    let end = Place::with_scene("").run(&["crush"]);
    assert_eq!(end.status, 2);
    assert!(
        end.err.contains("Missing scene file.") && end.err.contains("asperity new single"),
        "{}",
        end.err
    );
}

#[test]
fn table1_is_written_to_the_given_folder() {
    let place = Place::with_scene("");
    let end = place.run(&["rough", "--table1", "--out", "table", "--json"]);
    assert_eq!((end.status, end.err.as_str()), (0, ""));
    let rows: serde_json::Value = serde_json::from_str(&end.out).unwrap();
    assert_eq!(rows.as_array().map(Vec::len), Some(3));
    let milled = &rows[1];
    assert_eq!(
        (milled["surface"].as_str(), milled["paper"]["pressure"].as_f64()),
        (Some("milled"), Some(3830.0))
    );
    let closures = milled["closures"].as_array().unwrap();
    assert!(closures.iter().all(|c| c["pressure"].as_array().is_some_and(|seeds| seeds.len() == 5)));
    let text = std::fs::read_to_string(place.path("table/table1.txt")).unwrap();
    assert!(closures.iter().all(|c| text.contains(c["closure"].as_str().unwrap())), "{text}");
    assert_eq!(end.out.trim_end(), std::fs::read_to_string(place.path("table/table1.json")).unwrap());
    // it has no file whose values could be changed
    assert_eq!(place.run(&["rough", "--table1", "--set", "load.pressure=1 MPa"]).status, 2);
}

#[test]
fn help_manual_completions_and_schema_are_there() {
    let place = Place::with_scene("");
    let run = |args: &[&str]| {
        let end = place.run(args);
        assert_eq!((end.status, end.err.as_str()), (0, ""), "{args:?}");
        end.out
    };
    let help = run(&["--help"]);
    for command in ["reproduce", "crush", "mesh", "calibrate", "rough", "new", "schema", "completions", "man"]
    {
        assert!(help.contains(command), "{command}");
        let page = run(&["man", command]);
        assert!(page.contains(".TH") && page.contains(command), "{command}");
    }
    assert!(run(&["man"]).contains("Examples") && run(&["man", "crush"]).contains("Examples"));
    assert_eq!(place.run(&["man", "melt"]).status, 2);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let text = run(&["completions", shell]);
        assert!(
            text.contains("reproduce") && (shell != "bash" || text.contains("draft standard reference")),
            "{shell}"
        );
    }
    for kind in ["scene", "rough", "sweep", "study", "fit"] {
        let schema: serde_json::Value = serde_json::from_str(&run(&["schema", kind])).unwrap();
        assert!(schema["properties"].is_object(), "{kind}");
    }
}

/// A crush with fields leaves a picture of the peak; one without leaves none.
#[test]
fn a_picture_is_drawn_only_with_fields() {
    let place = Place::with_scene(common::SCENE);
    let pictures = |out: &str| place.names(out).iter().filter(|n| n.starts_with("section_")).count();
    place.run(&["crush", "scene.toml", "--out", "plain"]);
    assert_eq!(pictures("plain"), 0);
    let end = place.run(&["crush", "scene.toml", "--set", "output.every=100", "--out", "drawn"]);
    assert_eq!((end.status, pictures("drawn")), (0, 1), "{}", end.err);
}
