//! Texture areas as they are written: `"areas": [A, ...]`. Each area is a rectangle of cells with a texture
//! of its own, fitted to the rectangle.
//!
//! ```json
//! [
//!   { "rows": [0, 48], "cols": [0, 16], "texture": 2 },
//!   { "rows": [10, 20], "cols": [4, 12], "texture": 3, "surface": 1, "repeat": [2, 1] }
//! ]
//! ```
//!
//! Cells are those of `mesh`, counted from 0: `[0, 48]` are the first 48 rows. The picture fills its area
//! once, or `repeat` times, in the direction that `uv.across` gives. `texture` and `surface` are ids; an id
//! that is left out is that of the whole object. Later areas cover earlier ones. `triangulate` writes
//! `usemtl texT_surfS` for each area, and a scene binds these names.

pub use crate::grid::Area;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_areas_on_this_page_are_read() {
        let page = include_str!("areas.rs").lines().skip_while(|line| *line != "//! ```json");
        let lines = page.skip(1).take_while(|line| *line != "//! ```");
        let text: String = lines.map(|line| line.trim_start_matches("//!")).collect();
        let areas: Vec<Area> = serde_json::from_str(&text).unwrap();
        assert_eq!(
            (areas[0].texture, areas[0].surface, areas[0].repeat),
            (Some(2), None, [1.0; 2])
        );
        assert_eq!((areas[1].rows, areas[1].cols), ([10, 20], [4, 12]));
    }
}
