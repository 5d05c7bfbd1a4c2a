//! Claims about text files: what they say of themselves, and what their shape says.

use super::*;

const MAP: &str = "1\t2\t3\n4\tnan\t6\n";

fn found(name: &str, text: &str) -> Result<Measured, String> {
    asked(name, text, &Request::default())
}

fn asked(name: &str, text: &str, request: &Request<'_>) -> Result<Measured, String> {
    let folder = Folder::new();
    read(&folder.file(name, text.as_bytes()), request).map_err(|e| e.to_string())
}

#[track_caller]
fn is_of(found: &Measured, pixel: [f64; 2], unit: f64) {
    same(found, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
    let Spacing::Metres(p) = found.spacing else { panic!("{:?}", found.spacing) };
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
    assert!(near(p[0], pixel[0]) && near(p[1], pixel[1]), "{p:?}");
    assert!(near(found.height_unit.unwrap(), unit), "{:?}", found.height_unit);
}

#[test]
fn size_pixels_and_units_in_words_are_used() {
    for head in [
        // Gwyddion, in the languages of its users
        "# Channel: Topography\n# Width: 3.00 µm\n# Height: 1.000 µm\n# Value units: nm\n",
        "# Kanal: Topographie\n# Breite: 3,00 µm\n# Höhe: 1,000 µm\n# Value units: nm\n",
        "# Canal : Topographie\n# Largeur : 3,00 µm\n# Hauteur : 1,000 µm\n# Unités : nm\n",
        "# Kanál: Topografie\n# Šířka: 3.00 µm\n# Výška: 1.000 µm\n# Jednotky hodnot: nm\n",
        "# チャンネル: Topography\n# ガガ: 3.00 µm\n# ギギ: 1.000 µm\n# ググ: nm\n",
        "Szerokość: 3,00 µm\nWysokość: 1,000 µm\nJednostka: nm\n",
        "Ширина: 3,00 мкм\nВысота: 1,000 мкм\nЕдиницы: нм\n",
        "Bredd: 3,00 µm\nHöjd: 1,000 µm\nEnhet: nm\n",
        "Breedte: 3,00 µm\nHoogte: 1,000 µm\nEenheid: nm\n",
        "Width: 3.00(um)\nHeight: 1.000(um)\nStart of Data: (nm)\n",
        // key = value
        "x-length = 3\ny-length = 1\nx-unit = µm\nz-unit = nm\n",
        "pixel size = 1 um x 0.5 um\nheight unit = nm\n",
        "Scan Size\t3 µm × 1 µm\nZ units\tnm\n",
        "\"X pixel size [um]\";\"1,0\"\n\"Y pixel size [um]\";\"0,5\"\nHöheneinheit;nm\n",
        "dx (um): 1.0\ndy (um): 500e-3\nData unit: nanometers\n",
        "Wavelength: 632.8 nm\nWidth: 3 um\nHeight: 1 um\nWidth of beam: 7\nunits: nm\n",
    ] {
        is_of(&found("a.txt", &format!("{head}{MAP}")).unwrap(), [1e-6, 0.5e-6], 1e-9);
    }
    let keyence =
        "\"Measurement data\",\"Height\"\n\"XY calibration\",\"1389\",\"nm/pixel\"\n\"Unit\",\"um\"\n";
    let keyence = found("a.csv", &format!("{keyence}\"1\",\"2\",\"3\"\n\"4\",\"\",\"6\"\n")).unwrap();
    is_of(&keyence, [1.389e-6, 1.389e-6], 1e-6);
    let waves = "Wavelength = 632.8 nm\nPixel size = 2 um\nValue unit = waves\n";
    is_of(&found("a.txt", &format!("{waves}{MAP}")).unwrap(), [2e-6; 2], 632.8e-9);
    // SPIP writes sizes in nm and their unit with none
    let spip = "# File Format = ASCII\n# Created by SPIP 6.7.7\n# x-pixels = 3\n# y-pixels = 2\n# x-length = 3000\n\
                # y-length = 1000\n# x-offset = 0\n# z-unit = nm\n# voidpixels =1\n# Start of Data:\n";
    let spip = found("a.asc", &format!("{spip}{MAP}")).unwrap();
    is_of(&spip, [1e-6, 0.5e-6], 1e-9);
    assert!(spip.notes.iter().any(|note| note.contains("SPIP")), "{:?}", spip.notes);
    // Nova of NT-MDT
    let nova = "NX = 3\nNY = 2\nScale X = 1\nScale Y = 0.5\nUnit X = um\nUnit Data = nm\nStart of Data :\n";
    is_of(&found("a.txt", &format!("{nova}{MAP}")).unwrap(), [1e-6, 0.5e-6], 1e-9);
    // numbers of pixels and times are no lengths
    let counts = "Width: 3\nHeight: 2\nDate: 12.05.2024 11:50:04\nCamera gain = 3\n";
    let bare = found("a.txt", &format!("{counts}{MAP}")).unwrap();
    assert_eq!((bare.spacing, bare.height_unit), (Spacing::Unknown, None));
}

/// ESRI: "cellsize"; a sensor: "pitch_x"; people: "Width: 6".
#[test]
fn sizes_without_a_unit_are_kept_as_numbers() {
    for (head, steps) in [
        ("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0.5\nNODATA_value -9999\n", [0.5, 0.5]),
        ("ncols 3\nnrows 2\ndx 0.5\ndy 0.25\n", [0.5, 0.25]),
        ("# x-pixels = 3\n# pitch_x = 0.5\n# pitch_y = 0.25\n# z-unit = um\n", [0.5, 0.25]),
        ("Width: 6\nHeight: 1\nz unit: nm\n", [2.0, 0.5]),
        ("Width: 6\nLength: 1\nHeight: 9\n", [2.0, 0.5]),
    ] {
        let map = found("a.txt", &format!("{head}{MAP}")).unwrap();
        assert_eq!(map.spacing, Spacing::Numbers(steps), "{head}");
    }
}

#[test]
fn values_that_are_no_heights_are_refused_unless_forced() {
    let phase = format!("# Width: 3.00 µm\n# Height: 1.000 µm\n# Value units: deg\n{MAP}");
    let refused = found("a.txt", &phase).unwrap_err();
    assert!(refused.contains("line 3") && refused.contains("\"deg\""), "{refused}");
    assert!(asked("a.txt", &phase, &Request { override_file: true, ..Request::default() }).is_ok());
}

#[test]
fn a_shape_that_is_no_map_is_named() {
    let rising: String = (0..20).map(|i| format!("{}.5;{}\n", i, (i * 7) % 5)).collect();
    let falling: String = (0..20).map(|i| format!("{}\t{}\n", 20 - i, (i * 7) % 5)).collect();
    let single: String = (0..20).map(|i| format!("{}\n", (i * 7) % 5)).collect();
    let across = format!(
        "{}\n{}\n",
        (0..20).map(|i| i.to_string()).collect::<Vec<_>>().join(" "),
        (0..20).map(|i| ((i * 7) % 5).to_string()).collect::<Vec<_>>().join(" ")
    );
    for text in [&rising, &falling, &single, &across] {
        let refused = found("a.txt", text).unwrap_err();
        assert!(refused.contains("profile"), "{refused}");
    }
    let list: String = (0..60).map(|i| format!("{} {} {}\n", i * i % 17, i * i % 13, i % 3)).collect();
    let refused = found("a.txt", &list).unwrap_err();
    assert!(refused.contains("columns = { x"), "{refused}");
}

/// Twelve points of a grid of 4 x 3 with steps 2 and 1, as text.
fn points(scatter: f64, unit: &str) -> String {
    let shift = |i: i32, k: i32| scatter * f64::from((i * 37 + k * 61) % 21 - 10) / 10.0;
    let line = |i: i32| {
        let (x, y) = (f64::from(2 * (i % 4)) + shift(i, 1), f64::from(i / 4) + shift(i, 2));
        format!("{x}{unit}{y}{unit}{}\n", i * i)
    };
    (0..12).map(line).collect()
}

fn is_the_grid(found: &Measured, step: f64) {
    assert_eq!((found.columns, found.rows), (4, 3));
    assert!((0..12).all(|i| found.heights[i] == (i * i) as f64), "{:?}", found.heights);
    let (Spacing::Metres(p) | Spacing::HeightUnits(p)) = found.spacing else { panic!() };
    assert!((p[0] / step - 2.0).abs() < 0.04 && (p[1] / step - 1.0).abs() < 0.04, "{p:?}");
}

#[test]
fn points_are_known_by_name_by_key_or_by_their_grid() {
    is_the_grid(&found("a.xyz", &points(0.0, " ")).unwrap(), 1.0);
    is_the_grid(&found("a.txt", &points(0.0, ";")).unwrap(), 1.0);
    let named = found("a.csv", &format!("X [mm],Y [mm],Z [nm]\n{}", points(0.0, ","))).unwrap();
    is_the_grid(&named, 1e-3);
    assert_eq!((named.height_unit, matches!(named.spacing, Spacing::Metres(_))), (Some(1e-9), true));
    let below = found("a.csv", &format!("x,y,z\nmm,mm,nm\n{}", points(0.0, ","))).unwrap();
    assert_eq!((below.height_unit, below.spacing), (named.height_unit, named.spacing));
    is_the_grid(&found("a.txt", &format!("# x y z\n{}", points(0.0, " "))).unwrap(), 1.0);
    // colours behind the heights
    let coloured = points(0.0, " ").replace('\n', " 255 128 0\n");
    is_the_grid(&found("a.xyz", &coloured).unwrap(), 1.0);
    let swapped: String = points(0.0, " ")
        .lines()
        .map(|line| line.split(' ').rev().collect::<Vec<_>>().join(";") + ";9\n")
        .collect();
    let columns = ["East [um]", "North [um]", "Up [um]"].map(Some);
    let request = Request { columns, ..Request::default() };
    let keyed = asked("a.txt", &format!("Up;North;East;Quality\n{swapped}"), &request).unwrap();
    is_the_grid(&keyed, 1e-6);
    let request = Request { columns: ["3", "2", "1"].map(Some), ..Request::default() };
    is_the_grid(&asked("a.txt", &swapped, &request).unwrap(), 1.0);
}

#[test]
fn points_that_scatter_are_put_on_their_grid_and_clouds_refused() {
    for share in [1e-9, 1e-4, 0.01, 0.04] {
        let near = found("a.xyz", &points(share, " ")).unwrap();
        is_the_grid(&near, 1.0);
        assert_eq!(near.notes.iter().any(|n| n.contains("put on a grid")), share > 1e-3, "{:?}", near.notes);
    }
    for share in [0.15, 0.4] {
        let refused = found("a.xyz", &points(share, " ")).unwrap_err();
        assert!(refused.contains("regular grid"), "{refused}");
    }
    // lines of the grid may be absent, points too
    let gap: String = points(0.001, " ")
        .lines()
        .enumerate()
        .filter(|(i, _)| i % 4 != 2 && *i != 5)
        .map(|(_, line)| format!("{line}\n"))
        .collect();
    let gap = found("a.xyz", &gap).unwrap();
    assert_eq!((gap.columns, gap.rows, gap.heights.iter().filter(|z| z.is_nan()).count()), (4, 3, 4));
}

#[test]
fn coordinates_beside_a_map_are_no_heights() {
    let axes = found("a.csv", ";0,0;0,5;1,0\n0;1;2;3\n0,25;4;;6\n0,5;7;8;9\n").unwrap();
    assert_eq!((axes.columns, axes.rows, axes.heights[3]), (3, 3, 4.0));
    // nothing tells their unit, and that of the heights need not be theirs
    assert_eq!(axes.spacing, Spacing::Unknown);
    assert!(axes.notes.iter().any(|note| note.contains("0.5 and 0.25 and name no unit")), "{:?}", axes.notes);
    let one = found("a.csv", "unit: um\n;0,0;0,5;1,0\n0;1;2;3\n0,25;4;;6\n0,5;7;8;9\n").unwrap();
    assert_eq!(one.spacing, Spacing::HeightUnits([0.5, 0.25]));
    for (names, lateral) in
        [("X [mm], Y [mm], Z [nm]", 1e-3), ("x/y in um; z in nm", 1e-6), ("X/Y [µm]; Z [nm]", 1e-6)]
    {
        let own = found("a.csv", &format!("{names}\n;0,0;0,5;1,0\n0;1;2;3\n0,25;4;;6\n0,5;7;8;9\n")).unwrap();
        assert_eq!(own.spacing, Spacing::Metres([0.5 * lateral, 0.25 * lateral]), "{names}");
        assert_eq!(own.height_unit, Some(1e-9), "{names}");
    }
    // numbers of rows and columns, as a table of a program has them
    let counted = found("a.csv", ",0,1,2\n0,1,2,3\n1,4,,6\n2,7,8,9\n").unwrap();
    assert_eq!((counted.columns, counted.rows, counted.spacing), (3, 3, Spacing::Unknown));
}

#[test]
fn a_number_for_missing_points_is_that_of_the_request() {
    let request = Request { missing_value: Some(-9999.0), ..Request::default() };
    let map = asked("a.txt", "1 2 3\n4 -9999 6\n", &request).unwrap();
    same(&map, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
}

#[test]
fn the_notes_say_what_was_understood() {
    let map = found("a.dat", "# Width: 3 µm\n# Value units: nm\n1,5;2\n3;4\nend\n").unwrap();
    let said = map.notes.join("; ");
    for words in
        ["UTF-8", "semicolons", "decimal commas", "lines 3 to 4", "3 lines of words", "unit of the heights"]
    {
        assert!(said.contains(words), "{said}");
    }
}

/// Rough heights without a line that is straight, um.
fn rough(i: usize, j: usize) -> f64 {
    ((i * 37 + j * 61 + i * j * 7) % 101) as f64 / 100.0
}

/// Rows of a map with `corner` and places above and beside it where asked for.
fn with_places(corner: &str, row: bool, column: bool, step: f64, [nx, ny]: [usize; 2]) -> String {
    let mut text = String::new();
    let line = |cells: Vec<String>| cells.join(",") + "\n";
    let place = |k: usize| format!("{:.2}", k as f64 * step + 0.5);
    if row {
        let first = column.then(|| corner.to_string());
        text += &line(first.into_iter().chain((0..nx).map(place)).collect());
    }
    for j in 0..ny {
        let first = column.then(|| place(j));
        text += &line(first.into_iter().chain((0..nx).map(|i| rough(i, j).to_string())).collect());
    }
    text
}

#[test]
fn places_are_known_whatever_stands_in_their_corner() {
    let sizes = [12, 9];
    for (corner, row, column) in [
        ("", true, true),
        ("0", true, true),
        ("y\\x (um)", true, true),
        ("Height [um]", true, true),
        ("DataLine", true, true),
        ("0.00", true, true),
        ("", false, true),
        ("", true, false),
    ] {
        let text = format!("Unit,um\n{}", with_places(corner, row, column, 0.5, sizes));
        let map = found("a.csv", &text).unwrap();
        assert_eq!([map.columns, map.rows], sizes, "{corner} {:?}", map.notes);
        assert!((0..108).all(|k| (map.heights[k] - rough(k % 12, k / 12)).abs() < 1e-12), "{corner}");
        assert_eq!(map.height_unit, Some(1e-6));
        if !(row && column) {
            // one side alone does not tell the other
            assert_eq!(map.spacing, Spacing::Unknown, "{corner}");
            continue;
        }
        let (Spacing::Metres([x, y]) | Spacing::HeightUnits([x, y])) = map.spacing else {
            panic!("{corner}")
        };
        let unit = if matches!(map.spacing, Spacing::Metres(_)) { 1e-6 } else { 1.0 };
        assert!((x / unit - 0.5).abs() < 1e-9 && (y / unit - 0.5).abs() < 1e-9, "{corner} {x} {y}");
        assert!(map.notes.iter().any(|note| note.contains("not as heights")), "{:?}", map.notes);
    }
    // numbers of rows beside a size in words
    let numbered: String = with_places("", false, true, 1.0, sizes).replace(".50,", ",");
    let map = found("a.csv", &format!("Pixel size,0.5,um\nUnit,um\nX pixels = 12\n{numbered}")).unwrap();
    assert_eq!(([map.columns, map.rows], map.spacing), (sizes, Spacing::Metres([0.5e-6; 2])));
}

#[test]
fn tilted_planes_keep_their_first_row_and_column() {
    type Plane = dyn Fn(usize, usize) -> f64;
    let table = |height: &Plane| -> String {
        let row = |j: usize| (0..12).map(|i| height(i, j).to_string()).collect::<Vec<_>>().join(" ");
        (0..10).map(|j| row(j) + "\n").collect()
    };
    let planes: [(&str, &Plane); 6] = [
        ("along x", &|i, _| i as f64),
        ("along y", &|_, j| 0.25 * j as f64),
        ("along both", &|i, j| 0.5 * i as f64 + 2.0 * j as f64),
        ("twisted", &|i, j| (i + 1) as f64 * (j + 1) as f64),
        ("of whole numbers", &|i, j| (1.04 * j as f64 + 0.01 * i as f64).round()),
        ("with a hole", &|i, j| if (i, j) == (1, 4) { NAN } else { j as f64 }),
    ];
    for (name, height) in planes {
        let map = found("a.txt", &table(height)).unwrap();
        assert_eq!([map.columns, map.rows], [12, 10], "{name} {:?}", map.notes);
    }
}

#[test]
fn numbers_of_columns_and_rows_in_words_must_be_those_of_the_map() {
    let body: String = (0..4).map(|j| format!("{} {} {}\n", rough(0, j), rough(1, j), rough(2, j))).collect();
    for (words, line, counts) in [
        ("X pixels = 2\nY pixels = 4\n", 1, ["2 columns", "3 were found"]),
        ("ncols 3\nnrows 5\n", 2, ["5 rows", "4 were found"]),
        ("Width [px]: 4\nWidth [um]: 3\n", 1, ["4 columns", "3 were found"]),
    ] {
        let refused = found("a.txt", &format!("{words}{body}")).unwrap_err();
        assert!(refused.contains(&format!("line {line}")), "{refused}");
        assert!(counts.iter().all(|count| refused.contains(count)), "{refused}");
        let forced = Request { override_file: true, ..Request::default() };
        assert!(asked("a.txt", &format!("{words}{body}"), &forced).is_ok());
    }
    assert!(found("a.txt", &format!("X pixels = 3\nY pixels: 4 px\n{body}")).is_ok());
}

#[test]
fn marks_of_missing_points_are_honoured_or_asked_for() {
    for words in
        ["ncols 3\nnrows 2\nNODATA_value -9999\n", "Invalid value: -9999\n", "# missing_value = -9999\n"]
    {
        let map = found("a.txt", &format!("{words}1 2 3\n4 -9999 6\n")).unwrap();
        same(&map, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
        assert!(
            map.notes.iter().any(|note| note.contains("1 points of -9999 are missing")),
            "{:?}",
            map.notes
        );
    }
    let points =
        found("a.xyz", "# no data value: -9999\n0 0 1\n2 0 2\n4 0 3\n0 1 4\n2 1 -9999\n4 1 6\n").unwrap();
    same(&points, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
    for mark in [-32768.0, -9999.0, 32767.0, 9999.0] {
        let text = format!("1 2 3\n4 {mark} 6\n");
        let refused = found("a.txt", &text).unwrap_err();
        assert!(refused.contains(&format!("missing_value = {mark}")), "{refused}");
        let told = Request { missing_value: Some(mark), ..Request::default() };
        same(&asked("a.txt", &text, &told).unwrap(), [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
        let forced = Request { override_file: true, ..Request::default() };
        assert_eq!(asked("a.txt", &text, &forced).unwrap().heights[4], mark);
    }
    // zeros apart from heights of many digits, and a floor of a map that a program made
    let zeros = "3.12161 2.94512 0 2.76613\n0 2.62104 4.52295 2.47166\n2.46757 0 2.51078 2.59399\n";
    assert!(found("a.txt", zeros).unwrap_err().contains("missing_value = 0"));
    assert!(found("a.txt", &zeros.replace("2.4", "0.2")).is_ok());
    assert!(found("a.txt", "3 2 0 3\n0 2 4 2\n2 0 2 2\n").is_ok());
    // a height among others
    assert!(found("a.txt", "9000 9500 9999\n8000 8100 9800\n").is_ok());
}

#[test]
fn one_size_gives_square_pixels_or_none() {
    let wide = "1 2 3\n4 nan 6\n";
    let map = found("a.txt", &format!("Scan size: 6 um\nZ unit: nm\n{wide}")).unwrap();
    is_of(&map, [2e-6; 2], 1e-9);
    assert!(map.notes.iter().any(|note| note.contains("square")), "{:?}", map.notes);
    for (words, body) in
        [("Scan size: 6 um\nAspect ratio: 1:1\n", wide), ("Scan size: 6 um\n", "1 2\n3 nan\n5 6\n")]
    {
        assert_eq!(found("a.txt", &format!("{words}{body}")).unwrap().spacing, Spacing::Unknown, "{words}");
    }
    let sides =
        found("a.txt", &format!("Width: 6 um\nLength: 2 um\nHeight: 0.5 um\nunit: nm\n{wide}")).unwrap();
    is_of(&sides, [2e-6, 1e-6], 1e-9);
    let thin = found("a.txt", &format!("dx = 2 um\ndy = 0.5 um\nunit: nm\n{wide}")).unwrap();
    assert!(thin.notes.iter().any(|note| note.contains("very unequal")), "{:?}", thin.notes);
}

#[test]
fn a_factor_beside_whole_numbers_is_refused_unless_forced() {
    for (words, is_factor) in [
        ("Scale Data = 0.1", true),
        ("Z scale: 0.1 nm/digit", false),
        ("Height factor: 10", true),
        ("Bit2nm = 0.3", false),
    ] {
        let text = format!("Pixel size: 1 um\nZ unit: nm\n{words}\n{MAP}");
        let refused = found("a.txt", &text).unwrap_err();
        assert!(refused.contains("line 3") && refused.contains("override = true"), "{refused}");
        let forced = Request { override_file: true, ..Request::default() };
        assert!(asked("a.txt", &text, &forced).is_ok());
        // fractions are no digits of a converter; a factor may go with them all the same
        let fractions = found("a.txt", &text.replace("3\n", "3.5\n").replace("0.3.5", "0.3"));
        assert_eq!(fractions.is_err(), is_factor, "{words}");
    }
    assert!(found("a.txt", &format!("Scale Data = 1\nUnit Data = nm\n{MAP}")).is_ok());
}

#[test]
fn micrometres_are_known_in_every_spelling() {
    for unit in ["um", "µm.", "mkm", "мкм", "microns", "[um]", "Micrometers"] {
        let map = found("a.txt", &format!("Pixel size: 1 um\nZ unit: {unit}\n{MAP}")).unwrap();
        is_of(&map, [1e-6; 2], 1e-6);
    }
    let refused = found("a.txt", &format!("Z unit: mym\n{MAP}")).unwrap_err();
    assert!(refused.contains("\"mym\"") && refused.contains("not known"), "{refused}");
}

/// As ProfilmOnline exports a map, with point or comma before decimals, and as a spreadsheet saves it again.
#[test]
fn sizes_that_stand_below_their_names_are_used() {
    let rows = "1\t2\t3\t4\t5\t6\n7\t8\t9\t10\t11\t12.5\n3\t1\t2\t1\t0\t2\n";
    let head = "numCols\tnumRows\tpixelSize (um)\n6\t3\t1.25\n";
    let text = format!("{head}Z-data (nm)\n{rows}");
    let padded = format!(
        "numCols,numRows,pixelSize (um),,,\n6,3,1.25,,,\nZ-data (nm),,,,,\n{}",
        rows.replace('\t', ",")
    );
    let notes = format!("# numCols\tnumRows\tpixelSize (um)\n# 6\t3\t1.25\n# Z-data (nm)\n{rows}");
    for text in [text.clone(), text.replace('.', ","), padded, notes, text.replace('\t', ";")] {
        let map = found("a.txt", &text).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!((map.columns, map.rows, map.heights[11]), (6, 3, 12.5), "{text}");
        assert!(
            matches!(map.spacing, Spacing::Metres([x, y]) if x == y && (x / 1.25e-6 - 1.0).abs() < 1e-12)
        );
        assert_eq!(map.height_unit, Some(1e-9), "{text}");
    }
    let wide = "1,2,4\n".replace('\n', &",3".repeat(100)) + "\n";
    let wide = format!("pixelSize (um){0}\n1.25{0}\nZ-data (nm){0}\n{wide}{wide}{wide}", ",".repeat(102));
    assert_eq!(found("a.csv", &wide).unwrap().height_unit, Some(1e-9));
    // without a word between the values and the heights
    let map = found("a.txt", &format!("{head}{rows}")).unwrap();
    assert_eq!((map.columns, map.rows, map.height_unit), (6, 3, None));
    let fault = found("a.txt", &text.replace("6\t3\t", "6\t4\t")).unwrap_err();
    assert!(fault.contains('4'), "{fault}");
    // names above rows as long as the others are those of points
    let points = "x_um\ty_um\tz_nm\n0\t0\t1\n1\t0\t2\n0\t1\t3\n1\t1\t4\n";
    let map = found("a.txt", points).unwrap();
    assert_eq!((map.columns, map.rows, map.heights[0]), (2, 2, 1.0));
}

/// Numbers that are no heights by themselves, and a unit that is none of the places.
#[test]
fn places_and_factors_that_are_not_told_are_asked_for() {
    let rows = "0\t.1\t.2\t.3\n.1\t.3\t.1\t.2\n.2\t.1\t.4\t.1\n";
    for (name, text, why) in [
        ("a.txt", format!("Pixel size: 0.5 um\nHeights in 0.1 um\n{rows}"), "to be multiplied"),
        ("a.txt", format!("Pixel size: 0.5 um\nHöhen in 1/10 µm\n{rows}"), "to be multiplied"),
        ("a.int", "title\nGRD 3 2 SUR WVL 0.6328 SSZ 10000 NDA -32768\n1 4 -4\n3 2 5\n".into(), "WVL/SSZ"),
        (
            "a.dat",
            "3 2 0.5 0.5 0 0 0\n0 0 0 0\n1 0 0 0\n2 0 0 0\n0 0 0 0\n3 0 0 0\n1 0 0 0\n".into(),
            "Zemax",
        ),
        (
            "a.dat",
            "VARIABLES = \"X\", \"Y\", \"Z\"\nZONE I=3, J=2, F=BLOCK\n0 1 2\n0 1 2\n".into(),
            "F=POINT",
        ),
    ] {
        let fault = found(name, &text).expect_err(&text);
        assert!(fault.contains(why), "{text}: {fault}");
    }
    let optics =
        found("a.txt", &format!("Lateral resolution (optical): 1.22 um\nHeights in um\n{rows}")).unwrap();
    assert_eq!((optics.spacing, optics.height_unit), (Spacing::Unknown, Some(1e-6)));
    let points = "0,0,1\n0.5,0,2\n1,0,3\n0,0.5,4\n0.5,0.5,5\n1,0.5,6\n";
    let of_z = found("a.csv", &format!("x,y,z_nm\n{points}")).unwrap();
    assert_eq!((of_z.spacing, of_z.height_unit), (Spacing::Unknown, Some(1e-9)));
    assert!(of_z.notes.iter().any(|note| note.contains("pixel_size = \"0.5 um\"")), "{:?}", of_z.notes);
    let none = found("a.csv", &format!("x,y,z\n{points}")).unwrap();
    assert_eq!((none.spacing, none.height_unit), (Spacing::HeightUnits([0.5; 2]), None));
    let tecplot = points.replace(',', " ");
    let head = "TITLE = \"map\"\nVARIABLES = \"X [um]\", \"Y [um]\", \"Z [nm]\"\nZONE I=3, J=2, F=POINT\n";
    let tecplot = found("a.dat", &format!("{head}{tecplot}")).unwrap();
    assert_eq!((tecplot.spacing, tecplot.height_unit), (Spacing::Metres([0.5e-6; 2]), Some(1e-9)));
}

/// As stylus instruments write the distance of points along a line and that of lines.
#[test]
fn points_and_lines_have_distances_of_their_own() {
    for words in ["Punktabstand: 1,0 um\nProfilabstand: 0,5 um", "Point spacing: 1 um\nLine spacing: 0.5 um"]
    {
        is_of(&found("a.txt", &format!("{words}\nEinheit Z: nm\n{MAP}")).unwrap(), [1e-6, 0.5e-6], 1e-9);
    }
    let alone = found("a.txt", &format!("Punktabstand: 1,0 um\nEinheit Z: nm\n{MAP}")).unwrap();
    is_of(&alone, [1e-6; 2], 1e-9);
    let both = found("a.txt", &format!("Pixel size: 1 um\nLine spacing: 0.5 um\nZ unit: nm\n{MAP}")).unwrap();
    assert_eq!(both.spacing, Spacing::Unknown);
}

/// Columns that differ by their letters alone, as programs for images of strain write pixels and places.
#[test]
fn a_key_names_a_column_letter_by_letter() {
    let text = "x,y,X,Y,Z\n0,0,0,0,1\n5,0,1,0,2\n10,0,2,0,3\n0,5,0,1,4\n5,5,1,1,5\n10,5,2,1,6\n";
    let columns = [Some("X [mm]"), Some("Y [mm]"), Some("Z [mm]")];
    let map = asked("a.csv", text, &Request { columns, ..Request::default() }).unwrap();
    assert_eq!((map.spacing, map.height_unit), (Spacing::Metres([1e-3; 2]), Some(1e-3)));
}
