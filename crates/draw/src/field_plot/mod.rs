//! Pictures of the deformed section: fields as filled contours, with the tool, axes in µm and a colour bar.
//!
//! A picture is an SVG document of panels one below the other. Lines and letters are SVG; the contours of a
//! panel are a small indexed PNG inside it, one colour a band, transparent outside the body.

mod deformed_mesh;
mod window;

mod raster;
mod section;

mod panel;

use crate::frame::{self, Frame, ROOM_LEFT, ROOM_RIGHT, Short};
use maud::{Markup, html};
use panel::HEADING;
pub use panel::Panel;
use raster::Raster;
pub use section::Section;
pub use window::Reach;

/// Width of the window on paper: the whole is so narrow that its letters stay legible on a phone.
const WIDTH: f64 = 408.0;
/// Dots of the contours for a unit of the drawing.
const DOTS_PER_UNIT: f64 = 3.0;
/// Room for the title.
const TITLE: f64 = 24.0;

impl Section {
    /// The panels as an SVG document.
    ///
    /// # Errors
    /// A text for a person where a picture cannot be encoded.
    pub fn svg(&self, panels: &[Panel], title: &str) -> Result<String, String> {
        let window = Frame::new(HEADING, WIDTH, self.window.low, self.window.high);
        let dots = window.size.map(|length| ((length * DOTS_PER_UNIT).round() as usize).max(1));
        let fields: Vec<_> = panels.iter().flat_map(|panel| panel.fields()).copied().collect();
        let raster = Raster::draw(&self.mesh, &self.window, self.mirrored, dots, &fields);
        let mut top = TITLE;
        let mut parts: Vec<Markup> = Vec::new();
        for (i, panel) in panels.iter().enumerate() {
            let (drawing, height) = panel.draw(self, &window, &raster, i + 1 == panels.len())?;
            parts.push(html! { g transform={ "translate(0 " (Short(top)) ")" } { (drawing) } });
            top += height;
        }
        let body = html! { @for part in &parts { (part) } };
        Ok(frame::document([ROOM_LEFT + WIDTH + ROOM_RIGHT, top], title, &body))
    }
}

#[cfg(test)]
mod tests;
