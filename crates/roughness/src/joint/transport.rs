//! Heat, current and fluid through a joint, from its contacts and gaps.

use super::conductance::{Bodies, of_medium};
use super::path::JointPoint;

/// The flow through a joint at one load, along x and y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flow {
    /// Gap of the critical constriction, in m; none where no path crosses.
    pub critical_gaps: [Option<f64>; 2],
    /// Width of the critical constriction, in m; none where no path crosses.
    pub critical_widths: [Option<f64>; 2],
    /// Volume flux times viscosity over pressure difference, in m³; none where it was not asked for.
    pub leaks: [Option<f64>; 2],
    /// Relative errors of the leaks.
    pub errors: [Option<f64>; 2],
}

impl Flow {
    /// The mean over maps: leaks of places beside each other add up. A number that one lacks is none of it,
    /// the error is the largest.
    pub fn mean<'a>(flows: impl Iterator<Item = &'a Flow> + Clone) -> Flow {
        let count = flows.clone().count() as f64;
        let mean = |of: &dyn Fn(&Flow) -> Option<f64>| {
            flows.clone().map(of).sum::<Option<f64>>().map(|sum| sum / count)
        };
        Flow {
            critical_gaps: [0, 1].map(|k| mean(&|flow| flow.critical_gaps[k])),
            critical_widths: [0, 1].map(|k| mean(&|flow| flow.critical_widths[k])),
            leaks: [0, 1].map(|k| mean(&|flow| flow.leaks[k])),
            errors: [0, 1].map(|k| flows.clone().filter_map(|flow| flow.errors[k]).reduce(f64::max)),
        }
    }
}

/// The bodies of a joint with the conductivity of the medium between them, in SI.
pub type BodiesAndMedium = (Bodies, Option<f64>);

/// The conductors that turn a contact into conductances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductors {
    /// For heat.
    pub thermal: Option<BodiesAndMedium>,
    /// For electric current.
    pub electrical: Option<BodiesAndMedium>,
    /// E*, in Pa.
    pub reduced_modulus: f64,
}

impl Conductors {
    /// Through spots and gap beside each other; none without bodies, or where no gap is left.
    fn total(&self, (bodies, medium): BodiesAndMedium, point: &JointPoint) -> Option<f64> {
        let spots = match point.elastic {
            Some(stiffness) => bodies.of_contact(stiffness.gap, self.reduced_modulus),
            None if point.pressure == 0.0 => 0.0,
            None => return None,
        };
        let gap = medium.map_or(0.0, |k| of_medium(k, point.mean_gap));
        Some(spots + gap).filter(|h| h.is_finite())
    }

    /// Of heat, W/(m² K).
    pub fn thermal(&self, point: &JointPoint) -> Option<f64> {
        self.total(self.thermal?, point)
    }

    /// Of electric current, S/m².
    pub fn electrical(&self, point: &JointPoint) -> Option<f64> {
        self.total(self.electrical?, point)
    }
}
