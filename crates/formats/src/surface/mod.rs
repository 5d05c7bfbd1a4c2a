//! Height maps in files. Readers give heights in the file's unit and say what the file says of units and
//! pixels.

mod bytes;
mod measured;

mod al3d;
mod npy;
mod sdf;
mod sur;
mod text;
mod vti;
mod x3p;

pub use measured::{Measured, ReadError, Spacing};
pub use npy::write_npy;
pub use vti::Vti;
pub use x3p::write_x3p;

use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Reader of one format.
type Reader = fn(&Path) -> Result<Measured, ReadError>;

/// Reads a surface file, told apart by its first bytes, else by its name.
///
/// # Errors
/// A file that cannot be read, is of no known format, or is damaged.
pub fn read(path: &Path) -> Result<Measured, ReadError> {
    let mut start = Vec::new();
    File::open(path)?.take(16).read_to_end(&mut start)?;
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let known: [(&[u8], Reader); 10] = [
        (b"\x93NUMPY", npy::read),
        (b"PK\x03\x04", x3p::read),
        (b"DIGITAL SURF", sur::read),
        (b"DSCOMPRESSED", sur::read),
        (b"AliconaImaging", al3d::read),
        (b"aISO-1.0", sdf::read),
        (b"aBCR-1.0", sdf::read),
        (b"bISO-1.0", sdf::read),
        (b"bBCR-1.0", sdf::read),
        (b" ISO-1.0", sdf::read),
    ];
    if let Some((_, reader)) = known.iter().find(|(magic, _)| start.starts_with(magic)) {
        return reader(path);
    }
    if start.is_empty() || picture(&start).is_some() {
        return Err(ReadError::Unknown { found: describe(&start, &extension) });
    }
    match extension.as_str() {
        "xyz" => text::read_points(path),
        "csv" | "txt" | "asc" | "dat" => text::read_table(path),
        _ => Err(ReadError::Unknown { found: describe(&start, &extension) }),
    }
}

/// The kind of picture that begins so.
fn picture(start: &[u8]) -> Option<&'static str> {
    let images: [(&[u8], &str); 6] = [
        (b"\x89PNG", "a PNG picture"),
        (b"\xff\xd8\xff", "a JPEG picture"),
        (b"II*\0", "a TIFF picture"),
        (b"MM\0*", "a TIFF picture"),
        (b"BM", "a BMP picture"),
        (b"GIF8", "a GIF picture"),
    ];
    images.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, name)| *name)
}

/// Probable kind of a file that is no surface.
fn describe(start: &[u8], extension: &str) -> String {
    if let Some(name) = picture(start) {
        return format!("this is {name}: colours are not heights");
    }
    if start.is_empty() {
        return "the file is empty".into();
    }
    match extension {
        "npy" | "x3p" | "sdf" | "sur" | "al3d" => {
            format!("the name says .{extension}, but the file does not begin like one")
        }
        "" => "the file has no known beginning and no extension".into(),
        other => format!("files of type .{other} are not known"),
    }
}

#[cfg(test)]
mod tests;
