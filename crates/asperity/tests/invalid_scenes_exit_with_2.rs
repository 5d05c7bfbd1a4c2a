//! Every wrong scene ends with status 2 and an error that shows the line and the allowed range; nothing is written.

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
    ("\"5 um\"", "\"5 um\"\nforce = \"1 N\"", &["scene.toml:17:", "does not go with `depth`"]),
    ("depth = \"5 um\"", "force = \"1 N/mm\"", &["scene.toml:16:", "plane strain"]),
    ("\"plane\"", "\"banana\"", &["scene.toml:14:", "unknown value `banana`", "plane, cone, sphere"]),
    ("\"plane\"", "\"cone\"", &["scene.toml:13:", "`slope_deg` of the cone is missing"]),
    ("[tool]\nshape = \"plane\"", "[tool]", &["scene.toml", "`shape` is missing"]),
    ("\"axisymmetric\"", "\"plane-strain\"", &["scene.toml", "substrate", "is missing"]),
    ("steps = 8", "steps = 0", &["scene.toml:21:", "from 1 to 10000", "not 0"]),
    ("steps = 8", "steps = -8", &["scene.toml:21:", "a whole number from 0 up"]),
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
    refused(&place, &["crush", "nowhere.toml"], &["cannot read nowhere.toml"], "missing file");
    refused(&place, &["crush", "."], &["cannot read ."], "a folder");
    refused(&place, &["mesh", "scene.toml", "-o", "mesh.stl"], &[".vtu", ".msh", ".inp"], "mesh format");
    refused(
        &place,
        &["mesh", "scene.toml", "-o", "nowhere/mesh.msh"],
        &["cannot write nowhere/mesh.msh"],
        "no folder",
    );
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
