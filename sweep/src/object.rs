//! An object: one sweep, or several that belong together, as a cup and its handle do.

use crate::{GridMesh, Sweep, SweepError, read};
use files::Source;
use files::json::Document;
use std::path::Path;

/// One sweep or several, checked.
#[derive(Debug, Clone)]
pub struct Object {
    pub(crate) name: String,
    pub(crate) parts: Vec<Sweep>,
}

impl Object {
    /// Reads and checks a [`Spec`](crate::spec::Spec), or a spec of [`Parts`](crate::spec::Parts).
    ///
    /// Files that it names count from `folder` and lie in `source`.
    ///
    /// # Errors
    /// When the text is not a spec, a surface does not exist, or a file cannot be read or is not what
    /// it should be; the message has the place.
    pub fn read_in(
        document: &Document<'_>,
        folder: &Path,
        source: &dyn Source,
    ) -> Result<Self, SweepError> {
        read::read(document, folder, source)
    }

    /// The object's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its sweeps, at least one.
    #[must_use]
    pub fn parts(&self) -> &[Sweep] {
        &self.parts
    }

    /// The same object with other numbers of cells in every part; `None` keeps a number.
    ///
    /// # Errors
    /// As [`Sweep::with_resolution`].
    pub fn with_resolution(
        self,
        rows: Option<usize>,
        cols: Option<usize>,
    ) -> Result<Self, SweepError> {
        let parts: Result<_, _> =
            self.parts.into_iter().map(|part| part.with_resolution(rows, cols)).collect();
        Ok(Self { parts: parts?, ..self })
    }

    /// The grids of its parts, in their order.
    ///
    /// # Errors
    /// When there is no memory for them.
    pub fn grids(&self) -> Result<Vec<GridMesh>, SweepError> {
        self.parts.iter().map(Sweep::try_grid).collect()
    }
}
