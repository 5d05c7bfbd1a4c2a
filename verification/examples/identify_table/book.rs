//! Journal of computed results, which later runs read.

use crate::cases::Case;
use crate::score::Row;
use asperity::batch::journal::{Journal, fingerprint};
use asperity::{Fit, identify};
use cpu_time::ProcessTime;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::path::Path;
use std::sync::Mutex;

/// A case with the `fit.json` that came of it.
pub struct Solved {
    pub case: Case,
    fit: Value,
}

impl Solved {
    /// Value, low and high of a parameter.
    pub fn parameter(&self, name: &str) -> [f64; 3] {
        ["value", "low", "high"].map(|key| self.fit["parameters"][name][key].as_f64().unwrap_or(f64::NAN))
    }

    /// Value, low and high of a stress (MPa) at a plastic strain.
    pub fn stress(&self, strain: f64) -> [f64; 3] {
        let rows = self.fit["stress_strain"].as_array().cloned().unwrap_or_default();
        let row = rows.iter().find(|r| r["plastic_strain"].as_f64() == Some(strain));
        row.map_or([f64::NAN; 3], numbers)
    }

    /// The stress that is told best, beside the true one at its strain.
    pub fn best_identified(&self) -> Row {
        let best = &self.fit["representative"];
        (self.case.stress(best["plastic_strain"].as_f64().unwrap_or(f64::NAN)), numbers(best))
    }
}

fn numbers(row: &Value) -> [f64; 3] {
    ["value_MPa", "low_MPa", "high_MPa"].map(|key| row[key].as_f64().unwrap_or(f64::NAN))
}

/// The journal of all that is computed.
pub struct Book {
    journal: Mutex<Option<Journal>>,
    known: HashMap<u64, Value>,
}

impl Book {
    /// The journal at `path`, begun anew where another version of the program wrote it; without one nothing
    /// is kept.
    pub fn open(path: Option<&Path>) -> Book {
        let identity = fingerprint(concat!("identify_table 4, asperity ", env!("CARGO_PKG_VERSION")));
        let opened = path.map(|path| Journal::open(path, identity).expect("can be written"));
        let (journal, lines) = opened.map_or((None, Vec::new()), |o| (Some(o.journal), o.texts));
        let known = lines.iter().filter_map(|l| serde_json::from_str::<(u64, Value)>(l).ok()).collect();
        Book { journal: Mutex::new(journal), known }
    }

    /// The result under `name` in the journal, else that of `compute`, which is added.
    pub fn recall(&self, name: &str, compute: impl FnOnce() -> Option<Value>) -> Option<Value> {
        let key = fingerprint(name);
        if let Some(known) = self.known.get(&key) {
            return Some(known.clone());
        }
        let value = compute()?;
        if let Some(journal) = self.journal.lock().expect("no panics").as_mut() {
            journal.append(&format!("[{key},{value}]")).expect("can be written");
        }
        Some(value)
    }

    /// Solves the cases; one without an answer is left out, and said.
    pub fn solve(&self, cases: Vec<Case>) -> Vec<Solved> {
        let one = |case: Case| {
            let fit = self.recall(&case.fit, || answer(&case))?;
            Some(Solved { case, fit })
        };
        cases.into_par_iter().with_max_len(1).filter_map(one).collect()
    }

    /// Core seconds of a case on one thread, with the runs of finite elements.
    pub fn time(&self, case: &Case) -> Option<[f64; 2]> {
        let found = self.recall(&format!("time of {}", case.fit), || {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
            let clock = ProcessTime::now();
            let fit = pool.install(|| answer(case))?;
            Some(json!([clock.elapsed().as_secs_f64(), fit["runs"]]))
        })?;
        Some([found[0].as_f64()?, found[1].as_f64()?])
    }
}

fn answer(case: &Case) -> Option<Value> {
    identified(&case.name, &case.fit, &case.folder)
}

/// The `fit.json` of the fit file `fit` in `folder`; none where there is no answer, which is said of `name`.
#[allow(clippy::print_stderr)]
pub fn identified(name: &str, fit: &str, folder: &Path) -> Option<Value> {
    let fit = Fit::from_toml(fit, folder).and_then(|fit| identify(fit, &mut |_, _| true));
    match fit.and_then(|found| found.to_json()) {
        Ok(text) => serde_json::from_str(&text).ok(),
        Err(error) => {
            eprintln!("{name}: {error}");
            None
        }
    }
}
