//! VTK's own reader opens the field files: cell types, names with units, numbers that agree with the curve.
//!
//! Needs a Python with the vtk package, `$ASPERITY_PYTHON` or `python3`; says so and passes where there is
//! none.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use serde_json::Value;
use std::process::Command;

/// Prints what VTK sees in the files given, one JSON object a line.
const READER: &str = r#"
import json, sys
import vtk
from vtk.util.numpy_support import vtk_to_numpy
for path in sys.argv[1:]:
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    areas = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Area"))
    arrays = {}
    for data in (grid.GetPointData(), grid.GetCellData()):
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            values = vtk_to_numpy(array)
            arrays[array.GetName()] = [array.GetNumberOfComponents(), float(values.min()), float(values.max())]
    print(json.dumps({
        "types": sorted({grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}),
        "cells": grid.GetNumberOfCells(), "points": grid.GetNumberOfPoints(),
        "bounds": grid.GetBounds(), "area": float(areas.sum()), "smallest": float(areas.min()),
        "arrays": arrays,
    }))
"#;

fn python_with_vtk() -> Option<String> {
    let python = std::env::var("ASPERITY_PYTHON").unwrap_or_else(|_| "python3".into());
    let works = Command::new(&python).args(["-c", "import vtk"]).output().is_ok_and(|o| o.status.success());
    works.then_some(python)
}

#[test]
fn cells_names_units_and_values_survive() {
    let Some(python) = python_with_vtk() else {
        eprintln!("skipped: no Python with vtk (pip install vtk, or name one in ASPERITY_PYTHON)");
        return;
    };
    for (element, cell_type) in [("q8r", 23), ("q4", 9)] {
        let place = Place::with_scene(SCENE.replace("every = 0", "every = 4"));
        let set = format!("numerics.element={element}");
        let end = place.run(&["crush", "scene.toml", "--out", "out", "--set", &set, "--json"]);
        assert_eq!(end.status, 0, "{}", end.err);
        let summary: Value = serde_json::from_str(&end.out).unwrap();
        let files: Vec<_> = place.names("out").into_iter().filter(|n| n.ends_with(".vtu")).collect();
        let output = Command::new(&python)
            .arg("-c")
            .arg(READER)
            .args(&files)
            .current_dir(place.path("out"))
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let seen: Vec<Value> = String::from_utf8(output.stdout)
            .unwrap()
            .lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect();
        assert_eq!(seen.len(), files.len());
        // of the frame in which the metal is pushed down furthest, the peak
        let (mut lowest, mut largest_pressure) = (0.0_f64, 0.0);
        for (grid, file) in seen.iter().zip(&files) {
            assert_eq!(grid["types"], serde_json::json!([cell_type]), "{element}");
            assert_eq!(grid["cells"], summary["elements"]);
            let number =
                |path: &str| grid.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path}"));
            // the section in µm: its summit at height 0, its area that of a half plane with a bump
            let (width, depth) = (number("/bounds/1"), -number("/bounds/2"));
            assert!(number("/bounds/3").abs() < 1e-9 && number("/smallest") > 0.0);
            let block = width * (depth - 20.0) + 0.5 * 114.3 * 20.0;
            assert!((number("/area") / block - 1.0).abs() < 1e-3, "{} {block}", number("/area"));
            for (name, components) in [
                ("displacement_um", 3),
                ("stress_rr_MPa", 1),
                ("stress_zz_MPa", 1),
                ("stress_tt_MPa", 1),
                ("stress_rz_MPa", 1),
                ("von_mises_MPa", 1),
                ("plastic_strain", 1),
                ("pressure_MPa", 1),
                ("plastic_zone", 1),
                ("contact_pressure_MPa", 1),
            ] {
                assert_eq!(grid["arrays"][name][0], components, "{name}");
                assert!(number(&format!("/arrays/{name}/1")).is_finite(), "{name}");
            }
            let zone = (number("/arrays/plastic_zone/1"), number("/arrays/plastic_zone/2"));
            // nothing has yielded before the crush
            let least = if file == "fields_0000.vtu" { 0.0 } else { 1.0 };
            assert!(zone.0 >= 0.0 && (least..=2.0).contains(&zone.1));
            if number("/arrays/displacement_um/1") < lowest {
                lowest = number("/arrays/displacement_um/1");
                largest_pressure = number("/arrays/contact_pressure_MPa/2");
            }
            // a tool 5 um down pushes no metal further than that
            assert!(number("/arrays/displacement_um/1") > -5.2);
        }
        // pressure in MPa: of the order of the mean pressure, force over area
        let mean =
            1e6 * summary["peak_force_N"].as_f64().unwrap() / summary["contact_area_um2"].as_f64().unwrap();
        // under a rounded tip that yields the pressure falls from the middle to the edge by less than under
        // an elastic cone, whose pressure is twice its mean at a fifth of the radius
        assert!(largest_pressure > 1.05 * mean && largest_pressure < 2.0 * mean, "{largest_pressure} {mean}");
    }
}
