//! Surfaces and loads at the edge of sense, and files that are no surfaces: each row has an answer or a clear
//! refusal. Expected by the definitions of rough contact in `docs/src/verified/rough.md`: a flat surface
//! carries nothing, a plane of one slope carries p = 0.13 E* tan β on what lies above d, load 0 touches the
//! highest point, scaling all lengths changes no ratio.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity_roughness::scene::Scene;
use asperity_roughness::{Closure, ClosureLaw, press};
use std::path::Path;

/// The outcome of a row of the table.
enum Expected {
    /// Contact area over nominal area, relative error below 1e-6 (absolute for 0).
    Area(f64),
    /// Refused with a message that holds this.
    Refused(&'static str),
}
use Expected::{Area, Refused};

/// Presses the surface in `content` and gives the area ratio, or what was wrong.
fn pressed(name: &str, content: &[u8], surface: &str, load: &str, closure: Closure) -> Result<f64, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), content).unwrap();
    let scene: Scene = toml::from_str(&format!(
        "closure = \"{}\"\n[surface]\nfile = \"{name}\"\n{surface}\n[material]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n\
         hardness = \"1280 MPa\"\n[load]\n{load}\n",
        closure.name()
    ))
    .map_err(|e| e.to_string())?;
    scene.validate().map_err(|e| e.to_string())?;
    let prepared =
        scene.surface.prepare(|path: &Path| folder.path().join(path)).map_err(|e| e.to_string())?;
    let model = ClosureLaw::new(closure, &scene.material, None).map_err(|e| e.to_string())?;
    let load = scene.load.load().map_err(|e| e.to_string())?;
    let contact = press(&prepared, &model, load).map_err(|e| e.to_string())?;
    if let Some(error) = contact.load_error {
        assert!(error <= 1e-6, "{name} {surface}: load error {error}");
    }
    Ok(contact.area_ratio)
}

const PIXEL: &str = "pixel_size = [\"1 um\", \"2 um\"]\nheight_unit = \"um\"\nlevel = \"none\"";
/// tan β = 0.5 along x.
const SLOPE: &str = "0,0.5,1\n0,0.5,1\n0,0.5,1\n";

/// A pyramid of 9 x 9 nodes with steps of `step`.
fn pyramid(step: f64) -> String {
    let line = |y: i32| -> String {
        let heights: Vec<String> = (0..9)
            .map(|x: i32| format!("{:e}", step * f64::from(4 - (x - 4).abs().max((y - 4).abs()))))
            .collect();
        heights.join(",")
    };
    (0..9).map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn every_row_of_the_table_is_as_it_should_be() {
    let full = 0.13 * 210e3 / 0.91 * 0.5; // MPa, the largest load of SLOPE
    let half = format!("pressure = \"{} MPa\"", 0.5 * full);
    let beyond = format!("pressure = \"{} MPa\"", 1.0001 * full);
    let spike = "0,0,0,0\n0,0,9,0\n0,0,0,0\n0,0,0,0\n";
    let rows: [(&str, &str, &str, &str, Expected); 21] = [
        ("flat", "3,3\n3,3\n", PIXEL, "pressure = \"1 MPa\"", Refused("flat")),
        ("flat, no load", "3,3\n3,3\n", PIXEL, "pressure = \"0 MPa\"", Area(0.0)),
        ("one node", "3\n", PIXEL, "pressure = \"1 MPa\"", Refused("no cell")),
        ("one row", "3,4,5\n", PIXEL, "pressure = \"1 MPa\"", Refused("profile")),
        ("all missing", "nan,nan\nnan,nan\n", PIXEL, "pressure = \"1 MPa\"", Refused("4 missing")),
        ("no number", "# nothing\n", PIXEL, "pressure = \"1 MPa\"", Refused("no rows of numbers")),
        ("one slope, half load", SLOPE, PIXEL, &half, Area(0.5)),
        ("one slope, load beyond", SLOPE, PIXEL, &beyond, Refused("largest load")),
        ("one slope, below it", SLOPE, PIXEL, "separation = \"-9 um\"", Area(1.0)),
        ("one slope, levelled", SLOPE, &PIXEL.replace("none", "plane"), &half, Refused("largest load")),
        ("a spike, load 0", spike, PIXEL, "pressure = \"0 MPa\"", Area(0.0)),
        ("a spike, above it", spike, PIXEL, "separation = \"1 m\"", Area(0.0)),
        ("negative load", SLOPE, PIXEL, "pressure = \"-1 MPa\"", Refused("0 or above")),
        ("no unit", SLOPE, "pixel_size = [\"1 um\", \"1 um\"]", &half, Refused("height_unit")),
        ("no pixel", SLOPE, "height_unit = \"um\"", &half, Refused("pixel_size")),
        (
            "pixel of 0",
            SLOPE,
            "pixel_size = [\"0 um\", \"1 um\"]\nheight_unit = \"um\"",
            &half,
            Refused("above 0"),
        ),
        (
            "a load and a separation",
            SLOPE,
            PIXEL,
            "pressure = \"1 MPa\"\nseparation = \"1 um\"",
            Refused("not both"),
        ),
        (
            "filters that cross",
            SLOPE,
            &format!("{PIXEL}\ns_filter = \"9 um\"\nl_filter = \"2 um\""),
            &half,
            Refused("below l_filter"),
        ),
        ("decimal commas or thousands", "1,500;2\n3;4\n", PIXEL, &half, Refused("comma")),
        ("lines of two lengths", "1,2\n3\n", PIXEL, &half, Refused("line 2")),
        ("infinite heights", "inf,1\n1,1\n", PIXEL, &half, Refused("no cell")),
    ];
    for (name, content, surface, load, expected) in &rows {
        let found = pressed("surface.csv", content.as_bytes(), surface, load, Closure::Published);
        match (expected, &found) {
            (Area(want), Ok(area)) => {
                assert!((area - want).abs() <= 1e-6 * want, "{name}: {area} not {want}")
            }
            (Refused(words), Err(message)) => assert!(message.contains(words), "{name}: {message}"),
            (_, found) => panic!("{name}: {found:?}"),
        }
    }
}

#[test]
fn no_ratio_knows_the_scale() {
    let load = "pressure = \"200 MPa\"";
    for closure in [Closure::Published, Closure::Johnson, Closure::Sneddon] {
        let area = |metres: f64| {
            let surface = format!(
                "pixel_size = [\"{metres} m\", \"{metres} m\"]\nheight_unit = \"m\"\nlevel = \"none\"\noverride = true"
            );
            pressed("a.csv", pyramid(0.1 * metres).as_bytes(), &surface, load, closure).unwrap()
        };
        let reference = area(1.0);
        for metres in [1e-12, 1e-9, 1e-6, 1e3] {
            assert!((area(metres) / reference - 1.0).abs() < 2e-6, "{metres} {closure:?}");
        }
    }
}

#[test]
fn what_is_no_surface_is_refused_by_its_content() {
    let rows: [(&str, &[u8], &str); 12] = [
        ("a.npy", b"\x93NUMPY\x01\x00\x05\x00{}", "npy"),
        ("a.npy", b"\x93NUM", "does not begin like one"),
        ("a.sur", b"DIGITAL SURF\0\0\x01\0\0\0\x02\0", "sur header"),
        ("a.al3d", b"AliconaImaging\0\r\n", "al3d header"),
        ("a.sdf", b"bISO-1.0 too short", "sdf header"),
        ("a.sdf", b"aISO-1.0\nNumPoints = 9\n", "sdf header"),
        ("a.x3p", b"PK\x03\x04 no zip", "x3p file is damaged"),
        ("a.csv", b"\x89PNG\r\n\x1a\n", "PNG picture"),
        ("a.sur", b"\xff\xd8\xff\xe0", "JPEG picture"),
        ("a.xyz", b"II*\0\x08\0\0\0", "TIFF file"),
        ("a.docx", b"hello", "not known"),
        ("a.sur", b"", "empty"),
    ];
    for (name, content, words) in rows {
        let message = pressed(name, content, PIXEL, "pressure = \"1 MPa\"", Closure::Published).unwrap_err();
        assert!(message.contains(words), "{name}: {message}");
    }
}
