//! Pictures of solids as pixels, for scenes with too many faces to be drawn as lines and areas.
//!
//! | file | what it does |
//! | --- | --- |
//! | `view` | from places to the paper: a parallel view |
//! | `canvas` | pixels with a depth, triangles and lines on them |
//! | `image` | PNG inside a page |

mod canvas;
mod image;
mod view;

pub use canvas::{Canvas, Colour, mixed};
pub use image::data_uri;
pub use view::View;
