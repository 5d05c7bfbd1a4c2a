//! Columns of a file of an imprint: places and heights, or points x, y, z, by the names that instruments give
//! them.

use asperity_formats::dimension::Dimension;
use asperity_formats::profile::{self, HEIGHT};
use asperity_formats::text::{Asked, Quantity, Separator, SeriesTable, TextError, read_grid, read_series};

/// Distance from the axis, negative on its other side.
const PLACE: Quantity = Quantity { name: "place r", ..profile::PLACE };

/// Height over the far field that counts down.
const DEPTH: Quantity =
    Quantity { called: &["depth", "tiefe", "profondeur", "profondita", "profundidad"], ..HEIGHT };

/// The other place of a point of a map or of a line across it.
const OTHER_PLACE: Quantity = Quantity {
    name: "place y",
    dimension: Dimension::Length,
    called: &["y", "y coordinate", "y position", "y axis", "axis y"],
    example: "y_um",
};

/// Columns of a file of an imprint.
pub enum Table {
    /// Places and heights.
    Profile(SeriesTable<2>),
    /// Points x, y, z.
    Points(SeriesTable<3>),
}

impl Table {
    /// That of `text`.
    ///
    /// # Errors
    /// No columns of places and heights, or those of points with a y that has no unit.
    pub fn new(text: &str) -> Result<Table, TextError> {
        Table::with(text, HEIGHT).or_else(|no_profile| Table::with(text, DEPTH).map_err(|_| no_profile))
    }

    /// That with these heights.
    fn with(text: &str, height: Quantity) -> Result<Table, TextError> {
        let of_points = [PLACE, OTHER_PLACE, height];
        // a list of points has the columns of a profile too
        let no_points = match read_series(text, &of_points, &Asked::default()) {
            Ok(points) => return Ok(Table::Points(points)),
            Err(no_points) => no_points,
        };
        match profile::read(text, [PLACE, height], &Asked::default()) {
            Ok(table) => {
                let without_units = Asked { may_lack_units: true, ..Asked::default() };
                let has_y = read_series(text, &of_points, &without_units).is_ok();
                if has_y { Err(no_points) } else { Ok(Table::Profile(table)) }
            }
            Err(no_profile) => match head_as_rows(text) {
                Some(text) => Table::with(&text, height),
                None => Err(no_profile),
            },
        }
    }
}

/// `text` with a header whose names commas part (`# X in mm, Z in um`) above rows that something else parts.
fn head_as_rows(text: &str) -> Option<String> {
    let grid = read_grid(text, None, None).ok()?;
    let mark = match grid.dialect.separator {
        Separator::Mark(',') => return None,
        Separator::Mark(mark) => mark.to_string(),
        Separator::Blanks => "\t".into(),
    };
    let is_head = |head: &str| head.contains(',') && head.matches(',').count() + 1 == grid.columns;
    let (line, _) = *grid.before.last().filter(|(_, head)| is_head(head))?;
    let part = |(i, row): (usize, &str)| {
        if i + 1 == line { row.replace(',', &mark) } else { row.to_string() }
    };
    Some(text.lines().enumerate().map(part).collect::<Vec<_>>().join("\n"))
}

/// Most columns of a list, and rows per column from which more than three are no map.
const COLUMNS_OF_A_LIST: usize = 8;
const ROWS_OF_A_LIST: usize = 16;
/// Rows from which a column that rises or falls all the way is no chance.
const ROWS_OF_A_PROFILE: usize = 4;
/// Characters of a header that a message shows.
const SHOWN_CHARACTERS: usize = 80;

/// The message on a table that is no map, for its first column rises or falls all the way or it has no
/// other, and that has no columns that are known, as `no_profile` says; `None` where it may be a map.
pub fn unknown_columns(text: &str, no_profile: &TextError) -> Option<String> {
    let grid = read_grid(text, None, None).ok()?;
    let (columns, rows) = (grid.columns, grid.rows());
    if columns.min(rows) == 1 && columns.max(rows) >= ROWS_OF_A_PROFILE {
        return Some(format!(
            "line {}: holds heights without places: write the place of each beside it, in columns headed {},{}",
            grid.lines[0], PLACE.example, HEIGHT.example
        ));
    }
    let is_list = columns <= 3 || columns <= COLUMNS_OF_A_LIST && rows >= ROWS_OF_A_LIST * columns;
    let places: Vec<f64> = grid.values.iter().step_by(columns).copied().collect();
    let goes = |sign: f64| places.windows(2).all(|p| sign * (p[1] - p[0]) > 0.0);
    if !is_list || rows < ROWS_OF_A_PROFILE || !(goes(1.0) || goes(-1.0)) {
        return None;
    }
    let head = grid.before.iter().rev().find(|(_, text)| text.contains(char::is_alphabetic));
    let head = head.map_or("; no line heads them".into(), |(line, text)| {
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let shown: String = words.chars().take(SHOWN_CHARACTERS).collect();
        format!("; line {line} heads them \"{shown}\"")
    });
    Some(format!("is a profile in {columns} columns, but {no_profile}{head}"))
}

#[cfg(test)]
mod tests {
    use crate::imprint_profile::tests::{cone, holds_the_cone, refused};

    #[test]
    fn names_that_instruments_write_are_known() {
        let heads = [
            "Lateral Distance (µm),Vertical (µm)",
            "Horizontal [um],Raw Height [um]",
            "Strecke (µm),Höhe (µm)",
            "Länge [µm],Hoehe [µm]",
            "Distance along profile (um),Elevation (um)",
            "Posizione [um],Quota [um]",
            "Axis X (um),Axis Z (um)",
            "X Position (um),Z Position (um)",
            "位置(µm),高さ(µm)",
            "x [µm],y [µm]",
        ];
        for head in heads {
            holds_the_cone(&cone(head, |_, x, z| format!("{x:.1},{z:.3}")));
        }
        let dektak = "Lateral(µm),Raw(µm),Normalized(µm)";
        holds_the_cone(&cone(dektak, |_, x, z| format!("{x:.1},{z:.3},{z:.3}")));
        for (head, mark) in
            [("# X in mm, Z in um", "\t"), ("# X in mm, Z in um", " "), ("X in mm, Z in um", ";")]
        {
            holds_the_cone(&cone(head, |_, x, z| format!("{:.4}{mark}{z:.3}", 1e-3 * x)));
        }
        let gwyddion = "Profile 1      \nx [µm]          y [nm]          ";
        holds_the_cone(&cone(gwyddion, |_, x, z| format!("{x:.5}  {:.5}", 1e3 * z)));
        // beside another column y is not the height
        refused(&cone("x [µm],y [µm],Q", |_, x, z| format!("{x:.1},{z:.3},1")), &["profile in 3 columns"]);
    }

    #[test]
    fn unknown_columns_of_a_profile_are_shown() {
        let abaqus = cone("Node Label      COORD.COOR1      COORD.COOR2\n-----", |k, x, z| {
            format!("{}      {x:.5}      {z:.5}", k + 1)
        });
        refused(&abaqus, &["a profile in 3 columns", "\"Node Label COORD.COOR1 COORD.COOR2\"", "r_um,z_um"]);
        let alone = cone("Profile data", |_, _, z| format!("{z:.4}"));
        refused(&alone, &["heights without places", "r_um,z_um"]);
    }
}
