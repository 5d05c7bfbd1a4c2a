//! Curves of depth and force, as indentation and testing instruments write them.

use crate::cantilever;
use crate::dimension::Dimension;
use crate::text::{Asked, Decimal, Quantity, Series, SeriesTable, TextError, read_series};

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

/// Marks before the name of a column that turn the sign of its numbers.
const MINUS: [char; 2] = ['-', '−'];
/// The largest negative force over the largest positive one from which compression is counted negative: an
/// attraction of the tip is not so much larger than the load.
const NEGATIVE_SHARE: f64 = 5.0;

/// Reads the tests of `text`; `columns` names those of depth and force where their names are unusual, with a
/// minus before a name whose numbers change sign, and `missing` is a number that stands for no reading.
///
/// # Errors
/// No columns of depth and force, units that are missing or unknown, cells that are no numbers, compression
/// counted negative.
pub fn read(
    text: &str,
    columns: [Option<&str>; 2],
    missing: Option<f64>,
) -> Result<SeriesTable<2>, TextError> {
    read_as(text, columns, missing, None)
}

/// [`read`] where the file does not tell what stands before decimals: `decimal` does.
///
/// # Errors
/// Those of [`read`].
pub fn read_as(
    text: &str,
    columns: [Option<&str>; 2],
    missing: Option<f64>,
    decimal: Option<Decimal>,
) -> Result<SeriesTable<2>, TextError> {
    let turned = columns.map(|name| name.is_some_and(|name| name.starts_with(MINUS)));
    let bare = columns.map(|name| name.map(|name| name.trim_start_matches(MINUS)));
    let named = Asked { columns: bare, missing, decimal, key: Some("columns"), ..Asked::default() };
    let mut table = read_series(text, &[DEPTH, FORCE], &named).map_err(|error| {
        let of_cantilever = cantilever::refusal(text).filter(|_| columns == [None; 2]);
        of_cantilever.unwrap_or(error)
    })?;
    for (k, quantity) in [DEPTH, FORCE].iter().enumerate().filter(|(k, _)| turned[*k]) {
        table.series.iter_mut().flat_map(|test| &mut test.rows).for_each(|row| row[k] = -row[k]);
        table.understood += &format!("; the sign of the {} turned", quantity.name);
    }
    for test in &table.series {
        refuse_negative(test, &table.names, turned)?;
    }
    Ok(table)
}

/// Refuses a test whose forces, or whose depths at the largest force, are negative.
///
/// # Errors
/// Such a test, with the key that turns the signs.
fn refuse_negative(test: &Series<2>, names: &[String; 2], turned: [bool; 2]) -> Result<(), TextError> {
    let force = |i: &usize| test.rows[*i][1];
    let end = |sign: f64| (0..test.rows.len()).max_by(|a, b| (sign * force(a)).total_cmp(&(sign * force(b))));
    let (Some(lowest), Some(highest)) = (end(-1.0), end(1.0)) else { return Ok(()) };
    let is_turned = -force(&lowest) > NEGATIVE_SHARE * force(&highest).max(0.0);
    let at = if is_turned { lowest } else { highest };
    let [depth, force] = test.rows[at];
    let is_negative = [depth < 0.0 && depth < test.rows[0][0] && force != 0.0, is_turned];
    if is_negative == [false; 2] {
        return Ok(());
    }
    let key = |k: usize| {
        let minus = if is_negative[k] != turned[k] { "-" } else { "" };
        format!("{} = \"{minus}{}\"", [DEPTH, FORCE][k].name, names[k])
    };
    let message = format!(
        "counts compression negative: its largest force is {:.4} mN, at a depth of {:.4} um. Depths and forces are positive into \
         the metal; a minus turns a sign: columns = {{ {}, {} }}",
        1e3 * force,
        1e6 * depth,
        key(0),
        key(1)
    );
    Err(TextError::new(test.lines[at], message))
}
