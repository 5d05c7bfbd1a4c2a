//! Sides of a map and of its pixels, as the words before the heights claim them.

use super::names::{ALONG_A_LINE, HEIGHT, LENGTH, PIXEL, SIZE, WIDTH, X, Y};
use super::remark::Remark;
use crate::dimension::Dimension;
use crate::text::shortened;

/// Largest difference of two claims on one step: that of rounded digits.
const SAME_STEP: f64 = 0.02;

/// Claims on sides, in one unit, in the order of their lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Sides {
    claims: Vec<Claim>,
    /// The one size that was named.
    scan: Option<f64>,
    /// The first line whose meaning is not certain, with the reason.
    doubt: Option<String>,
    /// The first line with two other lengths that does not say which is that along x.
    pair: Option<String>,
}

/// A length that a line claims.
#[derive(Clone, Debug, PartialEq)]
struct Claim {
    /// 0 along x, 1 along y.
    axis: usize,
    /// True of the step, false of the whole side.
    is_step: bool,
    /// True where it is the step across lines only if no line tells that.
    is_else: bool,
    length: f64,
    said: String,
}

/// A line of the file in a message.
pub(super) fn quoted(remark: &Remark) -> String {
    format!("line {} \"{}\"", remark.line, shortened(&remark.text))
}

/// True where the words of a line put y before x, as in `dy x dx`, `[y, x]`; `None` where they name no axes.
fn order_of_axes(text: &str) -> Option<bool> {
    let text = text.to_lowercase();
    let words: Vec<&str> =
        text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let is = |word: &str, axis: &str| word.trim_start_matches(['d', 'δ']) == axis;
    let is_digit = |c: char| c.is_ascii_digit();
    // the x between two sizes, or between y and x, is no axis
    let times = |i: usize| {
        let before = i.checked_sub(1).map_or("", |i| words[i]);
        let after = words.get(i + 1).copied().unwrap_or("");
        let is_size = before.starts_with(is_digit) || Dimension::Length.scale(before).is_some();
        words[i] == "x" && (is_size && after.starts_with(is_digit) || is(before, "y") && is(after, "x"))
    };
    let place = |axis: &str| (0..words.len()).find(|&i| is(words[i], axis) && !times(i));
    Some(place("y")? < place("x")?)
}

impl Sides {
    /// True where nothing is claimed.
    pub fn is_empty(&self) -> bool {
        self.claims.is_empty() && self.scan.is_none()
    }

    /// True of a key that names sides.
    pub fn is_side(key: &str) -> bool {
        PIXEL.contains(&key) || SIZE.contains(&key) || Sides::axis(key, false).is_some()
    }

    /// The side that a key names alone, and whether it is that of a pixel.
    fn axis(key: &str, has_length: bool) -> Option<(usize, bool)> {
        let without = |axis: &str| {
            let rest = key.strip_prefix(axis).or_else(|| key.strip_suffix(axis)).map(str::trim);
            rest.is_some_and(|rest| PIXEL.contains(&rest))
        };
        if X[1..].contains(&key) || without("x") {
            Some((0, true))
        } else if Y[1..].contains(&key) || without("y") {
            Some((1, true))
        } else if WIDTH.contains(&key) {
            Some((0, false))
        } else if Sides::is_second_side(key, has_length) {
            Some((1, false))
        } else {
            None
        }
    }

    /// Takes what the key of `remark` names.
    pub fn take(&mut self, remark: &Remark, lengths: &[f64], has_length: bool) {
        let key = remark.key.as_str();
        let mut lengths = lengths.to_vec();
        if let [x, y] = lengths[..]
            && x != y
        {
            match order_of_axes(&remark.text) {
                Some(true) => lengths.reverse(),
                Some(false) => {}
                None => self.pair = self.pair.take().or_else(|| Some(quoted(remark))),
            }
        }
        let lengths = &lengths[..];
        let Some(&first) = lengths.first() else { return };
        let is_else = |axis| axis == 1 && lengths.len() == 1 && ALONG_A_LINE.contains(&key);
        let mut set = |axis, is_step, length| {
            let said = quoted(remark);
            self.claims.push(Claim { axis, is_step, is_else: is_else(axis), length, said });
        };
        match (PIXEL.contains(&key), lengths) {
            (true, [_] | [_, _]) => {
                set(0, true, first);
                set(1, true, lengths.get(1).copied().unwrap_or(first));
            }
            (false, [_]) if SIZE.contains(&key) => self.scan = self.scan.or(Some(first)),
            (false, [_, second]) if SIZE.contains(&key) => {
                set(0, false, first);
                set(1, false, *second);
            }
            (false, _) if !SIZE.contains(&key) => match (Sides::axis(key, has_length), lengths) {
                (Some((axis, is_step)), [_]) => set(axis, is_step, first),
                (Some(_), _) => self.doubt(remark, "holds several numbers for one side"),
                (None, _) => {}
            },
            _ => self.doubt(remark, "holds more numbers than there are sides"),
        }
    }

    /// The first line with two other lengths that does not say which is that along x.
    pub fn pair(&self) -> Option<&str> {
        self.pair.as_deref()
    }

    /// Keeps the first line whose meaning is not certain.
    pub fn doubt(&mut self, remark: &Remark, why: &str) {
        self.doubt = self.doubt.take().or_else(|| Some(format!("{} {why}", quoted(remark))));
    }

    /// Takes sides that stand in known lines.
    pub fn set_size(&mut self, size: [f64; 2], said: &str) {
        self.claims = [0, 1]
            .map(|axis| Claim { axis, is_step: false, is_else: false, length: size[axis], said: said.into() })
            .into();
    }

    /// True of the name of the side across the width: the length, where width and length are named, and then
    /// no bare height.
    fn is_second_side(key: &str, has_length: bool) -> bool {
        let is_bare = !key.contains(['x', 'y', ' ']);
        if has_length && (is_bare || LENGTH.contains(&key)) {
            LENGTH.contains(&key)
        } else {
            HEIGHT.contains(&key)
        }
    }

    /// True where the claims are the numbers of columns and rows.
    pub fn are_counts(&self, counts: [usize; 2]) -> bool {
        !self.claims.is_empty() && self.claims.iter().all(|c| !c.is_step && c.length == counts[c.axis] as f64)
    }

    /// The one size that was named, where nothing else tells the sides.
    pub fn sole(&self) -> Option<f64> {
        self.scan.filter(|_| self.claims.is_empty())
    }

    /// Distance of the points along x and y of a map of so many columns and rows, the numbers of which are
    /// `uncertain` where empty cells or rows stand at its edges.
    ///
    /// # Errors
    /// The reason why nothing certain can be told of it.
    pub fn steps(
        &self,
        counts: [usize; 2],
        uncertain: [bool; 2],
        aspect: Option<f64>,
    ) -> Result<Option<[f64; 2]>, String> {
        if let Some(doubt) = &self.doubt {
            return Err(doubt.clone());
        }
        if let Some(scan) = self.sole() {
            // square pixels along the longer side, which is that of a line; else the file does not tell
            let ratio = counts[1] as f64 / counts[0] as f64;
            let fits = aspect
                .is_none_or(|aspect| [ratio, 1.0 / ratio].iter().any(|r| (r / aspect - 1.0).abs() < 0.02));
            return Ok((ratio <= 1.0 && fits && !uncertain[0]).then_some([scan / counts[0] as f64; 2]));
        }
        let [x, y] = [self.step(0, counts[0], uncertain[0])?, self.step(1, counts[1], uncertain[1])?];
        match (x, y) {
            (Some(x), Some(y)) => Ok(Some([x, y])),
            (None, None) => Ok(None),
            _ => Err(format!("{} tells one side alone", self.claims[0].said)),
        }
    }

    /// The step along one axis: as a line names it, else the side over the number of points.
    fn step(&self, axis: usize, count: usize, is_uncertain: bool) -> Result<Option<f64>, String> {
        let any = || self.claims.iter().filter(|claim| claim.axis == axis);
        let is_told = any().any(|claim| claim.is_step && !claim.is_else);
        let of_axis = || any().filter(|claim| !(is_told && claim.is_else));
        let Some(best) = of_axis().find(|claim| claim.is_step).or_else(|| of_axis().next()) else {
            return Ok(None);
        };
        let over = |claim: &Claim, count: usize| {
            if claim.is_step { claim.length } else { claim.length / count.max(1) as f64 }
        };
        let step = over(best, count);
        let near = |other: f64| (other / step - 1.0).abs() <= SAME_STEP;
        if let Some(other) = of_axis().find(|c| !near(over(c, count)) && !near(over(c, count - 1))) {
            return Err(format!("{} and {} do not agree for {count} points", best.said, other.said));
        }
        if is_uncertain && !best.is_step {
            let what = ["columns", "rows"][axis];
            return Err(format!("{} is the side of a map with empty {what} at its edge", best.said));
        }
        Ok(Some(step))
    }
}

#[cfg(test)]
mod tests {
    use super::order_of_axes;

    #[test]
    fn words_tell_which_of_two_sides_comes_first() {
        for text in [
            "Pitch (dy x dx): 3 um x 2 um",
            "Pixel pitch (Y, X): 3 um, 2 um",
            "Pixel size (y x x): 3 µm x 2 µm",
            "Spacing [y, x]: 3 um, 2 um",
        ] {
            assert_eq!(order_of_axes(text), Some(true), "{text}");
        }
        for text in ["Pitch (dx x dy): 2 um x 3 um", "Pixel size X, Y: 2, 3 um", "x/y step: 2 um, 3 um"] {
            assert_eq!(order_of_axes(text), Some(false), "{text}");
        }
        for text in ["Pixel size: 2 um x 3 um", "Scan size: 64x48 um", "Pixels: 2 x 3"] {
            assert_eq!(order_of_axes(text), None, "{text}");
        }
    }
}
