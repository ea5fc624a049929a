//! Volume, area and size of an object, and whether it is watertight.
//!
//! The volume is the sum of signed volumes of the tetrahedra from one point to all triangles (the divergence theorem).
//! A cell counts as the mean of both its splits into triangles, so that the two sides of a thin twisted body fit each other.

use super::{Finding, Severity, short};
use crate::grid::{End, GridMesh, Lid, Seam, Unit};
use crate::sampling::{Object, Sweep};
use glam::DVec3;

/// How a surface closes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The surface encloses a volume.
    Watertight,
    /// The surface has a rim.
    Open,
    /// The surface has one side.
    OneSided,
}

/// Measures of an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// How the surface closes.
    pub kind: Kind,
    /// Enclosed volume, below 0 if the outside is inside; meaningful for a watertight object only.
    pub volume: f64,
    /// Area of all surfaces.
    pub area: f64,
    /// Smallest and largest coordinates.
    pub bounds: [DVec3; 2],
    /// True if every surface of one side can have a wall, which needs a closed contour.
    pub wallable: bool,
    /// Number of surfaces that are closed by themselves.
    pub bodies: usize,
}

impl Measures {
    /// Returns the measures of an object with its grids.
    #[must_use]
    pub fn of(object: &Object, grids: &[GridMesh]) -> Self {
        let all = || grids.iter().flat_map(|grid| &grid.positions);
        let bounds = all().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| {
            [low.min(*p), high.max(*p)]
        });
        // Far from the origin a nearer point keeps the digits.
        let origin = grids.first().and_then(|grid| grid.positions.first()).copied();
        let origin = origin.unwrap_or_default();
        let (mut volume, mut area) = (0.0, 0.0);
        let mut add = |[a, b, c]: [DVec3; 3], part: f64| {
            let across = (b - a).cross(c - a) * part;
            area += 0.5 * across.length();
            volume += (a - origin).dot(across) / 6.0;
        };
        for (i, grid) in grids.iter().enumerate() {
            triangles(grid, &mut add);
            for lid in &grid.lids {
                let group = &grids[(i + 1).saturating_sub(lid.patches)..=i];
                of_lid(lid, group, &mut add);
            }
        }
        let kinds = object.parts().iter().zip(grids).map(|(sweep, grid)| kind(sweep, grid));
        let worst = |a: Kind, b: Kind| match (a, b) {
            (Kind::OneSided, _) | (_, Kind::OneSided) => Kind::OneSided,
            (Kind::Open, _) | (_, Kind::Open) => Kind::Open,
            _ => Kind::Watertight,
        };
        let kind = kinds.fold(Kind::Watertight, worst);
        let bodies = object.parts().iter().filter(|sweep| sweep.group > 0).count();
        let mirrored = |grid: &&GridMesh| grid.seam_v == Seam::Mirror;
        let wallable = grids.iter().filter(mirrored).all(|grid| grid.seam_u.joins());
        Self { kind, volume, area, bounds, wallable, bodies }
    }

    /// Returns one line about an object: whether it is watertight, and its sizes.
    #[must_use]
    pub fn line(&self, name: &str, unit: Option<Unit>) -> String {
        let unit =
            |power: &str| unit.map_or(String::new(), |unit| format!(" {}{power}", unit.symbol()));
        let size = self.bounds[1] - self.bounds[0];
        let kind = match self.kind {
            Kind::Watertight if self.bodies > 1 => format!(
                "watertight, {} bodies with volumes of {}{} together",
                self.bodies,
                short(self.volume),
                unit("^3")
            ),
            Kind::Watertight => format!("watertight, volume {}{}", short(self.volume), unit("^3")),
            Kind::Open => "open".into(),
            Kind::OneSided => "one-sided".into(),
        };
        format!(
            "{name}: {kind}, area {}{}, box {} x {} x {}{}",
            short(self.area),
            unit("^2"),
            short(size.x),
            short(size.y),
            short(size.z),
            unit("")
        )
    }

    /// Returns findings about an object that is inside out, has one side, or is printed.
    #[must_use]
    pub fn findings(&self, unit: Option<Unit>) -> Vec<Finding> {
        let mut found = Vec::new();
        if self.kind == Kind::Watertight && self.volume < 0.0 {
            let message = format!(
                "the volume is {}: the outside of the surface lies inside; drawn in the other direction the contour has \
                 its outside outside",
                short(self.volume)
            );
            found.push(Finding::new(Severity::Hint, "contour", message));
        }
        if self.kind == Kind::OneSided && self.wallable {
            let message = "the surface has one side and encloses no volume, which printers and readers of STL need: \
                           `\"wall\": thickness` encloses one";
            found.push(Finding::new(Severity::Remark, "seam", message));
        }
        let printed = matches!(unit, Some(Unit::Mm | Unit::Cm | Unit::In));
        if self.kind == Kind::Watertight && printed {
            let message = "y points up here and z in slicers: `triangulate --up z` turns the mesh";
            found.push(Finding::new(Severity::Remark, "unit", message));
        }
        found
    }
}

/// Returns how a part closes, with the lids of its group.
fn kind(sweep: &Sweep, grid: &GridMesh) -> Kind {
    let (rows, cols) = (grid.rows(), grid.cols());
    let ends = [0, rows - 1].map(|row| &grid.positions[row * cols..(row + 1) * cols]);
    let pole = |row: &[DVec3]| row.iter().all(|p| *p == row[0]);
    let column =
        |col: usize| (0..rows).all(|row| grid.positions[row * cols + col] == grid.positions[col]);
    let around = grid.seam_u.joins() || (column(0) && column(cols - 1));
    let along = grid.seam_v.joins()
        || (0..2).all(|end| sweep.lids[end] || grid.pressed[end] || pole(ends[end]));
    match (grid.seam_v, around && along) {
        (Seam::Mirror, _) => Kind::OneSided,
        (_, true) => Kind::Watertight,
        (_, false) => Kind::Open,
    }
}

/// Passes the triangles of both splits of each cell on, each with the part of a half.
fn triangles(grid: &GridMesh, add: &mut impl FnMut([DVec3; 3], f64)) {
    for cell in grid.quads() {
        let [a, b, c, d] = cell.corners.map(|corner| grid.positions[corner]);
        for corners in [[a, b, c], [a, c, d], [a, b, d], [b, c, d]] {
            add(corners, 0.5);
        }
    }
}

/// Passes the triangles of a lid on. Its corners count the points of all loops, one after another.
fn of_lid(lid: &Lid, group: &[GridMesh], add: &mut impl FnMut([DVec3; 3], f64)) {
    let ends = group.iter().flat_map(|grid| {
        let row = if lid.end == End::Start { 0 } else { grid.rows() - 1 };
        &grid.positions[row * grid.cols()..(row + 1) * grid.cols()]
    });
    let points: Vec<DVec3> = ends.copied().collect();
    for corners in &lid.triangles {
        add(corners.map(|corner| points[corner as usize]), 1.0);
    }
}
