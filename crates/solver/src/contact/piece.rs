//! How deep a point lies behind a straight piece of the surface, with first and second derivatives.
//!
//! The piece runs from a to b with the body on its left; t = (b - a)/L. With c = (b - a) × (x - a) the depth is d = c/L, so that
//!   ∇d = (∇c - d ∇L)/L,   ∇∇d = (∇∇c - ∇d ⊗ ∇L - ∇L ⊗ ∇d - d ∇∇L)/L,
//! all with respect to (x, a, b): a tangent that is symmetric because it is a second derivative.

/// Values of the point and of the two ends, r and z each.
pub type Ends = [[f64; 2]; 3];

/// A depth and its derivatives with respect to the point and the two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Depth behind the surface; negative outside.
    pub depth: f64,
    /// First derivatives.
    pub slope: [f64; 6],
    /// Second derivatives.
    pub curvature: [[f64; 6]; 6],
}

/// Where the nearest point of a piece lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nearest {
    /// Between its ends.
    Between,
    /// At the end of this number, 0 or 1.
    End(usize),
}

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Distance of the point from the piece, whether it lies behind the line of the piece, and where the nearest point is.
pub fn nearest([x, a, b]: Ends) -> (f64, bool, Nearest) {
    let (along, from) = (difference(b, a), difference(x, a));
    let length = along[0].hypot(along[1]);
    let depth = cross(along, from) / length;
    let share = (along[0] * from[0] + along[1] * from[1]) / (length * length);
    let behind = depth > 0.0;
    match share {
        s if s < 0.0 => (from[0].hypot(from[1]), behind, Nearest::End(0)),
        s if s > 1.0 => {
            let to = difference(x, b);
            (to[0].hypot(to[1]), behind, Nearest::End(1))
        }
        _ => (depth.abs(), behind, Nearest::Between),
    }
}

/// The depth behind the line of the piece.
pub fn behind_line([x, a, b]: Ends) -> Depth {
    let (along, from) = (difference(b, a), difference(x, a));
    let length = along[0].hypot(along[1]);
    let depth = cross(along, from) / length;
    let [tr, tz] = along.map(|along| along / length);
    let of_c = [-along[1], along[0], b[1] - x[1], x[0] - b[0], from[1], -from[0]];
    let of_length = [0.0, 0.0, -tr, -tz, tr, tz];
    let mut slope = [0.0; 6];
    for i in 0..6 {
        slope[i] = (of_c[i] - depth * of_length[i]) / length;
    }
    let mut curvature = [[0.0; 6]; 6];
    // ∇∇c: c is bilinear
    for (i, j, value) in [(1, 4, 1.0), (0, 5, -1.0), (3, 4, -1.0), (2, 5, 1.0), (1, 2, -1.0), (0, 3, 1.0)] {
        curvature[i][j] += value;
        curvature[j][i] += value;
    }
    let flat = [[(1.0 - tr * tr) / length, -tr * tz / length], [-tr * tz / length, (1.0 - tz * tz) / length]];
    for i in 0..6 {
        for j in 0..6 {
            let of_length_twice = match (i, j) {
                (0 | 1, _) | (_, 0 | 1) => 0.0,
                _ if i / 2 == j / 2 => flat[i % 2][j % 2],
                _ => -flat[i % 2][j % 2],
            };
            curvature[i][j] -= slope[i] * of_length[j] + of_length[i] * slope[j] + depth * of_length_twice;
            curvature[i][j] /= length;
        }
    }
    Depth { depth, slope, curvature }
}

/// The distance from the end of number `end`: the depth of a point for which that end is the nearest point of the surface.
pub fn behind_end([x, a, b]: Ends, end: usize) -> Depth {
    let from = difference(x, [a, b][end]);
    let depth = from[0].hypot(from[1]);
    let [ur, uz] = from.map(|from| from / depth);
    let flat = [[1.0 - ur * ur, -ur * uz], [-ur * uz, 1.0 - uz * uz]];
    let (mut slope, mut curvature) = ([0.0; 6], [[0.0; 6]; 6]);
    let places = [(0, 1.0), (2 + 2 * end, -1.0)];
    for (i, sign) in places {
        slope[i] = sign * ur;
        slope[i + 1] = sign * uz;
        for (j, other) in places {
            for k in 0..2 {
                for l in 0..2 {
                    curvature[i + k][j + l] = sign * other * flat[k][l] / depth;
                }
            }
        }
    }
    Depth { depth, slope, curvature }
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

    fn moved(ends: Ends, i: usize, step: f64) -> Ends {
        let mut ends = ends;
        ends[i / 2][i % 2] += step;
        ends
    }

    /// Central differences with a step of 1e-5 are good to 1e-9.
    fn check(depth: impl Fn(Ends) -> Depth, ends: Ends) {
        let (here, step) = (depth(ends), 1e-5);
        for i in 0..6 {
            let (after, before) = (depth(moved(ends, i, step)), depth(moved(ends, i, -step)));
            assert!((here.slope[i] - (after.depth - before.depth) / (2.0 * step)).abs() < 1e-8);
            for j in 0..6 {
                let difference = (after.slope[j] - before.slope[j]) / (2.0 * step);
                assert!((here.curvature[i][j] - difference).abs() < 1e-8, "{i} {j}");
                assert!((here.curvature[i][j] - here.curvature[j][i]).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn derivatives_of_the_depth_are_the_derivatives() {
        let ends = [[0.4, -0.3], [1.1, 0.2], [-0.3, 0.4]];
        check(behind_line, ends);
        check(|ends| behind_end(ends, 0), ends);
        check(|ends| behind_end(ends, 1), ends);
    }

    /// The body lies on the left of a piece: below one that runs towards the axis.
    #[test]
    fn a_point_below_a_top_face_lies_behind_it() {
        let face = |x| [x, [1.0, 2.0], [0.0, 2.0]];
        assert!((behind_line(face([0.3, 1.5])).depth - 0.5).abs() < 1e-15);
        assert_eq!(nearest(face([0.3, 1.5])), (0.5, true, Nearest::Between));
        assert_eq!(nearest(face([0.3, 2.5])), (0.5, false, Nearest::Between));
        assert_eq!(nearest(face([4.0, 6.0])), (5.0, false, Nearest::End(0)));
        assert_eq!(nearest(face([-3.0, -2.0])), (5.0, true, Nearest::End(1)));
    }
}
