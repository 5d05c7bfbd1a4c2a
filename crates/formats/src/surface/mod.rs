//! Height maps in files. Readers give heights in the file's unit and say what the file says of units and
//! pixels.

mod bytes;
mod measured;

mod al3d;
mod archive;
mod axes;
mod bcr;
mod beside;
mod datx;
mod described;
mod even;
mod factor;
mod foreign;
mod gsf;
mod gwy;
mod keyence;
mod marks;
mod metropro;
mod names;
mod nanoscope;
mod nanoscope_text;
mod nid;
mod npy;
mod opd;
mod opdx;
mod points;
mod remark;
mod sdf;
mod sensofar;
mod sides;
mod sur;
mod text;
mod tif;
mod titled;
mod vti;
mod x3p;

pub use measured::{Measured, ReadError, Request, Spacing};
pub use npy::write_npy;
pub use vti::Vti;
pub use x3p::write_x3p;

use rayon::prelude::*;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Reader of one format.
type Reader = fn(&Path, &Request<'_>) -> Result<Measured, ReadError>;

/// Reads a surface file, told apart by its first bytes; text by its content.
///
/// # Errors
/// A file that cannot be read, is of no known format, is damaged, or takes more memory than it may.
pub fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let mut map = read_as_written(path, request)?;
    // a number without end is no height either
    map.heights.par_iter_mut().filter(|z| z.is_infinite()).for_each(|z| *z = f64::NAN);
    Ok(map)
}

fn read_as_written(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let mut start = Vec::new();
    File::open(path)?.take(foreign::LOOKED_AT).read_to_end(&mut start)?;
    if let Some(reader) = reader(&start) {
        return reader(path, request);
    }
    if let Some(error) = foreign::named(&start) {
        return Err(error);
    }
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    match extension.as_str() {
        _ if start.is_empty() => Err(ReadError::Unknown { found: "the file is empty".into() }),
        "plu" | "apx" => sensofar::read_plu(path, request),
        "npy" | "x3p" | "sdf" | "sur" | "al3d" | "opd" | "opdx" | "vk4" | "vk6" | "datx" | "plux" | "bcr"
        | "bcrf" | "nid" => Err(ReadError::Unknown {
            found: format!("the name says .{extension}, but the file does not begin like one"),
        }),
        "stl" | "obj" | "off" | "3mf" => Err(foreign::mesh(&extension)),
        "csv" | "txt" | "asc" | "dat" | "xyz" | "grd" | "" => text::read(path, request),
        other => text::read(path, request).map_err(|error| match error {
            ReadError::Text(error) => ReadError::Unknown {
                found: format!("files of type .{other} are not known, and as text: {error}"),
            },
            error => error,
        }),
    }
}

/// The reader of a file that begins so.
fn reader(start: &[u8]) -> Option<Reader> {
    let known: [(&[u8], Reader); 19] = [
        (b"\x93NUMPY", npy::read),
        (b"PK\x03\x04", read_archive),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", text::read),
        (b"DIGITAL SURF", sur::read),
        (b"DSCOMPRESSED", sur::read),
        (b"AliconaImaging", al3d::read),
        (gsf::MAGIC, gsf::read),
        (b"GWYP", gwy::read),
        (opd::MAGIC, opd::read),
        (opdx::MAGIC, opdx::read),
        (nanoscope::MAGIC, nanoscope_text::read),
        (nanoscope_text::QUOTED_MAGIC, nanoscope_text::read),
        (nid::MAGIC, nid::read),
        (b"VK3_", keyence::read_vk4),
        (b"VK4_", keyence::read_vk4),
        (b"VK6", keyence::read_vk6),
        (b"VK7", keyence::read_vk6),
        (b"KPK0", keyence::read_zon),
        (datx::MAGIC, datx::read),
    ];
    let several = [
        (&tif::MAGICS[..], tif::read as Reader),
        (&metropro::MAGICS, metropro::read),
        (&bcr::MAGICS, bcr::read),
    ];
    if let Some((_, reader)) = several.iter().find(|(magics, _)| magics.iter().any(|m| start.starts_with(m)))
    {
        return Some(*reader);
    }
    let is_sdf = start.first().is_some_and(|kind| b"ab ".contains(kind))
        && sdf::VERSIONS.iter().any(|version| start[1..].starts_with(version.as_bytes()));
    let found = known.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, reader)| *reader);
    found.or(is_sdf.then_some(sdf::read as Reader))
}

/// Reads the surface of an archive, whichever program wrote it.
fn read_archive(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let names = archive::Archive::open(measured::Format("x3p"), path)?.names();
    let has = |test: &dyn Fn(&str) -> bool| names.iter().any(|name| test(name));
    if has(&|name| name.rsplit('/').next().is_some_and(|last| last.eq_ignore_ascii_case("main.xml"))) {
        return x3p::read(path, request);
    }
    if has(&|name| name == "index.xml") {
        return sensofar::read_plux(path, request);
    }
    if has(&|name| name.starts_with("xl/") || name == "content.xml") {
        return text::read(path, request);
    }
    Err(foreign::archive(&names))
}

#[cfg(test)]
mod tests;
