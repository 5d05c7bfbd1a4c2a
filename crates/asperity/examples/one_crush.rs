//! One crush of a scene built in code: prints the force with its error.

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity::tables::{Accuracy, Asperity, Loading, Material, Scene as Tables, Symmetry, Tool};
use asperity::{Error, Length, Scene, Stress, crush};

fn main() -> Result<(), Error> {
    let steel = Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), 0.3);
    let cone = Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6));
    let loading = Loading::to_depth(Length(5e-6)).unloaded();
    let tables = Tables::new(Symmetry::Axisymmetric, steel, Tool::plane(), loading).with(cone);
    let result = crush(&Scene::new(&tables.with_accuracy(Accuracy::Draft))?, &mut |_| true)?;
    let summary = &result.summary;
    println!("{:.3} N at {:.3} um", summary.peak_force, 1e6 * summary.peak_depth);
    println!("error within {:.1} %", 100.0 * summary.estimated_error);
    println!("residual depth {:.3} um", 1e6 * summary.residual_depth.unwrap_or(f64::NAN));
    Ok(())
}
