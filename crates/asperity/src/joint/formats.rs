//! The files of a joint: CSV, JSON, charts, and the law as other programs read it.

use super::press_joint::Joint;
use super::summary::TABLE_TOLERANCE;
use super::table::JointRow;
use crate::crush::Phase;
use crate::error::Error;
use crate::results::numbers::{rounded, with_digits};
use crate::results::output::{Sink, SinkExt, sorted_json, write_csv};
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use asperity_formats::interface_law::{CALCULIX_CONDUCTANCE_ROWS, Exponential, InterfaceLaw};
use asperity_roughness::joint::conductance_table;
use asperity_roughness::read_as;
use std::fmt::Write;

/// Factor by which a tolerance grows until a table is short enough.
const COARSER: f64 = 1.02;
/// Share of points without a height from which on the decks say what pressures are over.
const SEEN_MISSING_SHARE: f64 = 1e-4;
/// The tables end at this many times the largest load that was computed, along the last tangent.
const CONTINUED: f64 = 2.0;

/// A column that not every joint has.
pub(super) struct OptionalColumn {
    /// Its name and unit for a person.
    pub head: &'static str,
    /// Its key in a row.
    pub key: &'static str,
    /// Its number in a row.
    of: fn(&JointRow) -> Option<f64>,
    /// The factor of that for a person.
    pub scale: f64,
}

impl Joint {
    /// Writes joint.csv, joint.json, calculix.inp, abaqus.inp, moose.csv and the charts.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        sink.write("joint.csv", |out| write_csv(out, &self.rows))?;
        let law = self.interface_law();
        let continued = InterfaceLaw { pressure: self.continued(&law.pressure), ..law.clone() };
        let (heat, heat_error) = self.conductances_for_calculix();
        let calculix = InterfaceLaw { heat, heat_error, ..continued.clone() };
        sink.text("calculix.inp", &calculix.calculix())?;
        sink.text("abaqus.inp", &continued.abaqus())?;
        sink.text("moose.csv", &self.with_rows_of_conductances(law).moose())?;
        for (name, chart) in self.charts() {
            sink.text(name, &crate::draw::chart::svg(&chart).map_err(Error::Unfinished)?)?;
        }
        sink.text("joint.json", &self.json()?)
    }

    /// The text of joint.json.
    ///
    /// # Errors
    /// None that is known: every summary is JSON.
    pub fn json(&self) -> Result<String, Error> {
        sorted_json(&self.summary)
    }

    /// Rows of loading that carry something.
    pub(super) fn loaded(&self) -> impl Iterator<Item = &JointRow> {
        self.rows.iter().filter(|row| row.phase == Phase::Load && row.pressure_MPa > 0.0)
    }

    /// The law for other programs, in SI.
    fn interface_law(&self) -> InterfaceLaw {
        let s = &self.summary;
        let touch = s.first_touch_gap_um * MICROMETRE;
        let conductances = |of| conductance_table(&self.conductances(of), TABLE_TOLERANCE);
        InterfaceLaw {
            head: self.head(),
            pressure: s
                .law
                .iter()
                .map(|row| [row.approach_um * MICROMETRE, row.pressure_MPa * MEGAPASCAL])
                .collect(),
            // the gap is that of first touch less the overclosure
            exponential: s.fit_pressure.as_ref().map(|fit| {
                let length = fit.length_um * MICROMETRE;
                Exponential {
                    touching: fit.pressure_MPa * MEGAPASCAL * (-touch / length).exp(),
                    length,
                    range: fit.range_MPa.map(|p| p * MEGAPASCAL),
                    residual: fit.residual,
                }
            }),
            heat: conductances(|row| row.conductance_W_per_m2K),
            heat_error: TABLE_TOLERANCE,
            current: conductances(|row| row.electrical_conductance_S_per_m2),
        }
    }

    /// Pressure (Pa) and a conductance of first touch and of every load.
    fn conductances(&self, of: fn(&JointRow) -> Option<f64>) -> Vec<[f64; 2]> {
        let rows = self.rows.iter().take(1).chain(self.loaded());
        rows.filter_map(|row| Some([row.pressure_MPa * MEGAPASCAL, of(row)?])).collect()
    }

    /// The thermal conductance in so few rows that CalculiX keeps them, and the share by which straight lines
    /// between them are off the law.
    fn conductances_for_calculix(&self) -> (Vec<[f64; 2]>, f64) {
        let loads = self.conductances(|row| row.conductance_W_per_m2K);
        let mut tolerance = TABLE_TOLERANCE;
        loop {
            let table = conductance_table(&loads, tolerance);
            if table.len() <= CALCULIX_CONDUCTANCE_ROWS {
                return (table, tolerance);
            }
            tolerance *= COARSER;
        }
    }

    /// The law with a row of pressure wherever a conductance has one, for a program that interpolates both
    /// over the approach.
    fn with_rows_of_conductances(&self, law: InterfaceLaw) -> InterfaceLaw {
        let Some(curve) = &self.law else { return law };
        let [low, high] = curve.range();
        let more = law.heat.iter().chain(&law.current).map(|row| row[0]).filter(|p| low < *p && *p < high);
        let mut pressure: Vec<_> =
            law.pressure.iter().copied().chain(more.map(|p| [curve.approach(p), p])).collect();
        pressure.sort_by(|a, b| a[0].total_cmp(&b[0]));
        pressure.dedup_by(|next, last| next[0] <= last[0] || next[1] <= last[1]);
        InterfaceLaw { pressure, ..law }
    }

    /// The rows of pressure with one more beyond the last load, along the tangent.
    fn continued(&self, rows: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut table = rows.to_vec();
        if let [.., a, b] = *rows {
            let chord = (b[1] - a[1]) / (b[0] - a[0]);
            let tangent = self.loaded().last().and_then(|row| row.stiffness_MPa_per_um);
            let slope = tangent.map_or(chord, |slope| slope * MEGAPASCAL / MICROMETRE);
            table.push([b[0] + (CONTINUED - 1.0) * b[1] / slope, CONTINUED * b[1]]);
        }
        table
    }

    /// The origin of the law and how to read it.
    fn head(&self) -> String {
        let s = &self.summary;
        let metal =
            s.limit_MPa.map_or("elastic".into(), |limit| format!("at most {limit:.0} MPa on a pixel"));
        let whole = s.pixels[0] as f64 * s.pixel_size_um[0] * s.pixels[1] as f64 * s.pixel_size_um[1];
        let measured = s.nominal_area_um2 / whole;
        let holes = match measured < 1.0 - SEEN_MISSING_SHARE {
            true => format!(
                "Points without a height carry nothing: pressures and conductances are over the {:.2} % of the area that has one. ",
                1e2 * measured
            ),
            false => String::new(),
        };
        let errors = self.loaded().filter_map(|row| row.error);
        let (low, high) = errors.fold((f64::INFINITY, 0.0_f64), |(l, h), e| (l.min(e), h.max(e)));
        let error = match low <= high {
            true => format!(
                "Stiffness and conductance of single loads are known to {} to {} %. ",
                rounded(1e2 * low),
                rounded(1e2 * high)
            ),
            false => String::new(),
        };
        format!(
            "Joint of the surface {} ({} x {} points of {} x {} um) on a smooth rigid plane, by asperity {}. {holes}Metal: \
             E* = {} MPa, {metal}. Units: N, mm, MPa, mW, K, A, V. Overclosure 0 is first touch, where the mean planes are {} um apart, which the mesh \
             leaves out. Straight lines between rows are off the law by at most 0.5 %. {error}The law was computed to {} MPa; the last row of \
             pressure continues it along its tangent to twice that, and no row of conductance goes beyond.",
            s.surfaces.join(" and "),
            s.pixels[0],
            s.pixels[1],
            with_digits(s.pixel_size_um[0], 4),
            with_digits(s.pixel_size_um[1], 4),
            s.version,
            with_digits(s.reduced_modulus_MPa, 4),
            with_digits(s.first_touch_gap_um, 6),
            with_digits(s.largest_pressure_MPa, 4),
        )
    }

    /// The columns of conductance and flow that this joint has, each with its head.
    pub(super) fn optional_columns(&self) -> Vec<OptionalColumn> {
        let column = |head, key, of| OptionalColumn { head, key, of, scale: 1.0 };
        let error = |head, key, of| OptionalColumn { head, key, of, scale: 1e2 };
        let flows = self.rows.iter().any(|row| row.flow_x_ml_per_min.or(row.flow_x_mbar_l_per_s).is_some());
        let all = [
            column("h, W/(m² K)", "conductance_W_per_m2K", |row| row.conductance_W_per_m2K),
            column("flow x, ml/min", "flow_x_ml_per_min", |row| row.flow_x_ml_per_min),
            column("flow y, ml/min", "flow_y_ml_per_min", |row| row.flow_y_ml_per_min),
            column("x, mbar l/s", "flow_x_mbar_l_per_s", |row| row.flow_x_mbar_l_per_s),
            column("y, mbar l/s", "flow_y_mbar_l_per_s", |row| row.flow_y_mbar_l_per_s),
        ];
        let errors = [
            error("error of x, %", "leak_x_error", |row| row.leak_x_error),
            error("error of y, %", "leak_y_error", |row| row.leak_y_error),
        ];
        // without a fluid no flow is shown that they belong to
        let errors = errors.into_iter().filter(|_| flows);
        all.into_iter().chain(errors).filter(|c| self.rows.iter().any(|row| (c.of)(row).is_some())).collect()
    }

    /// The result for a person.
    pub fn text(&self) -> String {
        let s = &self.summary;
        let mut text = read_as(&s.understood);
        let taken = match s.outliers {
            0 => String::new(),
            n => format!(", {n} taken away by surface.outliers"),
        };
        let _ = writeln!(
            text,
            "{}: {} x {} points of {} x {} um, {} missing{taken}; Sq {} um",
            s.surfaces.join(", "),
            s.pixels[0],
            s.pixels[1],
            with_digits(s.pixel_size_um[0], 4),
            with_digits(s.pixel_size_um[1], 4),
            s.missing,
            with_digits(s.sq_um, 4),
        );
        let more = self.optional_columns();
        let heads: String = more.iter().map(|column| format!("  {:>14}", column.head)).collect();
        let _ = writeln!(
            text,
            "phase    pressure MPa   mean gap um   approach um    A/A0 %  elastic MPa/um  error %{heads}"
        );
        let shown = |value: Option<f64>| value.map_or_else(|| "-".into(), |v| with_digits(v, 4));
        for row in &self.rows {
            let _ = writeln!(
                text,
                "{:<8} {:>12}  {:>12}  {:>12}  {:>8}  {:>14}  {:>7}{}",
                if row.phase == Phase::Load { "load" } else { "unload" },
                shown(Some(row.pressure_MPa)),
                shown(Some(row.mean_gap_um)),
                shown(Some(row.approach_um)),
                shown(Some(100.0 * row.contact_area_ratio_corrected)),
                shown(row.elastic_stiffness_MPa_per_um),
                row.error.map_or_else(|| "-".into(), |e| rounded(100.0 * e)),
                more.iter()
                    .map(|c| format!("  {:>14}", shown((c.of)(row).map(|v| c.scale * v))))
                    .collect::<String>(),
            );
        }
        text + &self.summary.verdict + "\n"
    }
}
