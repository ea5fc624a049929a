//! Draws plots as SVG. Both axes are logarithmic, curves are named at their ends, and marks differ
//! without colour.
//!
//! A plot is part of an HTML page or a file of its own. Both forms are readable on white and on dark.

pub mod axis;
pub mod chart;
pub mod look;
pub mod trials;

pub use axis::{Axis, Unit};
pub use chart::{Band, Chart, Point, Series, Size};
pub use look::{Look, Mark};

/// The style of plots, for a `style` element of an HTML page that contains plots.
pub const STYLE: &str = include_str!("style.css");
