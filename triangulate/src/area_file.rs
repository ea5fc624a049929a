//! Reads texture areas that replace or add to those of a grid, from a JSON file: `tb-areas` version 1.
//!
//! ```json
//! {
//!   "format": "tb-areas", "version": 1,
//!   "patch": "cup",
//!   "areas": [
//!     { "rows": [0, 48], "cols": [0, 16], "texture": 2 },
//!     { "rows": [10, 20], "cols": [4, 12], "texture": 3, "surface": 1, "repeat": [2, 1] }
//!   ]
//! }
//! ```
//!
//! The areas have the keys of a spec's areas ([`Area`]) and lie on top of the grid's own areas.
//! `patch` names the patch that receives the areas. This key may be left out when the object has
//! one patch.

use files::JsonError;
use files::json::Document;
use serde::Deserialize;
use sweep::GridMesh;
use sweep::grid::Area;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct AreaFile {
    #[expect(dead_code, reason = "looked at by Document::expect, and must be there")]
    format: String,
    #[expect(dead_code, reason = "looked at by Document::expect, and must be there")]
    version: u32,
    #[serde(default)]
    patch: Option<String>,
    areas: Vec<Area>,
}

/// Adds the areas of a file to the patch that the file names.
///
/// # Errors
/// When the document is not a `tb-areas` file, names no patch of the object, or holds an area that does
/// not lie on the patch.
pub fn add(document: &Document<'_>, grids: &mut [GridMesh]) -> Result<(), JsonError> {
    document.expect("tb-areas", 1)?;
    let file: AreaFile = document.parse()?;
    let known = || grids.iter().map(|grid| grid.name.as_str()).collect::<Vec<_>>().join(", ");
    let grid = match &file.patch {
        Some(name) if !grids.iter().any(|grid| grid.name == *name) => {
            let message = format!("found {name:?}, expected one of: {}", known());
            return Err(document.fault("patch", message));
        }
        None if grids.len() != 1 => {
            let message = format!("found no \"patch\", expected the name of one: {}", known());
            return Err(document.fault("", message));
        }
        name => grids.iter_mut().find(|grid| name.as_ref().is_none_or(|name| grid.name == *name)),
    };
    let Some(grid) = grid else { return Ok(()) };
    let cells = grid.cells();
    for (i, area) in file.areas.iter().enumerate() {
        if let Some((key, message)) = area.fault(cells) {
            return Err(document.fault(&format!("areas[{i}].{key}"), message));
        }
    }
    grid.areas.extend(file.areas);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(name: &str) -> GridMesh {
        let places = (0..=60).map(|i| f64::from(i) / 60.0);
        let (u, v) = (places.clone().collect(), places.collect());
        GridMesh { name: name.into(), u, v, ..GridMesh::default() }
    }

    fn added(text: &str, grids: &mut [GridMesh]) -> Result<(), JsonError> {
        add(&Document::new("areas.json", text.as_bytes())?, grids)
    }

    #[test]
    fn the_file_on_this_page_is_added_to_its_patch() {
        let page = include_str!("area_file.rs").lines().skip_while(|line| *line != "//! ```json");
        let lines = page.skip(1).take_while(|line| *line != "//! ```");
        let text: String = lines.map(|line| line.trim_start_matches("//!")).collect();
        let mut grids = [grid("handle"), grid("cup")];
        added(&text, &mut grids).unwrap();
        assert_eq!(grids.each_ref().map(|grid| grid.areas.len()), [0, 2]);
        added(&text, &mut grids).unwrap();
        assert_eq!(grids.each_ref().map(|grid| grid.areas.len()), [0, 4]);
        added(&text.replace("\"patch\": \"cup\",", ""), &mut grids[..1]).unwrap();
        assert_eq!(grids[0].areas.len(), 2);
    }

    #[test]
    fn what_is_wrong_has_its_place() {
        let file = |rest: &str| format!("{{\"format\": \"tb-areas\", \"version\": 1,\n{rest}}}");
        let area = "\"areas\": [{\"rows\": [0, 1], \"cols\": [0, 61]}]";
        for (text, expected) in [
            (file(area), "found no \"patch\", expected the name of one: handle, cup"),
            (
                file(&format!("\"patch\": \"cap\", {area}")),
                "found \"cap\", expected one of: handle, cup",
            ),
            (
                file(&format!("\"patch\": \"cup\", {area}")),
                "areas[0].cols: found [0, 61], expected two rising numbers from 0 to 60",
            ),
            (file("\"patch\": \"cup\", \"areas\": [{\"rows\": [0, 1]}]"), "cols"),
            (file("\"patch\": \"cup\", \"area\": []"), "areas"),
        ] {
            let message = added(&text, &mut [grid("handle"), grid("cup")]).unwrap_err().to_string();
            assert!(message.starts_with("areas.json:"), "{message}");
            assert!(message.contains(expected), "{message}");
        }
    }
}
