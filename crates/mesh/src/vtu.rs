//! Fields on a mesh as compressed VTU, the XML format of VTK and ParaView.

use crate::{ElementKind, Mesh};
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
    let file = Vtk {
        version: Version::new_xml(1, 0),
        title: String::new(),
        byte_order: ByteOrder::LittleEndian,
        data: DataSet::inline(piece),
        file_path: None,
    }
    .try_into_xml_format(Compressor::ZLib, 1)
    .map_err(|e| VtuError::Encode(e.to_string()))?;
    let mut text = Vec::new();
    file.write(&mut text).map_err(|e| VtuError::Encode(e.to_string()))?;
    // vtkio writes no data of a whole file
    const GRID: &[u8] = b"<UnstructuredGrid>";
    let start = text.windows(GRID.len()).position(|w| w == GRID).map_or(0, |i| i + GRID.len());
    if start == 0 && !whole.is_empty() {
        return Err(VtuError::Encode("no grid was written".into()));
    }
    out.write_all(&text[..start])?;
    write_whole(&mut out, whole)?;
    out.write_all(&text[start..])?;
    Ok(())
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
