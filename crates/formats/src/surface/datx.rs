//! Zygo `.datx`: HDF5 with maps in /Data/Surface, each with its unit, its mark of a missing point and its
//! pixels as attributes. Source: the layout that SurfaceTopography (MIT) documents.

use super::measured::{Format, Measured, ReadError, Request};
use crate::dimension::Dimension;
use hdf5_reader::{Dataset, Datatype, Hdf5File, OpenOptions, StringSize, VarLenKind};
use std::path::Path;

const FORMAT: Format = Format("datx");
/// Beginning of HDF5.
pub(super) const MAGIC: &[u8] = b"\x89HDF\r\n\x1a\n";

/// Reads the first surface.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let most = usize::try_from(request.memory()).unwrap_or(usize::MAX);
    let options = OpenOptions::default().with_max_read_bytes(most).with_max_chunk_bytes(most);
    let file = Hdf5File::from_vec_with_options(data, options).map_err(|e| FORMAT.damaged(e))?;
    let maps = file.group("/Data/Surface").and_then(|group| group.datasets());
    let maps = maps.map_err(|_| ReadError::Foreign {
        found: "an HDF5 file without /Data/Surface (.h5, .nid, .mat), no .datx of Zygo".into(),
        export: "save the heights by np.save(\"map.npy\", heights)",
    })?;
    let Some(map) = maps.first() else {
        return Err(FORMAT.header("/Data/Surface", "nothing", "the file must hold heights"));
    };
    let mut measured = surface(map, request)?;
    if maps.len() > 1 {
        measured.notes.push(format!("of its {} surfaces the first was read", maps.len()));
    }
    Ok(measured)
}

fn surface(map: &Dataset, request: &Request<'_>) -> Result<Measured, ReadError> {
    let &[rows, columns] = map.shape() else {
        return Err(FORMAT.header("shape", format_args!("{:?}", map.shape()), "a map has two dimensions"));
    };
    FORMAT.nodes_within(columns, rows, 8, request)?;
    let unit = map.attribute("Unit").and_then(|unit| unit.read_strings()).unwrap_or_default();
    let unit = unit.first().map_or("", String::as_str);
    let up = Dimension::Length.scale(unit);
    let up = up.ok_or_else(|| {
        let allowed = "it must be a unit of length: set one in Mx, or export .xyz";
        FORMAT.header("Unit", format!("\"{unit}\""), allowed)
    })?;
    let pixel = [step(map, "X Converter")?, step(map, "Y Converter")?];
    let missing = map.attribute("No Data").and_then(|value| value.read_as_f64()).ok();
    let damaged = |e: hdf5_reader::error::Error| FORMAT.damaged(e);
    let mut heights: Vec<f64> = match map.dtype() {
        Datatype::FloatingPoint { size: 4, .. } => {
            map.read_array::<f32>().map_err(damaged)?.into_iter().map(f64::from).collect()
        }
        Datatype::FloatingPoint { size: 8, .. } => {
            map.read_array::<f64>().map_err(damaged)?.into_iter().collect()
        }
        other => {
            let allowed = "heights are floating-point numbers of 4 or 8 bytes";
            return Err(FORMAT.header("kind of points", format_args!("{other:?}"), allowed));
        }
    };
    let is_missing = |z: f64| !z.is_finite() || missing == Some(z);
    heights.iter_mut().for_each(|z| *z = if is_missing(*z) { f64::NAN } else { *z * up });
    Ok(Measured::in_metres(columns, rows, pixel, heights))
}

/// Metres per pixel: a converter has a category, the unit "Pixels", and parameters with the step second.
fn step(map: &Dataset, name: &'static str) -> Result<f64, ReadError> {
    let refused = |found: &str| {
        let allowed =
            "it must convert pixels into metres: calibrate the map along the surface, or export .xyz";
        FORMAT.header(name, found, allowed)
    };
    let attributes = map.raw_attributes().map_err(|e| FORMAT.damaged(e))?;
    let attribute = attributes.iter().find(|a| a.name() == name).ok_or_else(|| refused("nothing"))?;
    let message = attribute.message();
    let Datatype::Compound { fields, .. } = &message.datatype else { return Err(refused("no record")) };
    let raw = |place: usize, length: usize| message.raw_data.get(place..place + length);
    let reference = |place: u32, size: usize| {
        let reference = raw(place as usize, map.vlen_reference_size())?;
        map.resolve_vlen_reference_bytes(reference, size).ok()
    };
    let mut unit = None;
    let mut numbers = None;
    for field in fields {
        match &field.datatype {
            Datatype::String { size: StringSize::Fixed(length), .. } => {
                unit = raw(field.byte_offset as usize, *length as usize).map(<[u8]>::to_vec);
            }
            Datatype::String { .. } => unit = reference(field.byte_offset, 1),
            Datatype::VarLen { base, kind, .. } => match **base {
                Datatype::FloatingPoint { size: 8, .. } => numbers = reference(field.byte_offset, 8),
                _ if *kind == VarLenKind::String => unit = reference(field.byte_offset, 1),
                _ => {}
            },
            Datatype::Array { base, dims } => {
                if let Datatype::FloatingPoint { size: 8, .. } = **base {
                    let count: u64 = dims.iter().product();
                    numbers = raw(field.byte_offset as usize, 8 * count as usize).map(<[u8]>::to_vec);
                }
            }
            _ => {}
        }
    }
    let unit = String::from_utf8_lossy(&unit.unwrap_or_default()).trim_end_matches('\0').to_string();
    if unit != "Pixels" {
        return Err(refused(&format!("a converter of \"{unit}\"")));
    }
    let second =
        numbers.and_then(|n| n.get(8..16).map(|b| f64::from_le_bytes(b.try_into().unwrap_or_default())));
    FORMAT.positive(name, second.ok_or_else(|| refused("no parameters"))?)
}
