//! The example of the front page: a scene as text, crushed.

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity::{Scene, crush};
use std::path::Path;

fn main() -> Result<(), asperity::Error> {
    let text = r#"
        symmetry = "axisymmetric"
        material = { youngs_modulus = "210 GPa", poissons_ratio = 0.3, yield_stress = "300 MPa", hardening_exponent = 0.3 }
        asperity = [{ height = "20 um", slope_deg = 10, tip_radius = "10 um" }]
        tool = { shape = "plane" }
        loading = { depth = "5 um" }
    "#;
    let scene = Scene::from_toml(text, Path::new("."))?;
    println!("{} N", crush(&scene, &mut |_| true)?.summary.peak_force);
    Ok(())
}
