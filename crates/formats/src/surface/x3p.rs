//! x3p of ISO 25178-72: a zip with main.xml and binary heights; all lengths in metres.

use super::archive::plain;
use super::bytes::Number;
use super::measured::{Format, Measured, ReadError, Request};
use crate::memory::MOST_UNPACKED;
use md5::{Digest, Md5};
use roxmltree::{Document, Node, ParsingOptions};
use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::path::Path;
use zip::ZipArchive;
use zip::write::SimpleFileOptions;

const FORMAT: Format = Format("x3p");
/// More than a main.xml holds that does not list a large map itself, which the binary form is for.
const LONGEST_XML: u64 = 1 << 26;
/// Most parts of a main.xml: an entry of some kilobytes can unpack to millions.
const MOST_PARTS: u32 = 1 << 23;

type Zip = ZipArchive<BufReader<File>>;

/// Bytes behind the promised end of a member that are looked at.
const LONGEST_REST: u64 = 1 << 16;

/// Longest tag of a main.xml: a parser compares each attribute of a tag with all others.
const LONGEST_TAG: usize = 1 << 16;

fn damaged(what: impl ToString) -> ReadError {
    FORMAT.damaged(what)
}

/// The members of the archive of one surface.
struct Archive<'r> {
    zip: Zip,
    /// Folder of main.xml, with its last slash.
    folder: String,
    request: &'r Request<'r>,
}

impl<'r> Archive<'r> {
    /// Finds main.xml, in whichever folder was packed.
    fn open(path: &Path, request: &'r Request<'r>) -> Result<Archive<'r>, ReadError> {
        let zip = ZipArchive::new(BufReader::new(File::open(path)?)).map_err(damaged)?;
        let names: Vec<String> = zip.file_names().filter_map(|name| Some(plain(&name.ok()?))).collect();
        // a Mac adds a shadow of every file
        let is_main = |name: &&String| {
            name.rsplit('/').next().is_some_and(|last| last.eq_ignore_ascii_case("main.xml"))
                && !name.split('/').any(|part| part == "__MACOSX")
        };
        let main = names.iter().filter(is_main).min_by_key(|name| name.matches('/').count());
        let main = main.ok_or_else(|| damaged("it holds no main.xml"))?;
        let folder = main.rfind('/').map_or("", |end| &main[..=end]).to_string();
        Ok(Archive { zip, folder, request })
    }

    /// The number of the member that a link names, from the folder of main.xml.
    fn place(&self, link: &str) -> Option<usize> {
        let link = plain(link);
        let wanted = [format!("{}{link}", self.folder), link];
        let is = |name: &str, wanted: &str| plain(name).eq_ignore_ascii_case(wanted);
        let found = |wanted: &String| {
            (0..self.zip.len()).find(|i| {
                self.zip.name_for_index(*i).is_some_and(|name| name.is_ok_and(|name| is(&name, wanted)))
            })
        };
        wanted.iter().find_map(found)
    }

    /// At most `limit` bytes of a member, whatever its directory entry says; its sum is looked at.
    fn member(&mut self, name: &str, limit: u64) -> Result<Vec<u8>, ReadError> {
        let at = |e: String| damaged(format!("{name}: {e}"));
        let place = self.place(name).ok_or_else(|| at("it is not in the archive".into()))?;
        let mut file = self.zip.by_index(place).map_err(|e| at(e.to_string()))?;
        let mut data = Vec::new();
        (&mut file).take(limit).read_to_end(&mut data).map_err(|e| at(e.to_string()))?;
        if self.request.override_file {
            return Ok(data);
        }
        // the sum is compared where the member ends
        let more = io::copy(&mut file.take(LONGEST_REST), &mut io::sink()).map_err(|e| {
            at(format!("its sum (CRC-32) does not hold ({e}); export it anew, or read it as it is with override = true"))
        })?;
        if more > 0 {
            return Err(at(format!("it holds more than the {limit} bytes that main.xml promises")));
        }
        Ok(data)
    }

    /// Compares the MD5 sum that main.xml has of a member.
    fn compare(&self, name: &str, data: &[u8], sum: Option<&str>) -> Result<bool, ReadError> {
        let Some(sum) = sum.filter(|sum| sum.len() == 32 && sum.bytes().all(|b| b.is_ascii_hexdigit()))
        else {
            return Ok(false);
        };
        if self.request.override_file || md5_of(data).eq_ignore_ascii_case(sum) {
            return Ok(true);
        }
        Err(damaged(format!(
            "{name}: its sum (MD5) is not the one in main.xml; export it anew, or read it as it is with override = true"
        )))
    }

    /// A remark where md5checksum.hex is not the sum of main.xml.
    fn remark_on_main(&mut self, xml: &[u8]) -> Option<String> {
        const LONGEST_SUM: u64 = 4096;
        self.place("md5checksum.hex")?;
        let text = self.member("md5checksum.hex", LONGEST_SUM).ok()?;
        let text = String::from_utf8_lossy(&text);
        let sum = text.split_whitespace().next()?;
        (sum.len() == 32 && !md5_of(xml).eq_ignore_ascii_case(sum))
            .then(|| "main.xml was changed after its sum (MD5) was taken".into())
    }
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
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let mut archive = Archive::open(path, request)?;
    let bytes = archive.member("main.xml", LONGEST_XML)?;
    let mut notes: Vec<String> = archive.remark_on_main(&bytes).into_iter().collect();
    let xml = String::from_utf8(bytes).map_err(|_| damaged("main.xml is not UTF-8"))?;
    if xml.split('<').any(|part| part.find('>').unwrap_or(part.len()) > LONGEST_TAG) {
        return Err(damaged(format!("main.xml has a tag of more than {LONGEST_TAG} bytes")));
    }
    let options = ParsingOptions { nodes_limit: MOST_PARTS, ..ParsingOptions::default() };
    let document =
        Document::parse_with_options(xml.trim_start_matches('\u{feff}'), options).map_err(damaged)?;
    let root = document.root_element();
    let (x, y, z) = (Axis::read(root, "CX")?, Axis::read(root, "CY")?, Axis::read(root, "CZ")?);
    refuse_other_features(root, &x, &y)?;
    let size = |key: &'static str| {
        let value = text(root, &["Record3", "MatrixDimension", key]).unwrap_or("");
        value.parse::<u64>().map_err(|_| damaged(format!("MatrixDimension {key} = \"{value}\" is no number")))
    };
    let (columns, rows, layers) = (size("SizeX")?, size("SizeY")?, size("SizeZ")?);
    if layers != 1 {
        return Err(FORMAT.header("SizeZ", layers, "only one layer can be pressed"));
    }
    let link = |key: &str| text(root, &["Record3", "DataLink", key]).filter(|value| !value.is_empty());
    let mut heights = match link("PointDataLink") {
        Some(name) => {
            let number = number_of(&z.kind)?;
            let count = FORMAT.nodes_within(columns, rows, number.size(), request)?;
            let raw = binary(&mut archive, name, number, count)?;
            if !archive.compare(name, &raw, link("MD5ChecksumPointData"))? {
                notes.push("main.xml has no sum (MD5) of the heights".into());
            }
            number.decode_all(&raw, count)
        }
        None => listed(root, FORMAT.nodes_within(columns, rows, 0, request)?)?,
    };
    let count = heights.len();
    heights.iter_mut().for_each(|h| *h = *h * z.increment + z.offset);
    if let Some(name) = link("ValidPointsLink") {
        let length = count.div_ceil(8);
        let mask = archive.member(name, length as u64)?;
        if mask.len() < length {
            return Err(truncated("validity mask", length, mask.len()));
        }
        archive.compare(name, &mask, link("MD5ChecksumValidPoints"))?;
        let is_valid = |i: usize| mask[i / 8] >> (i % 8) & 1 == 1;
        heights.iter_mut().enumerate().filter(|(i, _)| !is_valid(*i)).for_each(|(_, h)| *h = f64::NAN);
    }
    let pixel =
        [FORMAT.positive("CX Increment", x.increment)?, FORMAT.positive("CY Increment", y.increment)?];
    Ok(Measured { notes, ..Measured::in_metres(columns, rows, pixel, heights) })
}

/// Profiles and clouds of points are no maps.
fn refuse_other_features<'a>(root: Node<'a, 'a>, x: &Axis, y: &Axis) -> Result<(), ReadError> {
    let feature = text(root, &["Record1", "FeatureType"]).unwrap_or("SUR");
    if feature != "SUR" {
        let allowed = "only a surface (SUR) can be pressed, no profile or point cloud";
        return Err(FORMAT.header("FeatureType", feature, allowed));
    }
    if x.absolute || y.absolute || child(root, "Record3").is_some_and(|r| child(r, "ListDimension").is_some())
    {
        let allowed = "points must lie on a regular grid (AxisType I)";
        return Err(FORMAT.header("CX, CY", "absolute", allowed));
    }
    Ok(())
}

fn truncated(what: &'static str, promised: usize, found: usize) -> ReadError {
    FORMAT.truncated(what, promised as u64, found as u64)
}

fn number_of(kind: &str) -> Result<Number, ReadError> {
    match kind {
        "I" => Ok(Number::I16),
        "L" => Ok(Number::I32),
        "F" => Ok(Number::F32),
        "D" => Ok(Number::F64),
        other => Err(FORMAT.header("CZ DataType", other, "it must be I, L, F or D")),
    }
}

/// The bytes of `count` heights.
fn binary(archive: &mut Archive<'_>, name: &str, number: Number, count: usize) -> Result<Vec<u8>, ReadError> {
    let promised = count * number.size();
    let packed =
        archive.place(name).and_then(|place| Some(archive.zip.by_index_raw(place).ok()?.compressed_size()));
    let most = packed.unwrap_or(0).saturating_mul(MOST_UNPACKED);
    if promised as u64 > most {
        return Err(FORMAT.truncated("heights", promised as u64, most));
    }
    let raw = archive.member(name, promised as u64)?;
    if raw.len() < promised {
        return Err(truncated("heights", promised, raw.len()));
    }
    Ok(raw)
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
