//! What a run leaves behind: one file a format.

pub mod atomic;
pub mod bed_plots;
pub mod between;
pub mod contacts;
pub mod csv;
pub mod folder;
pub mod grain_list;
pub mod grain_means;
pub mod grain_plots;
pub mod hashed;
pub mod layers;
pub mod load_means;
pub mod loads;
pub mod lock;
pub mod npy;
pub mod plot;
pub mod records;
pub mod slice;
pub mod snapshots;
pub mod vtk;
pub mod walls;
mod wrapped;
