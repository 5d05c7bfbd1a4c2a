//! Claims about the readers and writers of surfaces.

use super::*;
use std::path::PathBuf;

/// A file that nothing else is known of.
fn read_plain(path: &Path) -> Result<Measured, ReadError> {
    read(path, &Request::default())
}

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: &str, content: &[u8]) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    }
}

fn npy(descr: &str, fortran: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let dictionary = format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}");
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend(((dictionary.len() + 1) as u16).to_le_bytes());
    file.extend(dictionary.as_bytes());
    file.push(b'\n');
    file.extend(data);
    file
}

fn sur(bits: u16, values: &[i32]) -> Vec<u8> {
    let mut file = vec![0u8; 512];
    let mut put = |at: usize, bytes: &[u8]| file[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, b"DIGITAL SURF");
    put(18, &2i16.to_le_bytes());
    put(86, &1i16.to_le_bytes());
    put(98, &bits.to_le_bytes());
    put(100, &10i32.to_le_bytes());
    put(108, &3i32.to_le_bytes());
    put(112, &2i32.to_le_bytes());
    put(120, &0.5f32.to_le_bytes());
    put(124, &0.25f32.to_le_bytes());
    put(128, &2.0f32.to_le_bytes());
    put(180, b"mm");
    put(196, b"um");
    put(212, b"nm");
    put(334, &4i16.to_le_bytes());
    file.extend(b"note");
    for v in values {
        if bits == 16 { file.extend((*v as i16).to_le_bytes()) } else { file.extend(v.to_le_bytes()) }
    }
    file
}

/// The same file with its heights in two zlib streams.
fn packed_sur() -> Vec<u8> {
    let plain = sur(16, &[10, 11, 12, 13, 8, 15]);
    let (head, heights) = plain.split_at(516);
    let mut file = b"DSCOMPRESSED".to_vec();
    file.extend(&head[12..]);
    file.extend(2u32.to_le_bytes());
    let streams: Vec<Vec<u8>> = heights
        .chunks(6)
        .map(|part| {
            let mut stream = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
            std::io::Write::write_all(&mut stream, part).unwrap();
            stream.finish().unwrap()
        })
        .collect();
    for stream in &streams {
        file.extend(6u32.to_le_bytes());
        file.extend((stream.len() as u32).to_le_bytes());
    }
    file.extend(streams.concat());
    file
}

fn x3p_of(heights: &[f64; 6]) -> Vec<u8> {
    let folder = Folder::new();
    let path = folder.0.path().join("a.x3p");
    write_x3p(&path, 3, 2, [1e-6, 1e-6], heights).unwrap();
    std::fs::read(&path).unwrap()
}

fn al3d() -> Vec<u8> {
    let mut file = b"AliconaImaging\0\r\n".to_vec();
    let mut tag = |key: &str, value: &str| {
        let mut line = vec![0u8; 50];
        line[..key.len()].copy_from_slice(key.as_bytes());
        line[20..20 + value.len()].copy_from_slice(value.as_bytes());
        file.extend(line);
        file.extend(b"\r\n");
    };
    tag("Version", "1");
    tag("TagCount", "6");
    tag("Cols", "3");
    tag("Rows", "2");
    tag("PixelSizeXMeter", "1e-6");
    tag("PixelSizeYMeter", "2e-6");
    tag("InvalidPixelValue", "3.0e15");
    tag("DepthImageOffset", "500");
    file.resize(500, 0);
    for row in [[1.0f32, 2.0, 3.0], [4.0, 3.0e15, 6.0]] {
        row.iter().for_each(|v| file.extend(v.to_le_bytes()));
        file.extend([0; 4]);
    }
    file
}

fn sdf_binary() -> Vec<u8> {
    let mut file = b"bISO-1.0".to_vec();
    file.extend([b' '; 34]);
    file.extend(3u16.to_le_bytes());
    file.extend(2u16.to_le_bytes());
    [1e-6, 2e-6, 1e-9, 1e-9].iter().for_each(|v: &f64| file.extend(v.to_le_bytes()));
    file.extend([0, 5, 0]);
    [1i16, 2, 3, 4, i16::MIN, 6].iter().for_each(|v| file.extend(v.to_le_bytes()));
    file
}

const SDF: &str = "aISO-1.0\nManufacID = x\nNumPoints = 3\nNumProfiles = 2\nXscale = 1e-6\nYscale = 2e-6\nZscale = 1e-9\n\
                   DataType = 7\n*\n1 2 3\n4 BAD 6\n*\n";

fn same(found: &Measured, want: [f64; 6], unit: f64) {
    assert_eq!((found.columns, found.rows), (3, 2));
    for (a, b) in found.heights.iter().zip(want) {
        assert!((a.is_nan() && b.is_nan()) || (a * unit - b).abs() <= 1e-15 * b.abs().max(1.0), "{a} {b}");
    }
}

const NAN: f64 = f64::NAN;

#[test]
fn npy_of_every_kind_and_order_is_read() {
    let folder = Folder::new();
    let values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let c_order = |f: &dyn Fn(f64) -> Vec<u8>| values.iter().flat_map(|v| f(*v)).collect::<Vec<u8>>();
    let halves: Vec<u8> =
        [0x3c00u16, 0x4000, 0x4200, 0x4400, 0x4500, 0x4600].iter().flat_map(|b| b.to_be_bytes()).collect();
    let cases: [(&str, Vec<u8>); 10] = [
        (">f2", halves),
        ("<u8", c_order(&|v| (v as u64).to_le_bytes().to_vec())),
        ("<f8", c_order(&|v| v.to_le_bytes().to_vec())),
        (">f8", c_order(&|v| v.to_be_bytes().to_vec())),
        ("<f4", c_order(&|v| (v as f32).to_le_bytes().to_vec())),
        (">i2", c_order(&|v| (v as i16).to_be_bytes().to_vec())),
        ("<i4", c_order(&|v| (v as i32).to_le_bytes().to_vec())),
        ("<u2", c_order(&|v| (v as u16).to_le_bytes().to_vec())),
        ("|u1", c_order(&|v| vec![v as u8])),
        ("<i8", c_order(&|v| (v as i64).to_le_bytes().to_vec())),
    ];
    for (descr, data) in &cases {
        same(&read_plain(&folder.file("a.npy", &npy(descr, "False", "(2, 3)", data))).unwrap(), values, 1.0);
    }
    let by_column: Vec<u8> = [1.0, 4.0, 2.0, 5.0, 3.0, 6.0f64].iter().flat_map(|v| v.to_le_bytes()).collect();
    same(&read_plain(&folder.file("a.npy", &npy("<f8", "True", "(2, 3)", &by_column))).unwrap(), values, 1.0);
    for (descr, shape) in [
        ("<f8", "(2, 4)"),
        ("<f8", "(6,)"),
        ("<f8", "(1, 2, 3)"),
        ("<f8", "(99999999999, 3)"),
        ("<f8", "(999999999, 999999999)"),
        ("<f8", "(0, 3)"),
        ("<c16", "(1, 3)"),
        ("|S8", "(2, 3)"),
        ("|O", "(2, 3)"),
        ("<f8', [[[", "(2, 3)"),
    ] {
        assert!(
            read_plain(&folder.file("a.npy", &npy(descr, "False", shape, &cases[2].1))).is_err(),
            "{descr} {shape}"
        );
    }
}

#[test]
fn instrument_files_are_read_with_units_and_holes() {
    let folder = Folder::new();
    for bits in [16, 32] {
        let found = read_plain(&folder.file("a.sur", &sur(bits, &[10, 11, 12, 13, 8, 15]))).unwrap();
        same(&found, [20.0, 22.0, 24.0, 26.0, NAN, 30.0], 1.0);
        assert_eq!(found.spacing, Spacing::Metres([0.5e-3, 0.25e-6]));
        assert_eq!(found.height_unit, Some(1e-9));
    }
    same(
        &read_plain(&folder.file("a.sur", &packed_sur())).unwrap(),
        [20.0, 22.0, 24.0, 26.0, NAN, 30.0],
        1.0,
    );
    let found = read_plain(&folder.file("a.al3d", &al3d())).unwrap();
    same(&found, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
    assert_eq!(found.spacing, Spacing::Metres([1e-6, 2e-6]));
    for content in [SDF.as_bytes(), &sdf_binary()] {
        let found = read_plain(&folder.file("a.sdf", content)).unwrap();
        same(&found, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1e9);
        assert_eq!(found.spacing, Spacing::Metres([1e-6, 2e-6]));
    }
}

#[test]
fn what_is_written_is_read_back() {
    let folder = Folder::new();
    let heights = [1e-6, -2e-6, 3.25e-6, NAN, 1.0 / 3.0, 6.0];
    let path = folder.0.path().join("a.x3p");
    write_x3p(&path, 3, 2, [0.1e-6, 1.0 / 3.0], &heights).unwrap();
    let found = read_plain(&path).unwrap();
    same(&found, heights, 1.0);
    assert_eq!(found.spacing, Spacing::Metres([0.1e-6, 1.0 / 3.0]));
    let path = folder.0.path().join("a.npy");
    write_npy(&path, 3, 2, &heights).unwrap();
    same(&read_plain(&path).unwrap(), heights, 1.0);
}

#[test]
fn text_is_read_as_table_or_points() {
    let folder = Folder::new();
    for table in ["1,2,3\n4,,6\n", "# note\n1;2;3;\n4;nan;6;\n", "1 2 3\n4 BAD 6"] {
        let found = read_plain(&folder.file("a.csv", table.as_bytes())).unwrap();
        same(&found, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
        assert_eq!(found.spacing, Spacing::Unknown);
    }
    let points = "0 0 1\n1 0 2\n2.00000001 0 3\n2 0.5 6\n0 0.5 4\n";
    let found = read_plain(&folder.file("a.xyz", points.as_bytes())).unwrap();
    same(&found, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
    let Spacing::HeightUnits([dx, dy]) = found.spacing else { panic!("{:?}", found.spacing) };
    assert!((dx - 1.0).abs() < 1e-7 && dy == 0.5);
    same(
        &read_plain(&folder.file("a.csv", b"\xef\xbb\xbf1\t2\t3\r\n4\t\t6\r\n")).unwrap(),
        [1.0, 2.0, 3.0, 4.0, NAN, 6.0],
        1.0,
    );
    same(
        &read_plain(&folder.file("a.xyz", format!("X Y Z\n{points}").as_bytes())).unwrap(),
        [1.0, 2.0, 3.0, 4.0, NAN, 6.0],
        1.0,
    );
    let titled = format!("x,y,z\n{}", points.replace(' ', ","));
    let named = read_plain(&folder.file("b.csv", titled.as_bytes())).unwrap();
    assert_eq!(
        (format!("{:?}", named.heights), named.spacing),
        (format!("{:?}", found.heights), found.spacing)
    );
    for (name, bad) in [
        ("a.csv", "1,2\n3\n"),
        ("a.csv", "1,two\n"),
        ("a.csv", ""),
        ("a.xyz", "0 0 1\n0 1 2\n"),
        ("a.xyz", "0 0 1\n1 0 2\n1.7 1 3\n0.2 0.3 3\n0.9 0.8 1\n"),
        ("a.xyz", "0 0\n"),
        ("a.xyz", "0 0 1\n0 0 2\n1 1 1\n1 0 3\n"),
        ("a.png", "\u{89}PNG"),
        ("a.npy", "hello"),
        ("a", ""),
    ] {
        assert!(read_plain(&folder.file(name, bad.as_bytes())).is_err(), "{name} {bad}");
    }
}

#[test]
fn an_x3p_that_lies_is_refused_and_not_unpacked() {
    let folder = Folder::new();
    let path = folder.0.path().join("a.x3p");
    write_x3p(&path, 3, 2, [1.0, 1.0], &[0.0; 6]).unwrap();
    let content = |size: &str, feature: &str, kind: &str| {
        let axis = "<AxisType>I</AxisType><DataType>D</DataType><Increment>1</Increment>";
        let xml = format!(
            "<p:I xmlns:p='u'><Record1><FeatureType>{feature}</FeatureType><Axes><CX>{axis}</CX><CY>{axis}</CY>\
             <CZ><AxisType>A</AxisType><DataType>{kind}</DataType></CZ></Axes></Record1><Record3><MatrixDimension>\
             <SizeX>{size}</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink>\
             <PointDataLink>d.bin</PointDataLink></DataLink></Record3></p:I>"
        );
        let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        for (name, data) in [("main.xml", xml.into_bytes()), ("d.bin", vec![0; 48])] {
            zip.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
            std::io::Write::write_all(&mut zip, &data).unwrap();
        }
        zip.finish().unwrap().into_inner()
    };
    assert!(read_plain(&folder.file("b.x3p", &content("3", "SUR", "D"))).is_ok());
    let tags: String = (0..100_000).map(|i| format!(" a{i}='1'")).collect();
    let long = read_plain(&folder.file("b.x3p", &content("3", &format!("<b{tags}/>SUR"), "D")))
        .unwrap_err()
        .to_string();
    assert!(long.contains("65536 bytes"), "{long}");
    for (size, feature, kind) in [
        ("4", "SUR", "D"),
        ("1000000000", "SUR", "D"),
        ("-3", "SUR", "D"),
        ("3", "PRF", "D"),
        ("3", "SUR", "Q"),
    ] {
        assert!(
            read_plain(&folder.file("b.x3p", &content(size, feature, kind))).is_err(),
            "{size} {feature} {kind}"
        );
    }
}

mod asked;
mod beside;
mod claims;
mod containers;
mod fuzz;
mod instruments;
mod scanning;
mod tables;
mod titled;
mod words;
