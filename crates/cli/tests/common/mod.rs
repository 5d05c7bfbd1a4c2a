//! A command to run and a folder to run it in.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, reason = "each test uses its part")]

use assert_cmd::Command;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// The asperity of the paper, coarse: a run takes a fraction of a second.
pub const SCENE: &str = r#"symmetry = "axisymmetric"
accuracy = "draft"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
yield_stress = "300 MPa"
hardening_exponent = 0.3
hardening_law = "hollomon"
[[asperity]]
height = "20 um"
slope_deg = 10
tip_radius = "10 um"
[tool]
shape = "plane"
[loading]
depth = "5 um"
unload = true
[output]
every = 0
[numerics]
steps = 8
elements_in_contact = 6
"#;

/// A folder with a scene in it.
pub struct Place {
    dir: TempDir,
}

impl Place {
    /// A new folder that holds `scene.toml`.
    pub fn with_scene(scene: impl AsRef<[u8]>) -> Self {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("scene.toml"), scene).unwrap();
        Place { dir }
    }

    /// A path in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    /// The text of a file in the folder.
    pub fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Runs asperity in the folder.
    pub fn run(&self, args: &[&str]) -> Finished {
        let output = Command::new(Path::new(env!("CARGO_BIN_EXE_asperity")))
            .current_dir(self.dir.path())
            .args(args)
            .output()
            .unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let (out, err) = (text(&output.stdout), text(&output.stderr));
        assert!(!err.contains("panicked"), "{err}");
        Finished { status: output.status.code().unwrap(), out, err }
    }

    /// The names in a folder of the folder, sorted; empty if there is none.
    pub fn names(&self, name: &str) -> Vec<String> {
        let Ok(entries) = std::fs::read_dir(self.path(name)) else { return Vec::new() };
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

/// A command that has ended.
pub struct Finished {
    pub status: i32,
    pub out: String,
    pub err: String,
}

/// A browser, where there is one in the path.
#[allow(clippy::print_stderr, reason = "a test that was skipped says so")]
pub fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let found = names.into_iter().find(|n| std::process::Command::new(n).arg("--version").output().is_ok());
    if found.is_none() {
        eprintln!("skipped: no chromium in the path");
    }
    found
}

/// What an example of the library prints. Cargo builds it beside all that the tests are built of: chosen by
/// its package alone it would have other features of its dependencies, and most of them would be built again.
pub fn printed_by_the_example(name: &str) -> String {
    let run = Command::new(env!("CARGO"))
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .args(["run", "--release", "--quiet", "--locked", "--example", name])
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    String::from_utf8(run.stdout).unwrap()
}
