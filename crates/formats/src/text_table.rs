//! Tables of numbers as text files: a header of column names, then lines of numbers.
//!
//! Columns are parted by commas, semicolons or tabs; empty lines and lines that begin with # are comments.

/// Two numbers of a line, with its place in the file (from 1).
pub type PlacedPair = (usize, [f64; 2]);

/// A table, cut into its lines.
#[derive(Clone, Debug, PartialEq)]
pub struct TextTable<'t> {
    /// Names of the columns.
    pub header: Vec<&'t str>,
    /// Line of the header, from 1.
    pub header_line: usize,
    /// Lines of numbers with their place, from 1.
    lines: Vec<(usize, &'t str)>,
    separator: char,
}

impl<'t> TextTable<'t> {
    /// Cuts up `text`; `None` where nothing but comments stands in it.
    pub fn new(text: &'t str) -> Option<TextTable<'t>> {
        // spreadsheets begin their files with a byte order mark
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = text
            .lines()
            .enumerate()
            .map(|(i, line)| (i + 1, line.trim()))
            .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let (header_line, header) = lines.next()?;
        let separator = [',', ';', '\t'].into_iter().find(|s| header.contains(*s)).unwrap_or(',');
        let header = header.split(separator).map(str::trim).collect();
        Some(TextTable { header, header_line, lines: lines.collect(), separator })
    }

    /// The numbers of two columns in every line, with its place (from 1).
    ///
    /// # Errors
    /// The first line with another number of columns than the header, or without a finite number in one of
    /// the two: its place and a sentence for the user.
    pub fn pairs(&self, columns: [usize; 2]) -> Result<Vec<PlacedPair>, (usize, String)> {
        let pair = |&(line, text): &(usize, &str)| {
            let at = |message: String| (line, message);
            let cells: Vec<&str> = text.split(self.separator).map(str::trim).collect();
            if cells.len() != self.header.len() {
                return Err(at(format!(
                    "{} columns where the header has {}: a decimal comma must be a point",
                    cells.len(),
                    self.header.len()
                )));
            }
            let [a, b] = columns.map(|column| number(cells[column]));
            Ok((line, [a.map_err(at)?, b.map_err(at)?]))
        };
        self.lines.iter().map(pair).collect()
    }
}

/// The finite number that a cell holds.
fn number(cell: &str) -> Result<f64, String> {
    cell.parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| {
        format!("`{cell}` is not a finite number: write digits with a decimal point, the unit belongs into the header")
    })
}
