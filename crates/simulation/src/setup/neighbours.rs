//! Depth by which each contact of a row indents its own surroundings, estimated before a run: what it and its
//! neighbours press down further away is no part of that.
//!
//! Under a row of contacts most of the depth of the tool goes into the body at large. With the depth `d` that
//! a contact indents its own surroundings, the load `P` that it then carries and the depth `δ` of the tool
//! below the summit,
//! ```text
//! d_i + Σ_j c_ij P_j(d_j) = δ_i,   d_i ≥ 0.
//! ```
//! The surface of an elastic half space falls under a line load q by (2q/πE*) ln(L/s) at the distance s
//! (Johnson, Contact Mechanics, 1985, section 2.3); of a strip as wide as a contact of the half width a, s =
//! a leaves the depth that an outline of this half width cuts off. L is the depth of a body in plane strain,
//! eight times the radius of a ring on a half space, whose other rings and middle fall by
//! (P/πE*)(2/π)K(m)/(c_i + c_j), m = 4c_i c_j/(c_i + c_j)². Symmetric sides mirror the loads, and make the
//! far field a bar.

use crate::setup::contact_estimate::{Meeting, area, meetings, pressure_under};
use asperity_mesh::profile::Profile;
use asperity_numerics::bisection::bisect;
use asperity_solver::contact::tool::Tool;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;
use std::f64::consts::{FRAC_PI_2, PI};

/// The body that carries a row, lengths over one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    pub symmetry: Symmetry,
    /// Left and right side of the cell that symmetric sides repeat.
    pub cell: Option<[f64; 2]>,
    /// Depth below the summits; `None`: not known, or a half space.
    pub depth: Option<f64>,
}

/// Sweeps over the row, and the change of a depth over that of the tool at which they end.
const MOST_SWEEPS: usize = 200;
const LEAST_DEPTH_CHANGE: f64 = 1e-10;

/// Depth that each contact of `profile` (one entry for a flat body) indents its surroundings where the tool
/// is `depth` below the highest summit; 0 where it does not touch.
pub fn own_depths(metal: &Metal, profile: &Profile, tool: &Tool, support: &Support, depth: f64) -> Vec<f64> {
    let mirrored = tool.mirrored();
    let meetings = meetings(profile, mirrored.as_ref());
    let free: Vec<f64> = meetings.iter().map(|m| (depth - m.below).max(0.0)).collect();
    let on_axis = |m: &Meeting<'_>| m.centre == 0.0 && support.is_half_space();
    let single = meetings.len() == 1 && meetings.iter().all(on_axis);
    let unknown = support.depth.is_none() && !support.is_half_space();
    if single || unknown {
        return free;
    }
    let load = |meeting: &Meeting<'_>, own: f64| {
        let half_width = meeting.half_width(own);
        pressure_under(metal, meeting.slope(half_width), 0.0)
            * area(support.symmetry, meeting.centre, half_width)
    };
    let mut own = vec![0.0; free.len()];
    let mut loads = vec![0.0; free.len()];
    for _ in 0..MOST_SWEEPS {
        let mut moved = 0.0_f64;
        for (i, meeting) in meetings.iter().enumerate() {
            let others =
                meetings.iter().zip(&loads).enumerate().filter(|(j, (_, load))| *j != i && **load > 0.0);
            let lowered: f64 =
                others.map(|(_, (other, load))| load * support.falls_beside(metal, meeting, other)).sum();
            let left = free[i] - lowered;
            let excess = |own: f64| {
                let load = load(meeting, own);
                own + load * support.falls_under(metal, meeting.centre, meeting.half_width(own)) - left
            };
            // between symmetric sides a body may fall less than a half space
            let next = if left > 0.0 { root(excess, left).min(free[i]) } else { 0.0 };
            moved = moved.max((next - own[i]).abs());
            own[i] = next;
            loads[i] = load(meeting, next);
        }
        if moved < LEAST_DEPTH_CHANGE * depth {
            break;
        }
    }
    own
}

/// The root of `excess`, which grows, between 0 and `high`.
fn root(excess: impl Fn(f64) -> f64, high: f64) -> f64 {
    bisect([0.0, high], 60, |x| excess(x) < 0.0)[1]
}

impl Support {
    fn is_half_space(&self) -> bool {
        self.symmetry == Symmetry::Axisymmetric && self.cell.is_none()
    }

    fn depth(&self) -> f64 {
        self.depth.unwrap_or(f64::INFINITY)
    }

    /// Fall of the surroundings of a contact per load of its own.
    fn falls_under(&self, metal: &Metal, centre: f64, half_width: f64) -> f64 {
        let line = 2.0 / (PI * metal.elastic.reduced_modulus());
        let around = |length: f64| line * (length / half_width).ln().max(0.0);
        match (self.symmetry, self.cell) {
            (Symmetry::PlaneStrain, None) => around(self.depth()),
            (Symmetry::PlaneStrain, Some(cell)) => {
                line * mirrored(cell, centre, centre, half_width) + self.bar(metal, cell[1] - cell[0])
            }
            (Symmetry::Axisymmetric, _) if centre == 0.0 => self.confined(metal),
            (Symmetry::Axisymmetric, _) => around(8.0 * centre) / (2.0 * PI * centre) + self.confined(metal),
        }
    }

    /// Fall at one contact per load of another.
    fn falls_beside(&self, metal: &Metal, one: &Meeting<'_>, other: &Meeting<'_>) -> f64 {
        let modulus = metal.elastic.reduced_modulus();
        let line = 2.0 / (PI * modulus);
        let (a, b) = (one.centre, other.centre);
        match (self.symmetry, self.cell) {
            (Symmetry::PlaneStrain, None) => line * (self.depth() / (a - b).abs()).ln().max(0.0),
            (Symmetry::PlaneStrain, Some(cell)) => {
                line * mirrored(cell, a, b, 0.0) + self.bar(metal, cell[1] - cell[0])
            }
            (Symmetry::Axisymmetric, _) => {
                let m = 4.0 * a * b / (a + b).powi(2);
                2.0 / (PI * PI * modulus) * elliptic(m) / (a + b) + self.confined(metal)
            }
        }
    }

    /// Of a cell of rings: the fall of a bar as wide, less that of a half space in the mean over the cell,
    /// 2P/(πE*R).
    fn confined(&self, metal: &Metal) -> f64 {
        let Some([_, radius]) = self.cell else { return 0.0 };
        self.bar(metal, PI * radius * radius) - 2.0 / (PI * metal.elastic.reduced_modulus() * radius)
    }

    /// Fall per load of a bar of this section between rigid walls: depth over section and E (1 - ν)/((1 +
    /// ν)(1 - 2ν)).
    fn bar(&self, metal: &Metal, section: f64) -> f64 {
        let (modulus, nu) = (metal.elastic.youngs_modulus, metal.elastic.poissons_ratio);
        let confined = modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
        self.depth() / (section * confined)
    }
}

/// ln of one over the distance of the places `a` and `b` (`s` if they are one) between mirrors at the sides
/// of the `cell`, with all images of `b`, less its mean: -ln(4 sin(π(a - b)/2W) sin(π(a + b)/2W)) from the
/// left side, W wide.
fn mirrored([left, right]: [f64; 2], a: f64, b: f64, s: f64) -> f64 {
    let turn = FRAC_PI_2 / (right - left);
    let near = if a == b { turn * s } else { (turn * (a - b)).sin().abs() };
    let image = (turn * (a + b - 2.0 * left)).sin().abs();
    -(4.0 * near * image).max(f64::MIN_POSITIVE).ln()
}

/// Complete elliptic integral K of the parameter m, by the arithmetic-geometric mean.
fn elliptic(m: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - m).max(f64::MIN_POSITIVE).sqrt());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    FRAC_PI_2 / a
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_material::{Elastic, StressMeasure};
    use asperity_mesh::profile::{Asperity, Shape};

    const ELASTIC: Elastic = Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };

    fn metal() -> Metal {
        Metal {
            elastic: ELASTIC,
            hardening: None,
            kinematic_share: 0.0,
            stress_measure: StressMeasure::Cauchy,
        }
    }

    fn caps(radius: f64, centres: &[f64]) -> Profile {
        let cap = |&centre: &f64| Asperity {
            shape: Shape::Sphere { radius },
            height: 10.0,
            centre,
            valley_radius: 0.0,
        };
        Profile { asperities: centres.iter().map(cap).collect(), line: None }
    }

    fn support(symmetry: Symmetry, depth: Option<f64>) -> Support {
        Support { symmetry, cell: None, depth }
    }

    /// Johnson, Contact Mechanics, eq. (4.43) and (5.56): a² = 4qR/(πE*), δ = (q/πE*)(2 ln(2L/a) - ν/(1 -
    /// ν)). A quarter: the pressure is that of a wedge of the slope at the edge, 1.27 times that of a
    /// cylinder.
    #[test]
    fn an_elastic_cylinder_is_as_wide_as_that_of_hertz() {
        let (radius, deep) = (1000.0, 500.0);
        let nu: f64 = ELASTIC.poissons_ratio;
        let fall = |a: f64| a * a / (4.0 * radius) * (2.0 * (2.0 * deep / a).ln() - nu / (1.0 - nu));
        let hertz = root(|a| fall(a) - 1.0, deep);
        let row = caps(radius, &[0.0]);
        let support = support(Symmetry::PlaneStrain, Some(deep));
        let own = own_depths(&metal(), &row, &Tool::Plane, &support, 1.0);
        let width = crate::setup::contact_estimate::half_widths(&row, &Tool::Plane, &own)[0];
        assert!((width / hertz - 1.0).abs() < 0.25, "{width} beside {hertz}");
    }

    /// Within rounding: the two sums are the same.
    #[test]
    fn a_ring_is_a_line_on_a_body_of_eight_times_its_radius() {
        let radius = 300.0;
        let own = |row: &Profile, support| own_depths(&metal(), row, &Tool::Plane, &support, 1.0)[0];
        let ring = own(&caps(50.0, &[radius]), support(Symmetry::Axisymmetric, None));
        let line = own(&caps(50.0, &[0.0]), support(Symmetry::PlaneStrain, Some(8.0 * radius)));
        assert!((ring / line - 1.0).abs() < 1e-9, "{ring} {line}");
    }

    #[test]
    fn neighbours_lower_a_contact() {
        let of = |centres: &[f64]| {
            own_depths(
                &metal(),
                &caps(50.0, centres),
                &Tool::Plane,
                &support(Symmetry::Axisymmetric, None),
                1.0,
            )
        };
        let (one, three) = (of(&[100.0])[0], of(&[0.0, 100.0, 200.0]));
        assert!(three[1] < 0.8 * one && three[1] > 0.0, "{three:?} {one}");
        assert!(three.iter().all(|own| (0.0..=1.0).contains(own)), "{three:?}");
    }

    /// Of a body whose depth is not known, the whole depth of the tool.
    #[test]
    fn nothing_is_taken_off_where_the_body_is_not_known() {
        let own = own_depths(
            &metal(),
            &caps(50.0, &[0.0]),
            &Tool::Plane,
            &support(Symmetry::PlaneStrain, None),
            0.5,
        );
        assert_eq!(own, [0.5]);
    }

    /// Abramowitz and Stegun, table 17.1.
    #[test]
    fn the_elliptic_integral_is_that_of_the_tables() {
        for (m, k) in [(0.0, FRAC_PI_2), (0.5, 1.854_074_677_301_372), (0.99, 3.695_637_362_989_875)] {
            assert!((elliptic(m) / k - 1.0).abs() < 1e-13, "{m}");
        }
    }
}
