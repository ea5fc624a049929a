//! Tests across the crates: one binary, a module for each subject.

mod architecture;
mod area_pictures;
mod book;
mod compare;
mod cup_and_column;
mod frontispiece;
mod glass_table;
mod hard_cases;
mod hostile;
mod pages;
mod pipe;
mod reliefs;
mod report;
mod still_lifes;
mod structures;
#[path = "../render/tests/studio/mod.rs"]
mod studio;
mod support;
mod textures;
