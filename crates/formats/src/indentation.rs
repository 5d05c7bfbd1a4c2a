//! Curves of depth and force, as indentation and testing instruments write them.

use crate::dimension::Dimension;
use crate::text::{Asked, Quantity, SeriesTable, TextError, read_series};

/// Depth and force, m and N, as they were read, one after the other in time.
pub type Readings = Vec<[f64; 2]>;

/// The depth of a curve.
pub const DEPTH: Quantity = Quantity {
    name: "depth",
    dimension: Dimension::Length,
    called: &[
        "depth",
        "displacement",
        "indentation depth",
        "penetration depth",
        "penetration",
        "indentation",
        "travel",
        "disp",
        "h",
        "pd",
        "extension",
        "crosshead",
        "stroke",
        "compression",
        "eindringtiefe",
        "tiefe",
        "weg",
        "standardweg",
        "traversenweg",
        "verschiebung",
        "enfoncement",
        "profondeur",
        "deplacement",
        "course",
        "profondita",
        "spostamento",
        "corsa",
        "profundidad",
        "desplazamiento",
        "penetracion",
        "carrera",
        "profundidade",
        "deslocamento",
    ],
    example: "depth_um",
};

/// The force of a curve.
pub const FORCE: Quantity = Quantity {
    name: "force",
    dimension: Dimension::Force,
    called: &[
        "force",
        "load",
        "p",
        "f",
        "fn",
        "fz",
        "normal force",
        "kraft",
        "prufkraft",
        "pruefkraft",
        "normalkraft",
        "standardkraft",
        "last",
        "charge",
        "force normale",
        "effort",
        "forza",
        "carico",
        "fuerza",
        "carga",
        "forca",
    ],
    example: "force_mN",
};

/// Reads the tests of `text`; `columns` names those of depth and force where their names are unusual, and
/// `missing` is a number that stands for no reading.
///
/// # Errors
/// No columns of depth and force, units that are missing or unknown, cells that are no numbers.
pub fn read(
    text: &str,
    columns: [Option<&str>; 2],
    missing: Option<f64>,
) -> Result<SeriesTable<2>, TextError> {
    let named = Asked { columns, missing, key: Some("columns"), ..Asked::default() };
    read_series(text, &[DEPTH, FORCE], &named)
}
