//! Checks the texture areas of a spec against the numbers of cells.

use super::Reader;
use crate::error::SweepError;
use crate::sampling::Sweep;
use crate::spec::Area;

impl Reader<'_> {
    pub(super) fn areas(&self, areas: &[Area], sweep: &Sweep) -> Result<(), SweepError> {
        for (i, area) in areas.iter().enumerate() {
            if let Some((key, message)) = area.fault([sweep.rows(), sweep.cols()]) {
                return Err(self.fault(&format!("areas[{i}].{key}"), message));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::sampling::Sweep;
    use files::json::Document;

    fn read(cols: &str) -> Result<Sweep, crate::error::SweepError> {
        let text = format!(
            "{{\"format\": \"tb-sweep\", \"version\": 1, \"name\": \"tube\",\n\
             \"contour\": {{\"circle\": 1}}, \"trajectory\": {{\"line\": [[0, 0, 0], [0, 0, 1]]}},\n\
             \"areas\": [{{\"rows\": [0, 4], \"cols\": {cols}, \"texture\": 2}}],\n\
             \"mesh\": {{\"rows\": 4, \"cols\": 8}}}}"
        );
        Sweep::read(&Document::new("a.json", text.as_bytes())?)
    }

    #[test]
    fn areas_are_handed_on_and_those_that_are_not_there_refused() {
        let grid = read("[0, 8]").unwrap().grid();
        assert_eq!((grid.areas.len(), grid.area_fault(), grid.cells()), (1, None, [4, 8]));
        let message = read("[3, 9]").unwrap_err().to_string();
        assert!(message.starts_with("a.json:3:"), "{message}");
        assert!(message.contains("areas[0].cols: found [3, 9], expected two rising"), "{message}");
        let message =
            read("[0, 8]").unwrap().with_resolution(Some(3), None).unwrap_err().to_string();
        assert!(message.starts_with("areas, rows: found [0, 4], expected"), "{message}");
    }
}
