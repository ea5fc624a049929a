//! Integration tests of `triangulate`: one binary, a module for each subject.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod areas;
mod binary;
mod cli;
mod interrupted;
mod lids;
mod made;
mod patches;
mod printable;
mod properties;
mod seams;
mod shapes;
mod surfaces;
mod truths;
