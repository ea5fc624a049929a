//! The curves of a sweep as points, for programs that draw them themselves.

use super::course;
use crate::curve::cut::{self, Stop};
use crate::frame::Frame;
use crate::sampling::Sweep;
use glam::{DVec2, DVec3};

/// The curves of a sweep, sampled evenly.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// Points of each contour in its plane. A closed contour does not repeat its first point.
    pub contours: Vec<Vec<DVec2>>,
    /// True if the contours are closed.
    pub is_closed: bool,
    /// Frames along the trajectory, from its start to its end. Those of a rotation are on the circle of its widest
    /// point.
    pub course: Vec<Frame>,
    /// True if the trajectory is a rotation about an axis.
    pub is_rotation: bool,
    /// Points of the surface along the contour at each station, from the start of the trajectory to its end.
    pub stations: Vec<Vec<DVec3>>,
}

impl Drawn {
    /// Samples a sweep: contours and stations at `places` points or somewhat more, the trajectory in `pieces` pieces,
    /// with `stations` stations. All numbers must be at least 1.
    #[must_use]
    pub fn of(sweep: &Sweep, places: usize, pieces: usize, stations: usize) -> Self {
        let contour = sweep.contour();
        let stops =
            cut::evenly(contour.breaks(), contour.closed(), places.max(contour.fewest_cells()));
        let columns = contour.columns(&stops);
        let of_contour = |one: usize| {
            let local = columns.iter().map(|column| match one {
                0 => column.first.point,
                _ => column.others[one - 1].point,
            });
            local.collect()
        };
        let spaces = if sweep.trajectory().closed() { stations } else { stations.max(2) - 1 };
        let station = |k: usize| {
            let v = k as f64 / spaces as f64;
            stops.iter().map(|stop: &Stop| sweep.at(stop.at, v).0).collect()
        };
        Self {
            contours: (0..contour.contours()).map(of_contour).collect(),
            is_closed: contour.closed(),
            course: course::frames(sweep, pieces),
            is_rotation: sweep.trajectory().is_rotation(),
            stations: (0..stations).map(station).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::json::Document;

    #[test]
    fn a_circle_along_a_line_is_drawn_where_it_is() {
        let text =
            br#"{"format": "tb-sweep", "version": 1, "name": "pipe", "contour": {"circle": 2},
            "trajectory": {"line": [[0, 0, 0], [0, 3, 0]]}, "mesh": {"rows": 2, "cols": 16}}"#;
        let sweep = Sweep::read(&Document::new("pipe.json", text).unwrap()).unwrap();
        let drawn = Drawn::of(&sweep, 32, 10, 4);
        assert!(drawn.is_closed && !drawn.is_rotation && drawn.contours.len() == 1);
        assert!(drawn.contours[0].iter().all(|p| (p.length() - 2.0).abs() < 1e-12));
        assert_eq!(drawn.course.len(), 11);
        assert!(drawn.course[10].origin.abs_diff_eq(DVec3::new(0.0, 3.0, 0.0), 1e-12));
        let heights: Vec<f64> = drawn.stations.iter().map(|station| station[0].y).collect();
        assert!(heights.iter().zip([0.0, 1.0, 2.0, 3.0]).all(|(y, at)| (y - at).abs() < 1e-12));
        assert!(drawn.stations[2].iter().all(|p| (p.with_y(0.0).length() - 2.0).abs() < 1e-12));
    }
}
