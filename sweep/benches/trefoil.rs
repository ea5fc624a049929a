//! A closed tube along a trefoil, 4000 x 250 cells: frames, points, exact normals, and its file.
//!
//! `cargo bench -p topobook-sweep`. Times are those of this machine and this moment; docs/speed.md has ratios.

use divan::Bencher;
use divan::counter::ItemsCount;
use files::json::Document;
use std::io::sink;
use std::path::Path;
use sweep::grid::file::{self, Encoding};
use sweep::spec::Resolution;
use sweep::{Object, Sweep};

const SPEC: &[u8] = include_bytes!("../../examples/curves/trefoil.json");
const CELLS: [usize; 2] = [4000, 250];

fn main() {
    divan::main();
}

fn object() -> Object {
    let document = Document::new("trefoil.json", SPEC).expect("the example is text");
    let overrides =
        Resolution { rows: Some(CELLS[0]), cols: Some(CELLS[1]), ..Resolution::default() };
    Object::read(&document, Path::new(""), &files::Disk, &overrides).expect("the example is a spec")
}

fn pool(threads: usize) -> rayon::ThreadPool {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads can be started")
}

fn cells() -> ItemsCount {
    ItemsCount::new(CELLS[0] * CELLS[1])
}

/// Reading the spec: curves, lengths, the nodes of the frames.
#[divan::bench]
fn read() -> Object {
    object()
}

/// Frames, points and normals, into new memory.
#[divan::bench(args = [1, 2])]
fn geometry(bencher: Bencher, threads: usize) {
    let (object, pool) = (object(), pool(threads));
    bencher.counter(cells()).bench_local(|| pool.install(|| object.parts()[0].grid()));
}

/// The same on one thread, written to nowhere as it is found.
#[divan::bench]
fn geometry_and_file(bencher: Bencher) {
    let (object, pool) = (object(), pool(1));
    let write = || object.write(Encoding::Binary, &mut sink()).is_ok();
    bencher.counter(cells()).bench_local(|| pool.install(write));
}

/// The file of a grid that is there: bytes and checksum, to nowhere.
#[divan::bench]
fn file(bencher: Bencher) {
    let grid = object().parts().first().map(Sweep::grid).expect("there is a part");
    bencher
        .counter(cells())
        .bench_local(|| file::write(&grid, Encoding::Binary, &mut sink()).is_ok());
}
