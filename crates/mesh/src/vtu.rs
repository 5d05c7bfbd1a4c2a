//! Fields on a mesh as compressed VTU, the XML format of VTK and ParaView.

use crate::{ElementKind, Mesh};
use base64::prelude::{BASE64_STANDARD, Engine};
use flate2::{Compress, Compression, FlushCompress, Status};
use std::io::Write;
use vtkio::model::{
    Attribute, Attributes, ByteOrder, CellType, Cells, DataArray, DataSet, UnstructuredGridPiece, Version,
    VertexNumbers, Vtk,
};
use vtkio::xml::Compressor;

/// Values on the nodes or on the cells of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldArray {
    /// Name with unit, for example `von_mises_MPa`.
    pub name: String,
    /// Numbers to a node or cell: 1 a scalar, 2 a vector (r, z), any other number as it is.
    pub components: usize,
    /// The numbers, `components` to a node or cell.
    pub values: Vec<f64>,
}

/// The reason why a VTU was not written.
#[derive(Debug, thiserror::Error)]
pub enum VtuError {
    /// An array does not fit the mesh.
    #[error("array {name} has {found} numbers, its mesh needs {needed}")]
    Length {
        /// The array.
        name: String,
        /// Its numbers.
        found: usize,
        /// Numbers that the mesh needs.
        needed: usize,
    },
    /// A number that no reader can draw.
    #[error("array {0} holds a number that is not finite")]
    NotFinite(String),
    /// The numbers could not be encoded.
    #[error("the fields could not be encoded: {0}")]
    Encode(String),
    /// The file could not be written.
    #[error(transparent)]
    Io(#[from] std::io::Error),
}

/// Writes `mesh` with its coordinates times `scale`, arrays on nodes and cells, and numbers of the whole
/// state, to `out`.
///
/// The section lies in the plane z = 0 of VTK: x is r, y is the height; vectors of two components get a third
/// that is 0. Quadratic cells stay quadratic; the data are zlib-compressed.
///
/// # Errors
/// Arrays that do not fit the mesh or hold NaN or infinity; a writer that fails.
pub fn write_vtu(
    mut out: impl Write,
    mesh: &Mesh,
    scale: f64,
    nodes: &[FieldArray],
    cells: &[FieldArray],
    whole: &[(&str, f64)],
) -> Result<(), VtuError> {
    let points: Vec<f64> = mesh.nodes.iter().flat_map(|p| [p[0] * scale, p[1] * scale, 0.0]).collect();
    let (count, width) = (mesh.cell_count(), mesh.kind.nodes());
    let cell_type = match mesh.kind {
        ElementKind::Quad4 => CellType::Quad,
        ElementKind::Quad8 => CellType::QuadraticQuad,
    };
    let attributes = |arrays: &[FieldArray], len: usize| {
        arrays.iter().map(|array| attribute(array, len)).collect::<Result<Vec<_>, _>>()
    };
    let piece = UnstructuredGridPiece {
        points: points.into(),
        cells: Cells {
            cell_verts: VertexNumbers::XML {
                connectivity: mesh.cells.iter().map(|&n| u64::from(n)).collect(),
                offsets: (1..=count).map(|i| (i * width) as u64).collect(),
            },
            types: vec![cell_type; count],
        },
        data: Attributes { point: attributes(nodes, mesh.nodes.len())?, cell: attributes(cells, count)? },
    };
    let encode = |e: &dyn std::error::Error| VtuError::Encode(e.to_string());
    let mut file = Vtk {
        version: Version::new_xml(1, 0),
        title: String::new(),
        byte_order: ByteOrder::LittleEndian,
        data: DataSet::inline(piece),
        file_path: None,
    }
    .try_into_xml_format(Compressor::None, 0)
    .map_err(|e| encode(&e))?;
    file.compressor = Compressor::ZLib;
    let mut text = Vec::new();
    file.write(&mut text).map_err(|e| encode(&e))?;
    let text = String::from_utf8(text).map_err(|e| encode(&e))?;
    // vtkio writes no data of a whole file
    let (head, arrays) =
        text.split_once(GRID).ok_or_else(|| VtuError::Encode("no grid was written".into()))?;
    write!(out, "{head}{GRID}")?;
    write_whole(&mut out, whole)?;
    let mut rest = arrays;
    while let Some((before, plain, after)) = next_array(rest) {
        write!(out, "{before}{}", compressed(plain).map_err(|e| encode(&*e))?)?;
        rest = after;
    }
    out.write_all(rest.as_bytes())?;
    Ok(())
}

/// The element of the file in which its numbers stand.
const GRID: &str = "<UnstructuredGrid>";

/// The text up to the numbers of the next array, these in base64, and the text after them.
fn next_array(text: &str) -> Option<(&str, &str, &str)> {
    let tag = text.find("<DataArray")?;
    let start = tag + text[tag..].find('>')? + 1;
    let end = start + text[start..].find('<')?;
    Some((&text[..start], &text[start..end], &text[end..]))
}

/// The numbers of an array in base64 behind their count of bytes, compressed as one block of VTK. (vtkio
/// gives its compressor every number by itself, which takes most of the time of a file.)
fn compressed(plain: &str) -> Result<String, Box<dyn std::error::Error>> {
    let bytes = BASE64_STANDARD.decode(plain)?;
    let numbers = bytes.get(size_of::<u64>()..).unwrap_or_default();
    // at the fastest level a byte takes nine bits at most
    let mut block = Vec::with_capacity(numbers.len() + numbers.len() / 8 + 64);
    let mut deflate = Compress::new(Compression::fast(), true);
    if deflate.compress_vec(numbers, &mut block, FlushCompress::Finish)? != Status::StreamEnd {
        return Err("an array is too large for its block".into());
    }
    // one block, its size as that of a last one, which all readers understand
    let sizes = [1, numbers.len(), numbers.len(), block.len()].map(|n| (n as u64).to_le_bytes()).concat();
    Ok(BASE64_STANDARD.encode(sizes) + &BASE64_STANDARD.encode(block))
}

/// The numbers of a whole file as VTK's field data.
fn write_whole(out: &mut impl Write, whole: &[(&str, f64)]) -> Result<(), VtuError> {
    if whole.is_empty() {
        return Ok(());
    }
    writeln!(out, "<FieldData>")?;
    for (name, value) in whole {
        if !value.is_finite() {
            return Err(VtuError::NotFinite((*name).into()));
        }
        writeln!(
            out,
            "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfTuples=\"1\" format=\"ascii\">{value:?}</DataArray>"
        )?;
    }
    writeln!(out, "</FieldData>")?;
    Ok(())
}

/// One array as VTK wants it: vectors have three components.
fn attribute(array: &FieldArray, len: usize) -> Result<Attribute, VtuError> {
    let FieldArray { name, components, values } = array;
    if values.len() != len * components {
        return Err(VtuError::Length { name: name.clone(), found: values.len(), needed: len * components });
    }
    if !values.iter().all(|v| v.is_finite()) {
        return Err(VtuError::NotFinite(name.clone()));
    }
    let (components, values) = match components {
        2 => (3, values.chunks_exact(2).flat_map(|v| [v[0], v[1], 0.0]).collect()),
        &n => (n as u32, values.clone()),
    };
    Ok(Attribute::DataArray(DataArray::new(name.as_str(), components).with_vec(values)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sides;
    use vtkio::model::Piece;

    /// A strip of square cells side by side.
    fn strip(cells: u32) -> Mesh {
        let nodes = (0..=cells).flat_map(|i| [[f64::from(i), 0.0], [f64::from(i), 1.0]]).collect();
        let cells = (0..cells).flat_map(|i| [2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1]).collect();
        Mesh { kind: ElementKind::Quad4, nodes, cells, sides: Sides::default() }
    }

    /// With an array of 4096 numbers, which is as long as a block of vtkio.
    #[test]
    fn every_array_is_one_block_and_is_read_back() {
        let mesh = strip(4096);
        let fields = |name: &str, count: usize| FieldArray {
            name: name.into(),
            components: 1,
            values: (0..count).map(|i| (i as f64).sqrt().sin()).collect(),
        };
        let (of_nodes, of_cells) = (fields("at_nodes", mesh.nodes.len()), fields("in_cells", 4096));
        let mut text = Vec::new();
        let [nodes, cells] = [&of_nodes, &of_cells].map(std::slice::from_ref);
        write_vtu(&mut text, &mesh, 1.0, nodes, cells, &[("time", 0.5)]).unwrap();
        let mut rest = std::str::from_utf8(&text).unwrap();
        let mut sizes = Vec::new();
        while let Some((_, array, after)) = next_array(rest) {
            rest = after;
            let Ok(head) = BASE64_STANDARD.decode(array.get(..44).unwrap_or("?")) else { continue };
            let words = head.chunks_exact(8).map(|word| u64::from_le_bytes(word.try_into().unwrap()));
            let words: Vec<u64> = words.collect();
            assert_eq!((words[0], words[2]), (1, words[1]));
            assert_eq!(words[3] as usize, BASE64_STANDARD.decode(&array[44..]).unwrap().len());
            sizes.push(words[1]);
        }
        // two fields, points, cells' nodes, ends, kinds
        assert_eq!(sizes, [8194 * 8, 4096 * 8, 8194 * 24, 4 * 4096 * 8, 4096 * 8, 4096]);

        let read = Vtk::parse_xml(text.as_slice()).unwrap();
        let DataSet::UnstructuredGrid { pieces, .. } = read.data else { panic!("no grid") };
        let Piece::Inline(piece) = &pieces[0] else { panic!("no piece") };
        let values = |attributes: &[Attribute]| match &attributes[0] {
            Attribute::DataArray(array) => array.data.clone().cast_into::<f64>().unwrap(),
            Attribute::Field { .. } => panic!("no array"),
        };
        assert_eq!(values(&piece.data.point), of_nodes.values);
        assert_eq!(values(&piece.data.cell), of_cells.values);
        assert_eq!(piece.points.clone().cast_into::<f64>().unwrap()[3], mesh.nodes[1][0]);
    }
}
