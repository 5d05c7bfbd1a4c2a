//! Surface files. ASPERITY_FUZZ_NAME is the name of the file, whose ending tells formats without a beginning
//! of their own.

#![no_main]

mod archive;
#[allow(dead_code, reason = "each program holds one claim")]
mod claims;

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use std::path::PathBuf;
use std::sync::LazyLock;

/// The file that is read, in a folder of this process.
static FILE: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = std::env::temp_dir().join(format!("asperity-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    folder.join(std::env::var("ASPERITY_FUZZ_NAME").unwrap_or_else(|_| "surface.txt".into()))
});

fuzz_target!(
    init: archive::count_only_panics_that_leave(),
    |content: &[u8]| {
        claims::surface_is_answered(&FILE, content);
    }
);

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    archive::mutated(data, size, max_size, seed)
});
