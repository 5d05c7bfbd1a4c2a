//! Levelling: subtracts the least-squares constant, plane or quadratic from a map.

use crate::surface::height_map::{HeightMap, chunks};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Form that is subtracted from the heights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Levelling {
    /// Nothing.
    None,
    /// The mean height.
    Mean,
    /// The least-squares plane.
    Plane,
    /// The least-squares polynomial of second degree.
    Quadratic,
}

/// Exponents (p, q) of the terms xᵖ y^q, in the order of the coefficients.
const TERMS: [(usize, usize); 6] = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)];

impl Levelling {
    fn terms(self) -> usize {
        match self {
            Levelling::None => 0,
            Levelling::Mean => 1,
            Levelling::Plane => 3,
            Levelling::Quadratic => 6,
        }
    }
}

/// Sums of xᵖ y^q and of xᵖ y^q z over the measured nodes.
#[derive(Clone, Copy, Default)]
struct Sums {
    powers: [[f64; 5]; 5],
    heights: [[f64; 3]; 3],
}

/// Position of node `i` of `n` in -1..1.
fn unit(i: usize, n: usize) -> f64 {
    if n > 1 { 2.0 * i as f64 / (n - 1) as f64 - 1.0 } else { 0.0 }
}

/// The map minus its least-squares constant, plane or quadratic over the measured nodes.
pub fn level(map: HeightMap, level: Levelling) -> HeightMap {
    let terms = level.terms();
    let Some(reference) = map.heights().iter().copied().find(|z| !z.is_nan()).filter(|_| terms > 0) else {
        return map;
    };
    let c = fit(&map, terms, reference);
    let (columns, rows) = (map.columns(), map.rows());
    map.mapped(|row, heights| {
        let y = unit(row, rows);
        let (c0, c1, c2) = (reference + c[0] + y * (c[2] + y * c[5]), c[1] + y * c[4], c[3]);
        for (i, z) in heights.iter_mut().enumerate() {
            let x = unit(i, columns);
            *z -= c0 + x * (c1 + x * c2);
        }
    })
}

/// Coefficients of the `terms` first terms for heights above `reference`.
fn fit(map: &HeightMap, terms: usize, reference: f64) -> [f64; 6] {
    let x: Vec<f64> = (0..map.columns()).map(|i| unit(i, map.columns())).collect();
    let whole_row = row_powers(&x, |_| true);
    let parts = chunks(map.rows(), |rows| {
        let mut sums = Sums::default();
        for row in rows {
            let heights = map.row(row);
            let powers =
                if map.missing() == 0 { whole_row } else { row_powers(&x, |i| !heights[i].is_nan()) };
            let mut h = [0.0; 3];
            for (x, z) in x.iter().zip(heights).filter(|(_, z)| !z.is_nan()) {
                let z = z - reference;
                h[0] += z;
                h[1] += x * z;
                h[2] += x * x * z;
            }
            let y = unit(row, map.rows());
            for p in 0..5 {
                for q in 0..5 - p {
                    sums.powers[p][q] += powers[p] * y.powi(q as i32);
                }
                for q in (0..3).filter(|q| p + q < 3) {
                    sums.heights[p][q] += h[p] * y.powi(q as i32);
                }
            }
        }
        sums
    });
    let add = |total: &mut [f64], part: &[f64]| total.iter_mut().zip(part).for_each(|(t, p)| *t += p);
    let mut total = Sums::default();
    for part in &parts {
        add(total.powers.as_flattened_mut(), part.powers.as_flattened());
        add(total.heights.as_flattened_mut(), part.heights.as_flattened());
    }
    solve(terms, &total)
}

/// Σ xᵖ, p = 0..4, over the nodes of a row that are measured.
fn row_powers(x: &[f64], measured: impl Fn(usize) -> bool) -> [f64; 5] {
    let mut s = [0.0; 5];
    for (_, x) in x.iter().enumerate().filter(|(i, _)| measured(*i)) {
        let mut power = 1.0;
        for sum in &mut s {
            *sum += power;
            power *= x;
        }
    }
    s
}

/// Normal equations by elimination with diagonal pivots; a term the nodes cannot tell apart gets 0.
///
/// `asperity_numerics::least_squares` takes a row per point: for a map of 10^8 nodes the separable sums are
/// ten times cheaper, and it refuses dependent terms, which a single row of nodes always has.
fn solve(terms: usize, sums: &Sums) -> [f64; 6] {
    let mut a = [[0.0; 7]; 6];
    for i in 0..terms {
        for j in 0..terms {
            a[i][j] = sums.powers[TERMS[i].0 + TERMS[j].0][TERMS[i].1 + TERMS[j].1];
        }
        a[i][6] = sums.heights[TERMS[i].0][TERMS[i].1];
    }
    let scale = sums.powers[0][0];
    let mut left: Vec<usize> = (0..terms).collect();
    let mut used = Vec::new();
    while let Some(at) =
        (0..left.len()).max_by(|i, j| a[left[*i]][left[*i]].total_cmp(&a[left[*j]][left[*j]]))
    {
        let k = left.swap_remove(at);
        if a[k][k] <= 1e-12 * scale {
            break;
        }
        used.push(k);
        let pivot_row = a[k];
        for i in (0..terms).filter(|i| *i != k) {
            let factor = a[i][k] / pivot_row[k];
            for j in 0..7 {
                a[i][j] -= factor * pivot_row[j];
            }
        }
    }
    let mut c = [0.0; 6];
    used.iter().for_each(|k| c[*k] = a[*k][6] / a[*k][*k]);
    c
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(holes: bool) -> HeightMap {
        let (nx, ny) = (70, 41);
        let z = (0..nx * ny)
            .map(|i| {
                let (x, y) = ((i % nx) as f64, (i / nx) as f64);
                let hole = holes && (i % 7 == 3 || x < 5.0);
                if hole {
                    f64::NAN
                } else {
                    76.0 + 1e-3 * (x - 0.3 * y + 1e-2 * x * x - 0.02 * x * y + 0.05 * y * y)
                }
            })
            .collect();
        HeightMap::new(nx, ny, [1.0, 2.0], z).unwrap()
    }

    #[test]
    fn a_quadratic_is_levelled_to_nothing_with_and_without_holes() {
        for holes in [false, true] {
            let flat = level(polynomial(holes), Levelling::Quadratic);
            assert!(flat.heights().iter().filter(|z| !z.is_nan()).all(|z| z.abs() < 1e-13));
            let plane = level(polynomial(holes), Levelling::Plane);
            let left: Vec<f64> = plane.heights().iter().copied().filter(|z| !z.is_nan()).collect();
            assert!(left.iter().sum::<f64>().abs() / (left.len() as f64) < 1e-13);
            assert!(left.iter().any(|z| z.abs() > 1e-3));
            assert_eq!(
                level(polynomial(holes), Levelling::None).heights()[3].to_bits(),
                polynomial(holes).heights()[3].to_bits()
            );
        }
    }

    #[test]
    fn a_single_row_or_a_single_point_can_be_levelled() {
        let row = HeightMap::new(5, 1, [1.0, 1.0], vec![1.0, 2.0, 3.0, 4.0, 5.0]).unwrap();
        assert!(level(row, Levelling::Plane).heights().iter().all(|z| z.abs() < 1e-15));
        for kind in [Levelling::Mean, Levelling::Plane, Levelling::Quadratic] {
            let point = HeightMap::new(2, 1, [1.0, 1.0], vec![f64::NAN, 7.0]).unwrap();
            assert_eq!(level(point, kind).heights()[1], 0.0);
        }
        let none = HeightMap::new(2, 1, [1.0, 1.0], vec![f64::NAN; 2]).unwrap();
        assert_eq!(level(none, Levelling::Plane).missing(), 2);
    }
}
