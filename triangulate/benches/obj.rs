//! Two million triangles of a tube along a trefoil: in memory, as OBJ, and from a grid file to OBJ.
//!
//! `cargo bench -p topobook-triangulate`. Times are those of this machine and this moment.

use divan::Bencher;
use divan::counter::ItemsCount;
use files::json::Document;
use std::io::sink;
use sweep::grid::file::{self, Encoding, GridReader};
use sweep::{GridMesh, Sweep};
use triangulate::{Options, mesh, write_obj};

const SPEC: &[u8] = include_bytes!("../../examples/curves/trefoil.json");

fn main() {
    divan::main();
}

fn grid() -> GridMesh {
    let document = Document::new("trefoil.json", SPEC).expect("the example is text");
    let sweep = Sweep::read(&document).expect("the example is a spec");
    sweep.with_resolution(Some(4000), Some(250)).expect("a tube may be this fine").grid()
}

fn triangles() -> ItemsCount {
    ItemsCount::new(2_000_000_usize)
}

/// Vertices and triangles in memory.
#[divan::bench(sample_count = 10)]
fn in_memory(bencher: Bencher) {
    let grid = grid();
    bencher.counter(triangles()).bench_local(|| mesh(&grid, &Options::default()).is_ok());
}

/// Text of a grid that is in memory, to nowhere.
#[divan::bench(sample_count = 10)]
fn obj(bencher: Bencher) {
    let grid = grid();
    let options = Options::default();
    bencher.counter(triangles()).bench_local(|| write_obj(&grid, &options, &mut sink()).is_ok());
}

/// Text of a grid file, row by row, to nowhere.
#[divan::bench(sample_count = 10)]
fn file_to_obj(bencher: Bencher) {
    let mut bytes = Vec::new();
    file::write(&grid(), Encoding::Binary, &mut bytes).expect("memory takes bytes");
    let options = Options::default();
    bencher.counter(triangles()).bench_local(|| {
        let mut reader = GridReader::open("grid", bytes.as_slice()).expect("it was just written");
        write_obj(&mut reader, &options, &mut sink()).is_ok()
    });
}
