//! `report.html` of one crush.

use super::plot::{contact_charts, titled_chart};
use super::{Crush, CycleRow, Sketch, Summary};
use crate::error::Error;
use crate::input::toml_file::to_toml;
use crate::page::{self, Numbers, Report};
use crate::results::columns::{Described, Unit};
use crate::results::numbers::{rounded, significant};
use crate::results::output::json;
use crate::results::units::{MICROMETRE, per_length};
use asperity_simulation::scene::Symmetry;
use maud::{Markup, html};

impl Crush {
    /// The run as one page that stands alone: what was found and how exactly, warnings, curves that tell
    /// their values.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn report(&self) -> Result<String, Error> {
        let (summary, scene) = (&self.summary, &self.summary.scene);
        let [area, pressure] = contact_charts(scene.symmetry, &self.curve);
        let section = self.section(&Sketch::PEAK)?;
        let sections = html! {
            h2 { "Numbers" }
            (self.numbers()?)
            h2 { "Curves" }
            (page::chart(&titled_chart(summary, &self.curve), &self.finding(), "Force against depth; the band is the stated error.")?)
            (page::chart(&area, "Contact against depth, loading and unloading.", "The contact, projected along the axis of the tool.")?)
            (page::chart(&pressure, "Mean pressure against depth, loading and unloading.", "Force over contact. Where few elements touch, at first touch and at the end of an unloading, it is rough.")?)
            @if let Some(svg) = section {
                h2 { "Section at the peak" }
                (page::drawing(
                    &svg,
                    "Section of the deformed body with the pressure of the tool, and stress and plastic strain in colour.",
                    "The body at the peak of the loading.",
                ))
            }
            @if !self.cycles.is_empty() {
                h2 { "Cycles" }
                (self.cycle_table())
            }
            h2 { "How it was computed" }
            p {
                (summary.elements) " elements, " (summary.dofs) " unknowns, " (summary.increments) " increments, "
                (summary.newton_iterations) " Newton iterations; " (summary.cutbacks) " increments were halved, the body was remeshed "
                (summary.meshed_anew) " times; " (significant(summary.wall_s)) " s."
            }
        };
        let about = format!(
            "One scene crushed; accuracy {}, which is to keep forces within {} %",
            scene.accuracy,
            100.0 * scene.accuracy.promise()
        );
        let report = Report {
            title: &self.title()?,
            about: &about,
            verdict: &self.finding(),
            warnings: &summary.warnings(),
            sections,
            inputs: &[("The scene, to run it again", to_toml(scene).map_err(Error::Unfinished)?)],
        };
        Ok(report.html())
    }

    /// Tool and metal.
    fn title(&self) -> Result<String, Error> {
        let scene = &self.summary.scene;
        let shape = json(&scene.tool.shape)?;
        let material = &scene.material;
        let stress =
            material.yield_stress.map(|stress| format!(", yield stress {} MPa", significant(stress.0 / 1e6)));
        Ok(format!(
            "A crush: tool {}, E {} GPa{}",
            shape.trim_matches(|c: char| !c.is_alphanumeric()),
            significant(material.youngs_modulus.0 / 1e9),
            stress.unwrap_or_default()
        ))
    }

    /// The result in a sentence.
    fn finding(&self) -> String {
        let summary = &self.summary;
        let end = match &summary.stopped {
            Some(reason) => format!("The run {reason}. What it reached: "),
            None => String::new(),
        };
        let bound = Some(summary.errors.force).filter(|error| error.is_finite());
        let bound = bound
            .map_or("its error is not known".into(), |error| format!("within {} %", rounded(100.0 * error)));
        let back = match (summary.residual_depth, summary.elastic_fraction) {
            (Some(residual), Some(fraction)) => format!(
                "; after unloading {} µm of depth remain, and {} % of the work is recovered",
                significant(residual / MICROMETRE),
                significant(100.0 * fraction)
            ),
            _ => String::new(),
        };
        format!(
            "{end}{} N{} ({bound}) at a depth of {} µm{back}.",
            significant(summary.written(summary.peak_force, Unit::Force)),
            per_length(summary.scene.symmetry),
            significant(summary.peak_depth / MICROMETRE)
        )
    }

    /// The numbers of the summary with their errors.
    fn numbers(&self) -> Result<Markup, Error> {
        let symmetry = self.summary.scene.symmetry;
        let numbers = Numbers::from_summary(&self.summary)?;
        let per = per_length(symmetry);
        let [newton, joule, stiff] = ["N", "µJ", "N/µm"].map(|unit| format!(" {unit}{per}"));
        let contact = match symmetry {
            Symmetry::Axisymmetric => ["Contact area at the peak", " µm²"],
            Symmetry::PlaneStrain => ["Contact width at the peak", " µm"],
        };
        let line = |name: &str, key: &str, scale: f64, unit: &str, error: Option<[&str; 2]>| {
            let column = Summary::COLUMNS.iter().find(|column| column.quantity == key);
            let place = column.map_or_else(String::new, |column| format!("/{}", column.name(symmetry)));
            let value = numbers.shown(&place, scale, unit);
            let error = error.map(|[key, of]| numbers.error(&format!("/errors/{key}"), of));
            vec![html! { (name) }, value, error.unwrap_or_default()]
        };
        let bound = |key| Some([key, ""]);
        let stays = Some(["residual_depth", " of the depth"]);
        let returned = Some(["elastic_fraction", " of the work"]);
        let mut rows = vec![
            line("Force at the peak", "peak_force", 1.0, &newton, bound("force")),
            line("Depth at the peak", "peak_depth", 1.0, " µm", None),
            line(contact[0], "contact_area", 1.0, contact[1], bound("contact_area")),
            line("Work done to the peak", "total_work", 1.0, &joule, None),
            line("Plastic work", "plastic_work", 1.0, &joule, None),
        ];
        if self.summary.residual_depth.is_some() {
            rows.extend([
                line("Residual depth", "residual_depth", 1.0, " µm", stays),
                line(
                    "Stiffness of unloading",
                    "unloading_stiffness",
                    1.0,
                    &stiff,
                    bound("unloading_stiffness"),
                ),
                line("Work returned", "elastic_work", 1.0, &joule, None),
                line("Share of the work returned", "elastic_fraction", 100.0, " %", returned),
            ]);
        }
        if self.summary.oliver_pharr.is_some() {
            let read = |name: &str, key: &str, unit: &str, error: Option<&str>| {
                let value = numbers.shown(&format!("/oliver_pharr/{key}"), 1.0, unit);
                let error = error.map(|key| numbers.error(&format!("/errors/{key}"), ""));
                vec![html! { (name) }, value, error.unwrap_or_default()]
            };
            let of_area = "Hardness: force over the contact area at the peak";
            rows.extend([
                read(of_area, "true_hardness_MPa", " MPa", Some("mean_pressure")),
                read("Hardness by Oliver and Pharr", "hardness_MPa", " MPa", None),
                read("Reduced modulus by Oliver and Pharr", "reduced_modulus_GPa", " GPa", None),
            ]);
        }
        rows.push(line("Energy-balance error", "energy_balance_error", 100.0, " % of the work", None));
        let caption =
            "Errors are bounds against the limit of fine meshes and steps, meant to hold in 95 % of scenes.";
        Ok(page::table(caption, &["quantity", "value", "error below"], &rows))
    }

    fn cycle_table(&self) -> Markup {
        let per = per_length(self.summary.scene.symmetry);
        let row = |c: &CycleRow| {
            let [force, residual, lost] =
                [(c.peak_force, Unit::Force), (c.residual_depth, Unit::Length), (c.hysteresis, Unit::Energy)]
                    .map(|(value, unit)| significant(self.summary.written(value, unit)));
            vec![html! { (c.cycle) }, html! { (force) }, html! { (residual) }, html! { (lost) }]
        };
        let head = [
            "cycle".to_string(),
            format!("peak force, N{per}"),
            "residual depth, µm".into(),
            format!("work lost, µJ{per}"),
        ];
        let rows: Vec<_> = self.cycles.iter().map(row).collect();
        page::table("The first loading, then the reloads.", &head.each_ref().map(String::as_str), &rows)
    }
}
