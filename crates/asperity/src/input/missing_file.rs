//! Files that cannot be opened, told with the name that was meant.

use super::suggest::nearest;
use crate::error::InputError;
use std::io;
use std::path::Path;

/// Names of a folder that are looked at for one that was meant.
const MOST_NAMES: usize = 10_000;

/// The error of a file at `path` that cannot be read: where there is none, the name in its folder that was
/// probably meant.
pub fn unreadable(path: &Path, error: &io::Error) -> InputError {
    let name = path.display();
    match error.kind() {
        io::ErrorKind::NotFound => {
            let message = format!("there is no file {name}");
            match meant(path) {
                Some(other) => InputError::new(message).help(format!("did you mean {other}?")),
                None => InputError::new(message),
            }
        }
        _ => InputError::new(format!("cannot read {name}: {}", error.to_string().to_lowercase())),
    }
}

/// The file beside `path` whose name is nearest to its.
fn meant(path: &Path) -> Option<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = std::fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?;
    let files = entries.take(MOST_NAMES).filter_map(Result::ok).filter(|entry| entry.path().is_file());
    let names: Vec<String> = files.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let name = nearest(path.file_name()?.to_str()?, &names)?;
    Some(folder.map_or_else(|| name.into(), |folder| folder.join(name).display().to_string()))
}
