//! Tables in the dialects of their sources, each with the number that it must give; the test writes the table
//! of the book with ASPERITY_RENEW=1, and fails where the committed one is not what it would write.

// a test fails by panicking; a table of dialects is long
#![allow(clippy::unwrap_used)]

use asperity_formats::indentation;
use asperity_formats::surface::{Measured, Request, Spacing, read};
use asperity_formats::text::decode;
use std::fmt::Write;
use std::path::Path;

/// First line of the table.
const WRITTEN_BY: &str = "<!-- written by `ASPERITY_RENEW=1 cargo test --release -p asperity-formats --test dialects_are_read_as_their_sources_write_them` -->\n\n";

/// A dialect: what is special, where it comes from, and the bytes of a file.
struct Dialect {
    feature: &'static str,
    source: &'static str,
    name: &'static str,
    bytes: Vec<u8>,
    /// Keys that name the columns of depth and force.
    columns: [Option<&'static str>; 2],
}

fn dialect(feature: &'static str, source: &'static str, name: &'static str, text: &str) -> Dialect {
    Dialect { feature, source, name, bytes: text.into(), columns: [None; 2] }
}

fn windows_1252(text: &str) -> Vec<u8> {
    text.chars().map(|c| c as u8).collect()
}

/// Each holds the readings (0.1 µm, 2 mN) and (0.2 µm, 8 mN).
#[expect(clippy::too_many_lines, reason = "a list of dialects")]
fn curves() -> Vec<Dialect> {
    let hysitron = "Mon May 04 11:50:04 2015\r\n\r\nNumber of Points = 2\r\nDepth (nm)\tLoad (µN)\tTime (s)\tDepth (V)\tLoad (V)\r\n100\t2000\t0\t1\t1\r\n200\t8000\t1\t1\t1\r\n";
    let mut all = vec![
        Dialect {
            feature: "Windows-1252, preamble, further columns in volts",
            source: "Hysitron TriboScan, as in micromechanics RobinSteel0000LC.txt",
            name: "curve.txt",
            bytes: windows_1252(hysitron),
            columns: [None; 2],
        },
        Dialect {
            feature: "UTF-16 without a mark",
            source: "Unicode text of Excel and of LabVIEW",
            name: "curve.txt",
            bytes: hysitron.encode_utf16().flat_map(u16::to_le_bytes).collect(),
            columns: [None; 2],
        },
        Dialect {
            feature: "Windows-1252, decimal commas, semicolons",
            source: "Fischerscope, as in micromechanics FS1.txt",
            name: "curve.csv",
            bytes: windows_1252("Eindringtiefe;Prüfkraft\r\nµm;mN\r\n0,1;2,0\r\n0,2;8,0\r\n"),
            columns: [None; 2],
        },
        Dialect {
            feature: "Shift-JIS, names in Japanese",
            source: "Windows of Japan, written by Python's codec",
            name: "curve.csv",
            // 変位(μm),試験力(mN)
            bytes: b"\x95\xcf\x88\xca(\x83\xcam),\x8e\x8e\x8c\xb1\x97\xcd(mN)\r\n0.1,2\r\n0.2,8\r\n".into(),
            columns: [None; 2],
        },
    ];
    for (feature, source, text) in [
        (
            "Pd and Fn in brackets",
            "Anton Paar/CSM, as in Indentation-Yield-Analyzer",
            "Time [s]\tPd [nm]\tFn [mN]\n0\t100\t2\n1\t200\t8\n",
        ),
        (
            "name of a sample before the quantity",
            "Anton Paar/CSM, as in Indentation-Yield-Analyzer",
            "X_Glass 1_Pd_[µm]\tY_Glass 1_Fn_[mN]\t\n0.1\t2\t\n0.2\t8\t\n",
        ),
        (
            "quotes, units in a line of their own",
            "Instron Bluehill, raw data",
            "\"Time\",\"Extension\",\"Load\"\n\"(s)\",\"(mm)\",\"(N)\"\n\"0.0\",\"0.0001\",\"0.002\"\n\"0.1\",\"0.0002\",\"0.008\"\n",
        ),
        (
            "German names, \"in mm\"",
            "ZwickRoell testXpert",
            "Standardweg in mm;Standardkraft in N\n0,0001;0,002\n0,0002;0,008\n",
        ),
        (
            "French names, decimal commas",
            "a French spreadsheet",
            "Profondeur (nm);Force normale (mN)\n100,0;2\n200,0;8\n",
        ),
        (
            "prefix as a word",
            "sandialabs nanoindentation-consistency-checker",
            "depth_nm,load_micro_N,time_s\n100,2000,0\n200,8000,1\n",
        ),
        (
            "kilogram-force",
            "hardness testers",
            "Depth (µm),Load (kgf)\n0.1,0.000203943242595586\n0.2,0.000815772970382343\n",
        ),
        (
            "header behind #, exponents of Fortran",
            "numpy.savetxt, Fortran programs",
            "# depth_nm force_mN\n1.0e+02 2.0D+00\n2.0e+02 8.0\n",
        ),
        (
            "thousands with commas beside decimals",
            "LabVIEW in English",
            "depth_nm\tforce_uN\n100.0\t2,000.0\n200.0\t8,000.0\n",
        ),
        (
            "a summary with names and numbers of its own below",
            "reports of indentation programs",
            "Depth (nm),Load (mN)\n100,2\n200,8\n\nResults\nHmax,Fmax\n2000.0,125.0\n",
        ),
        (
            "raw columns beside those of the sample",
            "KLA/MTS NanoIndenter",
            "Raw Displacement (nm)\tRaw Load (mN)\tDisplacement Into Surface (nm)\tLoad On Sample (mN)\n900\t9\t100\t2\n950\t15\t200\t8\n",
        ),
        (
            "tabs behind the commas between columns",
            "C and MATLAB programs that line columns up",
            "Depth (nm),\tLoad (mN)\n100.0,\t2\n200.0,\t8\n",
        ),
        (
            "notes in the first column, beside some readings",
            "sheets of MTS NanoSuite, whose first column has marks",
            "Note,Depth (nm),Load (mN)\n,100,2\npop-in,200,8\n",
        ),
        (
            "names and units in Korean, units in a line of their own",
            "Shimadzu TRAPEZIUM",
            "\"1 _ 1\",,\n\"Time\",\"Force\",\"스트로크\"\n\"sec\",\"N\",\"mm\"\n0.0,0.002,0.0001\n0.5,0.008,0.0002\n",
        ),
        (
            "name and unit in cells of their own",
            "spreadsheets and loggers",
            "Time,s,Depth,nm,Load,mN\n0,100,2\n1,200,8\n",
        ),
        (
            "units in the words before the table",
            "loggers",
            "Depth unit: nm\nLoad [unit]: mN\nDepth\tLoad\n100\t2\n200\t8\n",
        ),
        ("footer and empty rows", "spreadsheets", "depth_um;force_mN\n0,1;2\n;\n0,2;8\nMittelwert;\n"),
    ] {
        all.push(dialect(feature, source, "curve.txt", text));
    }
    for (feature, source, columns, text) in [
        (
            "compression counted negative, turned by `columns = { depth = \"-…\", force = \"-…\" }`",
            "testing machines",
            ["-Displacement (um)", "-Force (mN)"],
            "Time (s),Displacement (um),Force (mN)\n0,-0.1,-2\n1,-0.2,-8\n",
        ),
        (
            "no header, columns by number and unit",
            "Micro Materials NanoTest, as micromechanics reads it",
            ["2 [nm]", "3 [mN]"],
            "0.0\t100\t2\n1.0\t200\t8\n",
        ),
        (
            "remarks behind #, a tip that moves down, columns by number and unit",
            "JPK, force curve as text",
            ["-1 [m]", "2 [N]"],
            "# segment: extend\n# columns: verticalTipPosition vDeflection height\n# units: m N m\n#\n-1e-7 2e-3 5e-6\n\n# segment: retract\n# columns: verticalTipPosition vDeflection height\n# units: m N m\n#\n-2e-7 8e-3 5e-6\n",
        ),
    ] {
        all.push(Dialect { columns: columns.map(Some), ..dialect(feature, source, "curve.txt", text) });
    }
    all.extend([
        dialect(
            "numbers with units in the words before the table, two more depths",
            "Optics11 Piuma, Chiaro and Pavone",
            "curve.txt",
            "X-position (um)\t0.0\nk (N/m)\t0.52\nD[Z1] (nm)\t10000\tt[1] (s)\t2\nP[max] (uN)\t8000\nD[max] (nm)\t200\nE[v=0.500] (Pa)\t750\n\nTime (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)\tAuxiliary\n0\t2000\t100\t50\t150\t0.01\n1\t8000\t200\t90\t290\t0.01\n",
        ),
        dialect(
            "names with a colon and their unit in the words before the table",
            "loggers and LabVIEW",
            "curve.txt",
            "Sample: 7\nDepth: nm\nLoad: mN\nTime: s\n\nTime\tDepth\tLoad\n0\t100\t2\n1\t200\t8\n",
        ),
        dialect(
            "units of all columns in one line before their names",
            "loggers and LabVIEW",
            "curve.csv",
            "Units: s, nm, mN\nTime,Depth,Load\n0,100,2\n1,200,8\n",
        ),
        dialect(
            "a unit behind each number",
            "loggers that format their cells",
            "curve.txt",
            "Depth\tLoad\n100.0 nm\t2 mN\n0.2 um\t8 mN\n",
        ),
        dialect(
            "several tabs between numbers, one between names",
            "C programs that line columns up",
            "curve.txt",
            "Depth (nm)\tLoad (mN)\tTime (s)\n100\t\t2\t\t0\n200\t\t8\t\t1\n",
        ),
        dialect(
            "bars between columns and at both ends, a line of dashes",
            "tables of Markdown, Org and PostgreSQL",
            "curve.md",
            "| Depth (nm) | Load (mN) |\n|---|---|\n| 100 | 2 |\n| 200 | 8 |\n",
        ),
        dialect(
            "tables of approach and drift before that of the test",
            "Hysitron TriboScan .hld, as micromechanics reads it",
            "curve.hld",
            "File Version: Hysitron 9.0\r\nMachine Comp: 0.9 nm/uN\r\nTip C0: 24.5 nm^2/nm^2\r\nSample Approach Data Points: 2 \r\nTime_s\tMotorDisp_mm\tPiezo Extension_nm\r\n0\t1.5\t20\r\n1\t1.6\t30\r\nDrift Data Points: 2 \r\nTime_s\tDisp_nm\r\n0\t0.1\r\n1\t0.2\r\nTest Data Points: 2 \r\nTime_s\tDisp_nm\tForce_uN\tLoadCell_nm\tPiezoDisp_nm\tDisp_V\tForce_V\tPiezo_LowV\r\n0\t100\t2000\t0\t0\t1\t1\t1\r\n1\t200\t8000\t0\t0\t1\t1\t1\r\n",
        ),
        Dialect {
            feature: "a workbook with the test on its second sheet, units in a row of their own",
            source: "KLA/MTS NanoIndenter .xlsx, written by openpyxl 3.1.5",
            name: "curve.xlsx",
            bytes: include_bytes!("files/openpyxl-curve.xlsx").into(),
            columns: [None; 2],
        },
        Dialect {
            feature: "the same of Excel 97",
            source: "MTS NanoIndenter XP .xls, written by xlwt 1.3.0",
            name: "curve.xls",
            bytes: include_bytes!("files/xlwt-curve.xls").into(),
            columns: [None; 2],
        },
        Dialect {
            feature: "a sheet of LibreOffice, units in a row of their own, cells that repeat",
            source: "LibreOffice, written by odfpy 1.4.1",
            name: "curve.ods",
            bytes: include_bytes!("files/odfpy-curve.ods").into(),
            columns: [None; 2],
        },
    ]);
    all
}

/// Each holds the same heights as [`maps`], point by point.
fn points() -> Vec<Dialect> {
    vec![
        dialect(
            "units of all columns in the words above",
            "scripts, numpy.savetxt with a header",
            "points.txt",
            "# Units: mm, mm, um\n# X Y Z\n0 0 0.001\n0.001 0 0.002\n0.002 0 0.003\n0 0.001 0.004\n0.001 0.001 nan\n0.002 0.001 0.006\n",
        ),
        dialect(
            "units in the names, decimal commas",
            "GOM, PolyWorks and German spreadsheets",
            "points.txt",
            "X [mm];Y [mm];Z [µm]\n0;0;0,001\n0,001;0;0,002\n0,002;0;0,003\n0;0,001;0,004\n0,001;0,001;\n0,002;0,001;0,006\n",
        ),
        dialect(
            "No Data in the place of a height",
            "Zygo Mx and MetroPro, .xyz",
            "points.xyz",
            "x_um y_um z_nm\n0 0 1\n1 0 2\n2 0 3\n0 1 4\n1 1 No Data\n2 1 6\n",
        ),
        dialect(
            "a column that says which points are valid",
            "optical profilometers, scripts",
            "points.csv",
            "x_um,y_um,z_nm,Valid\n0,0,1,1\n1,0,2,1\n2,0,3,1\n0,1,4,1\n1,1,-4000,0\n2,1,6,1\n",
        ),
        dialect(
            "x and y number the pixels of a camera, whose size stands in the header",
            "Zygo MetroPro and Mx, .xyz",
            "points.xyz",
            "Zygo XYZ Data File - Format 1\n1 8 1 5 \"Mon Feb 03 10:00:00 2020\"\n0 0 3 2 1 255\n10 20 3 2\n\"\"\n\"\"\n\"\"\n0 0.5 6.328e-007 0 1 0 1e-006 1580720400\n3 2 0 0 0 0 0\n1 1 0 20 2 0 0 0 0 0\n0 0 0\n\"\"\n#\n10 20 0.001\n11 20 0.002\n12 20 0.003\n10 21 0.004\n11 21 No Data\n12 21 0.006\n#\n",
        ),
        dialect(
            "a missing point left out, in any order",
            "Sensofar .dat, Alicona point clouds",
            "points.csv",
            "x_um,y_um,z_nm\n2,1,6\n0,1,4\n2,0,3\n1,0,2\n0,0,1\n",
        ),
    ]
}

/// Each holds the heights 1, 2, 3; 4, missing, 6.
#[expect(clippy::too_many_lines, reason = "a list of dialects")]
fn maps() -> Vec<Dialect> {
    let body = "1\t2\t3\n4\tnan\t6\n";
    let head = |words: &str| format!("{words}{body}");
    let gwyddion = "Gwyddion, text export with its header";
    vec![
        dialect(
            "comments: width, height, unit",
            gwyddion,
            "map.txt",
            &head("# Channel: Topography\n# Width: 3.00 µm\n# Height: 1.000 µm\n# Value units: nm\n"),
        ),
        dialect(
            "the same in German, decimal commas",
            gwyddion,
            "map.txt",
            "# Kanal: Topographie\n# Breite: 3,00 µm\n# Höhe: 1,000 µm\n# Value units: nm\n1,0e+00\t2,0\t3,0\n4,0\tnan\t6,0\n",
        ),
        dialect(
            "the same in any language, by its place",
            gwyddion,
            "map.txt",
            &head("# a: b\n# ширинка: 3.00 µm\n# высотка: 1.000 µm\n# единица: nm\n"),
        ),
        dialect(
            "key = value",
            "SurfaceTopography, asc files",
            "map.asc",
            &head("x-length = 3\ny-length = 1\nx-unit = µm\nz-unit = nm\n"),
        ),
        dialect(
            "sizes in nm without a unit",
            "SPIP, ASCII export",
            "map.asc",
            &head(
                "# File Format = ASCII\n# Created by SPIP 6.7.7\n# x-pixels = 3\n# y-pixels = 2\n# x-length = 3000\n# y-length = 2000\n# z-unit = nm\n# voidpixels =1\n# Start of Data:\n",
            ),
        ),
        dialect(
            "Scale X, Unit X, Unit Data",
            "NT-MDT Nova, ASCII export",
            "map.txt",
            &head("NX = 3\nNY = 2\nScale X = 1\nScale Y = 1\nUnit X = um\nUnit Data = nm\nStart of Data :\n"),
        ),
        dialect(
            "quotes, pixel in nm/pixel",
            "Keyence VK analyzer, CSV",
            "map.csv",
            "\"XY calibration\",\"1000\",\"nm/pixel\"\n\"Unit\",\"nm\"\n\"1\",\"2\",\"3\"\n\"4\",\"\",\"6\"\n",
        ),
        dialect(
            "a line for each x, Bad, pixel and unit in a header of its own",
            "Wyko and Veeco Vision, .asc",
            "map.asc",
            "Wyko ASCII Data File Format 0\t1\t1\nX Size\t3\nY Size\t2\nBlock Name\tType\tLength\tValue\nWavelength\t7\t4\t600\nPixel_size\t7\t4\t0.001\nRAW_DATA\t3\t24\t\n4\t1\nBad\t2\n6\t3\n",
        ),
        dialect(
            "names above the values of the header",
            "Filmetrics ProfilmOnline, text export",
            "map.txt",
            &head("pixelSize (um)\n1\nZ-data (nm)\n"),
        ),
        dialect(
            "a number for missing points in the header",
            "grids of ESRI and of programs",
            "map.asc",
            "ncols 3\nnrows 2\npixel size = 1 um\nz unit = nm\nNODATA_value -9999\n1 2 3\n4 -9999 6\n",
        ),
        dialect(
            "rows in several lines",
            "ESRI, ASCII grid",
            "map.asc",
            "ncols 3\nnrows 2\npixel size = 1 um\nz unit = nm\nnull -1\n1\n2\n3\n4\n-1\n6\n",
        ),
        dialect(
            "two sizes that commas part",
            "spreadsheets and programs, CSV",
            "map.csv",
            "Pixel size,1,1,um\nHeight unit,nm\n1,2,3\n4,,6\n",
        ),
        dialect(
            "an empty cell before each row",
            "Igor, text waves",
            "map.txt",
            "pixel size = 1 um\nz unit = nm\n\t1\t2\t3\n\t4\tnan\t6\n",
        ),
        dialect(
            "bars between heights",
            "tables of Markdown and Org",
            "map.txt",
            "pixel size = 1 um\nz unit = nm\n| 1 | 2 | 3 |\n| 4 | nan | 6 |\n",
        ),
        dialect(
            "two tabs between heights",
            "C programs that line columns up",
            "map.txt",
            "pixel size = 1 um\nz unit = nm\n1\t\t2\t\t3\n4\t\tnan\t\t6\n",
        ),
        dialect(
            "heights in waves",
            "interferometers",
            "map.txt",
            &head("Wavelength = 1 nm\nPixel size = 1 um\nValue unit = waves\n"),
        ),
        dialect(
            "words for missing points",
            "Wyko (Bad), Zygo (No Data), spreadsheets (N/A)",
            "map.txt",
            "pixel size = 1 um\nz unit = nm\n1 2 3\n4 No Data 6\n",
        ),
        dialect(
            "a number for missing points, 1e37 and beyond",
            "SPIP, old instruments",
            "map.txt",
            "pixel size = 1 um\nz unit = nm\n1;2;3\n4;3,4e38;6\n",
        ),
    ]
}

fn curve_is_right(one: &Dialect) -> bool {
    let (text, _) = decode(&one.bytes).unwrap();
    let table =
        indentation::read(&text, one.columns, None).unwrap_or_else(|e| panic!("{}: {e}", one.feature));
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
    let rows = &table.series[0].rows;
    let want = [[1e-7, 2e-3], [2e-7, 8e-3]];
    rows.len() == 2 && rows.iter().zip(want).all(|(row, want)| near(row[0], want[0]) && near(row[1], want[1]))
}

fn map_is_right(one: &Dialect) -> bool {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(one.name);
    std::fs::write(&path, &one.bytes).unwrap();
    let Measured { heights, spacing, height_unit, .. } =
        read(&path, &Request::default()).unwrap_or_else(|e| panic!("{}: {e}", one.feature));
    let want = [1.0, 2.0, 3.0, 4.0, f64::NAN, 6.0];
    let unit = height_unit.unwrap() / 1e-9;
    let same = |(a, b): (&f64, f64)| (a * unit - b).abs() < 1e-9 || a.is_nan() && b.is_nan();
    let Spacing::Metres([x, _]) = spacing else { return false };
    heights.len() == 6 && heights.iter().zip(want).all(same) && (x / 1e-6 - 1.0).abs() < 1e-9
}

#[test]
fn every_dialect_gives_its_numbers() {
    let mut page = String::from(WRITTEN_BY);
    page.push_str("| table | what is special | where it comes from |\n|-|-|-|\n");
    let mut row = |kind: &str, one: &Dialect| {
        let _ = writeln!(page, "| {kind} | {} | {} |", one.feature, one.source);
    };
    for one in curves() {
        assert!(curve_is_right(&one), "{}", one.feature);
        row("curve", &one);
    }
    for (kind, all) in [("map", maps()), ("points", points())] {
        for one in all {
            assert!(map_is_right(&one), "{}", one.feature);
            row(kind, &one);
        }
    }
    let results = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification/results");
    if !results.is_dir() {
        return; // the crate by itself
    }
    let committed = results.join("files.md");
    if std::env::var_os("ASPERITY_RENEW").is_some() {
        std::fs::write(&committed, &page).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&committed).unwrap_or_default(), page, "run it with ASPERITY_RENEW=1");
}
