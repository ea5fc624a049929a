//! Integration tests of `sweep`: one binary, a module for each subject.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod cells;
mod check;
mod cli;
mod corners;
mod ends;
mod fitting;
mod frames;
mod hard_closings;
mod hard_contours;
mod hard_cusps;
mod hard_mutations;
mod hard_trajectories;
mod hard_units;
mod hints;
mod made;
mod named_files;
mod normals;
mod preview;
mod properties;
mod relief;
mod resolution;
mod schema;
mod tubes;
mod vessels;
mod wall;
