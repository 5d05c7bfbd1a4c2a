//! Presses a plane on a generated surface by every closure and prints the table.
//!
//! `cargo run --release -p asperity --example rough_surface`

#![allow(clippy::print_stdout, reason = "an example prints")]

use asperity::{RoughScene, press};
use std::path::Path;

/// A sanded surface of steel under 100 MPa; the coefficient is that of the program's own calibration.
const SCENE: &str = r#"
closure = "all"
[surface.generate]
kind = "sanded"
ra = "1 um"
mean_slope_deg = 8
size = ["0.5 mm", "0.5 mm"]
pixels = [256, 256]
seed = 1
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
hardness = "1280 MPa"
[load]
pressure = "100 MPa"
unload = true
"#;

fn main() -> Result<(), asperity::Error> {
    let scene = RoughScene::from_toml(SCENE, Path::new(""))?;
    let rough = press(&scene, &mut |progress| {
        println!("{:>3.0} %  {}", 100.0 * progress.share, progress.news.map_or("", |c| c.name()));
        true
    })?;
    println!("{}", rough.text());
    for row in &rough.table {
        println!("{:<10} carries on {:.2} % of the area", row.closure.name(), 100.0 * row.contact_area_ratio);
    }
    // the calibrated cone needs yield_stress and hardening_exponent: it is skipped with a warning
    rough.summary.warnings.iter().for_each(|warning| println!("{warning}"));
    Ok(())
}
