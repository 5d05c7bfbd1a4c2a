//! Finished cases on disk while many of them run: append-only lines, each forced to the disk, so that a
//! killed run loses nothing that was finished.
//!
//! The first line names the work (its definition, discretisation and program version as one number); every
//! other line is a checksum and a text of one line that the caller understands. A line that was cut short
//! fails its checksum and is cut off when the run resumes.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    file: File,
    /// Length up to the end of its last whole line.
    whole: u64,
}

/// FNV-1a: a short, stable number for a text or the content of a file.
pub fn fingerprint(content: impl AsRef<[u8]>) -> u64 {
    let step = |h: u64, b: &u8| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3);
    content.as_ref().iter().fold(0xcbf2_9ce4_8422_2325, step)
}

fn sealed(text: &str) -> String {
    format!("{:016x} {text}\n", fingerprint(text))
}

/// The text of a line, if the line is whole.
fn unsealed(line: &str) -> Option<&str> {
    let (sum, text) = line.strip_suffix('\n')?.split_once(' ')?;
    (u64::from_str_radix(sum, 16).ok()? == fingerprint(text)).then_some(text)
}

fn header(identity: u64) -> String {
    sealed(&format!("sweep {identity:016x}"))
}

/// The texts of the whole lines behind the header of the work `identity`, and the bytes up to the end of the
/// last one; 0 without that header.
fn whole_lines(bytes: &[u8], identity: u64) -> (Vec<String>, usize) {
    let text = String::from_utf8_lossy(bytes);
    let (mut texts, mut whole) = (Vec::new(), header(identity).len());
    if !text.starts_with(&header(identity)) {
        return (texts, 0);
    }
    for line in text[whole..].split_inclusive('\n') {
        let Some(text) = unsealed(line) else { break };
        whole += line.len();
        texts.push(text.to_string());
    }
    (texts, whole)
}

impl Journal {
    /// Opens the journal of the work `identity` and returns the texts it holds. A journal of other work is
    /// begun anew.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn open(path: &Path, identity: u64) -> io::Result<(Journal, Vec<String>)> {
        let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let (texts, mut whole) = whole_lines(&bytes, identity);
        file.set_len(whole as u64)?;
        file.seek(SeekFrom::End(0))?;
        if whole == 0 {
            let header = header(identity);
            whole = header.len();
            file.write_all(header.as_bytes())?;
            file.sync_all()?;
        }
        Ok((Journal { file, whole: whole as u64 }, texts))
    }

    /// The texts that the journal of the work `identity` holds; none where it is of other work. It stays as
    /// it is.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(path: &Path, identity: u64) -> io::Result<Vec<String>> {
        Ok(whole_lines(&std::fs::read(path)?, identity).0)
    }

    /// Adds a text of one line and forces it to the disk.
    ///
    /// # Errors
    /// A full disk; the texts before this one stay, and texts after it find no piece of it in front of them.
    pub fn append(&mut self, text: &str) -> io::Result<()> {
        let line = sealed(text);
        let written = self.file.write_all(line.as_bytes()).and_then(|()| self.file.sync_data());
        match written {
            Ok(()) => self.whole += line.len() as u64,
            Err(_) => {
                self.file.set_len(self.whole)?;
                self.file.seek(SeekFrom::End(0))?;
            }
        }
        written
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_journal_cut_anywhere_keeps_its_whole_lines() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("journal");
        let text = |i: usize| format!("case {i}, reason {i}");
        let (mut journal, texts) = Journal::open(&path, 7).unwrap();
        assert!(texts.is_empty());
        (0..3).for_each(|i| journal.append(&text(i)).unwrap());
        drop(journal);
        let bytes = std::fs::read(&path).unwrap();
        let ends: Vec<usize> =
            bytes.iter().enumerate().filter(|(_, b)| **b == b'\n').map(|(i, _)| i + 1).collect();
        for cut in 0..=bytes.len() {
            std::fs::write(&path, &bytes[..cut]).unwrap();
            let (mut journal, texts) = Journal::open(&path, 7).unwrap();
            let whole = ends.iter().filter(|e| **e <= cut).count().saturating_sub(1);
            assert_eq!(texts, (0..whole).map(text).collect::<Vec<_>>(), "cut at {cut}");
            journal.append(&text(9)).unwrap();
            drop(journal);
            let (_, texts) = Journal::open(&path, 7).unwrap();
            assert_eq!(texts.len(), whole + 1);
        }
        // other work starts anew
        assert!(Journal::open(&path, 8).unwrap().1.is_empty());
    }
}
