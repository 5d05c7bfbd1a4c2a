//! `report.html` of a sweep.

use super::calibration::Calibration;
use crate::error::Error;
use crate::page::{self, Numbers, Report};
use crate::results::numbers::{rounded, significant};
use maud::{Markup, html};

impl Calibration {
    /// The sweep as one page that stands alone: the coefficient with its intervals, every slope, the curves
    /// made one, what failed.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn report(&self) -> Result<String, Error> {
        let charts = if self.whole { self.charts() } else { Vec::new() };
        let charts = charts.iter().map(|(_, chart, seen)| page::chart(chart, seen, &format!("{seen}.")));
        let charts = charts.collect::<Result<Vec<Markup>, Error>>()?;
        let numbers = Numbers::from_summary(&self.fit)?;
        let sections = html! {
            h2 { "Numbers" }
            (coefficients(&numbers))
            @if self.whole && !self.fit.per_angle.is_empty() {
                h2 { "Every slope" }
                (self.slopes(&numbers))
            }
            @if !charts.is_empty() { h2 { "Curves" } }
            @for chart in &charts { (chart) }
            h2 { "How it was computed" }
            p {
                (self.cases.len()) " cones at accuracy " (self.sweep.accuracy) ", hardening law "
                (self.sweep.hardening_law.name()) ", " (significant(self.wall_s)) " s; K is exact to "
                (rounded(100.0 * self.worst())) " % or better in each."
            }
        };
        let failed = self.cases.iter().filter(|row| row.K_over_E.is_none()).map(|row| row.line());
        let warnings: Vec<String> = failed.map(|line| format!("no result: {line}")).collect();
        let report = Report {
            title: "A sweep of cones",
            about: &format!("{} cones crushed; accuracy {}", self.cases.len(), self.sweep.accuracy),
            verdict: &self.finding(),
            warnings: &warnings,
            sections,
            inputs: &[("The sweep", crate::results::output::json(&self.sweep)?)],
        };
        Ok(report.html())
    }

    /// Largest error of a K, relative.
    pub(super) fn worst(&self) -> f64 {
        self.cases.iter().filter_map(|r| r.K_error).fold(0.0, f64::max)
    }

    fn finding(&self) -> String {
        if !self.whole {
            return format!(
                "A part of a sweep, {} of its cases: join the parts to fit them.",
                self.cases.len()
            );
        }
        let fit = &self.fit;
        let (Some(c), Some(ci95), Some(model)) = (fit.coefficient, fit.ci95, fit.model_interval) else {
            let reason = fit.reason.as_deref().unwrap_or_default();
            return format!("No representative strain: {reason}.");
        };
        let within = |[low, high]: [f64; 2]| format!("{low:.4} to {high:.4}");
        let side = if (model[0]..=model[1]).contains(&fit.published) { "inside" } else { "outside" };
        format!(
            "The representative strain is {c:.4} tan β: {} by the arithmetic (95 %), {} by the choice of metals and slopes; the \
             published {} lies {side} of that.",
            within(ci95),
            within(model),
            fit.published
        )
    }

    fn slopes(&self, numbers: &Numbers) -> Markup {
        let row = |(i, angle): (usize, &super::AngleFit)| {
            let at =
                |key: &str, scale: f64, unit| numbers.shown(&format!("/per_angle/{i}/{key}"), scale, unit);
            vec![
                html! { (angle.beta_deg) "°" },
                at("representative_strain", 100.0, " %"),
                html! { (at("low", 100.0, "")) " … " (at("high", 100.0, " %")) },
                at("scatter", 100.0, " %"),
                html! { (angle.cases) },
            ]
        };
        let rows: Vec<_> = self.fit.per_angle.iter().enumerate().map(row).collect();
        let head = ["slope", "representative strain", "95 % interval", "scatter left", "cases"];
        page::table("The strain at which the curves of all exponents mix best, slope by slope.", &head, &rows)
    }
}

fn coefficients(numbers: &Numbers) -> Markup {
    let one = |name: &str, place: &str, ends: Option<&str>| {
        let ends = ends.map(|at| [0, 1].map(|i| numbers.shown(&format!("{at}/{i}"), 1.0, "")));
        let interval = ends.map_or_else(Markup::default, |[low, high]| html! { (low) " … " (high) });
        vec![html! { (name) }, numbers.shown(place, 1.0, ""), interval]
    };
    let mut rows = vec![
        one("c by least squares; other cases drawn, K shifted by its error", "/coefficient", Some("/ci95")),
        one("the same; over parts of the metals and slopes", "/coefficient", Some("/model_interval")),
        one("c as the mean of εᵣ/tan β", "/coefficient_mean_ratio", None),
        one("c where plasticity is developed", "/developed/coefficient", Some("/developed/ci95")),
        one("c as published", "/published", None),
        one("exponent of unloading", "/unloading_exponent", None),
    ];
    rows.retain(|row| row[1].0 != "–");
    page::table("c of the representative strain εᵣ = c tan β.", &["quantity", "value", "interval"], &rows)
}
