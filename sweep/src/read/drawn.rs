//! Curves of a contour as they are drawn, before their directions and corners count.

use crate::curve::{Cubic, Path};
use crate::surface::contour::Contour;
use glam::DVec2;
use kurbo::{CubicBez, Point, Shape};

/// Straight pieces of a polygon that stands for a loop, for each of its cubics.
const PIECES: usize = 16;

/// A loop, or an open curve, as it is drawn.
#[derive(Debug, Clone)]
pub(super) enum Drawn {
    Circle { center: DVec2, radius: f64 },
    Curve { path: Path<DVec2>, reached: Option<f64> },
}

impl Drawn {
    pub(super) fn closed(&self) -> bool {
        match self {
            Self::Circle { .. } => true,
            Self::Curve { path, .. } => path.closed(),
        }
    }

    pub(super) fn contour(self) -> Contour {
        match self {
            Self::Circle { center, radius } => Contour::circle(center, radius),
            Self::Curve { path, reached } => Contour::fitted(path, reached),
        }
    }

    /// Returns the corners of the box around the curve.
    pub(super) fn bounds(&self) -> [DVec2; 2] {
        match self {
            Self::Circle { center, radius } => [*center - *radius, *center + *radius],
            Self::Curve { path, .. } => path
                .cubics()
                .map(|cubic| {
                    let [p0, p1, p2, p3] = cubic.0.map(|p| Point::new(p.x, p.y));
                    CubicBez::new(p0, p1, p2, p3).bounding_box()
                })
                .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], bounds| {
                    [
                        low.min(DVec2::new(bounds.x0, bounds.y0)),
                        high.max(DVec2::new(bounds.x1, bounds.y1)),
                    ]
                }),
        }
    }

    pub(super) fn moved(self, by: DVec2) -> Option<Self> {
        Some(match self {
            Self::Circle { center, radius } => Self::Circle { center: center + by, radius },
            Self::Curve { path, reached } => {
                let cubics: Vec<_> =
                    path.cubics().map(|cubic| Cubic(cubic.0.map(|p| p + by))).collect();
                Self::Curve { path: Path::new(&cubics, path.closed())?, reached }
            }
        })
    }

    pub(super) fn polygon(&self) -> Vec<DVec2> {
        match self {
            Self::Circle { center, radius } => (0..4 * PIECES)
                .map(|i| crate::curve::turn(i as f64 / (4 * PIECES) as f64) * *radius + *center)
                .collect(),
            Self::Curve { path, .. } => {
                let part = |i: usize| i as f64 / PIECES as f64;
                path.cubics()
                    .flat_map(|cubic| (0..PIECES).map(move |i| cubic.point(part(i))))
                    .collect()
            }
        }
    }
}
