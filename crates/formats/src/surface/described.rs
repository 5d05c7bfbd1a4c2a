//! Words before the heights of a text file: size, pixels, units, wavelength.

use super::factor::Factor;
use super::measured::{ReadError, Request, Spacing};
use super::names::{
    COLUMNS, HEIGHT, LENGTH, MISSING, OF_HEIGHTS, OF_LENGTHS, OF_NOTHING, OF_THE_CAMERA, RESOLUTION, ROWS,
    UNIT, WIDTH,
};
use super::remark::{Remark, has_decimal_comma, number_and_unit};
use super::sides::{Sides, quoted};
use crate::dimension::Dimension;
use crate::text::{Decimal, Grid, Separator, TextError, folded_name, uncommented};

/// Statements of the file on its heights, lengths in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Described {
    /// Metres per unit of height.
    pub height_unit: Option<f64>,
    /// Metres per unit of places along the surface.
    pub lateral_unit: Option<f64>,
    /// Sides in metres, and those that stand without a unit.
    sides: Sides,
    bare: Sides,
    wavelength: Option<f64>,
    /// Metres per unit along x and y.
    units: [Option<f64>; 2],
    /// True where the unit of heights is said to be theirs.
    is_of_heights: bool,
    /// True where the file names a unit, and not of its heights alone.
    pub has_one_unit: bool,
    /// The mark before decimals, where anything tells it.
    decimal: Option<Decimal>,
    /// Whole numbers of the words, with their lines.
    whole: Vec<(usize, usize)>,
    /// Columns and rows of the map, with the line that names them.
    counts: [Option<(usize, usize)>; 2],
    /// The ratio of the sides of the map.
    aspect: Option<f64>,
    /// True where width and length are the sides, so that a height is one along z: with units, and without.
    has_length: [bool; 2],
    /// True where sizes without a unit are in nm, as SPIP writes them.
    is_spip: bool,
    /// The number for a point that was not measured.
    missing: Option<f64>,
    /// The first factor of the heights whose meaning is not known.
    factor: Option<Factor>,
}

impl Described {
    /// Reads the lines before the heights; `first` is the first line of these.
    ///
    /// # Errors
    /// Values in a unit that is no length; two units of the heights.
    pub fn new(grid: &Grid<'_>, first: &str, request: &Request<'_>) -> Result<Described, ReadError> {
        let remarks = Remark::list(grid);
        let mut said = Described { decimal: decimal_of(grid, first, &remarks), ..Described::default() };
        let place = |names: &[&str], unit: Option<f64>| {
            remarks.iter().position(|r| {
                let lengths = || r.lengths(&r.numbers(said.decimal), unit);
                names.contains(&r.key.as_str()) && lengths().first().is_some_and(Option::is_some)
            })
        };
        let sides = [None, Some(1.0)].map(|unit| (place(WIDTH, unit), place(LENGTH, unit)));
        said.has_length = sides.map(|(width, length)| width.is_some() && length.is_some());
        said.is_spip =
            remarks.iter().any(|r| r.key == "file format" && r.value.eq_ignore_ascii_case("ascii"));
        // units first: a number may stand without one
        for remark in &remarks {
            said.take_unit(remark, request)?;
        }
        said.take_title(&grid.before);
        said.take_list(grid);
        let sentences = || grid.before.iter().find_map(|(line, text)| Factor::of_sentence(*line, text));
        said.factor = said.factor.take().or_else(sentences);
        let [x, y] = said.units;
        said.lateral_unit = match (x, y) {
            (Some(x), Some(y)) => Some(x).filter(|_| x == y),
            (x, y) => x.or(y),
        };
        if said.is_spip {
            said.lateral_unit = said.lateral_unit.or(Some(1e-9));
        }
        for remark in &remarks {
            said.take_length(remark);
            said.take_count(remark);
            said.take_number(remark);
        }
        let resolution = remarks.iter().find(|r| RESOLUTION.contains(&r.key.as_str()));
        if let Some(remark) = resolution.filter(|_| said.sides.is_empty() && said.bare.is_empty()) {
            said.bare.doubt(remark, "may be the resolution of the optics or the pixel");
        }
        if let (Some(width), Some(length)) = sides[1]
            && length < width
        {
            let why = "stands before the width, and may be the side along x or across";
            said.sides.doubt(&remarks[length], why);
            said.bare.doubt(&remarks[length], why);
        }
        if said.sides.is_empty() {
            said.take_by_place(grid, &remarks);
        }
        Ok(said)
    }

    /// A unit of heights or of lengths along the surface, by the words that stand with it.
    fn take_unit(&mut self, remark: &Remark, request: &Request<'_>) -> Result<(), ReadError> {
        let key = remark.key.as_str();
        if ["wavelength", "wellenlange", "wellenlaenge", "longueur d'onde"].contains(&key) {
            let length = remark.lengths(&remark.numbers(self.decimal), Some(1e-9));
            self.wavelength = length.first().copied().flatten();
        }
        let Some(words) = words_of_unit(key) else { return Ok(()) };
        let has = |names: &[&str]| words.iter().any(|word| names.contains(word));
        let unit = remark.value.trim_matches(['(', ')', '[', ']', ' ']);
        let scale = Dimension::Length.scale(unit);
        if has(OF_LENGTHS) {
            let is_of = [has(&["x"]), has(&["y"])];
            let is_of = if is_of == [false; 2] { [true; 2] } else { is_of };
            for (slot, _) in self.units.iter_mut().zip(is_of).filter(|(_, is_of)| *is_of) {
                *slot = slot.or(scale);
            }
            return Ok(());
        }
        let is_of_heights = has(OF_HEIGHTS);
        if !is_of_heights && !words.iter().all(|word| OF_NOTHING.contains(word)) {
            return Ok(());
        }
        let is_wave = ["wave", "waves", "wv", "wvs", "λ"].contains(&unit.to_lowercase().as_str());
        let scale = if is_wave { self.wavelength } else { scale };
        if is_of_heights && scale.is_none() && !unit.is_empty() && !request.override_file {
            let problem = if is_wave {
                "says that its values are in waves, but not how long one is: give height_unit".to_string()
            } else {
                format!(
                    "says that its values are in \"{unit}\", which is not known as a unit of length (one of {}): export the channel of heights, or set override = true and height_unit",
                    Dimension::Length.units()
                )
            };
            return Err(TextError::new(remark.line, problem).into());
        }
        self.has_one_unit |= !is_of_heights && scale.is_some();
        match (self.height_unit, scale) {
            (Some(known), Some(other)) if is_of_heights && self.is_of_heights && known != other => {
                let problem = format!(
                    "says that heights are in \"{unit}\", but a line above names another unit: delete the wrong one"
                );
                return Err(TextError::new(remark.line, problem).into());
            }
            // one of heights goes before one of anything
            (Some(_), _) if !is_of_heights || self.is_of_heights => {}
            _ => (self.height_unit, self.is_of_heights) = (scale.or(self.height_unit), is_of_heights),
        }
        Ok(())
    }

    /// The units of a list of names: `X [µm], Y [µm], Z [nm]` or `x/y in mm; z in nm`.
    /// Names above as many columns are those of points.
    fn take_list(&mut self, grid: &Grid<'_>) {
        for (_, text) in &grid.before {
            if grid.dialect.cells(text).count() == grid.columns {
                continue;
            }
            let text = uncommented(text);
            let one = |piece: &str| {
                let bracketed = || piece.split_once(['[', '(']);
                let (name, unit) = piece.split_once(" in ").or_else(bracketed)?;
                let axis = name.trim().rsplit(' ').next().unwrap_or("").to_lowercase();
                Some((axis, Dimension::Length.scale(unit.trim_matches([']', ')', ' ']))?))
            };
            // "X, Y in mm": an axis without a unit is in that of the next one
            let mut named: Vec<(String, f64)> = Vec::new();
            let mut waiting: Vec<String> = Vec::new();
            for piece in text.split([',', ';', '\t']) {
                match one(piece) {
                    Some((axis, unit)) => {
                        named.extend(waiting.drain(..).map(|axis| (axis, unit)));
                        named.push((axis, unit));
                    }
                    None => waiting.push(piece.trim().to_lowercase()),
                }
            }
            let of = |names: &[&str]| named.iter().find(|(axis, _)| names.contains(&&**axis)).map(|n| n.1);
            let (both, z) = (of(&["x/y", "xy"]), of(&["z"]));
            if let (Some(x), Some(y), Some(z)) = (both.or(of(&["x"])), both.or(of(&["y"])), z) {
                self.units = [self.units[0].or(Some(x)), self.units[1].or(Some(y))];
                self.height_unit = self.height_unit.or(Some(z));
                self.is_of_heights = true;
            }
        }
    }

    /// The unit of a title: `Height [nm]`, `z: um`, `Heights in nm`.
    fn take_title(&mut self, before: &[(usize, &str)]) {
        const LONGEST_TITLE: usize = 80;
        // a spreadsheet fills the line up to the width of the table
        let bare = before.iter().map(|(line, text)| (line, text.trim_end_matches([',', ';', '\t', ' '])));
        for (line, bare) in bare.filter(|(_, text)| text.len() < LONGEST_TITLE) {
            let text = uncommented(bare).replace([':', '='], " ");
            let (name, unit) = folded_name(&text);
            let scale = unit.and_then(|unit| Dimension::Length.scale(&unit));
            let mut words = name.split(' ');
            let is_title = words.clone().all(|word| OF_HEIGHTS.contains(&word) || OF_NOTHING.contains(&word))
                && words.any(|word| OF_HEIGHTS.contains(&word));
            // Height: 1 um and Height (mm): 1 are a side, Heights in 0.1 um has a factor
            let marks = [':', '=', '\t', ';', ',', '[', '('];
            let outside = [bare.split(['[', '(']).next(), bare.rsplit([']', ')']).next()];
            let has_number =
                outside.into_iter().flatten().any(|part| part.contains(|c: char| c.is_ascii_digit()));
            if !is_title || scale.is_none() || has_number && bare.contains(marks) {
                continue;
            }
            // a unit of heights goes before one of anything
            if self.height_unit.is_none() || !self.is_of_heights {
                (self.height_unit, self.is_of_heights) = (scale, true);
            }
            let factor = has_number.then(|| Factor::of_title(*line, &text));
            self.factor = self.factor.take().or(factor);
        }
    }

    fn take_length(&mut self, remark: &Remark) {
        let key = remark.key.as_str();
        if !Sides::is_side(key) && !LENGTH.contains(&key) {
            return;
        }
        let text = remark.text.to_lowercase();
        if OF_THE_CAMERA.iter().any(|word| text.contains(word)) {
            return;
        }
        let numbers = remark.numbers(self.decimal);
        if numbers.is_range || numbers.list.iter().any(|(number, _)| number.is_nan()) {
            let why = if numbers.is_range {
                "may tell places or a side"
            } else {
                "may be a thousand or a fraction"
            };
            let sides =
                if remark.lengths(&numbers, None).is_empty() { &mut self.bare } else { &mut self.sides };
            return sides.doubt(remark, why);
        }
        let lengths: Option<Vec<f64>> = remark.lengths(&numbers, self.lateral_unit).into_iter().collect();
        match lengths {
            Some(lengths) if !lengths.is_empty() => self.sides.take(remark, &lengths, self.has_length[0]),
            _ => self.bare.take(remark, &remark.bare_numbers(&numbers), self.has_length[1]),
        }
    }

    /// A whole number of columns or rows: `X pixels = 128`, `Width [px]: 128`, `X size,128,pixel`.
    fn take_count(&mut self, remark: &Remark) {
        const PIXELS: [&str; 8] = ["px", "pxl", "pix", "pixel", "pixels", "points", "pts", "pt"];
        let mut words = remark.value.split([' ', ',', '(', '[']).filter(|word| !word.is_empty());
        let Some(Ok(count)) = words.next().map(str::parse::<usize>) else { return };
        let unit = remark.key_unit.as_deref().or(words.next()).map(|word| word.trim_end_matches([']', ')']));
        let key = remark.key.as_str();
        let is_of_pixels = unit.is_some_and(|unit| PIXELS.contains(&unit.to_lowercase().as_str()));
        if unit.is_some() && !is_of_pixels {
            return;
        }
        for (slot, names, sizes) in [(0, COLUMNS, WIDTH), (1, ROWS, HEIGHT)] {
            if names.contains(&key) || is_of_pixels && sizes.contains(&key) {
                self.counts[slot] = self.counts[slot].or(Some((count, remark.line)));
            }
        }
    }

    /// A mark of missing points, a ratio of sides, a factor of heights.
    fn take_number(&mut self, remark: &Remark) {
        let numbers = remark.numbers(self.decimal);
        let is_whole = |number: &&(f64, Option<String>)| number.0 >= 2.0 && number.0.fract() == 0.0;
        // a line of many numbers holds places
        const MOST_IN_WORDS: usize = 6;
        if numbers.list.len() <= MOST_IN_WORDS {
            let whole = numbers.list.iter().filter(is_whole);
            self.whole.extend(whole.map(|(number, _)| (remark.line, *number as usize)));
        }
        let Some((number, rest)) = number_and_unit(&remark.value) else { return };
        let key = remark.key.as_str();
        let is_bare =
            rest.trim().is_empty() || rest.trim().starts_with('(') || Dimension::Length.scale(rest).is_some();
        if MISSING.contains(&key) && is_bare {
            self.missing = Some(number);
        } else if key.contains("aspect") {
            let other =
                rest.trim().strip_prefix(':').and_then(number_and_unit).map_or(1.0, |(other, _)| other);
            self.aspect = Some(number / other);
        } else {
            let factor = Factor::of_key(remark, number, rest);
            self.factor = self.factor.take().or(factor);
        }
    }

    /// Makes heights missing that are the number named for such; gives how many.
    pub fn take_missing<'z>(&self, heights: impl Iterator<Item = &'z mut f64>) -> Option<String> {
        let mark = self.missing?;
        let count = heights.filter(|z| **z == mark).map(|z| *z = f64::NAN).count();
        // no number of this size is a height, whatever the words say
        let is_plain = count > 0 || mark.abs() < 1e30;
        is_plain.then(|| format!("{count} points of {mark} are missing, as the words before the heights say"))
    }

    /// Refuses heights beside a factor, and whole numbers beside a step, whose meaning is not known.
    ///
    /// # Errors
    /// Such a factor.
    pub fn refuse_factor(&self, heights: &[f64], request: &Request<'_>) -> Result<(), ReadError> {
        self.factor.as_ref().map_or(Ok(()), |factor| factor.refuse(heights, request))
    }

    /// The number of columns that the words name, where each row of the map is broken into several lines of
    /// the file, as grids of geographers may be.
    pub fn columns_of_broken_rows(&self, grid: &Grid<'_>) -> Option<usize> {
        let [Some((columns, _)), Some((rows, _))] = self.counts else { return None };
        let is_whole = columns.checked_mul(rows) == Some(grid.values.len());
        (is_whole && columns > grid.columns && columns % grid.columns == 0).then_some(columns)
    }

    /// Compares the columns and rows that the words name with those that were found.
    ///
    /// # Errors
    /// Others than were found.
    pub fn refuse_counts(&self, columns: usize, rows: usize, request: &Request<'_>) -> Result<(), ReadError> {
        for (said, found, what) in [(self.counts[0], columns, "columns"), (self.counts[1], rows, "rows")] {
            if let Some((count, line)) = said.filter(|(count, _)| *count != found && !request.override_file) {
                let problem = format!(
                    "says {count} {what}, but {found} were found (the map has {columns} columns and {rows} rows): remove \
                     {what} that hold no heights, correct this line or delete it, or set override = true"
                );
                return Err(TextError::new(line, problem).into());
            }
        }
        // two numbers that multiply to the count of heights are those of columns and rows
        let is_other = |two: &&[(usize, usize)]| {
            let ((first, a), (second, b)) = (two[0], two[1]);
            second - first <= 1
                && a.checked_mul(b) == Some(columns * rows)
                && ![[columns, rows], [rows, columns]].contains(&[a, b])
        };
        match self.whole.windows(2).find(is_other) {
            Some(two) if !request.override_file => {
                let ((line, a), (_, b)) = (two[0], two[1]);
                let problem = format!(
                    "says {a} and {b}, which is the number of heights, but they stand in {rows} lines of {columns}: write \
                     each row of the map in one line, correct this line or delete it, or set override = true"
                );
                Err(TextError::new(line, problem).into())
            }
            _ => Ok(()),
        }
    }

    /// Gwyddion writes its channel, width, height and unit of the values below each other, each behind #, in
    /// any language. Other programs may write other lengths so: those of square pixels, or in words that are
    /// not in plain letters, are taken.
    fn take_by_place(&mut self, grid: &Grid<'_>, remarks: &[Remark]) {
        let lines: Vec<&(usize, &str)> = grid.before.iter().filter(|(_, text)| !text.is_empty()).collect();
        let [_, width, height, unit] = remarks else { return };
        if lines.len() != 4 || !lines.iter().all(|(_, text)| text.starts_with('#')) {
            return;
        }
        let length = |remark: &Remark| match remark.lengths(&remark.numbers(self.decimal), None)[..] {
            [length] => length,
            _ => None,
        };
        let (Some(x), Some(y), Some(scale)) =
            (length(width), length(height), Dimension::Length.scale(&unit.value))
        else {
            return;
        };
        let ratio = x / y * grid.rows() as f64 / grid.columns as f64;
        if (ratio - 1.0).abs() < 0.01 || !width.key.is_ascii() && !height.key.is_ascii() {
            self.sides.set_size([x, y], &quoted(width));
            self.height_unit = Some(scale);
        }
    }

    /// Distance of the points of a map of so many columns and rows, and the reason where lines on it are not
    /// certain; `uncertain` where empty cells stand at the edges.
    pub fn spacing(&self, counts: [usize; 2], uncertain: [bool; 2]) -> (Option<Spacing>, Option<String>) {
        if let Some(doubt) = self.rows_first(counts) {
            return (None, Some(format!("{doubt}: no size was taken from it")));
        }
        let found = match self.sides.steps(counts, uncertain, self.aspect) {
            Ok(Some(steps)) => return (Some(Spacing::Metres(steps)), None),
            // a width of 3 of a map of 3 columns counts these
            Ok(None) if self.sides.is_empty() && !self.bare.are_counts(counts) => {
                self.bare.steps(counts, uncertain, self.aspect)
            }
            Ok(None) => return (None, None),
            Err(doubt) => Err(doubt),
        };
        match found {
            Ok(steps) => (steps.map(Spacing::Numbers), None),
            Err(doubt) => (None, Some(format!("{doubt}: no size was taken from it"))),
        }
    }

    /// The doubt about two sides where the words name rows before columns.
    fn rows_first(&self, [columns, rows]: [usize; 2]) -> Option<String> {
        let are = |a: usize, b: usize| {
            self.whole.windows(2).any(|two| two[0].0 == two[1].0 && [two[0].1, two[1].1] == [a, b])
        };
        let pair = self.sides.pair().or(self.bare.pair())?;
        (columns != rows && are(rows, columns) && !are(columns, rows)).then(|| {
            format!("{pair} may name y first, as the words name {rows} rows before {columns} columns")
        })
    }

    /// The finding, in words.
    pub fn notes(&self, has_size: bool) -> Option<String> {
        let found = [
            (has_size, "size of the map or of its pixels"),
            (self.height_unit.is_some(), "unit of the heights"),
        ];
        let found: Vec<&str> = found.iter().filter(|(is, _)| *is).map(|(_, what)| *what).collect();
        let square = if has_size && self.sides.sole().is_some() {
            ", the one size along a line and pixels square"
        } else {
            ""
        };
        let spip = if self.is_spip { ", sizes in nm where SPIP names no unit" } else { "" };
        (!found.is_empty())
            .then(|| format!("{} from the words before the heights{square}{spip}", found.join(" and ")))
    }
}

/// The mark before decimals: as the heights are written, else as a number of the words can only be.
fn decimal_of(grid: &Grid<'_>, first: &str, remarks: &[Remark]) -> Option<Decimal> {
    let has_comma = |r: &Remark| {
        r.value
            .split([' ', 'x', '×'])
            .any(|word| word.starts_with(|c: char| c.is_ascii_digit()) && has_decimal_comma(word))
    };
    if grid.dialect.decimal == Decimal::Comma {
        Some(Decimal::Comma)
    } else if first.contains('.') || grid.dialect.separator == Separator::Mark(',') {
        Some(Decimal::Point)
    } else {
        remarks.iter().any(has_comma).then_some(Decimal::Comma)
    }
}

/// The words beside that for a unit in a key; `None` where it names no unit.
fn words_of_unit(key: &str) -> Option<Vec<&str>> {
    let mut is_unit = false;
    let words = key.split([' ', '.', '(', ')']).map(|word| {
        let stem = UNIT.iter().find(|stem| word.contains(*stem));
        is_unit |= stem.is_some();
        match stem.and_then(|stem| word.split_once(stem)) {
            Some((before, "" | "s" | "en")) => before,
            Some(("", after)) => after,
            _ => word,
        }
    });
    let words: Vec<&str> = words.collect();
    is_unit.then_some(words)
}
