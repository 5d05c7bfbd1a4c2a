//! Gaussian areal filters (ISO 16610-61) and the filling of holes.

use crate::surface::gaussian::{Gaussian, Places};
use crate::surface::height_map::{HeightMap, MapError};
use asperity_material::units::rounded;
use rayon::prelude::*;
use std::borrow::Cow;
use thiserror::Error;

/// The reason why a filter cannot be applied.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FilterError {
    /// The cut-off does not fit the map.
    #[error(
        "{name} = {cutoff_um} µm must be at least two pixels ({least_um} µm) and at most the size of the map ({most_um} µm)"
    )]
    Cutoff {
        /// The filter.
        name: &'static str,
        /// Its cut-off, µm.
        cutoff_um: f64,
        /// Two pixels, µm.
        least_um: f64,
        /// The shorter side of the map, µm.
        most_um: f64,
    },
    /// The result is no map.
    #[error(transparent)]
    Map(#[from] MapError),
}

/// Checks that a cut-off (m) is resolved by the pixels and fits the map.
fn checked(map: &HeightMap, name: &'static str, cutoff: f64) -> Result<(), FilterError> {
    let pixel = map.pixel();
    let least = 2.0 * pixel[0].max(pixel[1]);
    let most = (map.columns() as f64 * pixel[0]).min(map.rows() as f64 * pixel[1]);
    if cutoff >= least && cutoff <= most {
        return Ok(());
    }
    let [cutoff_um, least_um, most_um] = [cutoff, least, most].map(|length| rounded(length * 1e6, 6));
    Err(FilterError::Cutoff { name, cutoff_um, least_um, most_um })
}

/// S-filter: removes what is shorter than `cutoff` (m); a wave of that length keeps half its height.
///
/// # Errors
/// A wavelength shorter than the map resolves or longer than it holds.
pub fn s_filter(map: &HeightMap, cutoff: f64) -> Result<HeightMap, FilterError> {
    checked(map, "s_filter", cutoff)?;
    Ok(map.with_heights(smoothed(map, cutoff, all(map)))?)
}

/// [`s_filter`], of which the heights at `kept` along x and y stay; a periodic map stays one where these are
/// as far apart everywhere.
///
/// # Errors
/// A wavelength shorter than the map resolves or longer than it holds; places that make no map.
pub(crate) fn s_filter_at(map: &HeightMap, cutoff: f64, kept: [Places; 2]) -> Result<HeightMap, FilterError> {
    checked(map, "s_filter", cutoff)?;
    let pixel = [0, 1].map(|k| map.pixel()[k] * kept[k].step as f64);
    let heights = smoothed(map, cutoff, kept);
    Ok(HeightMap::new(kept[0].count, kept[1].count, pixel, heights)?.with_periodic(map.periodic()))
}

/// Every place along x and y.
fn all(map: &HeightMap) -> [Places; 2] {
    [map.columns(), map.rows()].map(Places::all)
}

/// L-filter: removes what is longer than `cutoff` (m); a wave of that length keeps half its height.
///
/// # Errors
/// A wavelength shorter than the map resolves or longer than it holds.
pub fn l_filter(map: &HeightMap, cutoff: f64) -> Result<HeightMap, FilterError> {
    checked(map, "l_filter", cutoff)?;
    let waviness = smoothed(map, cutoff, all(map));
    Ok(map.with_heights(map.heights().iter().zip(waviness).map(|(z, w)| z - w).collect())?)
}

/// Mean of the measured heights around each measured node at `kept` along x and y, weighted by the Gaussian
/// of `cutoff`.
///
/// Beyond an edge and in a hole the weight is 0, so that the mean is of what was measured. Without holes the
/// weights are those of a row times those of a column.
fn smoothed(map: &HeightMap, cutoff: f64, kept: [Places; 2]) -> Vec<f64> {
    let (columns, rows, periodic) = (map.columns(), map.rows(), map.periodic());
    let reference = map.heights().iter().copied().find(|z| !z.is_nan()).unwrap_or(0.0);
    let [along_x, along_y] = map.pixel().map(|pixel| Gaussian::with_cutoff(cutoff / pixel));
    let summed = along_x.is_summed_at(kept[0]) && along_y.is_summed_at(kept[1]);
    let blurred = |data: &[f64], offset: f64| {
        if summed {
            let mut lines = along_y.columns_at(data, offset, columns, kept[1], periodic);
            if kept[0] != Places::all(columns) {
                return along_x.rows_at(&lines, columns, kept[0], periodic);
            }
            along_x.along_rows(&mut lines, columns, periodic);
            return lines;
        }
        let mut data: Vec<f64> = data.par_iter().map(|z| z - offset).collect();
        along_x.along_rows(&mut data, columns, periodic);
        picked(along_y.along_columns(data, columns, periodic).into(), columns, kept).into_owned()
    };
    if map.missing() > 0 {
        let over_measured = |value: &(dyn Fn(f64) -> f64 + Sync)| -> Vec<f64> {
            map.heights().par_iter().map(|z| if z.is_nan() { 0.0 } else { value(*z) }).collect()
        };
        let mut mean = blurred(&over_measured(&|z| z - reference), 0.0);
        let weights = blurred(&over_measured(&|_| 1.0), 0.0);
        let own = picked(map.heights().into(), columns, kept);
        mean.par_iter_mut().zip(&weights).zip(&*own).for_each(|((mean, weight), z)| {
            *mean = if z.is_nan() { f64::NAN } else { reference + *mean / weight };
        });
        return mean;
    }
    let mut mean = blurred(map.heights(), reference);
    let weights = |gaussian: &Gaussian, length: usize, kept: Places| -> Vec<f64> {
        let mut line = vec![1.0; length];
        gaussian.along_rows(&mut line, length, periodic);
        kept.iter().map(|place| line[place]).collect()
    };
    let (across, down) = (weights(&along_x, columns, kept[0]), weights(&along_y, rows, kept[1]));
    mean.par_chunks_mut(kept[0].count).zip(&down).for_each(|(line, down)| {
        line.iter_mut().zip(&across).for_each(|(mean, across)| *mean = reference + *mean / (across * down));
    });
    mean
}

/// The numbers at `kept` along x and y of rows of `columns`.
fn picked(data: Cow<'_, [f64]>, columns: usize, kept: [Places; 2]) -> Cow<'_, [f64]> {
    if kept == [Places::all(columns), Places::all(data.len() / columns)] {
        return data;
    }
    let row = |y: usize| &data[y * columns..(y + 1) * columns];
    kept[1].iter().flat_map(|y| kept[0].iter().map(move |x| row(y)[x])).collect()
}

/// Relaxation sweeps after the first fill.
const SWEEPS: usize = 60;

/// Fills the holes smoothly from their rims: coarser and coarser means, then relaxation towards the mean of
/// the neighbours. A map without any height stays as it is.
///
/// # Errors
/// None for a map that exists: its grid is kept.
pub fn fill(map: &HeightMap) -> Result<HeightMap, MapError> {
    if map.missing() == 0 || map.missing() == map.heights().len() {
        return Ok(map.clone());
    }
    let (columns, rows) = (map.columns(), map.rows());
    let mut heights = fill_from_coarser(map.heights(), columns, rows);
    let holes: Vec<usize> = (0..heights.len()).filter(|i| map.heights()[*i].is_nan()).collect();
    for _ in 0..SWEEPS {
        for &i in &holes {
            let (x, y) = (i % columns, i / columns);
            let beside = [
                (x > 0).then(|| heights[i - 1]),
                (x + 1 < columns).then(|| heights[i + 1]),
                (y > 0).then(|| heights[i - columns]),
                (y + 1 < rows).then(|| heights[i + columns]),
            ];
            let (sum, n) = beside.iter().flatten().fold((0.0, 0.0), |(s, n), z| (s + z, n + 1.0));
            if n > 0.0 {
                heights[i] = sum / n;
            }
        }
    }
    map.with_heights(heights)
}

/// Heights with every hole filled from a map of half the size, in which a node is the mean of its measured
/// four.
fn fill_from_coarser(heights: &[f64], columns: usize, rows: usize) -> Vec<f64> {
    if !heights.iter().any(|z| z.is_nan()) {
        return heights.to_vec();
    }
    let (half_columns, half_rows) = (columns.div_ceil(2), rows.div_ceil(2));
    let mut coarse = vec![(0.0, 0.0); half_columns * half_rows];
    for (i, z) in heights.iter().enumerate().filter(|(_, z)| !z.is_nan()) {
        let node = &mut coarse[i / columns / 2 * half_columns + i % columns / 2];
        *node = (node.0 + z, node.1 + 1.0);
    }
    let coarse: Vec<f64> = coarse.iter().map(|(sum, n)| if *n > 0.0 { sum / n } else { f64::NAN }).collect();
    let filled = fill_from_coarser(&coarse, half_columns, half_rows);
    let restored = |(i, z): (usize, &f64)| {
        if z.is_nan() { filled[i / columns / 2 * half_columns + i % columns / 2] } else { *z }
    };
    heights.iter().enumerate().map(restored).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(length: usize, n: usize, holes: bool, periodic: bool) -> HeightMap {
        let z = (0..n * 40).map(|i| {
            let x = (i % n) as f64;
            if holes && (i % 11 == 4 || x < 3.0) {
                f64::NAN
            } else {
                3.0 + (std::f64::consts::TAU * x / length as f64).cos()
            }
        });
        HeightMap::new(n, 40, [0.5, 0.5], z.collect()).unwrap().with_periodic(periodic)
    }

    /// ISO 16610-61: a wave of the cut-off length is halved, exp(-π (α λc/λ)²) in general.
    #[test]
    fn a_wave_keeps_the_share_of_the_standard() {
        for (length, share) in [(16, 0.5), (32, 0.5f64.powf(0.25)), (8, 0.0625)] {
            let map = wave(length, 128, false, true);
            let smooth = s_filter(&map, 8.0).unwrap();
            let rough = l_filter(&map, 8.0).unwrap();
            for i in 0..128 {
                let z = map.heights()[i] - 3.0;
                assert!((smooth.heights()[i] - 3.0 - share * z).abs() < 2e-4, "{length}");
                assert!((rough.heights()[i] - (1.0 - share) * z).abs() < 2e-4);
            }
        }
    }

    #[test]
    fn edges_and_holes_neither_bend_a_constant_nor_spread() {
        let flat = wave(16, 128, true, false)
            .mapped(|_, row| row.iter_mut().filter(|z| !z.is_nan()).for_each(|z| *z = 7.0));
        let smooth = s_filter(&flat, 8.0).unwrap();
        assert_eq!(smooth.missing(), flat.missing());
        assert!(smooth.heights().iter().filter(|z| !z.is_nan()).all(|z| (z - 7.0).abs() < 1e-12));
        assert!(
            s_filter(&flat, 0.9).is_err()
                && l_filter(&flat, 1e3).is_err()
                && l_filter(&flat, f64::NAN).is_err()
        );
    }

    #[test]
    fn holes_are_filled_between_their_rims() {
        let map = wave(64, 128, true, false);
        let filled = fill(&map).unwrap();
        assert_eq!(filled.missing(), 0);
        let whole = wave(64, 128, false, false);
        let worst =
            filled.heights().iter().zip(whole.heights()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 0.1, "{worst}");
        let none = HeightMap::new(2, 2, [1.0, 1.0], vec![f64::NAN; 4]).unwrap();
        assert_eq!(fill(&none).unwrap().missing(), 4);
    }
}
