//! The messages of serde in the words of a scene, and the known word nearest to an unknown one.

use crate::scenes;
use strsim::osa_distance as distance;

/// The candidate that `word` was probably meant to be.
pub fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase();
    let near = |c: &&&str| {
        let longer = word.chars().count().max(c.chars().count());
        let starts = word.len() > 2 && (c.starts_with(&word) || word.starts_with(**c));
        starts || distance(&word, c) <= 1 + longer / 4
    };
    // what begins as the word does was meant before what looks like it: slope_deg before shape
    let longer_word = |c: &&&str| word.len() > 2 && c.starts_with(&word);
    candidates.iter().filter(near).min_by_key(|c| (!longer_word(c), distance(&word, c))).copied()
}

/// The two filters of a map.
const WAVES: &str = "surface.s_filter leaves out shorter waves than it says, surface.l_filter longer ones";

/// Keys that are asked for and are none, each with a key of the table it would stand in, the message, and
/// what to do.
const EXPLAINED: [(&str, &str, &str, &str); 7] = [
    (
        "contact",
        "newton_tolerance",
        "the key `contact` is gone",
        "the tool pushes by a penalty, for whose penetration the depth is corrected: leave numerics.contact out",
    ),
    (
        "force",
        "separation",
        "unknown key `force`",
        "give load.pressure = force / area of the map; known here: pressure, separation, unload",
    ),
    (
        "table",
        "hollomon",
        "hardening_law = \"table\" is one of `asperity crush` alone",
        "to a map give yield_stress and hardening_exponent, or the hardness measured on this metal",
    ),
    (
        "hardening_mode",
        "hardening_law",
        "unknown key `hardening_mode`",
        "only `asperity crush` knows kinematic hardening: a loading and an unloading do not tell it from isotropic hardening",
    ),
    ("filter", "s_filter", "unknown key `filter`", WAVES),
    ("lambda_c", "l_filter", "unknown key `lambda_c`", WAVES),
    ("lambda_s", "s_filter", "unknown key `lambda_s`", WAVES),
];

/// The line of a scene of the program that gives the key `field`.
fn example(field: &str) -> Option<String> {
    let gives = |line: &&str| line.split_once('=').is_some_and(|(key, _)| key.trim() == field);
    let line = [scenes::SINGLE_ASPERITY, scenes::SURFACE].into_iter().flat_map(str::lines).find(gives)?;
    Some(format!("for example {}", line.split('#').next().unwrap_or(line).trim()))
}

/// A message of serde in the words of a scene, and help where there is some.
pub fn reword(message: &str) -> (String, Option<String>) {
    // serde quotes names in backticks: `unknown field `colour`, expected one of `symmetry`, `accuracy``
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let what = [("unknown field", "key"), ("unknown variant", "value")];
    let unknown = what.iter().find(|(start, _)| message.starts_with(start));
    if let (Some(_), [word, known @ ..]) = (unknown, quoted.as_slice())
        && let Some((_, _, said, help)) =
            EXPLAINED.iter().find(|(key, table, ..)| key == word && known.contains(table))
    {
        return ((*said).into(), Some((*help).into()));
    }
    match (unknown, quoted.as_slice()) {
        (Some((_, noun)), [word, known @ ..]) => {
            // a file never holds what a program hands in
            let known: Vec<&str> = known.iter().copied().filter(|name| *name != "custom").collect();
            let list = known.join(", ");
            let help = match nearest(word, &known) {
                Some(near) => format!("did you mean `{near}`? Known here: {list}"),
                None => format!("known here: {list}"),
            };
            (format!("unknown {noun} `{word}`"), Some(help))
        }
        (None, [field]) if message.starts_with("missing field") => {
            (format!("`{field}` is missing"), example(field))
        }
        _ => {
            let message = message
                .replace("expected f64", "expected a number without quotes")
                .replace("expected usize", "expected a whole number from 0 up")
                .replace("expected a boolean", "expected true or false");
            (message, None)
        }
    }
}
