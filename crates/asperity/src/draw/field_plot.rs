//! Pictures of the deformed section: fields as filled contours, with the tool, axes in µm and a colour bar.
//!
//! A picture is an SVG document of panels one below the other. Lines and letters are SVG; the contours of a panel are
//! a small indexed PNG inside it, one colour a band, transparent outside the metal.

mod deformed_mesh;
mod palette;
mod panel;
mod raster;
mod window;

use crate::units::{MEGAPASCAL, MICROMETRE};
use asperity_solver::run::crush::FieldFrame;
use asperity_solver::scene::{Scene, Symmetry, ToolForm};
use deformed_mesh::Metal;
use maud::{Markup, PreEscaped, Render, html};
use panel::Layout;
use raster::Raster;
pub use window::Reach;
use window::{Row, Window};

/// One drawing of the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Panel {
    /// The pressure of the tool along the surface, as a curve.
    ContactPressure,
    /// Von Mises stress.
    VonMises,
    /// Accumulated plastic strain; what never yielded is pale.
    PlasticStrain,
    /// Hydrostatic pressure, tension below 0.
    Pressure,
    /// What never yielded, what yielded once and is elastic now, what flows; and the line of the first yield stress.
    ElasticZones,
    /// The elements.
    Mesh,
}

impl Panel {
    /// What `asperity crush` draws of the peak.
    pub const PEAK: [Panel; 4] =
        [Panel::ContactPressure, Panel::VonMises, Panel::PlasticStrain, Panel::Pressure];
    /// Fig. 5 of the paper.
    pub const FIG5: [Panel; 2] = [Panel::ElasticZones, Panel::Pressure];
}

/// The tool and the metal of one converged state, ready to be drawn. Lengths in µm, stresses in MPa.
pub struct Section {
    metal: Metal,
    window: Window,
    tool: ToolForm,
    /// Height of the tool's lowest point; `None` if nothing touches it.
    tip: Option<f64>,
    /// Whether the other half of a body of revolution is drawn too.
    mirrored: bool,
    revolved: bool,
    /// First yield stress.
    yield_stress: Option<f64>,
}

impl Section {
    /// The section of `frame`, a state of `scene`, as far as `reach` says.
    ///
    /// # Errors
    /// A text for a person where the scene's tool is none.
    pub fn new(frame: &FieldFrame, scene: &Scene, reach: Reach) -> Result<Section, String> {
        let metal = Metal::new(frame);
        let revolved = scene.symmetry == Symmetry::Axisymmetric;
        let mirrored = revolved && scene.asperity.len() < 2;
        let tool = scene.tool.form().map_err(|e| e.to_string())?;
        let profile = panel::profile(&tool);
        let tips = metal.pressed().map(|[r, z]| z - profile(r));
        let tip = tips.fold(None, |most: Option<f64>, z| Some(most.map_or(z, |m| m.max(z))));
        let heights = scene.asperity.iter().filter_map(|a| a.form().ok());
        let height = heights.map(|form| form.height() / MICROMETRE).fold(0.0, f64::max);
        let row = Row { feet: metal.feet(height), height, count: scene.asperity.len() };
        let window = Window::around(&metal, mirrored, revolved, reach, &row);
        let yield_stress = scene.material.yield_stress.map(|s| s.0 / MEGAPASCAL);
        Ok(Section { metal, window, tool, tip, mirrored, revolved, yield_stress })
    }

    /// The panels as an SVG document.
    ///
    /// # Errors
    /// A text for a person where a picture cannot be encoded.
    pub fn svg(&self, panels: &[Panel], title: &str) -> Result<String, String> {
        let layout = Layout::new(&self.window);
        let raster = Raster::of(&self.metal, &self.window, self.mirrored, layout.dots());
        let mut top = layout.title_height();
        let mut parts: Vec<Markup> = Vec::new();
        for (i, &kind) in panels.iter().enumerate() {
            let last = i + 1 == panels.len();
            let (drawing, height) = self.panel(kind, &layout, &raster, last)?;
            parts.push(html! { g transform={ "translate(0 " (Short(top)) ")" } { (drawing) } });
            top += height;
        }
        let (width, height) = (layout.width(), top);
        let style = PreEscaped(panel::STYLE);
        let markup = html! {
            svg xmlns="http://www.w3.org/2000/svg" class="section" viewBox={ "0 0 " (Short(width)) " " (Short(height)) }
                width=(Short(width)) height=(Short(height)) role="img" aria-label=(title) {
                style { (style) }
                @if !title.is_empty() { text class="title" x=(Short(layout.left())) y="18" { (title) } }
                @for part in &parts { (part) }
            }
        };
        Ok(markup.into_string())
    }
}

/// A number of a drawing, to a hundredth.
struct Short(f64);

impl Render for Short {
    fn render_to(&self, buffer: &mut String) {
        let text = format!("{:.2}", self.0);
        buffer.push_str(text.trim_end_matches('0').trim_end_matches('.'));
    }
}

#[cfg(test)]
mod tests;
