//! Contours swept along trajectories: a JSON spec to a contour x trajectory grid.

pub mod curve;
pub mod error;
pub mod frame;
pub mod grid;

pub use error::SweepError;
pub use grid::GridMesh;
