//! Maps of a rough surface as PNG: heights, pressure, contact by regime, with axes and colour key.
//!
//! A map is an SVG document around an indexed picture of its cells; the PNG is that document rendered, dot
//! for dot.

use super::encode::{drawing_png, indexed_png};
use super::frame::{Frame, HEADS, ROOM_LEFT, ROOM_RIGHT, Short, boxes, document};
use super::palette::{Bands, Colour, REGIMES, interpolated};
use crate::numbers::decimals;
use maud::{Markup, html};

/// No side of a picture is longer, unless less is asked for.
pub const MAX_SIDE_DOTS: usize = 2048;
/// Small maps are enlarged to about so many dots.
const WANTED_DOTS: usize = 640;
/// Longer side of a map on paper: the whole is so narrow that its letters stay legible on a phone.
const SIDE: f64 = 408.0;
/// Room above a map for title and heading.
const ROOM_ABOVE: f64 = 58.0;
/// Room below it for its axis, and for the key.
const ROOM_BELOW: f64 = 76.0;
/// A colour bar is at least so high, a picture at least so wide.
const MIN_SIZE: [f64; 2] = [560.0, 110.0];

/// Outlines on a map.
const MARK: &str = "#0086c8";

/// One number per cell.
#[derive(Clone, Copy)]
pub struct Map<'a> {
    /// Columns and rows.
    pub cells: [usize; 2],
    /// Size of a cell along x and y, m.
    pub pixel: [f64; 2],
    /// Row by row, y rising.
    pub values: &'a [f32],
    /// No side of the picture has more dots.
    pub longest: usize,
}

/// The way cells become dots: several cells a dot, or several dots a cell, so that lengths keep their ratio.
struct Grid {
    cells: [usize; 2],
    dots: [usize; 2],
    frame: Frame,
    /// Width and height of the picture on paper.
    paper: [f64; 2],
    /// Dots to a unit of paper.
    fine: f64,
}

impl Grid {
    fn new(map: &Map) -> Grid {
        let size = [0, 1].map(|k| map.cells[k] as f64 * map.pixel[k] * 1e6);
        let longer = size[0].max(size[1]);
        let extent = size.map(|s| s / longer * SIDE);
        let paper = [
            (ROOM_LEFT + extent[0] + ROOM_RIGHT).max(MIN_SIZE[0]),
            ROOM_ABOVE + extent[1].max(MIN_SIZE[1] - ROOM_BELOW) + ROOM_BELOW,
        ];
        let cells = map.cells[0].max(map.cells[1]);
        let wanted = if cells >= WANTED_DOTS { cells } else { cells * WANTED_DOTS.div_ceil(cells.max(1)) };
        let fine = (wanted as f64 / SIDE).min(map.longest as f64 / paper[0].max(paper[1]));
        let dots = extent.map(|side| ((side * fine).round() as usize).max(1));
        // the picture's corner lies on a dot, so that its dots are those of the map
        let top = (ROOM_ABOVE * fine).round() / fine;
        Grid { cells: map.cells, dots, frame: Frame::new(top, extent[0], [0.0; 2], size), paper, fine }
    }

    /// Cells `start..end` that dot `dot` shows along axis `k`.
    fn span(&self, k: usize, dot: usize) -> std::ops::Range<usize> {
        let start = dot * self.cells[k] / self.dots[k];
        let end = ((dot + 1) * self.cells[k] / self.dots[k]).max(start + 1);
        start..end
    }

    /// `colour` of the cells of each dot, row by row from the top, where y is largest.
    fn paint(&self, colour: impl Fn(&mut dyn Iterator<Item = usize>) -> u8) -> Vec<u8> {
        let mut indices = Vec::with_capacity(self.dots[0] * self.dots[1]);
        for y in (0..self.dots[1]).rev() {
            let rows = self.span(1, y);
            for x in 0..self.dots[0] {
                let columns = self.span(0, x);
                let mut cells = rows
                    .clone()
                    .flat_map(|row| columns.clone().map(move |column| row * self.cells[0] + column));
                indices.push(colour(&mut cells));
            }
        }
        indices
    }

    /// The picture as PNG: its cells, what they mean, and `key` beside or below them.
    fn png(
        &self,
        title: &str,
        heading: &str,
        (palette, indices): (&[Colour], &[u8]),
        key: &Markup,
    ) -> Result<Vec<u8>, String> {
        let picture = indexed_png(self.dots, palette, indices)?;
        let body = html! {
            text x=(Short(HEADS)) y="41" { (heading) }
            (self.frame.image(&picture))
            (self.frame.axes(["x (µm)", "y (µm)"], true))
            (key)
        };
        drawing_png(&document(self.paper, title, &body), self.fine)
    }

    /// An ellipse with its name beside it.
    fn mark(&self, mark: &Mark) -> Markup {
        let [x, y] = [self.frame.x(mark.centre[0]), self.frame.y(mark.centre[1])];
        let scale = self.frame.size[0] / (self.frame.high[0] - self.frame.low[0]);
        // small ones stay visible
        let [a, b] = mark.semi_axes.map(|s| (s * scale).max(2.0));
        // y of a picture points down
        let turn = Short(-mark.angle.to_degrees());
        html! {
            ellipse rx=(Short(a)) ry=(Short(b)) transform={ "translate(" (Short(x)) " " (Short(y)) ") rotate(" (turn) ")" }
                fill="none" stroke=(MARK) stroke-width="1.5" {}
            text x=(Short(x + 4.0)) y=(Short(y - 4.0)) style={ "fill:" (MARK) ";font-size:14px;paint-order:stroke;stroke:#fff;stroke-width:2.5px" } { (mark.label) }
        }
    }

    /// Colours of a scale with the numbers beside the map; `nothing` counts from 1 after the colours of the
    /// scale.
    fn scaled(&self, bands: &Bands, nothing: Colour) -> (Vec<Colour>, Markup) {
        ([bands.colours.as_slice(), &[nothing]].concat(), self.frame.bar(bands, MIN_SIZE[1]))
    }
}

/// The three leading digits of a pressure.
fn digits(value: f64) -> String {
    format!("{value:.*}", decimals(value.max(1.0), 3))
}

/// The value that a share of the loaded pixels does not exceed.
fn quantile(values: &[f32], share: f64) -> f64 {
    let mut loaded: Vec<f32> = values.iter().copied().filter(|v| *v > 0.0).collect();
    if loaded.is_empty() {
        return 1.0;
    }
    let k = ((loaded.len() - 1) as f64 * share) as usize;
    let (_, value, _) = loaded.select_nth_unstable_by(k, f32::total_cmp);
    f64::from(*value)
}

/// Pressure in MPa under `nominal_mpa`: colours end at the pressure that 99 % of the loaded pixels do not
/// exceed; no load is pale.
///
/// # Errors
/// A picture that cannot be encoded.
pub fn pressure(map: &Map, title: &str, nominal_mpa: f64) -> Result<Vec<u8>, String> {
    let grid = Grid::new(map);
    let most = quantile(map.values, 0.99);
    let bands = Bands::smooth([0.0, most]).darkening();
    let (palette, key) = grid.scaled(&bands, REGIMES[0]);
    let none = palette.len() as u8;
    // the largest pressure of the cells of a dot: small asperities stay visible
    let indices = grid.paint(|cells| {
        let value = cells.fold(0f32, |v, i| v.max(map.values[i]));
        if value > 0.0 { 1 + bands.band(f64::from(value)) as u8 } else { none }
    });
    let heading = format!(
        "pressure (MPa); 99 % of the contact below {}; nominal {}",
        digits(most),
        digits(nominal_mpa)
    );
    grid.png(title, &heading, (&palette, &indices), &key)
}

/// Heights in µm, from low to high; missing ones are pale.
///
/// # Errors
/// A picture that cannot be encoded.
pub fn heights(map: &Map, title: &str) -> Result<Vec<u8>, String> {
    asperities(map, title, &[])
}

/// An ellipse on a map with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Its centre, µm from the corner of the map.
    pub centre: [f64; 2],
    /// Major and minor semi-axis, µm.
    pub semi_axes: [f64; 2],
    /// From x to the major axis, radians.
    pub angle: f64,
    /// Its name.
    pub label: String,
}

/// Heights in µm as [`heights`], with ellipses on them.
///
/// # Errors
/// A picture that cannot be encoded.
pub fn asperities(map: &Map, title: &str, marks: &[Mark]) -> Result<Vec<u8>, String> {
    let grid = Grid::new(map);
    let (low, high) = map.values.iter().fold((f32::MAX, f32::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
    let bands = Bands::smooth([f64::from(low), f64::from(high)]);
    let (palette, key) = grid.scaled(&bands, REGIMES[0]);
    let none = palette.len() as u8;
    let indices = grid.paint(|cells| {
        let finite = cells.map(|i| f64::from(map.values[i])).filter(|v| v.is_finite());
        let (sum, count) = finite.fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
        if count > 0.0 { 1 + bands.band(sum / count) as u8 } else { none }
    });
    let over = html! { (grid.frame.cut(&html! { @for mark in marks { (grid.mark(mark)) } })) (key) };
    grid.png(title, "height (µm)", (&palette, &indices), &over)
}

/// Contact by regime with the shares of each; a partly covered pixel is paler.
///
/// # Errors
/// A picture that cannot be encoded.
pub fn contact(map: &Map, title: &str, regime: &[f32], shares: Option<[f64; 3]>) -> Result<Vec<u8>, String> {
    /// Shades of each regime, from none to full cover.
    const SHADES: usize = 64;
    let grid = Grid::new(map);
    let shade = |i: usize| {
        let full = REGIMES[1 + i / SHADES];
        interpolated(&[REGIMES[0], full], (i % SHADES) as f64 / (SHADES - 1) as f64)
    };
    let palette: Vec<Colour> = (0..3 * SHADES).map(shade).collect();
    let indices = grid.paint(|cells| {
        let (mut cover, mut worst, mut count) = (0f32, 0f32, 0);
        for i in cells {
            (cover, worst, count) = (cover + map.values[i], worst.max(regime[i]), count + 1);
        }
        let share = f64::from(cover) / f64::from(count.max(1));
        let shade = (share.clamp(0.0, 1.0) * (SHADES - 1) as f64).round() as usize;
        1 + (SHADES * (worst as usize).clamp(1, 3) - SHADES + shade) as u8
    });
    let names = ["elastic", "elastoplastic", "plastic"].iter().enumerate().map(|(k, name)| {
        let share = shares.map_or_else(String::new, |s| format!(" {:.0} %", 100.0 * s[k]));
        (REGIMES[k + 1], format!("{name}{share}"))
    });
    let (key, _) = boxes(grid.frame.bottom() + 50.0, grid.paper[0], &names.collect::<Vec<_>>());
    grid.png(title, "contact by regime", (&palette, &indices), &key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_keep_their_proportions_and_their_limit() {
        for (cells, pixel, want) in [
            ([1024, 1024], [1.0, 1.0], [1.0, 1.0]),
            ([8192, 4096], [1.0, 1.0], [1.0, 0.5]),
            ([100, 100], [1.0, 2.0], [0.5, 1.0]),
            ([5000, 10], [1.0, 1.0], [1.0, 0.002]),
        ] {
            let grid = Grid::new(&Map { cells, pixel, values: &[], longest: MAX_SIDE_DOTS });
            let longer = grid.dots[0].max(grid.dots[1]) as f64;
            for k in 0..2 {
                assert!((grid.dots[k] as f64 - want[k] * longer).abs() <= 1.0, "{:?}", grid.dots);
                assert!(grid.paper[k] * grid.fine <= MAX_SIDE_DOTS as f64 + 1e-6);
            }
            assert!(longer >= 640.0);
        }
    }

    #[test]
    fn a_picture_reads_back() {
        let values: Vec<f32> = (0..64).map(|i| i as f32 / 8.0).collect();
        let map = Map { cells: [8, 8], pixel: [1e-6, 1e-6], values: &values, longest: MAX_SIDE_DOTS };
        let size = |picture: Vec<u8>| {
            let reader = png::Decoder::new(std::io::Cursor::new(picture)).read_info().unwrap();
            [reader.info().width, reader.info().height]
        };
        let first = size(pressure(&map, "pressure", 100.0).unwrap());
        assert!(first[0] > 640 && first.iter().all(|side| *side <= 2048), "{first:?}");
        contact(&map, "contact", &[3.0; 64], None).unwrap();
        let small = size(heights(&Map { longest: 300, ..map }, "heights").unwrap());
        assert!(small.iter().all(|side| *side <= 300), "{small:?}");
    }
}
