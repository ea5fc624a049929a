//! The curves of the opened specs as points, for the editors of the page.

use super::board::{Board, Snapshot};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;
use sweep::preview::Drawn;
use sweep::{Object, Sweep};

/// Points of a contour, pieces of a trajectory, and stations.
const NUMBERS: [usize; 3] = [120, 120, 9];

/// Most parts of an object whose curves are shown.
const MOST: usize = 12;

/// Tells the windows the curves of the objects, by the names of their meshes.
pub fn tell(board: &Board, snapshot: &Snapshot, objects: &BTreeMap<String, Arc<Object>>) {
    let mut all = Map::new();
    for (name, path) in &snapshot.opened.specs {
        if let Some(object) = objects.get(name) {
            let parts = object.parts().iter().take(MOST).map(part);
            all.insert(path.clone(), parts.collect());
        }
    }
    board.tell("curves", &json!({ "revision": snapshot.revision, "specs": all }));
}

fn part(sweep: &Sweep) -> Value {
    let [places, pieces, stations] = NUMBERS;
    let drawn = Drawn::of(sweep, places, pieces, stations);
    // Single precision is enough for the eye and halves the text.
    let space = |p: glam::DVec3| p.to_array().map(|x| x as f32);
    let contours: Vec<Vec<[f32; 2]>> = drawn
        .contours
        .iter()
        .map(|contour| contour.iter().map(|p| p.to_array().map(|x| x as f32)).collect())
        .collect();
    let course: Vec<_> = drawn.course.iter().map(|frame| space(frame.origin)).collect();
    let every = pieces / 12;
    let frames: Vec<_> = drawn
        .course
        .iter()
        .step_by(every)
        .map(|frame| [space(frame.origin), space(frame.normal), space(frame.binormal)])
        .collect();
    let stations: Vec<Vec<_>> =
        drawn.stations.iter().map(|station| station.iter().map(|p| space(*p)).collect()).collect();
    json!({
        "name": sweep.name(), "closed": drawn.is_closed, "rotation": drawn.is_rotation,
        "contours": contours, "course": course, "frames": frames, "stations": stations,
    })
}
