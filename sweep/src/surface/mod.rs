//! The swept surface before it is cut into cells.
//!
//! | module         | what                                                               |
//! |----------------|--------------------------------------------------------------------|
//! | [`contour`]    | the curve that is swept; creases                                   |
//! | [`place`]      | the position of the finished part                                  |
//! | [`press`]      | an end that is pressed to a line                                    |
//! | [`profile`]    | one contour, or several that blend into each other; columns        |
//! | [`depth`]      | relief on the contour, in waves                                    |
//! | [`fade`]       | where a relief covers the contour, and where it fades              |
//! | [`height`]     | heights from a picture                                             |
//! | [`lid`]        | triangles that fill an outline with holes                          |
//! | [`nest`]       | loops inside each other: outlines and holes                        |
//! | [`modulation`] | the contour scaled and twisted along the trajectory                |
//! | [`cap`]        | surfaces that close the ends                                       |
//! | [`closing`]    | how the end of the surface meets its start                         |
//! | [`deform`]     | taper, twist and bend of the finished surface                      |
//! | [`edges`]      | rows and columns where a deformation makes an edge                 |
//! | [`shape`]      | all of these together: a point and a normal for each (u, v)        |
//! | [`vessel`]     | the profile of a rotation given a thickness                        |
//! | [`wall`]       | a one-sided surface given a thickness                              |

pub mod cap;
pub mod closing;
pub mod contour;
pub mod deform;
pub mod depth;
pub mod edges;
pub mod fade;
pub mod height;
pub mod lid;
pub mod modulation;
pub mod nest;
pub mod place;
pub mod press;
pub mod profile;
pub mod shape;
pub mod vessel;
pub mod wall;

pub use shape::Shape;

use crate::curve::cut::Stop;
use glam::DVec3;
use profile::Column;

/// A point of a surface with its unit normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// The point, in the unit of length.
    pub point: DVec3,
    /// The unit normal.
    pub normal: DVec3,
    /// True if the surface runs backward here, so that its normal is turned over.
    pub folds: bool,
}

/// A surface that can be cut into cells and measured.
pub trait Surface: Sync {
    /// Returns the columns at stops of the contour.
    fn columns(&self, stops: &[Stop]) -> Vec<Column>;

    /// Returns points and unit normals at one stop of the trajectory, one for each column.
    fn station(&self, stop: Stop, columns: &[Column]) -> Vec<Corner>;

    /// Returns the points at one stop of the trajectory, one for each column.
    fn points(&self, stop: Stop, columns: &[Column]) -> Vec<DVec3>;
}
