//! `compared.svg`: force and contact area of every closure over those of the finite elements, against the
//! slope.

use super::rows::ComparedRow;
use crate::draw::axis::Axis;
use crate::draw::chart::{FINE_PIXELS, Failure, INK, Paper, Sample, axes, framed, rgb, titled};
use crate::draw::palette;
use asperity_roughness::Closure;
use plotters::prelude::*;

/// Width and height of both axes in pixels.
const SIZE: (u32, u32) = (540, 680);
/// Radius of a dot in pixels.
const DOT: f64 = 4.0;

/// A closure with its rows at the full depth of each asperity.
pub(super) type AtDepth<'a> = (Closure, Vec<&'a ComparedRow>);

/// The picture of the closures that have rows; `None` where none has.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub(super) fn compared(mut closures: Vec<AtDepth<'_>>) -> Result<Option<String>, String> {
    closures.retain(|(_, rows)| !rows.is_empty());
    if closures.is_empty() {
        return Ok(None);
    }
    let legend = closures.iter().map(|(c, _)| {
        let turns = (0..32).map(|k| f64::from(k) * std::f64::consts::TAU / 32.0);
        let scale = DOT * f64::from(FINE_PIXELS);
        let outline = turns.map(|t| ((scale * t.cos()) as i32, (scale * t.sin()) as i32)).collect();
        (c.name().to_string(), Sample::Mark(rgb(palette::closure(*c)), outline))
    });
    let drawn = framed(SIZE, &legend.collect::<Vec<_>>(), |paper: &Paper| {
        let (above, below) = paper.split_vertically(SIZE.1 / 2 * FINE_PIXELS);
        panel(&above, &closures, "force over finite elements", |r| r.force_over_finite_elements)?;
        panel(&below, &closures, "contact area over finite elements", |r| r.area_over_finite_elements)
    })?;
    Ok(Some(titled("Every closure beside finite elements", drawn)))
}

fn panel(
    paper: &Paper,
    closures: &[AtDepth<'_>],
    name: &str,
    value: fn(&ComparedRow) -> Option<f64>,
) -> Result<(), Failure> {
    let points = |(_, rows): &AtDepth<'_>| {
        rows.iter().filter_map(|row| Some((row.slope_deg, value(row)?))).collect::<Vec<_>>()
    };
    let all: Vec<(f64, f64)> = closures.iter().flat_map(points).collect();
    let x = Axis::covering(all.iter().map(|p| p.0));
    let y = Axis::covering(all.iter().map(|p| p.1).chain([1.0]));
    let one = [(x.low, 1.0), (x.high, 1.0)];
    let mut area = axes(paper, [x, y], ["slope of the body down to the depth (degrees)", name])?;
    area.draw_series(LineSeries::new(one, INK.stroke_width(FINE_PIXELS)))?;
    for closure in closures {
        let colour = rgb(palette::closure(closure.0));
        let dot = |p| Circle::new(p, (DOT * f64::from(FINE_PIXELS)) as u32, colour.filled());
        area.draw_series(points(closure).into_iter().map(dot))?;
    }
    Ok(())
}
