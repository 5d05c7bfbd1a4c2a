//! `report.html` of an identification.

use super::pictures::stress_strain;
use super::result::Identification;
use crate::error::Error;
use crate::page::{self, Numbers, Report};
use crate::results::numbers::significant;
use asperity_identification::identifiability::Decided;
use asperity_identification::numbers::{CurveResidual, Found};
use asperity_material::units::rounded;
use maud::{Markup, html};

/// Plastic strains at which the report tells the stress.
const STRAINS: [f64; 3] = [0.02, 0.05, 0.1];

/// The key of a quantity in words.
fn in_words(key: &str) -> String {
    key.replace('_', " ").replace("youngs", "Young's")
}

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
            let unit = if found.unit.is_empty() { String::new() } else { format!(", {}", found.unit) };
            let told = match (found.identifiable, found.at_bound.contains(&true)) {
                (true, _) => "yes",
                (false, true) => "no, a bound of the search cuts its interval",
                (false, false) => "no",
            };
            vec![
                html! { (in_words(name)) (unit) },
                at("value"),
                self.interval(html! { (at("low")) " to " (at("high")) }),
                html! { (told) },
            ]
        };
        let parameters: Vec<_> = self.parameters.iter().map(parameter).collect();
        let caption = if self.residual.fits {
            "What was sought, with 95 % intervals by the fit. How often they held for known metals: \"Identified metals\", a page of the book."
        } else {
            "No metal explains the measurements: these are the nearest values, and they have no intervals."
        };
        let stress = stress_strain(&self.stress_strain, self.residual.fits);
        let band = "Where the fit is right, 95 % of the residuals lie in the pale band: noise and errors of the finite elements together.";
        let sections = html! {
            h2 { "Numbers" }
            (page::table(caption, &["quantity", "value", "95 % interval", "identifiable"], &parameters))
            (self.stresses(&numbers))
            @if self.residual.fits { (self.decisions()) }
            h2 { "Curves" }
            @if let Some(forces) = self.drawn.forces() {
                (page::chart(&forces, "Measured points of force over depth, and the fit through them.", "Measured points and the fit.")?)
            }
            @if let Some(imprints) = self.drawn.imprints() {
                (page::chart(&imprints, "Heights of the imprint over the distance from the axis, measured and fitted.", "The imprint and the surface that finite elements leave.")?)
            }
            @let left = self.drawn.left();
            @if !left.is_empty() {
                (page::chart(&left, "Residuals of the curves and features.", &format!("Measured less fitted force; of unloading the depth over the deepest. {band}"))?)
            }
            @if let Some(left) = self.drawn.imprints_left() {
                (page::chart(&left, "Residuals of the imprint.", &format!("Measured less fitted height, over the deepest depth. {band}"))?)
            }
            (page::chart(&stress, "Stress over plastic strain.", &stress.title)?)
            @if let (true, Some(svg)) = (self.residual.fits, self.objective_svg()?) {
                (page::drawing(&svg, "Map of the sum of squares over two unknowns.", "The sum of squares over the two unknowns that are determined worst: along a long valley the measurements do not distinguish."))
            }
            h2 { "Residuals" }
            (self.residuals(&numbers))
            (self.sums(&numbers))
            @if !self.understood.is_empty() {
                h2 { "Files as they were read" }
                ul { @for line in &self.understood { li { (line) } } }
            }
        };
        let report = Report {
            title: if self.residual.fits { "A metal identified" } else { "No metal fits" },
            about: "From measured force curves, by finite elements",
            verdict: &format!("{}.", self.verdict),
            warnings: &self.notes,
            sections,
            inputs: &[("The fit, to identify the metal again", self.asked.clone())],
        };
        Ok(report.html())
    }

    /// An interval as it is shown: none where no metal fits.
    fn interval(&self, shown: Markup) -> Markup {
        if self.residual.fits {
            shown
        } else {
            html! { "–" }
        }
    }

    /// Stresses of the curve at a few strains, and the one that is determined best.
    fn stresses(&self, numbers: &Numbers) -> Markup {
        let row = |at: String, place: String| {
            let shown = |key: &str| numbers.shown(&format!("{place}/{key}"), 1.0, "");
            let interval = self.interval(html! { (shown("low_MPa")) " to " (shown("high_MPa")) });
            vec![html! { (at) }, shown("value_MPa"), interval]
        };
        let percent = |strain: f64| format!("{} %", rounded(100.0 * strain, 3));
        let best = self.representative.as_ref();
        let best = best.map(|s| {
            row(format!("{}, determined best", percent(s.plastic_strain)), "/representative".into())
        });
        let curve = self.stress_strain.iter().enumerate();
        let told =
            curve.filter(|(_, s)| STRAINS.iter().any(|strain| (s.plastic_strain - strain).abs() < 1e-9));
        let told = told.map(|(i, s)| row(percent(s.plastic_strain), format!("/stress_strain/{i}")));
        let rows: Vec<_> = best.into_iter().chain(told).collect();
        page::table("Yield stress, MPa", &["plastic strain", "stress", "95 % interval"], &rows)
    }

    /// Sums of squares of all measurements, and what one metal for all of them adds.
    fn sums(&self, numbers: &Numbers) -> Markup {
        html! {
            p {
                "All together: χ² " (numbers.shown("/residual/chi2", 1.0, "")) " of at most "
                (numbers.shown("/residual/chi2_limit", 1.0, "")) ", with " (self.residual.degrees_of_freedom)
                " degrees of freedom; " (self.runs) " runs of finite elements, " (significant(self.wall_s)) " s."
            }
            @for (i, accord) in self.residual.accords.iter().enumerate() {
                p {
                    "One metal for " (accord.measurement) " and the other measurements: χ² grows by "
                    (numbers.shown(&format!("/residual/accords/{i}/growth"), 1.0, "")) " of at most "
                    (numbers.shown(&format!("/residual/accords/{i}/growth_limit"), 1.0, "")) "."
                }
            }
        }
    }

    /// Widening of the intervals without each of several measurements.
    fn decisions(&self) -> Markup {
        let row = |measurement: &String, (name, by): (&String, &f64)| {
            vec![html! { (measurement) }, html! { (in_words(name)) }, html! { (significant(*by)) }]
        };
        let of_one = |d: &Decided| d.widening.iter().map(|w| row(&d.measurement, w)).collect::<Vec<_>>();
        let rows: Vec<_> = self.decided.iter().flat_map(of_one).collect();
        let caption = "How many times as wide each interval would be without one of the measurements.";
        html! {
            @if !rows.is_empty() { (page::table(caption, &["left out", "interval of", "times as wide"], &rows)) }
        }
    }

    /// Residuals of each measurement.
    fn residuals(&self, numbers: &Numbers) -> Markup {
        let row = |(i, curve): (usize, &CurveResidual)| {
            let place = |key: &str| format!("/residual/curves/{i}/{key}");
            let error = |key: &str| numbers.error(&place(key), "");
            let number = |key: &str| numbers.shown(&place(key), 1.0, "");
            vec![html! { (curve.name) }, error("rms"), error("noise"), number("chi2"), number("chi2_limit")]
        };
        let rows: Vec<_> = self.residual.curves.iter().enumerate().map(row).collect();
        let caption = "Root mean square (rms) of measured less fitted: of forces over the force, of heights over the depth; the noise that \
                       was stated or, where none was, taken from the scatter; χ², the sum of squares in standard deviations of noise and \
                       finite elements together, and the largest χ² that chance allows.";
        page::table(caption, &["measurement", "rms residual", "noise", "χ²", "largest χ²"], &rows)
    }
}
