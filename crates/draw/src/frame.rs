//! The shared parts of pictures of sections and of maps: the framed window with its axes, the colour bar, the
//! key, the document.

use super::palette::{Bands, Colour, hex};
use super::scale;
use base64::Engine;
use maud::{Markup, PreEscaped, Render, html};

/// Lines take the colour of the text around them, so that they show on dark ground too; those on the body are
/// dark.
const STYLE: &str = ".section text{font:15px \"DejaVu Sans\",system-ui,sans-serif;fill:currentColor}.section .title{font-size:16px}\
.section .line{fill:none;stroke:currentColor;stroke-width:1}.section .thin{fill:none;stroke:#26303a;stroke-width:.5;opacity:.6}\
.section .grid{stroke:currentColor;stroke-width:.5;opacity:.2}.section .tool{fill:#8b95a1}.section .on-tool{fill:#fff}\
.section .area{fill:#0072b2;fill-opacity:.35;stroke:#0072b2;stroke-width:1.5}";

/// Room left of a window, for the numbers of the vertical axis.
pub const ROOM_LEFT: f64 = 64.0;
/// Left end of headings above a window.
pub const HEADS: f64 = 8.0;
/// Room right of it, for the colour bar.
pub const ROOM_RIGHT: f64 = 88.0;

/// A number of a drawing, to a hundredth.
pub struct Short(pub f64);

impl Render for Short {
    fn render_to(&self, buffer: &mut String) {
        let text = format!("{:.2}", self.0);
        buffer.push_str(text.trim_end_matches('0').trim_end_matches('.'));
    }
}

/// A PNG inside a document.
pub fn data_uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(png))
}

/// A drawing of `size` with a title over it.
pub fn document(size: [f64; 2], title: &str, body: &Markup) -> String {
    let [width, height] = size.map(Short);
    let markup = html! {
        svg xmlns="http://www.w3.org/2000/svg" class="section" viewBox={ "0 0 " (width) " " (height) }
            width=(width) height=(height) role="img" aria-label=(title) {
            style { (PreEscaped(STYLE)) }
            @if !title.is_empty() { text class="title" x=(Short(HEADS)) y="18" { (title) } }
            (body)
        }
    };
    markup.into_string()
}

/// A window on paper: the rectangle from `low` to `high` of a plane, in µm, at one scale in both directions.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Upper end on paper; its left end is at [`ROOM_LEFT`].
    pub top: f64,
    /// Width and height on paper.
    pub size: [f64; 2],
    /// Left and lower end of the plane.
    pub low: [f64; 2],
    /// Right and upper end of the plane.
    pub high: [f64; 2],
}

impl Frame {
    /// The window at `top` with a side of `length` on paper along x.
    pub fn new(top: f64, length: f64, low: [f64; 2], high: [f64; 2]) -> Frame {
        Frame { top, size: [length, length * (high[1] - low[1]) / (high[0] - low[0])], low, high }
    }

    /// Lower end on paper.
    pub fn bottom(&self) -> f64 {
        self.top + self.size[1]
    }

    /// The place of `x` on paper.
    pub fn x(&self, x: f64) -> f64 {
        ROOM_LEFT + (x - self.low[0]) / (self.high[0] - self.low[0]) * self.size[0]
    }

    /// The place of `y` on paper.
    pub fn y(&self, y: f64) -> f64 {
        self.top + (self.high[1] - y) / (self.high[1] - self.low[1]) * self.size[1]
    }

    /// A PNG that fills the window.
    pub fn image(&self, png: &[u8]) -> Markup {
        html! {
            image href=(data_uri(png)) x=(Short(ROOM_LEFT)) y=(Short(self.top)) width=(Short(self.size[0]))
                height=(Short(self.size[1])) preserveAspectRatio="none" {}
        }
    }

    /// `content` cut off at the window.
    pub fn cut(&self, content: &Markup) -> Markup {
        let [left, top, width, height] = [ROOM_LEFT, self.top, self.size[0], self.size[1]].map(Short);
        html! {
            svg x=(left) y=(top) width=(width) height=(height)
                viewBox={ (left) " " (top) " " (width) " " (height) } { (content) }
        }
    }

    /// The frame with ticks; distances from the axis have no sign. Numbers and name of the horizontal axis
    /// only on the lowest of several windows.
    pub fn axes(&self, names: [&str; 2], lowest: bool) -> Markup {
        let span = [0, 1].map(|k| self.high[k] - self.low[k]);
        let most = [(self.size[0] / 70.0).clamp(2.0, 8.0), (self.size[1] / 34.0).clamp(2.0, 8.0)];
        let [step_x, step_y] = [0, 1].map(|k| scale::round_step(span[k], most[k]));
        let (bottom, middle) =
            (self.bottom(), [ROOM_LEFT + 0.5 * self.size[0], self.top + 0.5 * self.size[1]]);
        html! {
            rect class="line" x=(Short(ROOM_LEFT)) y=(Short(self.top)) width=(Short(self.size[0])) height=(Short(self.size[1])) {}
            @for value in scale::multiples(self.low[1], self.high[1], step_y) {
                (tick(self.y(value), &scale::label(value, step_y)))
            }
            text transform={ "translate(14 " (Short(middle[1])) ") rotate(-90)" } text-anchor="middle" { (names[1]) }
            @for value in scale::multiples(self.low[0], self.high[0], step_x) {
                @let x = Short(self.x(value));
                path class="line" d={ "M" (x) " " (Short(bottom)) "v5" } {}
                @if lowest { text x=(x) y=(Short(bottom + 19.0)) text-anchor="middle" { (scale::label(value.abs(), step_x)) } }
            }
            @if lowest { text x=(Short(middle[0])) y=(Short(bottom + 37.0)) text-anchor="middle" { (names[0]) } }
        }
    }

    /// The colour bar beside the window, at least `least` high.
    pub fn bar(&self, bands: &Bands, least: f64) -> Markup {
        let (x, height) = (ROOM_LEFT + self.size[0] + 14.0, self.size[1].max(least));
        let y = |share: f64| self.top + height * (1.0 - share);
        let count = bands.colours.len() as f64;
        // numbers closer than a line of text are left out
        let sparse = ((bands.labels.len() as f64 * 17.0 / height).ceil() as usize).max(1);
        html! {
            @for (i, colour) in bands.colours.iter().enumerate() {
                rect x=(Short(x)) y=(Short(y((i as f64 + 1.0) / count))) width="16" height=(Short(height / count + 0.3)) fill=(hex(*colour)) {}
            }
            rect class="line" x=(Short(x)) y=(Short(self.top)) width="16" height=(Short(height)) {}
            @for (share, label) in bands.labels.iter().step_by(sparse) {
                path class="line" d={ "M" (Short(x + 16.0)) " " (Short(y(*share))) "h4" } {}
                text x=(Short(x + 23.0)) y=(Short(y(*share) + 5.0)) { (label) }
            }
        }
    }
}

/// A tick of the vertical axis with its number.
pub fn tick(y: f64, label: &str) -> Markup {
    html! {
        path class="line" d={ "M" (Short(ROOM_LEFT - 5.0)) " " (Short(y)) "h5" } {}
        text x=(Short(ROOM_LEFT - 8.0)) y=(Short(y + 5.0)) text-anchor="end" { (label) }
    }
}

/// Height of a row of [`boxes`].
const ROW: f64 = 24.0;

/// Boxes of colour, each with its name, in rows from (`HEADS`, `y`) to `width` at most, and the height of the
/// rows.
pub fn boxes(y: f64, width: f64, entries: &[(Colour, String)]) -> (Markup, f64) {
    let mut next = [HEADS, y];
    let mut places = Vec::new();
    for (_, name) in entries {
        // room by the number of letters
        let room = 36.0 + 8.8 * name.chars().count() as f64;
        if next[0] > HEADS && next[0] + room > width {
            next = [HEADS, next[1] + ROW];
        }
        places.push(next);
        next[0] += room;
    }
    let height = places.last().map_or(0.0, |last| last[1] + ROW - y);
    let drawn = html! {
        @for ([x, y], (colour, name)) in places.into_iter().zip(entries) {
            rect x=(Short(x)) y=(Short(y)) width="14" height="14" fill=(hex(*colour)) stroke="currentColor" stroke-width=".5" {}
            text x=(Short(x + 20.0)) y=(Short(y + 12.5)) { (name) }
        }
    };
    (drawn, height)
}
