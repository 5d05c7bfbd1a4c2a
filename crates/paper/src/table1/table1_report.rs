//! `report.html` of the whole table.

use super::{ComparedRow, HARDNESS, MODULUS, NOMINAL, POISSON, SEEDS, Seeds, Table1, trends};
use asperity::draw::chart::{Chart, Series};
use asperity::error::Error;
use asperity::page::{self, Report};
use asperity::roughness::Closure;
use maud::{Markup, html};

impl Table1 {
    /// The table as one page that stands alone: whether the paper's trends hold, every surface with every
    /// closure beside the printed row, and where that row contradicts itself.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn report(&self) -> Result<String, Error> {
        let seen = "Mean contact pressure of every closure on the three surfaces, and as printed";
        let sections = html! {
            h2 { "Trends from ground to sanded" }
            (self.trends())
            h2 { "Curves" }
            (page::chart(&self.chart(), seen, &format!("{seen}."))?)
            @for row in &self.rows {
                h2 { "The surface " (row.surface.name()) }
                (surface(row))
                p { "Of this row: " (row.against_itself) "." }
            }
        };
        let warnings: Vec<String> = self.rows.iter().flat_map(|row| row.notes.clone()).collect();
        let report = Report {
            title: "The paper's Table 1, computed again",
            about: &format!(
                "Steel of E {MODULUS} MPa, ν {POISSON}, H {HARDNESS} MPa under {NOMINAL} MPa; {SEEDS} generated surfaces a row, 1024 × 1024 \
                 points of 1.953 µm"
            ),
            verdict: &self.finding(),
            warnings: &warnings,
            sections,
            inputs: &[("All values, surface by surface", self.json()?)],
        };
        Ok(report.html())
    }

    fn finding(&self) -> String {
        let found = trends(&self.rows);
        let both = found.iter().filter(|(_, holds)| *holds == [true; 2]).count();
        format!(
            "From ground to sanded the paper's contact area falls and its pressure rises: so it is with {both} of {} closures. The printed \
             numbers of each row contradict each other, as stated below it.",
            found.len()
        )
    }

    fn trends(&self) -> Markup {
        let say = |ok: bool| html! { @if ok { "holds" } @else { "does not hold" } };
        let found = trends(&self.rows);
        let row = |(closure, holds): &(Closure, [bool; 2])| {
            vec![html! { (closure.name()) }, say(holds[0]), say(holds[1])]
        };
        let rows: Vec<_> = found.iter().map(row).collect();
        page::table(
            "What the paper's rows show, closure by closure.",
            &["closure", "area falls", "pressure rises"],
            &rows,
        )
    }

    /// Mean pressure against the slope of the surface.
    fn chart(&self) -> Chart {
        let printed = self.rows.iter().map(|row| [row.paper.beta, row.paper.pressure]).collect();
        let mut series = vec![Series::line("as printed", printed).marked()];
        for (closure, _) in trends(&self.rows) {
            let point = |row: &ComparedRow| {
                let found = row.closures.iter().find(|one| one.closure == closure)?;
                Some([row.paper.beta, found.pressure.mean()])
            };
            let points = self.rows.iter().filter_map(point).collect();
            series.push(Series::of_closure(closure, false, points).marked());
        }
        Chart::new("slope of the surface (degrees)", "mean contact pressure (MPa)", series)
    }
}

/// The printed row and those of all closures.
fn surface(row: &ComparedRow) -> Markup {
    let paper = &row.paper;
    let head =
        ["", "P_m, MPa", "A_r, %", "ψ", "peak over nominal", "residual displacement, µm", "work returned, %"];
    let mut rows = vec![vec![
        html! { "paper" },
        html! { (paper.pressure) },
        html! { (paper.area) },
        html! { (paper.index) },
        html! { (paper.peak) },
        html! { "–" },
        html! { "–" },
    ]];
    let cell = |seeds: &Seeds, digits| html! { (seeds.text(digits)) };
    rows.extend(row.closures.iter().map(|one| {
        vec![
            html! { (one.closure.name()) },
            cell(&one.pressure, 0),
            cell(&one.area, 2),
            cell(&one.index, 3),
            cell(&one.peak, 1),
            cell(&one.residual, 2),
            cell(&one.elastic, 1),
        ]
    }));
    let caption = format!(
        "Ra {} µm, mean slope {}°: as printed, and mean ± standard deviation of {SEEDS} surfaces.",
        paper.ra, paper.beta
    );
    page::table(&caption, &head, &rows)
}

#[cfg(test)]
mod tests {
    use super::super::{ClosureSeeds, TABLE, contradictions};
    use super::*;

    #[test]
    fn the_page_says_which_trends_hold() {
        let table = TABLE;
        let rows = table.iter().enumerate().map(|(i, (surface, paper))| {
            let mut one = ClosureSeeds::new(Closure::Published);
            one.pressure = Seeds(vec![100.0, 102.0 + i as f64]);
            one.area = Seeds(vec![20.0 - i as f64]);
            let (paper, against_itself) = (paper.clone(), contradictions(paper));
            ComparedRow { surface: *surface, paper, closures: vec![one], notes: Vec::new(), against_itself }
        });
        let page = Table1 { rows: rows.collect() }.report().unwrap();
        assert!(page.contains("with 1 of 1 closures") && page.matches("<table").count() == 4);
        assert!(page.contains("101 ± 1") && page.contains("75683") && page.contains("class=\"chart\""));
    }
}
