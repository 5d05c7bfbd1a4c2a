//! Claim: each file that coverage-guided fuzzing kept is a map or a curve that its bytes can hold, or refused
//! (the claims of `verification/fuzz/claims.rs`, the corpus that `verification/measure/fuzz` grows). Bytes
//! outside a claim, a panic and an endless loop fail it.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test fails by panicking")]

#[path = "../fuzz/claims.rs"]
mod claims;

use rayon::prelude::*;
use std::io::Read;
use std::path::{Path, PathBuf};

#[test]
fn each_kept_file_is_answered() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    let archives: Vec<PathBuf> =
        std::fs::read_dir(corpus).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(archives.len() >= 24, "an archive for each kind of file");
    archives.par_iter().for_each(|archive| {
        let kind = archive.file_stem().unwrap().to_str().unwrap();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(format!("surface.{kind}"));
        let mut packed = zip::ZipArchive::new(std::fs::File::open(archive).unwrap()).unwrap();
        let mut read = 0;
        for i in 0..packed.len() {
            let mut content = Vec::new();
            packed.by_index(i).unwrap().read_to_end(&mut content).unwrap();
            let is_read = match kind {
                "curve" => claims::curve_is_answered(&content),
                _ => claims::surface_is_answered(&file, &content),
            };
            read += usize::from(is_read);
        }
        // a reader that refuses everything answers too
        assert!(read > 0, "{kind}: no file of {} is read", packed.len());
    });
}
