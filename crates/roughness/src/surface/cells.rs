//! One cell of the map: four triangles about the mean of its corners, cut by a plane of constant height.
//!
//! Corners run around the cell, (0,0), (1,0), (1,1), (0,1) in pixels; side s joins corners s and s+1, and
//! triangle s stands on side s with its tip in the middle. Each triangle is a quarter of the cell.

/// Positions of the corners, in pixels.
const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
const CENTRE: [f64; 2] = [0.5, 0.5];

/// Height in the middle of the cell.
#[inline]
pub(crate) fn centre(corners: &[f64; 4]) -> f64 {
    0.25 * ((corners[0] + corners[1]) + (corners[2] + corners[3]))
}

/// |∇h| of the four triangles for pixels of `pixel` = [dx, dy], in units of height over units of `pixel`.
#[inline]
pub(crate) fn gradients(corners: &[f64; 4], inverse_pixel: [f64; 2]) -> [f64; 4] {
    squared_gradients(corners, inverse_pixel).map(f64::sqrt)
}

/// |∇h|² of the same.
#[inline]
pub(crate) fn squared_gradients(corners: &[f64; 4], inverse_pixel: [f64; 2]) -> [f64; 4] {
    let [a, b, c, d] = *corners;
    let (x_low, x_high) = ((b - a) * inverse_pixel[0], (c - d) * inverse_pixel[0]);
    let (y_low, y_high) = ((d - a) * inverse_pixel[1], (c - b) * inverse_pixel[1]);
    let (x, y) = (0.5 * (x_low + x_high), 0.5 * (y_low + y_high));
    [x_low * x_low + y * y, x * x + y_high * y_high, x_high * x_high + y * y, x * x + y_low * y_low]
}

/// |∇h| of a whole cell on the mean.
#[inline]
pub(crate) fn mean_gradient(corners: &[f64; 4], inverse_pixel: [f64; 2]) -> f64 {
    let g = gradients(corners, inverse_pixel);
    0.25 * ((g[0] + g[1]) + (g[2] + g[3]))
}

/// ∫|∇h|, in cells, over whole cells in a row between the nodes `low` and `high`.
pub(crate) fn whole_slopes(low: &[f64], high: &[f64], inverse_pixel: [f64; 2]) -> f64 {
    low.windows(2)
        .zip(high.windows(2))
        .map(|(a, b)| mean_gradient(&[a[0], a[1], b[1], b[0]], inverse_pixel))
        .sum()
}

/// The share of a triangle that lies above 0, from the heights of its vertices.
#[inline]
pub(crate) fn share_above(a: f64, b: f64, c: f64) -> f64 {
    // one vertex above: the corner cut off at it; two above: all but the corner below
    let corner = |tip: f64, u: f64, v: f64| (tip / (tip - u)) * (tip / (tip - v));
    match (a > 0.0, b > 0.0, c > 0.0) {
        (false, false, false) => 0.0,
        (true, true, true) => 1.0,
        (true, false, false) => corner(a, b, c),
        (false, true, false) => corner(b, c, a),
        (false, false, true) => corner(c, a, b),
        (false, true, true) => 1.0 - corner(a, b, c),
        (true, false, true) => 1.0 - corner(b, c, a),
        (true, true, false) => 1.0 - corner(c, a, b),
    }
}

/// ∫h over the part of a triangle of unit area that lies above 0, from the heights of its vertices.
#[inline]
fn volume_above(a: f64, b: f64, c: f64) -> f64 {
    let whole = (a + b + c) / 3.0;
    // the corner cut off at a vertex is a pyramid; a corner below has a volume below 0
    let corner = |tip: f64, u: f64, v: f64| (tip / (tip - u)) * (tip / (tip - v)) * tip / 3.0;
    match (a > 0.0, b > 0.0, c > 0.0) {
        (false, false, false) => 0.0,
        (true, true, true) => whole,
        (true, false, false) => corner(a, b, c),
        (false, true, false) => corner(b, c, a),
        (false, false, true) => corner(c, a, b),
        (false, true, true) => whole - corner(a, b, c),
        (true, false, true) => whole - corner(b, c, a),
        (true, true, false) => whole - corner(c, a, b),
    }
}

/// Mean height above 0 of the part of a cell that lies above; 0 where nothing does.
pub(crate) fn mean_above(corners: &[f64; 4]) -> f64 {
    let middle = centre(corners);
    let (mut area, mut volume) = (0.0, 0.0);
    for s in 0..4 {
        let (a, b) = (corners[s], corners[(s + 1) % 4]);
        area += share_above(a, b, middle);
        volume += volume_above(a, b, middle);
    }
    if area > 0.0 { volume / area } else { 0.0 }
}

/// Area above 0 and ∫|∇h| over it, in cells, of a cell whose corner heights are relative to the plane.
#[inline]
pub(crate) fn area_above(corners: &[f64; 4], inverse_pixel: [f64; 2]) -> (f64, f64) {
    let middle = centre(corners);
    let slope = gradients(corners, inverse_pixel);
    let mut area = 0.0;
    let mut slope_area = 0.0;
    for s in 0..4 {
        let share = 0.25 * share_above(corners[s], corners[(s + 1) % 4], middle);
        area += share;
        slope_area += share * slope[s];
    }
    (area, slope_area)
}

/// Area integrals of 1, |∇h|, x, y, x², xy, y² over a region, lengths in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moments {
    pub area: f64,
    pub slope_area: f64,
    pub x: f64,
    pub y: f64,
    pub xx: f64,
    pub xy: f64,
    pub yy: f64,
}

impl Moments {
    /// A whole cell, origin at corner 0.
    #[inline]
    pub fn of_cell(slope: f64) -> Moments {
        let (half, third) = (0.5, 1.0 / 3.0);
        Moments { area: 1.0, slope_area: slope, x: half, y: half, xx: third, xy: half * half, yy: third }
    }

    /// Adds those of another region.
    #[inline]
    pub fn add(&mut self, other: &Moments) {
        self.area += other.area;
        self.slope_area += other.slope_area;
        self.x += other.x;
        self.y += other.y;
        self.xx += other.xx;
        self.xy += other.xy;
        self.yy += other.yy;
    }

    /// The same region seen from an origin that lies (-`dx`, -`dy`) from the old one.
    #[inline]
    pub fn moved(&self, dx: f64, dy: f64) -> Moments {
        Moments {
            area: self.area,
            slope_area: self.slope_area,
            x: self.x + dx * self.area,
            y: self.y + dy * self.area,
            xx: self.xx + dx * (2.0 * self.x + dx * self.area),
            xy: self.xy + dx * self.y + dy * self.x + dx * dy * self.area,
            yy: self.yy + dy * (2.0 * self.y + dy * self.area),
        }
    }

    /// Adds `sign` times a triangle of the given area, vertices and slope.
    #[inline]
    fn add_triangle(&mut self, sign_area: f64, slope: f64, p: [[f64; 2]; 3]) {
        let (sx, sy) = (p[0][0] + p[1][0] + p[2][0], p[0][1] + p[1][1] + p[2][1]);
        let dot = |i: usize, j: usize| p[0][i] * p[0][j] + p[1][i] * p[1][j] + p[2][i] * p[2][j];
        self.area += sign_area;
        self.slope_area += sign_area * slope;
        self.x += sign_area * sx / 3.0;
        self.y += sign_area * sy / 3.0;
        self.xx += sign_area * (dot(0, 0) + sx * sx) / 12.0;
        self.xy += sign_area * (dot(0, 1) + sx * sy) / 12.0;
        self.yy += sign_area * (dot(1, 1) + sy * sy) / 12.0;
    }
}

/// The corner of a triangle beside `tip`, cut by height 0: area relative to the triangle, and vertices.
fn cut_corner(tip: usize, p: &[[f64; 2]; 3], z: &[f64; 3]) -> (f64, [[f64; 2]; 3]) {
    let towards = |other: usize| {
        let t = z[tip] / (z[tip] - z[other]);
        (t, [p[tip][0] + t * (p[other][0] - p[tip][0]), p[tip][1] + t * (p[other][1] - p[tip][1])])
    };
    let ((t, u), (s, v)) = (towards((tip + 1) % 3), towards((tip + 2) % 3));
    (t * s, [p[tip], u, v])
}

/// Moments of what lies above 0 in the triangles named by `sides` (bit s: triangle s), origin at corner 0.
pub(crate) fn moments_above(corners: &[f64; 4], sides: u8, inverse_pixel: [f64; 2]) -> Moments {
    let middle = centre(corners);
    let slope = gradients(corners, inverse_pixel);
    let mut total = Moments::default();
    for s in (0..4).filter(|s| sides & (1 << s) != 0) {
        let next = (s + 1) % 4;
        let p = [CORNERS[s], CORNERS[next], CENTRE];
        let z = [corners[s], corners[next], middle];
        let up = z.map(|z| z > 0.0);
        match up.iter().filter(|u| **u).count() {
            0 => {}
            3 => total.add_triangle(0.25, slope[s], p),
            n => {
                let odd = (0..3).find(|i| up[*i] == (n == 1)).unwrap_or(0);
                let (share, corner) = cut_corner(odd, &p, &z);
                if n == 1 {
                    total.add_triangle(0.25 * share, slope[s], corner);
                } else {
                    total.add_triangle(0.25, slope[s], p);
                    total.add_triangle(-0.25 * share, slope[s], corner);
                }
            }
        }
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_half_covered_cell_has_the_moments_of_half_a_square() {
        // h = 0.5 - x: the left half is above
        let m = moments_above(&[0.5, -0.5, -0.5, 0.5], 15, [1.0, 1.0]);
        for (got, want) in [
            (m.area, 0.5),
            (m.slope_area, 0.5),
            (m.x, 0.125),
            (m.y, 0.25),
            (m.xx, 1.0 / 24.0),
            (m.xy, 0.0625),
            (m.yy, 1.0 / 6.0),
        ] {
            assert!((got - want).abs() < 1e-15, "{got} {want}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn above_and_below_make_the_whole_cell(z in prop::array::uniform4(-1.0..1.0f64)) {
            let whole = moments_above(&z.map(|v| v + 3.0), 15, [1.0, 2.0]);
            let mut sum = moments_above(&z, 15, [1.0, 2.0]);
            let (area, slope_area) = area_above(&z, [1.0, 2.0]);
            prop_assert!((sum.area - area).abs() < 1e-14 && (sum.slope_area - slope_area).abs() < 1e-13);
            sum.add(&moments_above(&z.map(|v| -v), 15, [1.0, 2.0]));
            for (a, b) in [(sum.area, whole.area), (sum.slope_area, whole.slope_area), (sum.x, whole.x),
                (sum.y, whole.y), (sum.xx, whole.xx), (sum.xy, whole.xy), (sum.yy, whole.yy)] {
                prop_assert!((a - b).abs() < 1e-13);
            }
        }

        #[test]
        fn moving_the_origin_there_and_back_changes_nothing(z in prop::array::uniform4(-1.0..1.0f64), dx in -9.0..9.0f64, dy in -9.0..9.0f64) {
            let m = moments_above(&z, 15, [1.0, 1.0]);
            let back = m.moved(dx, dy).moved(-dx, -dy);
            prop_assert!((back.xx - m.xx).abs() < 1e-12 && (back.xy - m.xy).abs() < 1e-12 && (back.y - m.y).abs() < 1e-13);
        }
    }
}
