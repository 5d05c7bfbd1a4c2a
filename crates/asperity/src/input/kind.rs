//! The command that reads a file, by its keys: for a file that was given to another one.

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

/// A key that tells a kind of file, the kind in words, and its command.
const MARKS: [(&str, &str, &str); 8] = [
    ("surface", "the scene of a rough surface", "rough"),
    ("curve", "a fit of measured curves", "identify"),
    ("slopes_deg", "a sweep over cones", "calibrate"),
    ("vary", "a study", "study"),
    ("scene", "a study", "study"),
    ("asperity", "a scene to be crushed", "crush"),
    ("loading", "a scene to be crushed", "crush"),
    ("symmetry", "a scene to be crushed", "crush"),
];

/// A sentence that names the command for the file `name` of these top keys, where it is not one that holds a
/// `T`.
pub fn of_another_command<T: DeserializeOwned>(table: &DeTable<'_>, name: &str) -> Option<String> {
    let known = known_keys::<T>();
    if known.is_empty() {
        return None;
    }
    let foreign = |key: &str| table.contains_key(key) && known.iter().all(|own| own != key);
    let (_, kind, command) = MARKS.iter().find(|(key, ..)| foreign(key))?;
    Some(format!("this looks like {kind}: asperity {command} {name}"))
}

/// The keys of a `T`, as its refusal of one that no file has lists them; none of a map, which takes all.
fn known_keys<T: DeserializeOwned>() -> Vec<String> {
    let odd = || Spanned::new(0..0, "?".into());
    let table = DeTable::from_iter([(odd(), Spanned::new(0..0, DeValue::Boolean(true)))]);
    let Err(refusal) = T::deserialize(Deserializer::from(Spanned::new(0..0, table))) else {
        return Vec::new();
    };
    let message = refusal.message();
    if !message.starts_with("unknown field") {
        return Vec::new();
    }
    message.split('`').skip(3).step_by(2).map(str::to_string).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::FitFile;
    use crate::study::StudyFile;
    use asperity_calibration::sweep::Sweep;
    use asperity_roughness::scene::Scene as Rough;
    use asperity_simulation::scene::Scene as Crush;

    fn said<T: DeserializeOwned>(text: &str) -> Option<String> {
        of_another_command::<T>(DeTable::parse(text).unwrap().get_ref(), "f.toml")
    }

    #[test]
    fn a_file_of_another_command_is_told_its_own() {
        let files = [
            (crate::scenes::SINGLE_ASPERITY, "crush"),
            (crate::scenes::SURFACE, "rough"),
            (crate::scenes::SWEEP, "calibrate"),
            (crate::scenes::STUDY, "study"),
            (crate::scenes::FIT, "identify"),
        ];
        for (text, command) in files {
            let answers = [
                ("crush", said::<Crush>(text)),
                ("rough", said::<Rough>(text)),
                ("calibrate", said::<Sweep>(text)),
                ("study", said::<StudyFile>(text)),
                ("identify", said::<FitFile>(text)),
            ];
            for (reader, answer) in answers {
                let wanted = (reader != command).then(|| format!(": asperity {command} f.toml"));
                match (answer, wanted) {
                    (Some(answer), Some(wanted)) => assert!(answer.ends_with(&wanted), "{answer}"),
                    (answer, wanted) => assert_eq!(answer, wanted, "{command} read by {reader}"),
                }
            }
        }
        assert_eq!(said::<Crush>("colour = 1"), None);
    }
}
