//! An own hardening law: Voce's σ = σ_s - (σ_s - σ_y) exp(-ε_p/ε_0) as a table, and a crush with it.

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity::tables::{Accuracy, Asperity, Loading, Material, Scene as Tables, Symmetry, Tool};
use asperity::{Error, Length, Scene, Stress, crush};

fn main() -> Result<(), Error> {
    let voce = |strain: f64| 600e6 - 300e6 * (-strain / 0.1).exp();
    // linear between the points, constant beyond the last; chords of a step s lie s²/8 |σ''| below the law,
    // which no stated error includes: a step of ε_0/100 does not show
    let table = (0..=1200).map(|i| 0.001 * f64::from(i)).map(|strain| (strain, Stress(voce(strain))));
    let material = Material::elastic_body(Stress(210e9), 0.3).hardening_by(table);
    let loading = Loading::to_depth(Length(5e-6));
    let tables = Tables::new(Symmetry::Axisymmetric, material, Tool::plane(), loading)
        .with(Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6)))
        .at(Accuracy::Draft);
    let summary = crush(&Scene::new(&tables)?, &mut |_| true)?.summary;
    println!("{:.3} N at {:.3} um", summary.peak_force, 1e6 * summary.peak_depth);
    println!("mean pressure {:.0} MPa", 1e-6 * summary.peak_force / summary.contact_area);
    Ok(())
}
