//! The results that the parts have left on disk, read back into types. A file that is not there is `None`,
//! never a guess.

use super::paper::IDENTICAL;
use super::part::{Job, Stamp};
use super::verdict::Measured;
use super::zones::Zones;
use crate::table1::{ClosureSeeds, ComparedRow, Seeds};
use asperity::calibrate::Fit;
use asperity::crush::{CurveRow, Phase, Summary, read_rows};
use asperity::draw::frame::data_uri;
use asperity::numbers::Spread;
use asperity::numerics::least_squares::Line;
use asperity::output::read_csv;
use asperity::roughness::Closure;
use asperity::units::MICROMETRE;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The part of `summary.json` of `asperity scales` that the report shows.
#[derive(Clone, Debug, Deserialize)]
pub struct ScalesSummary {
    /// Of the power spectrum.
    pub hurst: Option<Hurst>,
    /// Share of the elastic load on patches so steep that the metal under them is fully plastic.
    pub singular_pressure_share: Option<f64>,
    /// The coarsest cut-off at which hardness ends the growth of the mean pressure, µm.
    pub hardness_ends_um: Option<f64>,
    /// The cut-off to use, µm.
    pub cutoff_um: f64,
    /// The result in words.
    pub verdict: String,
}

/// The Hurst exponent of a spectrum.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct Hurst {
    /// The number.
    pub value: f64,
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

    /// The rows of a CSV file of a part.
    pub fn rows<T: DeserializeOwned>(&self, part: &str, file: &str) -> Option<Vec<T>> {
        self.stamp(part)?;
        read_csv(&self.parts.join(part).join(file)).ok()
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
        self.stamp(part)?;
        read_rows(&self.parts.join(part).join("curve.csv")).ok()
    }

    /// Depth (µm) and force (N) of an axisymmetric crush while loading.
    fn loading(&self, part: &str) -> Option<Vec<[f64; 2]>> {
        let rows = self.curve(part)?.into_iter().filter(|row| row.phase == Phase::Load);
        Some(rows.map(|row| [row.depth / MICROMETRE, row.force]).collect())
    }

    /// The fit of the sweep.
    pub fn fit(&self) -> Option<Fit> {
        self.json("calibrate", "fit.json")
    }

    /// The row of Table 1 of a rough surface.
    pub fn table1(&self, part: &str) -> Option<ComparedRow> {
        self.json(part, "table1.json")
    }

    /// One quantity of Table 1 by a closure.
    pub fn rough(
        &self,
        part: &str,
        closure: Closure,
        quantity: fn(&ClosureSeeds) -> &Seeds,
    ) -> Option<Spread> {
        let table = self.table1(part)?;
        let seeds = quantity(table.closures.iter().find(|row| row.closure == closure)?);
        (!seeds.0.is_empty()).then(|| Spread { mean: seeds.mean(), deviation: seeds.deviation() })
    }

    /// The summary of a surface at all its scales.
    pub fn scales(&self, part: &str) -> Option<ScalesSummary> {
        self.json(part, "summary.json")
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
        Some(Line::fit(&logs).slope).filter(|slope| slope.is_finite())
    }

    /// The elastic zones of the row of identical asperities on each of its meshes, from the coarsest to the
    /// finest; `end` tells the symmetry.
    pub fn zones_of_meshes(&self, end: &str) -> Vec<Zones> {
        IDENTICAL.iter().filter_map(|name| self.json(&format!("{name}{end}"), "zones.json")).collect()
    }

    /// A quantity of Table 1 by a closure, with what is not known of it: two standard deviations over the
    /// generated surfaces, and how far surfaces of other kinds with the same height and slope lie from them.
    pub fn of_surface(
        &self,
        part: &str,
        closure: Closure,
        quantity: fn(&ClosureSeeds) -> &Seeds,
    ) -> Option<Measured> {
        let Spread { mean, deviation } = self.rough(part, closure, quantity)?;
        let others: Vec<ClosureSeeds> = self.json(part, "other_kinds.json")?;
        let others = others.iter().filter(|other| other.closure == closure).map(quantity);
        let far = others.flat_map(|seeds| &seeds.0).map(|v| (v - mean).abs()).fold(f64::NAN, f64::max);
        Some(Measured { value: mean, error: (2.0 * deviation).hypot(far) })
    }
}
