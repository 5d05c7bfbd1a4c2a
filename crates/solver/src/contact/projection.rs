//! Depth of a point of one edge behind another edge, with first and second derivatives.
//!
//! Let y(ξ) be the other edge with the body on its left, t = y' with m = |t|, n its outward normal, κ = n ·
//! y'', and ξ where (x - y) · t = 0. The depth is d = -(x - y) · n. Its first variation is -n · (δx - δy),
//! because ξ is stationary. With a = t · (δx - δy) and b = n · δt, and D = m² + κ d from δξ = (a - d b)/D,
//! its second is
//!   δ²d = (κ a²/m² + 2ab - d b²)/D,
//! a symmetric form. Behind an end v of the edge d = |x - v|.

use crate::contact::edge::ContactEdge;

/// Most nodes of two edges.
pub const NODES_OF_TWO_EDGES: usize = 6;

/// Iterations after which a projection that has not converged is taken as it is: three to five do.
const MOST_PROJECTION_ITERATIONS: usize = 20;

/// An edge with the current positions of its nodes.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    /// The edge.
    pub edge: &'a ContactEdge,
    /// Its nodes.
    pub x: [[f64; 2]; 3],
}

/// The nearest point of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its coordinate on the edge.
    pub xi: f64,
    /// The end that it is, 0 or 1, if it is one.
    pub end: Option<usize>,
    /// Distance of the point.
    pub distance: f64,
    /// True where the point lies on the side of the body.
    pub behind: bool,
}

/// A depth and its derivatives by the nodes: those of the edge of the point, then those of the other one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Depth behind the surface.
    pub depth: f64,
    /// First derivatives.
    pub slope: [[f64; 2]; NODES_OF_TWO_EDGES],
    /// Second derivatives, `[node a][i][node b][j]`.
    pub curvature: [[[[f64; 2]; NODES_OF_TWO_EDGES]; 2]; NODES_OF_TWO_EDGES],
}

/// A linear form of the displacements of the nodes.
type Form = [[f64; 2]; NODES_OF_TWO_EDGES];

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Adds `factor` (a ⊗ b + b ⊗ a)/2.
fn add_product(
    to: &mut [[[[f64; 2]; NODES_OF_TWO_EDGES]; 2]; NODES_OF_TWO_EDGES],
    factor: f64,
    a: &Form,
    b: &Form,
) {
    for (k, l) in (0..NODES_OF_TWO_EDGES).flat_map(|k| (0..NODES_OF_TWO_EDGES).map(move |l| (k, l))) {
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            to[k][i][l][j] += 0.5 * factor * (a[k][i] * b[l][j] + b[k][i] * a[l][j]);
        }
    }
}

impl Placed<'_> {
    /// Position at ξ.
    pub fn point(&self, xi: f64) -> [f64; 2] {
        self.edge.point(&self.x, xi)
    }

    /// Distance between the ends.
    pub fn length(&self) -> f64 {
        let [r, z] = difference(self.x[1], self.x[0]);
        r.hypot(z)
    }

    /// Outward unit normal at ξ.
    fn normal(&self, xi: f64) -> [f64; 2] {
        let [r, z] = self.edge.tangent(&self.x, xi);
        let length = r.hypot(z);
        [z / length, -r / length]
    }

    /// y''.
    fn bend(&self) -> [f64; 2] {
        if !self.edge.quadratic {
            return [0.0; 2];
        }
        [0, 1].map(|i| self.x[0][i] + self.x[1][i] - 2.0 * self.x[2][i])
    }

    /// Coordinate of the nearest point of the chords between neighbouring nodes: where the search begins.
    fn start(&self, here: [f64; 2]) -> f64 {
        let [first, last, middle] = self.x;
        let chords = [(first, middle, -1.0, 1.0), (middle, last, 0.0, 1.0)];
        let chords = if self.edge.quadratic { &chords[..] } else { &[(first, last, -1.0, 2.0)] };
        let near = |&(a, b, from, length): &([f64; 2], [f64; 2], f64, f64)| {
            let along = difference(b, a);
            let share = (dot(difference(here, a), along) / dot(along, along)).clamp(0.0, 1.0);
            let to = difference(here, [a[0] + share * along[0], a[1] + share * along[1]]);
            (dot(to, to), from + share * length)
        };
        chords.iter().map(near).min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, xi)| xi)
    }

    /// The point of the edge nearest to `here`.
    pub fn nearest(&self, here: [f64; 2]) -> Nearest {
        let (mut xi, bend) = (self.start(here), self.bend());
        for _ in 0..MOST_PROJECTION_ITERATIONS {
            let (from, along) = (difference(here, self.point(xi)), self.edge.tangent(&self.x, xi));
            let slope = dot(along, along) - dot(from, bend);
            // far inside the bend the nearest point is not unique: a step along the tangent still goes
            // downhill
            let step = dot(from, along) / if slope > 0.0 { slope } else { dot(along, along) };
            let next = (xi + step).clamp(-1.0, 1.0);
            let converged = (next - xi).abs() < 1e-15;
            xi = next;
            if converged {
                break;
            }
        }
        let from = difference(here, self.point(xi));
        let outwards = dot(from, self.edge.tangent(&self.x, xi)) * xi;
        let end = (xi.abs() == 1.0 && outwards > 0.0).then_some(usize::from(xi > 0.0));
        let behind = dot(from, self.normal(xi)) < 0.0;
        Nearest { xi, end, distance: from[0].hypot(from[1]), behind }
    }

    /// Depth of the point at ξ behind `other`, whose nearest point is `nearest`.
    pub fn depth_behind(&self, xi: f64, other: &Placed<'_>, nearest: &Nearest) -> Depth {
        let count = self.edge.node_count();
        let shape = self.edge.shape(xi);
        // v · (δx - δy) and v · δt
        let apart = |v: [f64; 2], of_other: [f64; 3]| -> Form {
            std::array::from_fn(|k| match k.checked_sub(count) {
                None => v.map(|v| v * shape[k]),
                Some(k) => v.map(|v| -v * of_other.get(k).copied().unwrap_or(0.0)),
            })
        };
        let turned = |v: [f64; 2], slope: [f64; 3]| -> Form {
            std::array::from_fn(|k| match k.checked_sub(count).and_then(|k| slope.get(k)) {
                None => [0.0; 2],
                Some(slope) => v.map(|v| v * slope),
            })
        };
        let from = difference(self.point(xi), other.point(nearest.xi));
        let mut out = Depth {
            depth: nearest.distance,
            slope: [[0.0; 2]; NODES_OF_TWO_EDGES],
            curvature: [[[[0.0; 2]; NODES_OF_TWO_EDGES]; 2]; NODES_OF_TWO_EDGES],
        };
        let of_other = other.edge.shape(nearest.xi);
        if nearest.end.is_some() {
            let u = from.map(|from| from / out.depth);
            let [along, across] = [apart(u, of_other), apart([-u[1], u[0]], of_other)];
            out.slope = along;
            add_product(&mut out.curvature, 1.0 / out.depth, &across, &across);
            return out;
        }
        let (t, n) = (other.edge.tangent(&other.x, nearest.xi), other.normal(nearest.xi));
        let (m2, bend) = (dot(t, t), dot(n, other.bend()));
        out.depth = -dot(from, n);
        out.slope = apart(n.map(|n| -n), of_other);
        let (a, b) = (apart(t, of_other), turned(n, other.edge.slope(nearest.xi)));
        let d = m2 + bend * out.depth;
        add_product(&mut out.curvature, bend / m2 / d, &a, &a);
        add_product(&mut out.curvature, 2.0 / d, &a, &b);
        add_product(&mut out.curvature, -out.depth / d, &b, &b);
        out
    }
}

/// The point that two straight pieces have in common, if they cross.
pub fn intersection([p, q]: [[f64; 2]; 2], [r, s]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let (u, v, w) = (difference(q, p), difference(s, r), difference(r, p));
    let determinant = cross(u, v);
    // parallel pieces that overlap are crossed by their neighbours
    let (along, along_other) = (cross(w, v) / determinant, cross(w, u) / determinant);
    let inside = |t: f64| (0.0..=1.0).contains(&t);
    (inside(along) && inside(along_other)).then(|| [p[0] + along * u[0], p[1] + along * u[1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::kinematics::Symmetry;

    fn edge(quadratic: bool) -> ContactEdge {
        ContactEdge::new([0, 1], quadratic.then_some(2), |_| [0.0; 2], Symmetry::PlaneStrain)
    }

    /// A body below a quadratic or straight edge that runs towards the axis; a point that its own edge
    /// carries.
    fn depth(x: &[[f64; 2]; NODES_OF_TWO_EDGES], quadratic: bool) -> Option<Depth> {
        let (first, second) = (edge(true), edge(quadratic));
        let point = Placed { edge: &first, x: [x[0], x[1], x[2]] };
        let other = Placed { edge: &second, x: [x[3], x[4], x[5]] };
        let nearest = other.nearest(point.point(0.3));
        nearest.behind.then(|| point.depth_behind(0.3, &other, &nearest))
    }

    /// Central differences with a step of 1e-5 are good to 1e-9.
    fn check(x: [[f64; 2]; NODES_OF_TWO_EDGES], quadratic: bool) {
        let here = depth(&x, quadratic).expect("the point lies behind the edge");
        for (k, i) in (0..NODES_OF_TWO_EDGES).flat_map(|k| [(k, 0), (k, 1)]) {
            let [after, before] = [1e-5, -1e-5].map(|step| {
                let mut x = x;
                x[k][i] += step;
                depth(&x, quadratic).unwrap()
            });
            assert!((here.slope[k][i] - (after.depth - before.depth) / 2e-5).abs() < 1e-8, "{k} {i}");
            for (l, j) in (0..NODES_OF_TWO_EDGES).flat_map(|l| [(l, 0), (l, 1)]) {
                let slope = (after.slope[l][j] - before.slope[l][j]) / 2e-5;
                assert!((here.curvature[k][i][l][j] - slope).abs() < 1e-7, "{k} {i} {l} {j}");
                assert!((here.curvature[k][i][l][j] - here.curvature[l][j][k][i]).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn derivatives_of_the_depth_are_the_derivatives() {
        let above = [[0.1, 0.1], [1.0, -0.2], [0.5, 0.1]];
        let other = [[1.3, 0.4], [-0.2, 0.5], [0.6, 0.7]];
        let all = |other: [[f64; 2]; 3]| [above[0], above[1], above[2], other[0], other[1], other[2]];
        check(all(other), true);
        check(all(other), false);
        // the other edge ends before the point
        check(all(other.map(|[r, z]| [r + 1.2, z])), true);
    }

    /// The body lies on the left of an edge: below one that runs towards the axis.
    #[test]
    fn a_point_below_a_top_face_lies_behind_it() {
        let face = edge(true);
        let placed = Placed { edge: &face, x: [[1.0, 2.0], [0.0, 2.0], [0.4, 2.0]] };
        let below = placed.nearest([0.3, 1.5]);
        assert!(below.behind && below.end.is_none() && (below.distance - 0.5).abs() < 1e-15);
        assert!((placed.point(below.xi)[0] - 0.3).abs() < 1e-14);
        assert!(!placed.nearest([0.3, 2.5]).behind);
        let beyond = placed.nearest([4.0, 6.0]);
        assert_eq!((beyond.end, beyond.distance), (Some(0), 5.0));
        assert_eq!(placed.nearest([-3.0, 6.0]).end, Some(1));
    }
}
