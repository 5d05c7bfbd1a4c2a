//! TIFF of heights in floating point. A file by itself has no units; ImageJ writes them into its description.
//! Sources: TIFF 6.0; ImageJ's `unit=` with pixels per unit as the resolution.

use super::measured::{Format, Measured, ReadError, Request, Spacing};
use crate::dimension::Dimension;
use std::io::Cursor;
use std::path::Path;
use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

const FORMAT: Format = Format("tif");
/// Beginnings: little or big endian, of 32-bit or 64-bit places.
pub(super) const MAGICS: [&[u8]; 4] = [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"];
/// Most bytes that one byte of a strip unpacks to: LZW has codes of 9 to 12 bits for up to 4094 bytes.
const MOST_UNPACKED: u64 = 4094;

fn refused(error: &tiff::TiffError) -> ReadError {
    FORMAT.header(
        "content",
        error,
        "it must be a whole TIFF file, plain or packed by deflate, LZW or PackBits",
    )
}

/// Reads the first page of one floating-point number to a point.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let length = data.len() as u64;
    let mut decoder = Decoder::new(Cursor::new(data)).map_err(|e| refused(&e))?;
    let (columns, rows) = decoder.dimensions().map_err(|e| refused(&e))?;
    let color = decoder.colortype().map_err(|e| refused(&e))?;
    let ColorType::Gray(bits @ (16 | 32 | 64)) = color else {
        return Err(FORMAT.header("kind of points", format_args!("{color:?}"), NO_HEIGHTS));
    };
    if decoder.get_tag_u32(Tag::PhotometricInterpretation).is_ok_and(|shown| shown == 0) {
        return Err(FORMAT.header(
            "photometric interpretation",
            "MinIsWhite",
            "it turns grey levels about, and nothing tells whether the heights are turned too: export MinIsBlack",
        ));
    }
    let bytes = usize::from(bits / 8);
    let count = FORMAT.nodes_within(columns.into(), rows.into(), bytes, request)?;
    let (promised, most) = ((count * bytes) as u64, length * MOST_UNPACKED);
    if promised > most {
        return Err(FORMAT.truncated("heights", promised, most));
    }
    let mut limits = Limits::default();
    // tags are held to the same limit
    limits.decoding_buffer_size = (count * bytes).max(LONGEST_TAG);
    limits.intermediate_buffer_size = count * bytes + (1 << 16);
    let mut decoder = decoder.with_limits(limits);
    let words = |decoder: &mut Decoder<Cursor<Vec<u8>>>, tag| decoder.get_tag_ascii_string(tag).ok();
    let description = words(&mut decoder, Tag::ImageDescription).unwrap_or_default();
    let no_data = words(&mut decoder, Tag::GdalNodata).and_then(|text| text.trim().parse::<f64>().ok());
    let (spacing, height_unit) = units(&mut decoder, &description);
    let mut heights: Vec<f64> = match decoder.read_image().map_err(|e| refused(&e))? {
        DecodingResult::F16(z) => z.into_iter().map(f64::from).collect(),
        DecodingResult::F32(z) => z.into_iter().map(f64::from).collect(),
        DecodingResult::F64(z) => z,
        _ => {
            return Err(FORMAT.header(
                "kind of points",
                format_args!("whole numbers of {bits} bits"),
                NO_HEIGHTS,
            ));
        }
    };
    if heights.len() != count {
        return Err(FORMAT.truncated("heights", promised, (heights.len() * bytes) as u64));
    }
    let is_missing = |z: f64| !z.is_finite() || no_data == Some(z);
    heights.iter_mut().filter(|z| is_missing(**z)).for_each(|z| *z = f64::NAN);
    let mut notes = Vec::new();
    if decoder.more_images() {
        notes.push("of its pages the first was read".into());
    }
    let (columns, rows) = (columns as usize, rows as usize);
    Ok(Measured { columns, rows, heights, spacing, spacing_error: 0.0, height_unit, notes })
}

/// Bytes of the longest tag that is read.
const LONGEST_TAG: usize = 1 << 20;
const NO_HEIGHTS: &str = "heights are floating-point numbers, one to a point: grey levels and colours are none; export 32-bit floats, .sur or .x3p";

/// The words of ImageJ: the unit of places, with pixels per unit, and of values. `vunit` is that of values;
/// `zunit`, that of the distance of slices, stands for it in files without it.
fn units(decoder: &mut Decoder<Cursor<Vec<u8>>>, description: &str) -> (Spacing, Option<f64>) {
    if !description.starts_with("ImageJ") {
        return (Spacing::Unknown, None);
    }
    let value = |key: &str| {
        let mut pairs = description.lines().filter_map(|line| line.split_once('='));
        pairs.find(|(name, _)| *name == key).map(|(_, value)| value.replace("\\u00B5", "µ"))
    };
    let scale = |key: &str| value(key).and_then(|unit| Dimension::Length.scale(&unit));
    let unit = scale("unit");
    let mut per_pixel = |tag| {
        let rational = decoder.get_tag(tag).ok()?.into_u32_vec().ok()?;
        let [up, down] = rational[..] else { return None };
        (up > 0 && down > 0).then(|| f64::from(down) / f64::from(up))
    };
    let pixel = per_pixel(Tag::XResolution).zip(per_pixel(Tag::YResolution));
    let spacing = match (pixel, unit, scale("yunit")) {
        (Some((x, y)), Some(unit), of_y) => Spacing::Metres([x * unit, y * of_y.unwrap_or(unit)]),
        _ => Spacing::Unknown,
    };
    (spacing, scale("vunit").or_else(|| scale("zunit")))
}
