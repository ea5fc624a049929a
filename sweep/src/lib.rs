//! Sweeps contours along trajectories: from a JSON spec to a contour x trajectory grid.
//!
//! | module         | what                                                                |
//! |----------------|---------------------------------------------------------------------|
//! | [`error`]      | why a spec is refused                                               |
//! | `limits`       | limits of the numbers in a spec, for its reader and its schema      |
//! | [`curve`]      | cubic Bezier paths by arc length, splines, SVG; division into cells |
//! | [`law`]        | numbers that change along the trajectory                            |
//! | [`frame`]      | rotation-minimizing frames, and frames that a direction fixes       |
//! | [`grid`]       | the grid and its file                                               |
//! | [`spec`]       | the spec as JSON, with its keys, and its JSON Schema                |
//! | [`trajectory`] | the curve that the contour follows; stations, normals in closed form |
//! | [`surface`]    | contour, modulation, relief, caps, deformations: the whole surface  |
//! | [`sampling`]   | the surface cut into cells: resolution, rows, [`Sweep`], [`Object`] |
//! | `read`         | from a spec to an [`Object`]; every value is checked                |
//! | [`check`]      | errors and suspicious values, in words                              |
//! | [`preview`]    | contour, trajectory, laws and surface drawn on one page             |
//!
//! Each module imports only modules above it in this table.
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

pub mod check;
pub mod curve;
pub mod error;
pub mod frame;
pub mod grid;
pub mod law;
mod limits;
pub mod preview;
mod read;
pub mod sampling;
pub mod spec;
pub mod surface;
pub mod trajectory;

pub use error::SweepError;
pub use grid::{GridMesh, MOST_CELLS};
pub use sampling::{Object, Spent, Sweep, resolution};
pub use spec::schema;
pub use surface::Shape;
