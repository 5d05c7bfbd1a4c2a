//! Lists of the columns of tables and the keys of summaries (those of a crush stand in
//! `crush_columns.rs`): each is listed once with its unit and meaning, and what is listed
//! writes CSV, JSON and the page of columns, and reads the files. In plane strain forces and energies are per
//! length of ridge, and the contact area is a width.

use crate::error::{Error, InputError};
use crate::results::numbers::shortest;
use crate::results::units::{GIGAPASCAL, MEGAPASCAL, MICROMETRE};
use asperity_simulation::scene::Symmetry;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::io::Write;
use std::path::Path;

/// The unit of a column or key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unit {
    /// None: a count, a ratio, a word, or a unit that the name has already.
    Plain,
    /// None: 1 for true, 0 for false.
    Bit,
    /// A table of these columns, or several.
    Table(&'static [Column]),
    /// µm.
    Length,
    /// Contact area, µm²; contact width in plane strain, µm.
    Contact,
    /// µm².
    Area,
    /// N, N/mm in plane strain.
    Force,
    /// µJ, µJ/mm in plane strain.
    Energy,
    /// N/µm, N/µm/mm in plane strain.
    Stiffness,
    /// MPa.
    Pressure,
    /// GPa.
    Modulus,
    /// MB of 10⁶ bytes.
    Memory,
}

impl Unit {
    /// SI values of 1 of it in axisymmetry and plane strain, and the ends of names there.
    fn both(self) -> ([f64; 2], [&'static str; 2]) {
        match self {
            Unit::Plain | Unit::Bit | Unit::Table(_) => ([1.0; 2], [""; 2]),
            Unit::Length => ([MICROMETRE; 2], ["_um"; 2]),
            Unit::Contact => ([1e-12, 1e-6], ["_um2", "_um"]),
            Unit::Area => ([MICROMETRE * MICROMETRE; 2], ["_um2"; 2]),
            Unit::Force => ([1.0, 1e3], ["_N", "_N_per_mm"]),
            Unit::Energy => ([1e-6, 1e-3], ["_uJ", "_uJ_per_mm"]),
            Unit::Stiffness => ([1e6, 1e9], ["_N_per_um", "_N_per_um_per_mm"]),
            Unit::Pressure => ([MEGAPASCAL; 2], ["_MPa"; 2]),
            Unit::Modulus => ([GIGAPASCAL; 2], ["_GPa"; 2]),
            Unit::Memory => ([1e6; 2], ["_MB"; 2]),
        }
    }

    /// SI value of 1 of it in a file.
    pub fn value(self, symmetry: Symmetry) -> f64 {
        self.both().0[usize::from(symmetry == Symmetry::PlaneStrain)]
    }

    /// The name in a file of the quantity `of`.
    pub fn name(self, of: &str, symmetry: Symmetry) -> String {
        let plane = symmetry == Symmetry::PlaneStrain;
        // what is an area under a body of revolution is a width
        let of = if plane && self == Unit::Contact { "contact_width" } else { of };
        format!("{of}{}", self.both().1[usize::from(plane)])
    }
}

/// A column of a table of results, or a key of a summary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// The quantity: the field of the row, in SI.
    pub quantity: &'static str,
    /// Its unit in the file.
    pub unit: Unit,
    /// Its meaning.
    pub about: &'static str,
}

impl Column {
    /// Its name in the file, unit included.
    pub fn name(&self, symmetry: Symmetry) -> String {
        self.unit.name(self.quantity, symmetry)
    }
}

/// Results that say what their columns mean.
pub trait Described {
    /// The columns in the order of the file; a table inside is one of them.
    const COLUMNS: &'static [Column];
}

/// The docstring in an attribute, or nothing.
#[doc(hidden)]
#[macro_export]
macro_rules! about_in {
    (doc = $text:literal) => {
        $text
    };
    ($($other:tt)*) => {
        ""
    };
}
pub use about_in;

/// The list of the columns of a row: its fields, each with meaning and unit.
macro_rules! columns {
    ($row:ident { $($(#[$($about:tt)*])* $quantity:ident: $unit:expr,)* }) => {
        impl $crate::results::columns::Described for $row {
            const COLUMNS: &'static [$crate::results::columns::Column] = {
                use $crate::results::columns::Unit::*;
                &[$($crate::results::columns::Column {
                    quantity: stringify!($quantity),
                    unit: $unit,
                    about: concat!($($crate::about_in!($($about)*)),*),
                }),*]
            };
        }
    };
}
pub(crate) use columns;

/// A value in SI as a file has it.
fn to_file(value: Value, unit: Unit, symmetry: Symmetry) -> Value {
    match (value, unit) {
        (Value::Array(list), _) => list.into_iter().map(|value| to_file(value, unit, symmetry)).collect(),
        (Value::Object(row), Unit::Table(columns)) => Value::Object(named(row, columns, symmetry).collect()),
        (Value::Bool(bit), Unit::Bit) => u8::from(bit).into(),
        (Value::Number(number), _) if unit != Unit::Plain => {
            number.as_f64().map(|si| si / unit.value(symmetry)).into()
        }
        (value, _) => value,
    }
}

/// The value in SI of what a file has.
fn from_file(value: Value, unit: Unit, symmetry: Symmetry) -> Value {
    match (value, unit) {
        (Value::Array(list), _) => list.into_iter().map(|value| from_file(value, unit, symmetry)).collect(),
        (Value::Object(mut row), Unit::Table(columns)) => {
            Value::Object(unnamed(columns, symmetry, |name| row.remove(name)))
        }
        (Value::Number(number), Unit::Bit) => (number.as_u64() == Some(1)).into(),
        (Value::Number(number), _) if unit != Unit::Plain => {
            let (written, unit) = (number.as_f64().unwrap_or(f64::NAN), unit.value(symmetry));
            let si = written * unit;
            // the neighbour that is written with the same digits
            let near = [si, si.next_up(), si.next_down()].into_iter().find(|si| si / unit == written);
            near.unwrap_or(si).into()
        }
        (value, _) => value,
    }
}

/// The values of a row in SI as a file has them, by their names there, in its order; a quantity that the row
/// does not have is left out.
pub(crate) fn named(
    mut row: Map<String, Value>,
    columns: &[Column],
    symmetry: Symmetry,
) -> impl Iterator<Item = (String, Value)> {
    columns.iter().filter_map(move |column| {
        let value = row.remove(column.quantity)?;
        Some((column.name(symmetry), to_file(value, column.unit, symmetry)))
    })
}

/// The values in SI of the row of a file that `value` gives by their names there.
pub(crate) fn unnamed(
    columns: &[Column],
    symmetry: Symmetry,
    mut value: impl FnMut(&str) -> Option<Value>,
) -> Map<String, Value> {
    let known = columns.iter().filter_map(|column| {
        let value = value(&column.name(symmetry))?;
        Some((column.quantity.to_string(), from_file(value, column.unit, symmetry)))
    });
    known.collect()
}

/// The symmetry of the file that `has` these names.
pub(crate) fn symmetry_of(columns: &[Column], has: impl Fn(&str) -> bool) -> Symmetry {
    let name = |column: &Column, symmetry| Some(column.name(symmetry)).filter(|name| has(name));
    let plane = columns.iter().filter_map(|column| name(column, Symmetry::PlaneStrain)).count();
    let round = columns.iter().filter_map(|column| name(column, Symmetry::Axisymmetric)).count();
    if plane > round { Symmetry::PlaneStrain } else { Symmetry::Axisymmetric }
}

/// Names of the columns of `rows` in a file: of all quantities, or of those that the first row has.
pub(crate) fn names<T: Described + Serialize>(rows: &[T], symmetry: Symmetry) -> csv::Result<Vec<String>> {
    let Some(row) = rows.first() else {
        return Ok(T::COLUMNS.iter().map(|column| column.name(symmetry)).collect());
    };
    let row = serde_json::to_value(row).map_err(std::io::Error::from)?;
    let has = |column: &&Column| row.get(column.quantity).is_some();
    Ok(T::COLUMNS.iter().filter(has).map(|column| column.name(symmetry)).collect())
}

/// The values of a row in SI as a file has them.
pub(crate) fn values<T: Described + Serialize>(row: &T, symmetry: Symmetry) -> csv::Result<Vec<Value>> {
    let Value::Object(row) = serde_json::to_value(row).map_err(std::io::Error::from)? else {
        return Ok(Vec::new());
    };
    Ok(named(row, T::COLUMNS, symmetry).map(|(_, value)| value).collect())
}

/// Writes rows as the CSV of a crush in this symmetry: numbers in the shortest digits that read back to the same bits, those that are
/// not finite as empty cells.
///
/// # Errors
/// A writer that fails.
pub fn write_rows<T: Described + Serialize>(
    out: impl Write,
    rows: &[T],
    symmetry: Symmetry,
) -> csv::Result<()> {
    let names = names(rows, symmetry)?.into_iter();
    write_values(out, names, rows.iter().map(|row| values(row, symmetry)))
}

/// Writes the values of rows as CSV under `names`.
pub(crate) fn write_values(
    out: impl Write,
    names: impl Iterator<Item = String>,
    mut rows: impl Iterator<Item = csv::Result<Vec<Value>>>,
) -> csv::Result<()> {
    let mut out = csv::Writer::from_writer(out);
    out.write_record(names)?;
    rows.try_for_each(|row| out.write_record(row?.iter().map(text)))?;
    Ok(out.flush()?)
}

/// A value as tables have it.
fn text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Number(number) if number.is_f64() => number.as_f64().map_or_else(String::new, shortest),
        value => value.to_string(),
    }
}

/// Reads the rows of a CSV file of a crush in either symmetry, which its names tell.
///
/// # Errors
/// A file that cannot be read, or holds other rows.
pub fn read_rows<T: Described + DeserializeOwned>(path: &Path) -> Result<Vec<T>, Error> {
    let rows = || -> csv::Result<Vec<T>> {
        let mut table = csv::Reader::from_path(path)?;
        let names = table.headers()?.clone();
        let place = |name: &str| names.iter().position(|own| own == name);
        let symmetry = symmetry_of(T::COLUMNS, |name| place(name).is_some());
        let row = |record: csv::StringRecord| {
            let row = unnamed(T::COLUMNS, symmetry, |name| record.get(place(name)?).map(value));
            serde_json::from_value(Value::Object(row)).map_err(std::io::Error::from)
        };
        table.records().map(|record| Ok(row(record?)?)).collect()
    };
    rows().map_err(|e| InputError::new(format!("cannot read {}: {e}", path.display())).into())
}

/// The value of a cell.
fn value(cell: &str) -> Value {
    if cell.is_empty() { Value::Null } else { serde_json::from_str(cell).unwrap_or_else(|_| cell.into()) }
}
