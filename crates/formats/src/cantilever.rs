//! Force curves of atomic force microscopes: their exports hold the way of the piezo and the bending of the
//! cantilever, of which a depth is made.

use crate::text::TextError;

/// Lines in which such a file is known.
const LOOKED_AT: usize = 500;

/// The reason why `text` holds no curve of depth and force, where it is an export of NanoScope or of JPK.
pub(crate) fn refusal(text: &str) -> Option<TextError> {
    let lines = || text.lines().take(LOOKED_AT).enumerate();
    let is_nanoscope =
        |line: &str| line.contains("_Ex") && (line.contains("Ramp_") || line.contains("Defl_"));
    if let Some((i, _)) = lines().find(|(_, line)| is_nanoscope(line)) {
        let message = "is an export of a NanoScope force curve: it holds the way of the piezo (Ramp) and the bending of the cantilever \
                       (Defl), the approach (Ex) beside the retract (Rt), and no depth. Write a table depth_nm,force_nN, first the \
                       rows of Ex, then those of Rt from the deepest on: depth = Ramp - Defl, both in nm from first touch, force = \
                       Defl in nN";
        return Some(TextError::new(i + 1, message));
    }
    let remark = |name: &'static str| {
        let words = move |(i, line): (usize, &'_ str)| {
            let rest = line.trim_start_matches(['#', ' ']).strip_prefix(name)?;
            Some((i + 1, rest.split_whitespace().map(str::to_string).collect::<Vec<String>>()))
        };
        lines().find_map(words)
    };
    let (line, columns) =
        remark("columns:").filter(|(_, names)| names.iter().any(|name| name == "vDeflection"))?;
    let units = remark("units:").map(|(_, units)| units).unwrap_or_default();
    let column = |name: &str, unit: &str| {
        let place = columns.iter().position(|column| column == name)?;
        units.get(place).is_some_and(|found| found == unit).then(|| format!("{} [{unit}]", place + 1))
    };
    let message = match (column("verticalTipPosition", "m"), column("vDeflection", "N")) {
        (Some(depth), Some(force)) => format!(
            "is a force curve of JPK, whose tip moves down into the metal: columns = {{ depth = \"-{depth}\", force = \"{force}\" }} takes \
             it; the position of the tip must count from first touch"
        ),
        _ => "is a force curve of JPK without the position of the tip in m and the deflection in N: calibrate it, correct the height for \
              the bending of the cantilever (tip position), count from the contact point, and export it again"
            .into(),
    };
    Some(TextError::new(line, message))
}
