//! Films: a scene in three dimensions over time, which the reader of a page turns, plays and clicks.
//!
//! | file | content |
//! | --- | --- |
//! | `page` | a film in a page: the data and the viewer |
//! | `viewer/` | the program that draws the film in the browser (WebGL2), its controls and style |
//! | `glb` | a film as a file for Blender and PowerPoint |
//! | `arrays` | points, triangles and values as compressed bytes |
//! | `scene` | what a film shows |
//! | `simplify` | meshes with fewer triangles |
//!
//! The page contains the program and the data, so that the film needs no network.

mod arrays;
mod glb;
mod page;
mod scene;
mod simplify;

pub use arrays::bounds;
pub use glb::glb;
pub use page::{packed_size, viewer_html};
pub use scene::{Bodies, Body, Clock, DENSE, Field, NO_YES, Scene, Seen, Series, WARM, thinned};
pub use simplify::Mesh;

/// Largest size of the meshes that change with time [bytes of text in the page].
pub const BUDGET: usize = 9_000_000;

/// Style sheet of the viewer.
pub const FILM_STYLE: &str = include_str!("viewer/film.css");
