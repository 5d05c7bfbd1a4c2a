//! Columns of tables and keys of summaries: each is listed once with its unit and meaning, and what is listed writes CSV, JSON and the
//! page of columns, and reads the files.

use crate::error::{Error, InputError};
use crate::results::numbers::shortest;
use crate::results::units::Unit;
use asperity_simulation::record::rows::Phase;
use asperity_simulation::scene::{Scene as Tables, Symmetry};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::io::Write;
use std::path::Path;

/// A column of a table of results, or a key of a summary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// The quantity, the field of the row.
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
    fn columns() -> Vec<Column>;
}

/// A row or summary in SI, which files have in the units of its columns.
pub trait Table: Described + Sized {
    /// The values of the columns as a file has them; null for what is not there.
    fn values(&self, symmetry: Symmetry) -> Vec<Value>;

    /// The row whose values in a file `value` gives by their names.
    ///
    /// # Errors
    /// The name of what is missing or has no such value.
    fn from_values(symmetry: Symmetry, value: &mut dyn FnMut(&str) -> Option<Value>) -> Result<Self, String>;
}

/// The value of a column.
pub trait Cell: Sized {
    /// As a file has it.
    fn to_file(&self, unit: Unit, symmetry: Symmetry) -> Value;

    /// What a file has, in SI.
    ///
    /// # Errors
    /// Why it is no such value.
    fn from_file(value: Value, unit: Unit, symmetry: Symmetry) -> Result<Self, String>;
}

impl Cell for f64 {
    fn to_file(&self, unit: Unit, symmetry: Symmetry) -> Value {
        Value::from(self / unit.value(symmetry))
    }

    fn from_file(value: Value, unit: Unit, symmetry: Symmetry) -> Result<f64, String> {
        if value.is_null() {
            return Ok(f64::NAN);
        }
        let (written, unit) = (plain::<f64>(value)?, unit.value(symmetry));
        let si = written * unit;
        // the neighbour that is written with the same digits
        Ok([si, si.next_up(), si.next_down()].into_iter().find(|si| si / unit == written).unwrap_or(si))
    }
}

impl<T: Cell> Cell for Option<T> {
    fn to_file(&self, unit: Unit, symmetry: Symmetry) -> Value {
        self.as_ref().map_or(Value::Null, |value| value.to_file(unit, symmetry))
    }

    fn from_file(value: Value, unit: Unit, symmetry: Symmetry) -> Result<Self, String> {
        if value.is_null() { Ok(None) } else { T::from_file(value, unit, symmetry).map(Some) }
    }
}

impl<T: Cell> Cell for Vec<T> {
    fn to_file(&self, unit: Unit, symmetry: Symmetry) -> Value {
        self.iter().map(|value| value.to_file(unit, symmetry)).collect()
    }

    fn from_file(value: Value, unit: Unit, symmetry: Symmetry) -> Result<Self, String> {
        plain::<Vec<Value>>(value)?.into_iter().map(|value| T::from_file(value, unit, symmetry)).collect()
    }
}

impl Cell for [f64; 2] {
    fn to_file(&self, unit: Unit, symmetry: Symmetry) -> Value {
        self.to_vec().to_file(unit, symmetry)
    }

    fn from_file(value: Value, unit: Unit, symmetry: Symmetry) -> Result<Self, String> {
        let pair = Vec::from_file(value, unit, symmetry)?;
        pair.try_into().map_err(|list: Vec<f64>| format!("{} numbers in the place of 2", list.len()))
    }
}

impl Cell for bool {
    fn to_file(&self, unit: Unit, _: Symmetry) -> Value {
        if unit == Unit::Bit { Value::from(u8::from(*self)) } else { Value::from(*self) }
    }

    fn from_file(value: Value, unit: Unit, _: Symmetry) -> Result<bool, String> {
        if unit == Unit::Bit { Ok(plain::<u8>(value)? != 0) } else { plain(value) }
    }
}

impl<T: Table> Cell for T {
    fn to_file(&self, _: Unit, symmetry: Symmetry) -> Value {
        let names = T::columns().into_iter().map(|column| column.name(symmetry));
        Value::Object(names.zip(self.values(symmetry)).collect())
    }

    fn from_file(value: Value, _: Unit, symmetry: Symmetry) -> Result<Self, String> {
        let mut table: Map<String, Value> = plain(value)?;
        T::from_values(symmetry, &mut |name| table.remove(name))
    }
}

macro_rules! without_unit {
    ($($kind:ty),*) => {$(
        impl Cell for $kind {
            fn to_file(&self, _: Unit, _: Symmetry) -> Value {
                serde_json::to_value(self).unwrap_or_default()
            }

            fn from_file(value: Value, _: Unit, _: Symmetry) -> Result<Self, String> {
                plain(value)
            }
        }
    )*};
}
without_unit!(usize, String, Phase, Box<Tables>);

fn plain<T: DeserializeOwned>(value: Value) -> Result<T, String> {
    serde_json::from_value(value).map_err(|e| e.to_string())
}

/// The value of a column out of those of a file.
pub(crate) fn take<T: Cell>(
    value: &mut dyn FnMut(&str) -> Option<Value>,
    quantity: &str,
    unit: Unit,
    symmetry: Symmetry,
) -> Result<T, String> {
    let name = unit.name(quantity, symmetry);
    let value = value(&name).ok_or_else(|| format!("missing field `{name}`"))?;
    T::from_file(value, unit, symmetry).map_err(|e| format!("{name}: {e}"))
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

/// The list of the columns of a row: its fields, each with unit and meaning; after a `+` what its functions derive from them, after `..`
/// a field whose columns stand there. Fields that no file has follow, with what they are when a file was read.
macro_rules! columns {
    ($row:ident {$(
        $(#[$($about:tt)*])* $field:ident: $unit:ident,
        $(+ $(#[$($own_about:tt)*])* $derived:ident: $own_unit:ident,)*
        $(.. $inner:ident: $rows:ident,)?
    )*} $(absent { $($absent:ident: $nothing:expr),* })?) => {
        impl $crate::results::columns::Described for $row {
            fn columns() -> Vec<$crate::results::columns::Column> {
                let all = [$(
                    vec![
                        columns!(column $field $unit $(#[$($about)*])*),
                        $(columns!(column $derived $own_unit $(#[$($own_about)*])*),)*
                    ],
                    $(<$rows as $crate::results::columns::Described>::columns(),)?
                )*];
                all.concat()
            }
        }

        impl $crate::results::columns::Table for $row {
            fn values(&self, symmetry: Symmetry) -> Vec<Value> {
                use $crate::results::columns::Cell;
                let all = [$(
                    vec![
                        self.$field.to_file($crate::results::units::Unit::$unit, symmetry),
                        $(self.$derived().to_file($crate::results::units::Unit::$own_unit, symmetry),)*
                    ],
                    $(self.$inner.values(symmetry),)?
                )*];
                all.concat()
            }

            fn from_values(
                symmetry: Symmetry,
                value: &mut dyn FnMut(&str) -> Option<Value>,
            ) -> Result<Self, String> {
                Ok($row {
                    $($field: $crate::results::columns::take(
                        value,
                        stringify!($field),
                        $crate::results::units::Unit::$unit,
                        symmetry,
                    )?,)*
                    $($($inner: $rows::from_values(symmetry, value)?,)?)*
                    $($($absent: $nothing,)*)?
                })
            }
        }
    };
    (column $quantity:ident $unit:ident $(#[$($about:tt)*])*) => {
        $crate::results::columns::Column {
            quantity: stringify!($quantity),
            unit: $crate::results::units::Unit::$unit,
            about: concat!($($crate::about_in!($($about)*)),*),
        }
    };
}
pub(crate) use columns;

/// Writes rows as the CSV of a crush in this symmetry: numbers in the shortest digits that read back to the same bits, those that are
/// not finite as empty cells. Without rows there is only a header.
///
/// # Errors
/// A writer that fails.
pub fn write_rows<T: Table>(out: impl Write, rows: &[T], symmetry: Symmetry) -> csv::Result<()> {
    let names = T::columns().into_iter().map(|column| column.name(symmetry));
    write_values(out, names, rows.iter().map(|row| row.values(symmetry)))
}

/// Writes the values of rows as CSV under `names`.
pub(crate) fn write_values(
    out: impl Write,
    names: impl Iterator<Item = String>,
    rows: impl Iterator<Item = Vec<Value>>,
) -> csv::Result<()> {
    let mut out = csv::Writer::from_writer(out);
    out.write_record(names)?;
    for row in rows {
        out.write_record(row.iter().map(text))?;
    }
    Ok(out.flush()?)
}

/// A value as tables have it: `5.0`, `5e-5`, nothing for what is not there.
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
pub fn read_rows<T: Table>(path: &Path) -> Result<Vec<T>, Error> {
    let error = |e: &dyn std::fmt::Display| InputError::new(format!("cannot read {}: {e}", path.display()));
    let mut table = csv::Reader::from_path(path).map_err(|e| error(&e))?;
    let names = table.headers().map_err(|e| error(&e))?.clone();
    let symmetry = symmetry_of::<T>(|name| names.iter().any(|own| own == name));
    let row = |record: csv::Result<csv::StringRecord>| {
        let record = record.map_err(|e| e.to_string())?;
        T::from_values(symmetry, &mut |name| {
            let place = names.iter().position(|own| own == name)?;
            let cell = &record[place];
            let word = || Value::from(cell);
            Some(if cell.is_empty() {
                Value::Null
            } else {
                serde_json::from_str(cell).unwrap_or_else(|_| word())
            })
        })
    };
    table.records().map(|record| row(record).map_err(|e| error(&e).into())).collect()
}

/// The symmetry whose names of the columns of a file `has`.
pub(crate) fn symmetry_of<T: Described>(has: impl Fn(&str) -> bool) -> Symmetry {
    let plane = T::columns().iter().any(|column| {
        let [name, plane] = [Symmetry::Axisymmetric, Symmetry::PlaneStrain].map(|s| column.name(s));
        name != plane && has(&plane)
    });
    if plane { Symmetry::PlaneStrain } else { Symmetry::Axisymmetric }
}
