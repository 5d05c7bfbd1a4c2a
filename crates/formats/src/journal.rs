//! Finished cases on disk while many of them run: append-only lines, each forced to the disk, so that a
//! killed run loses nothing that was finished.
//!
//! The first line names the work (its definition, discretisation and program version as one number); every
//! other line is a checksum and a text of one line that the caller understands. A line that fails its
//! checksum is passed over; a last one that was cut short is cut off when the run resumes. A journal of other
//! work is kept beside the new one.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    file: File,
    /// Length up to the end of its last line.
    whole: u64,
}

/// A journal that was opened, and what it held.
#[derive(Debug)]
pub struct Opened {
    /// Takes further texts.
    pub journal: Journal,
    /// The texts of its whole lines.
    pub texts: Vec<String>,
    /// The number of its lines that are damaged.
    pub damaged: usize,
    /// The place where a journal of other work, which stood in its place, is kept.
    pub set_aside: Option<PathBuf>,
}

/// Start of [`continued`].
const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;

/// FNV-1a: a short, stable number for a text.
pub fn fingerprint(content: impl AsRef<[u8]>) -> u64 {
    continued(FNV_OFFSET, content.as_ref())
}

/// The same of the content of a file, which may be larger than the memory.
///
/// # Errors
/// A file that cannot be read.
pub fn fingerprint_of_file(path: &Path) -> io::Result<u64> {
    let (mut file, mut buffer, mut number) = (File::open(path)?, vec![0; 1 << 16], FNV_OFFSET);
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(number),
            length => number = continued(number, &buffer[..length]),
        }
    }
}

fn continued(number: u64, content: &[u8]) -> u64 {
    let step = |h: u64, b: &u8| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3);
    content.iter().fold(number, step)
}

fn sealed(text: &str) -> String {
    format!("{:016x} {text}\n", fingerprint(text))
}

/// The text of a line, if the line is whole.
fn unsealed(line: &str) -> Option<&str> {
    let (_, text) = line.strip_suffix('\n')?.split_once(' ')?;
    (line == sealed(text)).then_some(text)
}

fn header(identity: u64) -> String {
    sealed(&format!("sweep {identity:016x}"))
}

/// Lines of a journal.
#[derive(Default)]
struct Lines {
    /// Texts of those that are whole, without the header.
    texts: Vec<String>,
    /// The number of those that are damaged.
    damaged: usize,
    /// Bytes up to the end of the last line that ends; 0 without the header of the work.
    end: usize,
}

/// The lines behind the header of the work `identity`; none without it.
fn lines(bytes: &[u8], identity: u64) -> Lines {
    let mut lines = Lines::default();
    let header = header(identity);
    let Some(behind) = bytes.strip_prefix(header.as_bytes()) else { return lines };
    lines.end = header.len();
    for line in behind.split_inclusive(|byte| *byte == b'\n').filter(|line| line.ends_with(b"\n")) {
        lines.end += line.len();
        match str::from_utf8(line).ok().and_then(unsealed) {
            Some(text) => lines.texts.push(text.into()),
            None => lines.damaged += 1,
        }
    }
    lines
}

/// A path beside `path` that names no file: `.old` behind it, or `.old2` and so on.
fn free_path_beside(path: &Path) -> PathBuf {
    let name = |k: usize| {
        let mut name = path.as_os_str().to_os_string();
        name.push(if k == 1 { ".old".into() } else { format!(".old{k}") });
        PathBuf::from(name)
    };
    (1..).map(name).find(|path| !path.exists()).unwrap_or_default()
}

impl Journal {
    /// Opens the journal of the work `identity` with what it holds. A journal of other work is moved to a
    /// path beside it, and one is begun anew.
    ///
    /// # Errors
    /// A file that cannot be read, moved or written.
    pub fn open(path: &Path, identity: u64) -> io::Result<Opened> {
        let open = || OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
        let mut file = open()?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let Lines { texts, damaged, mut end } = lines(&bytes, identity);
        let mut set_aside = None;
        // a header alone, or a part of it, is no work
        if end == 0 && bytes.iter().filter(|byte| **byte == b'\n').count() > 1 {
            let old = free_path_beside(path);
            fs::rename(path, &old)?;
            set_aside = Some(old);
            file = open()?;
        }
        file.set_len(end as u64)?;
        file.seek(SeekFrom::End(0))?;
        if end == 0 {
            let header = header(identity);
            end = header.len();
            file.write_all(header.as_bytes())?;
            file.sync_all()?;
        }
        Ok(Opened { journal: Journal { file, whole: end as u64 }, texts, damaged, set_aside })
    }

    /// The texts that the journal of the work `identity` holds; none where it is of other work. It stays as
    /// it is.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(path: &Path, identity: u64) -> io::Result<Vec<String>> {
        Ok(lines(&fs::read(path)?, identity).texts)
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

    fn text(i: usize) -> String {
        format!("case {i}, reason {i}")
    }

    /// A journal of the work 7 with three texts.
    fn written(path: &Path) -> Vec<u8> {
        let Opened { mut journal, texts, .. } = Journal::open(path, 7).unwrap();
        assert!(texts.is_empty());
        (0..3).for_each(|i| journal.append(&text(i)).unwrap());
        fs::read(path).unwrap()
    }

    #[test]
    fn a_journal_cut_anywhere_keeps_its_whole_lines() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("journal");
        let bytes = written(&path);
        let ends: Vec<usize> =
            bytes.iter().enumerate().filter(|(_, b)| **b == b'\n').map(|(i, _)| i + 1).collect();
        for cut in 0..=bytes.len() {
            fs::write(&path, &bytes[..cut]).unwrap();
            let Opened { mut journal, texts, .. } = Journal::open(&path, 7).unwrap();
            let whole = ends.iter().filter(|e| **e <= cut).count().saturating_sub(1);
            assert_eq!(texts, (0..whole).map(text).collect::<Vec<_>>(), "cut at {cut}");
            journal.append(&text(9)).unwrap();
            drop(journal);
            assert_eq!(Journal::open(&path, 7).unwrap().texts.len(), whole + 1);
        }
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    }

    /// Every bit of the second line flipped, to bytes that are no text and to the end of a line too.
    #[test]
    fn a_damaged_line_costs_itself_only() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("journal");
        let bytes = written(&path);
        let line = header(7).len() + sealed(&text(0)).len();
        for bit in 0..8 * (sealed(&text(1)).len() - 1) {
            let mut damaged = bytes.clone();
            damaged[line + bit / 8] ^= 1 << (bit % 8);
            fs::write(&path, &damaged).unwrap();
            let opened = Journal::open(&path, 7).unwrap();
            assert_eq!(opened.texts, [text(0), text(2)], "bit {bit}");
            assert!((1..=2).contains(&opened.damaged) && opened.set_aside.is_none(), "bit {bit}");
        }
    }

    #[test]
    fn a_journal_of_other_work_is_kept_beside_the_new_one() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("journal");
        let first = written(&path);
        let mut opened = Journal::open(&path, 8).unwrap();
        assert!(opened.texts.is_empty());
        assert_eq!(fs::read(opened.set_aside.unwrap()).unwrap(), first);
        opened.journal.append(&text(5)).unwrap();
        let second = Journal::open(&path, 9).unwrap().set_aside.unwrap();
        assert_eq!(second, dir.path().join("journal.old2"));
        // put back, it goes on
        fs::rename(second, &path).unwrap();
        assert_eq!(Journal::open(&path, 8).unwrap().texts, [text(5)]);
    }
}
