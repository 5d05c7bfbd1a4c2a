//! The functions of the library against each other: a surface in memory and in a file, a sweep whole and
//! stopped.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity::calibrate::{CaseRow, Fit, Options};
use asperity::output::Directory;
use asperity::{RoughScene, Sweep, calibrate, press};
use std::path::Path;

const REST: &str = r#"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
hardness = "1280 MPa"
[load]
pressure = "50 MPa"
unload = true
"#;

#[test]
fn heights_in_memory_give_the_table_of_their_file() {
    let folder = tempfile::tempdir().unwrap();
    let height = |i: usize| 1e-6 * (0.9 * (i % 24) as f64).sin() * (1.3 * (i / 24) as f64).cos();
    let heights: Vec<f64> = (0..24 * 20).map(height).collect();
    let lines: Vec<String> =
        heights.chunks(24).map(|row| row.iter().map(f64::to_string).collect::<Vec<_>>().join(",")).collect();
    std::fs::write(folder.path().join("z.csv"), lines.join("\n")).unwrap();
    let surface = "closure = \"johnson\"\n[surface]\nfile = \"z.csv\"\nheight_unit = \"m\"\npixel_size = [\"2 um\", \"1 um\"]\n";
    let file = RoughScene::from_toml(&format!("{surface}{REST}"), folder.path()).unwrap();
    let bare = format!("closure = \"johnson\"\n[surface]\n{REST}");
    let memory = RoughScene::from_toml(&bare, Path::new("")).unwrap();
    assert!(press(&memory, &mut |_| true).unwrap_err().to_string().contains("name a file"));
    let memory = memory.with_heights(24, [2e-6, 1e-6], heights);
    let (file, memory) = (press(&file, &mut |_| true).unwrap(), press(&memory, &mut |_| true).unwrap());
    assert_eq!(file.load_curve, memory.load_curve);
    assert_eq!(file.table[0].separation_um, memory.table[0].separation_um);
    // summary.json reads back as its type
    let summary: asperity::rough::Summary = serde_json::from_str(&file.json().unwrap()).unwrap();
    assert_eq!(summary.closures[0].row.asperities, file.table[0].asperities);
}

#[test]
fn an_observer_ends_a_sweep_that_keeps_its_rows_and_resumes() {
    let folder = tempfile::tempdir().unwrap();
    let text = "slopes_deg = [5, 9]\nyield_stress = [\"300 MPa\"]\nyoungs_modulus = [\"210 GPa\"]\nhardening_exponent = [0.1, 0.3, 0.5]\naccuracy = \"draft\"\n";
    std::fs::write(folder.path().join("sweep.toml"), text).unwrap();
    let sweep: Sweep = asperity::calibrate::read_sweep(Some(&folder.path().join("sweep.toml")), &[]).unwrap();
    let journal = Some(folder.path().join("journal"));
    let options = Options { threads: 1, journal, ..Options::default() };
    let part = calibrate(&sweep, &options, &mut |p| p.done < 2).unwrap();
    assert!(part.stopped && !part.whole && part.cases.len() == 2);
    let mut resumed = 0;
    let whole = calibrate(&sweep, &options, &mut |p| {
        resumed += usize::from(p.news.is_none()) * p.done;
        true
    })
    .unwrap();
    assert_eq!((resumed, whole.cases.len()), (2, 6));
    assert_eq!(whole.cases[..2], part.cases[..]);
    // the files read back as the types that wrote them
    let out = folder.path().join("out");
    whole.write(&mut Directory::create(&out).unwrap()).unwrap();
    let rows = CaseRow::read(std::fs::File::open(out.join("cases.csv")).unwrap()).unwrap();
    assert_eq!(rows, whole.cases);
    let fit: Fit = serde_json::from_str(&std::fs::read_to_string(out.join("fit.json")).unwrap()).unwrap();
    assert_eq!((fit.cases, fit.coefficient), (6, whole.fit.coefficient));
}
