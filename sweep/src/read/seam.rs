//! Reads how the surface of a spec returns to its start.

use super::Reader;
use crate::curve::cut::Stop;
use crate::error::SweepError;
use crate::spec::SeamKind;
use crate::surface::Shape;
use crate::surface::closing::{Closing, Ends, SAMPLES};
use crate::surface::modulation::Section;

/// The ends of a trajectory meet if they are at most this fraction of the section's size apart.
const MEETS: f64 = 1e-6;

/// Unit vectors that differ by at most this are one direction; in radians for such small angles.
const ALIKE: f64 = 1e-3;

impl Reader<'_> {
    /// Closes a shape whose trajectory is open at its ends, or whose contour does not return to
    /// itself.
    pub(super) fn closed(&self, mut shape: Shape, kind: SeamKind) -> Result<Shape, SweepError> {
        let refusal = |message: String| self.geometry("seam", message);
        let refused = |message: String| Err(refusal(message));
        let mirrored = kind == SeamKind::Mirror;
        let closed = shape.contour.closed();
        if shape.trajectory.is_rotation() {
            return refused(
                "found a seam of a rotation, expected none, since each column meets itself".into(),
            );
        }
        if shape.caps.iter().any(Option::is_some) {
            return refused("found a seam and caps, expected one of them".into());
        }
        if !closed && !mirrored {
            return refused(
                "found the shift of an open contour, expected `mirror` or a closed contour".into(),
            );
        }
        if shape.trajectory.breaks().first() == Some(&0.0) {
            return refused(
                "found a corner where the trajectory closes, expected a trajectory that starts at \
                 another point"
                    .into(),
            );
        }
        let stops: Vec<Stop> = (0..SAMPLES + usize::from(!closed))
            .map(|i| Stop::after(i as f64 / SAMPLES as f64))
            .collect();
        let columns = shape.contour.columns(&stops);
        let [first, last] = [Stop::after(0.0), Stop::before(1.0)]
            .map(|stop| shape.modulation.section(&shape.trajectory, stop));
        let [from, to] = [&first, &last].map(Section::frame);
        let size =
            columns.iter().map(|column| first.local_point(column).length()).fold(0.0, f64::max);
        let gap = from.origin.distance(to.origin);
        if gap > MEETS * size {
            return refused(format!(
                "found a trajectory that ends {gap:.1e} from its start, expected the same point"
            ));
        }
        let agree = from.tangent.dot(to.tangent).signum();
        let off = from.tangent.distance(to.tangent * agree);
        if off > ALIKE {
            return refused(format!(
                "found a trajectory whose directions at the start and at the end differ by {:.2} \
                 degrees, expected 0 or 180",
                from.tangent.dot(to.tangent).clamp(-1.0, 1.0).acos().to_degrees()
            ));
        }
        let ends = Ends {
            start: &columns.iter().map(|column| first.local_point(column)).collect::<Vec<_>>(),
            end: &columns
                .iter()
                .map(|column| from.across(last.point(column) - to.origin))
                .collect::<Vec<_>>(),
            closed,
            against: agree < 0.0,
            turned: shape.trajectory.closing_turn(),
        };
        let free = shape.modulation.twist.is_none();
        let closing = ends.close(mirrored, free).map_err(|missed| {
            let how = match (mirrored, free) {
                (true, true) => "turned and mirrored",
                (true, false) => "mirrored after its twist",
                (false, true) => "turned",
                (false, false) => "shifted after its twist",
            };
            refusal(format!(
                "found a contour that differs by {missed:.1e} of its size from the contour at the \
                 start when {how}, expected a contour that coincides with the one at the start"
            ))
        })?;
        shape.modulation.turn = closing.turn;
        shape.closing = Some(closing);
        let edge = Self::has_edge(&shape, closing, &stops);
        shape.closing = Some(Closing { edge, ..closing });
        if shape.seam(&shape.even_columns(shape.contour.fewest_cells())).is_some() {
            return Ok(shape);
        }
        refused(
            "found corners of the contour that do not meet corners over the seam, expected \
             columns at the same positions on both sides of the seam"
                .into(),
        )
    }

    /// Returns whether the normal jumps by more than rounding where the surface closes.
    fn has_edge(shape: &Shape, closing: Closing, stops: &[Stop]) -> bool {
        let side = if closing.mirrored { -1.0 } else { 1.0 };
        stops.iter().step_by(7).any(|&stop| {
            let led = closing.leads_to(shape.contour.closed(), stop);
            let (_, before) = shape.at(stop.at, 1.0);
            let (_, after) = shape.at(led.at, 0.0);
            before.distance(after * side) > ALIKE
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;
    use files::Exit;

    #[test]
    fn what_does_not_meet_itself_is_refused_with_how_far_it_misses() {
        for (contour, keys, message) in [
            ("{\"circle\": 1}", "\"caps\": {\"end\": \"flat\"}", "caps: found a closed trajectory"),
            ("{\"svg\": \"M0 0H1\"}", "\"seam\": \"shift\"", "seam: found the shift of an open"),
            (
                "{\"svg\": \"M0 0H1\"}",
                "\"seam\": \"mirror\"",
                "seam: found a contour that differs by 1.0e0 of its size from the contour at the \
                 start when turned and mirrored",
            ),
            (
                "{\"svg\": \"M-1 0H1\"}",
                "\"seam\": \"mirror\", \"twist\": {\"total\": 90}",
                "mirrored after its twist",
            ),
            (
                "{\"svg\": \"M2 0L-1 1L-1 -1.1Z\"}",
                "\"seam\": \"mirror\"",
                "seam: found a contour that differs by",
            ),
        ] {
            let (found, exit) = complaint("{\"circle\": 0.25}", &format!("{contour}, {keys}"));
            assert!(found.contains(message), "{found}");
            assert_eq!(exit, Exit::Geometry);
        }
    }
}
