//! `report.html` of what the coefficient depends on.

use super::{Sensitivity, SensitivityLine, published};
use asperity::calibration::fit::DEVELOPED_PLASTICITY;
use asperity::error::Error;
use asperity::page::{self, Report};
use maud::{Markup, html};

impl Sensitivity {
    /// The dependence of c as one page that stands alone: its range over all parts of the grid, then every
    /// part.
    ///
    /// # Errors
    /// Lines that JSON cannot hold.
    pub fn report(&self) -> Result<String, Error> {
        let cases: usize = self.sweeps.iter().map(|(_, rows)| rows.len()).sum();
        let kinds = self.lines.chunk_by(|a, b| (&a.tool, a.hardening_law) == (&b.tool, b.hardening_law));
        let sections = html! { @for lines in kinds { (kind(lines)) } p { (published()) "." } };
        let report = Report {
            title: "What the coefficient depends on",
            about: &format!("c of the representative strain εᵣ = c tan β, fitted to parts of {cases} cases"),
            verdict: &self.finding(),
            warnings: &[],
            sections,
            inputs: &[("All values", self.json()?)],
        };
        Ok(report.html())
    }

    fn finding(&self) -> String {
        let found = self.lines.iter().filter_map(|line| line.c);
        let (low, high) = found.fold((f64::INFINITY, 0.0_f64), |(l, h), c| (l.min(c), h.max(c)));
        if low > high {
            return "No part of the grid determines c.".into();
        }
        let known = self.lines.iter().filter(|line| line.c.is_some()).count();
        format!(
            "c is {low:.3} to {high:.3}, by the tool, the hardening law and the range of metals: a coefficient is one of its range. {known} of \
             {} parts of the grid determine it.",
            self.lines.len()
        )
    }
}

/// The parts of one tool and one hardening law.
fn kind(lines: &[SensitivityLine]) -> Markup {
    let Some(first) = lines.first() else { return Markup::default() };
    let law = first.hardening_law.name();
    let row = |line: &SensitivityLine| {
        let [all, developed] = line.coefficients().map(|c| match c {
            Some([c, low, high]) => format!("{c:.3} ({low:.3} … {high:.3})"),
            None => "–".into(),
        });
        let ratios = format!("{} … {}", line.E_over_sy_least, line.E_over_sy_largest);
        let exponents = format!("{} … {}", line.n_least, line.n_largest);
        vec![html! { "n " (exponents) }, html! { (ratios) }, html! { (all) }, html! { (developed) }]
    };
    let rows: Vec<_> = lines.iter().map(row).collect();
    let developed = format!("c where E* tan β/σᵣ ≥ {DEVELOPED_PLASTICITY}");
    let caption =
        format!("{}, law {law}: c with its 95 % interval; a dash where it is not determined.", first.tool);
    html! {
        h2 { (first.tool) ", " (law) }
        (page::table(&caption, &["hardening exponents", "E/σ_y", "c of all cases", &developed], &rows))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::material::HardeningLaw;

    #[test]
    fn the_page_gives_the_range_of_c_and_says_what_is_not_determined() {
        let line = |tool: &str, c: Option<f64>| SensitivityLine {
            tool: tool.into(),
            hardening_law: HardeningLaw::Hollomon,
            n_least: 0.1,
            n_largest: 0.5,
            E_over_sy_least: 100.0,
            E_over_sy_largest: 350.0,
            c,
            low: c.map(|c| c - 0.01),
            high: c.map(|c| c + 0.01),
            c_developed: None,
            low_developed: None,
            high_developed: None,
        };
        let lines = vec![line("crush", Some(0.12)), line("crush", None), line("indentation", Some(0.2))];
        let found = Sensitivity { lines, published: 0.13, sweeps: Vec::new(), journals: Vec::new() };
        let page = found.report().unwrap();
        assert!(page.contains("c is 0.120 to 0.200") && page.contains("2 of 3 parts"));
        assert!(page.contains("0.120 (0.110 … 0.130)") && page.matches("<table").count() == 2);
    }
}
