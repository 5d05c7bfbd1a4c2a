//! Coulomb's friction between tool and surface, as a penalty in the tangent of the tool with a return
//! mapping.
//!
//! A point of the surface that moves by Δ beside the tool slips by Δs = t·Δ along the tangent t of the tool,
//! of which it takes the share φ since it touches. The elastic slip s_e holds the traction q = ε_t s_e, and
//! what would lift that above its limit is slip that is lost:
//! ```text
//! s* = s_e + φ Δs,    q = ε_t s*  where |ε_t s*| ≤ μp,  else ±μp,    s_e ← q/ε_t.
//! ```
//! The elastic slip is kept at places of the edges, which move with the metal: integration points move with
//! the end of contact. Because the traction vanishes with the pressure or with φ where contact begins, the
//! end of contact adds nothing to its derivative.

use crate::contact::edge::{ContactContext, ContactEdge, EdgeContact, GAUSS4};

/// The law of the traction along the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// At most this share of the pressure.
    Coulomb(f64),
    /// What touches sticks.
    Sticking,
}

impl Friction {
    /// Whether a traction is below its limit under this pressure.
    pub(crate) fn sticks(self, traction: f64, pressure: f64) -> bool {
        match self {
            Friction::Coulomb(coefficient) => traction.abs() < (1.0 - 1e-9) * coefficient * pressure,
            Friction::Sticking => true,
        }
    }
}

/// Tangential penalty over the normal one. The traction is a fraction of the pressure: the elastic slip is
/// that fraction of a quarter of the penetration.
const TANGENTIAL_RATIO: f64 = 4.0;

/// Places of an edge, evenly over -1 ≤ ξ ≤ 1, that keep its elastic slip: corners and mid-side are among
/// them.
pub const SLIP_PLACES: usize = 9;

/// Elastic slip at the places of an edge.
pub type EdgeSlip = [f64; SLIP_PLACES];

/// The friction of an increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rubbing {
    /// The law.
    pub friction: Friction,
    /// Height of the tool's lowest point at the converged state.
    pub tip_before: f64,
    /// Whether what touches sticks whatever its law: an infinitesimal unloading.
    pub holds: bool,
}

/// Traction of a point along the tool, per reference area.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shear {
    traction: f64,
    /// What it holds of the slip.
    elastic_slip: f64,
    /// Unit vector along the tool.
    tangent: [f64; 2],
    /// ∂traction/∂s where the point sticks, 0 where it slips.
    stiffness: f64,
    /// Work lost per reference area.
    work: f64,
}

/// Coordinate ξ of a place of an edge.
fn coordinate(place: usize) -> f64 {
    2.0 * place as f64 / (SLIP_PLACES - 1) as f64 - 1.0
}

/// Elastic slip at ξ, straight between the places.
fn between(slip: &EdgeSlip, xi: f64) -> f64 {
    let along = 0.5 * (xi + 1.0) * (SLIP_PLACES - 1) as f64;
    let place = (along.max(0.0) as usize).min(SLIP_PLACES - 2);
    let share = along - place as f64;
    slip[place] + share * (slip[place + 1] - slip[place])
}

impl Rubbing {
    /// Traction at the end `to` of the way of a point from `from`, which held the elastic slip `before`.
    fn shear(&self, context: &ContactContext<'_>, [from, to]: [[f64; 2]; 2], before: f64) -> Shear {
        let penalty = TANGENTIAL_RATIO * context.penalty;
        let earlier = context.tool.penetration(from, self.tip_before).depth;
        let now = context.tool.penetration(to, context.tip);
        let tangent = [now.slope[1], -now.slope[0]];
        // the share of the way since the point touches
        let touching = if earlier < 0.0 && !self.holds {
            (now.depth / (now.depth - earlier)).clamp(0.0, 1.0)
        } else {
            1.0
        };
        let way = [to[0] - from[0], to[1] - from[1] - (context.tip - self.tip_before)];
        let trial = before + touching * (tangent[0] * way[0] + tangent[1] * way[1]);
        let (pressure, earlier) = (context.penalty * now.depth.max(0.0), context.penalty * earlier.max(0.0));
        let coefficient = match self.friction {
            Friction::Coulomb(coefficient) if !self.holds => coefficient,
            _ => f64::INFINITY,
        };
        let stiffness = touching * TANGENTIAL_RATIO * context.spring;
        if self.holds || (penalty * trial).abs() <= coefficient * pressure || coefficient == f64::INFINITY {
            return Shear { traction: penalty * trial, elastic_slip: trial, tangent, stiffness, work: 0.0 };
        }
        let traction = (coefficient * pressure).copysign(trial);
        let elastic_slip = traction / penalty;
        let work = 0.5 * coefficient * (earlier + pressure) * (trial - elastic_slip).abs();
        Shear { traction, elastic_slip, tangent, stiffness: 0.0, work }
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
                let shear = rubbing.shear(context, way, between(&self.slip, xi));
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
                                out.stiffness[a][i][b][j] += w * shear.stiffness * t[i] * t[j] * n[a] * n[b];
                            }
                        }
                    }
                }
            }
        }
    }

    /// The elastic slip that is left where the nodes of the edge have come to `x`: none off the tool.
    pub(crate) fn slip_after(&self, context: &ContactContext<'_>, x: &[[f64; 2]; 3]) -> EdgeSlip {
        let Some(rubbing) = context.rubbing.filter(|_| context.tip.is_finite()) else {
            return [0.0; SLIP_PLACES];
        };
        std::array::from_fn(|place| {
            let xi = coordinate(place);
            let way = [self.point(&self.reference, xi), self.point(x, xi)];
            if context.tool.penetration(way[1], context.tip).depth <= 0.0 {
                return 0.0;
            }
            rubbing.shear(context, way, self.slip[place]).elastic_slip
        })
    }

    /// Traction along the tool at ξ per current area, the edge at rest with its nodes at `x`.
    pub(crate) fn shear_traction(&self, penalty: f64, x: &[[f64; 2]; 3], xi: f64) -> f64 {
        TANGENTIAL_RATIO * penalty * between(&self.slip, xi) / self.stretch(x, xi)
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
