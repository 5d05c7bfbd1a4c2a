//! An own hardening law, a power law with a transient at small strains, and a crush with it.

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity::tables::{Accuracy, Asperity, Loading, Material, Scene as Tables, Symmetry, Tool};
use asperity::{Error, FlowCurve, Length, Scene, Stress, crush};
use std::sync::Arc;

/// σ = σ_y (1 + ε_p/ε_0)^n + σ_t (1 - exp(-ε_p/ε_t)), Pa.
#[derive(Debug)]
struct WithTransient {
    yield_stress: f64,
    exponent: f64,
    strain: f64,
    transient: f64,
    transient_strain: f64,
}

impl FlowCurve for WithTransient {
    fn name(&self) -> &str {
        "power-law-with-transient"
    }

    fn parameters(&self) -> Vec<(&str, f64)> {
        vec![
            ("yield_stress_Pa", self.yield_stress),
            ("exponent", self.exponent),
            ("strain", self.strain),
            ("transient_Pa", self.transient),
            ("transient_strain", self.transient_strain),
        ]
    }

    fn flow(&self, plastic_strain: f64) -> [f64; 2] {
        let grown = 1.0 + plastic_strain / self.strain;
        let power = self.yield_stress * grown.powf(self.exponent);
        let left = (-plastic_strain / self.transient_strain).exp();
        [
            power + self.transient * (1.0 - left),
            self.exponent * power / (grown * self.strain) + self.transient * left / self.transient_strain,
        ]
    }
}

fn main() -> Result<(), Error> {
    let law = WithTransient {
        yield_stress: 250e6,
        exponent: 0.3,
        strain: 0.01,
        transient: 60e6,
        transient_strain: 0.02,
    };
    let material = Material::elastic_body(Stress(210e9), 0.3).hardening_as(Arc::new(law));
    let tables =
        Tables::new(Symmetry::Axisymmetric, material, Tool::plane(), Loading::to_depth(Length(5e-6)))
            .with(Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6)))
            .with_accuracy(Accuracy::Draft);
    let summary = crush(&Scene::new(&tables)?, &mut |_| true)?.summary;
    println!("{:.3} N at {:.3} um", summary.peak_force, 1e6 * summary.peak_depth);
    Ok(())
}
