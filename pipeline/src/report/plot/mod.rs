//! Plots as SVG: both axes by powers of ten, curves named where they end, marks that are told apart
//! without colour.
//!
//! A plot stands in a page of HTML or is a file of its own; both are right on white and on dark.

pub mod axis;
pub mod chart;
pub mod look;
mod svg;
pub mod tables;
pub mod trials;

pub use axis::{Axis, Unit};
pub use chart::{Band, Chart, Place, Series, Size};
pub use look::{Look, Mark};

/// What plots look like: for one `style` element of a page of HTML that has plots in it.
pub const STYLE: &str = include_str!("style.css");
