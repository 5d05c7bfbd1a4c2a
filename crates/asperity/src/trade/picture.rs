//! `trade.svg`: error against cost, both logarithmic, what each knob buys around each level, and the front.

use super::errors::Row;
use super::settings::{Knob, LEVELS};
use crate::draw::chart::{COLOURS, FINE, GRID, INK, framed};
use asperity_solver::scene::Accuracy;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Width and height in pixels.
const SIZE: (u32, u32) = (900, 620);

/// The knobs in the order of the legend.
const KNOBS: [Knob; 7] =
    [Knob::Mesh, Knob::Step, Knob::Element, Knob::Penetration, Knob::Contact, Knob::Domain, Knob::Tolerance];

const MIXED: RGBColor = RGBColor(170, 170, 170);

/// A row's place: core seconds and error of the force in percent.
fn place(row: &Row) -> Option<(f64, f64)> {
    let (run, errors) = row.outcome.as_ref().ok()?;
    let (x, y) = (run.core_s, 100.0 * errors.force);
    (x > 0.0 && y > 0.0 && x.is_finite() && y.is_finite()).then_some((x, y))
}

/// Whole powers of ten around the values, at least one decade.
fn decades(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) =
        values.map(f64::log10).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    if low > high { (0.0, 1.0) } else { (low.floor(), high.ceil().max(low.floor() + 1.0)) }
}

/// Draws the rows as SVG.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub fn draw(rows: &[Row]) -> Result<String, String> {
    framed(SIZE, |root| fill(rows, root)).map_err(|e| format!("the picture could not be drawn: {e}"))
}

fn fill(rows: &[Row], root: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), Box<dyn std::error::Error>> {
    let places: Vec<(f64, f64)> = rows.iter().filter_map(place).collect();
    // the axes hold logarithms: the library's own leave half a decade empty
    let x = decades(places.iter().map(|p| p.0));
    let y = decades(places.iter().map(|p| p.1));
    let font = |size: u32| ("sans-serif", size * FINE).into_font().color(&INK);
    let mut area = ChartBuilder::on(root)
        .margin(14 * FINE)
        .x_label_area_size(54 * FINE)
        .y_label_area_size(70 * FINE)
        .build_cartesian_2d(x.0..x.1, y.0..y.1)?;
    let power = |v: &f64| {
        let decimals = (-v.round()).max(0.0) as usize;
        format!("{:.decimals$}", 10f64.powf(v.round()))
    };
    area.configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(INK.stroke_width(FINE))
        .x_labels((x.1 - x.0) as usize + 1)
        .y_labels((y.1 - y.0) as usize + 1)
        .x_label_formatter(&power)
        .y_label_formatter(&power)
        .label_style(font(16))
        .axis_desc_style(font(18))
        .x_desc("Cost (core seconds)")
        .y_desc("Largest error of the force (%)")
        .draw()?;
    let log = |p: (f64, f64)| (p.0.log10(), p.1.log10());
    let at = |row: &Row| place(row).map(log);
    let of = |knob: Knob| rows.iter().filter(move |r| r.setting.knob == knob);
    let base = |level: Accuracy| of(Knob::Level).find(|r| r.setting.around == level).and_then(at);

    let mut on_front: Vec<(f64, f64)> = rows.iter().filter(|r| r.on_front).filter_map(at).collect();
    on_front.sort_by(|a, b| a.0.total_cmp(&b.0));
    // between two points of the front the cheaper one is what can be had
    let stairs: Vec<(f64, f64)> = on_front
        .iter()
        .enumerate()
        .flat_map(|(i, p)| on_front[i.saturating_sub(1)..=i].iter().map(|before| (p.0, before.1)))
        .collect();
    let line = INK.stroke_width(2 * FINE);
    area.draw_series(LineSeries::new(stairs, line))?
        .label("front")
        .legend(move |(x, y)| PathElement::new([(x, y), (x + 18 * FINE as i32, y)], line));

    area.draw_series(of(Knob::Mixed).filter_map(at).map(|p| Circle::new(p, 3 * FINE, MIXED.filled())))?
        .label("all at once")
        .legend(|(x, y)| Circle::new((x + 9 * FINE as i32, y), 3 * FINE, MIXED.filled()));
    for (i, knob) in KNOBS.into_iter().enumerate() {
        let colour = COLOURS[i % COLOURS.len()];
        let arms = of(knob).filter_map(|r| Some(vec![base(r.setting.around)?, at(r)?]));
        area.draw_series(arms.map(|arm| PathElement::new(arm, colour.mix(0.6).stroke_width(FINE))))?;
        let marks = of(knob).filter_map(at);
        area.draw_series(marks.map(|p| EmptyElement::at(p) + Polygon::new(outline(i), colour.filled())))?
            .label(label(knob))
            .legend(move |place| sample(i, place));
    }
    for row in of(Knob::Level) {
        let Some(p) = at(row) else { continue };
        let level = row.setting.around;
        let name = if LEVELS.contains(&level) { level.to_string() } else { String::new() };
        let ring = INK.stroke_width(2 * FINE);
        // names of marks near the right side stand before them
        let (side, shift) =
            if p.0 > x.1 - 0.15 * (x.1 - x.0) { (HPos::Right, -10) } else { (HPos::Left, 10) };
        let style = font(16).pos(Pos::new(side, VPos::Top));
        area.draw_series([EmptyElement::at(p)
            + Circle::new((0, 0), 7 * FINE as i32, ring)
            + Text::new(name, (shift * FINE as i32, -18 * FINE as i32), style)])?;
    }
    area.configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .margin(10 * FINE)
        .legend_area_size(24 * FINE)
        .label_font(font(15))
        .background_style(WHITE.mix(0.85))
        .border_style(GRID.stroke_width(FINE))
        .draw()?;
    Ok(())
}

fn label(knob: Knob) -> &'static str {
    match knob {
        Knob::Mesh => "mesh",
        Knob::Step => "load step",
        Knob::Element => "other element",
        Knob::Penetration => "penetration",
        Knob::Contact => "augmented Lagrange",
        Knob::Domain => "size of the body",
        Knob::Tolerance => "Newton's tolerance",
        other => other.name(),
    }
}

/// Pixels around the middle of the mark of knob `i`. Knobs differ in shape and in colour, so that either alone tells
/// them apart.
fn outline(i: usize) -> Vec<(i32, i32)> {
    // corners, first angle in degrees, and the radius of every other corner over that of the rest
    let (corners, start, inner) = [
        (32, 0.0, 1.0),
        (4, 45.0, 1.0),
        (3, 90.0, 1.0),
        (4, 0.0, 1.0),
        (3, -90.0, 1.0),
        (10, 90.0, 0.45),
        (6, 0.0, 1.0),
    ][i % KNOBS.len()];
    let size = 6.0 * f64::from(FINE);
    (0..corners)
        .map(|k| {
            let angle = f64::to_radians(start + 360.0 * f64::from(k) / f64::from(corners));
            let radius = if k % 2 == 1 { size * inner } else { size };
            ((radius * angle.cos()).round() as i32, (-radius * angle.sin()).round() as i32)
        })
        .collect()
}

/// The mark of knob `i` in a legend.
fn sample(i: usize, (x, y): (i32, i32)) -> Polygon<(i32, i32)> {
    let middle = x + 9 * FINE as i32;
    let moved: Vec<_> = outline(i).into_iter().map(|(dx, dy)| (middle + dx, y + dy)).collect();
    Polygon::new(moved, COLOURS[i % COLOURS.len()].filled())
}
