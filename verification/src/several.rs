//! Bodies with several asperities of the paper's kind, and how their curves are compared.

use crate::single_asperity::crush;
use asperity_material::units::Length;
use asperity_simulation::record::rows::Phase;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, Asperity, Lateral, Scene, Substrate, Symmetry};

/// Half width of the base of the paper's asperity (20 µm, 10°, tip 10 µm), m.
pub const FOOT: f64 = 114.30e-6;

/// One asperity of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Height, m.
    pub height: f64,
    /// Flat stretch between its foot and the next one, m.
    pub spacing: f64,
}

/// The paper's asperity, foot to foot with the next.
pub const PAPER: Member = Member { height: 20e-6, spacing: 0.0 };

/// An asperity too low to be touched.
pub const LOW_MEMBER: Member = Member { height: 12e-6, spacing: 0.0 };

/// A row of asperities of 10° with tips of 10 µm, crushed to 5 µm at draft accuracy without unloading;
/// `substrate` is its half width (radius) and depth, m.
///
/// # Errors
/// The committed scene file does not read.
pub fn row(
    symmetry: Symmetry,
    lateral: Lateral,
    members: &[Member],
    substrate: Option<[f64; 2]>,
) -> Result<Scene, toml::de::Error> {
    let mut scene = crate::single_asperity::scene(Accuracy::Draft)?;
    let paper = scene.asperity[0].clone();
    scene.asperity = members
        .iter()
        .map(|member| Asperity {
            height: Some(Length(member.height)),
            spacing: (member.spacing > 0.0).then_some(Length(member.spacing)),
            ..paper.clone()
        })
        .collect();
    scene.symmetry = symmetry;
    scene.lateral = lateral;
    scene.substrate = substrate
        .map(|[radius, depth]| Substrate { radius: Some(Length(radius)), depth: Some(Length(depth)) });
    scene.loading.unload = false;
    Ok(scene)
}

/// A loading curve: depths (m) and forces (N or N/m), from first touch.
pub type Curve = Vec<[f64; 2]>;

/// The loading curve of the whole body.
pub fn whole(outcome: &Outcome) -> Curve {
    outcome.rows.iter().filter(|row| row.phase == Phase::Load).map(|row| [row.depth, row.force]).collect()
}

/// The loading curve of one asperity of several.
pub fn of_asperity(outcome: &Outcome, asperity: usize) -> Curve {
    let own = outcome.asperities.iter().filter(|row| row.phase == Phase::Load && row.asperity == asperity);
    std::iter::once([0.0; 2]).chain(own.map(|row| [row.depth, row.force])).collect()
}

/// `y` at `x` on a curve of rising `x`, by the cubic through the four nearest points; NaN outside.
pub fn interpolated(curve: &[[f64; 2]], x: f64) -> f64 {
    let after = curve.partition_point(|p| p[0] < x);
    if curve.len() < 4 || x < curve[0][0] || x > curve[curve.len() - 1][0] * (1.0 + 1e-9) {
        return f64::NAN;
    }
    let first = after.saturating_sub(2).min(curve.len() - 4);
    let points = &curve[first..first + 4];
    let term = |(i, p): (usize, &[f64; 2])| {
        let others = points.iter().enumerate().filter(|(j, _)| *j != i);
        p[1] * others.map(|(_, q)| (x - q[0]) / (p[0] - q[0])).product::<f64>()
    };
    points.iter().enumerate().map(term).sum()
}

/// Depth at which the curve carries `force`, m.
pub fn depth_at(curve: &[[f64; 2]], force: f64) -> f64 {
    let turned: Vec<[f64; 2]> = curve.iter().map(|[h, f]| [*f, *h]).collect();
    interpolated(&turned, force)
}

/// The largest |F/F_reference - 1| from a fifth of the peak depth on.
pub fn worst_difference(curve: &[[f64; 2]], reference: &[[f64; 2]]) -> f64 {
    let peak = curve.last().map_or(0.0, |p| p[0]).min(reference.last().map_or(0.0, |p| p[0]));
    (0..=40)
        .map(|i| peak * (0.2 + 0.8 * f64::from(i) / 40.0))
        .map(|h| (interpolated(curve, h) / interpolated(reference, h) - 1.0).abs())
        .fold(
            0.0,
            |worst, difference| if difference > worst || difference.is_nan() { difference } else { worst },
        )
}

/// Three ridges of this pitch over a free layer of this depth (m) on a rigid base against three times one:
/// the largest difference of the force.
///
/// # Errors
/// The reason why the solver refused.
pub fn three_over_one(pitch: f64, depth: f64, accuracy: Accuracy) -> Result<f64, Box<dyn std::error::Error>> {
    let member = Member { spacing: pitch - 2.0 * FOOT, ..PAPER };
    let body = |members: &[Member]| {
        // the free sides stay four depths away from the row
        let half = 0.5 * (members.len() as f64 - 1.0) * pitch + FOOT + 4.0 * depth;
        row(Symmetry::PlaneStrain, Lateral::Free, members, Some([half, depth]))
            .map(|scene| Scene { accuracy, ..scene })
    };
    let one: Curve = whole(&crush(&body(&[member])?)?).iter().map(|[h, f]| [*h, 3.0 * f]).collect();
    Ok(worst_difference(&whole(&crush(&body(&[member; 3])?)?), &one))
}
