//! The folder a run leaves its results in.
//!
//! While a run lasts its files grow in `<folder>.partial`; [`Folder::publish`] moves them to `<folder>`. A
//! manifest lists the files a run has made, so that a later run of the same command may replace exactly
//! those.

use asperity::error::{Error, InputError};
use asperity::output::{Sink, path_beside};
use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Names the command and the files it made, a line each; also the lock of a running command.
const MANIFEST: &str = ".asperity-run";

/// Results in the making.
#[derive(Debug)]
pub struct Folder {
    target: PathBuf,
    partial: PathBuf,
    /// Held open and locked as long as the run lasts.
    manifest: File,
    files: BTreeSet<String>,
}

/// The files in `folder` that an earlier run of `command` made.
///
/// # Errors
/// Anything else in the folder, unless `force`; a folder that cannot be read.
fn own_files(folder: &Path, command: &str, force: bool) -> Result<Vec<String>, InputError> {
    let name = folder.display();
    let entries = match fs::read_dir(folder) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(e) => {
            return Err(InputError::new(format!("cannot use {name} for results: {e}"))
                .help("give another folder with --out"));
        }
        Ok(entries) => entries,
    };
    let manifest = fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
    let mut lines = manifest.lines();
    let maker = lines.next().unwrap_or_default();
    let listed: BTreeSet<&str> = if maker == command { lines.collect() } else { BTreeSet::new() };
    let mut own = Vec::new();
    for entry in entries {
        let entry = entry.map_err(|e| InputError::new(format!("cannot read {name}: {e}")))?;
        let file = entry.file_name().to_string_lossy().into_owned();
        let plain = entry.file_type().is_ok_and(|t| t.is_file());
        if plain && (listed.contains(file.as_str()) || file == MANIFEST) {
            own.push(file);
        } else if !force {
            let whose = if maker.is_empty() || maker == command {
                "which no run of this command made".to_string()
            } else {
                format!("and an earlier run of `asperity {maker}`")
            };
            return Err(InputError::new(format!("{name} holds {file}, {whose}: nothing was written")).help(
                "give another folder with --out, or --force to write there: files of the same name are overwritten, others stay",
            ));
        }
    }
    Ok(own)
}

/// The journal of a long run into `target`: beside the results, not in them, for a folder of results holds
/// results.
pub fn journal_beside(target: &Path) -> PathBuf {
    target.with_file_name(path_beside(Path::new(target.file_name().unwrap_or_default()), ".journal"))
}

fn cannot_write(path: &Path, e: &io::Error) -> InputError {
    InputError::new(format!("cannot write to {}: {e}", path.display()))
        .help("give a folder you may write to with --out")
}

/// Opens the manifest of a run into `target` and locks it as long as it is held.
fn lock(manifest: &Path, target: &Path) -> Result<File, InputError> {
    let options = fs::OpenOptions::new().append(true).create(true).open(manifest);
    let file = options.map_err(|e| cannot_write(manifest, &e))?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            Err(InputError::new(format!("another run is writing to {}", target.display()))
                .help("wait for it, or give another folder with --out"))
        }
        // a file system without locks: go on without
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// Marks `target` as the place where `command` adds to its results, and holds it as long as the mark is held.
///
/// # Errors
/// A folder that holds anything that no run of `command` made (unless `force`), that another run is filling
/// now, or that cannot be written.
pub fn claim(target: &Path, command: &str, force: bool) -> Result<File, InputError> {
    let path = target.join(MANIFEST);
    let ours = fs::read_to_string(&path).is_ok_and(|mark| mark.starts_with(command));
    if !ours {
        own_files(target, command, force)?;
    }
    fs::create_dir_all(target).map_err(|e| cannot_write(target, &e))?;
    let mark = lock(&path, target)?;
    if !ours {
        fs::write(&path, format!("{command}\n")).map_err(|e| cannot_write(target, &e))?;
    }
    Ok(mark)
}

impl Folder {
    /// Prepares to fill `target` with the results of `command`.
    ///
    /// # Errors
    /// A folder that holds anything but results of an earlier run of `command` (unless `force`), that another
    /// run is filling now, or that cannot be written.
    pub fn create(target: &Path, command: &str, force: bool) -> Result<Self, InputError> {
        own_files(target, command, force)?;
        fs::create_dir_all(target).map_err(|e| cannot_write(target, &e))?;
        let target = fs::canonicalize(target).map_err(|e| cannot_write(target, &e))?;
        let partial = path_beside(&target, ".partial");
        let leftovers = own_files(&partial, command, force)?;
        fs::create_dir_all(&partial).map_err(|e| cannot_write(&partial, &e))?;
        let path = partial.join(MANIFEST);
        let mut manifest = lock(&path, &target)?;
        for file in leftovers.iter().filter(|f| *f != MANIFEST) {
            fs::remove_file(partial.join(file)).map_err(|e| cannot_write(&partial.join(file), &e))?;
        }
        manifest
            .set_len(0)
            .and_then(|()| writeln!(manifest, "{command}"))
            .map_err(|e| cannot_write(&path, &e))?;
        Ok(Folder { target, partial, manifest, files: BTreeSet::new() })
    }

    /// Writes and publishes the results of `work`; work that failed leaves no trace.
    ///
    /// # Errors
    /// The failure of the work, or a disk that refuses.
    pub fn fill<T>(
        mut self,
        work: Result<T, Error>,
        write: impl FnOnce(&T, &mut Folder) -> Result<(), Error>,
    ) -> Result<T, Error> {
        match work {
            Ok(done) => {
                write(&done, &mut self)?;
                self.publish().map(|_| done)
            }
            Err(failure) => {
                self.abandon();
                Err(failure)
            }
        }
    }

    /// True where the results that are replaced hold a file of this name.
    pub fn replaces(&self, name: &str) -> bool {
        fs::read_to_string(self.target.join(MANIFEST))
            .is_ok_and(|old| old.lines().skip(1).any(|file| file == name))
    }

    /// Leaves no trace of a run that did not begin.
    pub fn abandon(self) {
        let Folder { target, partial, manifest, files } = self;
        drop(manifest);
        for file in files.iter().map(String::as_str).chain([MANIFEST]) {
            let _ = fs::remove_file(partial.join(file));
        }
        let _ = fs::remove_dir(&partial);
        let _ = fs::remove_dir(&target); // only if it is empty
    }

    /// Puts the results in place of those of an earlier run.
    ///
    /// # Errors
    /// A disk that refuses; what could not be moved stays in the `.partial` folder.
    pub fn publish(self) -> Result<PathBuf, Error> {
        let Folder { target, partial, manifest, files } = self;
        let error = |e| Error::disk(&target, e);
        // the manifest first: a move that is cut short leaves files that a later run knows as its own
        let command = fs::read_to_string(partial.join(MANIFEST)).map_err(error)?;
        let maker = command.lines().next().unwrap_or_default();
        let old = own_files(&target, maker, true).unwrap_or_default();
        for file in old.iter().filter(|f| *f != MANIFEST && !files.contains(*f)) {
            fs::remove_file(target.join(file)).map_err(error)?;
        }
        fs::copy(partial.join(MANIFEST), target.join(MANIFEST)).map_err(error)?;
        for file in &files {
            let from = partial.join(file);
            if from.exists() {
                fs::rename(from, target.join(file)).map_err(error)?;
            }
        }
        drop(manifest);
        let _ = fs::remove_file(partial.join(MANIFEST));
        let _ = fs::remove_dir(&partial); // stays where somebody else has put a file
        Ok(target)
    }
}

impl Sink for Folder {
    /// The path a result file has while the run lasts; it becomes part of the results.
    fn path(&mut self, name: &str) -> Result<PathBuf, Error> {
        let path = self.partial.join(name);
        if self.files.insert(name.to_string()) {
            writeln!(self.manifest, "{name}").map_err(|e| Error::disk(&path, e))?;
        }
        Ok(path)
    }

    fn remove(&mut self, name: &str) -> Result<(), Error> {
        let path = self.partial.join(name);
        fs::remove_file(&path).map_err(|e| Error::disk(&path, e))?;
        self.files.remove(name);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::output::SinkExt;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn run(target: &Path, command: &str, force: bool, files: &[&str]) -> Result<(), InputError> {
        let mut folder = Folder::create(target, command, force)?;
        for name in files {
            folder.write(name, |out| out.write_all(command.as_bytes())).unwrap();
        }
        folder.publish().unwrap();
        Ok(())
    }

    #[test]
    fn a_run_replaces_its_own_results_and_nothing_else() {
        let dir = tempfile::tempdir().unwrap();
        let out = dir.path().join("a/b");
        run(&out, "crush", false, &["curve.csv", "fields_0001.vtu"]).unwrap();
        run(&out, "crush", false, &["curve.csv"]).unwrap();
        assert_eq!(names(&out), [MANIFEST, "curve.csv"]);
        assert_eq!(names(out.parent().unwrap()), ["b"]);
        // another command, or a stranger's file, is refused and left as it is
        assert!(run(&out, "calibrate", false, &["cases.csv"]).is_err());
        fs::write(out.join("thesis.tex"), "years").unwrap();
        assert!(run(&out, "crush", false, &["curve.csv"]).unwrap_err().to_string().contains("thesis.tex"));
        assert_eq!(names(out.parent().unwrap()), ["b"]);
        run(&out, "crush", true, &["summary.json"]).unwrap();
        assert_eq!(names(&out), [MANIFEST, "summary.json", "thesis.tex"]);
        assert_eq!(fs::read_to_string(out.join("thesis.tex")).unwrap(), "years");
    }

    #[test]
    fn results_of_a_killed_run_are_replaced_and_a_running_one_is_left_alone() {
        let dir = tempfile::tempdir().unwrap();
        let out = dir.path().join("out");
        let mut first = Folder::create(&out, "crush", false).unwrap();
        first.write("curve.csv", |out| out.write_all(b"half")).unwrap();
        assert!(Folder::create(&out, "crush", false).unwrap_err().to_string().contains("another run"));
        drop(first); // as if killed
        run(&out, "crush", false, &["summary.json"]).unwrap();
        assert_eq!(names(&out), [MANIFEST, "summary.json"]);
        assert_eq!(names(dir.path()), ["out"]);
    }

    #[test]
    fn a_file_in_the_way_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let out = dir.path().join("out");
        fs::write(&out, "a file").unwrap();
        assert!(Folder::create(&out, "crush", true).is_err());
        assert!(Folder::create(&out.join("deeper"), "crush", false).is_err());
    }
}
