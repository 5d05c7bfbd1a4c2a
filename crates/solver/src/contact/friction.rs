//! Coulomb's friction between tool and surface, as a penalty in the tangent of the tool with a return
//! mapping.
//!
//! A point of the surface that moves by Δ beside the tool slips by Δs = t·Δ along the tangent t of the tool,
//! of which it takes the share φ since it touches. The elastic slip s_e holds the traction q = ε s_e with the
//! penalty ε of the pressure, and what would lift that above its limit is slip that is lost:
//! ```text
//! s* = s_e + φ Δs,    q = ε s*  where |ε s*| ≤ μp,  else ±μp,    s_e ← q/ε.
//! ```
//! The elastic slip is kept at places of the edges, which move with the metal: integration points move with
//! the end of contact. Because the traction vanishes with the pressure or with φ where contact begins, the
//! end of contact adds nothing to its derivative.

use crate::contact::edge::{ContactContext, ContactEdge, EdgeContact, GAUSS4};
use crate::contact::slip::{EdgeSlip, Friction, Rubbing, SLIP_PLACES, coordinate, slip_between};

/// Traction of a point along the tool, per reference area.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shear {
    traction: f64,
    /// Its share of the slip that is elastic.
    elastic_slip: f64,
    /// Unit vector along the tool.
    tangent: [f64; 2],
    /// Its derivative by the end of the way.
    slope: [f64; 2],
    /// The symmetric part of that: ∂traction/∂s where the point sticks, 0 where it slips.
    stiffness: f64,
    /// ∂tangent_i/∂x_j.
    turn: [[f64; 2]; 2],
    /// Work lost per reference area.
    work: f64,
}

impl Rubbing {
    /// Traction at the end `to` of the way of a point from `from`, which held the elastic slip `before`.
    fn shear(&self, context: &ContactContext<'_>, [from, to]: [[f64; 2]; 2], before: f64) -> Shear {
        let penalty = context.penalty;
        let earlier = context.tool.penetration(from, self.tip_before).depth;
        let now = context.tool.penetration(to, context.tip);
        let tangent = [now.slope[1], -now.slope[0]];
        let [rr, zz, rz] = now.curvature;
        let turn = [[rz, zz], [-rr, -rz]];
        let newly = earlier < 0.0 && !self.holds;
        // the share of the way since the point touches
        let touching = if newly { (now.depth / (now.depth - earlier)).clamp(0.0, 1.0) } else { 1.0 };
        let way = [to[0] - from[0], to[1] - from[1] - (context.tip - self.tip_before)];
        let along = tangent[0] * way[0] + tangent[1] * way[1];
        let trial = before + touching * along;
        let (pressure, pressure_before) =
            (context.penalty * now.depth.max(0.0), context.penalty * earlier.max(0.0));
        let coefficient = match self.friction {
            Friction::Coulomb(coefficient) if !self.holds => coefficient,
            _ => f64::INFINITY,
        };
        if coefficient == f64::INFINITY || (penalty * trial).abs() <= coefficient * pressure {
            let stiffness = touching * context.spring;
            let sooner = if newly { -earlier / (now.depth - earlier).powi(2) } else { 0.0 };
            let slope = [0, 1].map(|j| {
                let turned = turn[0][j] * way[0] + turn[1][j] * way[1];
                stiffness * (tangent[j] + turned) + penalty * along * sooner * now.slope[j]
            });
            return Shear {
                traction: penalty * trial,
                elastic_slip: trial,
                tangent,
                slope,
                stiffness,
                turn,
                work: 0.0,
            };
        }
        let traction = (coefficient * pressure).copysign(trial);
        let elastic_slip = traction / penalty;
        let work = 0.5 * coefficient * (pressure_before + pressure) * (trial - elastic_slip).abs();
        let growth = if pressure > 0.0 { (coefficient * context.spring).copysign(trial) } else { 0.0 };
        let slope = now.slope.map(|n| growth * n);
        Shear { traction, elastic_slip, tangent, slope, stiffness: 0.0, turn, work }
    }
}

impl Rubbing {
    /// Work lost at a point that parts from the tool on its way, per reference area.
    fn work_of_parting(&self, context: &ContactContext<'_>, [from, to]: [[f64; 2]; 2], before: f64) -> f64 {
        let penalty = context.penalty;
        if !context.tip.is_finite() {
            return 0.5 * penalty * before * before;
        }
        let [nr, nz] = context.tool.penetration(from, self.tip_before).slope;
        let along = nz * (to[0] - from[0]) - nr * (to[1] - from[1] - (context.tip - self.tip_before));
        0.5 * penalty * (before * (before + along)).max(0.0)
    }
}

impl ContactEdge {
    /// Adds the traction along the tool over the parts of `out` that touch.
    pub(super) fn rub(
        &self,
        context: &ContactContext<'_>,
        rubbing: &Rubbing,
        x: &[[f64; 2]; 3],
        out: &mut EdgeContact,
    ) {
        let places = self.places(context, x);
        for part in out.parts.into_iter().flatten().filter(|[start, end]| end > start) {
            let points = places.pieces_of(part).flat_map(|[from, to]| {
                GAUSS4.map(|[abscissa, weight]| {
                    [0.5 * (from + to) + 0.5 * (to - from) * abscissa, 0.5 * (to - from) * weight]
                })
            });
            for [xi, weight] in points {
                let n = self.shape(xi);
                let way = [self.point(&self.reference, xi), self.point(x, xi)];
                let shear = rubbing.shear(context, way, slip_between(&self.slip, xi));
                let w = weight * self.measure(xi);
                let t = shear.tangent;
                out.penalty_energy += 0.5 * w * shear.traction * shear.elastic_slip;
                out.friction_work += w * shear.work;
                out.load += w * shear.traction * t[1];
                for a in 0..self.node_count() {
                    for i in 0..2 {
                        out.force[a][i] += w * shear.traction * t[i] * n[a];
                        for b in 0..self.node_count() {
                            for j in 0..2 {
                                let symmetric = shear.stiffness * t[i] * t[j];
                                let whole = t[i] * shear.slope[j] + shear.traction * shear.turn[i][j];
                                out.stiffness[a][i][b][j] += w * symmetric * n[a] * n[b];
                                out.unsymmetric[a][i][b][j] += w * (whole - symmetric) * n[a] * n[b];
                            }
                        }
                    }
                }
            }
        }
    }

    /// The elastic slip that is left where the nodes of the edge have come to `x`, none off the tool; and the
    /// work that is lost where the surface parts from it: the traction falls to nothing along the way.
    pub(crate) fn slip_after(&self, context: &ContactContext<'_>, x: &[[f64; 2]; 3]) -> (EdgeSlip, f64) {
        let (mut slip, mut lost) = ([0.0; SLIP_PLACES], 0.0);
        let Some(rubbing) = context.rubbing else { return (slip, lost) };
        for (place, after) in slip.iter_mut().enumerate() {
            let (xi, before) = (coordinate(place), self.slip[place]);
            let way = [self.point(&self.reference, xi), self.point(x, xi)];
            let touches =
                context.tip.is_finite() && context.tool.penetration(way[1], context.tip).depth > 0.0;
            if touches {
                *after = rubbing.shear(context, way, before).elastic_slip;
            } else if before != 0.0 {
                let ends = if place == 0 || place == SLIP_PLACES - 1 { 0.5 } else { 1.0 };
                let area = ends * 2.0 / (SLIP_PLACES - 1) as f64 * self.measure(xi);
                lost += area * rubbing.work_of_parting(context, way, before);
            }
        }
        (slip, lost)
    }

    /// Traction along the tool at ξ per current area, the edge at rest with its nodes at `x`.
    pub(crate) fn shear_traction(&self, penalty: f64, x: &[[f64; 2]; 3], xi: f64) -> f64 {
        penalty * slip_between(&self.slip, xi) / self.stretch(x, xi)
    }
}

/// The elastic slip of a surface of `edges` on others: that of the nearest place of the old ones.
pub(crate) fn carry_slip(edges: &[ContactEdge], onto: &mut [ContactEdge]) {
    let touching = edges.iter().filter(|edge| edge.slip.iter().any(|slip| *slip != 0.0));
    let pieces: Vec<[([f64; 2], f64); 2]> = touching
        .flat_map(|edge| {
            let place = |k: usize| (edge.point(&edge.reference, coordinate(k)), edge.slip[k]);
            (1..SLIP_PLACES).map(move |k| [place(k - 1), place(k)])
        })
        .collect();
    for edge in onto {
        for place in 0..SLIP_PLACES {
            edge.slip[place] = nearest(&pieces, edge.point(&edge.reference, coordinate(place)));
        }
    }
}

/// Slip at the point of `pieces` that is nearest to `x`; none where that is no foot of `x`: further along the
/// surface than they reach.
fn nearest(pieces: &[[([f64; 2], f64); 2]], x: [f64; 2]) -> f64 {
    let mut least = (f64::INFINITY, 0.0);
    for [(from, first), (to, last)] in pieces {
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0] * along[0] + along[1] * along[1];
        let share = ((x[0] - from[0]) * along[0] + (x[1] - from[1]) * along[1]) / length;
        let on = share.clamp(0.0, 1.0);
        let far = (from[0] + on * along[0] - x[0]).hypot(from[1] + on * along[1] - x[1]);
        if far < least.0 {
            let beyond = (share - on).abs() > 1e-9;
            least = (far, if beyond { 0.0 } else { first + on * (last - first) });
        }
    }
    least.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::tool::Tool;
    use crate::point::kinematics::Symmetry;

    /// A tool at rest with its lowest point at `tip`, 0 before, in plane strain with a penalty of 2.
    fn at_rest(tool: &Tool, tip: f64, friction: Friction) -> ContactContext<'_> {
        let rubbing = Some(Rubbing { friction, tip_before: 0.0, holds: false });
        ContactContext { tool, tip, penalty: 2.0, spring: 2.0, symmetry: Symmetry::PlaneStrain, rubbing }
    }

    /// An edge along a plane, pressed by 0.01 and moved by `slide`, under a plane that stays.
    fn rubbed(friction: Friction, slide: f64) -> (ContactEdge, EdgeContact, EdgeSlip) {
        let place = |node: u32| [f64::from(node), 0.01];
        let edge = ContactEdge::new([0, 1], None, place, Symmetry::PlaneStrain);
        let context = at_rest(&Tool::Plane, 0.0, friction);
        let x = edge.reference.map(|[r, z]| [r + slide, z]);
        let contact = edge.integrate(&context, edge.touching(&context, &x), &x);
        (edge, contact, edge.slip_after(&context, &x).0)
    }

    /// Over a width of 1 the pressure is 0.02: the traction is 2 times the slip up to 0.3 of that, what slips
    /// beyond is lost at that traction.
    #[test]
    fn the_traction_grows_to_its_limit_and_what_slips_beyond_is_lost() {
        for sign in [1.0, -1.0] {
            let (_, stuck, slip) = rubbed(Friction::Coulomb(0.3), sign * 0.002);
            let force: f64 = stuck.force.iter().map(|f| f[0]).sum();
            assert!((force - sign * 0.004).abs() < 1e-15 && stuck.friction_work == 0.0);
            // of the springs across, 0.02 x 0.01 / 2, and along
            assert!((stuck.penalty_energy - 1e-4 - 0.5 * 0.004 * 0.002).abs() < 1e-18);
            assert!(slip.iter().all(|s| (s - sign * 0.002).abs() < 1e-15));
            let (_, slipped, slip) = rubbed(Friction::Coulomb(0.3), sign * 0.01);
            let force: f64 = slipped.force.iter().map(|f| f[0]).sum();
            assert!((force - sign * 0.006).abs() < 1e-15);
            assert!((slipped.friction_work - 0.006 * 0.007).abs() < 1e-15);
            assert!(slip.iter().all(|s| (s - sign * 0.003).abs() < 1e-15));
            let (_, stuck, _) = rubbed(Friction::Sticking, sign * 0.01);
            assert!((stuck.force.iter().map(|f| f[0]).sum::<f64>() - sign * 0.02).abs() < 1e-15);
        }
    }

    /// A point that was 0.01 above the metal and is 0.03 within it has rubbed over three quarters of its way.
    #[test]
    fn what_comes_to_touch_rubs_from_there_on() {
        let place = |node: u32| [f64::from(node), -0.01];
        let edge = ContactEdge::new([0, 1], None, place, Symmetry::PlaneStrain);
        let context = at_rest(&Tool::Plane, 0.0, Friction::Sticking);
        let (slip, _) = edge.slip_after(&context, &edge.reference.map(|[r, z]| [r + 0.004, z + 0.04]));
        assert!(slip.iter().all(|slip| (slip - 0.003).abs() < 1e-15), "{slip:?}");
    }

    /// A traction that grows from 0 to 2 times 0.004 over a width of 1: a third of its force at one node, two
    /// thirds at the other.
    #[test]
    fn nodes_take_the_traction_where_it_is() {
        let (mut edge, ..) = rubbed(Friction::Sticking, 0.0);
        edge.slip = std::array::from_fn(|place| 0.004 * place as f64 / (SLIP_PLACES - 1) as f64);
        let context = at_rest(&Tool::Plane, 0.0, Friction::Sticking);
        let force = edge.integrate(&context, edge.touching(&context, &edge.reference), &edge.reference).force;
        for (node, share) in [(0, 1.0 / 3.0), (1, 2.0 / 3.0)] {
            assert!((force[node][0] - 0.004 * share).abs() < 1e-15, "{force:?}");
        }
    }

    /// An edge that is pressed into a flank and rubs along it: whichever way it does, the tool feels what the
    /// nodes feel.
    #[test]
    fn the_load_is_the_force_of_the_nodes() {
        let tool = Tool::Cone { tan_slope: 0.5, tip_radius: 0.0 };
        let place = |node: u32| [1.0 + f64::from(node), 0.51 + 0.5 * f64::from(node)];
        let edge = ContactEdge::new([0, 1], None, place, Symmetry::PlaneStrain);
        let load = |friction: Friction, slide: f64| {
            let context = at_rest(&tool, 0.0, friction);
            let x = edge.reference.map(|[r, z]| [r + slide, z + 0.5 * slide]);
            let contact = edge.integrate(&context, edge.touching(&context, &x), &x);
            let nodes: f64 = contact.force.iter().map(|force| force[1]).sum();
            assert!((contact.load / nodes - 1.0).abs() < 1e-12, "{slide}: {} {nodes}", contact.load);
            contact.load
        };
        let [up, down] = [0.002, -0.002].map(|slide| load(Friction::Sticking, slide));
        assert!(up > 1.1 * down, "{up} {down}");
    }

    /// Traction 2 times 0.002 over a width of 1, which falls to nothing where the surface parts: half of it
    /// is lost over the elastic slip and the way, none where the way takes the slip back; all energy where
    /// the tool is gone.
    #[test]
    fn what_parts_loses_its_traction_along_the_way() {
        let (mut edge, ..) = rubbed(Friction::Sticking, 0.0);
        edge.slip = [0.002; SLIP_PLACES];
        let lost = |slide: f64, tip: f64| {
            let context = at_rest(&Tool::Plane, tip, Friction::Sticking);
            let (slip, lost) = edge.slip_after(&context, &edge.reference.map(|[r, z]| [r + slide, z - 0.02]));
            assert_eq!(slip, [0.0; SLIP_PLACES]);
            lost
        };
        for (slide, work) in [(0.0, 4e-6), (0.001, 6e-6), (-0.001, 2e-6), (-0.003, 0.0)] {
            assert!((lost(slide, 0.0) - work).abs() < 1e-18, "{slide}: {}", lost(slide, 0.0));
        }
        assert!((lost(0.001, f64::INFINITY) - 4e-6).abs() < 1e-18);
    }

    /// A surface whose nodes move along it keeps its elastic slip where the metal is, and none beyond.
    #[test]
    fn slip_is_carried_over_where_it_was() {
        let edge = |from: f64, to: f64| {
            ContactEdge::new([0, 1], None, |node| [[from, to][node as usize], 0.0], Symmetry::PlaneStrain)
        };
        let mut old = edge(0.0, 1.0);
        old.slip = std::array::from_fn(|place| 0.1 * place as f64);
        let mut new = [edge(0.25, 0.75), edge(1.25, 1.5)];
        carry_slip(&[old], &mut new);
        assert!((new[0].slip[0] - 0.2).abs() < 1e-15 && (new[0].slip[8] - 0.6).abs() < 1e-15);
        assert_eq!(new[1].slip, [0.0; SLIP_PLACES]);
        let pieces = [[([0.0, 0.0], 0.0), ([4.0, 0.0], 0.4)], [([2.9, 0.5], 1.0), ([3.4, 0.5], 2.0)]];
        assert!((nearest(&pieces, [3.0, 0.2]) - 0.3).abs() < 1e-15);
    }
}
