//! Findings about a surface that folds back on itself.

use super::{Finding, Severity, ranges, short};
use crate::sampling::Survey;

use crate::sampling::TOUCHES;

impl Survey {
    /// Returns a finding for each reason for which the surface folds.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let folds = |is: &[bool], path: &str, why: &str| {
            let count = is.iter().filter(|&&folded| folded).count();
            let rows = if count == 1 { "row" } else { "rows" };
            let message = format!(
                "the surface folds back on itself in {count} {rows}, where {why} ({})",
                ranges(&self.rows, is)
            );
            (count > 0).then(|| Finding::new(Severity::Wrong, path, message))
        };
        let (worst, fits) = (short(self.worst().unwrap_or(0.0)), short(self.fits().unwrap_or(0.0)));
        let bend = format!(
            "the trajectory bends more sharply than the contour is wide: the least stretch \
             1 - k.q is {worst}, and a contour of up to {fits} times this size passes"
        );
        let relief = "the relief is deeper than the contour's radius of curvature: a smaller \
                      amp passes";
        let bent = folds(&self.bent, "trajectory", &bend).or_else(|| {
            let (worst, [_, v]) = self.worst?;
            let between = format!(
                "the surface folds back on itself between two rows at v {}, where {bend}",
                short(v)
            );
            let touches = format!(
                "the surface touches itself at v {}, where the contour reaches the axis that the \
                 trajectory bends about: a contour smaller than {fits} times this size does not \
                 touch itself",
                short(v)
            );
            if worst < -TOUCHES {
                Some(Finding::new(Severity::Wrong, "trajectory", between))
            } else if worst <= TOUCHES {
                Some(Finding::new(Severity::Hint, "trajectory", touches))
            } else {
                None
            }
        });
        let deformed = folds(&self.deformed, "deform", "a bend turns space inside out");
        bent.into_iter().chain(folds(&self.relief, "depth", relief)).chain(deformed).collect()
    }
}
