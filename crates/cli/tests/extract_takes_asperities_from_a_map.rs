//! `asperity extract`: asperities of a map, their profiles and scenes, closures beside finite elements;
//! several maps pressed.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Place;
use std::fmt::Write;

const NODES: usize = 121;
/// tan β of the cones.
const SLOPE: f64 = 0.1;

/// A table of heights in µm, a node a µm: four cones of different height on a plane.
fn cones() -> String {
    let summits = [(30.0, 30.0, 3.0), (90.0, 30.0, 2.8), (30.0, 90.0, 2.6), (90.0, 90.0, 2.4)];
    let height = |x: f64, y: f64| {
        summits.iter().map(|(a, b, top)| top - SLOPE * (x - a).hypot(y - b)).fold(0.0, f64::max)
    };
    let mut text = String::new();
    for row in 0..NODES {
        let line: Vec<String> = (0..NODES).map(|x| height(x as f64, row as f64).to_string()).collect();
        writeln!(text, "{}", line.join(",")).unwrap();
    }
    text
}

const METAL: &str = r#"closure = "all"
[surface]
file = "cones.csv"
height_unit = "um"
pixel_size = ["1 um", "1 um"]
level = "none"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
yield_stress = "300 MPa"
hardening_exponent = 0.3
[load]
pressure = "20 MPa"
"#;

/// A folder with a map of cones, a scene of it, and a map that is flat.
fn place() -> Place {
    let place = Place::with_scene(METAL);
    std::fs::write(place.path("cones.csv"), cones()).unwrap();
    std::fs::write(place.path("flat.csv"), "1,1,1\n1,1,1\n1,1,1\n").unwrap();
    place
}

/// Rows of a file by the names of their columns.
fn rows(place: &Place, name: &str) -> Vec<std::collections::HashMap<String, String>> {
    let text = place.text(name);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    reader.deserialize().map(Result::unwrap).collect()
}

fn number(row: &std::collections::HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {row:?}"))
}

#[test]
fn cones_give_their_numbers_profiles_and_scenes() {
    let place = place();
    let done = place.run(&[
        "extract",
        "scene.toml",
        "--hills",
        "--profiles",
        "3",
        "--line",
        "y=30 um",
        "--out",
        "out",
    ]);
    assert_eq!(done.status, 0, "{}", done.err);
    let found = rows(&place, "out/asperities.csv");
    let cones: Vec<_> = found.iter().filter(|row| number(row, "height_um") > 1.0).collect();
    assert_eq!(cones.len(), 4);
    for (row, (x, y)) in cones.iter().zip([(30.0, 30.0), (90.0, 30.0), (30.0, 90.0), (90.0, 90.0)]) {
        assert!((number(row, "x_um") - x).abs() < 1e-9 && (number(row, "y_um") - y).abs() < 1e-9);
        assert!(number(row, "rise_um") > 2.0 && row["cut"] == "true");
    }
    // hills reach the edges here; islands do not
    let plane = [
        "extract",
        "scene.toml",
        "--separation",
        "1 um",
        "--profiles",
        "3",
        "--line",
        "y=30 um",
        "--out",
        "islands",
    ];
    let done = place.run(&plane);
    assert_eq!(done.status, 0, "{}", done.err);
    let found = rows(&place, "islands/asperities.csv");
    assert_eq!(found.len(), 4);
    for row in &found[..3] {
        assert!((number(row, "slope_deg") / SLOPE.atan().to_degrees() - 1.0).abs() < 0.01, "{row:?}");
        assert!((number(row, "profile_area_um2") / number(row, "area_um2") - 1.0).abs() < 0.01);
        assert!((number(row, "depth_um") - number(row, "rise_um")).abs() < 1e-12 && row["status"] == "ok");
    }
    assert!(found[3]["status"].is_empty() && found[3]["depth_um"].is_empty());
    assert_eq!(place.names("islands/profiles"), ["001.csv", "002.csv", "003.csv", "line-y-30um.csv"]);
    assert_eq!(place.names("islands/scenes"), ["001.toml", "002.toml", "003.toml", "line-y-30um.toml"]);
    let profile = rows(&place, "islands/profiles/001.csv");
    assert!(number(&profile[0], "r_um") == 0.0 && number(profile.last().unwrap(), "z_um") == 0.0);
    let line = rows(&place, "islands/profiles/line-y-30um.csv");
    assert!(line.len() == NODES && (number(&line[30], "z_um") - 3.0).abs() < 1e-9);
    assert!(place.text("islands/scenes/line-y-30um.toml").contains("plane-strain"));
    let picture = std::fs::read(place.path("islands/asperities.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG"));
    // what an earlier run left is replaced
    assert_eq!(
        place
            .run(&["extract", "scene.toml", "--separation", "1 um", "--profiles", "1", "--out", "islands"])
            .status,
        0
    );
    assert_eq!(place.names("islands/scenes"), ["001.toml"]);
}

#[test]
fn what_cannot_be_taken_is_an_error_that_says_why() {
    let place = place();
    let units = ["--set", "surface.height_unit=um", "--set", "surface.pixel_size=[\"1 um\", \"1 um\"]"];
    for (words, said) in [
        (&["scene.toml", "--separation", "9 um"][..], "above the highest point"),
        (&["scene.toml", "--separation=-9 um"], "below the lowest point"),
        (&["scene.toml", "--separation", "1 um", "--crush", "9"], "only 4 of 4 have a profile"),
        (&["scene.toml", "--share", "1.5"], "above 0 and below 1"),
        (&["scene.toml", "--hills", "1"], "below 1"),
        (&["scene.toml", "--depth=-1 um"], "must be above 0"),
        (&["scene.toml", "--line", "y=900 um"], "beside the map"),
        (&["scene.toml", "--line", "z=1 um"], "x=PLACE"),
        (&["scene.toml", "--share", "0.1", "--hills"], "cannot be used with"),
        (&["cones.csv"], "height_unit"),
        (&["nothing.sur"], "nothing.sur"),
    ] {
        let done = place.run(&[&["extract"], words].concat());
        assert!(done.status == 2 && done.err.contains(said), "{words:?}: {} {}", done.status, done.err);
        assert!(place.names("out").is_empty(), "{words:?}");
    }
    let flat = place.run(&[&["extract", "flat.csv"][..], &units].concat());
    assert!(flat.status == 2 && flat.err.contains("the map is flat"), "{}", flat.err);
}

#[test]
fn several_maps_give_one_table_and_a_bad_one_is_named() {
    let place = place();
    std::fs::create_dir(place.path("b")).unwrap();
    std::fs::write(place.path("b/cones.csv"), cones()).unwrap();
    let done = place.run(&[
        "rough",
        "cones.csv",
        "b/cones.csv",
        "flat.csv",
        "--like",
        "scene.toml",
        "--set",
        "judge=false",
        "--out",
        "all",
    ]);
    assert!(done.status == 1 && done.err.contains("1 of 3 surfaces"), "{} {}", done.status, done.err);
    let surfaces = rows(&place, "all/surfaces.csv");
    let names: Vec<&str> = surfaces.iter().map(|row| row["surface"].as_str()).collect();
    assert_eq!(names, ["cones", "cones-2", "flat"]);
    assert!(surfaces[1]["status"] == "ok" && surfaces[2]["status"].contains("flat"));
    let spv = ["sp_um", "sv_um"].map(|name| number(&surfaces[0], name)).iter().sum::<f64>();
    assert!((spv - number(&surfaces[0], "sz_um")).abs() < 1e-12 && number(&surfaces[0], "sdr") > 0.0);
    let table = rows(&place, "all/table.csv");
    assert!(table.len() > 8 && table.iter().any(|row| row["surface"] == "cones-2"));
    let own = place.names("all/cones-2");
    for file in ["table.csv", "bearing.csv", "spectrum.csv", "gaps.csv", "summary.json"] {
        assert!(own.iter().any(|name| name == file), "{file}: {own:?}");
    }
    let gaps = rows(&place, "all/cones/gaps.csv");
    assert_eq!(number(gaps.last().unwrap(), "share"), 1.0);
    let bearing = rows(&place, "all/cones/bearing.csv");
    assert!(number(&bearing[0], "material_ratio") == 0.0 && bearing.len() == 201);
}

/// The calibrated closure comes from cones that this program has crushed: on a cone of the map it must find
/// their force again.
#[test]
fn crushed_cones_agree_with_the_closure_that_was_made_from_cones() {
    let place = place();
    let words = [
        "extract",
        "scene.toml",
        "--separation",
        "1.4 um",
        "--crush",
        "2",
        "--accuracy",
        "draft",
        "--out",
        "out",
    ];
    let done = place.run(&words);
    assert_eq!(done.status, 0, "{}", done.err);
    let table = place.text("out/compared.csv");
    let found = rows(&place, "out/compared.csv");
    let closures = [
        "finite-elements",
        "published",
        "fitted",
        "johnson",
        "sneddon",
        "calibrated",
        "half-space",
        "half-space-plastic",
    ];
    for (i, row) in found.iter().enumerate() {
        assert_eq!(row["closure"], closures[i % closures.len()]);
        assert!(number(row, "force_N") > 0.0 && number(row, "contact_area_um2") > 0.0, "{row:?}");
    }
    assert_eq!(found.len(), 2 * 4 * closures.len());
    // at the full depth of both asperities: the force to 2.3 and 1.9 %, of which draft is most (0.8 and 0.9 %
    // at standard); the area is 7.9 and 9.7 % too large (7.8 and 7.5 % at standard), most of it by the
    // contact ratio of the table, 0.943, where cones of this metal have 0.920
    for row in found.iter().filter(|row| row["closure"] == "calibrated").skip(3).step_by(4) {
        assert!((number(row, "force_over_finite_elements") - 1.0).abs() < 0.03, "{row:?}");
        assert!((1.04..1.1).contains(&number(row, "area_over_finite_elements")), "{row:?}");
    }
    // Love's cone: the exact elastic answer on a half-space
    let of = |name: &str| found.iter().rev().find(|row| row["closure"] == name).unwrap();
    let elastic = number(of("half-space"), "force_N") / number(of("sneddon"), "force_N");
    assert!((elastic - 1.0).abs() < 0.005, "{elastic}");
    assert_eq!(place.names("out/curves"), ["001.csv", "002.csv"]);
    assert!(place.text("out/compared.svg").contains("contact area over finite elements"));
    // again: from the journal, the same bytes
    let again = place.run(&words);
    assert!(again.status == 0 && again.err.contains("2 asperities of an earlier start"), "{}", again.err);
    assert_eq!(place.text("out/compared.csv"), table);
}

/// Of a scene under \"all\" the plane is that of the first closure, which the summary names, or that of the
/// one that is asked for.
#[test]
fn the_plane_is_that_of_a_named_closure() {
    let place = place();
    let plane = |args: &[&str]| {
        let words =
            [&["extract", "scene.toml", "--profiles", "1", "--out", "out", "--force"][..], args].concat();
        let done = place.run(&words);
        assert_eq!(done.status, 0, "{}", done.err);
        let summary: serde_json::Value = serde_json::from_str(&place.text("out/summary.json")).unwrap();
        (summary["separation_closure"].clone(), summary["separation_um"].as_f64().unwrap(), done.out)
    };
    let (first, published, text) = plane(&[]);
    assert!(
        first == "published" && text.contains("where closure \"published\" carries 20 MPa"),
        "{first} {text}"
    );
    let (named, sneddon, text) = plane(&["--closure", "sneddon"]);
    assert!(named == "sneddon" && text.contains("closure \"sneddon\" carries"), "{named} {text}");
    // a cone of Sneddon carries more at the same depth (0.32 E* for 0.13 E*), so that its plane is higher
    assert!(sneddon > published, "{sneddon} {published}");
    assert!(plane(&["--share", "0.1"]).0.is_null());
    for (args, word) in [
        (&["--closure", "half-space"][..], "published, fitted, johnson, sneddon, calibrated"),
        (&["--closure", "sneddon", "--share", "0.1"], "cannot be used with"),
        (&["--closure", "sneddon", "--set", "load={ separation = \"1 um\" }"], "load.separation"),
        (&["--depth", "-1 um"], "must be above 0"),
    ] {
        let done = place.run(&[&["extract", "scene.toml", "--out", "other"][..], args].concat());
        assert!(done.status == 2 && done.err.contains(word), "{word}: {}", done.err);
    }
}

/// The commands of the tutorial on measured summits, in their order.
#[test]
fn the_page_from_a_profilometer_to_a_force_curve_runs() {
    let page = std::fs::read_to_string(
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/tutorials/extract.md"),
    )
    .unwrap();
    let blocks = |kind: &str| {
        let fence = format!("```{kind}\n");
        let starts = page.split(fence.as_str()).skip(1);
        starts.map(|rest| rest.split("```").next().unwrap().to_string()).collect::<Vec<_>>()
    };
    let place = place();
    std::fs::write(place.path("map.toml"), &blocks("toml")[0]).unwrap();
    let mut count = 0;
    for line in blocks("sh").iter().flat_map(|block| block.lines()) {
        // a word in quotes holds a space
        let words: Vec<String> = line.split('"').enumerate().fold(Vec::new(), |mut words, (i, part)| {
            match i % 2 {
                0 => words.extend(part.split_whitespace().map(str::to_string)),
                _ => words.push(part.to_string()),
            }
            words
        });
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let done = place.run(words.strip_prefix(&["asperity"]).unwrap());
        assert_eq!(done.status, 0, "{line}: {}", done.err);
        count += 1;
    }
    assert_eq!(count, 6);
    for file in
        ["asperities/asperities.csv", "one/curve.csv", "line-crushed/curve.csv", "compared/compared.csv"]
    {
        assert!(place.text(file).lines().count() > 4, "{file}");
    }
    // the picture stands at the side of the page
    for picture in page.split("](").skip(1).filter_map(|rest| rest.strip_prefix("output/")) {
        let name = picture.split(')').next().unwrap();
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../docs/src/tutorials/output")
            .join(name);
        assert!(path.is_file(), "{name}");
    }
}
