//! Columns that may all hold the heights of a list of points or of a profile, and heights that are depths.

use crate::text::{TextError, folded, folded_name, shortened};

/// Words of a name of heights.
const HEIGHTS: [&str; 12] = [
    "z",
    "height",
    "heights",
    "hohe",
    "hoehe",
    "hauteur",
    "altezza",
    "altura",
    "topography",
    "elevation",
    "altitude",
    "高さ",
];
/// Words that make it a column of how far heights scatter or may be trusted, of their ends, of what they were
/// or were to be: one without such a word goes before it.
const BESIDE: [&str; 32] = [
    "std",
    "stdev",
    "sd",
    "sigma",
    "error",
    "err",
    "uncertainty",
    "unc",
    "deviation",
    "variance",
    "rms",
    "quality",
    "confidence",
    "intensity",
    "count",
    "valid",
    "mask",
    "rate",
    "min",
    "max",
    "minimum",
    "maximum",
    "raw",
    "uncorrected",
    "unfiltered",
    "roh",
    "brut",
    "nominal",
    "design",
    "target",
    "reference",
    "ref",
];

/// Words that make it another quantity: displacements along z, places of a scanner.
const OF_OTHERS: [&str; 16] = [
    "u",
    "displacement",
    "velocity",
    "force",
    "stress",
    "strain",
    "slope",
    "gradient",
    "curvature",
    "normal",
    "scan",
    "peak",
    "index",
    "pixel",
    "number",
    "unit",
];

/// Words of the column that was measured, beside one that was wanted.
const MEASURED: [&str; 4] = ["measured", "actual", "ist", "gemessen"];

fn has(name: &str, words: &[&str]) -> bool {
    name.split([' ', '.', '\\']).any(|word| words.contains(&word))
}

/// Refuses a header at `line` with columns of heights beside the one that was `picked` of its `cells`:
/// nominal and measured ones, raw and levelled ones. `key` names columns, for the message.
///
/// # Errors
/// Two such columns.
pub(crate) fn refuse_several(
    line: usize,
    cells: &[String],
    picked: usize,
    key: Option<&str>,
) -> Result<(), TextError> {
    let Some(own) = cells.get(picked) else { return Ok(()) };
    let name = |cell: &String| folded_name(cell).0;
    let is_own_beside = has(&name(own), &BESIDE);
    let is_other = |cell: &&String| {
        let other = name(cell);
        let is_height = has(&other, &HEIGHTS) && !has(&other, &OF_OTHERS);
        other != name(own) && is_height && (is_own_beside || !has(&other, &BESIDE))
    };
    let Some(other) = cells.iter().find(is_other) else { return Ok(()) };
    let is_measured = |cell: &&String| has(&name(cell), &MEASURED) && has(&name(cell), &HEIGHTS);
    let example = shortened(cells.iter().find(is_measured).unwrap_or(other));
    let [own, other] = [own, other].map(|cell| shortened(cell));
    let way = key.map_or_else(
        || "keep one of them, or call the others by another name".to_string(),
        |key| format!("say which, like {key} = {{ …, z = \"{example}\" }}"),
    );
    Err(TextError::new(line, format!("\"{own}\" and \"{other}\" may both be the heights: {way}")))
}

/// Words of what points into the material, and those of a title that may stand beside one.
pub(crate) const DEPTHS: [&str; 5] = ["depth", "depths", "tiefe", "tiefen", "profondeur"];
const OF_A_TITLE: [&str; 22] = [
    "map", "channel", "image", "data", "values", "value", "in", "of", "the", "kanal", "bild", "karte",
    "surface", "z", "measured", "unit", "units", "type", "signal", "display", "quantity", "name",
];

/// Refuses a map whose lines `before` the numbers say that these are depths: a title, a channel, a sentence
/// on where z points.
///
/// # Errors
/// Such a line.
pub(crate) fn refuse_depths(before: &[(usize, &str)]) -> Result<(), TextError> {
    let says = |text: &str| {
        let (name, _) = folded_name(text.trim_start_matches(['#', '%', ';', '/', ' ', '"']));
        let sentence = folded(text);
        let has_digit = text.contains(|c: char| c.is_ascii_digit());
        let is_title = !has_digit
            && has(&name, &DEPTHS)
            && name.split(' ').all(|word| DEPTHS.contains(&word) || OF_A_TITLE.contains(&word));
        let points_down = ["into the material", "into the surface", "downward", "downwards", "pointing down"];
        let is_of_z = has(&sentence, &["z", "heights", "positive", "axis"]);
        is_title
            || sentence.starts_with("depth map")
            || is_of_z && points_down.iter().any(|words| sentence.contains(words))
            || sentence.contains("positive") && sentence.contains("below")
    };
    before.iter().find(|(_, text)| says(text)).map_or(Ok(()), |(line, text)| {
        let problem = format!(
            "says that the numbers are depths (\"{}\"), which point down: turn their sign and delete the line, or set override = true if they are heights",
            shortened(text)
        );
        Err(TextError::new(*line, problem))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_columns_of_heights_are_asked_about() {
        let refused = |names: [&str; 4], picked: usize| {
            refuse_several(1, &names.map(str::to_string), picked, Some("columns")).is_err()
        };
        for (third, fourth) in [
            ("Z nominal [um]", "Z measured [um]"),
            ("Z raw", "Z levelled"),
            ("Height", "Height filtered"),
            ("Z", "Z repeat (um)"),
            ("Z std (um)", "Z mean (um)"),
            ("Z min", "Z mean"),
        ] {
            assert!(refused(["X [mm]", "Y [mm]", third, fourth], 2), "{third} {fourth}");
        }
        for other in [
            "Z error (um)",
            "Quality",
            "Height std",
            "z_sd_um",
            "Intensity",
            "Z raw",
            "Z nominal",
            "u_z_um",
            "Scan Z",
        ] {
            assert!(!refused(["x", "y", "z_um", other], 2), "{other}");
        }
        assert!(refused(["x", "y", "Z std", "Z mean"], 2) && !refused(["x", "y", "Z std", "Z mean"], 3));
    }

    #[test]
    fn lines_that_say_that_numbers_are_depths_are_found() {
        for line in [
            "# Depth map, positive values below the reference plane",
            "Channel: Depth",
            "Depth [nm]",
            "z axis points into the material",
            "# Positive = below",
        ] {
            assert_eq!(refuse_depths(&[(3, line)]).unwrap_err().line, Some(3), "{line}");
        }
        for line in
            ["Depth: 64 um", "Width 10 um, depth 8 um", "Bit depth: 16", "Depth of focus 3 um", "Height [nm]"]
        {
            assert_eq!(refuse_depths(&[(3, line)]), Ok(()), "{line}");
        }
    }
}
