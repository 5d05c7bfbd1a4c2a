//! `.vti` for ParaView: cell data on the pixels, appended raw.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// A named array of one number per cell or per point; the unit is part of the name.
pub struct CellArray<'a> {
    /// Name with unit.
    pub name: &'a str,
    /// Numbers, x fastest.
    pub values: &'a [f32],
}

/// Writes an image of `cells` = [columns, rows] with `points` (one per node) and `arrays` (one per cell).
///
/// `origin` and `spacing` are in micrometres.
pub fn write_vti(
    path: &Path,
    cells: [usize; 2],
    spacing: [f64; 2],
    points: &[CellArray],
    arrays: &[CellArray],
) -> std::io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 20, File::create(path)?);
    let extent = format!("0 {} 0 {} 0 0", cells[0], cells[1]);
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(
        out,
        "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <ImageData WholeExtent=\"{extent}\" Origin=\"0 0 0\" Spacing=\"{} {} 1\">\n<Piece Extent=\"{extent}\">",
        spacing[0], spacing[1]
    )?;
    let mut offset = 0;
    for (kind, list) in [("PointData", points), ("CellData", arrays)] {
        writeln!(out, "<{kind}>")?;
        for array in list {
            writeln!(
                out,
                "<DataArray type=\"Float32\" Name=\"{}\" format=\"appended\" offset=\"{offset}\"/>",
                array.name
            )?;
            offset += 8 + 4 * array.values.len();
        }
        writeln!(out, "</{kind}>")?;
    }
    write!(out, "</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_")?;
    for array in points.iter().chain(arrays) {
        out.write_all(&(4 * array.values.len() as u64).to_le_bytes())?;
        for part in array.values.chunks(1 << 14) {
            let bytes: Vec<u8> = part.iter().flat_map(|v| v.to_le_bytes()).collect();
            out.write_all(&bytes)?;
        }
    }
    writeln!(out, "\n</AppendedData>\n</VTKFile>")?;
    out.flush()
}
