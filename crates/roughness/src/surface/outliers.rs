//! Points that stand out from all around them: dust, and errors of optical instruments.

use crate::surface::height_map::HeightMap;
use rayon::prelude::*;

/// 1.4826 times the median of the absolute values of a normal variable is its standard deviation.
const ROBUST_DEVIATION: f64 = 1.4826;
/// Points that the scatter is taken from, at most.
const SAMPLED_POINTS: usize = 1 << 20;

/// The map without outliers, which become missing, and how many there were.
///
/// A point is an outlier if it lies further from the median of its eight neighbours than `limit` standard
/// deviations of that distance over the map, the deviation by the median of the absolute values, which
/// outliers do not move.
pub(crate) fn without(map: HeightMap, limit: f64) -> (HeightMap, usize) {
    let columns = map.columns();
    let off: Vec<f64> = (0..map.rows())
        .into_par_iter()
        .flat_map_iter(|row| {
            let map = &map;
            (0..columns).map(move |column| off_median(map, column, row))
        })
        .collect();
    let stride = (off.len() / SAMPLED_POINTS).max(1);
    let mut sample: Vec<f64> = off.iter().step_by(stride).map(|d| d.abs()).filter(|d| !d.is_nan()).collect();
    if sample.is_empty() {
        return (map, 0);
    }
    let middle = sample.len() / 2;
    let median = *sample.select_nth_unstable_by(middle, f64::total_cmp).1;
    // of a map that is mostly flat, the root mean square in its place
    let rms = (sample.iter().map(|d| d * d).sum::<f64>() / sample.len() as f64).sqrt();
    let deviation = if median > 0.0 { ROBUST_DEVIATION * median } else { rms };
    let most = limit * deviation;
    let count = off.par_iter().filter(|d| d.abs() > most).count();
    let cleaned = map.mapped(|row, heights| {
        let off = &off[row * columns..(row + 1) * columns];
        heights.iter_mut().zip(off).filter(|(_, d)| d.abs() > most).for_each(|(z, _)| *z = f64::NAN);
    });
    (cleaned.recounted(), count)
}

/// Height above the median of the measured ones among the eight neighbours; NaN where the point or all of
/// them are missing.
fn off_median(map: &HeightMap, column: usize, row: usize) -> f64 {
    let mut around = [0.0; 8];
    let mut count = 0;
    let (columns, rows) = (map.columns() as i64, map.rows() as i64);
    for dy in -1..=1 {
        for dx in -1..=1 {
            let [x, y] = [column as i64 + dx, row as i64 + dy];
            let inside = (0..columns).contains(&x) && (0..rows).contains(&y);
            if (dx, dy) == (0, 0) || !(inside || map.periodic()) {
                continue;
            }
            let z = map.row(y.rem_euclid(rows) as usize)[x.rem_euclid(columns) as usize];
            if !z.is_nan() {
                around[count] = z;
                count += 1;
            }
        }
    }
    let around = &mut around[..count];
    around.sort_by(f64::total_cmp);
    let median = match count {
        0 => f64::NAN,
        n if n.is_multiple_of(2) => 0.5 * (around[n / 2 - 1] + around[n / 2]),
        n => around[n / 2],
    };
    map.row(row)[column] - median
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spikes_go_and_the_surface_stays() {
        let n = 64;
        let mut z: Vec<f64> = (0..n * n)
            .map(|i| {
                ((i % n) as f64 * 0.3).sin()
                    + ((i / n) as f64 * 0.2).cos()
                    + 1e-3 * (i as f64 * i as f64).sin()
            })
            .collect();
        let spikes = [5 * n + 7, 0, 40 * n + 63, 40 * n + 62];
        for i in spikes {
            z[i] += 3.0;
        }
        z[9 * n + 9] = f64::NAN;
        let map = HeightMap::new(n, n, [1.0, 1.0], z.clone()).unwrap();
        let (clean, count) = without(map, 12.0);
        assert_eq!((count, clean.missing()), (4, 5));
        assert!(spikes.iter().all(|i| clean.heights()[*i].is_nan()));
        let flat = HeightMap::new(8, 8, [1.0, 1.0], vec![2.0; 64]).unwrap();
        assert_eq!(without(flat, 3.0).1, 0);
        let none = HeightMap::new(2, 2, [1.0, 1.0], vec![f64::NAN; 4]).unwrap();
        assert_eq!(without(none, 3.0).1, 0);
    }
}
