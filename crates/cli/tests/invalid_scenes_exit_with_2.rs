//! Every wrong scene ends with status 2 and an error that shows the line and the allowed range; nothing is
//! written.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};

/// A piece of the scene, what it is replaced by, and what the error must say.
const TABLE: &[(&str, &str, &[&str])] = &[
    ("poissons_ratio = 0.3", "poissons_ratio = 0.5", &["scene.toml:5:", "above -1 and below 0.5", "not 0.5"]),
    ("poissons_ratio = 0.3", "poissons_ratio = -1", &["scene.toml:5:", "above -1 and below 0.5"]),
    ("\"20 um\"", "\"20\"", &["scene.toml:10:", "\"20\" has no unit", "um, nm, mm"]),
    ("\"20 um\"", "20", &["scene.toml:10:", "a length as a string with a unit"]),
    ("\"20 um\"", "\"20 MPa\"", &["scene.toml:10:", "\"MPa\" is not a unit of length"]),
    ("\"20 um\"", "\"-20 um\"", &["scene.toml:10:", "above 0", "-20 um"]),
    ("\"20 um\"", "\"nan um\"", &["scene.toml:10:", "not a finite number"]),
    ("slope_deg = 10", "slope_deg = 0", &["scene.toml:11:", "above 0 and below 90", "not 0"]),
    ("slope_deg = 10", "slope_deg = 90", &["scene.toml:11:", "above 0 and below 90", "not 90"]),
    ("slope_deg = 10", "", &["scene.toml:9:", "`slope_deg` is missing"]),
    ("tip_radius = \"10 um\"", "tip_radius = \"2 mm\"", &["scene.toml:12:", "below 1.316", "not 2 mm"]),
    (
        "tip_radius",
        "tip_raduis",
        &["scene.toml:12:", "unknown key `tip_raduis`", "did you mean `tip_radius`?"],
    ),
    ("every = 0", "every = 0\ncolour = 1", &["scene.toml:20:", "unknown key `colour`", "fields, every"]),
    ("exponent = 0.3", "exponent = 1.0", &["scene.toml:7:", "at least 0 and below 1", "not 1"]),
    ("exponent = 0.3", "exponent = nan", &["scene.toml:7:", "at least 0 and below 1", "not NaN"]),
    ("exponent = 0.3", "exponent = \"0.3\"", &["scene.toml:7:", "a number without quotes"]),
    ("\"hollomon\"", "\"holomon\"", &["scene.toml:8:", "did you mean `hollomon`?"]),
    ("\"300 MPa\"", "\"300 GPa\"", &["scene.toml:6:", "from 0.21 to 42000 MPa", "not 300000 MPa"]),
    ("\"5 um\"", "\"500 um\"", &["scene.toml:16:", "at most 20 um", "not 500 um"]),
    ("\"5 um\"", "\"inf um\"", &["scene.toml:16:", "not a finite number"]),
    ("\"plane\"", "\"berkovich\"\narea_function = [1]", &["scene.toml:15:", "a unit of length as a word"]),
    ("\"5 um\"", "\"5 um\"\nforce = \"1 N\"", &["scene.toml:17:", "does not go with `depth`"]),
    ("depth = \"5 um\"", "force = \"1 N/mm\"", &["scene.toml:16:", "plane strain"]),
    ("\"plane\"", "\"banana\"", &["scene.toml:14:", "unknown value `banana`", "plane, cone, sphere"]),
    ("\"plane\"", "\"cone\"", &["scene.toml:13:", "`slope_deg` of the cone is missing"]),
    ("\"plane\"", "\"cone\"\nslope = 10", &["scene.toml:15:", "did you mean `slope_deg`?"]),
    ("\"plane\"", "\"cone\"\nhalf_apex_deg = 120", &["scene.toml:15:", "not 120", "between flank and axis"]),
    ("[tool]\nshape = \"plane\"", "[tool]", &["scene.toml", "`shape` is missing"]),
    ("\"axisymmetric\"", "\"plane-strain\"", &["scene.toml", "substrate", "is missing"]),
    ("steps = 8", "steps = 0", &["scene.toml:21:", "from 1 to 10000", "not 0"]),
    ("steps = 8", "steps = -8", &["scene.toml:21:", "a whole number from 0 up"]),
    (
        "steps = 8",
        "contact = \"penalty\"",
        &["scene.toml:21:", "`contact` is gone", "leave numerics.contact out"],
    ),
    ("[numerics]", "[numerics", &["scene.toml:20:"]),
    ("[numerics]", "[tool]", &["scene.toml:20:"]),
    (
        "[numerics]",
        "[mesh]\nfile = \"none.msh\"\n[numerics]",
        &["scene.toml:21:", "none.msh", "cannot be read"],
    ),
    (
        "[numerics]",
        "[mesh]\nfile = \"scene.toml\"\n[numerics]",
        &["scene.toml:21:", "line 1", "not an MSH file"],
    ),
];

fn refused(place: &Place, args: &[&str], words: &[&str], what: &str) {
    let end = place.run(args);
    assert_eq!(end.status, 2, "{what}\n{}", end.err);
    for word in words {
        assert!(end.err.contains(word), "{what}: {word} is not in\n{}", end.err);
    }
    assert_eq!(end.out, "", "{what}");
    assert_eq!(place.names("."), ["scene.toml"], "{what} left something");
}

#[test]
fn each_names_the_line_and_the_range() {
    for (old, new, words) in TABLE {
        assert!(SCENE.contains(old), "{old}");
        let place = Place::with_scene(SCENE.replacen(old, new, 1));
        refused(&place, &["crush", "scene.toml", "--out", "out"], words, new);
        refused(&place, &["mesh", "scene.toml", "-o", "mesh.msh"], words, new);
    }
}

#[test]
fn a_key_that_went_is_refused_in_an_override_too() {
    let place = Place::with_scene(SCENE);
    let args = ["crush", "scene.toml", "--set", "numerics.contact=augmented", "--out", "out"];
    refused(&place, &args, &["--set", "`contact` is gone", "leave numerics.contact out"], "--set");
}

/// The same with a second asperity beside the first.
const BESIDE: &[(&str, &[&str])] = &[
    ("spacing = \"-5 um\"", &["scene.toml:", "at least 0", "-5 um", "leave it out"]),
    ("valley_radius = \"700 um\"", &["scene.toml:", "valley_radius", "at most"]),
    ("valley_radius = \"-1 um\"", &["scene.toml:", "at least 0"]),
    ("height = \"0 um\"", &["scene.toml:", "height", "above 0"]),
    ("radius = \"50 um\"", &["scene.toml:", "radius", "does not go with"]),
];

#[test]
fn a_second_asperity_is_checked_too() {
    for (line, words) in BESIDE {
        let first = "[[asperity]]\nheight = \"20 um\"\nslope_deg = 10\n";
        assert!(SCENE.contains(first), "{SCENE}");
        let own = if line.starts_with("height") { "" } else { "height = \"20 um\"\n" };
        let two = format!("[[asperity]]\n{own}{line}\nslope_deg = 10\n{first}");
        let place = Place::with_scene(SCENE.replacen(first, &two, 1));
        refused(&place, &["crush", "scene.toml", "--out", "out"], words, line);
    }
}

#[test]
fn what_is_no_scene_at_all_is_refused() {
    let whole: &[(&[u8], &[&str])] = &[
        (b"", &["scene.toml is empty"]),
        (b"\n  \n", &["scene.toml is empty"]),
        (b"\x00\xff[[[", &["not a text file", "byte 2"]),
        (b"[[[", &["scene.toml:1:"]),
        (b"a = 1\n", &["unknown key `a`"]),
        (b"%PDF-1.4", &["scene.toml:1:"]),
    ];
    for (bytes, words) in whole {
        refused(
            &Place::with_scene(bytes),
            &["crush", "scene.toml", "--out", "out"],
            words,
            &format!("{bytes:?}"),
        );
    }
    let place = Place::with_scene(SCENE);
    refused(&place, &["crush", "nowhere.toml"], &["there is no file nowhere.toml"], "missing file");
    refused(&place, &["crush", "."], &["cannot read ."], "a folder");
    refused(&place, &["mesh", "scene.toml", "-o", "mesh.stl"], &[".vtu", ".msh", ".inp"], "mesh format");
    refused(
        &place,
        &["mesh", "scene.toml", "-o", "nowhere/mesh.msh"],
        &["cannot write nowhere/mesh.msh"],
        "no folder",
    );
}

/// A piece of the rough scene, what it is replaced by, and what the error must say.
const ROUGH: &[(&str, &str, &[&str])] = &[
    (
        "viscosity = \"1 mPa s\"",
        "viscosity = 1",
        &["scene.toml:16:", "a viscosity as a string with a unit, for example \"1 mPa s\""],
    ),
    ("viscosity = \"1 mPa s\"", "viscosity = \"1 mm\"", &["scene.toml:16:", "mPa s, Pa s or cP"]),
    ("\"hertz\"", "\"flat\"", &["scene.toml:2:", "unknown value `flat`", "hertz, cone, uniform"]),
    ("outliers = 8", "outliers = 1", &["scene.toml:5:", "1 must be at least 3"]),
    ("poissons_ratio = 0.3", "poissons_ratio = 0.5", &["scene.toml:8:", "above -1 and below 0.5, not 0.5"]),
    ("\"210 GPa\"", "\"0 GPa\"", &["scene.toml:7:", "above 0, not 0 GPa"]),
    ("\"1280 MPa\"", "\"1280 GPa\"", &["scene.toml:9:", "at most 210000 MPa, not 1280000 MPa", "unit"]),
    ("\"100 MPa\"", "\"-1 MPa\"", &["scene.toml:11:", "0 or above, not -1 MPa"]),
    (
        "outliers",
        "pixel_size = \"1 um\"\noutliers",
        &["none.npy", "cannot be read", "relative to the folder"],
    ),
];

#[test]
fn a_rough_scene_is_checked_too() {
    let scene = "closure = \"published\"\npressure_profile = \"hertz\"\n[surface]\nfile = \"none.npy\"\noutliers = 8\n\
                 [material]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\nhardness = \"1280 MPa\"\n[load]\n\
                 pressure = \"100 MPa\"\nunload = false\n[output]\nmaps = false\n[fluid]\nviscosity = \"1 mPa s\"\n\
                 pressures = [\"1 MPa\", \"0 MPa\"]\n";
    for (old, new, words) in ROUGH {
        assert!(scene.contains(old), "{old}");
        let place = Place::with_scene(scene.replacen(old, new, 1));
        refused(&place, &["rough", "scene.toml", "--out", "out"], words, new);
        refused(&place, &["extract", "scene.toml", "--out", "out"], words, new);
    }
    // a map on the command line is not shown as a scene that nobody wrote
    let words = ["there is no file none.npy", "give a map of heights"];
    refused(&Place::with_scene(scene), &["extract", "none.npy", "--out", "out"], &words, "no map");
}

#[test]
fn a_sweep_and_a_fit_are_checked_too() {
    let fit = "[material]\nyoungs_modulus = \"70 GPa\"\npoissons_ratio = 0.33\nyield_stress = [\"50 MPa\", \"2 GPa\"]\n\
               hardening_exponent = 0.2\n[[curve]]\nfeatures = { loading_curvature = \"27.41 GPa\" }\n\
               tool = { shape = \"berkovich\" }\nnoise = \"2 %\"\n";
    let cases: &[(&str, &str, &str, &[&str])] = &[
        ("identify", "\"2 %\"", "0.5", &["scene.toml:9:", "a percentage as a string, for example \"0.5 %\""]),
        ("identify", "\"2 %\"", "\"2\"", &["scene.toml:9:", "\"2\" is no percentage"]),
        ("identify", "\"2 %\"", "\"200 %\"", &["scene.toml:9:", "from 0 % to 50 %, not 200 %"]),
        (
            "identify",
            "yield_stress = [\"50 MPa\", \"2 GPa\"]",
            "",
            &["scene.toml:1:", "material: `yield_stress` is missing"],
        ),
    ];
    for (command, old, new, words) in cases {
        let place = Place::with_scene(fit.replacen(old, new, 1));
        refused(&place, &[command, "scene.toml", "--out", "out"], words, new);
    }
    for (value, words) in [
        ("poissons_ratio = 0.6", ["above -1 and below 0.5, not 0.6", "metals have"]),
        ("yield_stress = [\"300 GPa\"]", ["from 0.07 to 14000 MPa", "with E = 70 GPa"]),
    ] {
        refused(&Place::with_scene(value), &["calibrate", "scene.toml", "--out", "out"], &words, value);
    }
}

#[test]
fn flags_are_checked_like_the_file() {
    let place = Place::with_scene(SCENE);
    for (flags, words) in [
        (&["--set", "loading.depth=1 mm"][..], &["--set:1:1", "at most 20 um", "loading.depth=1 mm"][..]),
        (&["--set", "loading.dpeth=1 um"], &["--set:1:1", "did you mean `depth`?"]),
        (&["--set", "asperity[3].height=1 um"], &["from 0 to 1"]),
        (&["--set", "nonsense"], &["key.path=value"]),
        (&["--accuracy", "perfect"], &["draft", "standard", "reference"]),
        (&["--threads", "0"], &["--threads"]),
        (&["--threads", "many"], &["--threads"]),
    ] {
        refused(&place, &[&["crush", "scene.toml"], flags].concat(), words, &flags.join(" "));
    }
}
