//! Slips in names of files, keys and values lead to what was meant.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use asperity::input::missing_file::unreadable;
use asperity::input::suggest::{nearest, reword};

#[test]
fn a_slip_in_a_name_finds_the_file_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["single.toml", "map.sur"] {
        std::fs::write(folder.path().join(name), "").unwrap();
    }
    let told = |name: &str| {
        let path = folder.path().join(name);
        unreadable(&path, &std::fs::metadata(&path).unwrap_err())
    };
    for (slip, file) in [("singel.toml", "single.toml"), ("single", "single.toml"), ("map.srf", "map.sur")] {
        let error = told(slip);
        assert!(error.to_string().contains(slip) && !error.to_string().contains("os error"), "{error}");
        let help = error.help.unwrap();
        assert!(help.contains(file), "{slip}: {help}");
    }
    assert!(told("elsewhere.dat").help.is_none());
}

#[test]
fn a_slip_finds_its_word_and_a_foreign_word_none() {
    let keys = ["height", "slope_deg", "tip_radius", "valley_radius", "spacing", "radius"];
    for (word, meant) in
        [("hieght", "height"), ("slope", "slope_deg"), ("tipradius", "tip_radius"), ("Radius", "radius")]
    {
        assert_eq!(nearest(word, &keys), Some(meant), "{word}");
    }
    assert_eq!(nearest("colour", &keys), None);
}

#[test]
fn serde_is_put_into_plain_words() {
    let (message, help) = reword("unknown field `depht`, expected one of `depth`, `force`");
    assert_eq!(message, "unknown key `depht`");
    assert_eq!(help.unwrap(), "did you mean `depth`? Known here: depth, force");
    let (message, help) = reword("unknown field `contact`, expected one of `element`, `newton_tolerance`");
    assert_eq!(message, "the key `contact` is gone");
    assert!(help.unwrap().contains("leave numerics.contact out"));
    let (message, help) = reword("unknown field `force`, expected one of `pressure`, `separation`, `unload`");
    assert_eq!(message, "unknown key `force`");
    assert!(help.unwrap().contains("load.pressure = force / area"));
    assert!(reword("unknown field `contact`, expected `tool`").0.contains("unknown key"));
    for (field, example) in [
        ("tool", None),
        ("slope_deg", Some("for example slope_deg = 10")),
        ("closure", Some("for example closure = \"all\"")),
    ] {
        let (message, help) = reword(&format!("missing field `{field}`"));
        assert_eq!((message.as_str(), help.as_deref()), (&*format!("`{field}` is missing"), example));
    }
    for (message, way_out) in [
        ("unknown variant `table`, expected `hollomon` or `swift`", "hardening_exponent"),
        ("unknown field `lambda_c`, expected one of `file`, `s_filter`, `l_filter`", "surface.l_filter"),
        ("unknown field `filter`, expected one of `file`, `s_filter`, `l_filter`", "surface.s_filter"),
    ] {
        assert!(reword(message).1.unwrap().contains(way_out), "{message}");
    }
    assert_eq!(
        reword("invalid type: string \"x\", expected f64").0,
        "invalid type: string \"x\", expected a number without quotes"
    );
}
