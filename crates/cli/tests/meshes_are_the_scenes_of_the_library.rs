//! The scenes of the top folder `meshes` are those that the library holds, byte for byte: files there, so
//! that an archive and a checkout without symbolic links have them, and files of the crate, so that the crate
//! can be packaged whole.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

#[test]
fn each_file_holds_the_bytes_of_the_library() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        assert!(path.symlink_metadata().unwrap().is_file(), "{} is no file", path.display());
        let name = path.file_stem().unwrap().to_str().unwrap();
        let held = asperity::scenes::ALL.iter().find(|(scene, _)| *scene == name);
        let (_, text) = held.unwrap_or_else(|| panic!("the library holds no scene {name}"));
        assert!(
            std::fs::read(&path).unwrap() == text.as_bytes(),
            "meshes/{name}.toml and crates/asperity/scenes/{name}.toml differ: copy the one that is right over the other"
        );
        count += 1;
    }
    assert!(count >= 14, "{count} scenes");
}
