//! The end of a search whose finer cells are of no use.
//!
//! The load of a smooth surface falls with the number of cells. At an edge inside a cell the angle stays, however
//! fine the cells are.

/// Factor by which a trial must have more cells than the best one so far, to show whether cells can be fine enough.
const FINER: f64 = 1.5;

/// A finer trial whose load is above this fraction of the load of a coarser one is not nearer to the tolerance. The
/// load of a smooth surface falls with the number of cells.
const NEARER: f64 = 0.85;

/// Number of finer trials that are not nearer before the search ends.
const PATIENCE: usize = 2;

/// The best trials so far, by which a search finds that finer cells are of no use.
#[derive(Debug, Default)]
pub struct Stall {
    /// Number of cells and load of the trial with the least load.
    best: Option<(usize, f64)>,
    /// Number of finer trials since then.
    since: usize,
}

impl Stall {
    /// Returns whether the last finer trial was not nearer.
    pub fn has_met_one(&self) -> bool {
        self.since > 0
    }

    /// Takes a trial of this number of cells and this largest load into account. Returns whether finer cells are of no use.
    pub fn found(&mut self, quads: usize, worst: f64) -> bool {
        match self.best {
            Some((cells, load)) if worst > 1.0 && worst > NEARER * load => {
                self.since += usize::from(quads as f64 >= FINER * cells as f64);
            }
            _ => {
                self.best = Some((quads, worst));
                self.since = 0;
            }
        }
        self.since >= PATIENCE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_that_falls_with_the_cells_does_not_stall_and_one_that_stays_does() {
        let mut falling = Stall::default();
        assert!((0..9).all(|i| !falling.found(1000 << i, 512.0 / f64::from(1 << i))));
        let mut staying = Stall::default();
        let found: Vec<bool> = (0..4).map(|i| staying.found(1000 << i, 9.0)).collect();
        assert_eq!(found, [false, false, true, true]);
    }
}
