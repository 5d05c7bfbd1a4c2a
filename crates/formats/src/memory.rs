//! Largest memory that a file may take, known before it is read.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Most bytes that one byte of a deflated stream unpacks to (its format allows no more).
pub(crate) const MOST_UNPACKED: u64 = 1032;

/// Bytes that may be taken where nothing is said: half of what is free and allowed to this process; no limit
/// where the system does not say.
pub fn default_limit() -> u64 {
    let field = |path: &str, name: &str, place: usize| -> Option<u64> {
        let text = std::fs::read_to_string(path).ok()?;
        let line = text.lines().find_map(|line| line.strip_prefix(name))?;
        line.split_whitespace().nth(place)?.parse().ok()
    };
    let free = field("/proc/meminfo", "MemAvailable:", 0).map(|kilobytes| kilobytes << 10);
    let taken = field("/proc/self/status", "VmSize:", 0).map_or(0, |kilobytes| kilobytes << 10);
    let allowed = field("/proc/self/limits", "Max address space", 0).map(|bytes| bytes.saturating_sub(taken));
    free.into_iter().chain(allowed).min().map_or(u64::MAX, |bytes| bytes / 2)
}

/// A file as a whole, of at most `limit` bytes, which messages call `name`. A device without end is read up
/// to there.
///
/// # Errors
/// A file that cannot be read, or is longer.
pub fn read_file(path: &Path, limit: u64, name: &str) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let length = file.metadata()?.len();
    if length > limit {
        let gigabytes = |bytes: u64| bytes as f64 / 1e9;
        let message =
            format!("its {:.2} GB are more than {name}, {:.2} GB", gigabytes(length), gigabytes(limit));
        return Err(io::Error::new(io::ErrorKind::OutOfMemory, message));
    }
    let mut data = Vec::with_capacity(length as usize);
    file.take(limit.saturating_add(1)).read_to_end(&mut data)?;
    if data.len() as u64 > limit {
        let message = format!("it has no end below {name}, {:.2} GB", limit as f64 / 1e9);
        return Err(io::Error::new(io::ErrorKind::OutOfMemory, message));
    }
    Ok(data)
}
