//! Claim: the result knows no unit. Lengths or moduli times powers of two give the same bits; times 1e-12 to
//! 1e12 the same dimensionless results to 1e-9.
//!
//! Source: inside the solver E = 1 and the unit of length goes with the scene; the dimensions enter and leave
//! as factors. Tolerances:
//! a power of two changes no digit of a quotient; other factors change the last one, which the run, solved to
//! 1e-12 of the peak force, must not enlarge beyond 1e-9 (steps as prescribed; the force of the first contact
//! is a thousandth of the peak's) or 1e-6 (steps that depend on convergence).

use asperity_material::units::{Length, Stress};
use asperity_simulation::record::rows::CurveRow;
use asperity_simulation::scene::{Accuracy, Scene};
use asperity_verification::single_asperity::{crush, scene};

/// The scene with lengths and stresses multiplied.
fn scaled(length: f64, stress: f64) -> Scene {
    let mut scene = scene(Accuracy::Draft).unwrap();
    let asperity = &mut scene.asperity[0];
    for quantity in [&mut asperity.height, &mut asperity.tip_radius, &mut scene.loading.depth] {
        *quantity = quantity.map(|l| Length(l.0 * length));
    }
    let material = &mut scene.material;
    material.youngs_modulus = Stress(material.youngs_modulus.0 * stress);
    material.yield_stress = material.yield_stress.map(|s| Stress(s.0 * stress));
    scene.numerics.newton_tolerance = Some(1e-12);
    scene
}

/// The quantities of a row that have a unit, in the units of the scale.
fn dimensionless(row: &CurveRow, length: f64, stress: f64) -> [f64; 9] {
    let (force, energy) = (stress * length * length, stress * length * length * length);
    [
        row.depth / length,
        row.force / force,
        row.contact_area / (length * length),
        row.contact_radius / length,
        row.mean_pressure / stress,
        row.external_work / energy,
        row.elastic_energy / energy,
        row.plastic_work / energy,
        row.penetration / length,
    ]
}

/// Rows of the scaled run, and whether its steps went as prescribed.
fn rows(length: f64, stress: f64) -> (Vec<[f64; 9]>, bool) {
    let outcome = crush(&scaled(length, stress)).unwrap();
    let rows = outcome.rows.iter().map(|row| dimensionless(row, length, stress)).collect();
    (rows, outcome.summary.cutbacks == 0)
}

#[test]
fn powers_of_two_give_the_same_bits() {
    let (reference, _) = rows(1.0, 1.0);
    for (length, stress) in [(1024.0, 1.0), (1.0, 2.0_f64.powi(-20)), (2.0_f64.powi(-30), 2.0_f64.powi(17))] {
        assert_eq!(rows(length, stress).0, reference, "{length} {stress}");
    }
}

#[test]
fn any_factor_gives_the_same_curve() {
    let (reference, prescribed) = rows(1.0, 1.0);
    let tolerance = if prescribed { 1e-9 } else { 1e-6 };
    let peak =
        reference.iter().fold([0.0; 9], |m: [f64; 9], row| std::array::from_fn(|i| m[i].max(row[i].abs())));
    for (length, stress) in [(1e-12, 1.0), (1e12, 1.0), (1.0, 1e-12), (1.0, 1e12), (1e5, 1e-7)] {
        let (other, _) = rows(length, stress);
        assert_eq!(other.len(), reference.len(), "{length} {stress}");
        for (a, b) in other.iter().zip(&reference) {
            for i in 0..9 {
                assert!(
                    (a[i] - b[i]).abs() <= tolerance * peak[i],
                    "{length} {stress} {i}: {} {}",
                    a[i],
                    b[i]
                );
            }
        }
    }
}
