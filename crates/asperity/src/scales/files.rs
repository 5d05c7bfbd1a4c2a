//! The files of the scales: CSV, JSON, charts, the text and `report.html`.

use super::press_scales::Scales;
use crate::draw::chart::{Chart, svg};
use crate::draw::scale_charts::scale_charts;
use crate::error::Error;
use crate::input::toml_file::to_toml;
use crate::page::{self, Numbers, Report};
use crate::results::numbers::{rounded, with_digits};
use crate::results::output::{Sink, SinkExt, sorted_json, write_csv};
use asperity_roughness::read_as;
use maud::{Markup, html};
use std::fmt::Write;

impl Scales {
    /// Writes scales.csv, slopes.csv, spectrum.csv, summary.json and the charts.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        sink.write("scales.csv", |out| write_csv(out, &self.rows))?;
        sink.write("slopes.csv", |out| write_csv(out, &self.slopes))?;
        sink.write("spectrum.csv", |out| write_csv(out, &self.spectrum))?;
        for (name, chart) in scale_charts(&self.found) {
            sink.text(name, &svg(&chart).map_err(Error::Unfinished)?)?;
        }
        sink.text("summary.json", &self.json()?)
    }

    /// The text of summary.json.
    ///
    /// # Errors
    /// None that is known: every summary is JSON.
    pub fn json(&self) -> Result<String, Error> {
        sorted_json(&self.summary)
    }

    /// The result for a person: the half-spaces by scale, the verdicts, the sentence.
    pub fn text(&self) -> String {
        let mut text = read_as(&self.summary.understood);
        text += "cut-off um, rms slope, half-space: A/A0 %, mean MPa, 99 % MPa, gap um, leak x m3, load on plastic slopes %\n";
        let shown = |value: Option<f64>| value.map_or_else(|| "-".into(), |v| with_digits(v, 4));
        for row in self.rows.iter().filter(|row| row.mean_gap_um.is_some()) {
            let [cutoff, slope] = [row.cutoff_um, row.rms_slope].map(|v| with_digits(v, 4));
            let shares = [row.contact_area_ratio_corrected, row.plastic_share].map(|v| v.map(|v| 100.0 * v));
            let [area, plastic] = shares.map(shown);
            let numbers =
                [row.corrected_mean_pressure(), row.pressure_p99_MPa, row.mean_gap_um, row.leak_x_m3];
            let numbers: String = numbers.map(|v| format!(" {:>10}", shown(v))).concat();
            let closure = &row.closure;
            let _ = writeln!(text, "{cutoff:>9} {slope:>9}  {closure:<28} {area:>8}{numbers} {plastic:>7}");
        }
        for (name, v) in &self.summary.verdicts {
            let error = v.error.map_or_else(String::new, |e| format!(" to {} %", rounded(100.0 * e)));
            let from = v.from_um.map_or_else(String::new, |f| format!(" from {} um on", with_digits(f, 3)));
            let _ = writeln!(text, "{name:<30} {}{error}{from}", v.class);
        }
        text + &self.summary.verdict + "\n"
    }

    /// The scales as one page that stands alone.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn report(&self) -> Result<String, Error> {
        let s = &self.summary;
        let numbers = Numbers::from_summary(s)?;
        let drawn = |(_, chart): (_, Chart)| page::chart(&chart, &chart.title, &format!("{}.", chart.title));
        let charts =
            scale_charts(&self.found).into_iter().map(drawn).collect::<Result<Vec<Markup>, Error>>()?;
        let rows: Vec<Vec<Markup>> = s
            .verdicts
            .iter()
            .map(|(name, v)| {
                let at = |key: &str| numbers.shown(&format!("/verdicts/{name}/{key}"), 1.0, "");
                let error = numbers.error(&format!("/verdicts/{name}/error"), "");
                vec![html! { (name) }, html! { (v.class) }, at("value"), at("from_um"), error, at("exponent")]
            })
            .collect();
        let head = ["quantity", "verdict", "value", "from, µm", "error", "log₂ of the change by an octave"];
        let sections = html! {
            h2 { "Verdicts" }
            (page::table("What two finer octaves of waves would change.", &head, &rows))
            h2 { "By scale" }
            @for chart in &charts { (chart) }
        };
        let scene = to_toml(&s.scene).map_err(Error::Unfinished)?;
        let report = Report {
            title: &format!("The scales of {}", s.surface),
            about: "Slopes and contact of a surface as ever finer waves are let in",
            verdict: &s.verdict,
            warnings: &s.warnings,
            sections,
            inputs: &[("The scene, to press it again", scene)],
        };
        Ok(report.html())
    }
}
