//! The pages built into the program: jobs with their specs, scenes and textures.
//!
//! The files are those of `examples/`, under the same paths. So the pages work in an empty folder, and
//! the files can be read as models for one's own jobs.

use crate::job::figure::listed;
use crate::{Job, PipelineError};
use files::Embedded;
use files::json::nearest;
use std::path::{Path, PathBuf};

macro_rules! examples {
    ($($path:literal),* $(,)?) => {
        &[$((
            concat!("examples/", $path),
            include_bytes!(concat!("../../examples/", $path)).as_slice(),
        )),*]
    };
}

/// The files built into the program.
pub const FILES: Embedded = Embedded(examples![
    "curves/bent-tower.json",
    "curves/bumpy-vase.json",
    "curves/cup.json",
    "curves/eight.json",
    "curves/figure-eight.json",
    "curves/figure-eight-immersion.json",
    "curves/figure-eight-klein.json",
    "curves/fluted-vase.json",
    "curves/glass-bud.json",
    "curves/glass-prism.json",
    "curves/globe.json",
    "curves/globe-arm.json",
    "curves/globe-axle.json",
    "curves/globe-foot.json",
    "curves/horn.json",
    "curves/klein-bottle.json",
    "curves/klein-glass.json",
    "curves/marble-column.json",
    "curves/moebius-band.json",
    "curves/pawn.json",
    "curves/picture-frame.json",
    "curves/relief-vase.json",
    "curves/saucer.json",
    "curves/scaly-ring.json",
    "curves/sections.json",
    "curves/six.json",
    "curves/smooth-ring.json",
    "curves/spring.json",
    "curves/still-water.json",
    "curves/threefold-torus.json",
    "curves/torus-knot.json",
    "curves/trefoil.json",
    "curves/twisted-column.json",
    "curves/u-cup.json",
    "curves/vase.json",
    "curves/water-glass.json",
    "curves/wine.json",
    "curves/wine-glass.json",
    "curves/world.json",
    "meshes/tube.obj",
    "pages/bent-tower.json",
    "pages/bump-and-relief.json",
    "pages/cup.json",
    "pages/cup-and-vase.json",
    "pages/cup-and-vase-adaptive.json",
    "pages/eight-world-klein.json",
    "pages/eight-world-klein-adaptive.json",
    "pages/figure-eight.json",
    "pages/figure-eight-klein.json",
    "pages/fluted-vase.json",
    "pages/frontispiece.json",
    "pages/glass-sphere.json",
    "pages/glass-table.json",
    "pages/glass-table-adaptive.json",
    "pages/globe.json",
    "pages/horn.json",
    "pages/klein-bottle.json",
    "pages/knots.json",
    "pages/marble-column.json",
    "pages/marble-column-adaptive.json",
    "pages/moebius-band.json",
    "pages/pawn.json",
    "pages/peer-glass.json",
    "pages/peer-tube.json",
    "pages/picture-frame.json",
    "pages/relief-vase.json",
    "pages/sections.json",
    "pages/solids.json",
    "pages/spring.json",
    "pages/threefold-torus.json",
    "pages/torus-knot.json",
    "pages/trefoil.json",
    "pages/twisted-column.json",
    "pages/vase.json",
    "pages/wine-glass.json",
    "scenes/bent-tower.json",
    "scenes/bump-and-relief.json",
    "scenes/cup.json",
    "scenes/cup-and-vase.json",
    "scenes/eight-world-klein.json",
    "scenes/figure-eight.json",
    "scenes/figure-eight-klein.json",
    "scenes/fluted-vase.json",
    "scenes/frontispiece.json",
    "scenes/glass-sphere.json",
    "scenes/glass-table.json",
    "scenes/globe.json",
    "scenes/horn.json",
    "scenes/klein-bottle.json",
    "scenes/knots.json",
    "scenes/marble-column.json",
    "scenes/moebius-band.json",
    "scenes/pawn.json",
    "scenes/peer-glass.json",
    "scenes/peer-tube.json",
    "scenes/picture-frame.json",
    "scenes/relief-vase.json",
    "scenes/sections.json",
    "scenes/solids.json",
    "scenes/spring.json",
    "scenes/threefold-torus.json",
    "scenes/torus-knot.json",
    "scenes/trefoil.json",
    "scenes/twisted-column.json",
    "scenes/vase.json",
    "scenes/wine-glass.json",
    "textures/checkerboard.png",
    "textures/cup-band.png",
    "textures/drawing-board.png",
    "textures/floor-tiles.png",
    "textures/granite.png",
    "textures/graticule.png",
    "textures/hatching.png",
    "textures/lettering.png",
    "textures/net.png",
    "textures/peer-checker.png",
    "textures/plate.png",
    "textures/ribbon.png",
    "textures/scales.png",
    "textures/sea.png",
    "textures/vase-band.png",
    "textures/world-chart.png",
]);

/// The folder of the jobs among the files.
const FOLDER: &str = "examples/pages";

/// Returns the names of the pages in alphabetical order.
#[must_use]
pub fn names() -> Vec<&'static str> {
    let jobs = FILES.0.iter().map(|(path, _)| Path::new(path));
    let jobs = jobs.filter(|path| path.parent() == Some(Path::new(FOLDER)));
    let mut names: Vec<&str> = jobs.filter_map(|path| path.file_stem()?.to_str()).collect();
    names.sort_unstable();
    names
}

/// Returns the path of a page's job among the files.
#[must_use]
pub fn path(name: &str) -> PathBuf {
    [FOLDER, &format!("{name}.json")].iter().collect()
}

/// Returns the job of a page.
///
/// # Errors
/// When there is no page of that name. The error suggests a page with a similar name, if there is one.
pub fn page(name: &str) -> Result<Job, PipelineError> {
    let names = names();
    if !names.contains(&name) {
        // A sentence cannot list all names.
        let near = nearest(name, names.iter().copied());
        let near = near.map_or_else(String::new, |near| format!(" (did you mean {near}?)"));
        return Err(PipelineError::UnknownPage { name: name.into(), near });
    }
    Job::read(&path(name), &FILES)
}

/// Returns all pages. Pages with figures of the thesis come first, by figure number, then the others by
/// name. Pages that show another page's scene with meshes made by tolerance (`-adaptive`) come last
/// among the others.
///
/// # Errors
/// None, as long as every page is a valid job, which a test checks.
pub fn in_order() -> Result<Vec<Job>, PipelineError> {
    let mut jobs = names().into_iter().map(page).collect::<Result<Vec<_>, _>>()?;
    jobs.sort_by_key(|job| {
        let figure = job.figures().first().copied().unwrap_or(u8::MAX);
        (figure, job.name.ends_with("-adaptive"))
    });
    Ok(jobs)
}

/// Returns the name of the page that shows a figure of the thesis.
///
/// # Errors
/// When no page shows the figure. The error lists the figures that exist.
pub fn of_figure(number: u8) -> Result<String, PipelineError> {
    let jobs = in_order()?;
    if let Some(job) = jobs.iter().find(|job| job.figures().contains(&number)) {
        return Ok(job.name.clone());
    }
    let mut all: Vec<u8> = jobs.iter().flat_map(Job::figures).collect();
    all.sort_unstable();
    Err(PipelineError::UnknownFigure { number, known: listed(&all) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Mode;

    #[test]
    fn every_page_in_examples_is_built_in() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/pages");
        let mut on_disk: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_string())
            .collect();
        on_disk.sort();
        assert_eq!(names(), on_disk);
    }

    #[test]
    fn a_near_miss_is_met_with_a_suggestion() {
        let error = page("glas-sphere").unwrap_err().to_string();
        assert!(error.contains("did you mean glass-sphere?"), "{error}");
        let error = page("x").unwrap_err().to_string();
        assert!(error.starts_with("there is no page \"x\"; `pipeline list` names"), "{error}");
    }

    #[test]
    fn every_page_has_a_title() {
        for name in names() {
            assert!(!page(name).unwrap().title.is_empty(), "{name}");
        }
    }

    #[test]
    fn a_figure_is_on_one_page_and_in_one_mode() {
        let jobs = in_order().unwrap();
        let mut shown: Vec<u8> =
            jobs.iter().flat_map(|job| job.modes.iter().filter_map(Mode::figure_number)).collect();
        shown.sort_unstable();
        let all = shown.len();
        shown.dedup();
        assert_eq!(shown.len(), all, "{shown:?}");
        for figure in shown {
            assert!(page(&of_figure(figure).unwrap()).unwrap().figures().contains(&figure));
        }
        let unknown = of_figure(99).unwrap_err().to_string();
        assert!(unknown.contains("no figure A.99") && unknown.contains("A.11"), "{unknown}");
    }
}
