//! A crush of a scene built in code, a sweep of six cones with its fit, and a generated surface under every
//! closure: the numbers that the commands `crush`, `calibrate` and `rough` write.
//!
//! `cargo run --release -p asperity --example library_tour`

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity::calibrate::Options;
use asperity::tables::{Accuracy, Asperity, Loading, Material, Scene as Tables, Symmetry, Tool};
use asperity::{Error, Length, RoughScene, Scene, Stress, Sweep, calibrate, crush, press};
use std::path::Path;

/// A micrometre in metres.
const UM: f64 = 1e-6;

const SURFACE: &str = r#"
closure = "all"
[surface.generate]
kind = "milled"
ra = "2.95 um"
mean_slope_deg = 4.08
size = ["1 mm", "1 mm"]
pixels = [256, 256]
seed = 1
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
hardness = "1280 MPa"
[load]
pressure = "100 MPa"
"#;

fn main() -> Result<(), Error> {
    let steel = Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), 0.3);
    let loading = Loading::to_depth(Length(5.0 * UM)).unloaded();
    let tables = Tables::new(Symmetry::Axisymmetric, steel, Tool::plane(), loading)
        .with(Asperity::cone(Length(20.0 * UM), 10.0).rounded(Length(10.0 * UM)))
        .with_accuracy(Accuracy::Draft);
    let crushed = crush(&Scene::new(&tables)?, &mut |_| true)?;
    println!("peak force {} N", crushed.summary.peak_force);

    let sweep = Sweep {
        slopes_deg: vec![8.0],
        youngs_modulus: vec![Stress(210e9)],
        yield_stress: [200e6, 400e6, 800e6].map(Stress).to_vec(),
        hardening_exponent: vec![0.1, 0.4],
        accuracy: Accuracy::Draft,
        ..Sweep::default()
    };
    let swept = calibrate(&sweep, &Options::default(), &mut |_| true)?;
    swept.cases.iter().for_each(|case| println!("K/E {}", case.K_over_E.unwrap_or(f64::NAN)));
    for angle in &swept.fit.per_angle {
        println!("scatter {}", angle.scatter);
    }
    // six cones of one slope collapse for many strains: the fit says so instead of a coefficient
    println!("c {:?}: {}", swept.fit.coefficient, swept.fit.reason.as_deref().unwrap_or("determined"));

    let rough = press(&RoughScene::from_toml(SURFACE, Path::new("."))?, &mut |_| true)?;
    rough.table.iter().for_each(|row| println!("{} {}", row.closure.name(), row.contact_area_ratio));
    Ok(())
}
