//! Tables with more in them than readings: several numbers to a test, notes, a last line of maxima, blocks
//! with names of their own, units in words, names in other letters. Sources: tidy tables of pandas and R;
//! National Instruments' specification of .lvm files (a header to each segment); sheets of MTS NanoSuite,
//! whose first column holds marks; Shimadzu TRAPEZIUM.

// a test fails by panicking
#![allow(clippy::expect_used)]

use asperity_formats::indentation;
use asperity_formats::surface::{Request, Spacing};
use std::path::Path;

/// Depth (nm) and force (mN) of a test of `n` readings up to the `largest` force and back.
fn test_of(n: usize, largest: f64) -> Vec<[f64; 2]> {
    let up = (0..=n).map(|i| i as f64 / n as f64).map(|d| [1000.0 * d, largest * d * d]);
    up.chain([[950.0, 0.6 * largest], [900.0, 0.3 * largest], [860.0, 0.0]]).collect()
}

/// Forces at the deepest point of each test, in mN.
fn largest_forces(text: &str) -> Vec<f64> {
    let table = indentation::read(text, [None; 2], None).unwrap_or_else(|e| panic!("{text}\n{e}"));
    let most = |rows: &[[f64; 2]]| rows.iter().map(|row| (1e6 * row[1]).round() / 1e3).fold(0.0, f64::max);
    table.series.iter().map(|test| most(&test.rows)).collect()
}

fn refusal(text: &str) -> String {
    indentation::read(text, [None; 2], None).expect_err(text).to_string()
}

#[test]
fn a_test_has_as_many_numbers_as_columns_count_it() {
    let forces = [("A", "1", 60.0), ("A", "2", 30.0), ("B", "1", 48.0), ("B", "2", 24.0)];
    let rows = |between: &str| {
        let mut text = String::new();
        for (specimen, indent, largest) in forces {
            for [depth, force] in test_of(6, largest) {
                text += &format!("{specimen}{between}{indent},{depth},{force}\n");
            }
        }
        text
    };
    // the name of the first column is one of a specimen, or none that is known
    for head in ["specimen,indent", "Sample,Eindruck", "material,test", "temperature,Run"] {
        let text = format!("{head},depth_nm,load_mN\n{}", rows(","));
        assert_eq!(largest_forces(&text), [60.0, 30.0, 48.0, 24.0], "{head}");
    }
    // few readings, long steps
    let mut few = "metal,test,depth_nm,load_mN\n".to_string();
    for (metal, test, largest) in forces {
        for depth in [0, 100, 200, 400, 600, 800, 1000, 900] {
            let force = if depth == 900 { 0.3 } else { 1e-6 * f64::from(depth * depth) } * largest;
            few += &format!("{metal},{test},{depth},{force}\n");
        }
    }
    assert_eq!(largest_forces(&few), [60.0, 30.0, 48.0, 24.0]);
    // a mark beside the name is no unit; a merged cell stands in its first row
    for head in ["Specimen [-]", "Test (No.)", "Sample (ID)"] {
        let mut text = format!("{head},depth_nm,load_mN\n");
        for (specimen, largest) in [("1", 60.0), ("2", 48.0)] {
            for (i, [depth, force]) in test_of(8, largest).into_iter().enumerate().skip(2) {
                text += &format!("{},{depth},{force}\n", if i == 2 { specimen } else { "" });
            }
        }
        assert_eq!(largest_forces(&text), [60.0, 48.0], "{head}");
    }
    // three readings at each load of a sample
    let mut loads = "Sample,Measurement,depth_nm,load_mN\n".to_string();
    for (i, [depth, force]) in test_of(9, 60.0).into_iter().enumerate() {
        loads += &format!("S1,{},{depth},{force}\n", i / 3);
    }
    assert_eq!(largest_forces(&loads), [60.0]);
    // a column that counts the rows of each test tells nothing
    let mut counted = "specimen,measurement,depth_nm,load_mN\n".to_string();
    for (specimen, largest) in [("A", 60.0), ("B", 30.0), ("C", 20.0)] {
        for (i, [depth, force]) in test_of(6, largest).into_iter().enumerate() {
            counted += &format!("{specimen},{i},{depth},{force}\n");
        }
    }
    assert_eq!(largest_forces(&counted), [60.0, 30.0, 20.0]);
}

#[test]
fn a_note_beside_a_reading_takes_nothing_from_it() {
    let with_notes = |notes: [&str; 3]| {
        let mut text = "note,depth_nm,load_mN\n".to_string();
        let rows = test_of(6, 30.0);
        for (i, [depth, force]) in rows.iter().enumerate() {
            let note = rows.len().checked_sub(i + 1).and_then(|left| notes.get(left)).unwrap_or(&"");
            text += &format!("{note},{depth},{force}\n");
        }
        text
    };
    for notes in [["drift check", "", ""], ["END", "pop-in", "over range"], ["", "", "peak load"]] {
        let table = indentation::read(&with_notes(notes), [None; 2], None).expect("readable");
        assert_eq!(table.series[0].rows.len(), 10, "{notes:?}");
    }
    // a footer is no reading
    for footer in [
        "Std. Dev.,12,0.4",
        "Modulus,210,5\nHardness,5.1,0.2",
        "Peak,1000,30",
        ",,\nResults,,\nH (GPa),5.1,0.2",
    ] {
        let table = indentation::read(&format!("{}{footer}\n", with_notes(["", "", ""])), [None; 2], None);
        assert_eq!(table.expect(footer).series[0].rows.len(), 10, "{footer}");
    }
    // where the first column holds numbers a word ends the table
    let timed = "time_s,depth_nm,load_mN\n0,0,0\n1,500,8\n2,1000,30\nMax,1000,30\n";
    assert_eq!(indentation::read(timed, [None; 2], None).expect("readable").series[0].rows.len(), 3);
}

#[test]
fn a_last_row_that_is_no_reading_is_refused() {
    let mut text = "depth_nm,load_mN\n".to_string();
    for [depth, force] in test_of(6, 30.0) {
        text += &format!("{depth},{force}\n");
    }
    for (last, why) in [("1000,30", "a line of maxima"), ("3.2,110", "the depth falls and the force rises")] {
        let message = refusal(&format!("{text}{last}\n"));
        assert!(message.starts_with("line 12:") && message.contains(why), "{message}");
    }
    // a reload goes on, also in steps of set points to the same peak, and a tip may snap off
    let set_points = "0,0\n500,10\n700,20\n860,25\n1000,30\n950,15\n1000,30\n950,15\n1000,30\n";
    let snap = "0,0\n40,1\n80,4\n120,9\n160,16\n155,9\n145,3\n140,0\n130,-3\n125,-5\n60,0\n";
    for (sound, largest) in
        [(format!("{text}940,20\n"), 30.0), (set_points.into(), 30.0), (snap.into(), 16.0)]
    {
        let head = if sound.starts_with("depth") { "" } else { "depth_nm,load_mN\n" };
        assert_eq!(largest_forces(&format!("{head}{sound}")), [largest], "{sound}");
    }
}

#[test]
fn blocks_of_one_test_are_one_test() {
    let rows: Vec<[f64; 2]> = test_of(24, 30.0);
    for size in [7, 9, 14] {
        let mut text = String::new();
        for block in rows.chunks(size) {
            text += "X_Value,Depth (nm),Load (mN)\n";
            for [depth, force] in block {
                text += &format!("0.1,{depth},{force}\n");
            }
        }
        let table = indentation::read(&text, [None; 2], None).unwrap_or_else(|e| panic!("{size}: {e}"));
        assert_eq!(table.series.iter().map(|test| test.rows.len()).collect::<Vec<_>>(), [28], "{size}");
    }
    // two tests are two, also of set points
    let mut points = "Sample,depth_nm,load_mN\n".to_string();
    for (sample, stiff) in [("A", 1.0), ("B", 1.01)] {
        for (depth, force) in [
            (408.2, 10),
            (577.4, 20),
            (707.1, 30),
            (816.5, 40),
            (912.9, 50),
            (1000.0, 60),
            (787.2, 30),
            (619.2, 10),
        ] {
            points += &format!("{sample},{},{force}\n", stiff * depth);
        }
    }
    assert_eq!(largest_forces(&points).len(), 2);
    let one: String = test_of(6, 30.0).iter().map(|[depth, force]| format!("{depth},{force}\n")).collect();
    assert_eq!(largest_forces(&format!("depth_nm,load_mN\n{one}depth_nm,load_mN\n{one}")).len(), 2);
}

#[test]
fn the_message_names_names_and_not_units() {
    let text = "\"Time\",\"Force\",\"Ход\"\n\"sec\",\"N\",\"mm\"\n0.0,0.0,0.0\n0.5,0.3,0.1\n1.0,0.5,0.2\n";
    let message = refusal(text);
    assert!(message.contains("\"Ход\"") && !message.contains("\"mm\""), "{message}");
    let korean = text.replace("Ход", "스트로크");
    let rows = indentation::read(&korean, [None; 2], None).expect("readable").series.remove(0).rows;
    assert_eq!(rows[2], [2e-4, 0.5]);
    let message = refusal("Load setpoint (mN),Load actual (mN),depth_nm\n1,1,10\n2,2,20\n");
    assert!(message.contains("force = \"Load actual (mN)\""), "{message}");
}

/// Step along x in m of the points `text`, read without a key, and metres of one of their heights.
fn points(text: &str) -> (f64, Option<f64>) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("points.txt");
    std::fs::write(&file, text).expect("can be written");
    let map = asperity_formats::surface::read(Path::new(&file), &Request::default())
        .unwrap_or_else(|e| panic!("{text}: {e:?}"));
    let step = match map.spacing {
        Spacing::Metres([x, _]) | Spacing::HeightUnits([x, _]) => x,
        Spacing::Unknown | Spacing::Numbers(_) => f64::NAN,
    };
    (step, map.height_unit)
}

#[test]
fn units_in_words_above_points_are_theirs() {
    let mut rows = String::new();
    for j in 0..4 {
        for i in 0..5 {
            rows += &format!(
                "{:.4} {:.4} {:.4}\n",
                5e-4 * i as f64,
                5e-4 * j as f64,
                0.01 * ((i * j) % 3) as f64
            );
        }
    }
    for head in [
        "# Units: mm, mm, um\n# X Y Z\n",
        "# units: mm mm um\n# X Y Z\n",
        "X-axis: mm\nY-axis: mm\nZ-axis: um\nX Y Z\n",
        "# Units: mm, mm, um\n",
        "# X-axis: mm\n# Y-axis: mm\n# Z-axis: um\n",
    ] {
        let (step, unit) = points(&format!("{head}{rows}"));
        assert!((step - 5e-7).abs() < 1e-12 && unit == Some(1e-6), "{head}: {step} {unit:?}");
    }
}

#[test]
fn numbers_of_rows_and_columns_before_points_are_asked_about() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("points.txt");
    let mut rows = String::new();
    for j in 0..4 {
        for i in 0..5 {
            rows += &format!("{j} {i} {} {} {}\n", 0.5 * i as f64, 0.5 * j as f64, ((i * j) % 3) as f64);
        }
    }
    std::fs::write(&file, rows).expect("can be written");
    let error = asperity_formats::surface::read(&file, &Request::default()).expect_err("refused");
    assert!(error.to_string().contains("z = \"5\""), "{error}");
    // colours that are a grid by chance are none
    let mut colours = String::from("# Units: um\n");
    for k in 0..16 {
        let [i, j] = [k % 4, k / 4];
        colours += &format!(
            "{} {} {} {} 7\n",
            0.5 * i as f64,
            0.5 * j as f64,
            1.0 + 0.1 * ((3 * i + j) % 4) as f64,
            100 + (k + j) % 4
        );
    }
    std::fs::write(&file, colours).expect("can be written");
    asperity_formats::surface::read(&file, &Request::default()).expect("a map of colours");
}
