//! Files that instruments and people write, read into columns and maps with their units. No mechanics.
//!
//! Quantities with units ([`units`]), tables of numbers under a header ([`text_table`]), tables of
//! indentation instruments ([`indentation_table`]), maps of surfaces ([`surface`]).
//!
//! ```
//! use asperity_formats::text_table::TextTable;
//!
//! let table = TextTable::new("r_um,z_um\n0,20\n5,19").unwrap();
//! assert_eq!(table.pairs([0, 1]).unwrap()[1], (3, [5.0, 19.0]));
//! ```

pub mod units;

pub mod text_table;

pub mod indentation_table;

pub mod surface;
