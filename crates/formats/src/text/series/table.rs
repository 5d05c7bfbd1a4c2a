//! The tests of a table.

/// The readings of one test.
#[derive(Clone, Debug, PartialEq)]
pub struct Series<const N: usize> {
    /// Its name or number.
    pub label: String,
    /// Readings, SI.
    pub rows: Vec<[f64; N]>,
    /// Line of each, from 1.
    pub lines: Vec<usize>,
}

/// All tests of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct SeriesTable<const N: usize> {
    /// Each test that has readings; at least one.
    pub series: Vec<Series<N>>,
    /// SI value of one in each column of the first test.
    pub scales: [f64; N],
    /// Names of these columns as a key takes them.
    pub names: [String; N],
    /// True of those of them that have a unit in the file.
    pub have_units: [bool; N],
    /// Its interpretation, in one sentence.
    pub understood: String,
}
