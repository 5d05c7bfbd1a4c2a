//! Claims about errors as a program prints them.

use asperity::InputError;

/// The form in which `main` prints an error that it returns.
#[test]
fn the_debug_form_of_an_error_names_line_and_way_out() {
    let error = InputError::new("bad depht").help("did you mean depth?").pointing_at(
        "scene",
        "a = 1\ndepht = 2\n",
        6..11,
    );
    assert_eq!(
        format!("{:?}", asperity::Error::from(error)),
        "bad depht\nscene, line 2: depht = 2\nhelp: did you mean depth?"
    );
}

#[test]
fn an_error_in_tables_names_the_key_by_its_path() {
    let text = "a = 1\n[[cone]]\nb = 1\n[[cone]]\nb = 2\n[tool]\nc = 3\n";
    for (at, path) in [(0, "a = 1"), (30, "cone[1].b = 2"), (43, "tool.c = 3"), (21, "[[cone]]")] {
        let error = InputError::new("bad").pointing_at("scene", text, at..at + 1).in_tables();
        assert_eq!(error.full(), format!("bad\n{path}"));
    }
}
