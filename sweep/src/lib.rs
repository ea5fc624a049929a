//! Sweeps contours along trajectories: from a JSON spec to a contour x trajectory grid.
//!
//! | module         | what                                                                |
//! |----------------|---------------------------------------------------------------------|
//! | [`spec`]       | the spec as JSON, with its keys and conventions                     |
//! | [`schema`]     | the spec as JSON Schema                                             |
//! | [`Object`]     | the object of a spec: one sweep or several                          |
//! | [`Sweep`]      | a checked spec, and its grid                                        |
//! | [`contour`]    | the curve that is swept; creases                                    |
//! | [`profile`]    | one contour, or several that blend into each other; columns         |
//! | [`cut`]        | division of a curve into cells                                      |
//! | [`trajectory`] | the curve that the contour follows; stations, normals in closed form |
//! | [`law`]        | numbers that change along the trajectory                            |
//! | [`depth`]      | relief on the contour, in waves                                     |
//! | [`height`]     | heights from a picture                                              |
//! | [`modulation`] | the contour scaled and twisted along the trajectory                 |
//! | [`Shape`]      | the whole surface, before it is cut into cells                      |
//! | [`cap`]        | surfaces that close the ends                                        |
//! | [`closing`]    | how the end of the surface meets its start                          |
//! | [`wall`]       | a one-sided surface given a thickness                               |
//! | [`deform`]     | taper, twist and bend of the finished surface                       |
//! | [`frame`]      | rotation-minimizing frames, and frames that a direction fixes       |
//! | [`curve`]      | cubic Bezier paths by arc length, splines, SVG                      |
//! | [`resolution`] | cells in rows x cols, or to a tolerance                             |
//! | [`grid`]       | the grid and its file                                               |
//! | [`check`]      | errors and suspicious values, in words                              |
//! | [`preview`]    | contour, trajectory, laws and surface drawn on one page             |
//!
//! ```
//! use files::json::Document;
//! use sweep::Sweep;
//!
//! let text = br#"{"format": "tb-sweep", "version": 1, "name": "pipe",
//!     "contour": {"circle": 1}, "trajectory": {"line": [[0, 0, 0], [0, 3, 0]]},
//!     "mesh": {"rows": 2, "cols": 16}}"#;
//! let grid = Sweep::read(&Document::new("pipe.json", text)?)?.grid();
//! assert_eq!((grid.rows(), grid.cols()), (3, 16));
//! # Ok::<(), sweep::SweepError>(())
//! ```

pub mod cap;
pub mod check;
pub mod closing;
pub mod contour;
pub mod curve;
pub mod cut;
pub mod deform;
pub mod depth;
pub mod error;
pub mod frame;
pub mod grid;
pub mod height;
pub mod law;
pub mod modulation;
mod object;
pub mod preview;
pub mod profile;
mod read;
pub mod resolution;
mod rows;
pub mod schema;
pub mod shape;
pub mod spec;
mod survey;
mod sweep;
pub mod trajectory;
pub mod wall;

pub use error::SweepError;
pub use grid::GridMesh;
pub use object::Object;
pub use rows::Spent;
pub use shape::Shape;
pub use sweep::{MOST_CELLS, Sweep};
