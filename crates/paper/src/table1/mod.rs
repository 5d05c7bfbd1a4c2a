//! The paper's Table 1 beside ours, with the contradictions named.

mod table1_report;

use asperity::Progress;
use asperity::error::{Error, InputError};
use asperity::output::{Sink, SinkExt};
use asperity::rough::Rough;
use asperity::rough::contact::press;
use asperity::rough::rough_scene::RoughScene;
use asperity::roughness::scene::{Choice, Scene};
use asperity::roughness::{Closure, KindName, PUBLISHED_COEFFICIENT};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt::Write;
use std::path::Path;

/// A row of the paper's Table 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Printed {
    /// Ra, µm.
    pub ra: f64,
    /// β, degrees.
    pub beta: f64,
    /// P_m, MPa.
    pub pressure: f64,
    /// A_r, %.
    pub area: f64,
    /// ψ.
    pub index: f64,
    /// Largest over nominal pressure, as the text says.
    pub peak: Cow<'static, str>,
}

const fn printed(ra: f64, beta: f64, pressure: f64, area: f64, index: f64, peak: &'static str) -> Printed {
    Printed { ra, beta, pressure, area, index, peak: Cow::Borrowed(peak) }
}

/// Table 1 as printed.
pub const TABLE: [(KindName, Printed); 3] = [
    (KindName::Ground, printed(0.23, 1.57, 719.0, 13.74, 0.52, "8")),
    (KindName::Milled, printed(2.95, 4.08, 3830.0, 5.35, 1.37, "60-80")),
    (KindName::Sanded, printed(5.27, 11.38, 75683.0, 2.23, 3.87, "60-80")),
];
const NOMINAL: f64 = 200.0;
/// Generated surfaces of a row.
pub(crate) const SEEDS: u64 = 5;
const HARDNESS: f64 = 1280.0;
const MODULUS: f64 = 210e3;
const POISSON: f64 = 0.3;

/// The scene of a row; σ_y for the closures that need it is that of eq. (20), H = 3 σ_y. Only what the table
/// prints is computed: no comparison of closures, no flow, no load curve of a half-space.
fn scene(kind: KindName, row: &Printed, seed: u64, closure: Choice) -> Result<RoughScene, InputError> {
    let text = format!(
        r#"closure = "all"
judge = false
[surface.generate]
kind = "{}"
ra = "{} um"
mean_slope_deg = {:?}
size = ["2 mm", "2 mm"]
pixels = [1024, 1024]
seed = {seed}
[material]
youngs_modulus = "{MODULUS} MPa"
poissons_ratio = {POISSON}
hardness = "{HARDNESS} MPa"
yield_stress = "{} MPa"
hardening_exponent = 0.3
[load]
pressure = "{NOMINAL} MPa"
unload = true
[half_space]
leak = false
load_points = 1
"#,
        kind.name(),
        row.ra,
        row.beta,
        HARDNESS / 3.0
    );
    let base = Path::new("");
    let tables = RoughScene::from_toml(&text, base)?.tables().clone();
    Ok(RoughScene::new(Scene { closure, ..tables }, base))
}

/// Values of one quantity, one per seed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seeds(pub Vec<f64>);

impl Seeds {
    /// Mean; NaN of none.
    pub fn mean(&self) -> f64 {
        self.0.iter().sum::<f64>() / self.0.len() as f64
    }

    /// Standard deviation of the sample; 0 of one value.
    pub fn deviation(&self) -> f64 {
        let mean = self.mean();
        let sum: f64 = self.0.iter().map(|v| (v - mean).powi(2)).sum();
        (sum / (self.0.len().max(2) - 1) as f64).sqrt()
    }

    fn text(&self, digits: usize) -> String {
        if self.0.is_empty() {
            return "-".into();
        }
        format!("{:.digits$} ± {:.digits$}", self.mean(), self.deviation())
    }
}

/// One closure on one kind of surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClosureSeeds {
    /// The closure.
    pub closure: Closure,
    /// P_m, MPa.
    pub pressure: Seeds,
    /// A_r, %.
    pub area: Seeds,
    /// ψ.
    pub index: Seeds,
    /// Largest over nominal pressure.
    pub peak: Seeds,
    /// Residual displacement after unloading, µm.
    pub residual: Seeds,
    /// Work returned over work done by the unloading law, %.
    pub elastic: Seeds,
}

impl ClosureSeeds {
    fn new(closure: Closure) -> ClosureSeeds {
        let [pressure, area, index, peak, residual, elastic] = [(); 6].map(|()| Seeds::default());
        ClosureSeeds { closure, pressure, area, index, peak, residual, elastic }
    }
}

/// One row of the paper's table beside ours: the content of the `table1.json` of one surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparedRow {
    /// The kind of surface.
    pub surface: KindName,
    /// The row as printed.
    pub paper: Printed,
    /// Every closure, one value per seed.
    pub closures: Vec<ClosureSeeds>,
    /// Warnings of the first seed.
    pub notes: Vec<String>,
    /// The numbers of the row that contradict each other.
    pub against_itself: String,
}

/// Hears of the share that is done (0 to 1) and of what comes next; `false` ends the work.
pub type Told<'a> = dyn FnMut(f64, &str) -> bool + 'a;

/// The error of work that its observer ended.
pub(crate) fn ended() -> Error {
    Error::Unfinished("stopped: nothing of it was written; the same command begins it anew".into())
}

/// The closures of `closure` on the surfaces of one row.
///
/// # Errors
/// A calibration that cannot be read, a surface that cannot be made or pressed, an observer that ended the
/// work.
pub fn measure(
    kind: KindName,
    row: &Printed,
    closure: Choice,
    observer: &mut Told<'_>,
) -> Result<ComparedRow, Error> {
    let mut table: Vec<ClosureSeeds> = Vec::new();
    let mut notes = Vec::new();
    for seed in 1..=SEEDS {
        let scene = scene(kind, row, seed, closure)?;
        let rough = press(&scene, &mut |reached| {
            let closure = reached.news.map_or("half-space", |closure| closure.name());
            let share = ((seed - 1) as f64 + reached.share) / SEEDS as f64;
            observer(share, &format!("{} surface {seed} of {SEEDS}, {closure}", kind.name()))
        })?;
        if rough.stopped {
            return Err(ended());
        }
        if seed == 1 {
            let warnings = rough.summary.warnings.iter();
            notes = warnings.map(|warning| format!("{}, seed 1: {warning}", kind.name())).collect();
        }
        take_down(&mut table, &rough);
    }
    let (paper, against_itself) = (row.clone(), contradictions(row));
    Ok(ComparedRow { surface: kind, paper, closures: table, notes, against_itself })
}

/// Adds the numbers of one surface to those of the closures.
fn take_down(table: &mut Vec<ClosureSeeds>, rough: &Rough) {
    for one in rough.summary.closures.iter().filter(|one| one.row.status == "ok") {
        let closure = one.row.closure;
        let at = table.iter().position(|o| o.closure == closure).unwrap_or_else(|| {
            table.push(ClosureSeeds::new(closure));
            table.len() - 1
        });
        let ours = &mut table[at];
        ours.pressure.0.extend(one.row.mean_pressure_MPa);
        ours.area.0.push(100.0 * one.row.contact_area_ratio);
        ours.index.0.extend(one.row.plasticity_index);
        ours.peak.0.extend(one.row.max_pressure_over_nominal);
        ours.residual.0.extend(one.row.residual_displacement_um);
        ours.elastic.0.extend(one.elastic_energy_share_by_law.map(|e| 100.0 * e));
    }
}

/// The closures that claims are judged by.
const JUDGED: [Closure; 2] = [Closure::Published, Closure::Johnson];

/// Results of the closures that claims are judged by on one surface of each other kind with the Ra and the
/// slope of `row`: how much of a result Ra and slope do not determine. A kind that has no such surface is
/// left out.
///
/// # Errors
/// As for [`measure`].
pub fn other_kinds(
    kind: KindName,
    row: &Printed,
    observer: &mut Told<'_>,
) -> Result<Vec<ClosureSeeds>, Error> {
    let mut table = Vec::new();
    let others = TABLE.into_iter().map(|(other, _)| other).filter(|other| *other != kind);
    for (i, other) in others.enumerate() {
        let message = format!("{} surface as a {} one", kind.name(), other.name());
        let told = &mut |reached: &Progress<'_, Closure>| {
            observer((i as f64 + reached.share) / (TABLE.len() - 1) as f64, &message)
        };
        match press(&scene(other, row, 1, Choice::Islands)?, told) {
            Ok(rough) if rough.stopped => return Err(ended()),
            Ok(rough) => take_down(&mut table, &rough),
            Err(Error::Input(_)) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(table.into_iter().filter(|one| JUDGED.contains(&one.closure)).collect())
}

/// The whole table: the content of `table1.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Table1 {
    /// Ground, milled, sanded.
    pub rows: Vec<ComparedRow>,
}

/// Every closure on the surfaces of every row.
///
/// # Errors
/// As for [`measure`].
pub fn table1(observer: &mut Told<'_>) -> Result<Table1, Error> {
    let share = |i: usize, share: f64| (i as f64 + share) / TABLE.len() as f64;
    let row = |(i, (kind, row)): (usize, (KindName, Printed))| {
        measure(kind, &row, Choice::All, &mut |part, text| observer(share(i, part), text))
    };
    let rows = TABLE.into_iter().enumerate().map(row).collect::<Result<_, Error>>()?;
    Ok(Table1 { rows })
}

impl Table1 {
    /// Writes `table1.txt` and `table1.json`.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        sink.text("table1.txt", &self.text())?;
        sink.text("table1.json", &self.json()?)
    }

    /// The text of table1.json.
    ///
    /// # Errors
    /// None that is known: every table is JSON.
    pub fn json(&self) -> Result<String, Error> {
        asperity::output::json(self)
    }

    /// The tables for a reader.
    pub fn text(&self) -> String {
        let mut text = format!(
            "Table 1: steel E = {MODULUS} MPa, nu = {POISSON}, H = {HARDNESS} MPa under {NOMINAL} MPa; ours: {SEEDS} seeds, 1024 x 1024 points of \
             1.953 um, mean ± standard deviation\n"
        );
        for row in &self.rows {
            let paper = &row.paper;
            let _ = writeln!(text, "\n{}: Ra {} um, beta {} deg", row.surface.name(), paper.ra, paper.beta);
            let _ = writeln!(
                text,
                "  {:<18} {:>18} {:>16} {:>7} {:>15} {:>16} {:>14}",
                "", "P_m MPa", "A_r %", "psi", "peak/nominal", "residual um", "returned %"
            );
            let _ = writeln!(
                text,
                "  {:<18} {:>18} {:>16} {:>7} {:>15} {:>16} {:>14}",
                "paper", paper.pressure, paper.area, paper.index, paper.peak, "", ""
            );
            for o in &row.closures {
                let _ = writeln!(
                    text,
                    "  {:<18} {:>18} {:>16} {:>7.3} {:>15} {:>16} {:>14}",
                    o.closure.name(),
                    o.pressure.text(0),
                    o.area.text(2),
                    o.index.mean(),
                    o.peak.text(1),
                    o.residual.text(2),
                    o.elastic.text(1)
                );
            }
            let _ = writeln!(text, "  {}", row.against_itself);
        }
        text += &trends_text(&self.rows);
        for note in self.rows.iter().flat_map(|row| &row.notes) {
            let _ = writeln!(text, "note: {note}");
        }
        text
    }
}

/// The numbers of one row of the paper that contradict each other, from its own equations.
fn contradictions(row: &Printed) -> String {
    let tan = row.beta.to_radians().tan();
    let modulus = MODULUS / (1.0 - POISSON * POISSON);
    let eq11 = PUBLISHED_COEFFICIENT * modulus * tan;
    let index = eq11 / HARDNESS;
    let balance = NOMINAL / (row.area / 100.0);
    let mut text = format!(
        "the paper against itself: P_m A_r = {:.1} MPa instead of {NOMINAL} (P_m = {balance:.0} MPa would balance the load); \
         eq. 13 gives psi = {index:.3}, printed {} ({:.2} times less); eq. 11 gives {eq11:.0} MPa, psi H = {:.0} MPa, printed {} MPa",
        row.pressure * row.area / 100.0,
        row.index,
        index / row.index,
        row.index * HARDNESS,
        row.pressure,
    );
    if row.pressure > 20000.0 {
        let _ = write!(
            text,
            "; {0} looks like {1:.1} with its decimal point lost ({1:.1} A_r = {2:.1} MPa)",
            row.pressure,
            row.pressure / 10.0,
            row.pressure * row.area / 1000.0
        );
    }
    text
}

/// Per closure, whether A_r falls and P_m rises with the slope, as in the paper.
fn trends(rows: &[ComparedRow]) -> Vec<(Closure, [bool; 2])> {
    let one = |o: &ClosureSeeds| {
        let column = |of: fn(&ClosureSeeds) -> f64| -> Vec<f64> {
            rows.iter()
                .filter_map(|row| row.closures.iter().find(|x| x.closure == o.closure).map(of))
                .collect()
        };
        let rises = |v: &[f64]| v.len() == rows.len() && v.windows(2).all(|w| w[1] > w[0]);
        let columns = [column(|x| -x.area.mean()), column(|x| x.pressure.mean())];
        (o.closure, columns.map(|v| rises(&v)))
    };
    rows.first().map_or(&[][..], |row| &row.closures).iter().map(one).collect()
}

/// [`trends`] for a reader.
fn trends_text(rows: &[ComparedRow]) -> String {
    let mut text = String::from("\ntrend from ground to sanded (the paper: A_r falls, P_m rises):\n");
    let say = |ok: bool| if ok { "holds" } else { "does not hold" };
    for (closure, [falls, rises]) in trends(rows) {
        let _ =
            writeln!(text, "  {:<18} A_r falls: {}; P_m rises: {}", closure.name(), say(falls), say(rises));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contradictions_of_the_paper_are_named_with_their_numbers() {
        let texts: Vec<String> = TABLE.iter().map(|(_, row)| contradictions(row)).collect();
        for (text, words) in texts.iter().zip([
            ["98.8", "0.642", "1456"],
            ["204.9", "1.672", "3738"],
            ["1687.7", "4.717", "7568.3"],
        ]) {
            assert!(words.iter().all(|w| text.contains(w)), "{text}");
        }
    }
}
