//! Line charts as SVG: labelled with units, legible in print and to colour-blind people.
//!
//! Series differ in colour (Okabe and Ito's palette) and in dash, so that either alone tells them apart.

use crate::draw::scale;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, Ranged, ValueFormatter};
use plotters::element::{DashedPathElement, IntoDynElement};
use plotters::prelude::*;
use plotters::series::DashedLineSeries;

/// One line of a chart.
#[derive(Clone, Debug)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// Points (x, y) in the unit of the axes; those that are not finite are left out.
    pub points: Vec<[f64; 2]>,
    /// Whether each point is marked with a dot.
    pub marks: bool,
}

/// A chart of lines over common axes that start at 0 or below.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Name of the horizontal axis with its unit.
    pub x_label: String,
    /// Name of the vertical axis with its unit.
    pub y_label: String,
    /// The lines, drawn in this order.
    pub series: Vec<Series>,
}

/// Colours in order of use: blue, vermilion, green, purple, orange, sky, black.
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];
/// Dash and gap of each series in pixels; no gap: solid.
const DASHES: [[u32; 2]; 4] = [[1, 0], [9, 5], [3, 4], [15, 4]];
/// Width and height in pixels.
const SIZE: (u32, u32) = (760, 500);
/// The library draws at whole pixels: it gets that many to a pixel of the picture.
pub const FINE: u32 = 8;
/// Lines and letters.
pub const INK: RGBColor = RGBColor(40, 40, 40);
/// Lines of the grid.
pub const GRID: RGBColor = RGBColor(225, 225, 225);

/// An axis with ticks at 1, 2, 2.5 or 5 times a power of ten, written with just the digits that they need.
#[derive(Clone)]
struct Axis {
    low: f64,
    high: f64,
    step: f64,
}

impl Axis {
    /// Covers `values` and 0 with about seven steps.
    fn covering(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values.fold((0.0_f64, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
        let span = if high > low { high - low } else { 1.0 };
        let step = scale::round_step(span, 7.0);
        let low = if low < 0.0 { (low / step + 1e-6).floor() * step } else { 0.0 };
        Axis { low, high: ((high / step - 1e-6).ceil() * step).max(low + step), step }
    }
}

impl Ranged for Axis {
    type FormatOption = plotters::coord::ranged1d::NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value - self.low) / (self.high - self.low);
        limit.0 + (f64::from(limit.1 - limit.0) * share).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        let count = ((self.high - self.low) / self.step).round() as usize;
        (0..=count).map(|i| self.low + i as f64 * self.step).collect()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        scale::label(*value, self.step)
    }
}

/// Draws the chart as an SVG document.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub fn svg(chart: &Chart) -> Result<String, String> {
    framed(SIZE, |root| draw(chart, root)).map_err(|e| format!("the chart could not be drawn: {e}"))
}

/// An SVG document of so many pixels that `fill` draws on, [`FINE`] times finer.
///
/// # Errors
/// What `fill` returns.
pub fn framed(
    size: (u32, u32),
    fill: impl FnOnce(&DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), Box<dyn std::error::Error>>,
) -> Result<String, Box<dyn std::error::Error>> {
    let mut text = String::new();
    let root = SVGBackend::with_string(&mut text, (size.0 * FINE, size.1 * FINE)).into_drawing_area();
    root.fill(&WHITE)?;
    fill(&root)?;
    root.present()?;
    drop(root);
    let header = |scale: u32| format!("<svg width=\"{}\" height=\"{}\"", size.0 * scale, size.1 * scale);
    Ok(text.replacen(&header(FINE), &header(1), 1))
}

fn draw(chart: &Chart, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), Box<dyn std::error::Error>> {
    let finite: Vec<Vec<(f64, f64)>> = chart
        .series
        .iter()
        .map(|s| s.points.iter().filter(|p| p.iter().all(|v| v.is_finite())).map(|p| (p[0], p[1])).collect())
        .collect();
    let x = Axis::covering(finite.iter().flatten().map(|p| p.0));
    let y = Axis::covering(finite.iter().flatten().map(|p| p.1));
    let font = |size: u32| ("sans-serif", size * FINE).into_font().color(&INK);
    let mut area = ChartBuilder::on(root)
        .margin(14 * FINE)
        .margin_right(26 * FINE)
        .x_label_area_size(52 * FINE)
        .y_label_area_size(66 * FINE)
        .build_cartesian_2d(x, y)?;
    area.configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(INK.stroke_width(FINE))
        .set_all_tick_mark_size(5 * FINE)
        .label_style(font(16))
        .axis_desc_style(font(18))
        .x_desc(&chart.x_label)
        .y_desc(&chart.y_label)
        .draw()?;
    for (i, (series, points)) in chart.series.iter().zip(&finite).enumerate() {
        let colour = COLOURS[i % COLOURS.len()];
        let style = colour.stroke_width(2 * FINE);
        let [dash, gap] = DASHES[i % DASHES.len()].map(|pixels| pixels * FINE);
        let annotation = if gap == 0 {
            area.draw_series(LineSeries::new(points.iter().copied(), style))?
        } else {
            area.draw_series(DashedLineSeries::new(points.iter().copied(), dash, gap, style))?
        };
        annotation.label(&series.label).legend(move |(x, y)| {
            let sample = [(x, y), (x + 36 * FINE as i32, y)];
            if gap == 0 {
                PathElement::new(sample, style).into_dyn()
            } else {
                DashedPathElement::new(sample, dash, gap, style).into_dyn()
            }
        });
        if series.marks {
            area.draw_series(points.iter().map(|&p| Circle::new(p, 3 * FINE, colour.filled())))?;
        }
    }
    area.configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .margin(14 * FINE)
        .legend_area_size(44 * FINE)
        .label_font(font(16))
        .background_style(WHITE.mix(0.85))
        .draw()?;
    Ok(())
}
