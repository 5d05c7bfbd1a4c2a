//! Conductance of a joint for heat or electric current.

use super::law::{fine_pressures, thinned};
use asperity_numerics::monotone_cubic::MonotoneCubic;

/// The two bodies of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bodies {
    /// Their conductivities: W/(m K) of heat, S/m of current.
    pub conductivities: [f64; 2],
}

impl Bodies {
    /// 2 k₁ k₂/(k₁ + k₂): the conductivity of two equal bodies that let through as much.
    pub fn conductivity(&self) -> f64 {
        let [one, other] = self.conductivities;
        // the form holds for any two positive numbers
        2.0 / (1.0 / one + 1.0 / other)
    }

    /// Conductance through the spots of contact over the nominal area (Barber 2003), k S/E*, in W/(m² K) or
    /// S/m²: the temperature drop of the flux q through the spots is the closure of the pressure p on them
    /// with k in the place of E*. `stiffness` is the elastic one of the contact as it stands (Pa/m),
    /// `reduced_modulus` E* (Pa).
    pub fn of_contact(&self, stiffness: f64, reduced_modulus: f64) -> f64 {
        self.conductivity() * stiffness / reduced_modulus
    }
}

/// Conductance of a medium of this `conductivity` in a gap of this mean height (m), in W/(m² K) or S/m²: that
/// between parallel planes. Of uneven gaps it is the least there can be, as the mean of 1/g is at least 1
/// over the mean of g.
pub fn of_medium(conductivity: f64, mean_gap: f64) -> f64 {
    conductivity / mean_gap
}

/// Pressure (Pa) and conductance of `loads`, both rising, the first at no pressure: so many points that
/// straight lines between them are off a smooth curve by the share `tolerance` at most. The curve is a cubic
/// in the logarithms; below the first load that carries something it is a straight line, as the conductance
/// of spots is nearly proportional to the pressure.
pub fn conductance_table(loads: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let carried: Vec<[f64; 2]> =
        loads.iter().filter(|[p, h]| *p > 0.0 && *h > 0.0).map(|load| load.map(f64::ln)).collect();
    let (Some(curve), Some(first)) = (MonotoneCubic::through_points(&carried), loads.first()) else {
        return loads.to_vec();
    };
    let [p, h] = carried[0].map(f64::exp);
    let value = |pressure: f64| {
        if pressure < p {
            return first[1] + (h - first[1]) * (pressure - first[0]) / (p - first[0]);
        }
        curve.value_and_slope(pressure.ln())[0].exp()
    };
    let fine: Vec<[f64; 2]> = fine_pressures(&curve).into_iter().map(|p| [p, value(p)]).collect();
    thinned(&fine, tolerance, 0.0)
}
