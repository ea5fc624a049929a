//! A surface cut into rows and columns.
//!
//! | module         | what                                                               |
//! |----------------|--------------------------------------------------------------------|
//! | [`resolution`] | cells in rows x cols, or to a tolerance                            |
//! | [`Sweep`]      | a checked surface with its resolution, and its grid                |
//! | [`Object`]     | the object of a spec: one sweep or several                         |
//! | [`Survey`]     | where the rows of a grid fold back on themselves                   |

pub(crate) mod lids;
mod object;
pub mod resolution;
mod rows;
mod survey;
mod sweep;

pub use object::Object;
pub use rows::Spent;
pub use survey::Survey;
pub use sweep::Sweep;

pub(crate) use survey::TOUCHES;
