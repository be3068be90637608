//! How fast a flow may be and how light a grain, as the maps of stability found. The runs that made the maps
//! are in `tests/validation`.

pub mod limits;
