//! The lids of a group of sweeps: an outline and its holes, closed together at an end.

use super::Sweep;
use crate::curve::cut::Stop;
use crate::grid::{End, Lid};
use crate::surface::lid::filled;
use crate::surface::profile::Column;
use glam::DVec2;

/// Returns the lids of a group of sweeps along one trajectory. An end without area has none: there, the sides meet in
/// an edge or in a point. `None` if the outlines of an end, with the columns that the sweeps have, cross themselves or
/// each other.
pub(crate) fn of(group: &[Sweep]) -> Option<Vec<Lid>> {
    let Some(first) = group.first() else { return Some(Vec::new()) };
    let ends = [(End::Start, Stop::after(0.0), -1.0), (End::End, Stop::before(1.0), 1.0)];
    ends.into_iter()
        .zip(first.lids)
        .filter(|(_, closed)| *closed)
        .map(|((end, stop, side), _)| lid(group, end, stop, side))
        .filter(|lid| lid.as_ref().is_none_or(|lid| !lid.triangles.is_empty()))
        .collect()
}

fn lid(group: &[Sweep], end: End, stop: Stop, side: f64) -> Option<Lid> {
    let columns: Vec<Vec<Column>> =
        group.iter().map(|sweep| sweep.shape.columns_at(&sweep.col_stops())).collect();
    let sections: Vec<_> = group.iter().map(|sweep| sweep.shape.section(stop)).collect();
    let loops: Vec<Vec<DVec2>> = columns
        .iter()
        .zip(&sections)
        .map(|(columns, section)| {
            columns.iter().map(|column| section.local_point(column)).collect()
        })
        .collect();
    let mut triangles = filled(&loops)?;
    if side < 0.0 {
        triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
    let (low, high) = loops
        .iter()
        .flatten()
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
    let size = high - low;
    let uvs = loops.iter().flatten().map(|&p| {
        // An end without area has no picture.
        let [s, t] =
            if size.cmpgt(DVec2::ZERO).all() { (p - low) / size } else { DVec2::ZERO }.to_array();
        // Seen from outside, no picture is mirrored.
        [if side < 0.0 { 1.0 - s } else { s }, t]
    });
    let uvs = uvs.collect();
    let ahead = sections[0].frame().tangent * side;
    let normals = if group[0].shape.deforms.is_empty() {
        vec![ahead.as_vec3().to_array()]
    } else {
        let of_loop = |((sweep, columns), section): ((&Sweep, &Vec<Column>), _)| {
            let normal = |column| sweep.shape.deformed(section, column, ahead).as_vec3().to_array();
            columns.iter().map(normal).collect::<Vec<_>>()
        };
        group.iter().zip(&columns).zip(&sections).flat_map(of_loop).collect()
    };
    Some(Lid { end, patches: group.len(), triangles, normals, uvs })
}
