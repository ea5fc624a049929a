//! Mutations of inputs, one file for each format.
//!
//! | module    | what                                                                       |
//! |-----------|----------------------------------------------------------------------------|
//! | [`bytes`] | flips, numbers, pieces removed, doubled and exchanged, in any format       |
//! | [`text`]  | numbers, words and lines of a text                                         |
//! | [`json`]  | keys and values of JSON                                                    |
//! | [`grid`]  | headers and rows of grid files, with their checksums made right            |
//! | [`png`]   | chunks of PNG files, with their checksums made right                       |
//! | [`jpeg`]  | segments of JPEG files                                                     |
//! | [`exr`]   | attributes and blocks of EXR files                                         |

pub mod bytes;
pub mod exr;
pub mod grid;
pub mod jpeg;
pub mod json;
pub mod png;
pub mod text;
