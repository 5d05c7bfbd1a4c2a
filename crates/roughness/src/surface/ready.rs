//! A surface ready to be pressed.

use crate::surface::height_map::{Extent, HeightMap, MapError};
use crate::surface::parameters::Parameters;

/// A surface ready to be pressed: its levelled, filtered map with the numbers that the contact needs.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The map.
    pub map: HeightMap,
    /// Points that were not measured, before any were filled.
    pub missing: usize,
    /// Extent of the map.
    pub extent: Extent,
    /// Roughness parameters of the map.
    pub parameters: Parameters,
}

impl Surface {
    /// The surface of `map` as it is.
    ///
    /// # Errors
    /// A map without a cell of four measured corners.
    pub fn of(map: HeightMap) -> Result<Surface, MapError> {
        let extent = map.extent()?;
        let parameters = Parameters::of(&map, &extent);
        Ok(Surface { missing: map.missing(), map, extent, parameters })
    }

    /// Nominal area, in m²: that of the cells with four measured corners.
    pub fn nominal_area(&self) -> f64 {
        self.extent.cells as f64 * self.map.cell_area()
    }
}
