//! The state of a body carried over to other places of its nodes.
//!
//! A new integration point lies in some old element. Elastic logarithmic strain, plastic strain and the last
//! plastic increment are interpolated there from the four points of that element, bilinearly, and so is the
//! first place of its metal from the nodes. A cell that stays keeps its state to the bit.

use crate::body::discrete_body::Body;
use crate::body::energy::contact_sums;
use crate::body::state::State;
use crate::contact::friction::carry_slip;
use crate::contact::self_contact::Facing;
use crate::element::kernel::{GAUSS, POINTS};
use crate::element::{quad4, quad8};
use crate::point::bdf2::{PlasticIncrement, exponential_minus_identity};
use crate::point::material::{PointState, Spectral, volume_ratio};
use crate::point::tensor::{Sym, contract, trace};
use asperity_mesh::{ElementKind, Mesh};

/// Quantities that are transferred to new places of the nodes.
struct Carried {
    /// First place of the metal at each node.
    origin: Vec<[f64; 2]>,
    /// Its displacement in the last increment.
    displacement: Vec<[f64; 2]>,
    /// Reference volume of each integration point.
    volume: Vec<f64>,
    /// Its state.
    states: Vec<PointState>,
    /// Its last plastic increment; empty where the state holds none.
    plastic: Vec<PlasticIncrement>,
    /// Its last change of the volume ratio; empty where the state holds none.
    volume_change: Vec<f64>,
}

/// A place in an element: its number and coordinates (ξ, η).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    cell: usize,
    xi: [f64; 2],
}

/// Shape functions of the corners and mid-sides at (ξ, η), and their slopes; those of an element of four
/// nodes end early.
fn shape(kind: ElementKind, [xi, eta]: [f64; 2]) -> ([f64; 8], [[f64; 2]; 8]) {
    let (mut value, mut slope) = ([0.0; 8], [[0.0; 2]; 8]);
    match kind {
        ElementKind::Quad8 => {
            let point = quad8::shape(xi, eta, 1.0);
            (value, slope) = (point.value, point.slope);
        }
        ElementKind::Quad4 => {
            let point = quad4::shape(xi, eta, 1.0);
            value[..4].copy_from_slice(&point.value);
            slope[..4].copy_from_slice(&point.slope);
        }
    }
    (value, slope)
}

/// The elements of a mesh with their nodes at `position`, to look points up in.
struct Lookup<'a> {
    mesh: &'a Mesh,
    position: &'a [[f64; 2]],
    /// Least and greatest r and z of each element.
    boxes: Vec<[[f64; 2]; 2]>,
}

/// Largest distance, in coordinates of an element, at which a point beside a curved surface may lie outside
/// it.
const LARGEST_WAY_OUTSIDE: f64 = 0.5;

impl<'a> Lookup<'a> {
    fn new(mesh: &'a Mesh, position: &'a [[f64; 2]]) -> Self {
        let boxed = |cell: usize| {
            let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
            for &node in mesh.cell(cell) {
                for i in 0..2 {
                    let x = position[node as usize][i];
                    ends[i] = [ends[i][0].min(x), ends[i][1].max(x)];
                }
            }
            // curved sides bulge beyond their nodes
            ends.map(|[low, high]| {
                let margin = 0.2 * (high - low);
                [low - margin, high + margin]
            })
        };
        Lookup { mesh, position, boxes: (0..mesh.cell_count()).map(boxed).collect() }
    }

    /// Coordinates of the point `x` in an element; `None` where Newton does not find them.
    fn coordinates_inside(&self, cell: usize, x: [f64; 2]) -> Option<[f64; 2]> {
        let mut xi = [0.0; 2];
        for _ in 0..30 {
            let (value, slope) = shape(self.mesh.kind, xi);
            let (mut beyond, mut j) = ([-x[0], -x[1]], [[0.0; 2]; 2]);
            for (a, &node) in self.mesh.cell(cell).iter().enumerate() {
                for i in 0..2 {
                    let at = self.position[node as usize][i];
                    beyond[i] += value[a] * at;
                    j[i][0] += slope[a][0] * at;
                    j[i][1] += slope[a][1] * at;
                }
            }
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            if det == 0.0 || !det.is_finite() {
                return None;
            }
            let step = [
                (j[1][1] * beyond[0] - j[0][1] * beyond[1]) / det,
                (j[0][0] * beyond[1] - j[1][0] * beyond[0]) / det,
            ];
            xi = [0, 1].map(|i| (xi[i] - step[i].clamp(-1.0, 1.0)).clamp(-3.0, 3.0));
            if step[0].hypot(step[1]) < 1e-12 {
                return Some(xi);
            }
        }
        None
    }

    /// The element that holds `x`, or the one that it lies least outside of; `guess` is looked at first.
    fn find(&self, x: [f64; 2], guess: usize) -> Place {
        let outside = |xi: [f64; 2]| xi[0].abs().max(xi[1].abs()) - 1.0;
        let mut nearest: Option<(f64, Place)> = None;
        let boxed = |cell: &usize| {
            (0..2).all(|i| (self.boxes[*cell][i][0]..=self.boxes[*cell][i][1]).contains(&x[i]))
        };
        for cell in std::iter::once(guess).chain(0..self.boxes.len()).filter(boxed) {
            let Some(xi) = self.coordinates_inside(cell, x) else { continue };
            let far = outside(xi);
            if nearest.is_none_or(|(least, _)| far < least) {
                nearest = Some((far, Place { cell, xi }));
            }
            if far <= 0.0 {
                break;
            }
        }
        nearest
            .filter(|(far, _)| *far < LARGEST_WAY_OUTSIDE)
            .map_or_else(|| self.nearest_place(x, guess), |(_, place)| place)
    }

    /// The place nearest to a point that no element holds: where two parts of the surface enclosed a gap that
    /// was cut off.
    fn nearest_place(&self, x: [f64; 2], guess: usize) -> Place {
        let mut nearest = (f64::INFINITY, Place { cell: guess, xi: [0.0; 2] });
        for cell in 0..self.boxes.len() {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            for (xi, &node) in corners.into_iter().zip(self.mesh.cell(cell)) {
                let at = self.position[node as usize];
                let far = (at[0] - x[0]).hypot(at[1] - x[1]);
                if far < nearest.0 {
                    nearest = (far, Place { cell, xi });
                }
            }
        }
        nearest.1
    }
}

/// Share of a plastic strain that its extrapolation beyond the integration points may change it by. Without a
/// limit an element that is crushed flat has points of very different strains, which transfer after transfer
/// drives apart without bound.
const LARGEST_EXTRAPOLATED_SHARE: f64 = 0.25;

/// Weights of the four integration points at (ξ, η): bilinear, and beyond them as far as
/// `LARGEST_EXTRAPOLATED_SHARE` lets the plastic strains of `points`.
fn weights([xi, eta]: [f64; 2], points: &[PointState]) -> [f64; POINTS] {
    let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let bilinear = |[s, t]: [f64; 2]| signs.map(|[a, b]| 0.25 * (1.0 + a * s) * (1.0 + b * t));
    let at = [xi, eta].map(|x| x.clamp(-1.0, 1.0) / GAUSS);
    let (between, beyond) = (bilinear(at.map(|s| s.clamp(-1.0, 1.0))), bilinear(at));
    let plastic_strain = |weights: &[f64; POINTS]| -> f64 {
        weights.iter().zip(points).map(|(weight, point)| weight * point.plastic_strain).sum()
    };
    let [near, far] = [between, beyond].map(|weights| plastic_strain(&weights));
    let change = (far - near).abs();
    let share = if change > 0.0 { (LARGEST_EXTRAPOLATED_SHARE * near / change).min(1.0) } else { 1.0 };
    std::array::from_fn(|i| between[i] + share * (beyond[i] - between[i]))
}

/// Deviator of a strain.
fn deviator(strain: &Sym) -> Sym {
    let mean = trace(strain) / 3.0;
    [strain[0] - mean, strain[1] - mean, strain[2] - mean, strain[3]]
}

/// Von Mises stress of an elastic logarithmic strain.
fn equivalent_stress(body: &Body<'_>, strain: &Sym) -> f64 {
    let dev = deviator(strain);
    2.0 * body.material.elastic.shear_modulus() * (1.5 * contract(&dev, &dev)).sqrt()
}

/// Kirchhoff's stress at yield over the yield stress: J, or 1.
fn measure(body: &Body<'_>, strain: &Sym) -> f64 {
    if body.material.yields_by_true_stress() { trace(strain).exp() } else { 1.0 }
}

/// The point at a place of the old mesh. Its stress takes the mean share of the yield stress, not the mean of
/// the deviators, which is smaller where their directions differ: metal that flows would come out elastic,
/// transfer after transfer.
fn interpolated(body: &Body<'_>, state: &State, place: Place) -> Option<PointState> {
    let range = Body::points_of(place.cell);
    let mut strain: Sym = [0.0; 4];
    let (mut plastic_strain, mut share) = (0.0, 0.0);
    let points = &state.points.states[range];
    for (point, weight) in points.iter().zip(weights(place.xi, points)) {
        let spectral = Spectral::new(&point.b_minus_i).ok()?;
        let logarithm = spectral.tensor(&spectral.log_strain);
        for i in 0..4 {
            strain[i] += weight * logarithm[i];
        }
        plastic_strain += weight * point.plastic_strain;
        share +=
            weight * equivalent_stress(body, &logarithm) / (measure(body, &logarithm) * point.yield_stress);
    }
    let plastic_strain = plastic_strain.max(0.0);
    let virgin = body.material.virgin();
    let yield_stress = body
        .material
        .hardening
        .as_ref()
        .map_or(virgin.yield_stress, |hardening| hardening.flow(plastic_strain).yield_stress);
    let (q, scale) = (equivalent_stress(body, &strain), measure(body, &strain));
    // an elastic body has an infinite yield stress and keeps its deviator
    let wanted = share.clamp(0.0, 1.0) * scale * yield_stress;
    let left = if q > 0.0 && wanted.is_finite() { wanted / q } else { 1.0 };
    let mut doubled = deviator(&strain).map(|e| 2.0 * left * e);
    doubled[..3].iter_mut().for_each(|e| *e += 2.0 / 3.0 * trace(&strain));
    Some(PointState {
        b_minus_i: exponential_minus_identity(&doubled),
        plastic_strain,
        yield_stress,
        yield_scale: scale,
    })
}

/// The state of `body` with its nodes at `places` instead of where `state` has them; `None` where a new cell
/// is inside out.
fn carried_over(body: &Body<'_>, state: &State, places: &[[f64; 2]]) -> Option<Carried> {
    let mesh = body.mesh;
    let lookup = Lookup::new(mesh, &state.position);
    let mut carried = Carried {
        origin: state.origin.clone(),
        displacement: state.displacement.clone(),
        volume: body.volume.clone(),
        states: state.points.states.clone(),
        plastic: state.plastic.clone(),
        volume_change: state.volume_change.clone(),
    };
    let mut looked_up = vec![false; mesh.nodes.len()];
    for cell in 0..mesh.cell_count() {
        let nodes = mesh.cell(cell);
        if nodes.iter().all(|&node| places[node as usize] == state.position[node as usize]) {
            continue;
        }
        for &node in nodes {
            let node = node as usize;
            if looked_up[node] || places[node] == state.position[node] {
                continue;
            }
            looked_up[node] = true;
            let place = lookup.find(places[node], cell);
            let (value, _) = shape(mesh.kind, place.xi);
            let old = mesh.cell(place.cell);
            let at = |values: &[[f64; 2]]| {
                [0, 1].map(|i| old.iter().zip(value).map(|(&n, v)| v * values[n as usize][i]).sum())
            };
            (carried.origin[node], carried.displacement[node]) = (at(&state.origin), at(&state.displacement));
        }
        let volumes = body.volumes_at(places, cell).ok()?;
        let gauss = [[-GAUSS, -GAUSS], [GAUSS, -GAUSS], [GAUSS, GAUSS], [-GAUSS, GAUSS]];
        for ((q, xi), volume) in Body::points_of(cell).zip(gauss).zip(volumes) {
            let (value, _) = shape(mesh.kind, xi);
            let x = [0, 1].map(|i| nodes.iter().zip(value).map(|(&n, v)| v * places[n as usize][i]).sum());
            let place = lookup.find(x, cell);
            carried.states[q] = interpolated(body, state, place)?;
            carried.volume[q] = volume / volume_ratio(&carried.states[q].b_minus_i);
            let old = Body::points_of(place.cell);
            let weights = weights(place.xi, &state.points.states[old.clone()]);
            if let (Some(flow), Some(last)) = (carried.plastic.get_mut(q), state.plastic.get(old.clone())) {
                let sum = |of: &dyn Fn(&PlasticIncrement) -> f64| -> f64 {
                    last.iter().zip(weights).map(|(flow, weight)| weight * of(flow)).sum()
                };
                *flow = PlasticIncrement {
                    strain: std::array::from_fn(|i| sum(&|flow| flow.strain[i])),
                    accumulated: sum(&|flow| flow.accumulated).max(0.0),
                };
            }
            if let (Some(change), Some(last)) =
                (carried.volume_change.get_mut(q), state.volume_change.get(old))
            {
                *change = last.iter().zip(weights).map(|(change, weight)| weight * change).sum();
            }
        }
    }
    Some(carried)
}

impl State {
    /// Elastic energy, plastic work, contact energy and work of friction so far, of which only the work of
    /// the tool may change the sum.
    fn balanced_energy(&self, body: &Body<'_>) -> f64 {
        let [elastic, plastic] = self.energies(body);
        let contact = contact_sums(self.contact.iter(), body.symmetry).energy;
        let kept = contact + self.ledger.self_contact - self.remeasured_energy();
        elastic + plastic + kept + self.ledger.friction_work
    }

    /// Takes down that a transfer from the state `before`, of the body `old`, ended here.
    pub fn note_transfer(&mut self, body: &Body<'_>, before: &State, old: &Body<'_>) {
        self.ledger.transferred =
            before.ledger.transferred + self.balanced_energy(body) - before.balanced_energy(old);
        self.ledger.transfers = before.ledger.transfers + 1;
    }

    /// The body and its state with the nodes at `places`, in touch with the same tool where it stands. It is
    /// not in equilibrium. `None` where a new cell is inside out.
    pub fn moved_to<'m>(&self, body: &Body<'m>, places: Vec<[f64; 2]>) -> Option<(Body<'m>, State)> {
        let carried = carried_over(body, self, &places)?;
        let mut state = self.clone();
        let mut anew = body.clone();
        anew.volume = carried.volume;
        (state.origin, state.points.states) = (carried.origin, carried.states);
        (state.plastic, state.volume_change) = (carried.plastic, carried.volume_change);
        state.edges = body.surface(&places);
        carry_slip(&self.edges, &mut state.edges);
        state.displacement = carried.displacement;
        if let Some(contact) = body.contact.as_ref().filter(|_| self.tip.is_finite()) {
            let context = contact.context(self.tip, self.penalty, body.symmetry);
            let integrate = |edge: &crate::contact::edge::ContactEdge| {
                let x = edge.nodes.map(|node| places[node as usize]);
                edge.integrate(&context, edge.touching(&context, &x), &x)
            };
            state.contact = state.edges.iter().map(integrate).collect();
        }
        state.facing = Facing::new(&state.edges, &places, &state.displacement, &Facing::default());
        state.position = places;
        state.ledger.remeasured[1] = 0.0;
        Some((anew, state))
    }
}
