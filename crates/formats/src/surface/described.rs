//! Words before the heights of a text file: size, pixels, units, wavelength.

use super::measured::{ReadError, Request, Spacing};
use super::remark::{Remark, number_and_unit};
use crate::dimension::Dimension;
use crate::text::TextError;

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
    height_unit_name: String,
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
    /// A factor of the heights whose meaning is not known, with its line.
    scale: Option<(String, usize)>,
}

/// Sides of a map and of its pixels, in one unit.
#[derive(Clone, Debug, Default, PartialEq)]
struct Sides {
    size: [Option<f64>; 2],
    pixel: [Option<f64>; 2],
    /// The one size that was named.
    scan: Option<f64>,
}

/// Names of sizes and pixels, in small letters without accents.
const WIDTH: &[&str] = &[
    "width",
    "breite",
    "largeur",
    "larghezza",
    "ancho",
    "anchura",
    "largura",
    "šiřka",
    "ширина",
    "幅",
    "너비",
    "宽度",
    "x width",
    "x range",
    "range x",
    "x size",
    "size x",
    "x length",
    "length x",
    "x scan size",
    "scan width",
    "image width",
    "xlength",
    "xsize",
    "lx",
    "x real",
];
const HEIGHT: &[&str] = &[
    "height",
    "hohe",
    "hoehe",
    "hauteur",
    "altezza",
    "alto",
    "altura",
    "vyška",
    "высота",
    "高さ",
    "높이",
    "高度",
    "y width",
    "y range",
    "range y",
    "y size",
    "size y",
    "y length",
    "length y",
    "y scan size",
    "scan height",
    "image height",
    "ylength",
    "ysize",
    "ly",
    "y real",
    "y height",
];
const SIZE: &[&str] =
    &["scan size", "scan range", "field of view", "size", "image size", "fov", "bildgrosse"];
const PIXEL: &[&str] = &[
    "pixel size",
    "pixelsize",
    "pixel",
    "pixel spacing",
    "pixel pitch",
    "lateral resolution",
    "xy calibration",
    "xy kalibrierung",
    "lateral calibration",
    "lateral sampling",
    "pixelgrosse",
    "pixelgroesse",
    "pixelabstand",
    "punktabstand",
    "taille de pixel",
    "taille du pixel",
    "taille pixel",
    "resolution laterale",
    "pas",
    "spacing",
    "sampling interval",
    "sampling distance",
    "sampling step",
    "point spacing",
    "step",
    "step size",
    "grid spacing",
    "xy spacing",
    "dimensione pixel",
    "tamano de pixel",
    "xy pixel size",
    "pixel size xy",
    "camera resolution",
    "pitch",
    "cellsize",
    "cell size",
];
const X: &[&str] =
    &["x", "dx", "pixel width", "delta x", "pas x", "xpixelsize", "x increment", "x scale", "scale x"];
const Y: &[&str] =
    &["y", "dy", "pixel height", "delta y", "pas y", "ypixelsize", "y increment", "y scale", "scale y"];

/// Names of the second side of a map beside its width.
const LENGTH: &[&str] = &["length", "lange", "laenge", "longueur", "lunghezza", "longitud", "comprimento"];
/// Names of the number for points that were not measured.
const MISSING: &[&str] = &[
    "nodata",
    "nodata value",
    "no data value",
    "invalid value",
    "missing value",
    "bad value",
    "void value",
    "fill value",
    "fillvalue",
    "invalid data value",
    "null value",
    "non measured value",
    "ungultiger wert",
    "valeur invalide",
    "valeur manquante",
];

/// Names of the numbers of columns and rows, which stand without a unit.
const COLUMNS: &[&str] = &[
    "x pixels",
    "x pixel",
    "pixels x",
    "nx",
    "ncols",
    "ncolumns",
    "cols",
    "columns",
    "number of columns",
    "dim x",
    "x dim",
    "x points",
    "points x",
    "horizontal",
    "width pixels",
    "width in pixels",
];
const ROWS: &[&str] = &[
    "y pixels",
    "y pixel",
    "pixels y",
    "ny",
    "nrows",
    "rows",
    "number of rows",
    "dim y",
    "y dim",
    "y points",
    "points y",
    "vertical",
    "vertikal",
    "height pixels",
    "height in pixels",
];

impl Described {
    /// Reads the lines before the heights.
    ///
    /// # Errors
    /// Values in a unit that is no length.
    pub fn new(before: &[(usize, &str)], request: &Request<'_>) -> Result<Described, ReadError> {
        let remarks: Vec<Remark> =
            before.iter().filter_map(|&(line, text)| Remark::new(line, text)).collect();
        let mut said = Described::default();
        let has = |names: &[&str], unit: Option<f64>| {
            remarks.iter().any(|r| {
                names.contains(&r.key.as_str()) && r.lengths(unit).first().is_some_and(Option::is_some)
            })
        };
        said.has_length = [None, Some(1.0)].map(|unit| has(WIDTH, unit) && has(LENGTH, unit));
        said.is_spip =
            remarks.iter().any(|r| r.key == "file format" && r.value.eq_ignore_ascii_case("ascii"));
        // units first: a number may stand without one
        for remark in &remarks {
            said.take_unit(remark, request)?;
        }
        if said.is_spip {
            said.lateral_unit = said.lateral_unit.or(Some(1e-9));
        }
        for remark in &remarks {
            said.take_length(remark);
            said.take_count(remark);
            said.take_number(remark);
        }
        if said.sides == Sides::default() {
            said.take_by_place(&remarks);
        }
        Ok(said)
    }

    fn take_unit(&mut self, remark: &Remark, request: &Request<'_>) -> Result<(), ReadError> {
        let key = remark.key.as_str();
        if ["wavelength", "wellenlange", "wellenlaenge", "longueur d'onde"].contains(&key) {
            let length = remark.lengths(Some(1e-9));
            self.wavelength = length.first().copied().flatten();
        }
        let has = |word: &str| key.contains(word);
        if !["unit", "einheit", "unite", "unita", "unidad", "jednotk", "единиц", "単位"]
            .iter()
            .any(|w| has(w))
        {
            return Ok(());
        }
        let unit = remark.value.trim_matches(['(', ')', '[', ']', ' ']);
        let scale = Dimension::Length.scale(unit);
        if ["x ", "y ", "xy ", "lateral", "xunit", "yunit", "unit x", "unit y", "unit xy"]
            .iter()
            .any(|w| key.starts_with(w))
        {
            self.lateral_unit = self.lateral_unit.or(scale);
            return Ok(());
        }
        if self.height_unit.is_some() {
            return Ok(());
        }
        let is_wave = ["wave", "waves", "wv", "wvs", "λ"].contains(&unit.to_lowercase().as_str());
        self.height_unit = if is_wave { self.wavelength } else { scale };
        self.height_unit_name = unit.into();
        let is_of_heights =
            ["value", "z", "height", "data", "wert", "valeur", "valore", "valor"].iter().any(|w| has(w));
        if self.height_unit.is_none() && is_of_heights && !unit.is_empty() && !request.override_file {
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
        Ok(())
    }

    fn take_length(&mut self, remark: &Remark) {
        let lengths: Option<Vec<f64>> = remark.lengths(self.lateral_unit).into_iter().collect();
        match lengths.filter(|lengths| !lengths.is_empty()) {
            Some(lengths) => self.sides.take(&remark.key, &lengths, self.has_length[0]),
            None => self.bare.take(&remark.key, &remark.bare_numbers(), self.has_length[1]),
        }
    }

    /// A whole number of columns or rows: `X pixels = 128`, `Width [px]: 128`, `X size,128,pixel`.
    fn take_count(&mut self, remark: &Remark) {
        const PIXELS: [&str; 7] = ["px", "pix", "pixel", "pixels", "points", "pts", "pt"];
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
        const SCALES: [&str; 8] =
            ["scale", "calibration", "kalibrierung", "factor", "faktor", "multiplier", "scaling", "lsb"];
        const HEIGHTS: [&str; 7] = ["z", "data", "height", "heights", "value", "values", "vertical"];
        let Some((number, rest)) = number_and_unit(&remark.value) else { return };
        let key = remark.key.as_str();
        let has = |names: &[&str]| key.split(' ').any(|word| names.contains(&word));
        if MISSING.contains(&key) && rest.trim().is_empty() {
            self.missing = Some(number);
        } else if key.contains("aspect") {
            let other =
                rest.trim().strip_prefix(':').and_then(number_and_unit).map_or(1.0, |(other, _)| other);
            self.aspect = Some(number / other);
        } else if (has(&SCALES) && has(&HEIGHTS) || key == "bit2nm") && number != 1.0 {
            self.scale = self.scale.take().or(Some((format!("{key} = {}", remark.value), remark.line)));
        }
    }

    /// Makes heights missing that are the number named for such; gives how many.
    pub fn take_missing<'z>(&self, heights: impl Iterator<Item = &'z mut f64>) -> Option<String> {
        let mark = self.missing?;
        let count = heights.filter(|z| **z == mark).map(|z| *z = f64::NAN).count();
        Some(format!("{count} points of {mark} are missing, as the words before the heights say"))
    }

    /// Refuses whole numbers beside a factor whose meaning is not known.
    ///
    /// # Errors
    /// Such a factor.
    pub fn refuse_scale(&self, heights: &[f64], request: &Request<'_>) -> Result<(), ReadError> {
        let Some((said, line)) = self.scale.as_ref().filter(|_| !request.override_file) else {
            return Ok(());
        };
        if heights.iter().any(|z| z.is_finite() && z.fract() != 0.0) {
            return Ok(());
        }
        let problem = format!(
            "says \"{said}\" beside heights that are whole numbers, and not whether they are to be multiplied by it: export \
             heights in a unit of length, or multiply them and delete this line, or set override = true if they are in their \
             unit already"
        );
        Err(TextError::new(*line, problem).into())
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
        Ok(())
    }

    /// Gwyddion writes width, height and unit of the values below each other, in any language.
    fn take_by_place(&mut self, remarks: &[Remark]) {
        for three in remarks.windows(3) {
            let [width, height] = [&three[0], &three[1]].map(|r| r.lengths(None).first().copied().flatten());
            let follow = three[1].line == three[0].line + 1 && three[2].line == three[1].line + 1;
            if let (true, Some(width), Some(height), Some(unit)) =
                (follow, width, height, Dimension::Length.scale(&three[2].value))
            {
                self.sides.size = [Some(width), Some(height)];
                self.height_unit = Some(unit);
                self.height_unit_name.clone_from(&three[2].value);
                return;
            }
        }
    }

    /// Distance of the points of a map of so many columns and rows.
    pub fn spacing(&self, columns: usize, rows: usize) -> Option<Spacing> {
        if let Some(steps) = self.sides.steps(columns, rows, self.aspect) {
            return Some(Spacing::Metres(steps));
        }
        // a width of 3 of a map of 3 columns counts these
        let is_count = self.bare.size == [Some(columns as f64), Some(rows as f64)];
        let steps = self.bare.steps(columns, rows, self.aspect)?;
        (self.sides == Sides::default() && !is_count).then_some(Spacing::Numbers(steps))
    }

    /// The finding, in words.
    pub fn notes(&self) -> Option<String> {
        let found = [
            (self.sides != Sides::default(), "size of the map or of its pixels"),
            (self.height_unit.is_some(), "unit of the heights"),
        ];
        let found: Vec<&str> = found.iter().filter(|(is, _)| *is).map(|(_, what)| *what).collect();
        let square =
            if self.sides.sole().is_some() { ", the one size along a line and pixels square" } else { "" };
        let spip = if self.is_spip { ", sizes in nm where SPIP names no unit" } else { "" };
        (!found.is_empty())
            .then(|| format!("{} from the words before the heights{square}{spip}", found.join(" and ")))
    }
}

impl Sides {
    /// Takes what `key` names.
    fn take(&mut self, key: &str, lengths: &[f64], has_length: bool) {
        let Some(&first) = lengths.first() else { return };
        let second = lengths.get(1).copied().unwrap_or(first);
        let without = |axis: &str| {
            let rest = key.strip_prefix(axis).or_else(|| key.strip_suffix(axis)).map(str::trim);
            rest.is_some_and(|rest| PIXEL.contains(&rest))
        };
        let set = |slot: &mut Option<f64>, value: f64| *slot = slot.or(Some(value));
        if PIXEL.contains(&key) {
            set(&mut self.pixel[0], first);
            set(&mut self.pixel[1], second);
        } else if X[1..].contains(&key) || without("x") {
            set(&mut self.pixel[0], first);
        } else if Y[1..].contains(&key) || without("y") {
            set(&mut self.pixel[1], first);
        } else if SIZE.contains(&key) && lengths.len() == 1 {
            set(&mut self.scan, first);
        } else if SIZE.contains(&key) {
            set(&mut self.size[0], first);
            set(&mut self.size[1], second);
        } else if WIDTH.contains(&key) {
            set(&mut self.size[0], first);
        } else if Sides::is_second_side(key, has_length) {
            set(&mut self.size[1], first);
        }
    }

    /// True of the name of the side across the width: the length, where width and length are named, and then
    /// no bare height.
    fn is_second_side(key: &str, has_length: bool) -> bool {
        let is_bare = !key.contains(['x', 'y', ' ']);
        if has_length && (is_bare || LENGTH.contains(&key)) {
            LENGTH.contains(&key)
        } else {
            HEIGHT.contains(&key)
        }
    }

    /// The one size that was named, where nothing else tells the sides.
    fn sole(&self) -> Option<f64> {
        self.scan.filter(|_| self.size == [None; 2] && self.pixel == [None; 2])
    }

    /// Distance of the points along x and y of a map of so many columns and rows.
    fn steps(&self, columns: usize, rows: usize, aspect: Option<f64>) -> Option<[f64; 2]> {
        if let Some(scan) = self.sole() {
            // square pixels along the longer side, which is that of a line; else the file does not tell
            let ratio = rows as f64 / columns as f64;
            let fits = aspect
                .is_none_or(|aspect| [ratio, 1.0 / ratio].iter().any(|r| (r / aspect - 1.0).abs() < 0.02));
            return (columns >= rows && fits).then_some([scan / columns as f64; 2]);
        }
        let from_size = |k: usize, count: usize| self.size[k].map(|size| size / count as f64);
        let x = self.pixel[0].or_else(|| from_size(0, columns));
        let y = self.pixel[1].or_else(|| from_size(1, rows));
        // one side alone tells of square pixels
        let (x, y) = (x.or(y)?, y.or(x)?);
        (x > 0.0 && y > 0.0).then_some([x, y])
    }
}
