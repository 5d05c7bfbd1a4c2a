//! Curves of indentation.

#![no_main]

mod archive;
#[allow(dead_code, reason = "each program holds one claim")]
mod claims;

use libfuzzer_sys::{fuzz_mutator, fuzz_target};

fuzz_target!(
    init: archive::count_only_panics_that_leave(),
    |content: &[u8]| {
        claims::curve_is_answered(content);
    }
);

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    archive::mutated(data, size, max_size, seed)
});
