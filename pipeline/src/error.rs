//! What can go wrong in a job.

use files::{Exit, Failure, FileError, JsonError};
use render::scene::SceneError;
use sweep::SweepError;
use thiserror::Error;
use triangulate::TriangulateError;

/// Why a job is not done.
#[derive(Debug, Error)]
pub enum PipelineError {
    /// The job file is wrong.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A curve spec is wrong.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A grid has no triangles in `f32`.
    #[error(transparent)]
    Triangulate(#[from] TriangulateError),
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A picture does not fit its file format.
    #[error("cannot encode {name}: {source}")]
    Encode {
        /// The picture's file.
        name: String,
        /// What the encoder said.
        source: image::ImageError,
    },
    /// Two jobs would write the same files.
    #[error("two jobs are called {name} and would write the same files: run them into two folders")]
    SameName {
        /// The name of both.
        name: String,
    },
    /// There is no page of that name.
    #[error(
        "there is no page {name:?}; there are {known}; a job of your own is named by its .json file"
    )]
    UnknownPage {
        /// The name given.
        name: String,
        /// The names there are, with a suggestion.
        known: String,
    },
}

impl Failure for PipelineError {
    fn exit(&self) -> Exit {
        match self {
            Self::Json(error) => error.exit(),
            Self::File(error) => error.exit(),
            Self::Sweep(error) => error.exit(),
            Self::Triangulate(error) => error.exit(),
            Self::Scene(error) => error.exit(),
            Self::Encode { .. } => Exit::Resource,
            Self::SameName { .. } | Self::UnknownPage { .. } => Exit::Use,
        }
    }
}
