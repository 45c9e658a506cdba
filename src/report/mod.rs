//! Output for human readers: pages, charts, pictures, and comparison with measurements.

pub mod compare;
pub mod fracture;
pub mod page;
pub mod plot;
pub mod raster;
pub mod run;
pub mod sweep;
pub mod wave_page;
