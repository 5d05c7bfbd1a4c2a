//! Lines that name the segments of a test: loading, hold, unloading.

use super::super::heading::folded;

/// Names of segments, which may stand before their first reading alone.
const SEGMENTS: [&str; 22] = [
    "load",
    "loading",
    "hold",
    "holding",
    "unload",
    "unloading",
    "segment",
    "approach",
    "surface",
    "reload",
    "reloading",
    "belastung",
    "belasten",
    "entlastung",
    "entlasten",
    "halten",
    "haltezeit",
    "abschnitt",
    "charge",
    "decharge",
    "maintien",
    "creep",
];

/// Those with which a test begins.
const FIRST: [&str; 7] = ["load", "loading", "approach", "surface", "belastung", "belasten", "charge"];

/// Words that may stand beside them.
const BESIDE: [&str; 8] = ["phase", "step", "data", "no", "nr", "number", "curve", "start"];

/// True of the name of a segment: one of them alone, or the word for it beside one, as in `Unload From Peak
/// Segment Type`.
pub(super) fn is_segment(cell: &str) -> bool {
    let name = folded(cell);
    let words: Vec<&str> = name.split([' ', '_']).filter(|word| !word.is_empty()).collect();
    let is_kind = |word: &&str| *word != "segment" && SEGMENTS.contains(word);
    SEGMENTS.contains(&name.as_str())
        || words.contains(&"segment")
            && words.iter().any(|word| is_kind(word) || *word == "end")
            && !name.contains(|c: char| c.is_ascii_digit())
}

/// A line that names a segment and nothing else: `Segment 2`, `Hold`, `[Segment: 3 (Unload)]`; true where it
/// is one with which no test begins.
pub(super) fn named_segment(line: &str) -> Option<bool> {
    // nearly all lines are rows of numbers
    if !line.contains(char::is_alphabetic) {
        return None;
    }
    let plain: String = line.chars().map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
    let words: Vec<String> = plain.split_whitespace().map(folded).collect();
    let numbers: Vec<usize> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let names: Vec<&str> =
        words.iter().map(String::as_str).filter(|word| word.parse::<usize>().is_err()).collect();
    let is_named = names.iter().any(|name| SEGMENTS.contains(name));
    let is_all = names.iter().all(|name| SEGMENTS.contains(name) || BESIDE.contains(name));
    if !is_named || !is_all || numbers.len() > 1 {
        return None;
    }
    Some(match numbers.first() {
        Some(number) => *number > 1,
        None => !names.iter().any(|name| FIRST.contains(name)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_name_a_segment_are_known() {
        let [unload, drift] = ["Unload From Peak Segment Type", "Thermal Drift Hold Segment Type"];
        for cell in [
            "Hold",
            "Load Segment Type",
            unload,
            drift,
            "UNLOAD_FROM_PEAK_SEGMENT",
            "Complete Unload Segment",
        ] {
            assert!(is_segment(cell), "{cell}");
        }
        for cell in ["Peak Load", "Drift", "From Segment 2 on", "n.a.", ""] {
            assert!(!is_segment(cell), "{cell}");
        }
    }

    #[test]
    fn segments_are_told_from_other_words() {
        for line in ["Segment 2", "Hold", "[Segment: 3 (Unload)]", "--- Entlastung ---", "Unloading data"] {
            assert_eq!(named_segment(line), Some(true), "{line}");
        }
        for line in ["Segment 1", "Loading", "[Segment 1 (Load)]", "Load segment"] {
            assert_eq!(named_segment(line), Some(false), "{line}");
        }
        for line in ["Test 2", "Load (mN)", "Hardness 3 GPa", "Hold 10 s at 5 mN", "Maximum load", ""] {
            assert_eq!(named_segment(line), None, "{line}");
        }
    }
}
