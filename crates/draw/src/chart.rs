//! Line charts as SVG: labelled with units, legible in print and to colour-blind people.
//!
//! Lines differ in colour and in dash, so that either alone tells them apart, unless they say how they look.
//! The legend stands below the axes, where no data are. A chart is so narrow that its letters stay legible
//! on a phone, where it is shrunk to the width of the page.

use super::axis::Axis;
use super::encode::FAMILY;
use super::palette::{self, Colour};
use asperity_roughness::Closure;
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::series::DashedLineSeries;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// One line of a chart.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// Points (x, y) in the unit of the axes; those that are not finite are left out.
    pub points: Vec<[f64; 2]>,
    /// True where each point is marked with a dot.
    pub marks: bool,
    /// Its colour; by its place among the lines where none is given.
    pub colour: Option<Colour>,
    /// Its dash; a line of a given colour is solid where none is given, others go by their place.
    pub dash: Option<Dash>,
    /// Outline of the band of its error, drawn pale under the line; none if empty.
    pub band: Vec<[f64; 2]>,
}

/// The way a line is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    Solid,
    /// Into dashes: what goes back, as in unloading.
    Dashed,
    /// Into dots.
    Dotted,
    /// Into long dashes.
    Long,
    /// There is none: its points alone.
    Hidden,
}

impl Series {
    /// A line that looks as its place among the lines says.
    pub fn line(label: impl Into<String>, points: Vec<[f64; 2]>) -> Series {
        Series { label: label.into(), points, ..Series::default() }
    }

    /// The loading or unloading of a rough surface by a closure: its colour is that of the closure in every
    /// chart.
    pub fn of_closure(closure: Closure, unloading: bool, points: Vec<[f64; 2]>) -> Series {
        let (end, dash) = if unloading { (", unloading", Dash::Dashed) } else { ("", Dash::Solid) };
        let label = format!("{}{end}", closure.name());
        Series { colour: Some(palette::closure(closure)), dash: Some(dash), ..Series::line(label, points) }
    }

    /// The same with a dot at each point.
    #[must_use]
    pub fn marked(self) -> Series {
        Series { marks: true, ..self }
    }
}

/// A chart of lines over common axes: each starts at 0 or below, or is logarithmic.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Name of the horizontal axis with its unit.
    pub x_label: String,
    /// Name of the vertical axis with its unit.
    pub y_label: String,
    /// The lines, drawn in this order.
    pub series: Vec<Series>,
    /// A sentence above the axes, which is also the name of the picture for those who cannot see it; none if
    /// empty.
    pub title: String,
    /// True where the horizontal and where the vertical axis is logarithmic; points without a logarithm are
    /// left out.
    pub logarithmic: [bool; 2],
}

impl Chart {
    /// A chart of `series` over axes of these names.
    pub fn new(
        x_label: impl Into<String>,
        y_label: impl Into<String>,
        series: impl IntoIterator<Item = Series>,
    ) -> Chart {
        let series = series.into_iter().collect();
        let (x_label, y_label) = (x_label.into(), y_label.into());
        Chart { x_label, y_label, series, title: String::new(), logarithmic: [false; 2] }
    }

    /// True where no line has a point to show.
    pub fn is_empty(&self) -> bool {
        !self.series.iter().flat_map(|line| &line.points).any(|point| point.iter().all(|v| v.is_finite()))
    }

    /// The same under a title.
    #[must_use]
    pub fn titled(self, title: impl Into<String>) -> Chart {
        Chart { title: title.into(), ..self }
    }

    /// The same with logarithmic axes, across and upward.
    #[must_use]
    pub fn logarithmic(self, logarithmic: [bool; 2]) -> Chart {
        Chart { logarithmic, ..self }
    }
}

/// Width and height of the axes with their names in pixels; 15 pixels of 540 are more than 9 on a phone.
pub const SIZE: (u32, u32) = (540, 400);
/// The library draws at whole pixels: it gets that many to a pixel of the picture.
pub const FINE_PIXELS: u32 = 8;
/// Lines and letters.
pub const INK: RGBColor = rgb(palette::INK);
/// Lines of the grid.
const GRID: RGBColor = rgb(palette::GRID);

/// A colour as the library takes it.
pub const fn rgb([r, g, b]: Colour) -> RGBColor {
    RGBColor(r, g, b)
}

/// Letters of `size` pixels: the library writes the 1.24th part of a size into a document.
pub fn font(size: u32) -> TextStyle<'static> {
    (FAMILY, size * FINE_PIXELS * 124 / 100).into_font().color(&INK)
}

/// An error of the drawing library.
pub type Failure = Box<dyn std::error::Error>;
/// A surface to draw on.
pub type Paper<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// The sign beside a name in a legend.
pub enum Sample {
    /// A piece of a line of this colour with dash and gap in pixels; no gap: solid, no dash: a dot.
    Line(RGBColor, [u32; 2]),
    /// A mark of this colour with its outline about the middle.
    Mark(RGBColor, Vec<(i32, i32)>),
    /// Nothing: the name heads those that follow.
    Heading,
}

/// An SVG document: axes of so many pixels that `fill` draws on, [`FINE_PIXELS`] times finer, and the legend
/// below them.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub fn framed(
    size: (u32, u32),
    legend: &[(String, Sample)],
    fill: impl FnOnce(&Paper) -> Result<(), Failure>,
) -> Result<String, String> {
    paint(size, legend, fill).map_err(|e| format!("the chart could not be drawn: {e}"))
}

/// Height of a row of a legend in pixels.
const ROW: u32 = 23;
/// Pixels from the left end of a chart to what stands above and below its axes.
const LEFT: u32 = 14;

impl Sample {
    /// Pixels from its left end to its name.
    fn width(&self) -> u32 {
        if matches!(self, Sample::Heading) { 0 } else { 44 }
    }
}

/// Pixels that an entry of a legend takes, by the number of its letters.
fn room((name, sample): &(String, Sample)) -> u32 {
    sample.width() + 10 * name.chars().count() as u32 + 14
}

/// Pixel from the left and row of each entry of a legend: a row is filled before the next one begins.
fn legend_places(width: u32, legend: &[(String, Sample)]) -> Vec<[u32; 2]> {
    let mut next = [LEFT, 0];
    let place = |entry| {
        if next[0] > LEFT && next[0] + room(entry) > width {
            next = [LEFT, next[1] + 1];
        }
        let here = next;
        next[0] += room(entry);
        here
    };
    legend.iter().map(place).collect()
}

fn paint(
    (width, height): (u32, u32),
    legend: &[(String, Sample)],
    fill: impl FnOnce(&Paper) -> Result<(), Failure>,
) -> Result<String, Failure> {
    let places = legend_places(width, legend);
    let ends = places.iter().zip(legend).map(|([x, _], entry)| x + room(entry));
    let whole = ends.max().unwrap_or(0).max(width);
    let rows = places.last().map_or(0, |[_, row]| row + 1);
    let tall = height + if rows > 0 { ROW * rows + 6 } else { 0 };
    let mut text = String::new();
    let root =
        SVGBackend::with_string(&mut text, (whole * FINE_PIXELS, tall * FINE_PIXELS)).into_drawing_area();
    root.fill(&WHITE)?;
    let (above, below) = root.split_vertically(height * FINE_PIXELS);
    let (axes, _) = above.split_horizontally(width * FINE_PIXELS);
    fill(&axes)?;
    let fine = FINE_PIXELS as i32;
    for ([x, row], (name, sample)) in places.into_iter().zip(legend) {
        let [x, y] = [x as i32, (ROW * row + ROW / 2) as i32].map(|pixels| pixels * fine);
        match sample {
            Sample::Line(colour, [dash, gap]) => {
                let (line, style) = ([(x, y), (x + 36 * fine, y)], colour.stroke_width(2 * FINE_PIXELS));
                match (dash, gap) {
                    (_, 0) => below.draw(&PathElement::new(line, style))?,
                    (0, _) => {
                        below.draw(&Circle::new((x + 18 * fine, y), 3 * FINE_PIXELS, colour.filled()))?
                    }
                    _ => below.draw(&DashedPathElement::new(line, *dash, *gap, style))?,
                }
            }
            Sample::Mark(colour, outline) => {
                let moved: Vec<_> = outline.iter().map(|(dx, dy)| (x + 18 * fine + dx, y + dy)).collect();
                below.draw(&Polygon::new(moved, colour.filled()))?;
            }
            Sample::Heading => {}
        }
        let style = font(15).pos(Pos::new(HPos::Left, VPos::Center));
        below.draw(&Text::new(name.as_str(), (x + sample.width() as i32 * fine, y), style))?;
    }
    root.present()?;
    drop((axes, above, below, root));
    let header = |scale: u32| format!("<svg width=\"{}\" height=\"{}\"", whole * scale, tall * scale);
    Ok(text.replacen(&header(FINE_PIXELS), &header(1), 1))
}

/// Colour, and pixels of dash and gap, of line `i`; no gap: solid, no dash: no line.
fn pen(i: usize, series: &Series) -> (RGBColor, [u32; 2]) {
    const ORDER: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::Dotted, Dash::Long];
    let placed = if series.colour.is_some() { Dash::Solid } else { ORDER[i % ORDER.len()] };
    let dash = match series.dash.unwrap_or(placed) {
        Dash::Solid => [1, 0],
        Dash::Dashed => [9, 5],
        Dash::Dotted => [3, 4],
        Dash::Long => [15, 4],
        Dash::Hidden => [0, 1],
    };
    let colour = series.colour.unwrap_or(palette::LINES[i % palette::LINES.len()]);
    (rgb(colour), dash.map(|pixels| pixels * FINE_PIXELS))
}

/// Place of the axes of a chart in its document, and their spans: left, top, right, lower end of both.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Window {
    /// In the units of the document's view box.
    pub frame: [f64; 4],
    /// In the units of the axes.
    pub range: [f64; 4],
}

/// Draws the chart as an SVG document.
///
/// # Errors
/// A text for a person where the drawing library fails.
pub fn svg(chart: &Chart) -> Result<String, String> {
    Ok(located(chart)?.0)
}

/// The same, and where its axes lie.
///
/// # Errors
/// Those of [`svg`].
pub fn located(chart: &Chart) -> Result<(String, Window), String> {
    let entry = |(i, series): (usize, &Series)| {
        let (colour, dashes) = pen(i, series);
        (series.label.clone(), Sample::Line(colour, dashes))
    };
    let mut legend: Vec<(String, Sample)> = Vec::new();
    for (name, sample) in chart.series.iter().enumerate().map(entry) {
        // both ends of an interval have one name
        if legend.iter().all(|(other, _)| *other != name) {
            legend.push((name, sample));
        }
    }
    let mut window = Window::default();
    let drawn = framed(SIZE, &legend, |paper| {
        window = draw(chart, paper)?;
        Ok(())
    })?;
    if chart.title.is_empty() {
        return Ok((drawn, window));
    }
    let Some((titled, shift)) = below_title(&chart.title, &drawn) else { return Ok((drawn, window)) };
    window.frame[1] += f64::from(shift * FINE_PIXELS);
    window.frame[3] += f64::from(shift * FINE_PIXELS);
    Ok((titled, window))
}

/// The same for a drawing of [`framed`]: the document below a title.
pub fn titled(title: &str, drawn: String) -> String {
    below_title(title, &drawn).map_or(drawn, |(titled, _)| titled)
}

/// `text` in lines of at most so many letters, broken between words.
fn lines(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.into()),
        }
    }
    lines
}

/// Height of a line of a title in pixels.
const TITLE: u32 = 22;

/// The document `drawn` of [`framed`] below a title, and the title's height in pixels; `None` if it is none
/// of that.
fn below_title(title: &str, drawn: &str) -> Option<(String, u32)> {
    let (head, rest) = drawn.split_once("<svg width=\"")?;
    let (tag, body) = rest.split_once('>')?;
    let mut numbers = tag.split(|c: char| !c.is_ascii_digit()).filter_map(|word| word.parse::<u32>().ok());
    let (width, height) = (numbers.next()?, numbers.next()?);
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let lines = lines(&title, ((width - 2 * LEFT) / 10) as usize);
    let above = TITLE * lines.len() as u32 + 8;
    let height = height + above;
    let [fine, left, line, size] = [above, LEFT, TITLE, 17].map(|pixels| pixels * FINE_PIXELS);
    let spans = lines.iter().map(|text| format!("<tspan x=\"{left}\" dy=\"{line}\">{text}</tspan>"));
    let text = format!(
        "{head}<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\">\
         <title>{title}</title><rect width=\"100%\" height=\"100%\" fill=\"#FFFFFF\"/>\
         <text y=\"0\" font-family=\"{FAMILY}\" font-size=\"{size}\" fill=\"{}\">{}</text>\
         <g transform=\"translate(0 {fine})\">{}</g></svg>\n",
        width * FINE_PIXELS,
        height * FINE_PIXELS,
        palette::hex(palette::INK),
        spans.collect::<String>(),
        body.trim_end().strip_suffix("</svg>")?
    );
    Some((text, above))
}

/// Axes on `paper` with their grid and names.
///
/// # Errors
/// Those of the drawing library.
pub fn axes<'a>(
    paper: &Paper<'a>,
    [x, y]: [Axis; 2],
    names: [&str; 2],
) -> Result<ChartContext<'a, SVGBackend<'a>, Cartesian2d<Axis, Axis>>, Failure> {
    // names are whole: letters get smaller where there are many
    let (wide, high) = paper.dim_in_pixel();
    let fitting = |name: &str, room: u32| room * 10 / (6 * FINE_PIXELS * name.chars().count().max(1) as u32);
    let size = fitting(names[0], wide * 9 / 10).min(fitting(names[1], high)).clamp(9, 16);
    let mut area = ChartBuilder::on(paper)
        .margin(LEFT * FINE_PIXELS)
        .margin_right(26 * FINE_PIXELS)
        .x_label_area_size(52 * FINE_PIXELS)
        .y_label_area_size(90 * FINE_PIXELS)
        .build_cartesian_2d(x, y)?;
    area.configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE_PIXELS))
        .axis_style(INK.stroke_width(FINE_PIXELS))
        .set_all_tick_mark_size(5 * FINE_PIXELS)
        .label_style(font(15))
        .axis_desc_style(font(size))
        .x_desc(names[0])
        .y_desc(names[1])
        .draw()?;
    Ok(area)
}

/// Draws axes and lines of the chart on `paper`.
///
/// # Errors
/// Those of the drawing library.
pub fn draw(chart: &Chart, paper: &Paper) -> Result<Window, Failure> {
    let placed = |points: &[[f64; 2]]| -> Vec<(f64, f64)> {
        let place = |p: &[f64; 2], k: usize| if chart.logarithmic[k] { p[k].log10() } else { p[k] };
        let places = points.iter().map(|p| [place(p, 0), place(p, 1)]);
        places.filter(|p| p.iter().all(|v| v.is_finite())).map(|[x, y]| (x, y)).collect()
    };
    let of_all = |of: fn(&Series) -> &Vec<[f64; 2]>| -> Vec<Vec<(f64, f64)>> {
        chart.series.iter().map(|series| placed(of(series))).collect()
    };
    let (finite, bands) = (of_all(|series| &series.points), of_all(|series| &series.band));
    let edges = || finite.iter().chain(&bands).flatten();
    let x = if chart.logarithmic[0] {
        Axis::logarithmic(edges().map(|p| p.0))
    } else {
        Axis::covering(finite.iter().flatten().map(|p| p.0))
    };
    let heights = edges().map(|p| p.1);
    let y = if chart.logarithmic[1] { Axis::logarithmic(heights) } else { Axis::covering(heights) };
    let range = [x.low, y.high, x.high, y.low];
    let mut area = axes(paper, [x, y], [&chart.x_label, &chart.y_label])?;
    let (across, down) = area.plotting_area().get_pixel_range();
    // the ranges end one beyond their last dot
    let frame = [across.start, down.start, across.end - 1, down.end - 1].map(f64::from);
    for (i, ((series, points), band)) in chart.series.iter().zip(&finite).zip(bands).enumerate() {
        let (colour, [dash, gap]) = pen(i, series);
        if !band.is_empty() {
            area.draw_series(std::iter::once(Polygon::new(band, colour.mix(0.25).filled())))?;
        }
        let style = colour.stroke_width(2 * FINE_PIXELS);
        if gap == 0 {
            area.draw_series(LineSeries::new(points.iter().copied(), style))?;
        } else if dash > 0 {
            area.draw_series(DashedLineSeries::new(points.iter().copied(), dash, gap, style))?;
        }
        if series.marks {
            area.draw_series(points.iter().map(|&p| Circle::new(p, 3 * FINE_PIXELS, colour.filled())))?;
        }
    }
    Ok(Window { frame, range })
}

#[cfg(test)]
mod tests;
