//! Columns of a profile: places along it and heights, by the names that instruments and people give them.

use crate::dimension::Dimension;
use crate::text::{Asked, Dialect, Quantity, SeriesTable, TextError, read_series};

/// Distance from the axis, or along the profile.
pub const PLACE: Quantity = Quantity {
    name: "place r or x",
    dimension: Dimension::Length,
    called: &[
        "r",
        "x",
        "radius",
        "distance",
        "position",
        "lateral",
        "horizontal",
        "lateral distance",
        "distance along profile",
        "length",
        "scan length",
        "abscissa",
        "x coordinate",
        "x position",
        "x axis",
        "axis x",
        "abstand",
        "strecke",
        "weg",
        "lange",
        "laenge",
        "abszisse",
        "rayon",
        "longueur",
        "abscisse",
        "distanza",
        "posizione",
        "ascissa",
        "distancia",
        "posicion",
        "位置",
        "distance x",
    ],
    example: "r_um",
};

/// Height over it.
pub const HEIGHT: Quantity = Quantity {
    name: "height z",
    dimension: Dimension::Length,
    called: &[
        "z",
        "height",
        "profile",
        "vertical",
        "raw",
        "raw height",
        "topography",
        "elevation",
        "ordinate",
        "z coordinate",
        "z position",
        "z axis",
        "axis z",
        "hohe",
        "hoehe",
        "profil",
        "hauteur",
        "altitude",
        "altezza",
        "quota",
        "altura",
        "高さ",
    ],
    example: "z_um",
};

/// Reads `columns` of places and heights; of a table of nothing but x and y, as Gwyddion exports a profile,
/// y is the height.
///
/// # Errors
/// As for [`read_series`].
pub fn read(text: &str, columns: [Quantity; 2], asked: &Asked<'_, 2>) -> Result<SeriesTable<2>, TextError> {
    read_series(text, &columns, asked).or_else(|no_profile| graph(text, columns, asked).ok_or(no_profile))
}

/// That of a table of nothing but x and y.
fn graph(text: &str, [place, height]: [Quantity; 2], asked: &Asked<'_, 2>) -> Option<SeriesTable<2>> {
    let of_a_graph = [Quantity { called: &["x"], ..place }, Quantity { called: &["y"], ..height }];
    let table = read_series(text, &of_a_graph, asked).ok()?;
    let row = text.lines().nth(table.series.first()?.lines.first()? - 1)?;
    let cells = Dialect::detect(text, None, false).ok()?.cells(row).filter(|cell| !cell.is_empty()).count();
    (cells == 2 * table.series.len()).then_some(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn y_is_a_height_where_it_stands_beside_x_alone() {
        for head in ["x [um],y [um]", "X (um),Y (um)", "Lateral (um),Vertical (um)", "Strecke [um],Höhe [um]"]
        {
            let table = read(&format!("{head}\n0,2\n1,3\n"), [PLACE, HEIGHT], &Asked::default()).unwrap();
            assert!((table.series[0].rows[1][1] - 3e-6).abs() < 1e-15, "{head} {table:?}");
        }
        assert!(read("x [um],y [um],Q\n0,2,1\n1,3,1\n", [PLACE, HEIGHT], &Asked::default()).is_err());
    }
}
