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
