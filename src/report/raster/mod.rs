//! Pixel images of solids. They show scenes that have too many faces for SVG paths.
//!
//! | file | content |
//! | --- | --- |
//! | `view` | parallel projection from positions [m] to the image [px] |
//! | `canvas` | pixel image with depth buffer for triangles and lines |
//! | `image` | PNG images embedded in a page |

mod canvas;
mod image;
mod view;

pub use canvas::{Canvas, Colour, mixed};
pub use image::data_uri;
pub use view::View;
