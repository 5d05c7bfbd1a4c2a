//! Archives (zip), from which members of at most so many bytes are read.

use super::measured::{Format, ReadError};
use crate::memory::MOST_UNPACKED;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
use zip::ZipArchive;

/// Longest description of a measurement.
const LONGEST_TEXT: u64 = 1 << 24;

/// A path in an archive without what programs put before it.
pub(super) fn plain(name: &str) -> String {
    let name = name.replace('\\', "/");
    name.split('/').filter(|part| !part.is_empty() && *part != ".").collect::<Vec<_>>().join("/")
}

/// An open archive.
pub(super) struct Archive {
    format: Format,
    zip: ZipArchive<BufReader<File>>,
}

impl Archive {
    /// Opens the archive in a file, at its beginning or behind a header of its own.
    pub fn open(format: Format, path: &Path) -> Result<Archive, ReadError> {
        let zip = ZipArchive::new(BufReader::new(File::open(path)?)).map_err(|e| format.damaged(e))?;
        Ok(Archive { format, zip })
    }

    /// The names of its members.
    pub fn names(&self) -> Vec<String> {
        self.zip.file_names().filter_map(|name| Some(plain(&name.ok()?))).collect()
    }

    fn place(&self, name: &str) -> Option<usize> {
        (0..self.zip.len()).find(|i| {
            self.zip
                .name_for_index(*i)
                .is_some_and(|found| found.is_ok_and(|found| plain(&found) == plain(name)))
        })
    }

    /// True where there is such a member.
    pub fn has(&self, name: &str) -> bool {
        self.place(name).is_some()
    }

    /// A member of at most `limit` bytes, whatever its directory entry says; its sum is compared.
    pub fn member(&mut self, name: &str, limit: u64) -> Result<Vec<u8>, ReadError> {
        let format = self.format;
        let at = |e: String| format.damaged(format_args!("{name}: {e}"));
        let place = self.place(name).ok_or_else(|| at("it is not in the archive".into()))?;
        let mut file = self.zip.by_index(place).map_err(|e| at(e.to_string()))?;
        let limit = limit.min(file.compressed_size().saturating_mul(MOST_UNPACKED));
        let mut data = Vec::new();
        // one byte more, so that the end is met, where the sum is compared
        (&mut file).take(limit.saturating_add(1)).read_to_end(&mut data).map_err(|e| at(e.to_string()))?;
        if data.len() as u64 > limit {
            return Err(at(format!("it holds more than {limit} bytes")));
        }
        Ok(data)
    }

    /// A member of text in UTF-8.
    pub fn text(&mut self, name: &str) -> Result<String, ReadError> {
        let data = self.member(name, LONGEST_TEXT)?;
        let data = data.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&data);
        Ok(String::from_utf8_lossy(data).into_owned())
    }
}
