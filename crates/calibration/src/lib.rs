//! The force of crushed cones over slopes and metals, and the representative strain that makes it one curve
//! (Jourani et al., section 3.3).
//!
//! In the order of the data: a case (`case`), its path (`cone`) and its constant
//! (`loading_curvature`); the grid (`sweep`), its rows on disk (`row`, `journal`) and its run (`run`); the representative strain of a
//! slope (`collapse`), of all (`fit`) and of parts (`sensitivity`), the force as a formula (`dimensionless`) and
//! the way back (`unloading`).

pub mod case;

pub mod cone;

pub mod loading_curvature;

pub mod sweep;

pub mod row;

pub mod journal;

pub mod run;

pub mod collapse;

pub mod fit;

pub mod sensitivity;

pub mod dimensionless;

pub mod unloading;
