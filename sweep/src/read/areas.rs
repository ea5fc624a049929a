//! The texture areas of a spec, checked against the numbers of cells.

use super::Reader;
use crate::spec::Area;
use crate::{Sweep, SweepError};

impl Reader<'_> {
    pub(super) fn areas(&self, areas: &[Area], sweep: &Sweep) -> Result<(), SweepError> {
        for (i, area) in areas.iter().enumerate() {
            if let Some((key, message)) = area.fault([sweep.rows, sweep.cols]) {
                return Err(self.fault(&format!("areas[{i}].{key}"), message));
            }
        }
        Ok(())
    }
}
