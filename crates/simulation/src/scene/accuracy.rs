//! Accuracy that the force must have: a level by name, or a share in percent.

use super::SceneError;
use super::messages::error;
use asperity_material::units::from_text;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

/// Promise on the force: |F/F* - 1| for 0.2 ≤ h/h_peak ≤ 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Accuracy {
    /// 5 %.
    Draft,
    /// 1 %.
    #[default]
    Standard,
    /// 0.2 %.
    Reference,
    /// This share, for example 0.005 for "0.5%".
    Within(f64),
}

/// The accuracies that have a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// 5 %.
    Draft,
    /// 1 %.
    Standard,
    /// 0.2 %.
    Reference,
}

/// Every level with its name, from coarse to fine.
const NAMES: [(&str, Accuracy); 3] =
    [("draft", Accuracy::Draft), ("standard", Accuracy::Standard), ("reference", Accuracy::Reference)];

impl Accuracy {
    /// Largest error of the force that is promised.
    pub fn promise(self) -> f64 {
        match self {
            Accuracy::Draft => 0.05,
            Accuracy::Standard => 0.01,
            Accuracy::Reference => 0.002,
            Accuracy::Within(share) => share,
        }
    }

    /// The allowed range: from 0.2 to 5 %.
    ///
    /// # Errors
    /// A number outside of what was measured; the path is that of the key `accuracy`.
    pub fn check(self) -> Result<(), SceneError> {
        let [finest, coarsest] = [Accuracy::Reference, Accuracy::Draft].map(Accuracy::promise);
        if (finest..=coarsest).contains(&self.promise()) {
            return Ok(());
        }
        Err(error(
            "accuracy",
            format!(
                "must be from {}% (reference) to {}% (draft), not {self}: beyond that no error was measured, so set the numbers of [numerics] by hand",
                percent(finest),
                percent(coarsest)
            ),
        ))
    }

    /// The coarsest level that promises as much, the finest one where none does.
    pub fn level(self) -> Level {
        match self.promise() {
            share if share >= Accuracy::Draft.promise() => Level::Draft,
            share if share >= Accuracy::Standard.promise() => Level::Standard,
            _ => Level::Reference,
        }
    }
}

/// A text that is no accuracy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no accuracy: give draft (5 %), standard (1 %), reference (0.2 %) or a percentage, for example \"0.5%\""
)]
pub struct AccuracyError(String);

impl FromStr for Accuracy {
    type Err = AccuracyError;

    fn from_str(text: &str) -> Result<Accuracy, AccuracyError> {
        if let Some((_, level)) = NAMES.iter().find(|(name, _)| *name == text) {
            return Ok(*level);
        }
        let share = text.strip_suffix('%').and_then(|number| number.trim().parse::<f64>().ok());
        match share {
            Some(percent) if percent > 0.0 && percent.is_finite() => Ok(Accuracy::Within(percent / 100.0)),
            _ => Err(AccuracyError(text.to_string())),
        }
    }
}

impl fmt::Display for Accuracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match NAMES.iter().find(|(_, level)| level == self) {
            Some((name, _)) => f.write_str(name),
            None => write!(f, "{}%", percent(self.promise())),
        }
    }
}

/// The share in percent, without the digits that the division by a hundred has added.
fn percent(share: f64) -> f64 {
    format!("{:.12e}", 100.0 * share).parse().unwrap_or(100.0 * share)
}

impl JsonSchema for Accuracy {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Accuracy".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names = NAMES.map(|(name, _)| name);
        json_schema!({"anyOf": [{"enum": names}, {"type": "string", "pattern": "^[0-9.eE+-]+ *%$"}]})
    }
}

impl Serialize for Accuracy {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Accuracy {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_text(
            deserializer,
            "an accuracy as a string: \"draft\", \"standard\", \"reference\" or a percentage like \"0.5%\"",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_percentages_read_and_write_the_same() {
        for (text, promise) in
            [("draft", 0.05), ("standard", 0.01), ("reference", 0.002), ("0.5%", 0.005), ("0.07%", 0.0007)]
        {
            let accuracy: Accuracy = text.parse().unwrap();
            assert!((accuracy.promise() / promise - 1.0).abs() < 1e-12, "{text}");
            assert_eq!(accuracy.to_string(), text);
        }
        assert_eq!("3 %".parse(), Ok(Accuracy::Within(0.03)));
        for text in ["", "%", "0.5", "-1%", "0%", "nan%", "inf%", "best", "Draft"] {
            assert!(text.parse::<Accuracy>().unwrap_err().to_string().contains("0.5%"), "{text}");
        }
    }

    #[test]
    fn what_was_not_measured_is_refused() {
        for share in [0.002, 0.004, 0.05] {
            Accuracy::Within(share).check().unwrap();
        }
        for share in [0.0019, 0.06] {
            let error = Accuracy::Within(share).check().unwrap_err();
            assert_eq!(error.path, "accuracy");
            assert!(error.message.contains("from 0.2% (reference) to 5% (draft)"), "{error}");
        }
    }

    #[test]
    fn the_level_of_a_number_promises_at_least_as_much() {
        for (share, level) in [
            (0.08, Level::Draft),
            (0.05, Level::Draft),
            (0.03, Level::Standard),
            (0.01, Level::Standard),
            (0.005, Level::Reference),
            (1e-4, Level::Reference),
        ] {
            assert_eq!(Accuracy::Within(share).level(), level);
        }
    }
}
