//! Columns of a profile: places along it and heights, by the names that instruments and people give them.

use crate::dimension::Dimension;
use crate::heights::refuse_several;
use crate::text::{
    Asked, Dialect, Quantity, SeriesTable, TextError, folded_name, header_cells, header_line, read_series,
    uncommented,
};

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
/// As for [`read_series`]; several columns that may be the height.
pub fn read(text: &str, columns: [Quantity; 2], asked: &Asked<'_, 2>) -> Result<SeriesTable<2>, TextError> {
    let table = read_series(text, &columns, asked)
        .or_else(|no_profile| graph(text, columns, asked).ok_or(no_profile))?;
    if let Some((line, cells)) = heads(text, &columns).filter(|_| asked.columns[1].is_none()) {
        let picked = cells.iter().position(|cell| *cell == table.names[1]);
        picked.map_or(Ok(()), |picked| refuse_several(line, &cells, picked, asked.key))?;
    }
    Ok(table)
}

/// [`read`] of an outline, whose places count from its axis or along one line.
///
/// # Errors
/// As for [`read`]; places in the plane, or along the surface.
pub fn read_outline(text: &str, asked: &Asked<'_, 2>) -> Result<SeriesTable<2>, TextError> {
    let columns = [PLACE, HEIGHT];
    let table = read(text, columns, asked)?;
    let Some((line, cells)) = heads(text, &columns) else { return Ok(table) };
    let name = |cell: &String| folded_name(cell).0;
    let has_x = ["x", "x position", "x coordinate"].contains(&name(&table.names[0]).as_str());
    let is_y = |cell: &String| ["y", "y position", "y coordinate"].contains(&name(cell).as_str());
    let message = if has_x && cells.iter().any(is_y) {
        "names x and y beside the heights: give the distance along the line in one column, or call y otherwise if it does not change"
    } else if ["arc", "arc length", "bogenlange", "path length"].contains(&name(&table.names[0]).as_str()) {
        "gives places along the surface: give the distance from the axis, r"
    } else {
        return Ok(table);
    };
    Err(TextError::new(line, message))
}

/// The line of the header of `columns`, and its cells.
fn heads(text: &str, columns: &[Quantity; 2]) -> Option<(usize, Vec<String>)> {
    let line = header_line(text, columns)?;
    let dialect = Dialect::detect(text, None, false).ok()?;
    let head = text.trim_start_matches('\u{feff}').lines().nth(line - 1)?;
    Some((line, header_cells(&dialect, uncommented(head), None)))
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
        for (text, words) in [
            ("X (um),Z raw (um),Z levelled (um)\n0,2,1\n1,3,1\n", "may both be the heights"),
            ("X (mm);Y (mm);Z (um)\n0;0;1\n1;1;2\n", "in one column"),
            ("Arc length (um),Height (um)\n0,0\n1,1\n", "distance from the axis"),
        ] {
            let fault = read_outline(text, &Asked::default()).unwrap_err();
            assert!(fault.line == Some(1) && fault.message.contains(words), "{text} {fault}");
        }
        assert!(read_outline("r (um),Z (um),Z error (um)\n0,2,1\n1,3,1\n", &Asked::default()).is_ok());
        assert!(read("x [um],y [um],Q\n0,2,1\n1,3,1\n", [PLACE, HEIGHT], &Asked::default()).is_err());
    }
}
