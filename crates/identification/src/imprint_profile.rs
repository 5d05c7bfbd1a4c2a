//! Profiles of imprints as text tables: places and heights, or points x, y, z along one line.
//!
//! A file that would be read wrongly without a word is refused: numbers that stand for no reading, a second
//! profile.

use crate::imprint_level::{LEVEL_RADII, level};
use asperity_formats::text::{Series, SeriesTable};
use asperity_material::units::rounded;

/// A profile across an imprint.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Place and height, m.
    pub points: Vec<[f64; 2]>,
    /// Interpretation of the file.
    pub understood: String,
}

/// The profile in `table`, heights above the far field.
///
/// # Errors
/// A second profile, or numbers that stand for no reading.
pub fn profile(table: SeriesTable<2>, radius: f64, is_down: bool) -> Result<Profile, String> {
    let series = only_one(table.series)?;
    made_ready(series, table.scales[1], table.understood, (radius, is_down))
}

/// The profile along the line on which the points in `table` lie; `None` where they lie on none.
pub fn line(table: SeriesTable<3>, radius: f64, is_down: bool) -> Option<Result<Profile, String>> {
    let mut understood = table.understood;
    let Series { label, rows, lines } = match only_one(table.series) {
        Ok(series) => series,
        Err(several) => return Some(Err(several)),
    };
    let (rows, angle) = along_line(&rows)?;
    if angle != 0.0 {
        understood += &format!("; places along the line of the points, {angle:.2}° from x");
    }
    let series = Series { label, rows, lines };
    Some(made_ready(series, table.scales[2], understood, (radius, is_down)))
}

/// The one profile of a file.
///
/// # Errors
/// Several.
fn only_one<const N: usize>(mut series: Vec<Series<N>>) -> Result<Series<N>, String> {
    if series.len() > 1 {
        let name = |one: &Series<N>| format!("{} (from line {})", one.label, one.lines[0]);
        let names: Vec<String> = series.iter().take(3).map(name).collect();
        return Err(format!(
            "holds {} profiles, {}: keep one profile in a file",
            series.len(),
            names.join(", ")
        ));
    }
    series.pop().ok_or_else(|| "holds no numbers".into())
}

/// Readings of one profile, whose heights are `unit` of the file, turned up and about the middle of the hole.
fn made_ready(
    Series { rows: mut points, lines, .. }: Series<2>,
    unit: f64,
    mut understood: String,
    (radius, is_down): (f64, bool),
) -> Result<Profile, String> {
    let column = |k: usize, unit: f64| points.iter().map(|p| p[k] / unit).collect::<Vec<f64>>();
    refuse_lone(&column(1, unit), &lines)?;
    if let Some(start) = second_profile(&column(0, 1.0)) {
        return Err(format!(
            "line {}: a second profile begins, for the places go over those before it again: keep one profile in a file",
            lines[start]
        ));
    }
    if is_down {
        for p in &mut points {
            p[1] = -p[1];
        }
    }
    if let Some((about, middle)) = centred(&points, radius) {
        points = about;
        let middle = 1e6 * middle;
        understood += &format!(
            "; a line across the imprint, levelled beyond {LEVEL_RADII} contact radii, its middle at {middle:.3} um"
        );
    }
    Ok(Profile { points, understood })
}

/// Distance of a height from all others, in ranges of these, from which it is none; that of a number by
/// which programs mark a missing one.
const LONE_DISTANCE: f64 = 3.0;
const DISTANCE_OF_A_MARK: f64 = 0.2;

/// True of numbers such as -9999, -32768 and 65535, which programs write where nothing was measured.
fn is_mark(number: f64) -> bool {
    let size = number.abs().round();
    let is_power =
        [15, 16, 31].iter().map(|k| 2.0_f64.powi(*k)).any(|power| [power - 1.0, power].contains(&size));
    let is_nines = (3..=6).any(|digits| size == 10.0_f64.powi(digits) - 1.0);
    (number.abs() - size).abs() < 1e-6 && (is_power || is_nines)
}

/// Refuses `heights`, in the unit of the file, whose lowest or highest lies far from all others.
fn refuse_lone(heights: &[f64], lines: &[usize]) -> Result<(), String> {
    // the file has fewer digits than the way to metres and back leaves
    let heights: Vec<f64> = heights.iter().map(|z| rounded(*z, 10)).collect();
    let range = |without: Option<f64>| {
        let others = heights.iter().filter(|z| Some(**z) != without);
        others.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(*z), high.max(*z)])
    };
    for end in range(None) {
        let [low, high] = range(Some(end));
        let least = if is_mark(end) { DISTANCE_OF_A_MARK } else { LONE_DISTANCE };
        let first = heights.iter().position(|z| *z == end).filter(|_| high > low);
        let Some(first) = first.filter(|_| (low - end).max(end - high) > least * (high - low)) else {
            continue;
        };
        return Err(format!(
            "line {}: the height {end} (at {} points) lies far from all others ({low} to {high}), as programs write it where \
             nothing was measured: write nan in its place, or delete such rows",
            lines[first],
            heights.iter().filter(|z| **z == end).count()
        ));
    }
    Ok(())
}

/// Fewest readings of a profile, and least share of all places over which one goes.
const LEAST_READINGS: usize = 5;
const LEAST_SPAN: f64 = 0.25;
/// Share of the shorter of two profiles over which both go.
const OVERLAP: f64 = 0.5;

/// The reading at which a second profile begins: `places` that rise or fall go there over the same again.
fn second_profile(places: &[f64]) -> Option<usize> {
    // of the readings from one turn to the next: the first one, lowest and highest place
    let mut runs: Vec<(usize, usize, [f64; 2])> = Vec::new();
    let mut direction = 0.0;
    for (i, &place) in places.iter().enumerate() {
        let step = if i > 0 { place - places[i - 1] } else { 0.0 };
        match runs.last_mut() {
            Some((_, count, [low, high])) if step * direction >= 0.0 => {
                (*count, *low, *high) = (*count + 1, low.min(place), high.max(place));
                direction = if step == 0.0 { direction } else { step };
            }
            _ => {
                runs.push((i, 1, [place; 2]));
                direction = 0.0;
            }
        }
    }
    let ends = |ends: [f64; 2], [low, high]: [f64; 2]| [ends[0].min(low), ends[1].max(high)];
    let all = runs.iter().map(|run| run.2).reduce(ends)?;
    let span = |[low, high]: [f64; 2]| high - low;
    runs.retain(|(_, count, run)| *count >= LEAST_READINGS && span(*run) >= LEAST_SPAN * span(all));
    let meets = |(a, b): (&[f64; 2], &[f64; 2])| {
        span([a[0].max(b[0]), a[1].min(b[1])]) > OVERLAP * span(*a).min(span(*b))
    };
    let second = (1..runs.len()).find(|k| runs[..*k].iter().any(|before| meets((&before.2, &runs[*k].2))))?;
    Some(runs[second].0)
}

/// Distance from a line over its length up to which points lie on it.
const BESIDE_A_LINE: f64 = 0.01;

/// Place along their line and height of `points` x, y, z, and the angle of that line with x, degrees; places
/// count from where the origin stands beside it. `None` where they lie on no line.
fn along_line(points: &[[f64; 3]]) -> Option<(Vec<[f64; 2]>, f64)> {
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
    let sum = |j: usize, k: usize| points.iter().map(|p| (p[j] - mean[j]) * (p[k] - mean[k])).sum::<f64>();
    let has_one = |k: usize| points.iter().all(|p| p[k] == points[0][k]);
    let angle = match [has_one(0), has_one(1)] {
        [_, true] => 0.0,
        [true, false] => 90.0,
        _ => (0.5 * (2.0 * sum(0, 1)).atan2(sum(0, 0) - sum(1, 1))).to_degrees(),
    };
    let (sine, cosine) = if angle == 90.0 { (1.0, 0.0) } else { angle.to_radians().sin_cos() };
    let rows: Vec<[f64; 2]> = points.iter().map(|p| [cosine * p[0] + sine * p[1], p[2]]).collect();
    let places = || rows.iter().map(|p| p[0]);
    let length = places().fold(f64::NEG_INFINITY, f64::max) - places().fold(f64::INFINITY, f64::min);
    let beside = |p: &[f64; 3]| (cosine * (p[1] - mean[1]) - sine * (p[0] - mean[0])).abs();
    points.iter().all(|p| beside(p) <= BESIDE_A_LINE * length).then_some((rows, angle))
}

/// Contact radii to which a line reaches on both sides of an imprint that it crosses, and from which its
/// middle is not the 0 of its places: half of an imprint, weighted by its depth, has its middle within.
const LINE_RADII: f64 = 1.2;
const CENTRED_RADII: f64 = 0.5;

/// The points of a line that crosses the whole imprint elsewhere than at 0, levelled and about its middle,
/// and the place of that; `None` of a profile that counts from the middle.
fn centred(points: &[[f64; 2]], radius: f64) -> Option<(Vec<[f64; 2]>, f64)> {
    let mut points: Vec<[f64; 3]> = points.iter().map(|p| [p[0], 0.0, p[1]]).collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // sums are integrals over the line: readings that stand close together count for no more of it
    let place = |i: usize| points[i.min(points.len() - 1)][0];
    let lengths: Vec<f64> = (0..points.len()).map(|i| place(i + 1) - place(i.saturating_sub(1))).collect();
    let [middle, _] = level(&mut points, radius, |i| lengths[i], |p| [1.0, p[0] / radius]).ok()?;
    let reaches = |side: f64| points.iter().any(|p| side * (p[0] - middle) > LINE_RADII * radius);
    let crosses = middle.abs() > CENTRED_RADII * radius && reaches(-1.0) && reaches(1.0);
    crosses.then(|| (points.iter().map(|p| [p[0] - middle, p[2]]).collect(), middle))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::imprint_file::{ImprintRead, Reading, read};
    use std::path::Path;

    /// A cone of depth 1 um and radius 5 um about 0 from -12 to 12 um, row by row: `row` writes place and
    /// height, um.
    pub(crate) fn cone(head: &str, row: impl Fn(i32, f64, f64) -> String) -> String {
        let one = |k: i32| {
            let x = 0.2 * f64::from(k - 60);
            row(k, x, (0.2 * x.abs() - 1.0).min(0.0))
        };
        (0..=120).fold(format!("{head}\n"), |text, k| text + &one(k) + "\n")
    }

    fn read_text(text: &str) -> Result<ImprintRead, String> {
        read(Path::new("no such file"), Some((text, "UTF-8")), 5e-6, Reading::default())
    }

    pub(crate) fn holds_the_cone(text: &str) {
        let read = read_text(text).unwrap_or_else(|problem| panic!("{problem}\n{text}"));
        assert_eq!(read.points.len(), 121, "{}", read.understood);
        for [x, z] in read.points {
            assert!((z - (0.2 * x.abs() - 1e-6).min(0.0)).abs() < 1e-9, "{x:e} {z:e} {}", read.understood);
        }
    }

    pub(crate) fn refused(text: &str, words: &[&str]) {
        let problem = read_text(text).map(|read| read.understood).unwrap_err();
        let lacking = words.iter().find(|word| !problem.contains(**word));
        assert_eq!(lacking, None, "{problem}");
    }

    #[test]
    fn a_number_that_stands_for_no_height_is_refused_with_its_line() {
        for mark in ["-9999", "-32768", "99999", "-21.5"] {
            let marked = |k: i32, x: f64, z: f64| match k {
                30 | 31 => format!("{x:.1},{mark}"),
                _ => format!("{x:.1},{z:.3}"),
            };
            refused(&cone("x_um,z_um", marked), &["line 32", mark, "2 points", "write nan"]);
        }
        // a mark among heights of its size, and a height that happens to be one
        let in_nm = |depth: f64, marked: i32| {
            cone("x_um,z_nm", move |k, x, z| match k {
                _ if k == marked => format!("{x:.1},-9999"),
                _ => format!("{x:.1},{:.0}", depth * z),
            })
        };
        refused(&in_nm(6000.0, 100), &["line 102", "-9999"]);
        assert!(read_text(&in_nm(9999.0, 60)).is_ok());
    }

    #[test]
    fn rows_of_nan_are_left_out() {
        let text = cone("x_um,z_um", |k, x, z| match k {
            55..65 => format!("{x:.1},nan"),
            _ => format!("{x:.1},{z:.3}"),
        });
        assert_eq!(read_text(&text).unwrap().points.len(), 111);
    }

    #[test]
    fn a_second_profile_is_refused_with_its_line() {
        let beside = |_: i32, x: f64, z: f64| format!("{x:.1},{z:.3},{x:.1},{:.3}", 0.9 * z);
        refused(&cone("x_um,z_um,x_um,z_um", beside), &["2 profiles", "keep one"]);
        let row = |_: i32, x: f64, z: f64| format!("{x:.1},{z:.3}");
        let below = cone("x_um,z_um", row) + &cone("x_um,z_um", row);
        refused(&below, &["2 profiles", "line 124", "keep one"]);
        let header_alone = below.replacen("x_um,z_um\n", "", 2);
        refused(&format!("x_um,z_um\n{header_alone}"), &["line 123", "second profile", "keep one"]);
    }

    #[test]
    fn one_profile_in_any_order_is_read() {
        holds_the_cone(&cone("x_um,z_um", |_, x, z| format!("{:.1},{z:.3}", -x)));
        // one side after the other, and nodes by their numbers
        let order = |place: fn(i32) -> i32| {
            cone("x_um,z_um", move |k, _, _| {
                let x = 0.2 * f64::from(place(k));
                format!("{x:.1},{:.3}", (0.2 * x.abs() - 1.0).min(0.0))
            })
        };
        holds_the_cone(&order(|k| if k < 61 { k } else { k - 121 }));
        holds_the_cone(&order(|k| k * 37 % 121 - 60));
    }

    #[test]
    fn places_of_a_line_of_points_go_along_it() {
        holds_the_cone(&cone("x_um,z_um,y_um", |_, x, z| format!("{},{z:.3},{}", 0.8 * x, -0.6 * x)));
        holds_the_cone(&cone("x_um,y_um,z_um", |_, x, z| format!("{x:.1},7.5,{z:.3}")));
        holds_the_cone(&cone("x_um,y_um,z_um", |_, x, z| format!("7.5,{x:.1},{z:.3}")));
        let bent = cone("x_um,y_um,z_um", |_, x, z| format!("{x:.1},{},{z:.3}", x * x));
        refused(&bent, &["nor do the points lie on one line"]);
        let without_unit = cone("x_um,y,z_um", |_, x, z| format!("{},{},{z:.3}", 0.8 * x, 0.6 * x));
        refused(&without_unit, &["place y", "has no unit"]);
    }

    /// A line along x over the same cone, read from its left end and tilted: the cone about its middle. A
    /// profile that counts from the middle stays as it is, one side of it or both.
    #[test]
    fn a_line_from_its_end_is_centred_and_levelled() {
        let line = |from: f64, to: f64, middle: f64, tilt: f64| {
            let at = move |k: i32| from + (to - from) * f64::from(k) / 400.0;
            (0..=400)
                .map(|k| [at(k), (0.2 * (at(k) - middle).abs() - 1e-6).min(0.0) + tilt * at(k)])
                .collect::<Vec<_>>()
        };
        let (points, middle) = centred(&line(0.0, 40e-6, 22.3e-6, 0.02), 5e-6).unwrap();
        assert!((middle - 22.3e-6).abs() < 0.05e-6, "{middle:e}");
        for [x, z] in points {
            let cone = (0.2 * x.abs() - 1e-6).min(0.0);
            assert!((z - cone).abs() < 0.02e-6, "{x:e} {z:e} {cone:e}");
        }
        // as finite elements write it: close points under the tool, the last ones a thousand radii away
        let growing = (0..200).map(|k| 0.05e-6 * f64::from(k) + 1e-8 * 1.06_f64.powi(k));
        let surface: Vec<[f64; 2]> = growing.map(|r| [r, (0.2 * r - 1e-6).min(0.0)]).collect();
        assert_eq!(centred(&surface, 5e-6), None);
        assert_eq!(centred(&line(0.0, 20e-6, 0.0, 0.0), 5e-6), None);
        assert_eq!(centred(&line(-20e-6, 20e-6, 0.1e-6, 0.0), 5e-6), None);
    }
}
