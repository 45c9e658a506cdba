//! HTML pages, charts and pictures of the results, and comparison with measurements.

pub mod compare;
pub mod fracture;
pub mod page;
pub mod plot;
pub mod raster;
pub mod run;
pub mod sweep;
pub mod wave_page;
