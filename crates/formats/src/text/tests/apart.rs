//! Claims about marks, names and units that stand apart: a tab behind the mark between columns, a unit in a
//! cell of its own beside its name, or in the words before the table.

use super::*;

/// Programs that line their columns up: `printf("%g,\t%g")` of C, `fprintf` of MATLAB with `;\t`.
#[test]
fn blanks_and_tabs_about_a_mark_part_nothing() {
    for mark in [",\t", ";\t", " ; ", " , ", "\t;\t", ",\t\t", "; \t", " ;"] {
        for end in ["", mark] {
            let row = |cells: [&str; 3]| format!("\t{}{end}\n", cells.join(mark));
            let rows = row(["1", "100.5", "2"]) + &row(["2", "", "4"]) + &row(["3", "200.5", "8"]);
            let text = row(["Time (s)", "Depth (nm)", "Load (mN)"]) + &rows;
            let table = indentation::read(&text, COLUMNS, None).unwrap_or_else(|e| panic!("{text}: {e}"));
            let [first, last] = table.series[0].rows[..] else { panic!("{text} {table:?}") };
            assert!(is_near(first[0], 100.5e-9) && is_near(first[1], 2e-3), "{text} {table:?}");
            assert!(is_near(last[0], 200.5e-9) && is_near(last[1], 8e-3), "{text} {table:?}");
            let grid = read_grid(&rows, None, None).unwrap_or_else(|e| panic!("{rows}: {e}"));
            assert_eq!((grid.columns, grid.rows()), (3, 3), "{rows}");
            assert!(grid.values[4].is_nan() && grid.values[7] == 200.5, "{rows} {grid:?}");
        }
        is_the_curve(
            &format!("\"Depth\"{mark}\"Load\"\nnm{mark}mN\n\"100\"{mark}\"2\"\n\"200\"{mark}\"8\"\n"),
            COLUMNS,
        );
        if mark.contains(';') {
            is_the_curve(&format!("Depth (nm){mark}Load (mN)\n100,0{mark}2,0\n200,0{mark}8,0\n"), COLUMNS);
        }
    }
    is_the_curve("Depth (nm)\t,Load (mN)\n100\t,2\n200\t,8\n", COLUMNS);
}

#[test]
fn tabs_part_columns_where_other_marks_stand_within_them() {
    is_the_curve("Depth (nm)\tLoad (mN)\n100,\t2,\n200,\t8,\n", COLUMNS);
    is_the_curve("Depth (um)\tLoad (mN)\n,1\t2\n,2\t8\n", COLUMNS);
    is_the_curve("Load; raw\tDepth (nm)\tLoad (mN)\na; b\t100\t2\nc; d\t200\t8\n", COLUMNS);
    let both = "Depth (nm),\tLoad (mN)\n100,0,\t2,0\n200,0,\t8,0\n";
    let fault = indentation::read(both, COLUMNS, None).unwrap_err();
    assert!(fault.line == Some(2) && fault.message.contains("as \"100,0,\" shows"), "{fault}");
    let fault = read_grid("1,234,\t5\n6,789,\t5\n", None, None).unwrap_err();
    assert!(fault.message.contains("\"1,234,\""), "{fault}");
}

/// As spreadsheets hold a quantity beside its unit, and loggers write both.
#[test]
fn a_unit_in_a_cell_of_its_own_belongs_to_the_name_before_it() {
    for text in [
        "Depth,nm,Load,mN\n100,2\n200,8\n",
        "Depth,(nm),Load,[mN],\n100,2,\n200,8,\n",
        "Time,s,Depth,nm,Load,mN\n0,100,2\n1,200,8\n",
        "Index,,Depth,nm,Load,mN,Cycle\n1,100,2,1\n2,200,8,1\n",
        "Depth\tnm\tLoad\tmN\n100\t2\n200\t8\n",
        "Depth nm Load mN\n100 2\n200 8\n",
        "Weg;nm;Kraft;mN\n100,0;2\n200,0;8\n",
        // cells that span two columns, and rows that say the unit again
        "Depth,nm,Load,mN\n100,,2,\n200,,8,\n",
        "Depth,nm,Load,mN\n100,nm,2,mN\n200,nm,8,mN\n",
    ] {
        is_the_curve(text, COLUMNS);
    }
    // a column of numbers is none of units
    for text in ["Depth,m,Load,N\n100,5,2,7\n", "nm,Depth,mN,Load\n100,2\n", "Depth,Load,Time,Cycle\n100,2\n"]
    {
        let fault = indentation::read(text, COLUMNS, None).unwrap_err();
        assert!(fault.line == Some(1) && fault.message.contains("has no unit"), "{text} {fault}");
    }
}

/// Headers of loggers: names alone above the columns, their units among the words before.
#[test]
fn units_in_the_words_before_a_table_are_those_of_its_columns() {
    for words in [
        "Depth unit: nm\nLoad unit: mN\n",
        "Depth Units = nm\nLoad Units = mN\n",
        "Displacement [unit]: nm\nForce (unit) mN\n",
        "Unit of depth: nm\nUnit of the load: mN\n",
        "Einheit der Eindringtiefe: nm\nEinheit Kraft: mN\n",
        "# depth_unit: nm\n# load_unit: milli Newton\n",
        "Depth unit,nm\nLoad unit,mN\n",
        "Depth unit: nm; Load unit: mN\n",
        "# Depth unit: nm, load unit: mN\n",
        "Depth: nm\nLoad: mN\n",
        "Depth = [nm]\nLoad = [mN]\nTime = s\n",
        "# Depth: nm, Load: mN\n",
        "Time: s; Depth: nm; Load: mN\n",
    ] {
        for head in ["Depth,Load", "Indentation depth,Normal load", "Time,Depth,Load"] {
            let time = if head.starts_with("Time") { "0," } else { "" };
            is_the_curve(&format!("Test 7\n{words}\n{head}\n{time}100,2\n{time}200,8\n"), COLUMNS);
        }
        is_the_curve(&format!("{words}Depth\tLoad\n100,0\t2,0\n200,0\t8,0\n"), COLUMNS);
        is_the_curve(&format!("Depth Load\n{words}100 2\n200 8\n"), COLUMNS);
    }
    is_the_curve("Depth: nm\tLoad: mN\n100\t2\n200\t8\n", COLUMNS);
    // all columns in turn
    for words in ["Units: s, nm, mN\n", "# units: s nm mN\n", "Einheiten;s;nm;mN\n"] {
        is_the_curve(&format!("{words}Time,Depth,Load\n0,100,2\n1,200,8\n"), COLUMNS);
    }
    let fault = indentation::read("Units: nm, mN\nTime,Depth,Load\n0,100,2\n", COLUMNS, None).unwrap_err();
    assert!(fault.message.contains("has no unit"), "{fault}");
    // each column its own
    is_the_curve("Piezo unit: um\nDepth unit: nm\nPiezo,Depth,Load (mN)\n9,100,2\n9,200,8\n", COLUMNS);
    is_the_curve(
        "Displacement unit: um\nDepth (nm),Displacement,Load (mN)\n100,9,2\n200,9,8\n",
        ["Depth (nm)", "Load (mN)"].map(Some),
    );
    let said =
        indentation::read("Depth unit: nm\nDepth,Load (mN)\n100,2\n", COLUMNS, None).unwrap().understood;
    assert!(said.starts_with("depth from \"Depth\" in nm, force from \"Load (mN)\";"), "{said}");
}

#[test]
fn a_unit_before_a_table_that_contradicts_its_column_is_refused_with_both() {
    for (text, words) in [
        ("Depth unit: um\nDepth (nm),Load (mN)\n100,2\n", "\"Depth (nm)\" is in nm, but line 1 says um"),
        ("Depth: um\nDepth (nm),Load (mN)\n100,2\n", "\"Depth (nm)\" is in nm, but line 1 says um"),
        ("Units: um, mN\nDepth (nm),Load (mN)\n100,2\n", "\"Depth (nm)\" is in nm, but line 1 says um"),
        ("Depth unit: um\nDepth,Load\nnm,mN\n100,2\n", "\"Depth\" is in nm, but line 1 says um"),
        ("Displacement unit: mm\nLoad unit: N\nDepth (nm),Load (N)\n100,2\n", "is in nm, but line 1 says mm"),
        ("Depth unit: nm\nDepth unit: um\nDepth,Load (mN)\n100,2\n", "is in nm, but line 2 says um"),
        ("Depth unit: mN\nDepth,Load (mN)\n100,2\n", "the unit \"mN\", which is not known"),
        ("Depth unit: furlong\nDepth,Load (mN)\n100,2\n", "has no unit"),
    ] {
        let fault = indentation::read(text, COLUMNS, None).unwrap_err();
        assert!(fault.message.contains(words), "{text} {fault}");
    }
    // the same unit, and a unit of one of two columns
    is_the_curve("Depth unit: µm\nDepth (um),Load (mN)\n0.1,2\n0.2,8\n", COLUMNS);
    let two = "Load unit: mN\nDepth (nm),Load (N),Load (mN)\n100,0.002,2\n200,0.008,8\n";
    is_the_curve(two, [Some("Depth (nm)"), Some("Load (mN)")]);
}

/// FemtoTools writes the header of each indent behind the sign of a comment.
#[test]
fn a_header_repeated_behind_the_sign_of_a_comment_begins_another_test() {
    let one = "// Depth [nm]\tLoad [mN]\n100\t2\n200\t8\n";
    let table = indentation::read(&format!("{one}\n{one}"), COLUMNS, None).unwrap();
    assert_eq!(table.series.iter().map(|test| test.rows.len()).collect::<Vec<_>>(), [2, 2], "{table:?}");
    // another remark between the rows begins none
    let table = indentation::read(&format!("{one}// a pause\n300\t18\n"), COLUMNS, None).unwrap();
    assert_eq!((table.series.len(), table.series[0].rows.len()), (1, 3), "{table:?}");
}

/// Some loggers write the unit behind every number, and not in the header.
#[test]
fn a_unit_behind_each_number_is_that_of_the_number() {
    for text in [
        "Depth\tLoad\n100 nm\t2 mN\n200 nm\t8 mN\n",
        "Depth;Load\n100,0nm;2 mN\n200,0nm;8 mN\n",
        "Time,Depth,Load\n0 s,0.1 µm,2e-3 N\n1 s,2e2 nm,8 mN\n",
        // what stands with the number goes before what stands above it
        "Depth (nm),Load (mN)\n0.1 um,2\n0.2 um,8\n",
    ] {
        is_the_curve(text, COLUMNS);
    }
    for (text, why) in [
        ("Depth\tLoad\n100 nm\t2\n200 nm\t8\n", "has no unit"),
        ("Depth\tLoad\n100 nm\t2 mN\n200 s\t8 mN\n", "\"200 s\" is not a number"),
        ("Depth (m)\tLoad (N)\n0.0001\t2\n0.0002\t66.2m\n", "\"66.2m\" is not a number"),
        ("Load (N)\tDepth (m)\n2\t0.0001\n8\t66.2m\n", "\"66.2m\" is not a number"),
    ] {
        let fault = indentation::read(text, COLUMNS, None).expect_err(text);
        assert!(fault.message.contains(why), "{text}: {fault}");
    }
}

/// As FemtoTools writes the displacement of its drive beside that of the sample.
#[test]
fn the_depth_of_the_sample_beside_that_of_the_drive_is_asked_about() {
    let text = "Displacement [nm]\tForce [mN]\tSample Displacement [nm]\n150\t2\t100\n280\t8\t200\n";
    let fault = indentation::read(text, COLUMNS, None).unwrap_err();
    assert!(
        fault.message.contains("\"Displacement [nm]\" and \"Sample Displacement [nm]\" may all be the depth"),
        "{fault}"
    );
    is_the_curve(text, [Some("Sample Displacement [nm]"), None]);
}

/// As `write.table` of R and `to_string` of pandas number their rows: all names but the first.
#[test]
fn one_name_fewer_than_columns_is_asked_about() {
    for text in [
        "\"Depth_nm\" \"Load_mN\"\n\"1\" 100 2\n\"2\" 200 8\n",
        "   Depth_nm  Load_mN\n0  100  2\n1  200  8\n",
        "Depth_nm\tLoad_mN\n1\t100\t2\n2\t200\t8\n",
    ] {
        let fault = indentation::read(text, COLUMNS, None).expect_err(text);
        assert!(fault.message.contains("2 names above 3 columns"), "{text}: {fault}");
        is_the_curve(text, [Some("2 [nm]"), Some("3 [mN]")]);
    }
}

/// Some programs hold a factor in the numbers already, others do not: the file cannot tell.
#[test]
fn a_factor_above_a_curve_is_said_to_change_nothing() {
    let said = |line: &str| {
        let text = format!("{line}\nDepth (nm)\tLoad (mN)\n100\t2\n200\t8\n");
        is_the_curve(&text, COLUMNS);
        indentation::read(&text, COLUMNS, None).unwrap().understood
    };
    for line in ["Load factor: 0.5", "# Kraftfaktor\t2", "Scaling = 1e-3", "Facteur de charge;0,5"] {
        let understood = said(line);
        assert!(understood.contains("line 1") && understood.contains("changes nothing"), "{understood}");
    }
    for line in ["Load factor: 1", "Factory: 5", "Tip area factor", "Load: 0.5 mN/s"] {
        let understood = said(line);
        assert!(!understood.contains("changes nothing"), "{understood}");
    }
}

/// The unit MN is of meganewtons; programs that write capitals alone mean mN.
#[test]
fn meganewtons_are_none_but_in_a_head_of_capitals() {
    let force = |text: &str, columns| indentation::read(text, columns, None).unwrap().series[0].rows[0][1];
    assert!(is_near(force("DEPTH (NM),LOAD (MN)\n100,2\n200,8\n", COLUMNS), 2e-3));
    assert!(is_near(force("DEPTH;LOAD\nNM;MN\n100;2\n200;8\n", COLUMNS), 2e-3));
    assert!(is_near(force("Displacement (mm),Force (MN)\n1,2\n2,8\n", COLUMNS), 2e6));
    assert!(is_near(force("1,2\n2,8\n", [Some("1 [mm]"), Some("2 [MN]")]), 2e6));
}

/// The frame of the machine bends with its crosshead, not between the ends of a gauge on the sample.
#[test]
fn a_gauge_beside_the_crosshead_is_asked_about() {
    for head in
        ["Traversenweg (mm);Wegaufnehmer (mm)", "Stroke (mm);LVDT (mm)", "Crosshead (mm);Extensometer (mm)"]
    {
        let text = format!("{head};Force (N)\n0.2;0.1;2\n0.4;0.2;8\n");
        let fault = indentation::read(&text, COLUMNS, None).unwrap_err();
        assert!(fault.message.contains("may all be the depth"), "{fault}");
    }
    let lateral = "Normal force (mN);Normal displacement (nm);Lateral force (mN);Lateral displacement (nm)";
    is_the_curve(&format!("{lateral}\n2;100;9;9\n8;200;9;9\n"), COLUMNS);
}

#[test]
fn tests_are_numbered_by_columns_of_many_names() {
    for name in ["Nr", "No.", "Test No", "Prüfung", "Messung", "Measurement", "Curve", "ID", "Probe Nr."] {
        let rows = |test: usize| (1..5).map(|i| format!("{test};{}00;{i}\n", i)).collect::<String>();
        let text = format!("{name};Depth (nm);Load (mN)\n{}{}", rows(1), rows(2));
        let table = indentation::read(&text, COLUMNS, None).unwrap();
        let lengths: Vec<usize> = table.series.iter().map(|series| series.rows.len()).collect();
        assert_eq!(lengths, [4, 4], "{name}");
        // a number in each row counts these, also where it begins anew
        let counted = (0..8).map(|i| format!("{};{}00;{i}\n", i % 4, i + 1)).collect::<String>();
        let text = format!("{name};Depth (nm);Load (mN)\n{counted}");
        let table = indentation::read(&text, COLUMNS, None).unwrap();
        assert_eq!((table.series.len(), table.series[0].rows.len()), (1, 8), "{name}");
    }
}

/// A spreadsheet of a place where points part thousands shows 1026 as 1.026 and 525 as 525.
#[test]
fn thousands_behind_points_among_whole_numbers_are_refused() {
    let map =
        "750;1.227;1.624\n1.873;932;1.791\n473;1.026;525\n1.050;324;1.300\n980;1.210;730\n1.410;880;1.730\n";
    let fault = read_grid(map, None, None).unwrap_err();
    assert!(fault.message.contains(" or 1") && fault.message.contains("decimal = \"point\""), "{fault}");
    assert!(read_grid(map, None, Some(Decimal::Point)).is_ok());
    for sound in
        ["0.500 12\n1.227 13\n2.500 14\n3.750 15\n", "1\t1.5\n2\t1.125\n3\t2\n4\t2.375\n5\t3\n6\t3.5\n"]
    {
        assert!(read_grid(sound, None, None).is_ok(), "{sound}");
    }
}

/// Igor begins its rows with a tab, other programs with the separator of a column of labels.
#[test]
fn an_empty_first_column_is_none_of_the_map() {
    for mark in ["\t", ",", ";"] {
        let row = |cells: [&str; 3]| format!("{mark}{}\n", cells.join(mark));
        let text = row(["1", "2.5", "3"]) + &row(["4", "5", "6"]);
        let grid = read_grid(&text, None, None).unwrap();
        assert_eq!((grid.columns, grid.rows(), grid.values.len()), (3, 2, 6), "{text}");
        assert!(grid.describe().contains("empty first cell"), "{}", grid.describe());
    }
}

/// Exports of several indents into one sheet, one below the other without a number or a word between them.
#[test]
fn tests_below_each_other_are_parted_where_the_tool_is_at_the_surface_again() {
    let test = |peak: i32, residual: f64| -> Vec<[f64; 2]> {
        let to = f64::from(peak);
        let back = |i: i32| to - (to - residual) * f64::from(i) / 10.0;
        (0..=peak)
            .map(|i| [f64::from(i), f64::from(i * i)])
            .chain((1..=10).map(|i| [back(i), to * to * (1.0 - f64::from(i) / 10.0)]))
            .collect()
    };
    let text = |tests: &[Vec<[f64; 2]>]| -> String {
        let rows = tests.iter().flatten().map(|[h, p]| format!("{h}\t{p}\n"));
        std::iter::once("Depth (nm)\tLoad (uN)\n".to_string()).chain(rows).collect()
    };
    let three = text(&[test(40, 34.0), test(38, 31.0), test(41, 36.0)]);
    let table = indentation::read(&three, COLUMNS, None).unwrap();
    let counts: Vec<usize> = table.series.iter().map(|test| test.rows.len()).collect();
    assert_eq!(counts, [51, 49, 52]);
    assert_eq!(table.series.iter().map(|test| &*test.label).collect::<Vec<_>>(), ["1", "2", "3"]);
    assert_eq!(table.series[1].lines[0], 53);
    assert!(table.understood.contains("3 tests below each other"), "{}", table.understood);
    assert!(table.understood.contains("again at lines 53, 102"), "{}", table.understood);
    // a lighter test below
    let lighter = indentation::read(&text(&[test(40, 34.0), test(12, 10.0)]), COLUMNS, None).unwrap();
    assert_eq!(lighter.series.iter().map(|test| test.rows.len()).collect::<Vec<_>>(), [51, 23]);
    // one test: reloading from the imprint, a way back that is elastic, and zeros where nothing was read
    let again: Vec<[f64; 2]> = (0..=6).map(|i| [34.0 + f64::from(i), 1600.0 * f64::from(i) / 6.0]).collect();
    let mut zeros = test(40, 34.0);
    zeros.splice(45..45, [[0.0; 2]; 3]);
    for one in [vec![test(40, 34.0), again], vec![test(40, 0.0), test(40, 0.0)], vec![zeros]] {
        let table = indentation::read(&text(&one), COLUMNS, None);
        assert!(table.map_or(true, |table| table.series.len() == 1), "{one:?}");
    }
}

/// Instruments write the name of a segment on a line of its own, and some the names of the columns again.
#[test]
fn segments_of_a_test_are_one_test() {
    let (names, load, hold, unload) =
        ("Depth (nm),Load (mN)\n", "100,2\n200,8\n", "201,8\n", "150,3\n120,0\n");
    for text in [
        format!("{names}Segment 1\n{load}Segment 2\n{hold}Segment 3\n{unload}"),
        format!("{names}{load}Hold\n{hold}Unload\n{unload}"),
        format!(
            "[Segment 1]\n{names}{load}\n[Segment 2]\n{names}{hold}\n[Segment: 3 (Unload)]\n{names}{unload}"
        ),
        format!("Loading\n{names}{load}Holding\n{names}{hold}Unloading\n{names}{unload}"),
    ] {
        let table = indentation::read(&text, COLUMNS, None).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!((table.series.len(), table.series[0].rows.len()), (1, 5), "{text} {table:?}");
    }
    // each of two tests begins with its first segment
    let one = format!("Segment 1\n{names}{load}Segment 2\n{names}{unload}");
    let table = indentation::read(&format!("{one}{one}"), COLUMNS, None).unwrap();
    assert_eq!(table.series.iter().map(|test| test.rows.len()).collect::<Vec<_>>(), [4, 4], "{table:?}");
}
