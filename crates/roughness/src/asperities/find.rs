//! The asperities of a surface with their numbers.

use super::gather::{self, Nodes};
use super::tip::Tip;
use super::{NO_ASPERITY, hills};
use crate::contact::ellipse::Ellipse;
use crate::contact::islands::Islands;
use crate::surface::prepared_surface::Surface;
use asperity_material::units::rounded;
use thiserror::Error;

/// Rule by which the surface is divided into asperities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segmentation {
    /// A connected part of the surface above a plane.
    Islands {
        /// Plane above the mean height, m.
        separation: f64,
    },
    /// A hill of ISO 25178-2: what drains from one summit, after pruning by Wolf.
    Hills {
        /// Least rise of a hill above its highest saddle to a higher one, as a share of the height of the
        /// surface (Sz).
        prune: f64,
    },
}

/// The reason why there are no asperities.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FindError {
    /// All heights are equal.
    #[error("the map is flat: it has no asperity")]
    Flat,
    /// The plane lies above the surface.
    #[error(
        "a separation of {separation_um} µm is above the highest point, {highest_um} µm above the mean height: no asperity is found; \
         lower it"
    )]
    Above {
        /// The plane above the mean height, µm.
        separation_um: f64,
        /// Highest point above the mean height, µm.
        highest_um: f64,
    },
    /// The plane lies below the surface.
    #[error(
        "a separation of {separation_um} µm is below the lowest point, {lowest_um} µm from the mean height: the whole map is one \
         island; raise it"
    )]
    Below {
        /// The plane above the mean height, µm.
        separation_um: f64,
        /// Lowest point above the mean height, µm (negative).
        lowest_um: f64,
    },
    /// The share is none.
    #[error(
        "a pruning of {0} is not possible: give a share of the surface's height from 0 to below 1 (ISO 25178-2: 0.05)"
    )]
    Prune(f64),
}

/// One asperity of a map. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asperity {
    /// Column and row of its highest node.
    pub summit: [usize; 2],
    /// The position of that, from node (0, 0).
    pub position: [f64; 2],
    /// Its highest node above the mean height of the surface.
    pub height: f64,
    /// Its highest node above its foot: the plane, or the highest saddle of a hill to another one.
    pub rise: f64,
    /// Projected area, in m².
    pub area: f64,
    /// tan β: mean of |∇h| over it.
    pub slope: f64,
    /// Ellipse of equal area and equal second moments, where there is one.
    pub ellipse: Option<Ellipse>,
    /// Curvature of its summit.
    pub tip: Option<Tip>,
    /// Nodes that it holds.
    pub nodes: usize,
    /// True where it reaches the edge of the map or a point that was not measured.
    pub cut: bool,
}

/// The asperities of `surface`, from the highest summit down.
///
/// # Errors
/// A flat map, a plane beyond the surface, a share that is none.
///
/// # Examples
/// ```
/// use asperity_roughness::asperities::{Segmentation, find};
/// use asperity_roughness::{HeightMap, Surface};
///
/// // two cones of slope 0.1, 100 µm apart
/// let cone = |x: f64, y: f64, x0: f64| 20e-6 - 0.1 * (x - x0).hypot(y - 100e-6);
/// let height = |i: usize| {
///     let (x, y) = ((i % 201) as f64 * 1e-6, (i / 201) as f64 * 1e-6);
///     cone(x, y, 50e-6).max(cone(x, y, 150e-6))
/// };
/// let map = HeightMap::new(201, 201, [1e-6, 1e-6], (0..201 * 201).map(height).collect())?;
/// let surface = Surface::from_map(map)?;
/// let found = find(&surface, Segmentation::Hills { prune: 0.05 })?;
/// assert_eq!(found.len(), 2);
/// assert!(found.iter().all(|one| (one.slope - 0.1).abs() < 2e-3 && (one.rise - 5e-6).abs() < 1e-12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn find(surface: &Surface, how: Segmentation) -> Result<Vec<Asperity>, FindError> {
    let extent = &surface.extent;
    if extent.high <= extent.low {
        return Err(FindError::Flat);
    }
    let mut found = match how {
        Segmentation::Islands { separation } => of_islands(surface, separation)?,
        Segmentation::Hills { prune } => of_hills(surface, prune)?,
    };
    found.sort_by(|a, b| b.height.total_cmp(&a.height).then(a.summit[1].cmp(&b.summit[1])));
    Ok(found)
}

fn of_islands(surface: &Surface, separation: f64) -> Result<Vec<Asperity>, FindError> {
    let (map, mean) = (&surface.map, surface.parameters.mean);
    let plane = mean + separation;
    let [separation_um, highest_um, lowest_um] =
        [separation, surface.extent.high - mean, surface.extent.low - mean].map(|h| rounded(h * 1e6, 5));
    if plane.is_nan() || plane >= surface.extent.high {
        return Err(FindError::Above { separation_um, highest_um });
    }
    if plane < surface.extent.low {
        return Err(FindError::Below { separation_um, lowest_um });
    }
    let islands = Islands::above_plane(map, plane);
    let mut labels = vec![NO_ASPERITY; map.heights().len()];
    islands.spans(|island, row, columns| {
        let start = row * map.columns();
        labels[start + columns.start..start + columns.end].fill(island);
    });
    let nodes = gather::nodes(map, &labels, islands.islands.len());
    let whole = |(nodes, island): (&Option<Nodes>, &crate::Island)| {
        let nodes = nodes.as_ref()?;
        let numbers = (island.area, island.slope, island.ellipse);
        Some(asperity(surface, nodes, island.approach, numbers))
    };
    Ok(nodes.iter().zip(&islands.islands).filter_map(whole).collect())
}

fn of_hills(surface: &Surface, prune: f64) -> Result<Vec<Asperity>, FindError> {
    if !(0.0..1.0).contains(&prune) {
        return Err(FindError::Prune(prune));
    }
    let (map, extent) = (&surface.map, &surface.extent);
    let labels = hills::labels(map, prune * (extent.high - extent.low));
    let count = labels.iter().filter(|l| **l != NO_ASPERITY).max().map_or(0, |l| *l as usize + 1);
    let nodes = gather::nodes(map, &labels, count);
    let moments = gather::moments(map, &labels, &nodes);
    let whole = |(nodes, m): (&Option<Nodes>, &crate::surface::cells::Moments)| {
        // a hill whose cells all lack a corner has no area
        let nodes = nodes.as_ref().filter(|_| m.area > 0.0)?;
        let summit = [nodes.summit % map.columns(), nodes.summit / map.columns()];
        let ellipse = Ellipse::from_moments(m, summit.map(|i| i as f64), map.pixel());
        let top = map.heights()[nodes.summit];
        let foot = if nodes.saddle.is_finite() { nodes.saddle } else { extent.low };
        Some(asperity(surface, nodes, top - foot, (m.area * map.cell_area(), m.slope_area / m.area, ellipse)))
    };
    Ok(nodes.iter().zip(&moments).filter_map(whole).collect())
}

fn asperity(
    surface: &Surface,
    nodes: &Nodes,
    rise: f64,
    (area, slope, ellipse): (f64, f64, Option<Ellipse>),
) -> Asperity {
    let map = &surface.map;
    let summit = [nodes.summit % map.columns(), nodes.summit / map.columns()];
    Asperity {
        summit,
        position: [0, 1].map(|k| summit[k] as f64 * map.pixel()[k]),
        height: map.heights()[nodes.summit] - surface.parameters.mean,
        rise,
        area,
        slope,
        ellipse,
        tip: Tip::fit(map, summit),
        nodes: nodes.count,
        cut: nodes.cut,
    }
}
