//! One panel: contours, tool, outline, axes, colour bar.

use super::deformed_mesh::Field;
use super::raster::Raster;
use super::section::Section;
use crate::encode::indexed_png;
use crate::frame::{Frame, HEADS, ROOM_LEFT, ROOM_RIGHT, Short, boxes, tick};
use crate::palette::{Bands, Colour, ELASTIC, ZONES};
use crate::scale;
use maud::{Markup, html};
use std::fmt::Write;

/// Room above a window for its heading.
pub const HEADING: f64 = 32.0;
/// Height of the curve of the contact pressure.
const CURVE: f64 = 90.0;

/// One drawing of the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Panel {
    /// The pressure of the tool along the surface, as a curve.
    ContactPressure,
    /// Von Mises stress.
    VonMises,
    /// Accumulated plastic strain; material that never yielded is pale.
    PlasticStrain,
    /// Hydrostatic pressure, tension below 0.
    Pressure,
    /// Material that never yielded, that yielded once and is elastic now, that yields; and the line of the
    /// first yield stress.
    ElasticZones,
    /// The elements.
    Mesh,
}

/// Heading, PNG and key of a panel.
struct Contours {
    heading: String,
    image: Vec<u8>,
    bar: Option<Bands>,
    boxes: Vec<(Colour, String)>,
}

impl Panel {
    /// Panels that `asperity crush` draws of the peak.
    pub const PEAK: [Panel; 4] =
        [Panel::ContactPressure, Panel::VonMises, Panel::PlasticStrain, Panel::Pressure];
    /// Fig. 5 of the paper.
    pub const FIG5: [Panel; 2] = [Panel::ElasticZones, Panel::Pressure];

    /// The fields whose contours it shows; the elements are drawn on the body, which any field tells.
    pub fn fields(self) -> &'static [Field] {
        match self {
            Panel::ContactPressure => &[],
            Panel::VonMises | Panel::Mesh => &[Field::VonMises],
            Panel::PlasticStrain => &[Field::PlasticStrain],
            Panel::Pressure => &[Field::Pressure],
            Panel::ElasticZones => &[Field::VonMises, Field::FirstYield, Field::YieldFunction],
        }
    }

    /// The panel in `frame`, whose top is below the heading, and the panel's height; the lowest one carries
    /// the numbers of the horizontal axis.
    ///
    /// # Errors
    /// A text for a person where a picture cannot be encoded.
    pub fn draw(
        self,
        section: &Section,
        frame: &Frame,
        raster: &Raster,
        lowest: bool,
    ) -> Result<(Markup, f64), String> {
        if self == Panel::ContactPressure {
            return Ok(pressure_curve(section, frame));
        }
        let contours = self.contours(section, raster)?;
        let outline = path(frame, section, section.mesh.surface_sides());
        let tip = section.tip.map(|tip| frame.y(tip)).filter(|y| *y > frame.top + 18.0);
        let below = if lowest { 42.0 } else { 12.0 };
        let width = ROOM_LEFT + frame.size[0] + ROOM_RIGHT;
        let (key, key_height) = boxes(frame.bottom() + below + 4.0, width, &contours.boxes);
        let drawing = html! {
            text x=(Short(HEADS)) y="17" { (contours.heading) }
            (frame.cut(&html! {
                (frame.image(&contours.image))
                @if self == Panel::Mesh { path class="thin" d=(path(frame, section, section.mesh.sides().into_iter())) {} }
                path class="line" d=(outline) {}
                @if section.tip.is_some() { path class="tool" d=(tool_outline(section, frame)) {} }
                @if let Some(tip) = tip {
                    text class="on-tool" x=(Short(ROOM_LEFT + 0.5 * frame.size[0])) y=(Short(0.5 * (frame.top + tip) + 5.0)) text-anchor="middle" { "rigid tool" }
                }
            }))
            (frame.axes([if section.revolved { "r (µm)" } else { "x (µm)" }, "z (µm)"], lowest))
            @if let Some(bands) = &contours.bar { (frame.bar(bands, 0.0)) }
            (key)
        };
        Ok((drawing, frame.bottom() + below + key_height))
    }

    fn contours(self, section: &Section, raster: &Raster) -> Result<Contours, String> {
        let banded = |heading: &str, field: Field, bands: Bands| {
            let mut last = 0;
            let image = raster.png(&bands.colours, field, |value| {
                last = bands.band_near(value, last);
                1 + last as u8
            })?;
            Ok(Contours { heading: heading.into(), image, bar: Some(bands), boxes: Vec::new() })
        };
        match self {
            Panel::VonMises => {
                let bands = Bands::rising(raster.range(Field::VonMises)[1]);
                banded("von Mises stress (MPa)", Field::VonMises, bands)
            }
            Panel::Pressure => {
                let bands = Bands::about_zero(raster.range(Field::Pressure));
                banded("hydrostatic pressure (MPa), tension below 0", Field::Pressure, bands)
            }
            Panel::PlasticStrain => {
                let bands = Bands::strain(raster.range(Field::PlasticStrain)[1]);
                let palette = [bands.colours.as_slice(), &[ELASTIC]].concat();
                let elastic = palette.len() as u8;
                let mut last = 0;
                let image = raster.png(&palette, Field::PlasticStrain, |strain| {
                    if strain < bands.edges[0] {
                        return elastic;
                    }
                    last = bands.band_near(strain, last);
                    1 + last as u8
                })?;
                let least = 100.0 * bands.edges[0];
                let heading = format!("accumulated plastic strain (%); pale: below {least} %");
                Ok(Contours { heading, image, bar: Some(bands), boxes: Vec::new() })
            }
            Panel::ElasticZones => {
                let names = ["never yielded", "has yielded, elastic now", "yields now"];
                let line = section.yield_stress.map(|stress| format!("line: von Mises stress {stress} MPa"));
                let boxes = ZONES.into_iter().zip(names.map(String::from).into_iter().chain(line)).collect();
                let heading = "elastic zones, by first yield and yield function".to_string();
                let image = zones(section, raster)?;
                Ok(Contours { heading, image, bar: None, boxes })
            }
            Panel::Mesh | Panel::ContactPressure => {
                let image = raster.png(&[ELASTIC], Field::VonMises, |_| 1)?;
                Ok(Contours { heading: "elements".into(), image, bar: None, boxes: Vec::new() })
            }
        }
    }
}

/// Yield function over yield stress below which metal is elastic: the yield stress of an increment is that of
/// the volume at its start, so that flowing metal is off by some thousandths.
const ELASTIC_NOW: f32 = -0.01;

/// Number of the zone of metal among [`ZONES`], counted from 1.
pub(super) fn zone(first_yield: f32, yield_function: f32) -> u8 {
    match (first_yield, yield_function) {
        (first_yield, _) if first_yield < 0.0 => 1,
        (_, now) if now < ELASTIC_NOW => 2,
        _ => 3,
    }
}

/// Zones by first yield and yield function, and a line where the von Mises stress passes the first yield
/// stress.
fn zones(section: &Section, raster: &Raster) -> Result<Vec<u8>, String> {
    let [columns, rows] = raster.size;
    let limit = section.yield_stress.unwrap_or(f64::INFINITY) as f32;
    let [stress, first_yield, now] =
        [Field::VonMises, Field::FirstYield, Field::YieldFunction].map(|field| raster.plane(field));
    let above = |place: usize| (!stress[place].is_nan()).then(|| stress[place] >= limit);
    let on_line = |place: usize| {
        let (x, y) = (place % columns, place / columns);
        let here = above(place);
        let next =
            [(x + 1 < columns).then_some(place + 1), (y + 1 < rows).then_some(place + columns)].into_iter();
        next.flatten().filter_map(above).any(|other| here.is_some_and(|h| h != other))
    };
    let zones = (0..columns * rows).map(|place| match place {
        place if stress[place].is_nan() => 0,
        place if on_line(place) => 4,
        place => zone(first_yield[place], now[place]),
    });
    indexed_png(raster.size, &ZONES, &zones.collect::<Vec<u8>>())
}

/// A path of straight and parabolic sides and their mirror images, those outside the window left out.
fn path(frame: &Frame, section: &Section, sides: impl Iterator<Item = [[f64; 2]; 3]>) -> String {
    let mut path = String::new();
    let images: &[f64] = if section.mirrored { &[1.0, -1.0] } else { &[1.0] };
    for side in sides {
        for &image in images {
            let [a, b, c] = side.map(|[r, z]| [image * r, z]);
            if section.window.meets(&[a, b]) {
                let [a, b, c] = [a, b, c].map(|[r, z]| [frame.x(r), frame.y(z)]);
                let _ =
                    write!(path, "M{:.1} {:.1}Q{:.1} {:.1} {:.1} {:.1}", a[0], a[1], c[0], c[1], b[0], b[1]);
            }
        }
    }
    path
}

/// The tool from the top of the window down to its face.
fn tool_outline(section: &Section, frame: &Frame) -> String {
    let mut path = format!("M{ROOM_LEFT} {}h{}", frame.top, frame.size[0]);
    for [r, z] in section.face() {
        let _ = write!(path, "L{:.1} {:.1}", frame.x(r), frame.y(z).max(frame.top));
    }
    path + "Z"
}

/// The pressure of the tool along the surface, over the same horizontal axis, and the height of the panel.
fn pressure_curve(section: &Section, frame: &Frame) -> (Markup, f64) {
    let inside = |p: &&[f64; 2]| p[0] >= frame.low[0] && p[0] <= frame.high[0];
    let points: Vec<[f64; 2]> = section.mesh.surface.iter().filter(inside).copied().collect();
    let most = points.iter().map(|p| p[1]).fold(0.0, f64::max);
    let step = scale::round_step(if most > 0.0 { most } else { 1.0 }, 4.0);
    let high = (most / step).ceil().max(1.0) * step;
    let y = |p: f64| HEADING + CURVE * (1.0 - p / high);
    let images = points.iter().rev().filter(|_| section.mirrored).map(|p| [-p[0], p[1]]);
    let along: Vec<[f64; 2]> = images.chain(points.iter().copied()).collect();
    let mut area = String::new();
    if let (Some(first), Some(end)) = (along.first(), along.last()) {
        let _ = write!(area, "M{:.1} {:.1}", frame.x(first[0]), y(0.0));
        for [r, p] in &along {
            let _ = write!(area, "L{:.1} {:.1}", frame.x(*r), y(*p));
        }
        let _ = write!(area, "L{:.1} {:.1}Z", frame.x(end[0]), y(0.0));
    }
    let (left, width) = (Short(ROOM_LEFT), Short(frame.size[0]));
    let drawing = html! {
        text x=(Short(HEADS)) y="17" { "contact pressure (MPa)" }
        @for p in scale::multiples(0.0, high, step) {
            path class="grid" d={ "M" (left) " " (Short(y(p))) "h" (width) } {}
            (tick(y(p), &scale::label(p, step)))
        }
        path class="area" d=(area) {}
        path class="line" d={ "M" (left) " " (Short(HEADING)) "v" (Short(CURVE)) "h" (width) } {}
    };
    (drawing, HEADING + CURVE + 12.0)
}
