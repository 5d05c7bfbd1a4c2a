//! `report.html` of a pressed surface.

use super::charts;
use super::summary::ClosureSummary;
use super::table::TableRow;
use crate::error::Error;
use crate::input::toml_file::to_toml;
use crate::page::{self, Numbers, Report};
use crate::results::numbers::significant;
use crate::rough::closure_contact::{Body, ClosureContact};
use crate::rough::contact::Rough;
use maud::{Markup, html};

/// No side of a map has more dots.
const MAX_SIDE_DOTS: usize = 800;

impl Rough {
    /// The contact as one page that stands alone: the verdict, every closure beside the others, load curves,
    /// maps.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn report(&self) -> Result<String, Error> {
        let s = &self.summary;
        let numbers = Numbers::from_summary(s)?;
        let charts = charts::all(&self.contacts, self.surface.parameters.mean_gradient);
        let charts = charts.map(|(_, chart)| page::chart(&chart, &chart.title, &format!("{}.", chart.title)));
        let charts = charts.collect::<Result<Vec<Markup>, Error>>()?;
        let sections = html! {
            h2 { "Every closure" }
            (self.closures(&numbers))
            h2 { "Curves" }
            @for chart in &charts { (chart) }
            h2 { "Maps" }
            div class="row" { @for map in &self.maps()? { (map) } }
            h2 { "The surface" }
            (surface(&numbers))
            p {
                (s.pixels[0]) " × " (s.pixels[1]) " points of " (significant(s.pixel_size_um[0])) " × "
                (significant(s.pixel_size_um[1])) " µm, " (s.missing) " of them not measured; pressed in " (significant(s.wall_s)) " s."
            }
        };
        let scene = to_toml(&s.scene).map_err(Error::Unfinished)?;
        let report = Report {
            title: &format!("The surface {} under a rigid plane", s.surface),
            about: "Contact of a rough surface by every closure that was asked for",
            verdict: &self.finding(),
            warnings: &s.warnings,
            sections,
            inputs: &[("The scene, to press it again", scene)],
        };
        Ok(report.html())
    }

    fn finding(&self) -> String {
        if let Some(verdict) = &self.summary.verdict {
            return verdict.clone();
        }
        let areas = self.table.iter().map(TableRow::best_area_ratio).filter(|a| a.is_finite());
        let (low, high) = areas.fold((f64::INFINITY, 0.0_f64), |(l, h), a| (l.min(a), h.max(a)));
        if low > high {
            return "No closure carries this load.".into();
        }
        let [low, high] = [low, high].map(|a| significant(100.0 * a));
        let range = if low == high { format!("on {low} %") } else { format!("on {low} to {high} %") };
        format!(
            "The closures put the true contact {range} of the area. None of them states its error: \
             the closure \"half-space\" on this surface would tell which to believe."
        )
    }

    fn closures(&self, numbers: &Numbers) -> Markup {
        let row = |(i, one): (usize, &ClosureSummary)| {
            let name = one.row.closure.name();
            if one.row.status != "ok" {
                return vec![html! { (name) }, html! { (one.row.status) }];
            }
            let at = |key: &str, scale: f64, unit: &str| {
                numbers.shown(&format!("/closures/{i}/{key}"), scale, unit)
            };
            let corrected = one.row.area_error.map_or_else(Markup::default, |_| {
                html! { (at("contact_area_ratio_corrected", 100.0, "")) " ± " (numbers.error(&format!("/closures/{i}/area_error"), "")) }
            });
            vec![
                html! { (name) },
                at("contact_area_ratio", 100.0, " %"),
                corrected,
                at("mean_pressure_MPa", 1.0, ""),
                at("plastic_share", 100.0, " %"),
                at("separation_um", 1.0, ""),
                at("max_pressure_over_nominal", 1.0, ""),
                at("area_over_half_space", 1.0, ""),
                at("pressure_over_half_space", 1.0, ""),
            ]
        };
        let rows: Vec<_> = self.summary.closures.iter().enumerate().map(row).collect();
        let head = [
            "closure",
            "contact of whole pixels",
            "true contact, corrected for pixels",
            "mean pressure on whole pixels, MPa",
            "plastic share of the contact",
            "separation, µm",
            "largest over nominal pressure",
            "area over half-space",
            "pressure over half-space",
        ];
        let caption = "Each closure at the load. The last columns, where they are there, tell how far it is from the half-space \
                       with the same metal: 1 is right.";
        page::table(caption, &head, &rows)
    }

    /// The topography, and the pressure by each closure.
    fn maps(&self) -> Result<Vec<Markup>, Error> {
        let map = |png: Result<Vec<u8>, String>, seen: &str| {
            png.map(|png| page::picture(&png, seen, seen)).map_err(Error::Unfinished)
        };
        let pressed = self.contacts.iter().filter(|one| !matches!(one.body, Body::Failed(_)));
        let pressure = |one: &ClosureContact| {
            let png = self.pressure_png(one, &self.layers(one), MAX_SIDE_DOTS);
            map(png, &format!("Map of the contact pressure by {}", one.name()))
        };
        std::iter::once(map(self.topography_png(MAX_SIDE_DOTS), "Map of the heights as pressed"))
            .chain(pressed.map(pressure))
            .collect()
    }
}

fn surface(numbers: &Numbers) -> Markup {
    let lines = [
        ("Sa, arithmetic mean height", "sa_um", " µm"),
        ("Sq, root mean square height", "sq_um", " µm"),
        ("Sz, highest less lowest", "sz_um", " µm"),
        ("Ssk, skewness", "ssk", ""),
        ("Sku, kurtosis", "sku", ""),
        ("Sdq, root mean square gradient", "sdq", ""),
        ("mean slope", "beta_deg", "°"),
    ];
    let row = |(name, key, unit): (&str, &str, &str)| {
        vec![html! { (name) }, numbers.shown(&format!("/{key}"), 1.0, unit)]
    };
    page::table("After levelling and filtering (ISO 25178-2).", &["parameter", "value"], &lines.map(row))
}
