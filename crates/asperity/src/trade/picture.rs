//! `trade.svg`: error against cost, both logarithmic, each knob around each level, and the Pareto front.

use super::row::TradeRow;
use super::settings::{Knob, LEVELS};
use crate::draw::axis::Axis;
use crate::draw::chart::{FINE_PIXELS, Failure, INK, Paper, Sample, axes, font, framed, rgb};
use crate::draw::palette::LINES;
use asperity_simulation::scene::Accuracy;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Width and height of the axes with their names in pixels.
const SIZE: (u32, u32) = (540, 480);

/// A knob in the legend: its name, and its mark as a polygon or star.
struct Mark {
    knob: Knob,
    name: &'static str,
    corners: i32,
    /// Angle of the first corner, degrees.
    start: f64,
    /// Radius of every other corner over that of the rest.
    inner: f64,
}

const fn mark(knob: Knob, name: &'static str, corners: i32, start: f64, inner: f64) -> Mark {
    Mark { knob, name, corners, start, inner }
}

/// The knobs in the order of the legend. They differ in shape and in colour: either alone is enough.
const MARKS: [Mark; 6] = [
    mark(Knob::Mesh, "mesh", 32, 0.0, 1.0),
    mark(Knob::Step, "load step", 4, 45.0, 1.0),
    mark(Knob::Element, "other element", 3, 90.0, 1.0),
    mark(Knob::Penetration, "penetration", 4, 0.0, 1.0),
    mark(Knob::Domain, "size of the body", 10, 90.0, 0.45),
    mark(Knob::Tolerance, "Newton's tolerance", 6, 0.0, 1.0),
];

const MIXED_COLOUR: RGBColor = RGBColor(170, 170, 170);

/// Logarithms of a row's core seconds and of its error of the force in percent.
fn place(row: &TradeRow) -> Option<(f64, f64)> {
    let (x, y) = (row.core_s?.log10(), (100.0 * row.force_error?).log10());
    (x.is_finite() && y.is_finite()).then_some((x, y))
}

/// Draws the rows as SVG.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub fn draw(rows: &[TradeRow]) -> Result<String, String> {
    let dot = outline(&MARKS[0]).into_iter().map(|(x, y)| (x / 2, y / 2)).collect();
    let mut legend = vec![
        ("Pareto front".to_string(), Sample::Line(INK, [1, 0])),
        ("all at once".to_string(), Sample::Mark(MIXED_COLOUR, dot)),
    ];
    let marks = MARKS.iter().enumerate();
    legend.extend(marks.map(|(i, mark)| (mark.name.to_string(), Sample::Mark(colour(i), outline(mark)))));
    framed(SIZE, &legend, |paper| fill(rows, paper))
}

fn fill(rows: &[TradeRow], paper: &Paper) -> Result<(), Failure> {
    let axis = |of: fn((f64, f64)) -> f64| Axis::logarithmic(rows.iter().filter_map(place).map(of));
    let (x, y) = (axis(|p| p.0), axis(|p| p.1));
    let left = x.low + 0.12 * (x.high - x.low);
    let mut area = axes(paper, [x, y], ["Cost (core seconds)", "Largest error of the force (%)"])?;
    let of = |knob: Knob| rows.iter().filter(move |r| r.knob == knob);
    let base = |level: Accuracy| of(Knob::Level).find(|r| r.around == Some(level)).and_then(place);

    let mut on_front: Vec<(f64, f64)> = rows.iter().filter(|r| r.on_front).filter_map(place).collect();
    on_front.sort_by(|a, b| a.0.total_cmp(&b.0));
    // between two points of the front the cheaper one is what can be had
    let stairs: Vec<(f64, f64)> = on_front
        .iter()
        .enumerate()
        .flat_map(|(i, p)| on_front[i.saturating_sub(1)..=i].iter().map(|before| (p.0, before.1)))
        .collect();
    area.draw_series(LineSeries::new(stairs, INK.stroke_width(2 * FINE_PIXELS)))?;
    area.draw_series(
        of(Knob::Mixed).filter_map(place).map(|p| Circle::new(p, 3 * FINE_PIXELS, MIXED_COLOUR.filled())),
    )?;
    for (i, mark) in MARKS.iter().enumerate() {
        let arms = of(mark.knob).filter_map(|r| Some(vec![base(r.around?)?, place(r)?]));
        area.draw_series(
            arms.map(|arm| PathElement::new(arm, colour(i).mix(0.6).stroke_width(FINE_PIXELS))),
        )?;
        let places = of(mark.knob).filter_map(place);
        area.draw_series(
            places.map(|p| EmptyElement::at(p) + Polygon::new(outline(mark), colour(i).filled())),
        )?;
    }
    for row in of(Knob::Level) {
        let (Some(p), Some(level)) = (place(row), row.around) else { continue };
        let name = if LEVELS.contains(&level) { level.to_string() } else { String::new() };
        // names stand below the front, where no row can be, and before their marks where there is room
        let (side, shift) = if p.0 > left { (HPos::Right, -8) } else { (HPos::Left, 8) };
        let style = font(16).pos(Pos::new(side, VPos::Top));
        area.draw_series([EmptyElement::at(p)
            + Circle::new((0, 0), 7 * FINE_PIXELS as i32, INK.stroke_width(2 * FINE_PIXELS))
            + Text::new(name, (shift * FINE_PIXELS as i32, 4 * FINE_PIXELS as i32), style)])?;
    }
    Ok(())
}

fn colour(i: usize) -> RGBColor {
    rgb(LINES[i % LINES.len()])
}

/// Pixels around the middle of a mark.
fn outline(&Mark { corners, start, inner, .. }: &Mark) -> Vec<(i32, i32)> {
    let size = 6.0 * f64::from(FINE_PIXELS);
    (0..corners)
        .map(|k| {
            let angle = f64::to_radians(start + 360.0 * f64::from(k) / f64::from(corners));
            let radius = if k % 2 == 1 { size * inner } else { size };
            ((radius * angle.cos()).round() as i32, (-radius * angle.sin()).round() as i32)
        })
        .collect()
}
