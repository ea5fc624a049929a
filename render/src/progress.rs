//! The progress bar of the programs, which the crates share.

pub use files::progress::Progress;
