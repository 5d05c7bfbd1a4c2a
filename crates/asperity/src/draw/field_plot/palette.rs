//! Bands of a scale and their colours: even in lightness, legible to colour-blind people and in grey.

use crate::draw::scale;

/// "viridis": rising lightness.
const RISING: [[u8; 3]; 9] = [
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
/// From 0 to the largest pressure.
const COMPRESSION: [[u8; 3]; 4] = [[245, 245, 245], [143, 205, 193], [39, 125, 117], [0, 60, 48]];
/// From 0 to the largest tension.
const TENSION: [[u8; 3]; 3] = [[245, 245, 245], [216, 179, 101], [140, 81, 10]];
/// Metal that never yielded.
pub const ELASTIC: [u8; 3] = [222, 228, 234];
/// Zones of Fig. 5: never yielded, has yielded and is elastic now, flows; and the line of the first yield stress.
pub const ZONES: [[u8; 3]; 4] = [[0, 114, 178], [240, 180, 60], [226, 226, 226], [20, 20, 20]];

/// A scale cut into bands of one colour each.
pub struct Bands {
    /// Rising ends of the bands; the first band begins at the first.
    pub edges: Vec<f64>,
    /// A colour for each band.
    pub colours: Vec<[u8; 3]>,
    /// Edges that carry a number, and the number.
    pub labels: Vec<(usize, String)>,
}

/// The colour at `share` (0 to 1) of the way through `stops`.
fn between(stops: &[[u8; 3]], share: f64) -> [u8; 3] {
    let place = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let k = (place as usize).min(stops.len() - 2);
    let t = place - k as f64;
    [0, 1, 2].map(|i| {
        (f64::from(stops[k][i]) + t * (f64::from(stops[k + 1][i]) - f64::from(stops[k][i]))).round() as u8
    })
}

impl Bands {
    /// Equal bands from 0 to at least `most`.
    pub fn rising(most: f64) -> Bands {
        let most = if most > 0.0 { most } else { 1.0 };
        let step = scale::round_step(most, 26.0);
        let count = (most / step - 1e-9).ceil().max(1.0) as usize;
        let edges: Vec<f64> = (0..=count).map(|i| i as f64 * step).collect();
        let colours = (0..count).map(|i| between(&RISING, (i as f64 + 0.5) / count as f64)).collect();
        Bands { labels: linear_labels(&edges), edges, colours }
    }

    /// Equal bands from `low` (or 0) to `high` (or 0), with another hue below 0.
    pub fn about_zero([low, high]: [f64; 2]) -> Bands {
        let (low, high) = (low.min(0.0), high.max(0.0));
        let step = scale::round_step((high - low).max(f64::MIN_POSITIVE), 26.0);
        let (first, last) = ((low / step + 1e-9).floor() as i64, (high / step - 1e-9).ceil() as i64);
        let edges: Vec<f64> = (first..=last.max(first + 1)).map(|i| i as f64 * step).collect();
        let colours = edges
            .windows(2)
            .map(|band| {
                let middle = 0.5 * (band[0] + band[1]);
                if middle > 0.0 {
                    between(&COMPRESSION, middle / high)
                } else {
                    between(&TENSION, middle / low)
                }
            })
            .collect();
        Bands { labels: linear_labels(&edges), edges, colours }
    }

    /// Bands of plastic strain in steps of about 2, up to at least `most`; below the first the metal counts as elastic.
    pub fn strain(most: f64) -> Bands {
        const LEVELS: [f64; 13] =
            [0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0];
        let end = LEVELS.iter().position(|l| *l >= most).unwrap_or(LEVELS.len() - 1).max(1);
        let edges = LEVELS[..=end].to_vec();
        let count = end;
        // low strain dark on the pale elastic metal, high strain bright
        let colours = (0..count).map(|i| between(&RISING, (i as f64 + 0.5) / count as f64)).collect();
        let labels = edges.iter().enumerate().map(|(i, e)| (i, format!("{}", (1e4 * e).round() / 100.0)));
        Bands { labels: labels.collect(), edges, colours }
    }

    /// The band of `value`, the outer ones beyond the ends.
    pub fn band(&self, value: f64) -> usize {
        self.edges.partition_point(|edge| *edge <= value).saturating_sub(1).min(self.colours.len() - 1)
    }
}

/// Numbers at about six of the edges.
fn linear_labels(edges: &[f64]) -> Vec<(usize, String)> {
    let span = edges[edges.len() - 1] - edges[0];
    let step = scale::round_step(span, 7.0);
    let near = |value: f64| edges.iter().position(|e| (e - value).abs() < 1e-6 * span);
    scale::multiples(edges[0], edges[edges.len() - 1], step)
        .into_iter()
        .filter_map(|v| near(v).map(|i| (i, scale::label(v, step))))
        .collect()
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
    }
}
