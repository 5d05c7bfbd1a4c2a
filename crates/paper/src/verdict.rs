//! A claim of the paper, and the one rule by which it is judged.

use serde::Serialize;

/// The rule in words, as the page states it.
pub const RULE: &str = "One rule judges every claim. What the paper says is an interval: a printed number within its rounding, a \
    printed range, or one side of a limit (what falls or rises is a difference below or above 0). Ours is an interval too: the \
    value with all that we do not know of it, at 95 %. That is the stated error of the finite elements; the interval of a fit; for \
    areas of zones their scatter over three meshes; for rough surfaces two standard deviations over five generated ones and, because \
    the measured surfaces are known by Ra and slope alone, how far surfaces of the two other kinds with the same Ra and slope lie \
    from them. Intervals that do not meet: contradicted. They meet, and ours reaches nowhere further than 10 % from a printed number \
    or across a limit: borne out. They meet, but ours reaches further, or zones differ by more than 10 % between meshes: cannot be \
    judged. A claim on a range of slopes that holds on a part of it is borne out in part, and its row says where. Of several numbers \
    in one claim the worst counts. Nothing here was adjusted to the paper.";

/// Largest distance of the whole of our interval from a printed number, as a share of the number, and largest
/// difference of areas between meshes.
pub const NEAR: f64 = 0.1;

/// The fate of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Ours agrees.
    BorneOut,
    /// Ours agrees on a part of the range that the paper speaks of.
    BorneOutInPart,
    /// The paper describes no number that can be computed, or what we do not know leaves both open.
    CannotBeJudged,
    /// Ours does not agree.
    Contradicted,
}

impl Verdict {
    /// Every verdict, from the best to the worst.
    pub const ALL: [Verdict; 4] =
        [Verdict::BorneOut, Verdict::BorneOutInPart, Verdict::CannotBeJudged, Verdict::Contradicted];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::BorneOut => "borne out",
            Verdict::BorneOutInPart => "borne out in part",
            Verdict::CannotBeJudged => "cannot be judged",
            Verdict::Contradicted => "contradicted",
        }
    }
}

/// A claim of the paper and its fate.
#[derive(Clone, Debug, Serialize)]
pub struct Claim {
    /// Figure or table it belongs to.
    pub item: &'static str,
    /// The place where the paper says it.
    pub place: &'static str,
    /// The claim itself.
    pub claim: String,
    /// The result of the computation.
    pub ours: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The reason, where there is more to say.
    pub why: String,
}

impl Claim {
    pub(super) fn new(
        (item, place): (&'static str, &'static str),
        claim: impl Into<String>,
        ours: impl Into<String>,
        verdict: Verdict,
        why: impl Into<String>,
    ) -> Claim {
        Claim { item, place, claim: claim.into(), ours: ours.into(), verdict, why: why.into() }
    }
}

/// The paper's statement on a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Said {
    /// A number or a range, its rounding included.
    Within([f64; 2]),
    /// More than this.
    Above(f64),
    /// Less than this.
    Below(f64),
}

impl Said {
    /// A printed number with the unit of its last digit.
    pub fn printed(number: f64, last_digit: f64) -> Said {
        Said::Within([number - 0.5 * last_digit, number + 0.5 * last_digit])
    }

    /// The verdict on `ours`.
    pub fn judge(self, ours: Measured) -> Verdict {
        let [low, high] = ours.interval();
        let ([least, most], slack) = match self {
            Said::Within(said) => (said, NEAR),
            Said::Above(limit) => ([limit, f64::INFINITY], 0.0),
            Said::Below(limit) => ([f64::NEG_INFINITY, limit], 0.0),
        };
        if !(low.is_finite() && high.is_finite()) {
            return Verdict::CannotBeJudged;
        }
        if high < least || low > most {
            return Verdict::Contradicted;
        }
        let room = |end: f64| if end.is_finite() { slack * end.abs() } else { 0.0 };
        let near = low >= least - room(least) && high <= most + room(most);
        if near { Verdict::BorneOut } else { Verdict::CannotBeJudged }
    }
}

/// A value of ours with what is not known of it, at 95 %, absolute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Half of the interval around it.
    pub error: f64,
}

impl Measured {
    /// A value known to a share of itself.
    pub fn known_to(value: f64, share: f64) -> Measured {
        Measured { value, error: (share * value).abs() }
    }

    /// Both ends.
    pub fn interval(self) -> [f64; 2] {
        [self.value - self.error, self.value + self.error]
    }

    /// This less another, independent one.
    pub fn less(self, other: Measured) -> Measured {
        Measured { value: self.value - other.value, error: self.error.hypot(other.error) }
    }
}

/// The worst of several; without any, nothing can be judged.
pub fn worst(verdicts: impl IntoIterator<Item = Verdict>) -> Verdict {
    verdicts.into_iter().max().unwrap_or(Verdict::CannotBeJudged)
}

/// Judges the claim that each value lies below the one before it.
pub fn falls(values: &[Measured]) -> Verdict {
    worst(values.windows(2).map(|w| Said::Below(0.0).judge(w[1].less(w[0]))))
}

/// Judges the claim that each value lies above the one before it.
pub fn rises(values: &[Measured]) -> Verdict {
    worst(values.windows(2).map(|w| Said::Above(0.0).judge(w[1].less(w[0]))))
}

/// Judges the claim that there is a zone, by its area on three meshes: there is where the areas agree within
/// [`NEAR`] of the largest, there is none where all are `least` or smaller, and nothing can be said where
/// they differ or where there are not three.
pub fn zone_is_there(areas: &[f64], least: f64) -> Verdict {
    let (low, high) = areas.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), a| (l.min(*a), h.max(*a)));
    match areas.len() {
        3.. if high <= least => Verdict::Contradicted,
        3.. if low > least && high - low <= NEAR * high => Verdict::BorneOut,
        _ => Verdict::CannotBeJudged,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_decide_and_a_wide_one_of_ours_decides_nothing() {
        let said = Said::printed(5.35, 0.01);
        let judge = |value, error| said.judge(Measured { value, error });
        assert_eq!(judge(5.298, 0.0086), Verdict::Contradicted);
        assert_eq!(judge(5.298, 0.1), Verdict::BorneOut);
        assert_eq!(judge(5.298, 2.0), Verdict::CannotBeJudged);
        assert_eq!(judge(5.298, f64::NAN), Verdict::CannotBeJudged);
        // 44 ± 21 is no 60 to 80, and does not rule it out either
        assert_eq!(
            Said::Within([60.0, 80.0]).judge(Measured { value: 44.4, error: 20.8 }),
            Verdict::CannotBeJudged
        );
        assert_eq!(
            Said::Within([60.0, 80.0]).judge(Measured { value: 70.0, error: 15.0 }),
            Verdict::BorneOut
        );
        assert_eq!(Said::Above(0.6).judge(Measured { value: 0.61, error: 0.02 }), Verdict::CannotBeJudged);
        assert_eq!(Said::Below(0.6).judge(Measured { value: 0.64, error: 0.02 }), Verdict::Contradicted);
    }

    #[test]
    fn an_order_is_judged_step_by_step_with_the_errors_of_both() {
        let of = |values: [f64; 3], error| values.map(|value| Measured { value, error });
        assert_eq!(falls(&of([3.0, 2.0, 1.0], 0.1)), Verdict::BorneOut);
        assert_eq!(rises(&of([3.0, 2.0, 1.0], 0.1)), Verdict::Contradicted);
        assert_eq!(falls(&of([3.0, 2.0, 1.9], 0.1)), Verdict::CannotBeJudged);
        assert_eq!(falls(&[]), Verdict::CannotBeJudged);
    }

    /// A zone is judged where three meshes agree on its area to a tenth, and not where they do not.
    #[test]
    fn areas_that_differ_between_meshes_judge_nothing() {
        assert_eq!(zone_is_there(&[3900.0, 4000.0, 4100.0], 70.0), Verdict::BorneOut);
        assert_eq!(zone_is_there(&[1150.0, 2050.0, 3380.0], 70.0), Verdict::CannotBeJudged);
        assert_eq!(zone_is_there(&[3600.0, 4000.0, 4010.0], 70.0), Verdict::CannotBeJudged);
        assert_eq!(zone_is_there(&[0.0, 6.0, 0.0], 70.0), Verdict::Contradicted);
        assert_eq!(zone_is_there(&[0.0, 600.0, 580.0], 70.0), Verdict::CannotBeJudged);
        assert_eq!(zone_is_there(&[4000.0, 4000.0], 70.0), Verdict::CannotBeJudged);
    }
}
