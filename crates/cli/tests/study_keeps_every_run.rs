//! A study over any key of any scene: the numbers of single runs, every run once whatever happens, the same
//! bytes in parts, failures as rows, and wrong input as an error that names the key.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const ROUGH: &str = r#"closure = "published"
[surface.generate]
kind = "milled"
ra = "2.95 um"
mean_slope_deg = 4.08
size = ["1 mm", "1 mm"]
pixels = [64, 64]
seed = 1
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
hardness = "1280 MPa"
[load]
pressure = "100 MPa"
"#;

const STUDY: &str = r#"scene = "scene.toml"
curves = true
[vary]
material.hardening_exponent = [0.1, 0.3]
"loading.depth" = "1 um..4 um/4"
[set]
loading.unload = false
"#;

/// The cells of a table by column.
fn column(text: &str, name: &str) -> Vec<String> {
    let mut table = csv::Reader::from_reader(text.as_bytes());
    let at =
        table.headers().unwrap().iter().position(|head| head == name).unwrap_or_else(|| panic!("{text}"));
    table.records().map(|row| row.unwrap()[at].to_string()).collect()
}

#[test]
fn a_killed_study_ends_with_the_bytes_of_an_undisturbed_one_and_so_do_its_parts() {
    let place = Place::with_scene(SCENE);
    std::fs::write(place.path("study.toml"), STUDY).unwrap();
    let clock = Instant::now();
    let end = place.run(&["study", "study.toml", "--out", "whole"]);
    assert_eq!(end.status, 0, "{}", end.err);
    let whole = clock.elapsed();
    for share in [0.2, 0.3, 0.5] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .current_dir(place.path(""))
            .args(["study", "study.toml", "--out", "killed", "--threads", "1"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_secs_f64(share * whole.as_secs_f64()));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert_eq!(place.run(&["study", "study.toml", "--out", "killed"]).status, 0);
    for part in ["1", "2", "3"] {
        let shard = format!("{part}/3");
        assert_eq!(place.run(&["study", "study.toml", "--shard", &shard, "--out", part]).status, 0);
    }
    let missing = place.run(&["study", "merge", "1", "3", "--out", "merged"]);
    assert!(missing.status == 2 && missing.err.contains("3 of 8"), "{}", missing.err);
    assert!(!place.path("merged").exists(), "wrong input leaves nothing");
    let end = place.run(&["study", "merge", "3", "1", "2", "--out", "merged"]);
    assert_eq!(end.status, 0, "{}", end.err);
    let results = place.text("whole/results.csv");
    for other in ["killed", "merged"] {
        assert_eq!(place.text(&format!("{other}/results.csv")), results, "{other}");
        assert_eq!(place.text(&format!("{other}/study.svg")), place.text("whole/study.svg"), "{other}");
        for curve in column(&results, "curve") {
            assert_eq!(place.text(&format!("{other}/{curve}")), place.text(&format!("whole/{curve}")));
        }
    }
    // a study that grows runs only what is new: its journal gains as many lines
    let lines = |folder: &str| place.text(&format!("{folder}/study.journal")).lines().count();
    let before = lines("killed");
    let end = place.run(&["study", "study.toml", "--vary", "loading.depth=1 um..5 um/5", "--out", "killed"]);
    assert_eq!((end.status, lines("killed") - before), (0, 2), "{}", end.err);
    assert_eq!(column(&place.text("killed/results.csv"), "status").len(), 10);
}

#[test]
fn a_row_has_the_numbers_of_its_run() {
    let place = Place::with_scene(SCENE);
    let vary = ["--vary", "material.hardening_law=hollomon,swift", "--vary", "loading.depth=2 um"];
    let end = place.run(&[&["study", "scene.toml", "--out", "study"][..], &vary].concat());
    assert_eq!(end.status, 0, "{}", end.err);
    let sets = ["--set", "material.hardening_law=swift", "--set", "loading.depth=2 um"];
    assert_eq!(place.run(&[&["crush", "scene.toml", "--out", "one"][..], &sets].concat()).status, 0);
    let summary: serde_json::Value = serde_json::from_str(&place.text("one/summary.json")).unwrap();
    let table = place.text("study/results.csv");
    assert_eq!(column(&table, "material.hardening_law"), ["hollomon", "swift"]);
    for (name, value) in [
        ("peak_force_N", &summary["peak_force_N"]),
        ("elastic_fraction", &summary["elastic_fraction"]),
        ("energy_balance_error", &summary["energy_balance_error"]),
        ("dofs", &summary["dofs"]),
    ] {
        assert_eq!(column(&table, name)[1], value.to_string(), "{name}");
    }
    // an error that is not known, where the scene fixes mesh and steps, is an empty cell
    assert_eq!(column(&table, "errors.force"), ["", ""]);
    assert!(!table.contains("wall_s") && column(&place.text("study/times.csv"), "wall_s").len() == 2);
}

#[test]
fn rough_scenes_are_varied_too() {
    let place = Place::with_scene(ROUGH);
    let vary = ["--vary", "closure=sneddon,all", "--vary", "load.pressure=50 MPa,100 MPa"];
    let end = place.run(&[&["study", "scene.toml", "--out", "study"][..], &vary].concat());
    assert_eq!(end.status, 0, "{}", end.err);
    let set = ["--set", "closure=sneddon", "--set", "load.pressure=100 MPa"];
    assert_eq!(place.run(&[&["rough", "scene.toml", "--out", "one"][..], &set].concat()).status, 0);
    let (table, one) = (place.text("study/results.csv"), place.text("one/table.csv"));
    assert_eq!(column(&table, "contact_area_ratio")[1], column(&one, "contact_area_ratio")[0]);
    assert_eq!(column(&table, "sneddon.contact_area_ratio")[3], column(&one, "contact_area_ratio")[0]);
    // of an area the picture shows the one that is corrected for pixels
    let shown = |folder: &str| {
        let picture = place.text(&format!("{folder}/study.svg"));
        let named: Vec<&str> = picture.lines().filter(|line| line.contains("contact_area_ratio")).collect();
        !named.is_empty() && named.iter().all(|line| line.contains("contact_area_ratio_corrected"))
    };
    assert!(shown("study"));
    let vary = ["--vary", "load.pressure=50 MPa,100 MPa", "--set", "closure=half-space"];
    let end = place.run(&[&["study", "scene.toml", "--out", "half-space"][..], &vary].concat());
    assert_eq!(end.status, 0, "{}", end.err);
    assert!(shown("half-space"));
}

#[test]
fn a_combination_that_makes_no_sense_is_a_row_with_its_reason() {
    let place = Place::with_scene(SCENE);
    // 12 um is deeper than the lower asperity is high
    let vary = ["--vary", "asperity[0].height=10 um,20 um", "--vary", "loading.depth=1 um,12 um"];
    let end = place.run(&[&["study", "scene.toml", "--out", "study"][..], &vary].concat());
    assert_eq!(end.status, 0, "{}", end.err);
    let table = place.text("study/results.csv");
    let status = column(&table, "status");
    assert!(status[1].contains("10 um deep") && [0, 2, 3].iter().all(|i| status[*i] == "ok"), "{status:?}");
    assert_eq!(column(&table, "peak_force_N")[1], "");
}

#[test]
fn wrong_input_names_the_key_and_leaves_nothing() {
    let place = Place::with_scene(SCENE);
    for (args, said) in [
        (&["--vary", "material.harden=1,2"][..], "harden`"),
        (&["--vary", "material.hardening_exponent=0.1,5"], "material.hardening_exponent: must be"),
        (&["--vary", "loading.depth=1 um,soft"], "loading.depth"),
        (&["--vary", "loading.depth="], "loading.depth: no values"),
        (&["--vary", "loading.depth=1 um..1 um/3"], "loading.depth: the range"),
        (&["--vary", "loading.depth=1 um..2 um"], "loading.depth: a range"),
        (&["--vary", "loading.depth=1 um,2 um", "--set", "loading.depth=1 um"], "loading.depth: is varied"),
        (&["--vary", "loading.depth=1 um..2 um", "--sample", "lhs"], "how many points"),
        (&["--vary", "loading.depth=1 um..2 um", "--sample", "halton", "4"], "halton"),
        (&[], "at least one key"),
    ] {
        let end = place.run(&[&["study", "scene.toml", "--out", "out"], args].concat());
        assert!(end.status == 2 && end.err.contains(said), "{args:?}: {} {}", end.status, end.err);
    }
    let file = STUDY.replace("[vary]", "[very]");
    std::fs::write(place.path("study.toml"), file).unwrap();
    let end = place.run(&["study", "study.toml", "--out", "out"]);
    assert!(end.status == 2 && end.err.contains("`very`"), "{}", end.err);
    assert_eq!(place.names(""), ["scene.toml", "study.toml"]);
}

#[test]
fn drawn_points_lie_in_their_ranges() {
    let place = Place::with_scene(SCENE);
    let vary = ["--vary", "material.hardening_exponent=0..0.5", "--vary", "loading.depth=0.5 um..1 um"];
    for sample in [&["--sample", "lhs", "4", "--seed", "2"][..], &["--sample", "sobol", "4"]] {
        let out = sample[1];
        let end = place.run(&[&["study", "scene.toml", "--out", out, "--quiet"], &vary[..], sample].concat());
        assert_eq!((end.status, end.err.as_str()), (0, ""));
        let table = place.text(&format!("{out}/results.csv"));
        let mut quarters: Vec<usize> = column(&table, "material.hardening_exponent")
            .iter()
            .map(|n| (n.parse::<f64>().unwrap() * 8.0) as usize)
            .collect();
        quarters.sort_unstable();
        assert_eq!(quarters, [0, 1, 2, 3], "{out}");
        assert!(column(&table, "status").iter().all(|s| s == "ok"), "{table}");
    }
}

/// The outline lies beside the scene, not where the study is run: every run finds it, and what stands in it
/// is part of the study.
#[test]
fn a_scene_with_a_measured_outline_is_varied() {
    let place = Place::with_scene("");
    std::fs::create_dir(place.path("measured")).unwrap();
    let cone = "[[asperity]]\nheight = \"20 um\"\nslope_deg = 10\ntip_radius = \"10 um\"\n";
    let scene = SCENE.replace(cone, "[[asperity]]\nprofile = \"cap.csv\"\n");
    assert_ne!(scene, SCENE);
    std::fs::write(place.path("measured/scene.toml"), scene).unwrap();
    let cap = |height: f64| {
        let point = |i: i32| format!("{i},{}\n", height * (1.0 - f64::from(i * i) / 6400.0));
        format!("r_um,z_um\n{}", (0..=80).map(point).collect::<String>())
    };
    std::fs::write(place.path("measured/cap.csv"), cap(20.0)).unwrap();
    std::fs::write(place.path("measured/flat.csv"), cap(10.0)).unwrap();
    let run = |args: &[&str]| {
        let end = place.run(&[&["study"], args, &["--quiet"]].concat());
        assert_eq!((end.status, end.err.as_str()), (0, ""));
    };
    let forces = |folder: &str| -> Vec<f64> {
        let table = place.text(&format!("{folder}/results.csv"));
        assert!(column(&table, "status").iter().all(|s| s == "ok"), "{table}");
        column(&table, "peak_force_N").iter().map(|f| f.parse().unwrap()).collect()
    };
    run(&["measured/scene.toml", "--vary", "loading.depth=1 um,2 um", "--out", "depths"]);
    let depths = forces("depths");
    assert!(depths[1] > 1.9 * depths[0], "{depths:?}");
    let file = "scene = \"measured/scene.toml\"\n[vary]\n\"loading.depth\" = [\"1 um\", \"2 um\"]\n";
    std::fs::write(place.path("study.toml"), file).unwrap();
    run(&["study.toml", "--out", "file"]);
    assert_eq!(forces("file"), depths);
    let shapes = ["--vary", "asperity[0].profile=\"cap.csv\",\"flat.csv\"", "--set", "loading.depth=2 um"];
    let all = [&["measured/scene.toml", "--out", "shapes"], &shapes[..]].concat();
    run(&all);
    let found = forces("shapes");
    assert_eq!(found[0], depths[1]);
    assert!(found[1] > 1.2 * found[0], "a flatter cap is stiffer: {found:?}");
    // another outline under the same name is another study
    std::fs::write(place.path("measured/flat.csv"), cap(12.0)).unwrap();
    let end = place.run(&[&["study"], &all[..], &["--quiet"]].concat());
    assert!(end.status != 0 || forces("shapes")[1] != found[1], "{}", end.err);
}

/// Runs of another accuracy cost seconds or days: they stay in their journal, which goes on where it was.
#[test]
fn runs_of_other_settings_are_kept_and_told() {
    let place = Place::with_scene(SCENE);
    let study = |vary: &str, more: &[&str]| {
        let usual = ["study", "scene.toml", "--vary", vary, "--out", "out"];
        let end = place.run(&[&usual[..], more].concat());
        assert_eq!(end.status, 0, "{}", end.err);
        end.err
    };
    let first = "loading.depth=1 um,2 um";
    study(first, &[]);
    let (journal, table) = (place.text("out/study.journal"), place.text("out/results.csv"));
    let said = study(first, &["--accuracy", "standard"]);
    assert!(said.contains("study.journal.old") && said.contains("accuracy"), "{said}");
    assert_eq!(place.text("out/study.journal.old"), journal);
    // a second one finds a name of its own
    let said = study(first, &["--set", "material.poissons_ratio=0.2"]);
    assert!(said.contains("study.journal.old2"), "{said}");
    assert_eq!(place.text("out/study.journal.old"), journal);
    // put back, its runs are not run again
    std::fs::rename(place.path("out/study.journal.old"), place.path("out/study.journal")).unwrap();
    study(first, &[]);
    assert_eq!((place.text("out/study.journal"), place.text("out/results.csv")), (journal, table));
    // other values share the journal
    let said = study("loading.depth=2 um,3 um", &[]);
    assert!(said.contains("1 run with other values"), "{said}");
    assert_eq!(place.text("out/study.journal").lines().count(), 4);
}

#[test]
fn a_damaged_line_of_a_journal_costs_its_own_run_only() {
    let place = Place::with_scene(SCENE);
    let study =
        || place.run(&["study", "scene.toml", "--vary", "loading.depth=1 um,2 um,3 um", "--out", "out"]);
    assert_eq!(study().status, 0);
    let (journal, table) = (place.text("out/study.journal"), place.text("out/results.csv"));
    let mut bytes = journal.clone().into_bytes();
    let second = journal.find('\n').unwrap() + 1;
    bytes[second + 40] ^= 4;
    std::fs::write(place.path("out/study.journal"), bytes).unwrap();
    let end = study();
    assert!(end.status == 0 && end.err.contains("1 run in the journal cannot be read"), "{}", end.err);
    assert!(end.err.contains("2 runs of an earlier start"), "{}", end.err);
    assert_eq!(place.text("out/results.csv"), table);
    assert_eq!(place.text("out/study.journal").lines().count(), 5, "one line more");
}

/// A count of values that would fill the memory is refused before they are listed.
#[test]
fn a_study_of_a_billion_runs_is_refused_at_once() {
    let place = Place::with_scene(SCENE);
    let start = Instant::now();
    for vary in ["loading.depth=1 um..3 um/1000000000", "loading.depth=1 um..3 um/18446744073709551615"] {
        let end = place.run(&["study", "scene.toml", "--vary", vary, "--out", "out"]);
        assert!(end.status == 2 && end.err.contains("more than 10000000 runs"), "{}", end.err);
    }
    let end = place.run(&["trade", "scene.toml", "--combinations", "1000000000", "--out", "out"]);
    assert!(end.status == 2 && end.err.contains("1000"), "{}", end.err);
    // four lists of 50,000 numbers, and their pairs
    let list = |unit: &str| {
        let values: Vec<String> = (0..50_000).map(|i| format!("\"{}.{i:05} {unit}\"", 1 + i % 7)).collect();
        format!("[{}]", values.join(","))
    };
    let numbers: Vec<String> = (0..50_000).map(|i| format!("0.1{i:05}")).collect();
    let sweep = format!(
        "slopes_deg = [{0}]\nhardening_exponent = [{0}]\nyoungs_modulus = {1}\nyield_stress = {2}\n",
        numbers.join(","),
        list("TPa"),
        list("GPa")
    );
    std::fs::write(place.path("sweep.toml"), sweep).unwrap();
    let end = place.run(&["calibrate", "sweep.toml", "--out", "out"]);
    assert!(end.status == 2 && end.err.contains("cases: give fewer values"), "{}", end.err);
    assert!(!place.path("out").exists() && start.elapsed() < Duration::from_secs(5));
}
