//! Tests that any grid, written and read back, keeps the same bits.

use super::*;
use crate::grid::{Across, Area, Fold, Seam, Tolerance, Unit, UvLayout, area};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

proptest! {
    #[test]
    fn a_grid_reads_back_to_the_same_bits(grid in grids()) {
        for encoding in [Encoding::Binary, Encoding::Json] {
            let mut bytes = Vec::new();
            write(&grid, encoding, &mut bytes).unwrap();
            assert_same_bits(&grid, &read("a", bytes.as_slice()).unwrap());
        }
    }
}

/// Asserts equality that distinguishes -0 from 0.
fn assert_same_bits(a: &GridMesh, b: &GridMesh) {
    assert_eq!(a, b);
    let bits = |g: &GridMesh| {
        let positions = g.positions.iter().flat_map(DVec3::to_array).map(f64::to_bits);
        let normals = g.normals.iter().flat_map(Vec3::to_array).map(|n| u64::from(n.to_bits()));
        let parameters = g.u.iter().chain(&g.v).chain(&g.uv.repeat).map(|x| x.to_bits());
        positions.chain(normals).chain(parameters).collect::<Vec<u64>>()
    };
    assert_eq!(bits(a), bits(b));
}

/// Returns finite numbers, among them some that text formats often lose.
fn nasty_f64() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::sample::select(vec![
            0.0,
            -0.0,
            5e-324,
            -2.2e-308,
            1e-300,
            1e300,
            f64::MAX,
            0.1,
            1.0 / 3.0,
            1e23,
        ]),
        any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()),
    ]
}

fn nasty_f32() -> impl Strategy<Value = f32> {
    prop_oneof![
        prop::sample::select(vec![0.0, -0.0, 1e-45, -1.1e-38, f32::MAX, 0.1, 16_777_216.0]),
        any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |x| x.is_finite()),
    ]
}

/// Returns `count` parameters from 0, not decreasing, below 1.
fn parameters(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.0..1.0, count - 1).prop_map(|mut list| {
        list.sort_by(f64::total_cmp);
        list.insert(0, 0.0);
        list
    })
}

/// Returns valid seams and shifts for `cols` columns.
fn seams(cols: usize) -> impl Strategy<Value = (Seam, Seam, usize)> {
    let seam = |all: &[Seam]| prop::sample::select(all.to_vec());
    let ways = (seam(&[Seam::Open, Seam::Closed]), seam(&[Seam::Open, Seam::Closed, Seam::Mirror]));
    (ways, 0..cols).prop_map(move |((seam_u, seam_v), shift)| match (seam_u, seam_v) {
        (Seam::Open, Seam::Mirror) => (seam_u, seam_v, cols - 1),
        (Seam::Open, _) | (_, Seam::Open) => (seam_u, seam_v, 0),
        _ => (seam_u, seam_v, shift),
    })
}

fn maybe() -> impl Strategy<Value = Option<f64>> {
    prop::option::of(nasty_f64())
}

/// Returns an area of the first cell along the contour, and one of all cells, if there are any.
fn areas_on(u: &[f64], seam_u: Seam, [texture, surface]: [Option<u32>; 2]) -> Vec<Area> {
    let cells = area::edges(u, seam_u).len() - 1;
    let of = |cols, repeat| Area { rows: [0, 1], cols, texture, surface, repeat };
    let areas = vec![of([0, 1], [1.0, 0.1]), of([0, cells], [1e-9, 1e9])];
    if cells > 0 && texture.is_some() { areas } else { Vec::new() }
}

fn grids() -> impl Strategy<Value = GridMesh> {
    (3_usize..6, 3_usize..6).prop_flat_map(|(rows, cols)| {
        let points = rows * cols;
        (
            (".*", seams(cols), 1e-9..1e9, any::<[Option<u32>; 2]>()),
            (
                prop::option::of((nasty_f64(), 0_usize..9, maybe())),
                prop::option::of([maybe(), maybe(), maybe()]),
            ),
            (parameters(cols), parameters(rows)),
            prop::collection::vec(prop::array::uniform3(nasty_f64()), points),
            prop::collection::vec(prop::array::uniform3(nasty_f32()), points),
        )
            .prop_map(
                |(
                    (name, (seam_u, seam_v, shift), repeat, ids),
                    (fold, tolerance),
                    (u, v),
                    positions,
                    normals,
                )| {
                    GridMesh {
                        lids: Vec::new(),
                        unit: ids[0].map(|_| Unit::Cm),
                        pressed: [false; 2],
                        name,
                        seam_u,
                        seam_v,
                        shift,
                        texture: ids[0],
                        surface: ids[1],
                        fold: fold.map(|(worst, rows, fits)| Fold { worst, rows, fits }),
                        tolerance: tolerance.map(|[asked, reached, pixels]| Tolerance {
                            asked,
                            reached,
                            angle_reached_deg: pixels,
                            angle_asked_deg: reached,
                            pixels,
                        }),
                        areas: areas_on(&u, seam_u, ids),
                        uv: UvLayout {
                            across: Across::Contour,
                            repeat: [repeat, 1.0],
                            ..UvLayout::default()
                        },
                        u,
                        v,
                        positions: positions.into_iter().map(DVec3::from_array).collect(),
                        normals: normals.into_iter().map(Vec3::from_array).collect(),
                    }
                },
            )
    })
}
