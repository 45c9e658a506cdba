//! HTML pages, charts and pictures of the results, and comparison with measurements.

mod base64;
pub mod compare;
mod film;
pub mod fracture;
pub mod page;
pub mod plot;
pub mod raster;
pub mod run;
pub mod sweep;
pub mod wave_page;
