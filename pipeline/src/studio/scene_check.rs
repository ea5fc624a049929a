//! The findings of `render --check` about the opened scene.

use super::board::{Board, Snapshot};
use super::kept::{Files, Kept};
use super::mesh::Finish;
use super::spec_check::listed;
use files::json::Document;
use files::{Source, input};
use render::Scene;
use render::filter::Filter;
use render::scene::check;
use render::scene::read::{Draft, SceneError, parse};
use serde_json::json;
use std::path::Path;

/// Reads the scene and tells the windows the findings about it.
pub fn tell(board: &Board, snapshot: &Snapshot) {
    let path = &snapshot.opened.scene;
    let files = Files::read(&snapshot.opened.job, &snapshot.source, snapshot.view.pixels());
    let made = files.and_then(|files| Kept::whole(&files, &snapshot.source, Finish::Stated));
    // The thread of pictures tells a fault of the files.
    let Ok(kept) = made else { return };
    if let Ok(report) = report(snapshot, &kept.scene) {
        let findings = listed(path, &report.findings);
        let facts = json!({ "revision": snapshot.revision, "findings": findings,
            "inventory": report.inventory });
        board.tell("scene-check", &facts);
    }
}

fn report(snapshot: &Snapshot, scene: &Scene) -> Result<check::Report, SceneError> {
    let path = Path::new(&snapshot.opened.scene);
    let (name, bytes) = (input::name_of(path), snapshot.source.read_json(path)?);
    let document = Document::new(&name, &bytes)?;
    let file = parse(&document)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let draft = Draft::gather(&document, &file, folder, &snapshot.source)?;
    let [width, height] = snapshot.view.size;
    let aspect = f64::from(width) / f64::from(height);
    check::check(&draft, scene, aspect, &|texture| Filter::Exact.bytes_for(texture))
}
