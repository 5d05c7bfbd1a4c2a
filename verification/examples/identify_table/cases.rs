//! The cases: metals that are known, and the fits that are to find them.

use asperity::tables::{
    Accuracy, HardeningChoice, Loading, Material, Output, Scene as Tables, Symmetry, Tool,
};
use asperity::units::MICROMETRE;
use asperity::{Crush, Length, Scene, Stress, crush};
use asperity_calibration::fit::SplitMix;
use asperity_verification::twins::Normal;
use rayon::prelude::*;
use std::collections::HashMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A known metal and the fit that is to find it. Law `swift`.
pub struct Case {
    pub name: String,
    /// GPa; of aluminium E*.
    pub youngs_modulus: f64,
    /// MPa.
    pub yield_stress: f64,
    pub exponent: f64,
    /// Stresses of a tensile test, by plastic strain, where the law does not give them.
    pub stresses: Vec<(f64, f64)>,
    /// The fit file.
    pub fit: String,
    /// Folder of the files that it names.
    pub folder: PathBuf,
}

impl Case {
    /// Yield stress at a plastic strain, MPa.
    pub fn stress(&self, strain: f64) -> f64 {
        let given = self.stresses.iter().find(|s| s.0 == strain);
        given.map_or_else(
            || {
                self.yield_stress
                    * (1.0 + 1e3 * self.youngs_modulus * strain / self.yield_stress).powf(self.exponent)
            },
            |s| s.1,
        )
    }
}

/// The numbers of the rows of a table, by the names of its columns.
pub fn rows(path: &Path) -> Vec<HashMap<String, f64>> {
    let mut reader = csv::Reader::from_path(path).expect("the data");
    let names: Vec<String> = reader.headers().expect("a header").iter().map(str::to_string).collect();
    let row = |record: csv::StringRecord| {
        names.iter().cloned().zip(record.iter().map(|c| c.parse().unwrap_or(f64::NAN))).collect()
    };
    reader.records().map(|r| row(r.expect("a row"))).collect()
}

/// Deepest depth of the published unloading slopes, µm, by their text.
pub const DEPTH: f64 = 0.2;

/// Published results of one metal under a cone of 60° half apex angle, and under one of 50° where there are.
pub struct Published {
    /// GPa.
    pub youngs_modulus: f64,
    /// GPa.
    pub yield_stress: f64,
    pub exponent: f64,
    /// Loading curvatures under 60° and 50°, GPa.
    pub curvatures: [Option<f64>; 2],
    /// Unloading slope under 60°, N/m.
    pub slope: f64,
}

/// The published metals of one series.
pub fn series(folder: &Path) -> Vec<Published> {
    let (sixty, fifty) = (rows(&folder.join("FEM_60deg.csv")), rows(&folder.join("FEM_50deg.csv")));
    let key = |r: &HashMap<String, f64>| ["E (GPa)", "sy (GPa)", "n"].map(|k| (1e4 * r[k]).round() as i64);
    let second: HashMap<_, f64> = fifty.iter().take(SERIES).map(|r| (key(r), r["C (GPa)"])).collect();
    let metal = |r: &HashMap<String, f64>| Published {
        youngs_modulus: r["E (GPa)"],
        yield_stress: r["sy (GPa)"],
        exponent: r["n"],
        curvatures: [Some(r["C (GPa)"]), second.get(&key(r)).copied()],
        slope: r["dP/dh (N/m)"],
    };
    sixty.iter().take(SERIES).map(metal).collect()
}

/// Rows of the published tables that are one series.
const SERIES: usize = 76;

/// Inputs and unknowns of a fit of the published metals.
#[derive(Clone, Copy, PartialEq)]
pub enum Asked {
    /// Curvatures under two cones; E is known.
    TwoCones,
    /// Curvature and unloading slope under 60°; E is known.
    OneCone,
    /// Curvatures under two cones and the unloading slope under 60°; E is sought.
    Modulus,
}

/// Fits of the published metals.
pub fn published(metals: &[Published], asked: Asked) -> Vec<Case> {
    let one = |p: &Published| {
        let (e, s, n) = (p.youngs_modulus, 1e3 * p.yield_stress, p.exponent);
        let known = format!("\"{e} GPa\"");
        let modulus = if asked == Asked::Modulus { "[\"5 GPa\", \"500 GPa\"]" } else { &known };
        let mut fit = material(modulus, 0.3, ["10 MPa", "10 GPa"]);
        let slope = format!(", unloading_slope = \"{} N/m\", max_depth = \"{DEPTH} um\"", p.slope);
        let sixty = if asked == Asked::TwoCones { "" } else { &slope };
        let noise = if asked == Asked::TwoCones { "0.3 %" } else { "2 %" };
        let fifty = p.curvatures[1].filter(|_| asked != Asked::OneCone).map(|c| (50, c, "", "0.3 %"));
        let first = p.curvatures[0].map(|c| (60, c, sixty, noise));
        for (angle, curvature, more, noise) in first.into_iter().chain(fifty) {
            let _ = write!(
                fit,
                "[[curve]]\nfeatures = {{ loading_curvature = \"{curvature} GPa\"{more} }}\ntool = {{ shape = \"cone\", half_apex_deg = {angle} }}\nnoise = \"{noise}\"\nmodel_error = \"1.5 %\"\n"
            );
        }
        Case {
            name: format!("E {e} GPa, σ_y {s} MPa, n {n}"),
            youngs_modulus: e,
            yield_stress: s,
            exponent: n,
            stresses: Vec::new(),
            fit,
            folder: PathBuf::new(),
        }
    };
    metals.iter().map(one).collect()
}

/// The head of a fit file: the metal that is sought.
pub fn material(modulus: &str, poissons_ratio: f64, [low, high]: [&str; 2]) -> String {
    format!(
        "accuracy = \"standard\"\nsamples = 0\n[material]\nyoungs_modulus = {modulus}\npoissons_ratio = {poissons_ratio}\nyield_stress = [\"{low}\", \"{high}\"]\nhardening_exponent = [0.0, 0.5]\nhardening_law = \"swift\"\n"
    )
}

/// Indents in aluminium: the diamond's compliance is in their E*, so the tool is rigid and E the one
/// that gives it.
pub fn aluminium(folder: &Path) -> Vec<Case> {
    of_aluminium(&folder.join("Al6061.csv"), "tool = { shape = \"berkovich\" }\n", true)
}

/// Fits of the indents in `file`, with the tool as `tool` says it, with or without the unloading slope.
pub fn of_aluminium(file: &Path, tool: &str, with_slope: bool) -> Vec<Case> {
    let of = |(i, r): (usize, &HashMap<String, f64>)| {
        let (reduced, nu) = (r["E* (GPa)"], 0.33);
        let modulus = reduced * (1.0 - nu * nu);
        let slope = format!("unloading_slope = \"{} N/m\", ", r["dP/dh (N/m)"]);
        let slope = if with_slope { slope.as_str() } else { "" };
        let mut fit = material(&format!("\"{modulus} GPa\""), nu, ["20 MPa", "2 GPa"]);
        let _ = write!(
            fit,
            "[[curve]]\nfeatures = {{ loading_curvature = \"{} GPa\", {slope}plastic_work_ratio = {}, max_depth = \"{} um\" }}\n{tool}noise = \"2 %\"\n",
            r["C (GPa)"], r["Wp/Wt"], r["hm (um)"]
        );
        let stress = |strain: f64, key: &str| (strain, 1e3 * r[key]);
        Case {
            name: format!("aluminium, test {}", i + 1),
            youngs_modulus: reduced,
            yield_stress: 1e3 * r["sy (GPa)"],
            exponent: r["n"],
            stresses: vec![
                stress(0.033, "s0.033 (GPa)"),
                stress(0.066, "s0.066 (GPa)"),
                stress(0.1, "s0.1 (GPa)"),
            ],
            fit,
            folder: PathBuf::new(),
        }
    };
    rows(file).iter().enumerate().map(of).collect()
}

/// Metals drawn with a fixed seed, indented by a cone of 70.3° and by a ball at `standard`, their forces with
/// noise of 0.5 %.
pub fn twins(count: usize) -> Vec<Case> {
    let folder = std::env::temp_dir().join(concat!("asperity-twins-", env!("CARGO_PKG_VERSION")));
    std::fs::create_dir_all(&folder).expect("can be made");
    let mut draw = SplitMix(2024);
    let mut uniform = || (draw.bits() >> 11) as f64 / (1_u64 << 53) as f64;
    let metals: Vec<[f64; 3]> = (0..count)
        .map(|_| [50.0 * 4.2_f64.powf(uniform()), 40.0 * 10_f64.powf(uniform()), 0.05 + 0.4 * uniform()])
        .collect();
    let one = |(i, [e, ratio, n]): (usize, [f64; 3])| {
        let (e, s, n) = ((10.0 * e).round() / 10.0, (1e3 * e / ratio).round(), (1e3 * n).round() / 1e3);
        for (name, tool) in [("cone", Tool::cone(19.7)), ("ball", Tool::sphere(Length(10e-6)))] {
            let file = folder.join(format!("{name}-{i}.csv"));
            if !file.exists() {
                std::fs::write(&file, curve([e, s, n], tool, i as u64 + 1000 * u64::from(name == "ball"))?)
                    .ok()?;
            }
        }
        let mut fit = material("[\"30 GPa\", \"300 GPa\"]", 0.3, ["50 MPa", "10 GPa"]);
        let _ = write!(
            fit,
            "[[curve]]\nfile = \"cone-{i}.csv\"\ntool = {{ shape = \"cone\", half_apex_deg = 70.3 }}\nnoise = \"0.5 %\"\n[[curve]]\nfile = \"ball-{i}.csv\"\ntool = {{ shape = \"sphere\", radius = \"10 um\" }}\nnoise = \"0.5 %\"\n"
        );
        Some(Case {
            name: format!("twin {i}"),
            youngs_modulus: e,
            yield_stress: s,
            exponent: n,
            stresses: Vec::new(),
            fit,
            folder: folder.clone(),
        })
    };
    metals.into_par_iter().enumerate().with_max_len(1).filter_map(one).collect()
}

/// The crush of a metal (GPa, MPa, n) by `tool` to `depth` and back; none where it stops.
pub fn indented([e, s, n]: [f64; 3], tool: Tool, depth: Length, level: Accuracy) -> Option<Crush> {
    let mut metal = Material::elastic_body(Stress(1e9 * e), 0.3).yielding(Stress(1e6 * s), n);
    metal.hardening_law = HardeningChoice::Swift;
    let loading = Loading::to_depth(depth).unloaded();
    // the fields of the last increment alone
    let output = Output { every: Some(usize::MAX), fields: None };
    let tables = Tables::new(Symmetry::Axisymmetric, metal, tool, loading).with_accuracy(level);
    let tables = Tables { output, ..tables };
    let done = crush(&Scene::new(&tables).ok()?, &mut |_| true).ok()?;
    done.summary.stopped.is_none().then_some(done)
}

/// A curve with noise on its forces, as a table.
fn curve(metal: [f64; 3], tool: Tool, seed: u64) -> Option<String> {
    let done = indented(metal, tool, Length(1e-6), Accuracy::Standard)?;
    let mut noise = Normal(SplitMix(seed));
    let mut text = "depth_um,force_mN\n".to_string();
    for row in &done.curve {
        let normal = noise.draw();
        let _ =
            writeln!(text, "{:.6},{:.8}", row.depth / MICROMETRE, 1e3 * row.force * (1.0 + 0.005 * normal));
    }
    (text.lines().count() > 10).then_some(text)
}
