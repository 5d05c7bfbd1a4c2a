//! One panel: contours, tool, outline, axes, colour bar.

use super::palette::{Bands, ELASTIC, ZONES};
use super::raster::{Dot, Raster};
use super::window::Window;
use super::{MICROMETRE, Panel, Section, Short};
use crate::draw::scale;
use asperity_solver::scene::ToolForm;
use base64::Engine;
use maud::{Markup, html};
use std::fmt::Write;

/// Lines take the colour of the text around them, so that they show on dark ground too; those on metal are dark.
pub const STYLE: &str = ".section text{font:13px system-ui,sans-serif;fill:currentColor}.section .title{font-size:15px;font-weight:600}\
.section .line{fill:none;stroke:currentColor;stroke-width:1}.section .thin{fill:none;stroke:#26303a;stroke-width:.5;opacity:.6}\
.section .grid{stroke:currentColor;stroke-width:.5;opacity:.2}.section .tool{fill:#8b95a1}.section .on-tool{fill:#fff}\
.section .area{fill:#0072b2;fill-opacity:.35;stroke:#0072b2;stroke-width:1.5}.section image{image-rendering:auto}";

/// Room left of the drawing, for the numbers of the vertical axis.
const LEFT: f64 = 62.0;
/// Room right of it, for the colour bar.
const RIGHT: f64 = 96.0;
/// Width of the drawing.
const WIDTH: f64 = 640.0;
/// Dots of the contours for a unit of the drawing.
const FINE: f64 = 2.0;
/// Room above a drawing for what it shows.
const HEADING: f64 = 26.0;
/// Height of the curve of the contact pressure.
const CURVE: f64 = 110.0;

/// How the window is put on paper.
pub struct Layout {
    window: Window,
    /// Units of the drawing per µm.
    scale: f64,
    height: f64,
}

impl Layout {
    pub fn new(window: &Window) -> Layout {
        let size = window.size();
        let scale = WIDTH / size[0];
        Layout { window: *window, scale, height: size[1] * scale }
    }

    pub fn dots(&self) -> [usize; 2] {
        [WIDTH, self.height].map(|length| ((length * FINE).round() as usize).max(1))
    }

    pub fn width(&self) -> f64 {
        LEFT + WIDTH + RIGHT
    }

    pub fn left(&self) -> f64 {
        LEFT
    }

    pub fn title_height(&self) -> f64 {
        24.0
    }

    fn x(&self, r: f64) -> f64 {
        (r - self.window.low[0]) * self.scale
    }

    fn y(&self, z: f64) -> f64 {
        (self.window.high[1] - z) * self.scale
    }

    /// A path of straight and parabolic sides, those outside the window left out.
    fn path(&self, sides: impl Iterator<Item = [[f64; 2]; 3]>, mirrored: bool) -> String {
        let mut path = String::new();
        for side in sides {
            let images: &[f64] = if mirrored { &[1.0, -1.0] } else { &[1.0] };
            for &image in images {
                let [a, b, c] = side.map(|[r, z]| [image * r, z]);
                if self.window.meets(&[a, b]) {
                    let [a, b, c] = [a, b, c].map(|[r, z]| [self.x(r), self.y(z)]);
                    let _ = write!(
                        path,
                        "M{:.1} {:.1}Q{:.1} {:.1} {:.1} {:.1}",
                        a[0], a[1], c[0], c[1], b[0], b[1]
                    );
                }
            }
        }
        path
    }
}

/// Height of the tool's face above its lowest point, at a distance r from the axis, both in µm.
pub fn profile(tool: &ToolForm) -> impl Fn(f64) -> f64 + use<> {
    let tool = *tool;
    let round = |radius: f64, r: f64| radius - (radius * radius - r * r).max(0.0).sqrt();
    move |r: f64| {
        let r = r.abs();
        match tool {
            ToolForm::Plane => 0.0,
            ToolForm::Sphere { radius } => round(radius / MICROMETRE, r),
            ToolForm::Cone { slope, tip_radius } => {
                let radius = tip_radius / MICROMETRE;
                if r < radius * slope.sin() {
                    round(radius, r)
                } else {
                    r * slope.tan() - radius * (slope.cos().recip() - 1.0)
                }
            }
        }
    }
}

/// The bar beside a panel, or the boxes below it.
enum Key {
    Bar(Bands),
    Boxes(Vec<([u8; 3], String)>),
    None,
}

impl Section {
    /// A panel and its height.
    pub(super) fn panel(
        &self,
        kind: Panel,
        layout: &Layout,
        raster: &Raster,
        last: bool,
    ) -> Result<(Markup, f64), String> {
        if kind == Panel::ContactPressure {
            return Ok(self.pressure_curve(layout));
        }
        let (heading, image, key) = self.contours(kind, raster)?;
        let boxes = matches!(key, Key::Boxes(_));
        let sides = if kind == Panel::Mesh {
            layout.path(self.metal.sides().into_iter(), self.mirrored)
        } else {
            String::new()
        };
        let outline = layout.path(self.metal.surface_sides(), self.mirrored);
        let base =
            format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(&image));
        let drawing = html! {
            text x=(Short(LEFT)) y="17" { (heading) }
            svg x=(Short(LEFT)) y=(Short(HEADING)) width=(Short(WIDTH)) height=(Short(layout.height)) {
                @if !image.is_empty() {
                    image href=(base) x="0" y="0" width=(Short(WIDTH)) height=(Short(layout.height)) preserveAspectRatio="none" {}
                }
                @if !sides.is_empty() { path class="thin" d=(sides) {} }
                path class="line" d=(outline) {}
                @if let Some(tool) = self.tool_outline(layout) { path class="tool" d=(tool) {} }
                @if self.tip.is_some() && layout.y(self.tip.unwrap_or(0.0)) > 16.0 {
                    text class="on-tool" x=(Short(0.5 * WIDTH)) y=(Short(0.5 * layout.y(self.tip.unwrap_or(0.0)) + 5.0)) text-anchor="middle" { "rigid tool" }
                }
            }
            (self.axes(layout, last))
            (key_markup(&key, layout, last))
        };
        let below = if last { 42.0 } else { 12.0 };
        Ok((drawing, HEADING + layout.height + below + if boxes { 24.0 } else { 0.0 }))
    }

    /// Heading, PNG and key of a panel.
    fn contours(&self, kind: Panel, raster: &Raster) -> Result<(String, Vec<u8>, Key), String> {
        let banded = |heading: &str, i: usize, bands: Bands| {
            let png = raster.png(&bands.colours, |dot| 1 + bands.band(f64::from(dot.values[i])) as u8)?;
            Ok((heading.to_string(), png, Key::Bar(bands)))
        };
        match kind {
            Panel::VonMises => banded("von Mises stress (MPa)", 0, Bands::rising(raster.range(0)[1])),
            Panel::Pressure => {
                banded("hydrostatic pressure (MPa), tension below 0", 1, Bands::about_zero(raster.range(1)))
            }
            Panel::PlasticStrain => {
                let bands = Bands::strain(raster.range(2)[1]);
                let palette = [bands.colours.as_slice(), &[ELASTIC]].concat();
                let elastic = palette.len() as u8;
                let png = raster.png(&palette, |dot| {
                    let strain = f64::from(dot.values[2]);
                    if strain < bands.edges[0] { elastic } else { 1 + bands.band(strain) as u8 }
                })?;
                let least = 100.0 * bands.edges[0];
                Ok((
                    format!("accumulated plastic strain (%); pale: elastic, or below {least} %"),
                    png,
                    Key::Bar(bands),
                ))
            }
            Panel::ElasticZones => {
                let png = self.zones(raster)?;
                let names = ["never yielded", "has yielded, elastic now", "flows now"];
                let mut boxes: Vec<([u8; 3], String)> =
                    ZONES.into_iter().zip(names.map(String::from)).collect();
                if let Some(stress) = self.yield_stress {
                    boxes.push((ZONES[3], format!("von Mises stress = {stress} MPa")));
                }
                Ok(("elastic zones".into(), png, Key::Boxes(boxes)))
            }
            Panel::Mesh | Panel::ContactPressure => {
                Ok(("elements".into(), raster.png(&[ELASTIC], |_| 1)?, Key::None))
            }
        }
    }

    /// Zones by cell, and a line where the von Mises stress passes the first yield stress.
    fn zones(&self, raster: &Raster) -> Result<Vec<u8>, String> {
        let [columns, rows] = raster.size;
        let limit = self.yield_stress.unwrap_or(f64::INFINITY) as f32;
        let above = |x: usize, y: usize| raster.dots[y * columns + x].map(|dot: Dot| dot.values[0] >= limit);
        let mut painted = Raster { size: raster.size, dots: raster.dots.clone() };
        for y in 0..rows {
            for x in 0..columns {
                let here = above(x, y);
                let next =
                    [(x + 1 < columns).then(|| above(x + 1, y)), (y + 1 < rows).then(|| above(x, y + 1))];
                let crossing =
                    next.into_iter().flatten().flatten().any(|other| here.is_some_and(|h| h != other));
                if crossing && let Some(dot) = &mut painted.dots[y * columns + x] {
                    dot.zone = 3;
                }
            }
        }
        painted.png(&ZONES, |dot| 1 + dot.zone.min(3))
    }

    /// The tool down to its face.
    fn tool_outline(&self, layout: &Layout) -> Option<String> {
        let tip = self.tip?;
        let face = profile(&self.tool);
        let window = &layout.window;
        let mut path = format!("M0 0H{WIDTH}");
        for i in (0..=200).rev() {
            let r = window.low[0] + f64::from(i) / 200.0 * (window.high[0] - window.low[0]);
            let _ = write!(path, "L{:.1} {:.1}", layout.x(r), layout.y(tip + face(r)).max(0.0));
        }
        path.push('Z');
        Some(path)
    }

    fn axes(&self, layout: &Layout, last: bool) -> Markup {
        let window = &layout.window;
        let size = window.size();
        let (step_x, step_z) = (
            scale::round_step(size[0], 8.0),
            scale::round_step(size[1], (layout.height / 34.0).clamp(2.0, 8.0)),
        );
        let bottom = HEADING + layout.height;
        let name = if self.revolved { "r (µm)" } else { "x (µm)" };
        html! {
            rect class="line" x=(Short(LEFT)) y=(Short(HEADING)) width=(Short(WIDTH)) height=(Short(layout.height)) {}
            @for z in scale::multiples(window.low[1], window.high[1], step_z) {
                @let y = HEADING + layout.y(z);
                path class="line" d={ "M" (Short(LEFT - 5.0)) " " (Short(y)) "h5" } {}
                text x=(Short(LEFT - 8.0)) y=(Short(y + 4.5)) text-anchor="end" { (scale::label(z, step_z)) }
            }
            text transform={ "translate(14 " (Short(HEADING + 0.5 * layout.height)) ") rotate(-90)" } text-anchor="middle" { "z (µm)" }
            @for r in scale::multiples(window.low[0], window.high[0], step_x) {
                @let x = LEFT + layout.x(r);
                path class="line" d={ "M" (Short(x)) " " (Short(bottom)) "v5" } {}
                @if last { text x=(Short(x)) y=(Short(bottom + 19.0)) text-anchor="middle" { (scale::label(r.abs(), step_x)) } }
            }
            @if last { text x=(Short(LEFT + 0.5 * WIDTH)) y=(Short(bottom + 37.0)) text-anchor="middle" { (name) } }
        }
    }

    /// The pressure of the tool along the surface, over the same horizontal axis.
    fn pressure_curve(&self, layout: &Layout) -> (Markup, f64) {
        let window = &layout.window;
        let inside = |p: &&[f64; 2]| p[0] >= window.low[0] && p[0] <= window.high[0];
        let points: Vec<[f64; 2]> = self.metal.surface.iter().filter(inside).copied().collect();
        let most = points.iter().map(|p| p[1]).fold(0.0, f64::max);
        let step = scale::round_step(if most > 0.0 { most } else { 1.0 }, 4.0);
        let high = (most / step).ceil().max(1.0) * step;
        let y = |p: f64| HEADING + CURVE * (1.0 - p / high);
        let mut along: Vec<[f64; 2]> = Vec::new();
        if self.mirrored {
            along.extend(points.iter().rev().map(|p| [-p[0], p[1]]));
        }
        along.extend(&points);
        let mut path = String::new();
        if let (Some(first), Some(end)) = (along.first(), along.last()) {
            let _ = write!(path, "M{:.1} {:.1}", LEFT + layout.x(first[0]), y(0.0));
            for [r, p] in &along {
                let _ = write!(path, "L{:.1} {:.1}", LEFT + layout.x(*r), y(*p));
            }
            let _ = write!(path, "L{:.1} {:.1}Z", LEFT + layout.x(end[0]), y(0.0));
        }
        let drawing = html! {
            text x=(Short(LEFT)) y="17" { "contact pressure (MPa)" }
            @for p in scale::multiples(0.0, high, step) {
                path class="grid" d={ "M" (Short(LEFT)) " " (Short(y(p))) "h" (Short(WIDTH)) } {}
                text x=(Short(LEFT - 8.0)) y=(Short(y(p) + 4.5)) text-anchor="end" { (scale::label(p, step)) }
            }
            path class="area" d=(path) {}
            path class="line" d={ "M" (Short(LEFT)) " " (Short(HEADING)) "v" (Short(CURVE)) "h" (Short(WIDTH)) } {}
        };
        (drawing, HEADING + CURVE + 12.0)
    }
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn key_markup(key: &Key, layout: &Layout, last: bool) -> Markup {
    match key {
        Key::None => html! {},
        Key::Boxes(boxes) => {
            let y = HEADING + layout.height + if last { 46.0 } else { 14.0 };
            // room by the number of letters
            let starts = boxes.iter().scan(LEFT, |x, (_, name)| {
                let start = *x;
                *x += 34.0 + 7.0 * name.chars().count() as f64;
                Some(start)
            });
            html! {
                @for (x, (colour, name)) in starts.zip(boxes) {
                    rect x=(Short(x)) y=(Short(y)) width="14" height="14" fill=(hex(*colour)) stroke="currentColor" stroke-width=".5" {}
                    text x=(Short(x + 20.0)) y=(Short(y + 12.0)) { (name) }
                }
            }
        }
        Key::Bar(bands) => {
            let (x, count) = (LEFT + WIDTH + 14.0, bands.colours.len() as f64);
            let y = |edge: f64| HEADING + layout.height * (1.0 - edge / count);
            // numbers closer than a line of text are left out
            let sparse = ((bands.labels.len() as f64 * 15.0 / layout.height).ceil() as usize).max(1);
            html! {
                @for (i, colour) in bands.colours.iter().enumerate() {
                    rect x=(Short(x)) y=(Short(y(i as f64 + 1.0))) width="16" height=(Short(layout.height / count + 0.3)) fill=(hex(*colour)) {}
                }
                rect class="line" x=(Short(x)) y=(Short(HEADING)) width="16" height=(Short(layout.height)) {}
                @for (edge, label) in bands.labels.iter().step_by(sparse) {
                    @let at = y(*edge as f64);
                    path class="line" d={ "M" (Short(x + 16.0)) " " (Short(at)) "h4" } {}
                    text x=(Short(x + 23.0)) y=(Short(at + 4.5)) { (label) }
                }
            }
        }
    }
}
