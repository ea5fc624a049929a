//! The key `note` of the JSON files: sentences for people, which the readers ignore.
//!
//! JSON has no comments, and unknown keys are errors. So each format has one key for the words of its authors.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One sentence, or a list of sentences.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a string, or a list of strings")]
pub enum Note {
    /// One sentence.
    One(String),
    /// Several sentences.
    More(Vec<String>),
}
