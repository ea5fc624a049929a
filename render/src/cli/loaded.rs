//! The text of a scene and its given meshes, from which one or several scenes are made.

use super::mesh;
use files::json::Document;
use files::memory::Reserved;
use files::{JsonError, Ledger, Report, Setting, setting};
use render::Scene;
use render::scene::read::{self, Draft};
use render::scene::{MeshSource, SceneError};
use std::path::Path;

/// A scene as it was read, before values are set in it.
#[derive(Debug)]
pub struct Loaded<'a> {
    /// Name of the scene in messages.
    pub name: String,
    /// Text of the scene.
    pub text: Vec<u8>,
    /// Folder to which the paths of the scene are relative.
    pub folder: &'a Path,
    /// The meshes that are given to the scene.
    pub given: MeshSource,
    /// The files of the run.
    pub ledger: &'a Ledger,
    /// The memory of the given meshes.
    pub _kept: Vec<Reserved<'static>>,
}

impl Loaded<'_> {
    /// Returns the text with these values.
    pub fn text_with(&self, settings: &[Setting]) -> Result<Vec<u8>, Report> {
        Ok(setting::apply(&self.name, self.text.clone(), settings)?)
    }

    /// Checks the types of the scene with these values, and that it has meshes of these names.
    pub fn check<'n>(
        &self,
        settings: &[Setting],
        names: impl IntoIterator<Item = &'n str>,
    ) -> Result<(), Report> {
        self.draft(settings, |draft| Ok(draft.check_mesh_names(names)?))
    }

    /// Makes the scene with these values, and calls `then` with the scene and its files. The given meshes are copied
    /// unless this scene is the last.
    pub fn scene<T>(
        &mut self,
        settings: &[Setting],
        last: bool,
        then: impl FnOnce(&Draft<'_>, Scene) -> Result<T, Report>,
    ) -> Result<T, Report> {
        let given = if last { std::mem::take(&mut self.given) } else { self.given.clone() };
        self.draft(settings, |draft| {
            let scene = draft.resolve(self.ledger, given)?;
            then(draft, scene)
        })
    }

    fn draft<T>(
        &self,
        settings: &[Setting],
        then: impl FnOnce(&Draft<'_>) -> Result<T, Report>,
    ) -> Result<T, Report> {
        let text = self.text_with(settings)?;
        let name = setting::name(self.name.clone(), settings);
        let hinted = |error: JsonError| SceneError::Json(mesh::hinted(&text, error));
        let document = Document::new(&name, &text).map_err(hinted)?;
        let file = match read::parse(&document) {
            Err(SceneError::Json(error)) => return Err(hinted(error).into()),
            other => other?,
        };
        then(&Draft::gather(&document, &file, self.folder, self.ledger)?)
    }
}
