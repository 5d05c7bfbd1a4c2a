//! Penalty correction from tool travel to depth: travel less this is the depth.
//!
//! The penalty is an elastic layer of stiffness ε per area on the tool; the layer is compressed by d = p/ε.
//! The depth that the tool would have without it depends on how the material answers:
//! * elastic: the layer adds E_c = ∫ ½ε d² dA to the complementary energy, so to first order in 1/ε the depth
//!   grows by dE_c/dF = ∫ d (∂p/∂F) dA (Castigliano). What an elastic contact gains in pressure is the
//!   pressure of a flat punch as wide as the contact (Johnson, Contact Mechanics, 1985, eq. 3.34 and 2.64),
//!   whatever the shape: the mean of d under a punch. That is ln 2 = 0.69 of the mean d under a cone, 3/4 of
//!   it under a ball;
//! * fully plastic, under an even pressure: a layer that is compressed evenly shifts the surface of the tool
//!   by d. The mean weighted by the pressure is taken, 2 E_c/F, which leaves out the rim where contact has
//!   just begun.
//!
//! Between the two the share of the plastic work decides, beside the elastic energy near the contact:
//! F²/(3E*a) of a cone (a ball has 0.9 times that), F²/(3E*) per length of a line, whose energy further away
//! grows with the body.

use crate::contact::edge::{ContactEdge, EdgeContact, divide};
use crate::point::kinematics::Symmetry;
use std::f64::consts::{FRAC_PI_2, PI};

/// A piece of a contact: left and right end, the penetration between them, its share of the force.
#[derive(Clone, Copy, Debug)]
struct Piece {
    ends: [f64; 2],
    depth: f64,
    force: f64,
}

/// Gaps below this share of the larger radius are none.
const LEAST_GAP: f64 = 1e-9;

/// Penalty correction if the material is elastic, and the elastic energy near the contacts times E*.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Punches {
    /// Mean penetration under flat punches as wide as the contacts; each contact counts by its force.
    pub penetration: f64,
    /// E* times the elastic energy.
    pub energy: f64,
}

/// Left and right end of pieces that touch each other, and whether they are a disc.
fn extent(pieces: &[Piece], symmetry: Symmetry) -> ([f64; 2], bool) {
    let (first, last) = (pieces.first(), pieces.last());
    let [left, right] = [first.map_or(0.0, |p| p.ends[0]), last.map_or(0.0, |p| p.ends[1])];
    ([left, right], symmetry == Symmetry::Axisymmetric && left <= LEAST_GAP * right)
}

/// Mean penetration of pieces that touch each other under the pressure of a flat punch.
fn under_a_punch(pieces: &[Piece], symmetry: Symmetry) -> f64 {
    let ([left, right], disc) = extent(pieces, symmetry);
    // share of the force of the punch that it carries left of x
    let carried = |x: f64| {
        if disc {
            1.0 - (1.0 - (x / right).powi(2)).max(0.0).sqrt()
        } else {
            let t = (2.0 * x - left - right) / (right - left);
            (t.clamp(-1.0, 1.0).asin() + FRAC_PI_2) / PI
        }
    };
    pieces.iter().map(|p| p.depth * (carried(p.ends[1]) - carried(p.ends[0]))).sum()
}

/// Length over which the energy F²/(3E* length) near a contact is spread.
fn length(pieces: &[Piece], symmetry: Symmetry) -> f64 {
    let ([left, right], disc) = extent(pieces, symmetry);
    match symmetry {
        Symmetry::PlaneStrain => 1.0,
        Symmetry::Axisymmetric if disc => right,
        Symmetry::Axisymmetric => PI * (left + right),
    }
}

/// Sums over the contacts of `edges`; `position` is that of a node, `depth` the penetration of a point.
pub fn under_punches<'a>(
    edges: impl Iterator<Item = (&'a ContactEdge, &'a EdgeContact)>,
    symmetry: Symmetry,
    position: impl Fn(u32) -> [f64; 2],
    depth: impl Fn([f64; 2]) -> f64,
) -> Punches {
    let mut pieces = Vec::new();
    for (edge, contact) in edges {
        let x = edge.nodes.map(&position);
        let touching: f64 = contact.parts.into_iter().flatten().map(|[from, to]| to - from).sum();
        for [from, middle, to] in contact.parts.into_iter().flatten().flat_map(divide) {
            let [a, b] = [from, to].map(|xi| edge.point(&x, xi)[0]);
            let force = contact.load * (to - from) / touching;
            pieces.push(Piece { ends: [a.min(b), a.max(b)], depth: depth(edge.point(&x, middle)), force });
        }
    }
    // an edge that touches in a point carries nothing
    pieces.retain(|p| p.ends[0] < p.ends[1] && p.force.is_finite());
    pieces.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
    let joined = |a: &Piece, b: &Piece| (b.ends[0] - a.ends[1]).abs() <= LEAST_GAP * b.ends[0].abs();
    let (mut sums, mut force) = (Punches::default(), 0.0);
    for contact in pieces.chunk_by(joined) {
        let carried: f64 = contact.iter().map(|p| p.force).sum();
        force += carried;
        sums.penetration += carried * under_a_punch(contact, symmetry);
        sums.energy += carried * carried / (3.0 * length(contact, symmetry));
    }
    if force > 0.0 {
        sums.penetration /= force;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `count` pieces of a contact from `left` to `right` that is compressed by `depth` of the share of its
    /// half width.
    fn patch(left: f64, right: f64, count: usize, depth: impl Fn(f64) -> f64) -> Vec<Piece> {
        let at = |i: f64| left + (right - left) * i / count as f64;
        let piece = |i: usize| {
            let i = i as f64;
            Piece { ends: [at(i), at(i + 1.0)], depth: depth(at(i + 0.5)), force: 1.0 }
        };
        (0..count).map(piece).collect()
    }

    /// Compressed as the pressures of Sneddon and of Hertz over their mean (Johnson 1985, eqs 5.8 and 3.39),
    /// the layer takes dE_c/dF: ln 2 and 3/4 of the mean. In plane strain (eq. 4.45: p over its mean
    /// 4/π √(1 - x²)) 8/π². An even layer takes itself. 1e-3: pieces of 1/4000.
    #[test]
    fn an_elastic_layer_takes_the_derivative_of_its_energy() {
        let disc = Symmetry::Axisymmetric;
        let cone = patch(0.0, 1.0, 4000, |r| (1.0 / r).acosh());
        let ball = patch(0.0, 1.0, 4000, |r| 1.5 * (1.0 - r * r).sqrt());
        let cylinder = patch(1.0, 3.0, 4000, |x| 4.0 / PI * (1.0 - (x - 2.0).powi(2)).sqrt());
        assert!((under_a_punch(&cone, disc) - 2f64.ln()).abs() < 1e-3);
        assert!((under_a_punch(&ball, disc) - 0.75).abs() < 1e-3);
        assert!((under_a_punch(&cylinder, Symmetry::PlaneStrain) - 8.0 / PI.powi(2)).abs() < 1e-3);
        assert!((under_a_punch(&patch(0.0, 2.0, 7, |_| 0.3), disc) - 0.3).abs() < 1e-12);
        assert!((under_a_punch(&patch(1.0, 2.0, 7, |_| 0.3), disc) - 0.3).abs() < 1e-12);
    }
}
