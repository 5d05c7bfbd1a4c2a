//! `.vti` for ParaView: numbers on the nodes and on the cells between them, appended and compressed.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use rayon::prelude::*;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Numbers that are compressed as one block.
const BLOCK: usize = 1 << 15;

/// Arrays of one image, compressed as they are added.
#[derive(Clone, Debug, Default)]
pub struct Vti {
    points: Vec<(String, Vec<u8>)>,
    cells: Vec<(String, Vec<u8>)>,
}

impl Vti {
    /// No array.
    pub fn new() -> Vti {
        Vti::default()
    }

    /// Adds one number a node, x fastest; the unit is part of the name.
    ///
    /// # Errors
    /// Numbers that cannot be compressed.
    pub fn add_points(&mut self, name: impl Into<String>, values: &[f32]) -> io::Result<()> {
        self.points.push((name.into(), compressed(values)?));
        Ok(())
    }

    /// Adds one number a cell, x fastest; the unit is part of the name.
    ///
    /// # Errors
    /// Numbers that cannot be compressed.
    pub fn add_cells(&mut self, name: impl Into<String>, values: &[f32]) -> io::Result<()> {
        self.cells.push((name.into(), compressed(values)?));
        Ok(())
    }

    /// Writes the image of `cells` = [columns, rows], their sides `spacing` in micrometres.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, path: &Path, cells: [usize; 2], spacing: [f64; 2]) -> io::Result<()> {
        let mut out = BufWriter::with_capacity(1 << 20, File::create(path)?);
        let extent = format!("0 {} 0 {} 0 0", cells[0], cells[1]);
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(
            out,
            "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
             compressor=\"vtkZLibDataCompressor\">\n\
             <ImageData WholeExtent=\"{extent}\" Origin=\"0 0 0\" Spacing=\"{} {} 1\">\n<Piece Extent=\"{extent}\">",
            spacing[0], spacing[1]
        )?;
        let mut offset = 0;
        for (kind, list) in [("PointData", &self.points), ("CellData", &self.cells)] {
            writeln!(out, "<{kind}>")?;
            for (name, bytes) in list {
                writeln!(
                    out,
                    "<DataArray type=\"Float32\" Name=\"{name}\" format=\"appended\" offset=\"{offset}\"/>"
                )?;
                offset += bytes.len();
            }
            writeln!(out, "</{kind}>")?;
        }
        write!(out, "</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_")?;
        for (_, bytes) in self.points.iter().chain(&self.cells) {
            out.write_all(bytes)?;
        }
        writeln!(out, "\n</AppendedData>\n</VTKFile>")?;
        out.flush()
    }
}

/// Number of blocks, their size, that of the last one if it is smaller, their compressed sizes, and the
/// blocks.
fn compressed(values: &[f32]) -> io::Result<Vec<u8>> {
    let block = |part: &[f32]| {
        let bytes: Vec<u8> = part.iter().flat_map(|v| v.to_le_bytes()).collect();
        let mut packed = ZlibEncoder::new(Vec::new(), Compression::fast());
        packed.write_all(&bytes)?;
        packed.finish()
    };
    let blocks = values.par_chunks(BLOCK).map(block).collect::<io::Result<Vec<_>>>()?;
    let head = [blocks.len(), 4 * BLOCK, 4 * (values.len() % BLOCK)];
    let sizes = head.into_iter().chain(blocks.iter().map(Vec::len));
    let mut out: Vec<u8> = sizes.flat_map(|n| (n as u64).to_le_bytes()).collect();
    blocks.iter().for_each(|block| out.extend(block));
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::ZlibDecoder;
    use std::io::Read;

    #[test]
    fn blocks_unpack_to_the_numbers() {
        for n in [0, 5, BLOCK, BLOCK + 7, 2 * BLOCK] {
            let values: Vec<f32> = (0..n).map(|i| (i % 100) as f32).collect();
            let bytes = compressed(&values).unwrap();
            let word = |k: usize| u64::from_le_bytes(bytes[8 * k..8 * k + 8].try_into().unwrap()) as usize;
            let blocks = word(0);
            assert_eq!((blocks, word(1), word(2)), (n.div_ceil(BLOCK), 4 * BLOCK, 4 * (n % BLOCK)));
            let mut at = 8 * (3 + blocks);
            let mut found = Vec::new();
            for k in 0..blocks {
                ZlibDecoder::new(&bytes[at..at + word(3 + k)]).read_to_end(&mut found).unwrap();
                at += word(3 + k);
            }
            assert_eq!(at, bytes.len());
            let wanted: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
            assert!(found == wanted && (n < 1000 || bytes.len() < n));
        }
    }
}
