//! Elastic unloading of the islands.

use super::closures::ClosureLaw;
use crate::contact::islands_contact::{CURVE_POINTS, Contact, CurvePoint};
use std::f64::consts::PI;

/// Elastic unloading.
#[derive(Clone, Debug, PartialEq)]
pub struct Unloading {
    /// First touch minus final separation minus the largest elastic return, in metres.
    pub residual_displacement: f64,
    /// Work returned over work done, at most 1; None without work.
    pub elastic_share: Option<f64>,
    /// The same as the unloading law gives it. Above 1 where islands are shallower than the cones that stand
    /// for them.
    pub elastic_share_by_law: Option<f64>,
    /// Share of the load on islands that the law would raise by more than they were pressed; None without
    /// load.
    pub limited_share: Option<f64>,
    /// From the load to the last touch.
    pub curve: Vec<CurvePoint>,
}

/// Takes the load off: every island returns by F = F_j (1 - u/u_j)^m with u_j = m F_j/(2 E* a_j).
///
/// m is the exponent measured on unloaded cones, a_j the radius of the true contact; the stiffness at the
/// start is that of a circular contact, 2 E* a_j, and so the contact area falls as (1 - u/u_j)^(2(m-1)).
/// Closures without a limit of pressure are elastic and return along the load curve.
///
/// For a cone u_j stays below its depth and F_j u_j/(m+1) below its work F_j h_j/3. A long ridge, or a wide
/// island with roughness upon it, was pressed by d_j far below h_j = tan β_j √(A_j/π): u_j is limited to d_j
/// there, and as the work of a body that is no cone may still be less than F_j d_j/(m+1), the sum is limited
/// to the work of the load curve.
pub fn unload(contact: &Contact, model: &ClosureLaw, exponent: f64) -> Unloading {
    let work = contact
        .curve
        .windows(2)
        .map(|w| 0.5 * (w[0].pressure + w[1].pressure) * (w[0].separation - w[1].separation))
        .sum::<f64>()
        * contact.nominal_area;
    if model.returns_everything() {
        let curve = contact.curve.iter().rev().copied().collect();
        let whole = (work > 0.0).then_some(1.0);
        return Unloading {
            residual_displacement: 0.0,
            elastic_share: whole,
            elastic_share_by_law: whole,
            limited_share: whole.map(|_| 0.0),
            curve,
        };
    }
    let (mut load, mut limited) = (0.0, 0.0);
    let returns: Vec<(f64, f64, f64)> = (0..contact.responses.len())
        .map(|j| {
            let (force, area) = (contact.force(j), contact.contact_area(j));
            let radius = (area / PI).sqrt();
            let stiffness = 2.0 * model.reduced_modulus * radius;
            let u = if stiffness > 0.0 { exponent * force / stiffness } else { 0.0 };
            let approach = contact.islands.islands[j].approach;
            load += force;
            limited += if u > approach { force } else { 0.0 };
            (force, area, u.min(approach))
        })
        .collect();
    let largest = returns.iter().fold(0.0, |u: f64, r| u.max(r.2));
    let energy: f64 = returns.iter().map(|(force, _, u)| force * u / (exponent + 1.0)).sum();
    let by_law = (work > 0.0).then(|| energy / work);
    let first_touch = contact.curve.first().map_or(contact.separation, |p| p.separation);
    let curve = (0..CURVE_POINTS)
        .map(|k| {
            let rise = largest * k as f64 / (CURVE_POINTS - 1) as f64;
            let (mut force, mut area) = (0.0, 0.0);
            for (f, a, u) in returns.iter().filter(|(_, _, u)| *u > rise) {
                let left = 1.0 - rise / u;
                force += f * left.powf(exponent);
                area += a * left.powf(2.0 * (exponent - 1.0));
            }
            CurvePoint {
                separation: contact.separation + rise,
                pressure: force / contact.nominal_area,
                area_ratio: (area / contact.nominal_area).min(1.0),
            }
        })
        .collect();
    Unloading {
        residual_displacement: first_touch - contact.separation - largest,
        elastic_share: by_law.map(|share| share.min(1.0)),
        elastic_share_by_law: by_law,
        limited_share: (load > 0.0).then(|| limited / load),
        curve,
    }
}
