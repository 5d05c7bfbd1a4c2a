//! Claims about files of instruments: archives as people pack them, sums, versions, types of objects.

use super::*;
use std::io::Write;
use zip::write::SimpleFileOptions;

const HEIGHTS: [f64; 6] = [1e-6, -2e-6, 3e-6, NAN, 5e-6, 6e-6];

/// The members of an x3p of [`HEIGHTS`].
fn members() -> Vec<(String, Vec<u8>)> {
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(x3p_of(&HEIGHTS))).unwrap();
    (0..zip.len())
        .map(|i| {
            let mut member = zip.by_index(i).unwrap();
            let mut data = Vec::new();
            member.read_to_end(&mut data).unwrap();
            (member.name().unwrap().to_string(), data)
        })
        .collect()
}

fn packed(members: &[(String, Vec<u8>)], method: zip::CompressionMethod) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, data) in members {
        zip.start_file(name.as_str(), SimpleFileOptions::default().compression_method(method)).unwrap();
        zip.write_all(data).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

fn renamed(rename: impl Fn(&str) -> String) -> Vec<(String, Vec<u8>)> {
    members().into_iter().map(|(name, data)| (rename(&name), data)).collect()
}

fn found(name: &str, content: &[u8]) -> Result<Measured, String> {
    read_plain(&Folder::new().file(name, content)).map_err(|e| e.to_string())
}

const DEFLATED: zip::CompressionMethod = zip::CompressionMethod::Deflated;

/// github heike/x3ptools: archives of a folder, with the shadows that a Mac adds.
#[test]
fn an_x3p_is_read_from_whichever_folder_was_packed() {
    let shadow = ("__MACOSX/scan/._main.xml".to_string(), b"shadow".to_vec());
    let decoy = ("__MACOSX/main.xml".to_string(), b"shadow".to_vec());
    for members in [
        members(),
        renamed(|n| format!("scan 7/{n}")),
        renamed(|n| format!("./{n}")),
        renamed(|n| format!("a/b/{n}")),
        renamed(|n| n.replace('/', "\\")),
        renamed(|n| n.to_uppercase()),
        [renamed(|n| format!("scan/{n}")), vec![shadow, decoy]].concat(),
    ] {
        let names: Vec<&String> = members.iter().map(|m| &m.0).collect();
        let map = found("a.x3p", &packed(&members, DEFLATED)).unwrap_or_else(|e| panic!("{names:?}: {e}"));
        same(&map, HEIGHTS, 1.0);
        assert!(map.notes.is_empty(), "{names:?} {:?}", map.notes);
    }
}

#[test]
fn archives_of_other_programs_are_named() {
    for (names, word) in [
        (&["[Content_Types].xml", "xl/workbook.xml"][..], "workbook"),
        (&["index.xml", "LAYER_0.raw"], "plux"),
        (&["arr_0.npy"], "np.save"),
        (&["content.xml", "mimetype"], "workbook"),
        (&["holiday.jpg"], "holiday.jpg"),
    ] {
        let members: Vec<_> = names.iter().map(|n| (n.to_string(), b"x".to_vec())).collect();
        let refused = found("a.x3p", &packed(&members, DEFLATED)).unwrap_err();
        assert!(refused.contains(word) && !refused.contains("damaged"), "{refused}");
    }
    for (start, word) in [
        (&b"\x89PNGrest"[..], "PNG"),
        (b"CDF\x01rest", "NetCDF"),
        (b"KPK1rest", "Keyence"),
        (b"# vtk DataFile Version 3.0\nheights\nASCII\n", "(.vti, in ParaView)"),
        (b"P5\n3 2\n255\n123456", "export the heights"),
        (b"\\*Force file list\r\n", "force curve"),
    ] {
        let refused = found("a.dat", start).unwrap_err();
        assert!(refused.contains(word) && refused.contains("not read"), "{refused}");
    }
    let office = found("a.doc", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1rest").unwrap_err();
    assert!(office.contains("workbook") && office.contains("CSV"), "{office}");
}

/// Files that gwyfile 0.3.0 and gsffile 0.5.5 (PyPI) wrote: 3 x 2 points of 0.5 x 0.25 um, the last but one
/// no number; the second Gwyddion file has a channel of phase before that of heights.
#[test]
fn files_of_gwyddion_by_independent_writers_are_read() {
    let want = [1e-7, 2e-7, -3e-7, 4e-7, NAN, 6e-7];
    for (name, content) in [
        ("a.gwy", &include_bytes!("data/gwyfile.gwy")[..]),
        ("b.gwy", include_bytes!("data/gwyfile-two-channels.gwy")),
        ("a.gsf", include_bytes!("data/gsffile.gsf")),
    ] {
        let map = found(name, content).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!((map.columns, map.rows, map.height_unit), (3, 2, Some(1.0)));
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-7 || a.is_nan() && b.is_nan();
        assert!(map.heights.iter().zip(want).all(|(a, b)| near(*a, b)), "{name} {:?}", map.heights);
        let Spacing::Metres(p) = map.spacing else { panic!() };
        assert!(near(p[0], 0.5e-6) && near(p[1], 0.25e-6), "{name} {p:?}");
        assert_eq!(map.notes.len(), usize::from(name == "b.gwy"), "{:?}", map.notes);
        // every cut is answered
        let folder = Folder::new();
        assert!((0..content.len() - 1).all(|end| read_plain(&folder.file(name, &content[..end])).is_err()));
    }
}

/// Every flipped bit of the stored heights is found by the sum of the archive, and a sum in main.xml that is
/// not that of the heights by itself.
#[test]
fn a_flipped_bit_of_an_x3p_is_found() {
    let whole = packed(&members(), zip::CompressionMethod::Stored);
    let heights: Vec<u8> = HEIGHTS.iter().flat_map(|z| z.to_le_bytes()).collect();
    let start = whole.windows(heights.len()).position(|w| w == heights).unwrap();
    let folder = Folder::new();
    for bit in 0..8 * heights.len() {
        let mut file = whole.clone();
        file[start + bit / 8] ^= 1 << (bit % 8);
        let path = folder.file("a.x3p", &file);
        let refused = read_plain(&path).unwrap_err().to_string();
        assert!(refused.contains("bindata/data.bin") && refused.contains("CRC-32"), "{refused}");
        assert!(read(&path, &Request { override_file: true, ..Request::default() }).is_ok());
    }
    let mut other = members();
    let data = other.iter_mut().find(|m| m.0 == "bindata/data.bin").unwrap();
    data.1[3] ^= 1;
    let refused = found("a.x3p", &packed(&other, DEFLATED)).unwrap_err();
    assert!(refused.contains("MD5") && refused.contains("bindata/data.bin"), "{refused}");
    // of main.xml alone it is a remark
    let mut other = members();
    let main = other.iter_mut().find(|m| m.0 == "main.xml").unwrap();
    main.1.push(b'\n');
    let map = found("a.x3p", &packed(&other, DEFLATED)).unwrap();
    assert!(map.notes.iter().any(|n| n.contains("main.xml was changed")), "{:?}", map.notes);
}

#[test]
fn heights_longer_than_promised_and_more_than_may_be_taken_are_refused() {
    let mut longer = members();
    longer.iter_mut().find(|m| m.0 == "bindata/data.bin").unwrap().1.extend([0; 8]);
    let refused = found("a.x3p", &packed(&longer, DEFLATED)).unwrap_err();
    assert!(refused.contains("more than"), "{refused}");
    let (side, zeros) = (4000usize, vec![0u8; 4000 * 4000 * 2]);
    let xml = String::from_utf8(members().into_iter().find(|m| m.0 == "main.xml").unwrap().1).unwrap();
    let xml = xml
        .replace("<SizeX>3", &format!("<SizeX>{side}"))
        .replace("<SizeY>2", &format!("<SizeY>{side}"))
        .replace("<CZ><AxisType>A</AxisType><DataType>D", "<CZ><AxisType>A</AxisType><DataType>I");
    let xml = xml.split("<MD5Checksum").next().unwrap().to_string() + "</DataLink></Record3></p:ISO5436_2>";
    let bomb = [("main.xml".to_string(), xml.clone().into_bytes()), ("bindata/data.bin".into(), zeros)];
    let folder = Folder::new();
    let path = folder.file("a.x3p", &packed(&bomb, DEFLATED));
    assert!(std::fs::metadata(&path).unwrap().len() < 40_000);
    let request = Request { memory_limit: Some(100_000_000), ..Request::default() };
    let refused = read(&path, &request).unwrap_err().to_string();
    assert!(refused.contains("memory_limit") && refused.contains("16000000 points"), "{refused}");
    assert!(read(&path, &Request { memory_limit: Some(200_000_000), ..Request::default() }).is_ok());
    // a stream cannot hold more than 1032 times its bytes
    let wide = xml.replace("<SizeX>4000", "<SizeX>400000").replace("<DataType>I<", "<DataType>D<");
    let short = [("main.xml".to_string(), wide.into_bytes()), ("bindata/data.bin".into(), vec![0; 4000])];
    let refused = found("a.x3p", &packed(&short, DEFLATED)).unwrap_err();
    assert!(refused.contains("promises") || refused.contains("memory_limit"), "{refused}");
}

/// Binary SDF of a version with heights of a type, the third point missing.
fn sdf_of(version: &str, kind: u8, missing: &[u8]) -> Vec<u8> {
    let mut file = format!("b{version}").into_bytes();
    file.resize(42, b' ');
    for size in [3u32, 2] {
        let wide = if version == "ISO-2.0" { 4 } else { 2 };
        file.extend(&size.to_le_bytes()[..wide]);
    }
    [1e-6, 2e-6, 1e-9, 1e-9].iter().for_each(|v: &f64| file.extend(v.to_le_bytes()));
    file.extend([0, kind, 0]);
    for z in [1, 2, 3, 4, 0, 6] {
        match kind {
            _ if z == 0 => file.extend(missing),
            0 | 4 => file.push(z as u8),
            1 | 5 => file.extend((z as u16).to_le_bytes()),
            2 | 6 => file.extend((z as u32).to_le_bytes()),
            3 => file.extend((z as f32).to_le_bytes()),
            _ => file.extend(f64::from(z).to_le_bytes()),
        }
    }
    file
}

/// sdfio 2.0.0 (PyPI), ISO 25178-71: BCR marks a point that was not measured by the largest number of its
/// type, ISO by the smallest of signed types.
#[test]
fn every_version_and_type_of_sdf_has_its_own_mark_of_a_missing_point() {
    let want = [1.0, 2.0, 3.0, 4.0, NAN, 6.0];
    for version in ["ISO-1.0", "ISO-2.0", "BCR-1.0", "NIST-1.0"] {
        let is_bcr = version == "BCR-1.0";
        let signed = |low: Vec<u8>, high: Vec<u8>| if is_bcr { high } else { low };
        let marks: [Vec<u8>; 8] = [
            vec![255],
            u16::MAX.to_le_bytes().into(),
            u32::MAX.to_le_bytes().into(),
            f32::MAX.to_le_bytes().into(),
            signed(i8::MIN.to_le_bytes().into(), i8::MAX.to_le_bytes().into()),
            signed(i16::MIN.to_le_bytes().into(), i16::MAX.to_le_bytes().into()),
            signed(i32::MIN.to_le_bytes().into(), i32::MAX.to_le_bytes().into()),
            f64::MAX.to_le_bytes().into(),
        ];
        for (kind, mark) in marks.iter().enumerate() {
            let map = found("a.sdf", &sdf_of(version, kind as u8, mark))
                .unwrap_or_else(|e| panic!("{version} {kind}: {e}"));
            same(&map, want, 1e9);
            assert_eq!(map.spacing, Spacing::Metres([1e-6, 2e-6]));
        }
        let word = if is_bcr { "32767" } else { "BAD" };
        for kind in ["5", "INTEGER ; of two bytes"] {
            let ascii = SDF
                .replace("ISO-1.0", version)
                .replace("BAD", word)
                .replace("DataType = 7", &format!("DataType\t= {kind}"))
                .replace("Zscale = 1e-9", "; heights\nZscale = 1e-9 ; m");
            let map = found("a.sdf", ascii.as_bytes()).unwrap_or_else(|e| panic!("{version} {kind}: {e}"));
            same(&map, want, 1e9);
        }
    }
}

#[test]
fn surfaces_of_every_type_of_sur_are_read_and_wrong_sizes_refused() {
    let plain = sur(16, &[10, 11, 12, 13, 8, 15]);
    let with = |changes: &[(usize, &[u8])], more: usize| {
        let mut file = plain.clone();
        changes.iter().for_each(|(at, bytes)| file[*at..at + bytes.len()].copy_from_slice(bytes));
        file.extend(vec![7; more]);
        file
    };
    let (total, layers) = (6i32.to_le_bytes(), 3i16.to_le_bytes());
    for (kind, objects, more) in [
        (1u8, None, 0),
        (2, None, 0),
        (8, Some(layers), 99),
        (11, Some(layers), 99),
        (13, Some(layers), 99),
        (16, Some(layers), 99),
    ] {
        let mut changes: Vec<(usize, &[u8])> = vec![(116, &total)];
        let kind_bytes = [kind, 0];
        changes.push((18, &kind_bytes));
        if let Some(objects) = &objects {
            changes.push((14, objects));
        }
        let map = found("a.sur", &with(&changes, more)).unwrap_or_else(|e| panic!("{kind}: {e}"));
        same(&map, [20.0, 22.0, 24.0, 26.0, NAN, 30.0], 1.0);
        assert_eq!(map.notes.is_empty(), kind == 2);
    }
    for (file, word) in [
        (with(&[(18, &[12, 0])], 0), "object type"),
        (with(&[(18, &[5, 0])], 0), "object type"),
        (with(&[(116, &7i32.to_le_bytes())], 0), "number of points"),
        (with(&[], 5), "longer"),
        (with(&[(108, &9i32.to_le_bytes())], 0), "promises"),
    ] {
        let refused = found("a.sur", &file).unwrap_err();
        assert!(refused.contains(word), "{refused}");
    }
}

/// zlib ends every stream with a sum.
#[test]
fn a_flipped_bit_of_a_packed_sur_is_found() {
    let whole = packed_sur();
    let start = 516 + 4 + 16;
    let right = found("a.sur", &whole).unwrap();
    let folder = Folder::new();
    for bit in 8 * start..8 * whole.len() {
        let mut file = whole.clone();
        file[bit / 8] ^= 1 << (bit % 8);
        // bits that only say how the stream was packed may change without a word
        if let Ok(map) = read_plain(&folder.file("a.sur", &file)) {
            assert_eq!(format!("{:?}", map.heights), format!("{:?}", right.heights), "bit {bit}");
        }
    }
}

#[test]
fn a_file_cut_anywhere_is_refused_or_whole() {
    let folder = Folder::new();
    for (name, whole) in [
        ("a.x3p", packed(&members(), DEFLATED)),
        ("a.sur", sur(32, &[10, 11, 12, 13, 8, 15])),
        ("b.sur", packed_sur()),
        ("a.sdf", sdf_binary()),
        ("a.al3d", al3d()),
    ] {
        let right = found(name, &whole).unwrap();
        for end in (0..whole.len()).step_by(7) {
            if let Ok(map) = read_plain(&folder.file(name, &whole[..end])) {
                assert_eq!(format!("{:?}", map.heights), format!("{:?}", right.heights), "{name} {end}");
            }
        }
    }
}
