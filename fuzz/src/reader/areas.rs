//! Reads files of areas.

use super::grid;
use crate::verdict::{Tried, refused};
use files::json::Document;
use sweep::GridMesh;
use triangulate::area_file;

/// Adds the areas to a grid and triangulates the grid. The grid has several patches if the file
/// names one of its patches, and otherwise one patch.
///
/// # Errors
/// When the file is refused, or the triangles are wrong.
pub fn read(bytes: &[u8], grids: &[Vec<GridMesh>]) -> Tried {
    let document = Document::new("areas.json", bytes).map_err(refused)?;
    let text = String::from_utf8_lossy(bytes);
    let named = |grids: &&Vec<GridMesh>| {
        grids.iter().any(|grid| text.contains(&format!("\"patch\":\"{}\"", grid.name)))
    };
    let several = grids.iter().filter(|grids| grids.len() > 1).find(named);
    let Some(grids) = several.or_else(|| grids.iter().find(|grids| grids.len() == 1)) else {
        return Ok(());
    };
    let mut grids = grids.clone();
    area_file::add(&document, &mut grids).map_err(refused)?;
    grid::follow(&grids)
}
