//! Tables as CSV: a type per row, its serde names the columns.

use crate::error::Error;
use crate::output::{Sink, SinkExt};
use serde::{Serialize, Serializer};

/// Writes `rows` as the file `name`.
pub(crate) fn write<T: Serialize>(
    sink: &mut dyn Sink,
    name: &str,
    rows: impl IntoIterator<Item = T>,
) -> Result<(), Error> {
    sink.write(name, |out| {
        let mut table = csv::Writer::from_writer(out);
        rows.into_iter().try_for_each(|row| table.serialize(row))?;
        table.flush().map_err(csv::Error::from)
    })
}

/// A number in the shortest digits that read back, with an exponent where it is below 1e-4.
pub(crate) fn shortest<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{value:?}"))
}
