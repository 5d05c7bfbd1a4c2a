//! Sizes of elements around a contact, and positions of nodes along a line from a wanted size that varies
//! along it.

use crate::ElementKind;

/// Height of the first row of a core over its depth, for a fineness of 1. The ripple that shells leave is of
/// first order in their width, the bias that rows leave is of second order in their height: with the root of
/// the fineness both fall alike.
const FIRST_ROW_HEIGHT: f64 = 0.435;

/// Height of the last row of a core over that of the first.
const ROW_GROWTH: f64 = 3.0;

/// Width of the column in the middle of a core over that of a column at its end.
const COLUMN_GROWTH: f64 = 5.0;

/// Linear elements that are as exact as one quadratic element, along a line.
pub const LINEAR_PER_QUADRATIC: f64 = 8.0 / 3.0;

/// Depths of a row of contacts within which shells around it stay fine: metal yields that far below touching
/// rows.
const NEAR_ROW: f64 = 3.0;

/// Growth of element sizes with the distance from a contact.
///
/// The front of a contact crosses shell after shell, and the force ripples by a share of their width; along a
/// shell, down from the surface, fields are smooth. So shells are thin and their cells long, the longer the
/// deeper: against square cells the same unknowns leave a third of the error (`docs/src/verified/single.md`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grading {
    /// Width of a shell over its distance from the centre, within the fine zone.
    pub fineness: f64,
    /// Half size of the core over the half width of the contact.
    pub start: f64,
    /// Extent of the fine zone over the half width of the contact.
    pub fine: f64,
    /// Element size over distance far away.
    pub far: f64,
}

impl Grading {
    /// Width of the column in the middle of the core under a contact of the half width `contact`.
    pub fn middle_column(&self, contact: f64) -> f64 {
        COLUMN_GROWTH * self.fineness * self.start * contact
    }

    /// Rows of cells from the surface down to the base of a core, as shares of its depth.
    pub(crate) fn rows(&self, kind: ElementKind) -> Vec<f64> {
        let linear = match kind {
            ElementKind::Quad8 => 1.0,
            ElementKind::Quad4 => LINEAR_PER_QUADRATIC,
        };
        let first = FIRST_ROW_HEIGHT * (self.fineness * linear).sqrt() / linear;
        let rows = divide(0.0, 1.0, &[], |t| first * (1.0 + (ROW_GROWTH - 1.0) * t));
        if rows.len() > 2 { rows } else { vec![0.0, 0.5, 1.0] }
    }

    /// Columns from the centre of a core to its end, where they are as narrow as a shell.
    ///
    /// There are two at least: a core of one column leaves the force 2 % too low beside any mesh of two, and
    /// run and companion would be meshes of two families.
    pub(crate) fn columns(&self, half: f64, kinks: &[f64]) -> Vec<f64> {
        let size = |x: f64| self.fineness * half * (1.0 + (COLUMN_GROWTH - 1.0) * (1.0 - x / half));
        let columns = divide(0.0, half, kinks, size);
        if columns.len() > 2 {
            return columns;
        }
        // halves of the integral of 1/size, which no fineness changes
        vec![0.0, half * (1.0 - (COLUMN_GROWTH.sqrt() - 1.0) / (COLUMN_GROWTH - 1.0)), half]
    }

    /// Wanted size over distance, `x` being the distance in depths of the row.
    pub(crate) fn size_around_row(&self, x: f64) -> f64 {
        let near = (1.5 * self.fineness).min(self.far);
        (self.far + (near - self.far) * NEAR_ROW / x).max(near)
    }

    /// Wanted size at the distance `x` from a contact of half width `contact`.
    pub(crate) fn size(&self, x: f64, contact: f64) -> f64 {
        let fine = self.fine * contact;
        if x < fine {
            self.fineness * x
        } else {
            x * (self.far + (self.fineness - self.far) * fine / x).max(self.fineness)
        }
    }
}

/// Divides [from, to] so that elements have about the size `size(x)`; every `kink` strictly inside becomes a
/// node.
///
/// Between two kinks the number of elements is ∫dx/size, rounded to at least one, and the nodes lie at equal
/// shares of that integral. Kinks closer than a third of an element to each other or to an end are left out.
pub fn divide(from: f64, to: f64, kinks: &[f64], size: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut stops = vec![from];
    for &kink in kinks {
        let gap = size(kink) / 3.0;
        if kink - stops[stops.len() - 1] > gap && to - kink > gap {
            stops.push(kink);
        }
    }
    stops.push(to);
    let mut nodes = vec![from];
    for pair in stops.windows(2) {
        divide_piece(pair[0], pair[1], &size, &mut nodes);
    }
    nodes
}

/// Divides like `divide`, but integrates in the logarithm of the distance, so that decades are resolved.
pub(crate) fn divide_geometric(from: f64, to: f64, kinks: &[f64], size: impl Fn(f64) -> f64) -> Vec<f64> {
    let place = |log: f64| from * log.exp();
    let logs: Vec<f64> = kinks.iter().filter(|&&k| k > from && k < to).map(|k| (k / from).ln()).collect();
    let mut nodes: Vec<f64> =
        divide(0.0, (to / from).ln(), &logs, |l| size(place(l)) / place(l)).into_iter().map(place).collect();
    // kinks and ends exactly, not to the rounding of the logarithm
    for node in &mut nodes {
        for &stop in kinks.iter().chain([&from, &to]) {
            if (*node / stop - 1.0).abs() < 1e-12 {
                *node = stop;
            }
        }
    }
    nodes
}

/// Appends the division of one piece, without its first node.
fn divide_piece(from: f64, to: f64, size: &impl Fn(f64) -> f64, nodes: &mut Vec<f64>) {
    const SAMPLES: usize = 400;
    // the integral of 1/size by the midpoint rule
    let x = |i: usize| from + (to - from) * i as f64 / SAMPLES as f64;
    let mut integral = vec![0.0; SAMPLES + 1];
    for i in 0..SAMPLES {
        let middle = 0.5 * (x(i) + x(i + 1));
        integral[i + 1] = integral[i] + (x(i + 1) - x(i)) / size(middle);
    }
    let total = integral[SAMPLES];
    let count = (total.round() as usize).max(1);
    let mut i = 0;
    for k in 1..count {
        let target = total * k as f64 / count as f64;
        while integral[i + 1] < target {
            i += 1;
        }
        let share = (target - integral[i]) / (integral[i + 1] - integral[i]);
        nodes.push(x(i) + share * (x(i + 1) - x(i)));
    }
    nodes.push(to);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shells_are_four_times_thinner_for_twice_the_rows() {
        let of = |fineness| Grading { fineness, start: 0.2, fine: 1.6, far: 0.4 };
        let rows = |fineness, kind| of(fineness).rows(kind).len() - 1;
        assert_eq!(rows(0.0064, ElementKind::Quad8), 2 * rows(0.0256, ElementKind::Quad8));
        assert!(rows(0.0256, ElementKind::Quad4) > rows(0.0256, ElementKind::Quad8));
        assert_eq!(rows(2.0, ElementKind::Quad8), 2);
        let rows = of(0.02).rows(ElementKind::Quad8);
        let last = rows.len() - 1;
        assert!((rows[1] / (FIRST_ROW_HEIGHT * 0.02_f64.sqrt()) - 1.0).abs() < 0.1, "{}", rows[1]);
        assert!(((rows[last] - rows[last - 1]) / rows[1] / ROW_GROWTH - 1.0).abs() < 0.15);
        // the column at the end of a core is as wide as the shell beside it
        let columns = of(0.02).columns(3.0, &[]);
        let end = columns[columns.len() - 1] - columns[columns.len() - 2];
        assert!((end / (0.02 * 3.0) - 1.0).abs() < 0.1, "{end}");
        // coarse cores keep two, which fewer elements do not move
        let [coarse, coarser] = [0.35, 0.7].map(|fineness| of(fineness).columns(1.0, &[]));
        assert_eq!(coarse.len(), 3);
        assert!(coarse.iter().zip(&coarser).all(|(a, b)| (a - b).abs() < 1e-2), "{coarse:?} {coarser:?}");
    }

    #[test]
    fn kinks_are_nodes_and_sizes_follow_the_wish() {
        let nodes = divide(0.0, 10.0, &[3.3, 3.4, 9.9], |x| 0.2 + 0.2 * x);
        assert!(nodes.contains(&3.3) && !nodes.contains(&3.4) && !nodes.contains(&9.9));
        for pair in nodes.windows(2) {
            let (size, wish) = (pair[1] - pair[0], 0.2 + 0.1 * (pair[0] + pair[1]));
            assert!((size / wish - 1.0).abs() < 0.4, "{size} {wish}");
        }
    }
}
