//! The thread of checks: findings of `sweep --check`, measures and the topology of each mesh.

use super::board::{Board, Snapshot, Task};
use super::mesh::{self, Finish};
use super::scene_check;
use crate::job::MeshJob;
use crate::{Job, PipelineError};
use files::Source;
use files::check::Finding;
use files::json::Document;
use serde_json::{Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Duration;
use sweep::check::measures::{Kind, Measures};
use triangulate::{MeshReport, Patches, TriMesh};

/// Time without changes after which a check starts.
const QUIET: Duration = Duration::from_millis(150);

/// Time without changes after which the check of the scene starts.
const REST: Duration = Duration::from_millis(1500);

/// Checks specs and scenes until the board ends.
pub fn run(board: &Board) {
    let mut seen = 0;
    loop {
        let mut snapshot = match board.next(seen, false) {
            Task::Draw(snapshot) => snapshot,
            Task::Answer(_) => continue,
            Task::End => return,
        };
        seen = snapshot.revision;
        board.linger(seen, QUIET);
        if board.now().is_some_and(|now| now.revision != seen) {
            continue;
        }
        snapshot.view.size = [512, 512];
        // A panic is a bug of ours, which the thread of pictures meets and tells as well.
        let work = AssertUnwindSafe(|| specs(&snapshot));
        if let Ok(Ok(specs)) = catch_unwind(work) {
            let facts = json!({ "revision": snapshot.revision, "specs": specs });
            board.tell("spec-check", &facts);
        }
        // The check of a scene takes longer, and waits until the user rests.
        board.linger(seen, REST);
        if board.now().is_some_and(|now| now.revision == seen) {
            let work = AssertUnwindSafe(|| scene_check::tell(board, &snapshot));
            let _ = catch_unwind(work);
        }
    }
}

/// Returns the findings and measures of all meshes of a job.
fn specs(snapshot: &Snapshot) -> Result<Vec<Value>, PipelineError> {
    let job = Job::read(Path::new(&snapshot.opened.job), &snapshot.source)?;
    let (name, bytes) = (job.scene.display().to_string(), snapshot.source.read_json(&job.scene)?);
    let file = render::scene::read::parse(&Document::new(&name, &bytes)?)?;
    let camera = mesh::camera_of(&file.camera, snapshot.view.pixels());
    let of_mesh = |mesh: &MeshJob| {
        let path = snapshot.opened.specs.iter().find(|(name, _)| *name == mesh.name);
        let path = path.map(|(_, path)| path.as_str()).unwrap_or_default();
        let object = mesh::object(mesh, &snapshot.source, camera, Finish::Stated)?;
        let grids = object.grids()?;
        let findings = sweep::check::check(&object, &grids, None);
        let measures = Measures::of(&object, &grids);
        let (triangles, counts) = grids.as_slice().run(&mesh.options, TriMesh::default())?;
        let report = MeshReport::of(&triangles, &counts);
        let [low, high] = measures.bounds;
        let closes = match measures.kind {
            Kind::Watertight => "watertight",
            Kind::Open => "open: the surface has a rim; caps or a wall close it",
            Kind::OneSided => "one-sided: a wall makes it a body",
        };
        Ok(json!({
            "name": mesh.name, "path": path, "findings": listed(path, &findings),
            "measures": {
                "closes": closes,
                "watertight": measures.kind == Kind::Watertight,
                "volume": (measures.kind == Kind::Watertight).then_some(measures.volume),
                "area": measures.area,
                "size": (high - low).to_array(),
                "low": low.to_array(),
                "unit": object.unit().map(sweep::grid::Unit::symbol),
                "euler": report.euler, "rims": report.boundary_loops,
                "sides": if report.orientable { 2 } else { 1 },
                "vertices": report.vertices, "triangles": report.faces,
            },
        }))
    };
    job.meshes.iter().map(of_mesh).collect()
}

/// Returns findings as the windows show them, about the file at `path`.
pub fn listed(path: &str, findings: &[Finding]) -> Vec<Value> {
    let one = |finding: &Finding| {
        json!({ "file": path, "severity": finding.severity.to_string(), "path": finding.path,
            "message": finding.message })
    };
    findings.iter().map(one).collect()
}
