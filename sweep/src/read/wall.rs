//! Reads the wall of a spec.

use super::Reader;
use crate::error::SweepError;
use crate::spec::Spec;
use crate::surface::Shape;
use crate::surface::wall::Wall;

impl Reader<'_> {
    /// Returns the wall of a spec; `shape` is the sheet in the middle of the wall.
    pub(super) fn wall(&self, spec: &Spec, shape: &Shape) -> Result<Option<Wall>, SweepError> {
        let Some(thickness) = spec.wall else {
            return Ok(None);
        };
        self.positive("wall", thickness)?;
        let refused = |message: &str| Err(self.geometry("wall", message));
        if shape.closing.is_none_or(|closing| !closing.mirrored) {
            return refused(
                "found a wall of a surface with two sides, expected `\"seam\": \"mirror\"`",
            );
        }
        if !shape.contour.closed() {
            return refused("found a wall of a surface with a rim, expected a closed contour");
        }
        if !(shape.row_breaks().is_empty() && shape.contour.breaks().is_empty()) {
            return refused("found a wall of a surface with edges or poles, expected a smooth one");
        }
        if !spec.areas.is_empty() {
            return refused("found a wall and areas, expected one of them");
        }
        Ok(Some(Wall { half: 0.5 * thickness }))
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;
    use files::Exit;

    #[test]
    fn what_has_no_smooth_mirrored_sheet_has_no_wall() {
        let eight = "{\"free\": {\"closed\": true, \"points\": [[0,0],[0.4,0.2],[0.4,-0.2],[0,0],\
                     [-0.4,0.2],[-0.4,-0.2]]}}";
        for (contour, keys, message, exit) in [
            (
                "{\"circle\": 0.2}",
                "\"wall\": 0.1",
                "wall: found a wall of a surface with two sides",
                Exit::Geometry,
            ),
            (
                "{\"circle\": 0.2}",
                "\"wall\": 0",
                "wall: found 0.0, expected a number above 0",
                Exit::Malformed,
            ),
            (
                "{\"svg\": \"M-0.2 0H0.2\"}",
                "\"wall\": 0.1, \"seam\": \"mirror\"",
                "wall: found a wall of a surface with a rim",
                Exit::Geometry,
            ),
            (
                "{\"svg\": \"M0 0L0.4 0.2V-0.2L-0.4 0.2V-0.2Z\"}",
                "\"wall\": 0.1, \"seam\": \"mirror\"",
                "wall: found a wall of a surface with edges",
                Exit::Geometry,
            ),
            (
                eight,
                "\"wall\": 0.02, \"seam\": \"mirror\", \"twist\": {\"total\": 180}, \"areas\": [{\"rows\": [0, 4], \"cols\": [0, 8], \"texture\": 2}]",
                "wall: found a wall and areas",
                Exit::Geometry,
            ),
        ] {
            let (found, code) = complaint("{\"circle\": 0.25}", &format!("{contour}, {keys}"));
            assert!(found.contains(message), "{found}");
            assert_eq!(code, exit, "{found}");
        }
    }
}
