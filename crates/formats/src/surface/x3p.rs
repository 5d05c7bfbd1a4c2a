//! x3p of ISO 25178-72: a zip with main.xml and binary heights; all lengths in metres.

use super::bytes::Number;
use super::measured::{Format, Measured, ReadError};
use md5::{Digest, Md5};
use roxmltree::{Document, Node, ParsingOptions};
use std::fs::File;
use std::io::{BufReader, Read, Write};
use std::path::Path;
use zip::ZipArchive;
use zip::write::SimpleFileOptions;

const FORMAT: Format = Format("x3p");
/// More than a main.xml holds that does not list a large map itself, which the binary form is for.
const LONGEST_XML: u64 = 1 << 26;
/// Most parts of a main.xml: an entry of some kilobytes can unpack to millions.
const MOST_PARTS: u32 = 1 << 23;

type Zip = ZipArchive<BufReader<File>>;

/// Longest tag of a main.xml: a parser compares each attribute of a tag with all others.
const LONGEST_TAG: usize = 1 << 16;

fn damaged(what: impl ToString) -> ReadError {
    ReadError::Container(what.to_string())
}

/// At most `limit` bytes of a member, whatever its directory entry says.
fn member(zip: &mut Zip, name: &str, limit: u64) -> Result<Vec<u8>, ReadError> {
    let mut data = Vec::new();
    // some programs write the paths of Windows
    let stored = if zip.index_for_name(name).is_some() { name.into() } else { name.replace('\\', "/") };
    let file = zip.by_name(&stored).map_err(|e| damaged(format!("{name}: {e}")))?;
    file.take(limit).read_to_end(&mut data).map_err(|e| damaged(format!("{name}: {e}")))?;
    Ok(data)
}

fn child<'a>(node: Node<'a, 'a>, name: &str) -> Option<Node<'a, 'a>> {
    node.children().find(|n| n.tag_name().name() == name)
}

fn text<'a>(node: Node<'a, 'a>, path: &[&str]) -> Option<&'a str> {
    path.iter().try_fold(node, |node, name| child(node, name)).and_then(|n| n.text()).map(str::trim)
}

/// One axis of Record1.
struct Axis {
    absolute: bool,
    kind: String,
    increment: f64,
    offset: f64,
}

impl Axis {
    fn read<'a>(root: Node<'a, 'a>, name: &'static str) -> Result<Axis, ReadError> {
        let get = |key: &str| text(root, &["Record1", "Axes", name, key]);
        let number = |key: &str, absent: f64| -> Result<f64, ReadError> {
            get(key).filter(|t| !t.is_empty()).map_or(Ok(absent), |t| {
                t.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
                    FORMAT.header(name, format!("{key} \"{t}\""), "it must be a finite number")
                })
            })
        };
        let axis_type =
            get("AxisType").ok_or_else(|| damaged(format!("main.xml has no AxisType for {name}")))?;
        Ok(Axis {
            absolute: axis_type == "A",
            kind: get("DataType").unwrap_or("D").to_string(),
            increment: number("Increment", 1.0)?,
            offset: number("Offset", 0.0)?,
        })
    }
}

/// Reads a surface; profiles, point clouds and layers are refused.
pub(super) fn read(path: &Path) -> Result<Measured, ReadError> {
    let mut zip = ZipArchive::new(BufReader::new(File::open(path)?)).map_err(damaged)?;
    if zip.index_for_name("main.xml").is_none() {
        return Err(damaged("it is a zip archive without main.xml, some other kind of file"));
    }
    let xml = member(&mut zip, "main.xml", LONGEST_XML)?;
    let xml = String::from_utf8(xml).map_err(|_| damaged("main.xml is not UTF-8"))?;
    if xml.split('<').any(|part| part.find('>').unwrap_or(part.len()) > LONGEST_TAG) {
        return Err(damaged(format!("main.xml has a tag of more than {LONGEST_TAG} bytes")));
    }
    let options = ParsingOptions { nodes_limit: MOST_PARTS, ..ParsingOptions::default() };
    let document =
        Document::parse_with_options(xml.trim_start_matches('\u{feff}'), options).map_err(damaged)?;
    let root = document.root_element();
    let (x, y, z) = (Axis::read(root, "CX")?, Axis::read(root, "CY")?, Axis::read(root, "CZ")?);
    let feature = text(root, &["Record1", "FeatureType"]).unwrap_or("SUR");
    let refuse = |name, value: String, allowed| Err(FORMAT.header(name, value, allowed));
    if feature != "SUR" {
        return refuse(
            "FeatureType",
            feature.into(),
            "only a surface (SUR) can be pressed, no profile or point cloud",
        );
    }
    if x.absolute || y.absolute || child(root, "Record3").is_some_and(|r| child(r, "ListDimension").is_some())
    {
        return refuse("CX, CY", "absolute".into(), "points must lie on a regular grid (AxisType I)");
    }
    let size = |key: &'static str| {
        let value = text(root, &["Record3", "MatrixDimension", key]).unwrap_or("");
        value.parse::<u64>().map_err(|_| damaged(format!("MatrixDimension {key} = \"{value}\" is no number")))
    };
    let (columns, rows, layers) = (size("SizeX")?, size("SizeY")?, size("SizeZ")?);
    if layers != 1 {
        return refuse("SizeZ", layers.to_string(), "only one layer can be pressed");
    }
    let count = FORMAT.nodes(columns, rows)?;
    let mut heights = match text(root, &["Record3", "DataLink", "PointDataLink"]) {
        Some(name) => binary(&mut zip, name, &z.kind, count)?,
        None => listed(root, count)?,
    };
    heights.iter_mut().for_each(|h| *h = *h * z.increment + z.offset);
    if let Some(name) = text(root, &["Record3", "DataLink", "ValidPointsLink"]).filter(|n| !n.is_empty()) {
        let mask = member(&mut zip, name, (count as u64).div_ceil(8))?;
        if mask.len() < count.div_ceil(8) {
            return Err(truncated("validity mask", count.div_ceil(8), mask.len()));
        }
        heights
            .iter_mut()
            .enumerate()
            .filter(|(i, _)| mask[i / 8] >> (i % 8) & 1 == 0)
            .for_each(|(_, h)| *h = f64::NAN);
    }
    let pixel =
        [FORMAT.positive("CX Increment", x.increment)?, FORMAT.positive("CY Increment", y.increment)?];
    Ok(Measured::in_metres(columns, rows, pixel, heights))
}

fn truncated(what: &'static str, promised: usize, found: usize) -> ReadError {
    FORMAT.truncated(what, promised as u64, found as u64)
}

fn binary(zip: &mut Zip, name: &str, kind: &str, count: usize) -> Result<Vec<f64>, ReadError> {
    let number = match kind {
        "I" => Number::I16,
        "L" => Number::I32,
        "F" => Number::F32,
        "D" => Number::F64,
        other => {
            return Err(FORMAT.header("CZ DataType", other, "it must be I, L, F or D"));
        }
    };
    let promised = count * number.size();
    let raw = member(zip, name, promised as u64)?;
    if raw.len() < promised {
        return Err(truncated("heights", promised, raw.len()));
    }
    Ok(number.decode_all(&raw, count))
}

/// Heights written in main.xml: the last number of each Datum, an empty one is missing.
fn listed<'a>(root: Node<'a, 'a>, count: usize) -> Result<Vec<f64>, ReadError> {
    let list = child(root, "Record3").and_then(|r| child(r, "DataList"));
    let list = list.ok_or_else(|| damaged("main.xml has neither DataLink nor DataList"))?;
    let mut heights = Vec::new();
    for datum in list.children().filter(|n| n.tag_name().name() == "Datum") {
        let word = datum.text().unwrap_or("").rsplit(';').next().unwrap_or("").trim();
        heights.push(match word {
            "" => f64::NAN,
            word => word.parse().map_err(|_| damaged(format!("Datum \"{word}\" is no number")))?,
        });
    }
    if heights.len() < count {
        return Err(truncated("heights (as Datum)", count, heights.len()));
    }
    heights.truncate(count);
    Ok(heights)
}

fn md5_of(data: &[u8]) -> String {
    Md5::digest(data).iter().map(|b| format!("{b:02X}")).collect()
}

/// Writes heights (m) as an x3p of 64-bit floats; missing points are NaN and out of the validity mask.
pub fn write_x3p(
    path: &Path,
    columns: usize,
    rows: usize,
    pixel: [f64; 2],
    heights: &[f64],
) -> std::io::Result<()> {
    let data: Vec<u8> = heights.iter().flat_map(|z| z.to_le_bytes()).collect();
    let mut mask = vec![0u8; heights.len().div_ceil(8)];
    heights.iter().enumerate().filter(|(_, z)| !z.is_nan()).for_each(|(i, _)| mask[i / 8] |= 1 << (i % 8));
    let holes = heights.iter().any(|z| z.is_nan());
    let valid = if holes {
        format!(
            "<ValidPointsLink>bindata/valid.bin</ValidPointsLink><MD5ChecksumValidPoints>{}</MD5ChecksumValidPoints>",
            md5_of(&mask)
        )
    } else {
        String::new()
    };
    let axis = |name: &str, increment: f64| {
        format!(
            "<{name}><AxisType>I</AxisType><DataType>D</DataType><Increment>{increment:e}</Increment><Offset>0</Offset></{name}>"
        )
    };
    let xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"no\"?>\n\
         <p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\n\
         <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>{}{}\
         <CZ><AxisType>A</AxisType><DataType>D</DataType><Increment>1</Increment><Offset>0</Offset></CZ></Axes></Record1>\n\
         <Record2><Date>1970-01-01T00:00:00</Date><Instrument><Manufacturer>asperity</Manufacturer><Model>asperity</Model>\
         <Serial>none</Serial><Version>{}</Version></Instrument><CalibrationDate>1970-01-01T00:00:00</CalibrationDate>\
         <ProbingSystem><Type>Software</Type><Identification>asperity</Identification></ProbingSystem></Record2>\n\
         <Record3><MatrixDimension><SizeX>{columns}</SizeX><SizeY>{rows}</SizeY><SizeZ>1</SizeZ></MatrixDimension>\
         <DataLink><PointDataLink>bindata/data.bin</PointDataLink><MD5ChecksumPointData>{}</MD5ChecksumPointData>{valid}\
         </DataLink></Record3>\n\
         <Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>\n</p:ISO5436_2>\n",
        axis("CX", pixel[0]),
        axis("CY", pixel[1]),
        env!("CARGO_PKG_VERSION"),
        md5_of(&data),
    );
    let sum = format!("{} *main.xml\n", md5_of(xml.as_bytes()));
    let mut zip = zip::ZipWriter::new(File::create(path)?);
    let options = SimpleFileOptions::default();
    let mut members: Vec<(&str, &[u8])> =
        vec![("main.xml", xml.as_bytes()), ("bindata/data.bin", &data), ("md5checksum.hex", sum.as_bytes())];
    if holes {
        members.push(("bindata/valid.bin", &mask));
    }
    for (name, content) in members {
        zip.start_file(name, options)?;
        zip.write_all(content)?;
    }
    zip.finish()?;
    Ok(())
}
