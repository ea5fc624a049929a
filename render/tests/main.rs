//! Integration tests of `render`: one binary, a module for each subject.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod accuracy;
mod area;
mod bench;
mod bump_footprints;
mod check;
mod cli;
mod complaints;
mod differentials;
mod exact;
mod exact_filter;
mod examples;
mod foreign;
mod hard_cases;
mod hard_mutations;
mod hard_optics;
mod hard_places;
mod hard_rays;
mod hard_sizes;
mod hard_textures;
mod hostile;
mod include;
mod interrupted;
mod layers;
mod light;
mod literal;
mod mapping;
mod media;
mod memory;
mod obj;
mod peer_scenes;
mod pictures;
mod pixel;
mod procedural;
mod proportional;
mod sampling;
mod schema;
mod shape_complaints;
mod shapes;
mod sky;
mod solid_averages;
mod solid_complaints;
mod structures;
mod studio;
mod textures;
