//! The results that the parts have left on disk, read back into types. A file that is not there is `None`, never a guess.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use super::part::{Job, Stamp};
use super::profile::ProfilePoint;
use crate::draw::frame::data_uri;
use asperity_law::least_squares::Line;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The columns of `curve.csv` that a report reads.
#[derive(Clone, Debug, Deserialize)]
pub struct CurveRow {
    /// `load` or `unload`.
    pub phase: String,
    /// Tool travel.
    pub depth_um: f64,
    /// Force; per mm in plane strain.
    #[serde(alias = "force_N_per_mm")]
    pub force_N: f64,
}

/// The keys of a crush's `summary.json` that a report reads; energies and forces per mm in plane strain.
#[derive(Clone, Debug, Deserialize)]
pub struct Summary {
    #[serde(alias = "peak_force_N_per_mm")]
    pub peak_force_N: Option<f64>,
    pub residual_depth_um: Option<f64>,
    #[serde(alias = "unloading_stiffness_N_per_um_per_mm")]
    pub unloading_stiffness_N_per_um: Option<f64>,
    pub contact_radius_um: Option<f64>,
    #[serde(alias = "total_work_uJ_per_mm")]
    pub total_work_uJ: Option<f64>,
    pub elastic_fraction: Option<f64>,
    pub estimated_error: Option<f64>,
    pub dofs: usize,
    pub newton_iterations: usize,
    pub elastic_islands: Vec<Island>,
}

/// A region of a summary that never yielded.
#[derive(Clone, Debug, Deserialize)]
pub struct Island {
    pub place_um: [Option<f64>; 2],
    pub area_um2: Option<f64>,
    pub mean_pressure_MPa: Option<f64>,
    pub reaches_substrate: bool,
}

/// The columns of `load_curve.csv` that a report reads.
#[derive(Clone, Debug, Deserialize)]
pub struct LoadPoint {
    pub closure: String,
    pub phase: String,
    pub separation_um: f64,
    pub pressure_MPa: f64,
}

/// The keys of `fit.json` that a report reads.
#[derive(Clone, Debug, Deserialize)]
pub struct Fit {
    pub coefficient: Option<f64>,
    pub ci95: Option<[f64; 2]>,
    pub per_angle: Vec<FitAngle>,
    pub published: f64,
    pub cases: usize,
}

/// A slope of `fit.json`.
#[derive(Clone, Debug, Deserialize)]
pub struct FitAngle {
    pub beta_deg: f64,
    pub representative_strain: Option<f64>,
    pub low: Option<f64>,
    pub high: Option<f64>,
    pub scatter: Option<f64>,
}

/// The keys of `table1.json` that a report reads.
#[derive(Clone, Debug, Deserialize)]
pub struct Table1 {
    pub closures: Vec<Table1Row>,
    pub against_itself: String,
}

/// A closure of `table1.json`: one value of each quantity per seed.
#[derive(Clone, Debug, Deserialize)]
pub struct Table1Row {
    pub closure: String,
    pub pressure: Vec<f64>,
    pub area: Vec<f64>,
    pub index: Vec<f64>,
    pub peak: Vec<f64>,
    pub residual: Vec<f64>,
    pub elastic: Vec<f64>,
}

/// Mean and standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the sample; 0 of one value.
    pub deviation: f64,
}

impl Spread {
    /// Of numbers; `None` of none.
    pub fn of(values: &[f64]) -> Option<Spread> {
        if values.is_empty() {
            return None;
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        Some(Spread { mean, deviation: (squares / (values.len().max(2) - 1) as f64).sqrt() })
    }
}

/// The folders of the parts that are done.
pub struct Results {
    parts: PathBuf,
    stamps: BTreeMap<&'static str, Stamp>,
}

impl Results {
    /// The results of `jobs` in `parts`.
    pub fn read(parts: &Path, jobs: &[Job]) -> Results {
        let stamps = jobs.iter().filter_map(|job| Some((job.part.name, job.done()?))).collect();
        Results { parts: parts.to_path_buf(), stamps }
    }

    /// The stamp of a part that is done.
    pub fn stamp(&self, part: &str) -> Option<&Stamp> {
        self.stamps.get(part)
    }

    fn bytes(&self, part: &str, file: &str) -> Option<Vec<u8>> {
        self.stamp(part)?;
        std::fs::read(self.parts.join(part).join(file)).ok()
    }

    fn json<T: DeserializeOwned>(&self, part: &str, file: &str) -> Option<T> {
        serde_json::from_slice(&self.bytes(part, file)?).ok()
    }

    fn rows<T: DeserializeOwned>(&self, part: &str, file: &str) -> Option<Vec<T>> {
        rows(&self.bytes(part, file)?)
    }

    /// A text file of a part.
    pub fn text(&self, part: &str, file: &str) -> Option<String> {
        String::from_utf8(self.bytes(part, file)?).ok()
    }

    /// The summary of a crush.
    pub fn summary(&self, part: &str) -> Option<Summary> {
        self.json(part, "summary.json")
    }

    /// The curve of a crush.
    pub fn curve(&self, part: &str) -> Option<Vec<CurveRow>> {
        self.rows(part, "curve.csv")
    }

    /// Depth (µm) and force of a crush while loading.
    fn loading(&self, part: &str) -> Option<Vec<[f64; 2]>> {
        let rows = self.curve(part)?;
        Some(rows.iter().filter(|row| row.phase == "load").map(|row| [row.depth_um, row.force_N]).collect())
    }

    /// The fit of the sweep.
    pub fn fit(&self) -> Option<Fit> {
        self.json("calibrate", "fit.json")
    }

    /// The load curves of a rough surface.
    pub fn load_curve(&self, part: &str) -> Option<Vec<LoadPoint>> {
        self.rows(part, "load_curve.csv")
    }

    /// The line across a rough surface.
    pub fn profile(&self, part: &str) -> Option<Vec<ProfilePoint>> {
        self.rows(part, "profile.csv")
    }

    /// The row of Table 1 of a rough surface.
    pub fn table1(&self, part: &str) -> Option<Table1> {
        self.json(part, "table1.json")
    }

    /// One quantity of Table 1 by a closure.
    pub fn rough(&self, part: &str, closure: &str, quantity: fn(&Table1Row) -> &Vec<f64>) -> Option<Spread> {
        let table = self.table1(part)?;
        Spread::of(quantity(table.closures.iter().find(|row| row.closure == closure)?))
    }

    /// A PNG of a part as a data URI.
    pub fn png(&self, part: &str, file: &str) -> Option<String> {
        self.bytes(part, file).map(|png| data_uri(&png))
    }

    /// The SVG of a part whose name starts with `start` and ends in the number of an increment.
    pub fn sketch(&self, part: &str, start: &str) -> Option<String> {
        self.stamp(part)?;
        let entries = std::fs::read_dir(self.parts.join(part)).ok()?;
        let names = entries.filter_map(|e| e.ok()?.file_name().into_string().ok());
        let name = names.filter(|n| n.starts_with(&format!("{start}_")) && n.ends_with(".svg")).max()?;
        self.text(part, &name)
    }

    /// Force at `depth` (µm) of the loading branch, √F interpolated.
    pub fn force_at(&self, part: &str, depth: f64) -> Option<f64> {
        let loading = self.loading(part)?;
        let pair = loading.windows(2).find(|w| w[0][0] < depth && depth <= w[1][0])?;
        let share = (depth - pair[0][0]) / (pair[1][0] - pair[0][0]);
        let root = |i: usize| pair[i][1].max(0.0).sqrt();
        Some((root(0) + share * (root(1) - root(0))).powi(2))
    }

    /// Slope of ln F against ln h of the single asperity over the upper half of the depth.
    pub fn force_exponent(&self) -> Option<f64> {
        let loading = self.loading("single-asperity")?;
        let peak = loading.last()?[0];
        let upper = loading.iter().filter(|p| p[0] >= 0.5 * peak && p[1] > 0.0);
        let logs: Vec<[f64; 2]> = upper.map(|p| p.map(f64::ln)).collect();
        Some(Line::through(&logs).slope).filter(|slope| slope.is_finite())
    }

    /// Regions of a crush that never yielded and do not belong to the bulk.
    pub fn islands(&self, part: &str) -> Option<Vec<Island>> {
        Some(self.summary(part)?.elastic_islands.into_iter().filter(|i| !i.reaches_substrate).collect())
    }
}

fn rows<T: DeserializeOwned>(bytes: &[u8]) -> Option<Vec<T>> {
    csv::Reader::from_reader(bytes).deserialize().collect::<Result<_, _>>().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_both_symmetries_and_spreads_read_back() {
        let read = |unit: &str, cell: &str| {
            let text =
                format!("increment,phase,depth_um,force_{unit}\n0,load,0.0,0.0\n2,unload,0.5,{cell}\n");
            rows::<CurveRow>(text.as_bytes())
        };
        for unit in ["N", "N_per_mm"] {
            assert_eq!(read(unit, "2.5").unwrap()[1].force_N, 2.5);
        }
        // half a file is none
        assert!(read("N", "").is_none() && read("kN", "2.5").is_none());
        let spread = Spread::of(&[1.0, 3.0]).unwrap();
        assert_eq!((spread.mean, spread.deviation), (2.0, 2.0_f64.sqrt()));
        assert_eq!(Spread::of(&[]), None);
    }
}
