//! The files of the atlas of cones: `results/atlas.csv.gz`, the cones it is held against in
//! `results/atlas-check.csv.gz`, and the journals from which they grow.

use asperity::batch::journal::{Journal, fingerprint};
use asperity_calibration::case::Case;
use asperity_calibration::cones::{self, Row, header};
use asperity_simulation::scene::Accuracy;
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// The cones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// Those of the atlas, at `standard`.
    Atlas,
    /// Those it is held against, at `reference`.
    Fresh,
}

impl Set {
    /// Cone number `index`.
    pub fn cone(self, index: usize) -> Case {
        match self {
            Set::Atlas => cones::cone(index),
            Set::Fresh => cones::fresh(index),
        }
    }

    /// The level at which they are solved.
    pub fn accuracy(self) -> Accuracy {
        match self {
            Set::Atlas => Accuracy::Standard,
            Set::Fresh => Accuracy::Reference,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Set::Atlas => "atlas",
            Set::Fresh => "atlas-check",
        }
    }

    /// Name of the journal of a part.
    pub fn journal(self, part: usize, parts: usize) -> String {
        format!("{}-{part}-of-{parts}.journal", self.name())
    }

    /// Inputs that the rows of a journal depend on.
    pub fn identity(self) -> u64 {
        fingerprint(format!("{} {self:?} {} {:?}", env!("CARGO_PKG_VERSION"), header(), self.cone(1)))
    }

    /// The committed file.
    pub fn file(self) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("results/{}.csv.gz", self.name()))
    }
}

/// The rows of the committed file; none where there is no file.
pub fn committed(set: Set) -> Vec<Row> {
    let mut text = String::new();
    let read =
        std::fs::File::open(set.file()).and_then(|file| GzDecoder::new(file).read_to_string(&mut text));
    if read.is_err() {
        return Vec::new();
    }
    text.lines().filter_map(Row::of_line).collect()
}

/// The rows of all journals of `folder`.
pub fn journals(set: Set, folder: &Path) -> Vec<Row> {
    let Ok(files) = std::fs::read_dir(folder) else { return Vec::new() };
    let own = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.strip_prefix(set.name()).is_some_and(|rest| {
            rest.ends_with(".journal") && rest.as_bytes().get(1).is_some_and(u8::is_ascii_digit)
        })
    };
    let paths = files.filter_map(|file| Some(file.ok()?.path())).filter(own);
    paths
        .flat_map(|path| Journal::read(&path, set.identity()).unwrap_or_default())
        .filter_map(|line| Row::of_line(&line))
        .collect()
}

/// Writes the committed file.
///
/// # Errors
/// It cannot be written.
pub fn write(set: Set, rows: &[Row]) -> io::Result<()> {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    writeln!(gzip, "{}", header())?;
    for row in rows {
        writeln!(gzip, "{}", row.line())?;
    }
    std::fs::write(set.file(), gzip.finish()?)
}
