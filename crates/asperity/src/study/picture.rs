//! `study.svg`: one result over the varied keys.
//!
//! One key: a line. Two: a line for each value of the second one; points in the colour of the second one
//! where they are drawn or where it has more values than lines can be told apart. More keys: points over the
//! first one.

use super::row::Run;
use super::vary::Vary;
use crate::draw::axis::Axis;
use crate::draw::chart::{
    self, Chart, FINE_PIXELS, Failure, INK, Paper, SIZE, Sample, Series, axes, framed, rgb,
};
use crate::draw::palette::{VIRIDIS, interpolated};
use plotters::prelude::*;

/// Most lines that a person can tell apart.
const LINES: usize = 7;

/// The number and the unit of a value.
fn number(value: &str) -> Option<(f64, String)> {
    let value = value.trim();
    let ends = value.char_indices().map(|(i, c)| i + c.len_utf8()).rev();
    let mut found =
        ends.filter_map(|end| Some((value[..end].parse().ok()?, value[end..].trim().to_string())));
    found.next().filter(|(number, _): &(f64, String)| number.is_finite())
}

/// A value with four digits at most.
fn short(value: &str) -> String {
    let Some((number, unit)) = number(value) else { return value.into() };
    let rounded = format!("{number:.3e}").parse().unwrap_or(number);
    format!("{rounded} {}", unit.replace("um", "µm")).trim_end().into()
}

/// A key as an axis: the place of each run along it, and its name with its unit.
struct Along {
    places: Vec<f64>,
    name: String,
    logarithmic: bool,
}

impl Along {
    fn new(vary: &Vary, key: usize, runs: &[&Run]) -> Along {
        let values: Vec<&str> = runs.iter().map(|run| run.values[key].as_str()).collect();
        let numbers: Option<Vec<(f64, String)>> = values.iter().map(|value| number(value)).collect();
        if let Some(numbers) = numbers.filter(|n| n.iter().all(|(_, unit)| *unit == n[0].1)) {
            let unit = numbers.first().map(|(_, unit)| unit.clone()).filter(|unit| !unit.is_empty());
            let name =
                unit.map_or(vary.key.clone(), |unit| format!("{} ({})", vary.key, unit.replace("um", "µm")));
            let places: Vec<f64> = numbers.iter().map(|(number, _)| *number).collect();
            let logarithmic = vary.logarithmic() && places.iter().all(|x| *x > 0.0);
            return Along { places, name, logarithmic };
        }
        // words stand in the order in which they come
        let mut words: Vec<&str> = Vec::new();
        let mut place = |value| {
            words.iter().position(|word| *word == value).unwrap_or_else(|| {
                words.push(value);
                words.len() - 1
            })
        };
        let places = values.iter().map(|value| 1.0 + place(value) as f64).collect();
        let list: Vec<String> =
            words.iter().enumerate().map(|(i, word)| format!("{} {word}", i + 1)).collect();
        Along { places, name: format!("{} ({})", vary.key, list.join(", ")), logarithmic: false }
    }
}

/// Draws `column` of the runs that have it.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub(super) fn draw(vary: &[Vary], runs: &[Run], column: &str) -> Result<String, String> {
    let ended: Vec<&Run> = runs.iter().filter(|run| run.ok() && run.number(column).is_some()).collect();
    let heights: Vec<f64> = ended.iter().filter_map(|run| run.number(column)).collect();
    let along: Vec<Along> = vary.iter().enumerate().map(|(key, one)| Along::new(one, key, &ended)).collect();
    let second = along.get(1).map(|_| values_of(&ended, 1)).unwrap_or_default();
    let lines = vary.len() == 1 || (vary.len() == 2 && second.len() <= LINES && second.len() < ended.len());
    if !lines || along[0].logarithmic {
        return dots(&along, &heights, column, vary.len() == 1);
    }
    let line = |label: &str, of: &dyn Fn(&Run) -> bool| {
        let chosen = ended.iter().enumerate().filter(|(_, run)| of(run));
        let mut points: Vec<[f64; 2]> = chosen.map(|(i, _)| [along[0].places[i], heights[i]]).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Series::line(label, points).marked()
    };
    let series: Vec<Series> = match &second[..] {
        [] => vec![Series { label: column.into(), ..line(column, &|_| true) }],
        values => values
            .iter()
            .map(|v| line(&format!("{} = {}", vary[1].key, short(v)), &|run| run.values[1] == *v))
            .collect(),
    };
    chart::svg(&Chart::new(along[0].name.clone(), column, series))
}

fn values_of(runs: &[&Run], key: usize) -> Vec<String> {
    let mut values: Vec<String> = Vec::new();
    for run in runs {
        if !values.contains(&run.values[key]) {
            values.push(run.values[key].clone());
        }
    }
    values
}

/// Points over the first key in the colour of the second one, where there are exactly two.
fn dots(along: &[Along], heights: &[f64], column: &str, joined: bool) -> Result<String, String> {
    let shade = along.get(1).filter(|_| along.len() == 2);
    let share = |second: &Along, i: usize| {
        let (low, high) =
            second.places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        if high > low { (second.places[i] - low) / (high - low) } else { 0.5 }
    };
    let colour = |i: usize| shade.map_or(INK, |second| rgb(interpolated(&VIRIDIS, 0.9 * share(second, i))));
    let dot = |colour| {
        Sample::Mark(
            colour,
            (0..32)
                .map(|k| k as f64 * 0.19635)
                .map(|a| {
                    ((4.0 * a.cos() * FINE_PIXELS as f64) as i32, (4.0 * a.sin() * FINE_PIXELS as f64) as i32)
                })
                .collect(),
        )
    };
    let legend: Vec<(String, Sample)> = shade.map_or(Vec::new(), |second| {
        let mut order: Vec<usize> = (0..heights.len()).collect();
        order.sort_by(|a, b| second.places[*a].total_cmp(&second.places[*b]));
        let shown = [0, order.len() / 4, order.len() / 2, 3 * order.len() / 4, order.len().saturating_sub(1)];
        let mut entries: Vec<(String, Sample)> = vec![(second.name.clone(), Sample::Heading)];
        let picked = shown.iter().filter_map(|k| order.get(*k));
        entries.extend(picked.map(|&i| (format!("{:.4}", second.places[i]), dot(colour(i)))));
        entries
    });
    let first = &along[0];
    let place = |i: usize| if first.logarithmic { first.places[i].log10() } else { first.places[i] };
    framed(SIZE, &legend, |paper: &Paper| -> Result<(), Failure> {
        let xs = || (0..heights.len()).map(place);
        let x = if first.logarithmic { Axis::logarithmic(xs()) } else { Axis::covering(xs()) };
        let mut area = axes(paper, [x, Axis::covering(heights.iter().copied())], [&first.name, column])?;
        if joined {
            let mut points: Vec<(f64, f64)> = xs().zip(heights.iter().copied()).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            area.draw_series(LineSeries::new(points, INK.stroke_width(2 * FINE_PIXELS)))?;
        }
        let circle = |i: usize| Circle::new((place(i), heights[i]), 4 * FINE_PIXELS, colour(i).filled());
        area.draw_series((0..heights.len()).map(circle))?;
        Ok(())
    })
}
