//! What the parts have left on disk, as the report reads it. What is not there is `None`, never a guess.

use super::part::{Job, Stamp};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The folders of the parts that are done.
pub struct Evidence {
    parts: PathBuf,
    stamps: BTreeMap<&'static str, Stamp>,
}

/// Columns of a CSV file by name; a cell that is no number is `None`.
pub struct Table {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
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
    /// Of the numbers in a JSON array; `None` of none.
    pub fn of(value: &Value) -> Option<Spread> {
        let values: Vec<f64> = value.as_array()?.iter().filter_map(Value::as_f64).collect();
        if values.is_empty() {
            return None;
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let deviation = (squares / (values.len().max(2) - 1) as f64).sqrt();
        Some(Spread { mean, deviation })
    }
}

impl Table {
    fn parse(text: &str) -> Table {
        let mut lines = text.lines().map(|line| line.split(',').map(String::from).collect::<Vec<_>>());
        Table { head: lines.next().unwrap_or_default(), rows: lines.collect() }
    }

    fn column(&self, start: &str) -> Option<usize> {
        self.head.iter().position(|name| name.starts_with(start))
    }

    /// Pairs of two columns, named by the start of their heads, of the rows whose cells equal those `of`.
    pub fn points(&self, x: &str, y: &str, of: &[(&str, &str)]) -> Vec<[f64; 2]> {
        let columns = (self.column(x), self.column(y));
        let wanted: Option<Vec<(usize, &str)>> =
            of.iter().map(|(name, value)| Some((self.column(name)?, *value))).collect();
        let ((Some(x), Some(y)), Some(wanted)) = (columns, wanted) else { return Vec::new() };
        let cell = |row: &Vec<String>, i: usize| row.get(i).and_then(|text| text.parse::<f64>().ok());
        self.rows
            .iter()
            .filter(|row| wanted.iter().all(|(i, value)| row.get(*i).is_some_and(|cell| cell == value)))
            .filter_map(|row| Some([cell(row, x)?, cell(row, y)?]))
            .collect()
    }
}

impl Evidence {
    /// What `jobs` have left in `parts`.
    pub fn read(parts: &Path, jobs: &[Job]) -> Evidence {
        let stamps = jobs.iter().filter_map(|job| Some((job.part.name, job.done()?))).collect();
        Evidence { parts: parts.to_path_buf(), stamps }
    }

    /// The stamp of a part that is done.
    pub fn stamp(&self, part: &str) -> Option<&Stamp> {
        self.stamps.get(part)
    }

    fn bytes(&self, part: &str, file: &str) -> Option<Vec<u8>> {
        self.stamp(part)?;
        std::fs::read(self.parts.join(part).join(file)).ok()
    }

    /// A text file of a part.
    pub fn text(&self, part: &str, file: &str) -> Option<String> {
        String::from_utf8(self.bytes(part, file)?).ok()
    }

    /// A JSON file of a part.
    pub fn json(&self, part: &str, file: &str) -> Option<Value> {
        serde_json::from_str(&self.text(part, file)?).ok()
    }

    /// The number in summary.json whose key starts with `key`: its end is the unit.
    pub fn summary(&self, part: &str, key: &str) -> Option<f64> {
        let summary = self.json(part, "summary.json")?;
        let (_, value) = summary.as_object()?.iter().find(|(name, _)| name.starts_with(key))?;
        value.as_f64()
    }

    /// A CSV file of a part.
    pub fn table(&self, part: &str, file: &str) -> Option<Table> {
        Some(Table::parse(&self.text(part, file)?))
    }

    /// A PNG of a part as a data URI.
    pub fn png(&self, part: &str, file: &str) -> Option<String> {
        use base64::Engine;
        let text = base64::engine::general_purpose::STANDARD.encode(self.bytes(part, file)?);
        Some(format!("data:image/png;base64,{text}"))
    }

    /// The SVG of a part whose name starts with `start` and goes on with the number of an increment.
    pub fn sketch(&self, part: &str, start: &str) -> Option<String> {
        self.stamp(part)?;
        let entries = std::fs::read_dir(self.parts.join(part)).ok()?;
        let names = entries.filter_map(|e| e.ok()?.file_name().into_string().ok());
        let name = names.filter(|n| n.starts_with(&format!("{start}_")) && n.ends_with(".svg")).max()?;
        self.text(part, &name)
    }

    /// Force at `depth` (µm) of the loading branch, √F interpolated.
    pub fn force_at(&self, part: &str, depth: f64) -> Option<f64> {
        let loading = self.table(part, "curve.csv")?.points("depth_um", "force_", &[("phase", "load")]);
        let pair = loading.windows(2).find(|w| w[0][0] < depth && depth <= w[1][0])?;
        let share = (depth - pair[0][0]) / (pair[1][0] - pair[0][0]);
        let root = |i: usize| pair[i][1].max(0.0).sqrt();
        Some((root(0) + share * (root(1) - root(0))).powi(2))
    }

    /// What a closure says of a rough surface: one quantity of table1.json.
    pub fn rough(&self, part: &str, closure: &str, quantity: &str) -> Option<Spread> {
        let table = self.json(part, "table1.json")?;
        let row = table["closures"].as_array()?.iter().find(|row| row["closure"] == closure)?.clone();
        Spread::of(&row[quantity])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_and_spreads_read_back() {
        let table =
            Table::parse("increment,phase,depth_um,force_N\n0,load,0.0,0.0\n1,load,1.0,\n2,unload,0.5,2.5\n");
        assert_eq!(table.points("depth_um", "force_", &[("phase", "load")]), [[0.0, 0.0]]);
        assert_eq!(table.points("depth_um", "force_", &[]).len(), 2);
        assert!(table.points("depth", "nothing", &[]).is_empty());
        let spread = Spread::of(&serde_json::json!([1.0, 3.0])).unwrap();
        assert_eq!((spread.mean, spread.deviation), (2.0, 2.0_f64.sqrt()));
        assert_eq!(Spread::of(&serde_json::json!([])), None);
    }
}
