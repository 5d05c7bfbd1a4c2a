//! `report.html` of an identification.

use super::pictures::stress_strain;
use super::result::Identification;
use crate::error::Error;
use crate::page::{self, Numbers, Report};
use crate::results::numbers::significant;
use asperity_identification::numbers::{CurveResidual, Found};
use maud::html;

impl Identification {
    /// The identification as one page that stands alone: the verdict, every number with its interval,
    /// measured points and fit, the stress-strain curve with its band.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn report(&self) -> Result<String, Error> {
        let numbers = Numbers::from_summary(self)?;
        let parameter = |(name, found): (&String, &Found)| {
            let at = |key: &str| numbers.shown(&format!("/parameters/{name}/{key}"), 1.0, "");
            let unit = if found.unit.is_empty() { String::new() } else { format!(" {}", found.unit) };
            let told = if found.identifiable { "yes" } else { "no" };
            vec![
                html! { (name) },
                html! { (at("value")) (unit) },
                html! { (at("low")) " … " (at("high")) (unit) },
                html! { (told) },
            ]
        };
        let parameters: Vec<_> = self.parameters.iter().map(parameter).collect();
        let residual = |(i, curve): (usize, &CurveResidual)| {
            let at = |key: &str| numbers.error(&format!("/residual/curves/{i}/{key}"), "");
            vec![html! { (curve.name) }, at("rms"), at("noise")]
        };
        let residuals: Vec<_> = self.residual.curves.iter().enumerate().map(residual).collect();
        let stress = stress_strain(&self.stress_strain);
        let sections = html! {
            h2 { "Numbers" }
            (page::table(
                "What was sought, with 95 % intervals by the fit (how often they held for known metals: page Metals found again of the book).",
                &["quantity", "value", "95 % interval", "identifiable"],
                &parameters,
            ))
            @if !self.decided.is_empty() {
                (page::table(
                    "How much wider each interval would be without one of the measurements.",
                    &["left out", "intervals wider by a factor of"],
                    &self.decided.iter().map(|d| {
                        let factors = d.widening.iter().map(|(name, by)| format!("{name} {}", significant(*by)));
                        vec![html! { (d.measurement) }, html! { (factors.collect::<Vec<_>>().join(", ")) }]
                    }).collect::<Vec<_>>(),
                ))
            }
            h2 { "Curves" }
            @if let Some(forces) = self.drawn.forces() {
                (page::chart(&forces, "Measured points of force over depth, and the fit through them.", "Measured points and the fit.")?)
            }
            @if let Some(imprints) = self.drawn.imprints() {
                (page::chart(&imprints, "Heights of the imprint over the distance from the axis, measured and fitted.", "The imprint and the surface that finite elements leave.")?)
            }
            (page::chart(&self.drawn.left(), "Residuals of the fit.", "Measured less fitted force; of unloading the depth over the deepest.")?)
            (page::chart(&stress, "Stress over plastic strain with the band of its error.", "The stress-strain curve with its 95 % band.")?)
            @if let Some(svg) = self.objective_svg()? {
                (page::drawing(&svg, "Map of the sum of squares over two unknowns.", "The sum of squares over the two unknowns that are determined worst: along a long valley the measurements do not distinguish."))
            }
            h2 { "Residuals" }
            (page::table("Root mean square of the differences to the fit, and the noise that was counted with.", &["measurement", "left", "noise"], &residuals))
            p {
                "Sum of squares " (numbers.shown("/residual/chi2", 1.0, "")) " with " (self.residual.degrees_of_freedom)
                " degrees of freedom; " (self.runs) " runs of finite elements, " (significant(self.wall_s)) " s."
            }
        };
        let report = Report {
            title: "A metal identified",
            about: "From measured indentation curves by finite elements",
            verdict: &format!("{}.", self.verdict),
            warnings: &self.notes,
            sections,
            inputs: &[],
        };
        Ok(report.html())
    }
}
