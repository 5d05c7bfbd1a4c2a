//! Colours, and scales cut into bands of one colour each: even in lightness, legible to colour-blind people
//! and in grey.

use super::scale;
use asperity_roughness::Closure;

/// Red, green, blue.
pub type Colour = [u8; 3];

/// Colours of lines in order of use: blue, vermilion, green, purple, orange, sky, black (Okabe and Ito's
/// palette).
pub const LINES: [Colour; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233], [0, 0, 0]];
/// Colour of a closure that a program passes in.
const CUSTOM: Colour = [120, 80, 40];
/// Lines of axes and letters.
pub const INK: Colour = [40, 40, 40];
/// Lines of a grid.
pub const GRID: Colour = [225, 225, 225];
/// "viridis": rising lightness.
pub const VIRIDIS: [Colour; 9] = [
    [68, 1, 84],
    [71, 45, 123],
    [59, 82, 139],
    [44, 114, 142],
    [33, 145, 140],
    [40, 174, 128],
    [94, 201, 98],
    [173, 220, 48],
    [253, 231, 37],
];
/// "inferno": rising lightness from black.
pub const INFERNO: [Colour; 7] = [
    [10, 8, 35],
    [66, 10, 104],
    [132, 32, 107],
    [188, 55, 84],
    [229, 92, 48],
    [251, 155, 6],
    [252, 255, 164],
];
/// From 0 to the largest pressure.
const COMPRESSION: [Colour; 4] = [[245, 245, 245], [143, 205, 193], [39, 125, 117], [0, 60, 48]];
/// From 0 to the largest tension.
const TENSION: [Colour; 3] = [[245, 245, 245], [216, 179, 101], [140, 81, 10]];
/// Material that never yielded.
pub const ELASTIC: Colour = [222, 228, 234];
/// Zones of Fig. 5: never yielded, has yielded and is elastic now, yields; and the line of the first yield
/// stress.
pub const ZONES: [Colour; 4] = [[0, 114, 178], [240, 180, 60], [226, 226, 226], [20, 20, 20]];
/// Regimes of a rough contact: none, elastic, elastoplastic, plastic.
pub const REGIMES: [Colour; 4] = [[236, 236, 236], [0, 114, 178], [240, 180, 30], [213, 60, 20]];

/// The colour of a closure in every picture.
pub fn closure(closure: Closure) -> Colour {
    LINES.get(closure as usize).copied().unwrap_or(CUSTOM)
}

/// A colour as SVG writes it.
pub fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The colour at `share` (0 to 1) of the way through `stops`.
pub fn interpolated(stops: &[Colour], share: f64) -> Colour {
    let place = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let k = (place as usize).min(stops.len() - 2);
    let t = place - k as f64;
    [0, 1, 2].map(|i| {
        (f64::from(stops[k][i]) + t * (f64::from(stops[k + 1][i]) - f64::from(stops[k][i]))).round() as u8
    })
}

/// `count` colours from the first of `stops` to the last.
fn shades(stops: &[Colour], count: usize) -> Vec<Colour> {
    (0..count).map(|i| interpolated(stops, (i as f64 + 0.5) / count as f64)).collect()
}

/// A scale cut into bands of one colour each.
pub struct Bands {
    /// Rising ends of the bands; the first band begins at the first.
    pub edges: Vec<f64>,
    /// A colour for each band.
    pub colours: Vec<Colour>,
    /// Numbers beside the scale, each at its share (0 to 1) of the scale's length.
    pub labels: Vec<(f64, String)>,
}

impl Bands {
    /// Equal bands from 0 to at least `most`.
    pub fn rising(most: f64) -> Bands {
        let most = if most > 0.0 { most } else { 1.0 };
        let step = scale::round_step(most, 26.0);
        let count = (most / step - 1e-9).ceil().max(1.0) as usize;
        let edges: Vec<f64> = (0..=count).map(|i| i as f64 * step).collect();
        Bands { labels: linear_labels(&edges), edges, colours: shades(&VIRIDIS, count) }
    }

    /// Equal bands from `low` (or 0) to `high` (or 0), with another hue below 0.
    pub fn about_zero([low, high]: [f64; 2]) -> Bands {
        let (low, high) = (low.min(0.0), high.max(0.0));
        let step = scale::round_step((high - low).max(f64::MIN_POSITIVE), 26.0);
        let (first, last) = ((low / step + 1e-9).floor() as i64, (high / step - 1e-9).ceil() as i64);
        let edges: Vec<f64> = (first..=last.max(first + 1)).map(|i| i as f64 * step).collect();
        let colour = |middle: f64| {
            if middle > 0.0 {
                interpolated(&COMPRESSION, middle / high)
            } else {
                interpolated(&TENSION, middle / low)
            }
        };
        let colours = edges.windows(2).map(|band| colour(0.5 * (band[0] + band[1]))).collect();
        Bands { labels: linear_labels(&edges), edges, colours }
    }

    /// Bands of plastic strain in steps of about 2, up to at least `most`; below the first the material
    /// counts as elastic.
    pub fn strain(most: f64) -> Bands {
        const LEVELS: [f64; 13] =
            [0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0];
        let count = LEVELS.iter().position(|l| *l >= most).unwrap_or(LEVELS.len() - 1).max(1);
        let edges = LEVELS[..=count].to_vec();
        let label =
            |(i, e): (usize, &f64)| (i as f64 / count as f64, format!("{}", (1e4 * e).round() / 100.0));
        // low strain dark on the pale elastic material, high strain bright
        Bands {
            labels: edges.iter().enumerate().map(label).collect(),
            edges,
            colours: shades(&VIRIDIS, count),
        }
    }

    /// So many equal bands from `low` to `high` that none shows its ends.
    pub fn smooth([low, high]: [f64; 2]) -> Bands {
        const COUNT: usize = 128;
        let high = if high > low { high } else { low + 1.0 };
        let edges: Vec<f64> = (0..=COUNT).map(|i| low + (high - low) * i as f64 / COUNT as f64).collect();
        Bands { labels: linear_labels(&edges), edges, colours: shades(&INFERNO, COUNT) }
    }

    /// The same with its colours the other way round: dark for what is high, on a pale ground.
    #[must_use]
    pub fn darkening(mut self) -> Bands {
        self.colours.reverse();
        self
    }

    /// [`Bands::band`], first looked for at `last`, the band of a neighbour: the same one as a rule.
    pub fn band_near(&self, value: f64, last: usize) -> usize {
        match self.edges[last..] {
            [from, to, ..] if from <= value && value < to => last,
            _ => self.band(value),
        }
    }

    /// The band of `value`, the outer ones beyond the ends.
    pub fn band(&self, value: f64) -> usize {
        self.edges.partition_point(|edge| *edge <= value).saturating_sub(1).min(self.colours.len() - 1)
    }
}

/// About six round numbers along equal bands.
fn linear_labels(edges: &[f64]) -> Vec<(f64, String)> {
    let (low, high) = (edges[0], edges[edges.len() - 1]);
    let step = scale::round_step(high - low, 7.0);
    let label = |v: f64| ((v - low) / (high - low), scale::label(v, step));
    scale::multiples(low, high, step).into_iter().map(label).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_hold_their_values() {
        let bands = Bands::rising(1273.0);
        assert!(bands.edges[bands.edges.len() - 1] >= 1273.0 && bands.colours.len() <= 26);
        assert_eq!(bands.band(0.0), 0);
        assert_eq!(bands.band(1e9), bands.colours.len() - 1);
        let bands = Bands::about_zero([-120.0, 900.0]);
        assert!(bands.edges.contains(&0.0) && bands.edges[0] <= -120.0);
        assert!(bands.labels.iter().any(|(_, text)| text == "0"));
        // nothing to show is a scale too
        assert_eq!(Bands::about_zero([0.0, 0.0]).colours.len(), 1);
        assert_eq!(Bands::smooth([2.0, 2.0]).edges[0], 2.0);
    }

    #[test]
    fn closures_differ_in_colour() {
        let mut colours = Closure::ALL.map(closure).to_vec();
        colours.sort_unstable();
        colours.dedup();
        assert_eq!(colours.len(), Closure::ALL.len());
    }
}
