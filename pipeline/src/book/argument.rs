//! Explains why a page takes its time.

use super::plate::Plate;
use crate::number::{count, millions};
use crate::stages::Stages;

/// Returns the slowest stage of a page and the work it did: a sentence or two, with the page's own
/// counts.
#[must_use]
pub fn argument(plate: &Plate) -> String {
    let (stage, part) = plate.total().slowest();
    let triangles: usize = plate.meshes.iter().map(|(_, triangles)| triangles).sum();
    let own = || plate.shots.iter().filter(|shot| shot.own);
    let why = match stage {
        "picture" => rays(plate),
        "tables" => {
            let bytes: u64 = own().map(|shot| shot.stats.table_bytes).max().unwrap_or(0);
            format!(
                "prefiltered tables, {} MB at once, are summed before the first ray.",
                bytes.div_ceil(1 << 20)
            )
        }
        "structure" => {
            format!(
                "boxes around {} triangles are sorted anew for each mode.",
                count(triangles as u64)
            )
        }
        "sweep" => {
            "resolution is sought until the tolerance is kept, and every row is evaluated.".into()
        }
        "triangulate" => format!("{} triangles are welded and split.", count(triangles as u64)),
        "read" => "textures are decoded and put into linear light, one after another.".into(),
        _ => "there is little to compute, and a PNG is compressed on one core.".into(),
    };
    format!("Slowest is the stage “{stage}”, {:.0} %: {why}", 100.0 * part)
}

/// Returns a sentence on the kinds of rays in the slowest mode.
fn rays(plate: &Plate) -> String {
    let slowest =
        plate.shots.iter().filter(|shot| shot.own).max_by_key(|shot| Stages::total(&shot.stages));
    let Some(shot) = slowest else { return String::new() };
    let stats = &shot.stats;
    let bent = stats.reflected_rays + stats.refracted_rays;
    let all = stats.primary_rays + bent + stats.shadow_rays;
    let pixels = f64::from(shot.picture.width) * f64::from(shot.picture.height);
    let part = |rays: u64| 100.0 * rays as f64 / all.max(1) as f64;
    let mut kinds = vec![("from the eye", stats.primary_rays)];
    if bent > 0 {
        kinds.push(("mirrored or refracted", bent));
    }
    if stats.shadow_rays > 0 {
        kinds.push(("to lights", stats.shadow_rays));
    }
    kinds.sort_by_key(|(_, rays)| std::cmp::Reverse(*rays));
    let kinds: Vec<String> =
        kinds.iter().map(|(kind, rays)| format!("{:.0} % {kind}", part(*rays))).collect();
    let each = 1e9 * shot.stages.picture.as_secs_f64() / all.max(1) as f64;
    format!(
        "{} rays in the mode {}, {:.0} for each pixel ({}), at {} ns each with all that is shaded.",
        millions(all),
        shot.mode.name,
        all as f64 / pixels,
        kinds.join(", "),
        count(each.round() as u64),
    )
}
