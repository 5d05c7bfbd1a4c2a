use super::closures::{ClosureContact, Warnings};
use super::table::TableRow;
use super::{MEGAPASCAL, MICROMETRE};
use asperity_roughness::Surface;
use asperity_roughness::scene::Scene;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Meaning of numbers whose names could be misread.
const DEFINITIONS: [(&str, &str); 6] = [
    (
        "standards",
        "sa, sq, ssk, sku, sz, sdq: ISO 25178-2 over the whole map, without further filters than those of the scene; \
         ra and rq are sa and sq of the map",
    ),
    (
        "beta",
        "atan of mean_gradient, the mean of |grad h|; mean_slope_x is the mean of |dz/dx|; both depend on the pixel size",
    ),
    (
        "asperity_slope",
        "tan(beta_j) is the mean of |grad h| over the island, not the slope from summit to rim",
    ),
    (
        "elastic_energy_share",
        "work returned over work done, at most 1; by_law is the unloading law's own figure, above 1 where asperities are \
         shallower than the cones that stand for them",
    ),
    ("separation", "from the mean height of the nodes"),
    (
        "pressure",
        "force on a pixel over the area of the pixel; an island mostly outside the ellipse of its moments is uniform \
         (load_share_uniform)",
    ),
];

/// The content of `summary.json`: the surface as pressed, and every closure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names are those of the file, see `definitions`")]
pub struct Summary {
    pub surface: String,
    /// Points along x and y.
    pub pixels: [usize; 2],
    pub pixel_size_um: [f64; 2],
    /// Points that were not measured.
    pub missing: usize,
    pub nominal_area_um2: f64,
    pub sa_um: f64,
    pub sq_um: f64,
    /// None of a flat map, like `sku`.
    pub ssk: Option<f64>,
    pub sku: Option<f64>,
    pub sz_um: f64,
    pub sdq: f64,
    pub ra_um: f64,
    pub rq_um: f64,
    pub mean_gradient: f64,
    pub mean_slope_x: f64,
    pub beta_deg: f64,
    pub definitions: BTreeMap<String, String>,
    pub closures: Vec<ClosureSummary>,
    /// Remarks on the trust in the numbers.
    pub warnings: Warnings,
    pub wall_s: f64,
    /// The scene as pressed.
    pub scene: Scene,
    pub version: String,
}

impl Summary {
    pub(super) fn of(name: &str, surface: &Surface, scene: &Scene) -> Summary {
        let (map, r) = (&surface.map, &surface.parameters);
        let [sa_um, sq_um, sz_um] = [r.sa, r.sq, r.sz].map(|v| v / MICROMETRE);
        let finite = |v: f64| Some(v).filter(|v| v.is_finite());
        let definitions = DEFINITIONS.map(|(name, text)| (name.to_string(), text.to_string()));
        Summary {
            surface: name.into(),
            pixels: [map.columns(), map.rows()],
            pixel_size_um: map.pixel().map(|p| p / MICROMETRE),
            missing: surface.missing,
            nominal_area_um2: surface.nominal_area() / MICROMETRE / MICROMETRE,
            sa_um,
            sq_um,
            ssk: finite(r.ssk),
            sku: finite(r.sku),
            sz_um,
            sdq: r.sdq,
            ra_um: sa_um,
            rq_um: sq_um,
            mean_gradient: r.mean_gradient,
            mean_slope_x: r.mean_slope_x,
            beta_deg: r.beta_deg(),
            definitions: definitions.into(),
            closures: Vec::new(),
            warnings: Vec::new(),
            wall_s: 0.0,
            scene: scene.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
        }
    }
}

/// One closure in the summary: its row of the table and how far to trust it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClosureSummary {
    /// The row of `table.csv`.
    #[serde(flatten)]
    pub row: TableRow,
    /// Where the closure comes from.
    pub source: String,
    /// The pressure asked for, or carried at the separation asked for, MPa.
    #[serde(rename = "nominal_pressure_MPa")]
    pub nominal_pressure_mpa: f64,
    /// Whether the load jumps at the separation.
    pub load_jumps: bool,
    /// Share of the load on islands outside the range of the closure.
    pub load_share_outside_range: Option<f64>,
    /// Share of the load on islands that no ellipse describes.
    pub load_share_uniform: Option<f64>,
    /// Work returned by the unloading law over work done, above 1 too.
    pub elastic_energy_share_by_law: Option<f64>,
    /// Share of the load on islands that the law would raise by more than they were pressed.
    pub load_share_return_limited: Option<f64>,
}

impl ClosureSummary {
    pub(super) fn of(row: TableRow, one: &ClosureContact) -> ClosureSummary {
        let unloading = one.unloading.as_ref();
        ClosureSummary {
            row,
            source: one.law.closure.source().into(),
            nominal_pressure_mpa: one.nominal / MEGAPASCAL,
            load_jumps: one.contact.jump,
            load_share_outside_range: one.contact.outside_share,
            load_share_uniform: one.field.uniform_share,
            elastic_energy_share_by_law: unloading.and_then(|u| u.elastic_share_by_law),
            load_share_return_limited: unloading.and_then(|u| u.limited_share),
        }
    }
}
