//! Every structure gives the same pages, to the last byte.

use pipeline::job::{Job, Mode};
use pipeline::run::{Options, run};
use rayon::prelude::*;
use render::Sampling;
use render::accel::Structure;
use render::filter::Filter;
use std::fs;
use std::path::Path;

/// A size at which brute force takes seconds, since each of its rays is tried on up to half a
/// million triangles. Points are sampled, since the neighbours for areas would double the number of
/// rays.
const SIZE: (u32, u32) = (6, 5);

#[test]
fn tree_grids_and_brute_force_make_the_same_pages() {
    let pages = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/pages");
    let mut pages: Vec<_> = fs::read_dir(pages).unwrap().map(|page| page.unwrap().path()).collect();
    pages.sort();
    assert!(pages.len() > 15, "{pages:?}");
    pages.par_iter().for_each(|page| {
        let mut job = Job::read(page, &files::Disk).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let mode = |name: &str, accel| Mode {
            accel,
            ..Mode::new(name, Filter::Point, Sampling::regular(1))
        };
        job.modes = vec![
            mode("none", Structure::None),
            mode("bvh", Structure::Bvh),
            mode("grid", Structure::Grid),
        ];
        let options =
            Options { folder: folder.path().into(), size: SIZE, keep: false, clobber: true };
        run(&job, &files::Disk, &options, &|_| {}).unwrap();
        let made =
            |name: &str| fs::read(folder.path().join(format!("{}-{name}.png", job.name))).unwrap();
        let brute = made("none");
        assert!(made("bvh") == brute, "{}: the tree differs", job.name);
        assert!(made("grid") == brute, "{}: the grids differ", job.name);
    });
}
