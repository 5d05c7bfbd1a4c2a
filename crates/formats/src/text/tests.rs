//! Claims about the reader of tables. Each text has a feature that files of a named origin have.

use super::*;
use crate::indentation;

mod apart;

const COLUMNS: [Option<&str>; 2] = [None; 2];

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

/// The curve (0.1 µm, 2 mN), (0.2 µm, 8 mN) and nothing else.
#[track_caller]
fn is_the_curve(text: &str, columns: [Option<&str>; 2]) {
    let table = indentation::read(text, columns, Some(-9999.0)).unwrap_or_else(|e| panic!("{text}: {e}"));
    let rows = &table.series[0].rows;
    assert_eq!((table.series.len(), rows.len()), (1, 2), "{text} {table:?}");
    let near = |row: [f64; 2], want: [f64; 2]| is_near(row[0], want[0]) && is_near(row[1], want[1]);
    assert!(near(rows[0], [1e-7, 2e-3]) && near(rows[1], [2e-7, 8e-3]), "{text} {table:?}");
}

#[test]
fn curves_of_many_makers_are_read() {
    for text in [
        "depth_um,force_mN\n0.1,2\n0.2,8\n",
        "Depth (nm),Load (mN)\n100,2\n200,8\n",
        "Instrument X\nDate;today\nDisplacement [nm];Load [uN]\n100,0;2000,0\n200,0;8000,0\n",
        "\u{feff}Time\tDepth\tForce\ns\tnm\tmN\n0\t100\t2\n1\t200\t8\n",
        "# a note\nh/nm P/mN\n100 2\n200 8\n",
        "increment,phase,depth_um,force_N,contact_area_um2,force_nodal_N,force_error\n1,load,0.1,0.002,1,3,0.01\n2,load,0.2,0.008,1,3,0.01\n",
        // Hysitron
        "Mon May 04 11:50:04 2015\n\nNumber of Points = 2\nDepth (nm)\tLoad (µN)\tTime (s)\tDepth (V)\tLoad (V)\n100\t2000\t0\t1\t2\n200\t8000\t1\t1\t2\n",
        // Anton Paar
        "Time [s]\tPd [nm]\tFn [mN]\n0\t100\t2\n1\t200\t8\n",
        "X_Glass 1_Pd_[µm]\tY_Glass 1_Fn_[mN]\t\n0.1\t2\t\n0.2\t8\t\n",
        // Instron
        "\"Time\",\"Extension\",\"Load\"\n\"(s)\",\"(mm)\",\"(N)\"\n\"0.0\",\"0.0001\",\"0.002\"\n\"0.1\",\"0.0002\",\"0.008\"\n",
        // Zwick, Fischer
        "Eindringtiefe;Prüfkraft\nµm;mN\n0,1;2,0\n0,2;8,0\n",
        "Standardweg in mm;Standardkraft in N\n0,0001;0,002\n0,0002;0,008\n",
        "Profondeur (nm);Force normale (mN)\n100,0;2\n200,0;8\n",
        // hardness testers
        "Depth (µm),Load (gf)\n0.1,0.203943242595586\n0.2,0.815772970382343\n",
        // prefixes that are words
        "depth_nm,load_micro_N,time_s\n100,2000,0\n200,8000,1\n",
        "Depth (nanometers),Force (milli Newton)\n100,2\n200,8\n",
        // NumPy, with a header in a comment
        "# depth_nm force_mN\n1.0e+02 2.0D+00\n2.0e+02 8.0\n",
        // names of several words apart by blanks
        "Indentation Depth (nm) Normal Load (mN)\n100 2\n200 8\n",
        // spreadsheets: separators alone, a sum below
        "depth_um,force_mN\n0.1,2\n,\n0.2,8\n,\nMean,\n",
        "depth_um;force_mN\n0,1;2\n0,2;8\nMittelwert;\n",
        // thousands
        "depth_nm\tforce_uN\n100.0\t2,000.0\n200.0\t8,000.0\n",
        "depth_nm;force_uN\n100,0;2.000,0\n200,0;8.000,0\n",
        "depth_nm;force_uN\n100,0;2\u{a0}000,0\n200,0;8\u{202f}000,0\n",
        "depth_nm;force_uN\n100;2 000.0\n200;8 000.0\n",
        // rows that begin with words or times
        "Segment\tDepth (nm)\tLoad (mN)\nLoad\t100,0\t2,0\nHold\t200,0\t8,0\n",
        "Uhrzeit;Tiefe (nm);Kraft (mN)\n12:00:00,00;100,0;2,0\n12:00:00,10;200,0;8,0\n",
        "Load (g),Depth (um)\n0.203943242595586,0.1\n0.815772970382343,0.2\n",
        // words and numbers that mean that nothing was read
        "depth_nm,force_mN\n100,2\n150,N/A\n-1.#IND,3\n160,1e38\n170,-9999\n200,8\n",
        "h_nm P_mN\n100 2\nNo Data No Data\n150 ***\n200 8\n",
    ] {
        is_the_curve(text, COLUMNS);
    }
}

#[test]
fn columns_named_by_a_key_are_taken() {
    let odd = "A [nm];B [mN];C [mN]\n100;5;2\n200;5;8\n";
    for columns in [["A", "C"], ["A [nm]", "C [mN]"], ["1", "3"], ["a", "3 [mN]"]] {
        is_the_curve(odd, columns.map(Some));
    }
    is_the_curve("Weg,Last 2\n100,2\n200,8\n", [Some("Weg [nm]"), Some("Last 2 (mN)")]);
    is_the_curve("5 100 2\n6 200 8\n", [Some("2 [nm]"), Some("3 [mN]")]);
    for (columns, word) in [
        (["A", "D"], "\"D\""),
        (["A", "9"], "\"9\""),
        (["A [um]", "C"], "leave the unit out of the key"),
        (["A", "C [furlong]"], "furlong"),
    ] {
        let fault = indentation::read(odd, columns.map(Some), None).unwrap_err();
        assert!(fault.message.contains(word), "{fault}");
    }
    let fault = indentation::read("Kanal 1;Kanal 2\n1;2\n", COLUMNS, None).unwrap_err();
    assert!(fault.message.contains("columns = { depth = \"…\", force = \"…\" }"), "{fault}");
    assert!(fault.message.contains("\"Kanal 1\", \"Kanal 2\"") && fault.line == Some(1), "{fault}");
}

/// 1,125 to 8,875 has three decimals throughout.
#[test]
fn a_key_says_what_stands_before_decimals() {
    let text = "depth_um;force_mN\n0;0\n1,125;2\n1,250;8\n";
    for (decimal, depth) in [(Decimal::Comma, 1.125e-6), (Decimal::Point, 1125e-6)] {
        let table = indentation::read_as(text, COLUMNS, None, Some(decimal)).unwrap();
        assert!(is_near(table.series[0].rows[1][0], depth), "{decimal:?} {table:?}");
        let grid = read_grid("1,125;2\n1,250;8\n", None, Some(decimal)).unwrap();
        assert!(is_near(grid.values[0], 1e6 * depth), "{decimal:?} {grid:?}");
    }
    let fault =
        indentation::read_as("depth_um,force_mN\n1,2\n", COLUMNS, None, Some(Decimal::Comma)).unwrap_err();
    assert!(fault.message.contains("part the columns"), "{fault}");
    // a comma of thousands behind others that tell
    is_the_curve(
        "depth_nm\tforce_uN\n100.5\t2,000.5\n100\t2,000\n200\t8,000\n"
            .replace("100.5\t2,000.5\n", "\t2,000.5\n")
            .as_str(),
        COLUMNS,
    );
}

/// Testing machines count tension positive.
#[test]
fn compression_counted_negative_is_answered_with_the_key_that_turns_it() {
    let rows = |depth: i32, force: i32| {
        let row = |[h, f]: [i32; 2]| format!("{},{}\n", depth * h, force * f);
        let rows: String = [[0, 0], [100, 2], [200, 8]].map(row).concat();
        format!("Displacement (nm),Force (mN)\n{rows}")
    };
    for (depth, force, key) in [
        (-1, -1, ["-Displacement (nm)", "-Force (mN)"]),
        (1, -1, ["Displacement (nm)", "-Force (mN)"]),
        (-1, 1, ["-Displacement (nm)", "Force (mN)"]),
    ] {
        let text = rows(depth, force);
        let fault = indentation::read(&text, COLUMNS, None).unwrap_err();
        let want = format!("columns = {{ depth = \"{}\", force = \"{}\" }}", key[0], key[1]);
        assert!(fault.message.contains(&want) && fault.line == Some(4), "{fault}");
        let table = indentation::read(&text, key.map(Some), None).unwrap();
        assert!(
            is_near(table.series[0].rows[2][0], 2e-7) && is_near(table.series[0].rows[2][1], 8e-3),
            "{table:?}"
        );
        assert!(table.understood.contains("the sign of the"), "{}", table.understood);
    }
    // the key is turned back where it was wrong, and numbers of columns turn too
    let fault = indentation::read(&rows(1, 1), ["-1 [nm]", "-2"].map(Some), None).unwrap_err();
    assert!(fault.message.contains("columns = { depth = \"1 [nm]\", force = \"2\" }"), "{fault}");
    // an attraction of the tip is no compression
    let pulled = "Depth (nm),Force (mN)\n0,0\n100,2\n200,8\n-10,-9\n";
    assert!(indentation::read(pulled, COLUMNS, None).is_ok());
}

/// Layouts of NanoScope Analysis' ASCII export and of JPK's text export, as public readers of them take them.
#[test]
fn force_curves_of_a_cantilever_are_named_with_what_makes_them_curves() {
    let bruker = "Calc_Ramp_Ex_nm\tCalc_Ramp_Rt_nm\tDefl_pN_Ex\tDefl_pN_Rt\t\n0\t9\t0\t9\t\n1\t8\t1\t8\t\n";
    let fault = indentation::read(bruker, COLUMNS, None).unwrap_err();
    assert!(fault.message.contains("depth = Ramp - Defl") && fault.line == Some(1), "{fault}");
    let jpk = |columns: &str, units: &str| {
        let segment =
            |rows: &str| format!("# segment: extend\n# columns: {columns}\n# units: {units}\n#\n{rows}\n");
        format!(
            "# xPosition: 0.0\n#\n{}{}",
            segment("9e-6 0 0 0\n-1e-7 2e-3 0 1\n-2e-7 8e-3 0 2\n"),
            segment("-1e-7 1e-3 0 3\n")
        )
    };
    let text = jpk("verticalTipPosition vDeflection height time", "m N m s");
    let fault = indentation::read(&text, COLUMNS, None).unwrap_err();
    assert!(fault.message.contains("columns = { depth = \"-1 [m]\", force = \"2 [N]\" }"), "{fault}");
    let table = indentation::read(&text, ["-1 [m]", "2 [N]"].map(Some), None).unwrap();
    let rows = &table.series[0].rows;
    assert!(rows.len() == 4 && is_near(rows[2][0], 2e-7) && is_near(rows[2][1], 8e-3), "{table:?}");
    let volts = indentation::read(&jpk("height vDeflection", "m V"), COLUMNS, None).unwrap_err();
    assert!(volts.message.contains("tip position"), "{volts}");
}

/// NanoTest of Micro Materials: time, depth and load without a header.
#[test]
fn more_columns_than_are_wanted_are_not_guessed() {
    let fault = indentation::read("0.0 0 0\n0.1 100 2\n0.2 200 8\n", COLUMNS, None).unwrap_err();
    let want = "columns = { depth = \"NUMBER [um]\", force = \"NUMBER [mN]\" } (they reach 0.2, 200, 8)";
    assert!(fault.message.contains(want), "{fault}");
}

#[test]
fn characters_of_every_encoding_give_the_same_curve() {
    let text = "Depth (µm);Load (mN)\n0,1;2,0\n0,2;8,0\n";
    let wide = |unit: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(unit).collect::<Vec<u8>>();
    let marked = |mark: &[u8], rest: &[u8]| [mark, rest].concat();
    let windows: Vec<u8> = text.chars().map(|c| c as u8).collect();
    for (bytes, name) in [
        (text.as_bytes().to_vec(), "UTF-8"),
        (marked(&[0xef, 0xbb, 0xbf], text.as_bytes()), "UTF-8"),
        (wide(u16::to_le_bytes), "UTF-16"),
        (wide(u16::to_be_bytes), "UTF-16"),
        (marked(&[0xff, 0xfe], &wide(u16::to_le_bytes)), "UTF-16"),
        (marked(&[0xfe, 0xff], &wide(u16::to_be_bytes)), "UTF-16"),
        (windows, "Windows-1252"),
        (text.replace('\n', "\r\n").into_bytes(), "UTF-8"),
        (text.replace('\n', "\r").into_bytes(), "UTF-8"),
        (marked(text.as_bytes(), &[0x1a]), "UTF-8"),
    ] {
        let (found, encoding) = decode(&bytes).unwrap();
        assert_eq!(encoding, name);
        is_the_curve(&found, COLUMNS);
    }
    for bytes in
        [&b"\x00\x01\x02\x03\x00\x00\x07"[..], &[0xff, 0xfe, 0, 0, 65, 0, 0, 0], b"\x01\x02\x03\x04abc"]
    {
        assert!(decode(bytes).is_err(), "{bytes:?}");
    }
}

#[test]
fn several_tests_are_told_apart() {
    for text in [
        "Depth 1 (nm),Load 1 (mN),Depth 2 (nm),Load 2 (mN)\n100,2,50,1\n200,8,,\n",
        "depth_nm,force_mN\n100,2\n200,8\n\ndepth_nm,force_mN\n50,1\n",
        "test,depth_nm,force_mN\n1,100,2\n1,200,8\n2,50,1\n",
        "X_Glass 1_Pd_[nm]\tY_Glass 1_Fn_[mN]\tX_Glass 1_Pd_[nm]\tY_Glass 1_Fn_[mN]\t\n100\t2\t50\t1\t\n200\t8\t\t\t\n",
    ] {
        let tests = indentation::read(text, COLUMNS, None).unwrap().series;
        assert_eq!(tests.iter().map(|t| t.rows.len()).collect::<Vec<_>>(), [2, 1], "{text}");
    }
}

#[test]
fn what_cannot_be_read_names_the_line_and_a_way_out() {
    for (text, line, word) in [
        ("depth,force\n1,2\n", 1, "has no unit"),
        ("a\nDepth (furlong),Load (mN)\n1,2\n", 2, "furlong"),
        ("depth_um,force_mN\n1,2\n1,x\n", 3, "not a number"),
        ("1,2\n3,4\n", 1, "header"),
        ("depth_um,force_mN\n\n", 1, "without readings"),
        ("depth_um,force_mN\n0,1,0,2\n0,2,0,8\n", 2, "decimal comma"),
        ("depth_um;force_mN\n1,234;5\n", 2, "decimal = \"comma\" for 1.234, decimal = \"point\" for 1234"),
        ("depth_um;force_mN\n1,2;5\n1.234;6\n", 3, "decimals stand behind a comma"),
        ("depth_um,load_micro\n1,2\n", 1, "\"micro\""),
        ("depth_um,force_kilo_furlong\n1,2\n", 1, "force"),
    ] {
        let fault = indentation::read(text, COLUMNS, None).unwrap_err();
        assert!(fault.line == Some(line) && fault.message.contains(word), "{text}: {fault:?}");
    }
}

#[test]
fn the_sentence_says_what_was_understood() {
    let text = "Instrument X\nDepth (nm);Load (mN)\n100,0;2\n150,0;\n200,0;8\n";
    let said = indentation::read(text, COLUMNS, None).unwrap().understood;
    let want = "depth from \"Depth (nm)\", force from \"Load (mN)\"; semicolons between columns and decimal commas; 2 rows, lines 3 to 5, other lines left out: 2";
    assert_eq!(said, want);
}

#[test]
fn rows_of_numbers_are_read_in_every_dialect() {
    let want = [1.5, 2.0, f64::NAN, 4.0, 5.0, 6.25];
    for text in [
        "1.5,2,\n4,5,6.25\n",
        "title\nunit: none\n1.5 2 nan\n4 5 6.25",
        "1,5;2;***\n4;5;6,25\n\nEnd of data\n",
        "1,5\t2\tN/A\t\n4\t5\t6,25\t\n",
        "1,5 2 -\n4 5 6,25\n",
        "# note\n1.5, 2, Bad\n4, 5, 6.25\n",
        "\"1,5\",\"2\",\"\"\n\"4\",\"5\",\"6,25\"\n",
        "1.5 2 No Data\n4 5 6.25\n",
        "1.5;2;-9999\n4;5;6.25\n",
        "+1.5 2. 1.#QNAN\n4 0.5e1 6.25e+00\n",
        "1.5,2,3.4e38\n% between\n4,5,6.25\n,,\n",
        "−1.5 2 nan\n4 5 6.25".replace('−', "").as_str(),
    ] {
        let grid = read_grid(text, Some(-9999.0), None).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!((grid.columns, grid.rows()), (3, 2), "{text}");
        for (a, b) in grid.values.iter().zip(want) {
            assert!(a == &b || a.is_nan() && b.is_nan(), "{text}: {:?}", grid.values);
        }
    }
}

/// The mask of a round aperture: whole rows at the edge of the map and the beginnings of others are missing.
#[test]
fn a_masked_map_keeps_its_rows_at_the_edge() {
    for word in ["nan", "***", "Bad", "N/A", "#NV", "#NUM!", "#NOM?"] {
        for separator in [",", ";", "\t"] {
            let row = |cells: [&str; 3]| {
                let many = [vec![cells[0]; 80], vec![cells[1]; 20], vec![cells[2]; 80]].concat();
                many.join(separator) + "\n"
            };
            let [edge, within] = [row([word; 3]), row([word, "1.5", word])];
            for head in ["", "# map\n", "Height map of a lens\n"] {
                let text = format!("{head}{edge}{edge}{within}{edge}");
                let grid = read_grid(&text, None, None).unwrap();
                let missing = grid.values.iter().filter(|z| z.is_nan()).count();
                assert_eq!((grid.columns, grid.rows(), missing), (180, 4, 700), "{word}{separator}{head}");
            }
        }
    }
    let grid = read_grid("nan,nan\nnan,nan\n", None, None).unwrap();
    assert_eq!((grid.columns, grid.rows()), (2, 2));
}

#[test]
fn rows_that_are_no_table_are_refused_at_their_line() {
    for (text, line, word) in [
        ("1,2\n3\n", Some(2), "1 numbers"),
        ("1,two\n", Some(1), "\"two\""),
        ("", None, "no rows"),
        ("words\nand more\n", None, "no rows"),
        ("1 2\n3 4\nsecond map\n5 6\n", Some(3), "second map"),
        ("0,5\t1,234\n0.5\t2\n", Some(2), "comma"),
        ("1,234\t5,678\n", Some(1), "is 1.234 or 1234"),
        ("0,07552,0,25755\n0,1,0,2\n", Some(1), "a decimal comma stands among"),
        ("1 2 3\n4 5 6 7\n", Some(2), "4 numbers"),
    ] {
        let fault = read_grid(text, None, None).unwrap_err();
        assert!(fault.line == line && fault.message.contains(word), "{text}: {fault:?}");
    }
}

#[test]
fn a_text_of_many_parts_is_one_table() {
    use std::fmt::Write;
    let mut text = String::from("# many\n");
    for i in 0..300_000 {
        writeln!(text, "{i}.5,{}", i % 7).unwrap();
    }
    let grid = read_grid(&text, None, None).unwrap();
    assert_eq!((grid.rows(), grid.lines), (300_000, [2, 300_001]));
    assert!(
        (0..300_000)
            .all(|i| grid.values[2 * i] == i as f64 + 0.5 && grid.values[2 * i + 1] == (i % 7) as f64)
    );
    let fault = read_grid(&(text + "1,x\n"), None, None).unwrap_err();
    assert_eq!(fault.line, Some(300_002));
}

#[test]
fn a_curve_ends_at_words() {
    let table = "Depth (nm),Load (mN)\n100,2\n200,8\n";
    for footer in [
        "\nResults\nHmax,Fmax\n2000.0,125.0\n",
        "Average,125.0\nStd,3\n",
        "\nEND\nMean hardness 0.98 GPa\n",
        "Time (s),Drift (nm)\n0,1\n1,2\n",
    ] {
        is_the_curve(&format!("{table}{footer}"), COLUMNS);
    }
    let wide = "Time On Sample\tLoad On Sample\tDisplacement Into Surface\ns\tmN\tnm\n0\t2\t100\n1\t8\t200\n\nAverage\t125.02\t2000.0\n";
    is_the_curve(wide, COLUMNS);
    // rows that begin with words go on
    let words =
        "Segment,Depth (nm),Load (mN)\nLoad Segment Type,100,2\nHold Segment Type,200,8\nMean,150,5\n";
    is_the_curve(words, COLUMNS);
    let parted = format!("{table}Somewhere else\n150,3\n");
    let fault = indentation::read(&parted, COLUMNS, None).unwrap_err();
    assert!(
        fault.line == Some(5) && fault.message.contains("line 4") && fault.message.contains('#'),
        "{fault}"
    );
    is_the_curve("Depth (nm),Load (mN)\n100,2\n# Hold\n200,8\n", COLUMNS);
}

#[test]
fn columns_that_were_corrected_come_before_raw_ones() {
    for head in [
        "Raw Displacement (nm),Raw Load (mN),Displacement Into Surface (nm),Load On Sample (mN)",
        "Displacement Raw (nm),Raw Load (mN),Corrected Displacement (nm),Load (mN)",
        "Uncorrected Depth (nm),Load raw (mN),Depth corrected (nm),Corrected Load (mN)",
    ] {
        is_the_curve(&format!("{head}\n900,9,100,2\n950,15,200,8\n"), COLUMNS);
    }
    is_the_curve("Raw Depth (nm),Raw Load (mN)\n100,2\n200,8\n", COLUMNS);
    let two = "Depth (nm),Load (N),Load (mN)\n100,0.002,2\n200,0.008,8\n";
    let fault = indentation::read(two, COLUMNS, None).unwrap_err();
    for words in
        ["\"Load (N)\" and \"Load (mN)\"", "columns = { depth = \"Depth (nm)\", force = \"Load (N)\" }"]
    {
        assert!(fault.message.contains(words), "{fault}");
    }
    is_the_curve(two, [Some("Depth (nm)"), Some("Load (mN)")]);
}

#[test]
fn units_of_inches_and_pounds_are_known_and_no_header_is_answered_with_a_key() {
    is_the_curve(
        "Depth (mil),Load (lbf)\n0.003937007874015748,0.000449617886199421\n0.007874015748031496,0.001798471544797684\n",
        COLUMNS,
    );
    let inches = "Depth (in)\tForce (kgf)\n3.937007874015748e-6\t2.03943242595586e-4\n7.874015748031496e-6\t8.15772970382343e-4\n";
    is_the_curve(inches, COLUMNS);
    let fault = indentation::read("100 2\n200 8\n", COLUMNS, None).unwrap_err();
    assert!(fault.message.contains("columns = { depth = \"1 [um]\", force = \"2 [mN]\" }"), "{fault}");
    let fault = indentation::read("Depth (nm),Force (HV)\n1,2\n", COLUMNS, None).unwrap_err();
    assert!(fault.message.contains("1 HV is 9.80665 MPa"), "{fault}");
}

/// Rises of 30 readings to 1 µm and 60 mN, and unloading in 20 to half of that, after `before`; `change`
/// makes a line of each.
fn curve(head: &str, before: &str, change: impl Fn(usize, f64, f64) -> String) -> String {
    let up = (1..=30).map(|i| f64::from(i) / 30.0).map(|s| [1000.0 * s, 60.0 * s * s]);
    let down = (1..=20).map(|i| f64::from(i) / 40.0).map(|s| [1000.0 - 150.0 * s, 60.0 * (1.0 - s)]);
    let rows: String = up.chain(down).enumerate().map(|(i, [h, f])| change(i, h, f)).collect();
    format!("{head}\n{before}{rows}")
}

/// A mark of a missing reading, a spark in the wiring, a gauge that was not set to zero, a scale in the head,
/// a depth that is computed: what makes another metal of a curve without a word.
#[test]
fn readings_that_are_none_are_not_taken() {
    let head = "Depth (nm)\tLoad (mN)";
    let plain = |_: usize, h: f64, f: f64| format!("{h}\t{f}\n");
    let at = |places: &'static [usize], odd: &'static str| {
        move |i: usize, h: f64, f: f64| if places.contains(&i) { format!("{odd}\n") } else { plain(i, h, f) }
    };
    let approach = |force: f64| (1..20).map(|i| format!("{}\t{force}\n", i - 20)).collect::<String>();
    for (text, words) in [
        (curve(head, "", at(&[20], "99999\t99999")), "missing_value = 99999"),
        (curve(head, "", at(&[5, 6, 7, 8, 20], "9999\t9999")), "missing_value = 9999"),
        (curve(head, "", at(&[20], "-9999\t-9999")), "missing_value = -9999"),
        (curve(head, "", at(&[20], "700\t999")), "the force 999 stands alone"),
        (curve(head, "", at(&[49], "925\t9999")), "the force 9999 stands alone"),
        (curve(head, &approach(3.0), plain), "3.0000 mN at all 19 readings"),
        (curve("Depth (nm)\tLoad x 10 (mN)", "", plain), "\"x 10\""),
        (curve("Depth (nm)\tsqrt Load (mN)", "", plain), "\"sqrt\""),
        (curve("Depth (nm)\tlog Load (mN)", "", plain), "\"log\""),
        (curve("Contact Depth (nm)\tLoad (mN)", "", plain), "\"Contact Depth (nm)\""),
    ] {
        let fault = indentation::read(&text, COLUMNS, None).unwrap_err();
        assert!(fault.message.contains(words), "{text} {fault}");
    }
    let inner_cycle = |i: usize, h: f64, f: f64| {
        if i == 20 { format!("{h}\t{f}\n{}\t1\n{h}\t{f}\n", h - 50.0) } else { plain(i, h, f) }
    };
    for (text, rows) in [
        (curve(head, "", plain), 50),
        (curve(head, "", inner_cycle), 52),
        (curve(head, &approach(0.01), plain), 69),
        (
            curve("Contact depth (nm)\tDepth (nm)\tLoad (mN)", "", |i, h, f| {
                format!("1\t{}", plain(i, h, f))
            }),
            50,
        ),
        // loads that double
        (
            curve(head, "", |i, _, _| {
                format!("{}\t{}\n", 2.0_f64.powi(i as i32 / 2), 2.0_f64.powi(i as i32))
            }),
            50,
        ),
    ] {
        let table = indentation::read(&text, COLUMNS, None).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(table.series[0].rows.len(), rows, "{text}");
    }
    let marked = curve(head, "", at(&[20], "99999\t99999"));
    assert_eq!(indentation::read(&marked, COLUMNS, Some(99999.0)).unwrap().series[0].rows.len(), 49);
}

/// Parts that begin where the one before ends are one test, however they stand; tests begin at the surface.
#[test]
fn parts_of_a_test_are_joined_and_tests_are_not() {
    let loading: Vec<[f64; 2]> = (1..=9).map(|i| [10.0 * f64::from(i), 0.1 * f64::from(i * i)]).collect();
    let way_back: Vec<[f64; 2]> = (0..9).map(|i| [90.0 - f64::from(i), 8.1 - 0.9 * f64::from(i)]).collect();
    let lines = |rows: &[[f64; 2]], before: &str| -> String {
        rows.iter().map(|[h, p]| format!("{before}{h}\t{p}\n")).collect()
    };
    let (head, names) = ("Depth (nm)\tLoad (mN)\n", ["Depth (nm)", "Load (mN)"].map(Some));
    let blocks =
        format!("[Loading]\n{head}{}[Unloading]\n{head}{}", lines(&loading, ""), lines(&way_back, ""));
    let beside: String = std::iter::once(format!("L {0}\tL {1}\tU {0}\tU {1}\n", "depth (nm)", "force (mN)"))
        .chain(
            loading.iter().zip(&way_back).map(|(l, w)| format!("{}\t{}\t{}\t{}\n", l[0], l[1], w[0], w[1])),
        )
        .collect();
    let runs = format!("Run\t{head}{}{}", lines(&loading, "1\t"), lines(&way_back, "2\t"));
    let numbered: String = std::iter::once(format!("Sample\t{head}"))
        .chain(loading.iter().chain(&way_back).enumerate().map(|(i, [h, p])| format!("{i}\t{h}\t{p}\n")))
        .collect();
    for text in [blocks, beside.replace("L ", "Loading ").replace("U ", "Unloading "), runs, numbered] {
        let table = indentation::read(&text, [None; 2], None).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(table.series.len(), 1, "{text}");
        assert_eq!(table.series[0].rows.len(), 18, "{text}");
        assert!((table.series[0].rows[9][0] - 90e-9).abs() < 1e-15, "{text}");
    }
    let two = format!("{head}{}{head}{}", lines(&loading, ""), lines(&loading, ""));
    assert_eq!(indentation::read(&two, names, None).unwrap().series.len(), 2);
}
