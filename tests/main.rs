//! Tests across the crates: one binary, a module for each subject.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod animation;
mod architecture;
mod area_limits;
mod area_pictures;
mod book;
mod clashes;
mod compare;
mod cup_and_column;
mod durable;
mod farm;
mod films;
mod frontispiece;
mod glass_table;
mod hard_cases;
mod hostile;
mod kills;
#[path = "../triangulate/tests/made/mod.rs"]
mod made;
mod mesh_formats;
mod pages;
mod pipe;
mod programs;
mod prose;
mod python;
mod reference;
mod reliefs;
mod report;
mod requested;
mod shown;
mod slurm;
mod starting_points;
mod still_lifes;
mod structures;
#[path = "../render/tests/studio/mod.rs"]
mod studio;
#[cfg(feature = "studio")]
mod studio_browser;
#[cfg(feature = "studio")]
mod studio_exports;
#[cfg(feature = "studio")]
mod studio_page;
#[cfg(feature = "studio")]
mod studio_server;
mod support;
