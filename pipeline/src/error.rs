//! Reasons why a job fails.

use compare::CompareError;
use files::variants::VariantsError;
use files::words::{LONGEST_LIST, cut, shown};
use files::{Exit, Failure, FileError, JsonError, MemoryError};
use render::film::join::JoinError;
use render::scene::SceneError;
use render::showcase::ShowcaseError;
use sweep::SweepError;
use thiserror::Error;
use triangulate::TriangulateError;

/// A reason why a job fails.
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
    /// A mesh, a scene or a picture takes more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// Two pictures cannot be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// A picture does not fit its file format.
    #[error("cannot encode {name}: {source}")]
    Encode {
        /// The picture's file.
        name: String,
        /// The error of the encoder.
        source: image::ImageError,
    },
    /// Pictures were written whose requested error was not reached.
    #[error(
        "number of pictures that miss the requested error: {0}; their lines state what was reached"
    )]
    ErrorMissed(usize),
    /// Two jobs would write the same file.
    #[error("{first} and {second} would both write {file}: run them into two folders")]
    SameFile {
        /// The job named first.
        first: String,
        /// The job named second.
        second: String,
        /// The file.
        file: String,
    },
    /// The job makes a mesh that its scene does not have.
    #[error(
        "job {} makes mesh {}: the scene has no mesh of that name; it has {}",
        shown(job),
        shown(name),
        cut(known, LONGEST_LIST)
    )]
    UnknownMesh {
        /// The job.
        job: String,
        /// The mesh.
        name: String,
        /// The names that exist, with a suggestion.
        known: String,
    },
    /// The scene has a mesh without a file, and the job does not make it.
    #[error(
        "job {} makes no mesh {}, which {2} needs: add it to the job's \"meshes\", or a \"file\" to {path} in {2}",
        shown(job),
        shown(name),
        shown(scene)
    )]
    MissingMesh {
        /// The job.
        job: String,
        /// The mesh.
        name: String,
        /// The JSON path of the mesh in the scene file.
        path: String,
        /// The scene file.
        scene: String,
    },
    /// The job has no mode of that name.
    #[error(
        "job {} has no mode \"{}\"; it has {}",
        shown(job),
        shown(name),
        cut(known, LONGEST_LIST)
    )]
    UnknownMode {
        /// The job.
        job: String,
        /// The requested name.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// The command line sets a value in the spec of a mesh that the job does not make.
    #[error(
        "-D {}: expected specs.NAME and a path in the spec of the mesh NAME; job {} makes {}",
        shown(setting),
        shown(job),
        cut(if known.is_empty() { "no mesh" } else { known }, LONGEST_LIST)
    )]
    UnknownSpec {
        /// The argument.
        setting: String,
        /// The job.
        job: String,
        /// The names of the job's meshes.
        known: String,
    },
    /// Frames or a film are wanted of a job without an animation.
    #[error(
        "job {} has no animation: add \"animate\" or \"turntable\" to it, or leave out --frames, --film and --again",
        shown(.0)
    )]
    NoAnimation(String),
    /// The pictures of a job without an animation are to be divided, and not in parts.
    #[error(
        "the pictures of job {} are not animated: add --tiles N to divide each in N parts, and leave out --chunk and --film",
        shown(.0)
    )]
    NotDivided(String),
    /// The animation has not all frames that are wanted.
    #[error("--frames of job {}: {message}", shown(job))]
    Frames {
        /// The job.
        job: String,
        /// The fault of the list of frames.
        message: String,
    },
    /// A film is wanted of a job with several modes.
    #[error(
        "--film needs one mode, and job {} has {}: add --mode and one of them",
        shown(job),
        cut(modes, LONGEST_LIST)
    )]
    FilmOfModes {
        /// The job.
        job: String,
        /// Its modes.
        modes: String,
    },
    /// A picture has fewer rows than parts.
    #[error(
        "found {count} parts for pictures of {height} rows: ask for at most {height}, since each part has a row of its own"
    )]
    ThinParts {
        /// The number of parts.
        count: u32,
        /// The rows of the pictures.
        height: u32,
    },
    /// Parts of a picture cannot be joined.
    #[error(transparent)]
    Join(#[from] JoinError),
    /// A table of variants is wrong.
    #[error(transparent)]
    Variants(#[from] VariantsError),
    /// A mesh cannot be shown.
    #[error(transparent)]
    Showcase(#[from] ShowcaseError),
    /// The file to show is one of another kind.
    #[error("{name}: found {found}, expected a spec, a grid or a mesh; {hint}")]
    NotShown {
        /// The file.
        name: String,
        /// The kind of the file.
        found: &'static str,
        /// The command that takes the file.
        hint: &'static str,
    },
    /// The command line sets a value of a spec, and the file is none.
    #[error("-D {setting}: expected scene and a path in the scene, since {name} is no spec")]
    NoSpec {
        /// The argument.
        setting: String,
        /// The file.
        name: String,
    },
    /// No page shows that figure of the thesis.
    #[error("there is no figure A.{number}; there are {known}")]
    UnknownFigure {
        /// The requested number.
        number: u8,
        /// The figures that exist.
        known: String,
    },
    /// There is no page of that name.
    #[error(
        "there is no page {name:?}{near}; `pipeline list` prints all pages; name a job of your \
         own by its .json file"
    )]
    UnknownPage {
        /// The requested name.
        name: String,
        /// Words that suggest a similar name; empty if there is none.
        near: String,
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
            Self::Compare(error) => error.exit(),
            Self::Showcase(error) => error.exit(),
            Self::Variants(error) => error.exit(),
            Self::Join(error) => error.exit(),
            Self::Memory(_) | Self::Encode { .. } => Exit::Resource,
            Self::ErrorMissed(_) => Exit::Inaccurate,
            Self::SameFile { .. }
            | Self::UnknownMesh { .. }
            | Self::MissingMesh { .. }
            | Self::UnknownMode { .. }
            | Self::UnknownSpec { .. }
            | Self::NoAnimation(_)
            | Self::NotDivided(_)
            | Self::Frames { .. }
            | Self::FilmOfModes { .. }
            | Self::ThinParts { .. }
            | Self::NotShown { .. }
            | Self::NoSpec { .. }
            | Self::UnknownFigure { .. }
            | Self::UnknownPage { .. } => Exit::Use,
        }
    }
}
