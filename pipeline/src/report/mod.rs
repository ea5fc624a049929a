//! Measures the cost of each method of rendering a page against the error of its picture.
//!
//! [`measure`] renders a page by the methods of a [`Plan`] and compares the pictures with the
//! [`refined`] truth, as a whole and by [`regions`]. [`Measured`] holds the results as numbers.
//! [`write()`] turns the results into rows of numbers, sentences of advice, plots and pages.
//! [`flicker`] measures the part of the errors that changes from frame to frame.
//! [`accompanying`] holds measurements of other programs, which every report shows.

pub mod accompanying;
pub mod advice;
mod blocks;
#[cfg(test)]
mod board;
mod document;
#[cfg(test)]
mod fixture;
pub mod flicker;
pub mod measure;
pub mod measured;
mod method;
pub mod pareto;
pub mod plan;
pub mod plot;
mod pool;
pub mod refined;
pub mod regions;
pub mod rows;
mod sight;
mod write;

pub use measured::Measured;
pub use plan::Plan;
pub use write::{files, write, write_numbers};
