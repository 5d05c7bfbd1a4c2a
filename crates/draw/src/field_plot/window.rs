//! The part of the section that is drawn.

use super::deformed_mesh::DeformedMesh;

/// The asperities before the crush.
#[derive(Clone, Copy, Debug)]
pub struct AsperityRow {
    /// From the first foot to the last, µm.
    pub feet: [f64; 2],
    /// Height of the highest, µm.
    pub height: f64,
    /// Their number.
    pub count: usize,
}

/// The part of the body that a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// All that has yielded or is pressed, and its surroundings; several asperities: their whole row.
    Yielded,
    /// The asperities, and as many of their heights below the base plane.
    Asperities(f64),
}

/// A rectangle of the section, µm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Left and lower end.
    pub low: [f64; 2],
    /// Right and upper end.
    pub high: [f64; 2],
}

/// Least and largest of numbers; `None` of none.
pub fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |so_far, v| Some(so_far.map_or([v, v], |[a, b]: [f64; 2]| [a.min(v), b.max(v)])))
}

impl Window {
    /// The part of the body that `reach` asks for.
    pub fn around_contact(
        mesh: &DeformedMesh,
        mirrored: bool,
        revolved: bool,
        reach: Reach,
        row: &AsperityRow,
    ) -> Window {
        let all = |k: usize| range(mesh.points().iter().map(move |p| p[k])).unwrap_or([0.0, 1.0]);
        let (body_x, body_z) = (all(0), all(1));
        let yielded: Vec<[f64; 2]> = (0..mesh.cells())
            .filter(|&cell| mesh.yielded(cell))
            .flat_map(|cell| mesh.corners(cell))
            .collect();
        let pressed = range(mesh.pressed().map(|p| p[0]));
        let busy = range(yielded.iter().map(|p| p[0]));
        let whole_row = row.count > 1 || (row.count == 1 && matches!(reach, Reach::Asperities(_)));
        let [mut left, right] = if whole_row { row.feet } else { busy.or(pressed).unwrap_or(body_x) };
        if mirrored {
            left = -right;
        } else if revolved {
            left = 0.0;
        }
        let bottom = match reach {
            Reach::Asperities(heights) => -(1.0 + heights) * row.height,
            Reach::Yielded if whole_row => -0.4 * (right - left),
            Reach::Yielded => {
                let deepest = range(yielded.iter().map(|p| p[1])).map_or(0.0, |[low, _]| low);
                (1.15 * deepest).min(-0.3 * (right - left))
            }
        };
        let margin = if whole_row { 0.04 } else { 0.12 } * (right - left);
        let low_limit = if mirrored { -body_x[1] } else { body_x[0] };
        let low = [(left - margin).max(low_limit), bottom.max(body_z[0])];
        let right = (right + margin).min(body_x[1]);
        // the tool is at least as high as its name
        let room = (0.06 * (right - low[0]).min(4.0 * -low[1])).max(0.034 * (right - low[0]));
        Window { low, high: [right, body_z[1].max(0.0) + room] }
    }

    /// Width and height.
    pub fn size(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.high[k] - self.low[k]).max(f64::MIN_POSITIVE))
    }

    /// True where some of the box around `points` lies in the window.
    pub fn meets(&self, points: &[[f64; 2]]) -> bool {
        (0..2).all(|k| {
            range(points.iter().map(|p| p[k])).is_some_and(|[a, b]| a < self.high[k] && b > self.low[k])
        })
    }
}
