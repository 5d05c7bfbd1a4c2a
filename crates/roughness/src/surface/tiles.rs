//! A map cut into tiles: places of one surface.

use super::height_map::MapError;
use super::level::{Levelling, level};
use crate::{HeightMap, Surface};

/// Points along the shorter side of a tile, at least.
const FEWEST_POINTS: usize = 16;

impl Surface {
    /// The map cut into `count` by `count` tiles, row by row, each levelled by a plane and free at its edges,
    /// as if it had been measured alone. Points of the last row and column that fill no tile are left out.
    ///
    /// # Errors
    /// Tiles of fewer than 16 points along a side, a tile without heights.
    ///
    /// ```
    /// use asperity_roughness::{HeightMap, Surface};
    /// let map = HeightMap::new(40, 32, [1e-6; 2], (0..1280).map(|i| f64::from(i % 7)).collect())?;
    /// let tiles = Surface::from_map(map)?.tiles(2)?;
    /// assert_eq!((tiles.len(), tiles[0].map.columns(), tiles[0].map.rows()), (4, 20, 16));
    /// # Ok::<(), asperity_roughness::MapError>(())
    /// ```
    pub fn tiles(&self, count: usize) -> Result<Vec<Surface>, MapError> {
        let [nx, ny] = [self.map.columns(), self.map.rows()].map(|n| n / count.max(1));
        if nx.min(ny) < FEWEST_POINTS {
            return Err(MapError::SmallTiles { count, points: nx.min(ny), fewest: FEWEST_POINTS });
        }
        let tile = |k: usize| {
            let (left, bottom) = (k % count * nx, k / count * ny);
            let heights =
                (bottom..bottom + ny).flat_map(|y| self.map.row(y)[left..left + nx].iter().copied());
            let map = HeightMap::new(nx, ny, self.map.pixel(), heights.collect())?;
            Surface::from_map(level(map, Levelling::Plane))
        };
        (0..count * count).map(tile).collect()
    }
}
