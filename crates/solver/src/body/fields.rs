//! Fields at the nodes of a converged state, and the line along the free surface.

use crate::body::discrete_body::Body;
use crate::body::state::State;
use crate::body::surface::Surface;
use crate::contact::edge::GAUSS4;
use crate::contact::parts::{NOTHING, WHOLE};
use crate::contact::slip::Friction;
use crate::element::kernel::POINTS;
use crate::point::kinematic_hardening::yield_function;
use crate::point::material::{hydrostatic, stress, volume_ratio};
use crate::point::tensor::{Sym, von_mises};
use serde::{Deserialize, Serialize};

/// Fields of one increment. Dimensionless as the model's, or in SI once scaled.
#[derive(Clone, Debug, PartialEq)]
pub struct Fields {
    /// Displacement (r, z) of the metal at the nodes.
    pub displacement: Vec<[f64; 2]>,
    /// Cauchy stress at the nodes: rr, zz, θθ, rz.
    pub stress: Vec<Sym>,
    /// Von Mises stress at the nodes.
    pub von_mises: Vec<f64>,
    /// Accumulated plastic strain at the nodes.
    pub plastic_strain: Vec<f64>,
    /// Hydrostatic pressure at the nodes, positive in compression.
    pub pressure: Vec<f64>,
    /// Contact pressure at the nodes, 0 off the contact.
    pub contact_pressure: Vec<f64>,
    /// Distance of the metal at the nodes from first yield: below 0 where it never yielded, von Mises stress
    /// over first yield stress less 1; above 0 where it did, plastic strain over the strain of first yield,
    /// 1 at most. It passes 0 at the edge of what never yielded.
    pub first_yield: Vec<f64>,
    /// Yield function over the yield stress at the nodes: 0 where metal yields, below 0 where it is elastic.
    pub yield_function: Vec<f64>,
    /// Of each cell: 0 never yielded, 1 has yielded, 2 yields in this increment.
    pub plastic_zone: Vec<f64>,
    /// The free surface from the axis outward.
    pub surface: Vec<SurfacePoint>,
}

/// A node of the free surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfacePoint {
    /// Current radius.
    pub r: f64,
    /// Current height over the initial summit.
    pub z: f64,
    /// Displacement along r.
    pub u_r: f64,
    /// Displacement along z.
    pub u_z: f64,
    /// Contact pressure (current area).
    pub pressure: f64,
    /// Shear traction (current area), positive where the tool pushes the surface towards -r; `None` under a
    /// smooth tool.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear_traction: Option<f64>,
    /// True where the surface sticks to the tool there; `None` under a smooth tool.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sticks: Option<bool>,
    /// True where the material there has yielded.
    pub yielded: bool,
}

/// The fields of a converged `state`. Stress and plastic strain at the nodes: see `averaged_at_nodes`.
pub fn fields(body: &Body<'_>, state: &State) -> Fields {
    let averages = averaged_at_nodes(body, state);
    let zone = |cell: usize| {
        let yielded = state.points.states[Body::points_of(cell)].iter().any(|s| s.plastic_strain > 0.0);
        if state.yielding[cell] { 2.0 } else { f64::from(u8::from(yielded)) }
    };
    let displacement: Vec<[f64; 2]> = state
        .position
        .iter()
        .zip(&state.origin)
        .map(|(x, reference)| [x[0] - reference[0], x[1] - reference[1]])
        .collect();
    let stress: Vec<Sym> = averages.iter().map(|s| [s[0], s[1], s[2], s[3]]).collect();
    let mut fields = Fields {
        von_mises: stress.iter().map(von_mises).collect(),
        pressure: stress.iter().map(|s| -hydrostatic(s)).collect(),
        displacement,
        stress,
        plastic_strain: averages.iter().map(|s| s[4].max(0.0)).collect(),
        first_yield: averages.iter().map(|s| s[5]).collect(),
        yield_function: averages.iter().map(|s| s[6]).collect(),
        contact_pressure: contact_pressure(body, state),
        plastic_zone: (0..body.mesh.cell_count()).map(zone).collect(),
        surface: Vec::new(),
    };
    fields.surface = surface_points(body, state, &fields);
    fields
}

/// Values at a node or a point: Cauchy stress, plastic strain, then what [`Fields::first_yield`] and
/// [`Fields::yield_function`] are.
type Values = [f64; 7];

/// The first of the values that tell of yield. They bend where the metal begins to: a line through the points
/// of a cell would leave their range.
const OF_YIELD: usize = 5;

/// The values at the nodes. Point values are extrapolated linearly to the corners of their element and
/// averaged by volume over the elements that share a node, those of yield within the range of the points
/// around; mid-side nodes take the mean of their corners.
pub(super) fn averaged_at_nodes(body: &Body<'_>, state: &State) -> Vec<Values> {
    let mesh = body.mesh;
    let nodes = mesh.nodes.len();
    let mut sums = vec![[0.0; 7]; nodes];
    let mut ranges = vec![[[f64::INFINITY, f64::NEG_INFINITY]; 2]; nodes];
    let mut weights = vec![0.0; nodes];
    // corner value from the points: √3 times their bilinear coordinates
    let root = 3.0_f64.sqrt();
    let (near, side, far) = (0.25 * (1.0 + root).powi(2), 0.25 * (1.0 - 3.0), 0.25 * (1.0 - root).powi(2));
    for cell in 0..mesh.cell_count() {
        let first = Body::points_of(cell).start;
        let values: [Values; POINTS] = std::array::from_fn(|q| values_at(body, state, first + q));
        let range = [0, 1].map(|i| {
            let of_points = values.map(|v| v[OF_YIELD + i]);
            [of_points.into_iter().fold(f64::INFINITY, f64::min), of_points.into_iter().fold(-1.0, f64::max)]
        });
        let volume: f64 = body.volume[Body::points_of(cell)].iter().sum();
        for (corner, &node) in mesh.cell(cell)[..4].iter().enumerate() {
            let coefficient = [near, side, far, side];
            for (step, c) in coefficient.into_iter().enumerate() {
                for (sum, value) in sums[node as usize].iter_mut().zip(values[(corner + step) % 4]) {
                    *sum += volume * c * value;
                }
            }
            weights[node as usize] += volume;
            for (known, new) in ranges[node as usize].iter_mut().zip(range) {
                *known = [known[0].min(new[0]), known[1].max(new[1])];
            }
        }
    }
    for ((sum, weight), range) in sums.iter_mut().zip(&weights).zip(&ranges) {
        if *weight > 0.0 {
            *sum = sum.map(|s| s / weight);
            for (value, [low, high]) in sum[OF_YIELD..].iter_mut().zip(range) {
                *value = value.max(*low).min(*high);
            }
        }
    }
    for cell in 0..mesh.cell_count() {
        let cell = mesh.cell(cell);
        for (k, &middle) in cell.iter().skip(4).enumerate() {
            let (a, b) = (cell[k] as usize, cell[(k + 1) % 4] as usize);
            sums[middle as usize] = std::array::from_fn(|i| 0.5 * (sums[a][i] + sums[b][i]));
        }
    }
    sums
}

/// The values of a point.
fn values_at(body: &Body<'_>, state: &State, point: usize) -> Values {
    let metal = &body.material;
    let now = &state.points.states[point];
    let kirchhoff = stress(&metal.elastic, &now.b_minus_i);
    let j = volume_ratio(&now.b_minus_i);
    let [rr, zz, tt, rz] = kirchhoff.map(|t| t / j);
    let first = metal.virgin().yield_stress;
    let first_yield = match now.plastic_strain {
        strain if strain > 0.0 => (strain * metal.elastic.youngs_modulus / first).min(1.0),
        _ => (von_mises(&kirchhoff) / (now.yield_scale * first) - 1.0).min(0.0),
    };
    let history = state.points.history.get(point);
    [rr, zz, tt, rz, now.plastic_strain, first_yield, yield_function(metal, now, history)]
}

/// The nodes of the free surface, from its outer end inwards, with the `fields` there.
fn surface_points(body: &Body<'_>, state: &State, fields: &Fields) -> Vec<SurfacePoint> {
    let mut surface: Vec<SurfacePoint> = Vec::new();
    let shear = shear_tractions(body, state, &fields.contact_pressure);
    for &edge in &body.mesh.sides.surface {
        // the edge runs counterclockwise around the body: from its outer to its inner corner
        let (corners, middle) = body.mesh.edge_nodes(edge);
        let mut along = vec![corners[1]];
        along.extend(middle);
        along.push(corners[0]);
        for node in along {
            let i = node as usize;
            let ([r, z], [u_r, u_z]) = (state.position[i], fields.displacement[i]);
            let point = SurfacePoint {
                r,
                z,
                u_r,
                u_z,
                pressure: fields.contact_pressure[i],
                shear_traction: shear.as_ref().map(|shear| shear[i].0),
                sticks: shear.as_ref().map(|shear| shear[i].1),
                yielded: fields.plastic_strain[i] > 0.0,
            };
            if surface.last() != Some(&point) {
                surface.push(point);
            }
        }
    }
    surface
}

/// Shear traction at the nodes under this current `pressure`, and whether the surface sticks there; `None`
/// under a smooth tool.
fn shear_tractions(body: &Body<'_>, state: &State, pressure: &[f64]) -> Option<Vec<(f64, bool)>> {
    let friction = body.contact.as_ref()?.friction?;
    let mut shear = vec![0.0; body.mesh.nodes.len()];
    let mut sticks = vec![false; body.mesh.nodes.len()];
    let surface = Surface::of_state(body, state);
    let traction = |i: usize, xi: f64| {
        let edge = &surface.edges[i];
        edge.shear_traction(state.penalty, &edge.nodes.map(|node| state.position[node as usize]), xi)
    };
    for (i, (edge, contact)) in surface.edges.iter().zip(surface.contact).enumerate() {
        if contact.parts == NOTHING {
            continue;
        }
        for (node, xi) in edge.nodes.into_iter().zip([-1.0, 1.0, 0.0]).take(edge.node_count()) {
            let (own, pressure) = (traction(i, xi), surface.nodal_pressure(edge, xi));
            shear[node as usize] = own;
            sticks[node as usize] = pressure > 0.0 && friction.sticks(own, pressure);
        }
    }
    let line = |i: usize| {
        let at = GAUSS4.map(|[xi, weight]| [0.5 * weight, 1.5 * weight * xi].map(|w| w * traction(i, xi)));
        at.into_iter().fold([0.0; 2], |sum, part| [0, 1].map(|k| sum[k] + part[k]))
    };
    let limited = |((own, line), pressure): ((&f64, f64), &f64)| match friction {
        // by symmetry, where it is none at a node itself
        _ if *own == 0.0 => 0.0,
        Friction::Coulomb(coefficient) => line.clamp(-coefficient * pressure, coefficient * pressure),
        Friction::Sticking => line,
    };
    let lined = on_lines(&surface, shear.clone(), line);
    Some(shear.iter().zip(lined).zip(pressure).map(limited).zip(sticks).collect())
}

/// Current pressure at the surface nodes: penalty times penetration, per current area.
fn contact_pressure(body: &Body<'_>, state: &State) -> Vec<f64> {
    let mut pressure = vec![0.0; body.mesh.nodes.len()];
    let surface = Surface::of_state(body, state);
    for (edge, contact) in surface.edges.iter().zip(surface.contact) {
        if contact.parts == NOTHING {
            continue;
        }
        for (node, xi) in edge.nodes.into_iter().zip([-1.0, 1.0, 0.0]).take(edge.node_count()) {
            pressure[node as usize] = surface.nodal_pressure(edge, xi).max(0.0);
        }
    }
    let pressure = on_lines(&surface, pressure, |i| surface.contact[i].line);
    pressure.into_iter().map(|p| p.max(0.0)).collect()
}

/// The `values` of a traction at the nodes, where quadratic edges touch wholly on their `line`, mean and
/// slope over ξ.
///
/// Corners move less under a traction than mid-side nodes: only the line through that of an edge is accurate.
/// Nodes of an edge that touches wholly, as its neighbours do, get that line, and a corner the mean of its
/// two; beside the end of the contact the traction falls too fast for a line.
fn on_lines(surface: &Surface<'_>, mut values: Vec<f64>, line: impl Fn(usize) -> [f64; 2]) -> Vec<f64> {
    let whole: Vec<bool> = surface.contact.iter().map(|contact| contact.parts == WHOLE).collect();
    let inside = |i: usize| whole[i.saturating_sub(1)..whole.len().min(i + 2)].iter().all(|whole| *whole);
    let mut lines = vec![[0.0; 2]; values.len()]; // sum and count
    for (i, edge) in surface.edges.iter().enumerate().take(whole.len()) {
        if !edge.quadratic || !inside(i) {
            continue;
        }
        let [mean, slope] = line(i);
        for (node, value) in edge.nodes.into_iter().zip([mean - slope, mean + slope, mean]) {
            let [sum, count] = &mut lines[node as usize];
            (*sum, *count) = (*sum + value, *count + 1.0);
        }
    }
    for (value, [sum, count]) in values.iter_mut().zip(lines) {
        if count > 0.0 {
            *value = sum / count;
        }
    }
    values
}
