//! Objects that the tests make of specs.

use files::Disk;
use files::json::Document;
use serde_json::Value;
use std::path::Path;
use sweep::check::measures::Measures;
use sweep::{Object, SweepError};

/// Reads a spec whose files lie in a folder.
pub fn read(folder: &Path, spec: &Value) -> Result<Object, SweepError> {
    let text = spec.to_string();
    let document = Document::new("test", text.as_bytes()).unwrap();
    Object::read(&document, folder, &Disk, &sweep::spec::Resolution::default())
}

/// Returns the measures of a spec that is read without complaint.
pub fn measured(folder: &Path, spec: &Value) -> Measures {
    let object = read(folder, spec).unwrap_or_else(|error| panic!("{error}\n{spec}"));
    Measures::of(&object, &object.grids().unwrap())
}
