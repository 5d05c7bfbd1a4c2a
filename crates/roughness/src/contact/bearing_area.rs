//! Area and slope integral above many planes at once, without naming islands.
//!
//! For closures linear in tan β the load needs only S(d) = ∫_{h>d} |∇h| dA. It is summed cell by cell at
//! equally spaced heights (planes) in one pass; a cell that no plane cuts costs one addition.

use crate::surface::cells;
use crate::surface::height_map::{Extent, HeightMap};
use rayon::prelude::*;

/// Planes of one pass of the search.
const PLANES: usize = 64;
/// Planes of a pass that narrows a bracket, and the number of cells that is few.
const NARROWING_PLANES: usize = 9;
const FEW_CELLS: usize = 256;
/// Cells above which a first estimate looks at one in `SAMPLED_ROW_STRIDE` rows only.
const LARGE_MAP_CELLS: usize = 1 << 20;
const SAMPLED_ROW_STRIDE: usize = 8;
/// Relative residual at which the search for a separation ends.
const LOAD_RESIDUAL: f64 = 1e-11;

/// Bearing area above one plane, and the integral of |∇h| over it, in cells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Above {
    /// Area above the plane, in cells.
    pub area: f64,
    /// ∫|∇h| dA above the plane, in cells.
    pub slope_area: f64,
}

impl Above {
    /// Adds what another part of the surface has above the plane.
    pub fn add(&mut self, other: Above) {
        self.area += other.area;
        self.slope_area += other.slope_area;
    }

    fn minus(self, other: Above) -> Above {
        Above { area: self.area - other.area, slope_area: self.slope_area - other.slope_area }
    }
}

/// Equally spaced heights low, low + step, … in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planes {
    /// Lowest plane.
    pub low: f64,
    /// Distance of two planes, above 0.
    pub step: f64,
    /// Their number.
    pub count: usize,
}

impl Planes {
    /// `count` ≥ 2 planes from `low` to `high`.
    pub fn evenly_spaced(low: f64, high: f64, count: usize) -> Planes {
        Planes { low, step: (high - low) / (count - 1) as f64, count }
    }

    /// Height of plane `k`.
    pub fn height(&self, k: usize) -> f64 {
        self.low + k as f64 * self.step
    }

    /// The highest plane that is not above `height`, which is not below the lowest.
    fn at_or_below(&self, height: f64) -> usize {
        (((height - self.low) / self.step) as usize).min(self.count - 1)
    }
}

/// Sums on the planes: `whole[k]` counts for plane k and all below it, `cut[k]` for plane k alone.
struct Tally {
    planes: Planes,
    inverse_pixel: [f64; 2],
    whole: Vec<Above>,
    cut: Vec<Above>,
}

impl Tally {
    fn new(planes: Planes, inverse_pixel: [f64; 2]) -> Tally {
        let zero = vec![Above::default(); planes.count];
        Tally { planes, inverse_pixel, whole: zero.clone(), cut: zero }
    }

    #[inline]
    fn add_cell(&mut self, z: &[f64; 4]) {
        let high = z[0].max(z[1]).max(z[2].max(z[3]));
        if high <= self.planes.low {
            return;
        }
        let low = z[0].min(z[1]).min(z[2].min(z[3]));
        let slopes = cells::gradients(z, self.inverse_pixel);
        if low >= self.planes.low {
            let top = self.planes.at_or_below(low);
            if top == self.planes.at_or_below(high) {
                let slope_area = 0.25 * ((slopes[0] + slopes[1]) + (slopes[2] + slopes[3]));
                self.whole[top].add(Above { area: 1.0, slope_area });
                return;
            }
        }
        let middle = cells::centre(z);
        for s in 0..4 {
            self.add_triangle([z[s], z[(s + 1) % 4], middle], slopes[s]);
        }
    }

    /// A quarter of a cell with these heights at its corners: the part above height d is quadratic in d, in
    /// two pieces.
    #[inline]
    fn add_triangle(&mut self, z: [f64; 3], slope: f64) {
        let (least, most) = (z[0].min(z[1]), z[0].max(z[1]));
        let (low, high) = (least.min(z[2]), most.max(z[2]));
        let middle = least.max(most.min(z[2]));
        if high <= self.planes.low {
            return;
        }
        let quarter = |share: f64| Above { area: 0.25 * share, slope_area: 0.25 * share * slope };
        let mut next = 0;
        if low >= self.planes.low {
            let top = self.planes.at_or_below(low);
            self.whole[top].add(quarter(1.0));
            next = top + 1;
        }
        // infinite where two heights are equal; no plane lies between those
        let (below, over) = (1.0 / ((middle - low) * (high - low)), 1.0 / ((high - middle) * (high - low)));
        while next < self.planes.count {
            let plane = self.planes.height(next);
            if plane >= high {
                break;
            }
            let share = if plane <= low {
                1.0
            } else if plane <= middle {
                1.0 - (plane - low) * (plane - low) * below
            } else {
                (high - plane) * (high - plane) * over
            };
            self.cut[next].add(quarter(share));
            next += 1;
        }
    }

    fn merge(&mut self, other: &Tally) {
        self.whole.iter_mut().zip(&other.whole).for_each(|(a, b)| a.add(*b));
        self.cut.iter_mut().zip(&other.cut).for_each(|(a, b)| a.add(*b));
    }

    fn finish(mut self) -> Vec<Above> {
        let mut running = Above::default();
        for k in (0..self.planes.count).rev() {
            running.add(self.whole[k]);
            self.cut[k].add(running);
        }
        self.cut
    }
}

/// Sums `parts` made in parallel, in their order.
fn joined(planes: Planes, inverse_pixel: [f64; 2], parts: Vec<Tally>) -> Vec<Above> {
    let mut total = Tally::new(planes, inverse_pixel);
    parts.iter().for_each(|part| total.merge(part));
    total.finish()
}

/// Bearing area of the map above each plane.
pub fn above_planes(map: &HeightMap, planes: Planes) -> Vec<Above> {
    above_planes_in_rows(map, planes, 1)
}

/// The same from every `stride`-th row of cells alone.
fn above_planes_in_rows(map: &HeightMap, planes: Planes, stride: usize) -> Vec<Above> {
    let inverse_pixel = map.inverse_pixel();
    let parts = map.chunks(|rows| {
        let mut tally = Tally::new(planes, inverse_pixel);
        let rows = rows.filter(|row| row % stride == 0);
        rows.for_each(|row| map.for_each_cell(row, |z| tally.add_cell(&z)));
        tally
    });
    joined(planes, inverse_pixel, parts)
}

/// Bearing area above each of 64 planes over the whole height: an estimate from some of the rows of a large
/// map.
pub(crate) fn estimate(map: &HeightMap, extent: &Extent) -> (Planes, Vec<Above>) {
    let planes = Planes::evenly_spaced(extent.low, extent.high, PLANES);
    let stride = if extent.cells > LARGE_MAP_CELLS { SAMPLED_ROW_STRIDE } else { 1 };
    let mut sums = above_planes_in_rows(map, planes, stride);
    // scaled by the whole area, which the lowest plane has above it
    let scale = if sums[0].area > 0.0 { extent.cells as f64 / sums[0].area } else { 1.0 };
    for sum in &mut sums {
        *sum = Above { area: sum.area * scale, slope_area: sum.slope_area * scale };
    }
    (planes, sums)
}

/// Cells that the bracket cuts, and what the cells wholly above it add.
struct Bracket {
    low: f64,
    high: f64,
    cells: Vec<[f64; 4]>,
    base: Above,
    inverse_pixel: [f64; 2],
}

const CELLS_PER_CHUNK: usize = 1 << 15;

impl Bracket {
    fn above_planes(&self, planes: Planes) -> Vec<Above> {
        let parts = self
            .cells
            .par_chunks(CELLS_PER_CHUNK)
            .map(|cells| {
                let mut tally = Tally::new(planes, self.inverse_pixel);
                cells.iter().for_each(|z| tally.add_cell(z));
                tally
            })
            .collect();
        let mut sums = joined(planes, self.inverse_pixel, parts);
        sums.iter_mut().for_each(|s| s.add(self.base));
        sums
    }

    fn above_plane(&self, plane: f64) -> Above {
        self.above_planes(Planes { low: plane, step: 1.0, count: 1 })[0]
    }

    /// The bracket between two heights inside this one; `top` is what lies above the upper.
    fn narrowed(self, low: f64, high: f64, top: Above) -> Bracket {
        let cells: Vec<_> = self.cells.into_par_iter().filter(|z| is_cut(z, low, high)).collect();
        Bracket { cells, low, high, base: Above::default(), inverse_pixel: self.inverse_pixel }.with_top(top)
    }

    fn with_top(mut self, top: Above) -> Bracket {
        self.base = top.minus(self.above_plane(self.high));
        self
    }
}

fn is_cut(z: &[f64; 4], low: f64, high: f64) -> bool {
    z[0].max(z[1]).max(z[2].max(z[3])) > low && z[0].min(z[1]).min(z[2].min(z[3])) < high
}

/// The height d with ∫_{h>d} |∇h| dA = `wanted` (in cells), and what lies above it; None if the whole map has
/// less.
///
/// 1. Estimate on 64 planes over the whole height; sum on the few planes around the load, or on all if it is
///    not between those; take the two that bracket the load.
/// 2. Keep the cells that this bracket cuts; narrow it on those as long as that leaves fewer (where the cells
///    are steep, nearly all that one plane cuts are also cut by its neighbours).
/// 3. Illinois' rule of false position on those, to a relative residual of 1e-11 or neighbouring numbers.
pub fn plane_of(map: &HeightMap, extent: &Extent, wanted: f64) -> Option<(f64, Above)> {
    if extent.high <= extent.low || !wanted.is_finite() {
        return None;
    }
    let (all, estimated) = estimate(map, extent);
    let k = plane_below(&estimated, wanted);
    let near = Planes { low: all.height(k.saturating_sub(1)), step: all.step, count: 4 };
    let (mut planes, mut sums) = (near, above_planes(map, near));
    if sums[0].slope_area < wanted || sums[3].slope_area >= wanted {
        (planes, sums) = (all, above_planes(map, all));
    }
    if sums[0].slope_area < wanted * (1.0 - 1e-12) {
        return None;
    }
    let mut bracket = first_bracket(map, planes, &sums, wanted);
    while bracket.cells.len() > FEW_CELLS {
        let before = bracket.cells.len();
        let planes = Planes::evenly_spaced(bracket.low, bracket.high, NARROWING_PLANES);
        let sums = bracket.above_planes(planes);
        let k = plane_below(&sums, wanted);
        bracket = bracket.narrowed(planes.height(k), planes.height(k + 1), sums[k + 1]);
        if 2 * bracket.cells.len() > before {
            break;
        }
    }
    Some(false_position(&bracket, wanted))
}

/// The last plane but one, or the last with at least `wanted` above it.
fn plane_below(sums: &[Above], wanted: f64) -> usize {
    (0..sums.len() - 1).rev().find(|k| sums[*k].slope_area >= wanted).unwrap_or(0)
}

fn first_bracket(map: &HeightMap, planes: Planes, sums: &[Above], wanted: f64) -> Bracket {
    let k = plane_below(sums, wanted);
    let (low, high) = (planes.height(k), planes.height(k + 1));
    let parts = map.chunks(|rows| {
        let mut cells = Vec::new();
        for row in rows {
            map.for_each_cell(row, |z| {
                if is_cut(&z, low, high) {
                    cells.push(z);
                }
            });
        }
        cells
    });
    let cells = parts.concat();
    Bracket { low, high, cells, base: Above::default(), inverse_pixel: map.inverse_pixel() }
        .with_top(sums[k + 1])
}

fn false_position(bracket: &Bracket, wanted: f64) -> (f64, Above) {
    let residual = |above: &Above| above.slope_area - wanted;
    let mut ends = [bracket.low, bracket.high];
    let sums = ends.map(|plane| bracket.above_plane(plane));
    let mut f = [residual(&sums[0]), residual(&sums[1])];
    let nearer = usize::from(f[0].abs() >= f[1].abs());
    let mut best = (ends[nearer], sums[nearer]);
    let mut last_side = None;
    for iteration in 0..200 {
        if residual(&best.1).abs() <= LOAD_RESIDUAL * wanted {
            break;
        }
        let [low, high] = ends;
        let cross = low + (high - low) * (f[0] / (f[0] - f[1]));
        // every fourth step halves, so that the bracket shrinks whatever the curve
        let d =
            if iteration % 4 < 3 && cross > low && cross < high { cross } else { low + 0.5 * (high - low) };
        if d <= low || d >= high {
            break;
        }
        let sum = bracket.above_plane(d);
        if residual(&sum).abs() < residual(&best.1).abs() {
            best = (d, sum);
        }
        let side = usize::from(residual(&sum) < 0.0);
        (ends[side], f[side]) = (d, residual(&sum));
        if last_side == Some(side) {
            f[1 - side] *= 0.5;
        }
        last_side = Some(side);
    }
    best
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// The part of the map above one plane.
    pub fn above_plane(map: &HeightMap, plane: f64) -> Above {
        above_planes(map, Planes { low: plane, step: 1.0, count: 1 })[0]
    }

    fn bumpy(n: usize) -> HeightMap {
        let z = |i: usize| {
            let (x, y) = ((i % n) as f64, (i / n) as f64);
            (0.37 * x).sin() * (0.21 * y).cos() + 0.3 * (1.7 * x + 0.9 * y).sin()
        };
        HeightMap::new(n, n, [0.5, 0.7], (0..n * n).map(z).collect()).unwrap()
    }

    #[test]
    fn one_pass_over_planes_agrees_with_single_planes() {
        let map = bumpy(90);
        let extent = map.extent().unwrap();
        let planes = Planes::evenly_spaced(extent.low, extent.high, 33);
        for (k, sum) in above_planes(&map, planes).iter().enumerate() {
            let one = above_plane(&map, planes.height(k));
            assert!((sum.area - one.area).abs() < 1e-8 && (sum.slope_area - one.slope_area).abs() < 1e-8);
        }
        let whole = above_plane(&map, extent.low - 1.0);
        assert_eq!(whole.area, extent.cells as f64);
    }

    #[test]
    fn the_found_plane_carries_what_was_wanted() {
        let map = bumpy(200);
        let extent = map.extent().unwrap();
        let whole = above_plane(&map, extent.low).slope_area;
        for share in [1e-9, 1e-4, 0.03, 0.5, 0.999, 1.0] {
            let (d, above) = plane_of(&map, &extent, share * whole).unwrap();
            assert!((above.slope_area / (share * whole) - 1.0).abs() < 1e-9, "{share}");
            assert!((above_plane(&map, d).slope_area / (share * whole) - 1.0).abs() < 1e-7, "{share}");
        }
        assert!(plane_of(&map, &extent, 1.001 * whole).is_none());
    }

    #[test]
    fn a_flat_map_carries_nothing() {
        let flat = HeightMap::new(4, 4, [1.0, 1.0], vec![2.0; 16]).unwrap();
        assert!(plane_of(&flat, &flat.extent().unwrap(), 1.0).is_none());
    }
}
