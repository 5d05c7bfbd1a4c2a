//! Finished cases on disk while a sweep runs: append-only lines, each forced to the disk, so that a killed run loses
//! nothing that was finished.
//!
//! The first line names the sweep (its definition, discretisation and program version as one number); every other
//! line is a checksum and a row. A line that was cut short fails its checksum and is cut off when the run resumes.

use crate::case::Case;
use crate::row::Row;
use std::collections::HashMap;
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

/// FNV-1a: a short, stable number for a text.
pub fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}

fn sealed(row: &str) -> String {
    format!("{:016x} {row}\n", fingerprint(row))
}

/// The row of a line, if the line is whole.
fn unsealed(line: &str) -> Option<&str> {
    let (sum, row) = line.strip_suffix('\n')?.split_once(' ')?;
    (u64::from_str_radix(sum, 16).ok()? == fingerprint(row)).then_some(row)
}

impl Journal {
    /// Opens the journal of the sweep `identity` and returns the rows of `cases` it holds. A journal of another sweep
    /// is begun anew.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn open(path: &Path, identity: u64, cases: &[Case]) -> io::Result<(Journal, Vec<Row>)> {
        let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let text = String::from_utf8_lossy(&bytes);
        let header = sealed(&format!("sweep {identity:016x}"));
        let by_key: HashMap<String, &Case> = cases.iter().map(|c| (Row::key(c), c)).collect();
        let mut rows = Vec::new();
        let mut whole = 0;
        if text.starts_with(&header) {
            whole = header.len();
            for line in text[whole..].split_inclusive('\n') {
                let Some(row) = unsealed(line) else { break };
                whole += line.len();
                rows.extend(by_key.get(Row::key_of(row)).and_then(|case| Row::from_csv(row, case)));
            }
        }
        file.set_len(whole as u64)?;
        file.seek(SeekFrom::End(0))?;
        if whole == 0 {
            whole = header.len();
            file.write_all(header.as_bytes())?;
            file.sync_all()?;
        }
        Ok((Journal { file, whole: whole as u64 }, rows))
    }

    /// Adds a finished row and forces it to the disk.
    ///
    /// # Errors
    /// A full disk; the rows before this one stay, and rows after it find no piece of it in front of them.
    pub fn append(&mut self, row: &Row) -> io::Result<()> {
        let line = sealed(&row.to_csv());
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
    use crate::sweep::Sweep;

    #[test]
    fn a_journal_cut_anywhere_keeps_its_whole_lines() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("journal");
        let cases = Sweep::default().cases();
        let row = |i: usize| Row { case: cases[i], outcome: Err(format!("reason {i}")), wall_s: i as f64 };
        let (mut journal, rows) = Journal::open(&path, 7, &cases).unwrap();
        assert!(rows.is_empty());
        (0..3).for_each(|i| journal.append(&row(i)).unwrap());
        drop(journal);
        let bytes = std::fs::read(&path).unwrap();
        let ends: Vec<usize> =
            bytes.iter().enumerate().filter(|(_, b)| **b == b'\n').map(|(i, _)| i + 1).collect();
        for cut in 0..=bytes.len() {
            std::fs::write(&path, &bytes[..cut]).unwrap();
            let (mut journal, rows) = Journal::open(&path, 7, &cases).unwrap();
            let whole = ends.iter().filter(|e| **e <= cut).count().saturating_sub(1);
            assert_eq!(rows, (0..whole).map(row).collect::<Vec<_>>(), "cut at {cut}");
            journal.append(&row(9)).unwrap();
            drop(journal);
            let (_, rows) = Journal::open(&path, 7, &cases).unwrap();
            assert_eq!(rows.len(), whole + 1);
        }
        // another sweep starts anew
        assert!(Journal::open(&path, 8, &cases).unwrap().1.is_empty());
    }
}
