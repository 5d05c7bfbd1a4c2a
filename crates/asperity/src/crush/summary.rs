//! `summary.json`.

use super::{GIGAPASCAL, MEGAPASCAL, MICROMETRE, area_unit, energy_unit, force_unit, stiffness_unit};
use asperity_solver::run::oliver_pharr::OliverPharr;
use asperity_solver::run::record::{IslandRow, Summary};
use asperity_solver::scene::{Scene, Symmetry};
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Value, json};

/// Keys and values in the order they are given.
struct Entries(Vec<(String, Value)>);

impl Serialize for Entries {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (key, value) in &self.0 {
            map.serialize_entry(key, value)?;
        }
        map.end()
    }
}

/// The summary as indented JSON. A number that does not exist (no unloading, not reached, not finite) is `null`.
///
/// `islands` are the regions that never yielded, `scene` is the scene as resolved, `stopped` why the run ended early, `wall_s` its wall time in seconds.
///
/// # Errors
/// A scene that JSON cannot hold.
pub fn summary_json(
    summary: &Summary,
    islands: &[IslandRow],
    scene: &Scene,
    stopped: Option<&str>,
    wall_s: f64,
) -> Result<String, serde_json::Error> {
    let symmetry = scene.symmetry;
    let (force, energy, area) = (force_unit(symmetry), energy_unit(symmetry), area_unit(symmetry));
    let stiffness = stiffness_unit(symmetry);
    let number = |value: Option<f64>, scale: f64| value.map_or(Value::Null, |v| json!(v / scale));
    let name = |start: &str, unit: &str| format!("{start}_{unit}");
    let mut entries = vec![
        (name("peak_force", force.suffix), number(Some(summary.peak_force), force.scale)),
        ("peak_depth_um".into(), number(Some(summary.peak_depth), MICROMETRE)),
        ("residual_depth_um".into(), number(summary.residual_depth, MICROMETRE)),
        (name("unloading_stiffness", stiffness.suffix), number(summary.unloading_stiffness, stiffness.scale)),
        (area.suffix.into(), number(Some(summary.contact_area), area.scale)),
        ("contact_radius_um".into(), number(Some(summary.contact_radius), MICROMETRE)),
        (name("total_work", energy.suffix), number(Some(summary.total_work), energy.scale)),
        (name("elastic_work", energy.suffix), number(summary.elastic_work, energy.scale)),
        (name("plastic_work", energy.suffix), number(Some(summary.plastic_work), energy.scale)),
        (
            "oliver_pharr".into(),
            summary.oliver_pharr.as_ref().map_or(Value::Null, |o| instrument(o, summary)),
        ),
        ("elastic_fraction".into(), number(summary.elastic_fraction, 1.0)),
        ("energy_balance_error".into(), number(Some(summary.energy_balance_error), 1.0)),
        ("estimated_error".into(), number(Some(summary.estimated_error), 1.0)),
        ("elements".into(), json!(summary.elements)),
        ("dofs".into(), json!(summary.dofs)),
        ("increments".into(), json!(summary.increments)),
        ("newton_iterations".into(), json!(summary.newton_iterations)),
        ("cutbacks".into(), json!(summary.cutbacks)),
        ("elastic_islands".into(), islands.iter().map(island).collect()),
        ("wall_s".into(), json!(wall_s)),
        ("peak_memory_MB".into(), json!(peak_memory_mb())),
        ("scene".into(), serde_json::to_value(scene)?),
        ("version".into(), json!(env!("CARGO_PKG_VERSION"))),
    ];
    if let Some(reason) = stopped {
        entries.insert(0, ("stopped".into(), json!(reason)));
    }
    serde_json::to_string_pretty(&Entries(entries)).map(|text| text + "\n")
}

/// A region that never yielded: its centroid and area before the crush, and whether it is a leak path.
fn island(row: &IslandRow) -> Value {
    json!({
        "place_um": row.place.map(|x| x / MICROMETRE),
        "area_um2": row.area / (MICROMETRE * MICROMETRE),
        "mean_pressure_MPa": row.mean_pressure / MEGAPASCAL,
        "mean_von_mises_MPa": row.mean_von_mises / MEGAPASCAL,
        "reaches_substrate": row.reaches_substrate,
        "reaches_surface": row.reaches_surface,
    })
}

/// What an instrument reads from the curve, and beside it what is true.
fn instrument(read: &OliverPharr, summary: &Summary) -> Value {
    let area = MICROMETRE * MICROMETRE;
    json!({
        "epsilon": read.geometry_factor,
        "contact_depth_um": read.contact_depth / MICROMETRE,
        "contact_area_um2": read.contact_area / area,
        "true_contact_area_um2": summary.contact_area / area,
        "hardness_MPa": read.hardness / MEGAPASCAL,
        "true_hardness_MPa": summary.peak_force / summary.contact_area / MEGAPASCAL,
        "reduced_modulus_GPa": read.reduced_modulus / GIGAPASCAL,
        "true_reduced_modulus_GPa": summary.reduced_modulus / GIGAPASCAL,
    })
}

/// Largest resident memory of this process so far, in MB of 10⁶ bytes; `None` where the system does not say.
pub fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1.024e-3)
}

/// A few lines for a person: what came out, and where it is.
pub fn overview(summary: &Summary, symmetry: Symmetry) -> String {
    let (force, energy) = (force_unit(symmetry), energy_unit(symmetry));
    let per = if symmetry == Symmetry::PlaneStrain { "/mm" } else { "" };
    let error = summary.estimated_error;
    let error =
        if error.is_finite() { format!(", error within {:.2} %", 100.0 * error) } else { String::new() };
    let mut text = format!(
        "peak      {:.4} N{per} at {:.4} um{error}\n",
        summary.peak_force / force.scale,
        summary.peak_depth / MICROMETRE,
    );
    if let (Some(residual), Some(elastic), Some(fraction)) =
        (summary.residual_depth, summary.elastic_work, summary.elastic_fraction)
    {
        text += &format!(
            "unloaded  residual depth {:.4} um; work returned {:.4} of {:.4} uJ{per} ({:.1} %)\n",
            residual / MICROMETRE,
            elastic / energy.scale,
            summary.total_work / energy.scale,
            100.0 * fraction
        );
    }
    text += &format!(
        "solved    {} elements, {} unknowns, {} increments, {} Newton iterations, energy balance {:.1e}",
        summary.elements,
        summary.dofs,
        summary.increments,
        summary.newton_iterations,
        summary.energy_balance_error
    );
    text
}
