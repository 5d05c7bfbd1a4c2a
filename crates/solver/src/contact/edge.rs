//! Penalty contact of surface edges with a rigid tool, integrated over exactly the part that touches;
//! friction is added by [`crate::contact::friction`].
//!
//! Energy ∫ p²/(2ε) dA over a reference area, p = ε d with the penetration d. Each edge is clipped where p =
//! 0 and Gauss points are laid on the clipped part: force and contact radius move smoothly as the front
//! crosses an element, and because p vanishes at the clip the tangent is the exact derivative of the force.
//!
//! The reference is the surface of the last converged state. A steep tool stretches the surface under its
//! apex over a large part of its flank, where a penalty over the undeformed area fades: the apex then pierces
//! the surface (30° cone, n = 0.1: K 15 % low, and no convergence to any mesh).

use crate::contact::parts::{NOTHING, Parts, WHOLE, ends_of_touch};
use crate::contact::pieces::Places;
use crate::contact::roots::parts_above_zero;
use crate::contact::slip::{EdgeSlip, Rubbing, SLIP_PLACES};
use crate::contact::tool::{Penetration, Tool};
use crate::point::kinematics::Symmetry;
use asperity_mesh::outline::quadratic_roots;

/// An edge of the free surface: two corners (ξ = -1, 1) and a mid-side node (ξ = 0) where the element has
/// one.
#[derive(Clone, Copy, Debug)]
pub struct ContactEdge {
    /// Nodes: two corners, then the mid-side node (or the first corner again).
    pub nodes: [u32; 3],
    /// True where the mid-side node exists.
    pub quadratic: bool,
    /// Positions of the three nodes in the configuration whose area the energy is taken over.
    pub reference: [[f64; 2]; 3],
    /// Elastic slip of friction in that configuration.
    pub slip: EdgeSlip,
    /// Axisymmetric or plane strain.
    symmetry: Symmetry,
}

/// The state a contact integral is taken in.
#[derive(Clone, Copy, Debug)]
pub struct ContactContext<'a> {
    /// The tool.
    pub tool: &'a Tool,
    /// Height of its lowest point.
    pub tip: f64,
    /// Penalty ε: pressure per penetration.
    pub penalty: f64,
    /// The same in the second derivative of the energy: ε where that is to be exact.
    pub spring: f64,
    /// Axisymmetric or plane strain.
    pub symmetry: Symmetry,
    /// Friction, where there is any.
    pub rubbing: Option<Rubbing>,
}

/// Contribution of one edge.
#[derive(Clone, Copy, Debug)]
pub struct EdgeContact {
    /// The parts that touch.
    pub parts: Parts,
    /// Nodal forces (r, z) of the three nodes, the gradient of the energy.
    pub force: [[f64; 2]; 3],
    /// Second derivative of the energy, `[node a][i][node b][j]`.
    pub stiffness: [[[[f64; 2]; 3]; 2]; 3],
    /// The derivative of the forces of friction less its symmetric part, which is in the stiffness.
    pub unsymmetric: [[[[f64; 2]; 3]; 2]; 3],
    /// Force on the tool along z.
    pub load: f64,
    /// ∫ p²/(2ε) dA.
    pub energy: f64,
    /// ∫ ½ε d² dA: the same but for rounding, and with the energy of the elastic slip.
    pub penalty_energy: f64,
    /// Work that friction takes in the increment.
    pub friction_work: f64,
    /// ∫ p d dA, for the pressure-weighted mean penetration.
    pub pressure_penetration: f64,
    /// ∫ p dA.
    pub pressure: f64,
    /// Projected current area.
    pub area: f64,
    /// Smallest and largest current radius that touches.
    pub reach: [f64; 2],
    /// Mean m and slope s of the current pressure (true, per current area) m + s t over a part, -1 ≤ t ≤ 1:
    /// its projection onto a line. Of two parts, that of the second.
    pub line: [f64; 2],
    /// Largest current pressure of that line where it is the pressure itself, if that is a parabola: at t =
    /// ±1/√3. The pressures of corners and mid-side nodes of one edge lie on two sides of the line.
    pub max_pressure: f64,
}

impl EdgeContact {
    /// Of an edge that touches in these parts, nothing summed up yet.
    fn empty(parts: Parts) -> EdgeContact {
        EdgeContact {
            parts,
            force: [[0.0; 2]; 3],
            stiffness: [[[[0.0; 2]; 3]; 2]; 3],
            unsymmetric: [[[[0.0; 2]; 3]; 2]; 3],
            load: 0.0,
            energy: 0.0,
            penalty_energy: 0.0,
            friction_work: 0.0,
            pressure_penetration: 0.0,
            pressure: 0.0,
            area: 0.0,
            reach: [f64::INFINITY, f64::NEG_INFINITY],
            line: [0.0; 2],
            max_pressure: 0.0,
        }
    }
}

/// Integration points of an interval [-1, 1]: abscissa and weight.
pub(crate) const GAUSS4: [[f64; 2]; 4] = [
    [-0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
    [-0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
];

impl ContactEdge {
    /// An edge from its reference positions (corner, corner, mid-side).
    pub fn new(
        nodes: [u32; 2],
        middle: Option<u32>,
        position: impl Fn(u32) -> [f64; 2],
        symmetry: Symmetry,
    ) -> Self {
        let quadratic = middle.is_some();
        let nodes = [nodes[0], nodes[1], middle.unwrap_or(nodes[0])];
        ContactEdge { nodes, quadratic, reference: nodes.map(position), slip: [0.0; SLIP_PLACES], symmetry }
    }

    /// Number of its nodes.
    pub fn node_count(&self) -> usize {
        if self.quadratic { 3 } else { 2 }
    }

    /// Shape functions of the three nodes at ξ.
    pub fn shape(&self, xi: f64) -> [f64; 3] {
        if self.quadratic { quadratic_shape(xi) } else { [0.5 * (1.0 - xi), 0.5 * (1.0 + xi), 0.0] }
    }

    /// Their derivatives by ξ.
    pub fn slope(&self, xi: f64) -> [f64; 3] {
        if self.quadratic { [xi - 0.5, xi + 0.5, -2.0 * xi] } else { [-0.5, 0.5, 0.0] }
    }

    /// Position at ξ.
    pub fn point(&self, x: &[[f64; 2]; 3], xi: f64) -> [f64; 2] {
        let n = self.shape(xi);
        [0, 1].map(|i| n[0] * x[0][i] + n[1] * x[1][i] + n[2] * x[2][i])
    }

    /// dx/dξ.
    pub fn tangent(&self, x: &[[f64; 2]; 3], xi: f64) -> [f64; 2] {
        let d = self.slope(xi);
        [0, 1].map(|i| d[0] * x[0][i] + d[1] * x[1][i] + d[2] * x[2][i])
    }

    /// Reference area per dξ at ξ.
    pub fn measure(&self, xi: f64) -> f64 {
        self.area(&self.reference, xi)
    }

    /// Area per dξ at ξ of the edge whose nodes are at `x`.
    fn area(&self, x: &[[f64; 2]; 3], xi: f64) -> f64 {
        let ([r, _], [dr, dz]) = (self.point(x, xi), self.tangent(x, xi));
        self.symmetry.weight(r.abs()) * dr.hypot(dz)
    }

    /// Current area over reference area at ξ; 1 at the axis, where both vanish.
    pub fn stretch(&self, x: &[[f64; 2]; 3], xi: f64) -> f64 {
        let (current, reference) = (self.area(x, xi), self.measure(xi));
        if reference > 0.0 { current / reference } else { 1.0 }
    }

    /// Places that part it into pieces along which the penetration is smooth.
    pub(super) fn places(&self, context: &ContactContext<'_>, x: &[[f64; 2]; 3]) -> Places {
        Places::of_edge(&x[..self.node_count()], |xi| self.point(x, xi), context.tool, context.tip)
    }

    /// Parts where ε d ≥ 0.
    pub fn touching(&self, context: &ContactContext<'_>, x: &[[f64; 2]; 3]) -> Parts {
        let pressure =
            |xi: f64| context.penalty * context.tool.penetration(self.point(x, xi), context.tip).depth;
        let places = self.places(context, x);
        let straight = match context.tool {
            Tool::Plane => true,
            Tool::Cone { tip_radius, .. } => *tip_radius == 0.0 && places.as_slice().is_empty(),
            _ => false,
        };
        if !straight {
            return parts_above_zero(pressure, places.as_slice());
        }
        // p(ξ) = c + bξ + aξ² under a plane and under a flank
        let (left, middle, right) = (pressure(-1.0), pressure(0.0), pressure(1.0));
        let (a, b, c) = (0.5 * (left + right) - middle, 0.5 * (right - left), middle);
        let mut roots = [0.0; 2];
        let mut count = 0;
        for root in quadratic_roots(a, b, c).into_iter().flatten() {
            if root > -1.0 && root < 1.0 {
                roots[count] = root;
                count += 1;
            }
        }
        match (count, left > 0.0, right > 0.0) {
            (0, _, _) if middle > 0.0 => WHOLE,
            (1, true, false) => [Some([-1.0, roots[0]]), None],
            (1, false, true) => [Some([roots[0], 1.0]), None],
            (1, true, true) => WHOLE, // touches zero at one point
            (2, true, true) => [Some([-1.0, roots[0].min(roots[1])]), Some([roots[0].max(roots[1]), 1.0])],
            (2, _, _) if middle > 0.0 || a < 0.0 => {
                [Some([roots[0].min(roots[1]), roots[0].max(roots[1])]), None]
            }
            _ => NOTHING,
        }
    }

    /// Integrates pressure over `parts`, wherever it may be negative there (a kept contact set may pull).
    pub fn integrate(&self, context: &ContactContext<'_>, parts: Parts, x: &[[f64; 2]; 3]) -> EdgeContact {
        self.integrate_widened(context, parts, parts, x)
    }

    /// The same over `parts` that are wider than the `touching` ones. There nothing presses, and the slope of
    /// the tool goes linearly from that at one end of touch to that at the other: beyond a corner of its
    /// outline the tool may be upright, and stiff springs along directions that turn within an edge as no
    /// displacement of its nodes does would hold these sideways too.
    pub fn integrate_widened(
        &self,
        context: &ContactContext<'_>,
        parts: Parts,
        touching: Parts,
        x: &[[f64; 2]; 3],
    ) -> EdgeContact {
        let mut out = EdgeContact::empty(parts);
        let slope = |xi: f64| context.tool.penetration(self.point(x, xi), context.tip).slope;
        let ends =
            if parts == touching { None } else { ends_of_touch(&touching).map(|ends| ends.map(slope)) };
        let places = self.places(context, x);
        for [start, end] in parts.into_iter().flatten().filter(|[start, end]| end > start) {
            let (centre, half) = (0.5 * (start + end), 0.5 * (end - start));
            out.line = [0.0; 2];
            let points = places.pieces_of([start, end]).flat_map(|[from, to]| {
                // a part in one piece keeps its bits
                let (middle, share) = (0.5 * (from + to), 0.5 * (to - from) / half);
                GAUSS4.map(|[abscissa, weight]| [(middle - centre) / half + share * abscissa, share * weight])
            });
            for [abscissa, weight] in points {
                let xi = centre + half * abscissa;
                let n = self.shape(xi);
                let here = self.point(x, xi);
                let d = match ends {
                    None => context.tool.penetration(here, context.tip),
                    Some([left, right]) => Penetration {
                        depth: 0.0,
                        slope: [0, 1].map(|i| 0.5 * ((1.0 - xi) * left[i] + (1.0 + xi) * right[i])),
                        curvature: [0.0; 3],
                    },
                };
                let p = context.penalty * d.depth;
                let w = half * weight * self.measure(xi);
                out.energy += w * p * p / (2.0 * context.penalty);
                out.penalty_energy += 0.5 * w * context.penalty * d.depth * d.depth;
                out.pressure += w * p;
                out.pressure_penetration += w * p * d.depth;
                out.load += w * p * d.slope[1];
                let [dr, dz] = self.tangent(x, xi);
                let current = context.symmetry.weight(here[0].abs()) * dr.hypot(dz);
                let pressure = p * self.measure(xi) / current;
                out.line[0] += 0.5 * weight * pressure;
                out.line[1] += 1.5 * weight * abscissa * pressure;
                let [krr, kzz, krz] = d.curvature;
                let [sr, sz] = d.slope;
                let e = context.spring;
                let form = [
                    [w * (e * sr * sr + p * krr), w * (e * sr * sz + p * krz)],
                    [w * (e * sr * sz + p * krz), w * (e * sz * sz + p * kzz)],
                ];
                for a in 0..self.node_count() {
                    for i in 0..2 {
                        out.force[a][i] += w * p * d.slope[i] * n[a];
                        for b in 0..self.node_count() {
                            for j in 0..2 {
                                out.stiffness[a][i][b][j] += form[i][j] * n[a] * n[b];
                            }
                        }
                    }
                }
            }
            out.max_pressure = out.max_pressure.max(out.line[0] + out.line[1].abs() / 3.0_f64.sqrt());
            let (r0, r1) = (self.point(x, start)[0], self.point(x, end)[0]);
            out.area += match context.symmetry {
                Symmetry::Axisymmetric => std::f64::consts::PI * (r1 * r1 - r0 * r0).abs(),
                Symmetry::PlaneStrain => (r1 - r0).abs(),
            };
            out.reach = [out.reach[0].min(r0).min(r1), out.reach[1].max(r0).max(r1)];
        }
        if let Some(rubbing) = &context.rubbing {
            self.rub(context, rubbing, x, &mut out);
        }
        out
    }
}

/// The part `[start, end]` of an edge as four pieces, each with an integration point in its middle place:
/// their lengths are the weights of the points.
pub fn divide([start, end]: [f64; 2]) -> [[f64; 3]; 4] {
    let half = 0.5 * (end - start);
    let mut from = start;
    GAUSS4.map(|[abscissa, weight]| {
        let piece = [from, 0.5 * (start + end) + half * abscissa, from + half * weight];
        from = piece[2];
        piece
    })
}

fn quadratic_shape(xi: f64) -> [f64; 3] {
    [0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside the axis of a ball, where its outline is inclined and curved. The tolerance is that of central
    /// differences over 1e-5 of numbers of the order of 1.
    #[test]
    fn stiffness_is_the_derivative_of_force_and_force_that_of_energy() {
        let tool = Tool::Sphere { radius: 1.0 };
        for symmetry in [Symmetry::Axisymmetric, Symmetry::PlaneStrain] {
            let place = |node: u32| [[0.5, 0.15], [0.7, 0.32], [0.61, 0.24]][node as usize];
            let edge = ContactEdge::new([0, 1], Some(2), place, symmetry);
            let context =
                ContactContext { tool: &tool, tip: 0.0, penalty: 2.0, spring: 2.0, symmetry, rubbing: None };
            let at = |x: &[[f64; 2]; 3]| edge.integrate(&context, WHOLE, x);
            let here = at(&edge.reference);
            assert!(here.energy > 0.0 && edge.touching(&context, &edge.reference) == WHOLE);
            for (b, j) in (0..3).flat_map(|b| [(b, 0), (b, 1)]) {
                let [less, more] = [-1e-5, 1e-5].map(|by| {
                    let mut x = edge.reference;
                    x[b][j] += by;
                    at(&x)
                });
                let by_energy = (more.energy - less.energy) / 2e-5;
                assert!((by_energy - here.force[b][j]).abs() < 1e-8, "{b} {j}: {by_energy} {:?}", here.force);
                for (a, i) in (0..3).flat_map(|a| [(a, 0), (a, 1)]) {
                    let by_force = (more.force[a][i] - less.force[a][i]) / 2e-5;
                    let found = here.stiffness[a][i][b][j];
                    assert!((by_force - found).abs() < 1e-8, "{a} {i} by {b} {j}: {by_force} {found}");
                }
            }
        }
    }

    #[test]
    fn an_edge_of_twice_the_length_has_twice_the_area_and_a_ring_four_times() {
        for (symmetry, stretch) in [(Symmetry::PlaneStrain, 2.0), (Symmetry::Axisymmetric, 4.0)] {
            let edge = ContactEdge::new([0, 1], None, |node| [1.0 + f64::from(node), 0.0], symmetry);
            let wider = edge.reference.map(|[r, z]| [2.0 * r, z]);
            for xi in [-1.0, 0.3, 1.0] {
                assert!((edge.stretch(&wider, xi) / stretch - 1.0).abs() < 1e-12, "{symmetry:?} {xi}");
            }
        }
    }
}
