//! `report.html` and the charts of a joint.

use super::press_joint::Joint;
use super::table::JointRow;
use crate::crush::Phase;
use crate::draw::chart::{Chart, Dash, Series};
use crate::error::Error;
use crate::input::toml_file::to_toml;
use crate::page::{self, Numbers, Report};
use asperity_numerics::monotone_cubic::MonotoneCubic;
use maud::{Markup, html};

/// Pieces of a line that is drawn of the unloading.
const DRAWN_PIECES: usize = 128;
/// Rows of the page: so many of the loads, evenly.
const SHOWN_ROWS: usize = 12;

impl Joint {
    /// The joint as one page that stands alone: the verdict, curves with bands and fits, the table.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn report(&self) -> Result<String, Error> {
        let s = &self.summary;
        let numbers = Numbers::from_summary(s)?;
        let drawn = |(_, chart): (_, Chart)| page::chart(&chart, &chart.title, &format!("{}.", chart.title));
        let charts = self.charts().into_iter().map(drawn).collect::<Result<Vec<Markup>, Error>>()?;
        let sections = html! {
            h2 { "The law" }
            @for chart in &charts { (chart) }
            h2 { "Loads" }
            (self.loads(&numbers))
            h2 { "Formulas" }
            (self.fits(&numbers))
            p { (s.bounds) "." }
        };
        let scene = to_toml(&s.scene).map_err(Error::Unfinished)?;
        let report = Report {
            title: &format!("The joint of {}", s.surfaces.join(", ")),
            about: "Pressure, gap, stiffness and conductance of a surface on a rigid plane",
            verdict: &s.verdict,
            warnings: &s.warnings,
            sections,
            inputs: &[("The scene, to press it again", scene)],
        };
        Ok(report.html())
    }

    fn loads(&self, numbers: &Numbers) -> Markup {
        let more = self.optional_columns();
        let places: Vec<usize> =
            (0..self.rows.len()).filter(|i| self.rows[*i].phase == Phase::Load).collect();
        let step = places.len().div_ceil(SHOWN_ROWS).max(1);
        let row = |i: &usize| {
            let at = |key: &str, scale: f64| numbers.shown(&format!("/rows/{i}/{key}"), scale, "");
            let mut cells = vec![
                at("pressure_MPa", 1.0),
                at("mean_gap_um", 1.0),
                at("approach_um", 1.0),
                at("contact_area_ratio_corrected", 100.0),
                at("stiffness_MPa_per_um", 1.0),
                at("elastic_stiffness_MPa_per_um", 1.0),
                numbers.error(&format!("/rows/{i}/error"), ""),
            ];
            cells.extend(more.iter().map(|column| at(column.key, column.scale)));
            cells
        };
        let rows: Vec<_> = places.iter().rev().step_by(step).rev().map(row).collect();
        let head = [
            "pressure, MPa",
            "mean gap, µm",
            "approach, µm",
            "true contact, %",
            "stiffness of loading, MPa/µm",
            "elastic stiffness, MPa/µm",
            "its error, and that of the conductance",
        ];
        let head: Vec<&str> = head.into_iter().chain(more.iter().map(|column| column.head)).collect();
        page::table("Some of the loads, from first touch to the largest; all are in joint.csv.", &head, &rows)
    }

    fn fits(&self, numbers: &Numbers) -> Markup {
        let row = |name: &str, key: &str, numbers_of: [&str; 2]| {
            let at = |part: &str| numbers.shown(&format!("/{key}/{part}"), 1.0, "");
            vec![
                html! { (name) },
                at(numbers_of[0]),
                at(numbers_of[1]),
                html! { (at("range_MPa/0")) " to " (at("range_MPa/1")) },
                numbers.error(&format!("/{key}/residual"), ""),
            ]
        };
        let mut rows = vec![
            row("p = a exp(-gap/b), MPa and µm", "fit_pressure", ["pressure_MPa", "length_um"]),
            row("elastic stiffness = a (p/MPa)^b, MPa/µm", "fit_stiffness", ["factor", "exponent"]),
        ];
        if self.summary.fit_conductance.is_some() {
            let name = "conductance = a (p/MPa)^b, W/(m² K)";
            rows.push(row(name, "fit_conductance", ["factor", "exponent"]));
        }
        let head = ["formula", "a", "b", "pressures, MPa", "residual"];
        page::table(
            "Formulas through loads that touch in spots, up to 30 % of the area, each over the widest range \
             that it meets to 20 %.",
            &head,
            &rows,
        )
    }

    /// The charts with the names of their files.
    pub(super) fn charts(&self) -> Vec<(&'static str, Chart)> {
        let unloaded = self.rows.iter().filter(|row| row.phase == Phase::Unload);
        let law = |row: &JointRow| [row.approach_um, row.pressure_MPa];
        // what never reaches the limit goes back as it came
        let flows = self.loaded().any(|row| row.limited_share > 0.0);
        let back = Series {
            dash: Some(Dash::Dashed),
            ..Series::line("back, elastic", smooth(unloaded.map(law).collect()))
        };
        // the law is smooth between its loads
        let loading = self.summary.law.iter().map(|row| [row.approach_um, row.pressure_MPa]);
        let mut curves = vec![Series::line("loading", loading.collect())];
        curves.extend(flows.then_some(back));
        if let Some(fit) = &self.summary.fit_pressure {
            let points = fit.points(self.summary.first_touch_gap_um).collect();
            curves.push(Series { dash: Some(Dash::Dotted), ..Series::line("exponential fit", points) });
        }
        let pressure = Chart::new("approach from first touch (µm)", "nominal pressure (MPa)", curves)
            .titled("Nominal pressure over the fall of the mean gap since first touch");
        let stiffness = self.banded("elastic stiffness", |row| row.elastic_stiffness_MPa_per_um);
        let stiffness = Chart::new("nominal pressure (MPa)", "elastic stiffness (MPa/µm)", [stiffness])
            .titled("Elastic stiffness of the joint as it stands, with the band of its error");
        let mut charts =
            vec![("pressure.svg", pressure), ("stiffness.svg", stiffness.logarithmic([true; 2]))];
        if self.summary.conductivity_W_per_mK.is_some() {
            let heat = self.banded("thermal conductance", |row| row.conductance_W_per_m2K);
            let chart = Chart::new("nominal pressure (MPa)", "thermal conductance (W/(m² K))", [heat]);
            let chart = chart.titled("Thermal conductance, with the band of its error");
            charts.push(("conductance.svg", chart.logarithmic([true; 2])));
        }
        charts
    }

    /// A line over the pressure with the band of its error.
    fn banded(&self, name: &str, of: fn(&JointRow) -> Option<f64>) -> Series {
        let points = || {
            self.loaded().filter_map(move |row| Some((row.pressure_MPa, of(row)?, row.error.unwrap_or(0.0))))
        };
        let edge = |sign: f64| points().map(move |(p, y, e)| [p, (y * (1.0 + sign * e)).max(0.0)]);
        let lower: Vec<[f64; 2]> = edge(-1.0).collect();
        let band = edge(1.0).chain(lower.into_iter().rev()).collect();
        Series { band, ..Series::line(name, points().map(|(p, y, _)| [p, y]).collect()) }
    }
}

/// Rows (approach, pressure) of an unloading, the last without pressure, as a smooth line: a cubic in the
/// logarithm of the pressure, straight below the smallest.
fn smooth(mut rows: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    rows.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let carried: Vec<_> = rows.iter().filter(|row| row[1] > 0.0).map(|[x, p]| [p.ln(), *x]).collect();
    let Some(curve) = MonotoneCubic::through_points(&carried) else { return rows };
    let [low, high] = [carried[0][0], carried[carried.len() - 1][0]];
    let between = (0..=DRAWN_PIECES).map(|i| {
        let t = low + (high - low) * i as f64 / DRAWN_PIECES as f64;
        [curve.value_and_slope(t)[0], t.exp()]
    });
    let end = rows.iter().take_while(|row| row[1] <= 0.0).copied();
    end.chain(between).collect()
}
