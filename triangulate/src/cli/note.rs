//! Statistics and notes about a mesh, on standard error.

use super::Arguments;
use files::exit::say;
use files::words;
use triangulate::{Counts, MeshReport};

/// Rounding that moves points by more than this fraction of the object's size is reported. The
/// fraction is a tenth of a pixel where the object fills a picture of a thousand pixels. A larger
/// number would hide visible steps, and a smaller number would report rounding that no picture
/// shows.
const MOVED: f64 = 1e-4;

/// Prints statistics and notes on standard error.
pub fn print(arguments: &Arguments, grid: &str, counts: &Counts) {
    let Counts { positions, uvs, normals, triangles, collapsed, slivers, moved, .. } = counts;
    if arguments.stats {
        say(format_args!(
            "triangles {triangles}\npositions {positions}\nnormals {normals}\n\
             picture_coordinates {uvs}\nleft_out_at_poles_and_creases {collapsed}\n\
             left_out_slivers {slivers}\nmoved_by_rounding {moved:.1e}"
        ));
    }
    if arguments.common.quiet {
        return;
    }
    if *triangles == 0 {
        say(format_args!(
            "triangulate: note: {grid}: the mesh has no triangles: all its points lie on a line, or \
             are one point"
        ));
    } else if *slivers > 0 {
        say(format_args!(
            "triangulate: note: {grid}: left out {slivers} triangles whose corners lie on a line; \
             the mesh has slits of no width there"
        ));
    }
    let format = arguments.format();
    if counts.tolerance_used > 1.0 {
        say(format_args!(
            "triangulate: note: {grid}: rounding to the seven digits of {} moved points by up to {:.1e}, \
             {:.1} times the tolerance that the grid was made to",
            format.name(),
            counts.displacement,
            counts.tolerance_used
        ));
    } else if *moved > MOVED {
        say(format_args!(
            "triangulate: note: {grid}: the seven digits of {} moved points by up to {moved:.0e} \
             of the object's size; the object would keep its shape nearer to the origin",
            format.with_article()
        ));
    }
}

/// Prints a note if merging the vertices of a mesh, as readers of STL do, would open or break it.
pub fn merged(object: &str, report: &MeshReport) {
    let broken = report.manifold && !report.merged.manifold;
    let opened = report.closed && !report.merged.closed;
    if broken || opened {
        say(format_args!(
            "triangulate: note: {}: programs that merge vertices, such as readers of STL, would {} the mesh, since \
             points in one place are not neighbours",
            words::shown(object),
            if opened { "open" } else { "break" }
        ));
    }
}
