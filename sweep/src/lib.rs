//! Contours swept along trajectories: a JSON spec to a contour x trajectory grid.

pub mod grid;

pub use grid::GridMesh;
