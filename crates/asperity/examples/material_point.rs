//! A material point driven alone: uniaxial tension, whose true stress is the hardening law.

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity::material::{Elastic, Hardening, HardeningLaw, StressMeasure};
use asperity::solver::point::j2::{PointUpdate, Tangent, update};
use asperity::solver::point::material::{Metal, PointState};

/// Logarithmic strain of an increment.
const STEP: f64 = 0.002;

/// Stretches `old` along z by [`STEP`] and sideways by the logarithmic strain `lateral`.
fn stretch(material: &Metal, old: &PointState, lateral: f64) -> Option<PointUpdate> {
    let (side, along) = (lateral.exp_m1(), STEP.exp_m1());
    update(material, old, &[side, 0.0, 0.0, along, side], Tangent::None).ok()
}

/// The increment whose stress on the sides is 0: between full contraction and none, by bisection.
fn pull(material: &Metal, old: &PointState) -> Option<PointUpdate> {
    let (mut low, mut high) = (-STEP, 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match stretch(material, old, middle)?.stress[0] > 0.0 {
            true => high = middle,
            false => low = middle,
        }
    }
    stretch(material, old, 0.5 * (low + high))
}

fn main() {
    // stresses in units of Young's modulus
    let law = Hardening {
        law: HardeningLaw::Hollomon,
        yield_stress: 1.0 / 700.0,
        exponent: 0.3,
        youngs_modulus: 1.0,
    };
    let elastic = Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };
    let material = Metal {
        elastic,
        hardening: Some(law.into()),
        kinematic_share: 0.0,
        stress_measure: StressMeasure::Kirchhoff,
    };
    let mut state = material.virgin();
    println!("strain  stress/E  plastic strain  law/E");
    for increment in 1..=50 {
        let Some(pulled) = pull(&material, &state) else { return println!("the point failed") };
        state = pulled.state;
        if increment % 10 == 0 {
            let yield_stress = law.flow(state.plastic_strain).yield_stress;
            let strain = f64::from(increment) * STEP;
            println!("{strain:.3}  {:.6}  {:.6}  {yield_stress:.6}", pulled.stress[1], state.plastic_strain);
        }
    }
}
