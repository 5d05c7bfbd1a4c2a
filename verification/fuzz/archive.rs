//! Changes within archives: one byte of an archive misses its sum, so that nothing behind it is reached.

use libfuzzer_sys::fuzzer_mutate;
use std::io::{Cursor, Read, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// A reader may catch panics of a library that it calls: only those that leave it end the program.
pub fn count_only_panics_that_leave() {
    // without the hook that ends the program at once; the caller ends it where a panic reaches it
    drop(std::panic::take_hook());
}

/// Changes `data[..size]` in at most `max_size` bytes; of an archive, mostly one of its members. Gives the
/// new size.
pub fn mutated(data: &mut [u8], size: usize, max_size: usize, seed: u32) -> usize {
    if !seed.is_multiple_of(8)
        && let Some(packed) = with_mutated_member(&data[..size], seed as usize / 8)
        && packed.len() <= max_size
    {
        data[..packed.len()].copy_from_slice(&packed);
        return packed.len();
    }
    fuzzer_mutate(data, size, max_size)
}

/// The archive with another member of number `seed`, its sums made anew.
fn with_mutated_member(content: &[u8], seed: usize) -> Option<Vec<u8>> {
    const LARGEST_MEMBER: u64 = 1 << 16;
    content.starts_with(b"PK").then_some(())?;
    let mut archive = ZipArchive::new(Cursor::new(content)).ok()?;
    let mut out = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    let victim = seed % archive.len().max(1);
    for i in 0..archive.len() {
        let mut member = archive.by_index(i).ok()?;
        let mut bytes = Vec::new();
        (&mut member).take(LARGEST_MEMBER).read_to_end(&mut bytes).ok()?;
        if i == victim {
            let size = bytes.len();
            bytes.resize(size + 64, 0);
            let size = fuzzer_mutate(&mut bytes, size, size + 64);
            bytes.truncate(size);
        }
        out.start_file(member.name().ok()?, options).ok()?;
        out.write_all(&bytes).ok()?;
    }
    Some(out.finish().ok()?.into_inner())
}
