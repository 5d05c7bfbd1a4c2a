//! The units that quantities may be written in.

use super::markdown::{code, table};
use asperity::material::units::{
    Compliance, ElectricalConductivity, Force, Length, LineForce, Stiffness, Stress, ThermalConductivity,
};
use asperity::roughness::scene::Viscosity;

/// The page.
pub fn page() -> String {
    let kinds = [
        ("length", Length::UNITS, "m"),
        ("stress, pressure, modulus", Stress::UNITS, "Pa"),
        ("force", Force::UNITS, "N"),
        ("force per length of ridge (plane strain)", LineForce::UNITS, "N/m"),
        ("stiffness (`unloading_slope` of a fit)", Stiffness::UNITS, "N/m"),
        ("compliance (`machine_compliance`)", Compliance::UNITS, "m/N"),
        ("viscosity", Viscosity::UNITS, "Pa s"),
        ("thermal conductivity", ThermalConductivity::UNITS, "W/(m K)"),
        ("electrical conductivity", ElectricalConductivity::UNITS, "S/m"),
    ];
    let row = |(kind, units, si): (&str, &[(&str, f64)], &str)| {
        let units: Vec<String> = units.iter().map(|(name, _)| code(name)).collect();
        vec![kind.into(), units.join(", "), si.into()]
    };
    format!(
        "# Units\n\nA quantity of a file is a string: a number and a unit, `\"20 um\"`, with or without a space between. The unit is never \
         left out, so that a number cannot be taken for another one. A share of a fit is in percent, `\"0.5 %\"`. Angles are numbers in degrees, in keys that end in `_deg`.\n\n{}\
         Files of results have the unit in the name of a column or key: `depth_um` is in µm, `force_N` in N, `mean_pressure_MPa` in MPa, \
         `total_work_uJ` in µJ. In plane strain forces, areas and energies are per millimetre of ridge, and their names say it. Inside the \
         library all quantities are in SI; inside the solver Young's modulus is the unit of stress, and a length of the scene that of \
         length.\n",
        table(&["quantity", "units of a file", "inside"], kinds.map(row))
    )
}
