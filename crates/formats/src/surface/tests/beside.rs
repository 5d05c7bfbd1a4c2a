//! Claims about what stands beside heights: factors in words, columns of means, places and marks.

use super::*;

fn found(text: &str, is_told: bool) -> Result<Measured, String> {
    let folder = Folder::new();
    let request = Request { override_file: is_told, ..Request::default() };
    read(&folder.file("a.txt", text.as_bytes()), &request).map_err(|e| e.to_string())
}

/// Rows of a map of 6 x 5 heights times `factor`, between the cells `before` and `after` of each row.
fn rows(factor: f64, before: impl Fn(usize) -> String, after: impl Fn(usize) -> String) -> String {
    let height = |i: usize, j: usize| factor * ((7 * i + 11 * j * j) % 13) as f64;
    let row = |i: usize| -> Vec<String> {
        let cells = (0..6).map(|j| format!("{:.2}", height(i, j)).replace(".00", ""));
        std::iter::once(before(i)).chain(cells).chain([after(i)]).filter(|cell| !cell.is_empty()).collect()
    };
    (0..5).map(|i| row(i).join(",") + "\n").collect()
}

fn nothing(_: usize) -> String {
    String::new()
}

/// As cameras, AFMs and scripts of a laboratory note it above a table.
#[test]
fn a_factor_in_words_is_refused_beside_heights_that_may_lack_it() {
    let pixel = "Pixel size: 1 um\n";
    let read = |words: &str, factor: f64| {
        found(&format!("{words}\n{pixel}{}", rows(factor, nothing, nothing)), false)
    };
    for words in [
        "Values x 0.5 nm",
        "Height = value * 0.5 nm",
        "Z [nm] = data × 0,5",
        "Multiply by 0.5 to get nm",
        "Unit: 0.5 nm",
        "# heights divided by 20",
    ] {
        for factor in [1.0, 0.37] {
            let fault = read(words, factor).expect_err(words);
            assert!(fault.contains("line 1: says") && fault.contains("multiplied by it"), "{words}: {fault}");
            assert!(
                found(&format!("{words}\n{pixel}{}", rows(factor, nothing, nothing)), true).is_ok(),
                "{words}"
            );
        }
    }
    for words in ["0.5 nm per count", "z = 0.5 nm/digit", "Counts per um: 200", "1 digit = 0.5 nm"] {
        let words = format!("# {words}");
        let fault = read(&words, 1.0).expect_err(&words);
        assert!(fault.contains("whole numbers"), "{words}: {fault}");
        assert!(read(&words, 0.37).is_ok(), "{words}");
    }
    for words in
        ["Data: 6 x 5 points", "Objective x 50", "Values in nm", "Camera: 2.5 um per count", "Data x 512"]
    {
        assert!(read(words, 0.37).is_ok(), "{words}: {:?}", read(words, 0.37));
    }
}

/// As spreadsheets sum rows up, and stages write the place of each line.
#[test]
fn columns_of_other_names_beside_those_of_heights_are_refused() {
    let names = |before: &str, after: &str| {
        let names = (1..=6).map(|j| format!("C{j}")).collect::<Vec<_>>().join(",");
        format!("Pixel size: 1 um\nHeight unit: nm\n{before}{names}{after}\n")
    };
    let mean = |i: usize| format!("{}.25", 3 + i);
    let encoder = |i: usize| format!("{}", [1003, 1010, 1018, 1022, 1031][i]);
    for (text, name) in [
        (names("", ",Mean") + &rows(0.37, nothing, mean), "\"Mean\""),
        (names("Encoder,", "") + &rows(0.37, encoder, nothing), "\"Encoder\""),
        (names("Encoder,", ",Sa") + &rows(0.37, encoder, mean), "\"Encoder\", \"Sa\""),
        (names("", "").replace("C6", "Max") + &rows(0.37, nothing, nothing), "\"Max\""),
    ] {
        let fault = found(&text, false).unwrap_err();
        assert!(fault.contains(&format!("line 3: names {name} beside columns of heights")), "{text}{fault}");
        assert!(found(&text, true).is_ok(), "{text}");
    }
    // places, which are taken as such, and names that are alike
    let places = |i: usize| format!("{i}");
    let numbered = |before: &str| names(before, "") + &rows(0.37, places, nothing);
    assert_eq!(found(&(names("", "") + &rows(0.37, nothing, nothing)), false).unwrap().columns, 6);
    assert_eq!(found(&numbered("Row,").replace("C1", "x1"), false).map(|m| m.columns).ok(), None);
    let even: String = (0..10)
        .map(|i| {
            format!(
                "{i},{}",
                rows(0.37 + 0.1 * f64::from(i), nothing, nothing).lines().nth(i as usize % 5).unwrap()
            ) + "\n"
        })
        .collect();
    assert_eq!(found(&(names("Row,", "") + &even), false).unwrap().columns, 6);
}

/// Alicona, GOM and scripts write such a column behind x, y, z.
#[test]
fn points_that_a_column_calls_invalid_are_missing() {
    let list = |name: &str, mark: &dyn Fn(usize) -> &'static str| -> String {
        let row = |k: usize| format!("{},{},{}.5,{}\n", k % 4, k / 4, (7 * k) % 5, mark(k));
        std::iter::once(format!("x_um,y_um,z_nm,{name}\n")).chain((0..20).map(row)).collect()
    };
    let is_bad = |k: usize| [3, 8, 9].contains(&k);
    for (name, bad) in [("Valid", "0"), ("is_valid", "0"), ("gültig", "0"), ("Masked", "1"), ("INVALID", "1")]
    {
        let good = if bad == "0" { "1" } else { "0" };
        let map = found(&list(name, &|k| if is_bad(k) { bad } else { good }), false).unwrap();
        let missing: Vec<usize> = (0..20).filter(|k| map.heights[*k].is_nan()).collect();
        assert_eq!(missing, [3, 8, 9], "{name}");
        assert!(
            map.notes
                .iter()
                .any(|note| note.contains(&format!("3 points are missing, as the column \"{name}\"")))
        );
    }
    for (name, mark) in [("Valid", "1"), ("Quality", "0"), ("Valid", "0.5")] {
        assert!(
            found(&list(name, &|_| mark), false).unwrap().heights.iter().all(|z| z.is_finite()),
            "{name}"
        );
    }
}

#[test]
fn rows_that_begin_with_labels_are_refused_by_the_label() {
    for label in ["Row 1", "12:00:01", "Profile 3"] {
        let text = "Pixel size: 1 um\n".to_string() + &rows(0.37, |_| label.to_string(), nothing);
        let fault = found(&text, false).unwrap_err();
        assert!(fault.contains(&format!("line 2: begins with \"{label}\"")), "{fault}");
    }
}
