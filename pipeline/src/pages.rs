//! The pages built into the program: jobs with their specs, scenes and textures.
//!
//! The files are those of `examples/`, under the same paths. So the pages work in an empty folder, and
//! the files can be read as models for one's own jobs.

use crate::job::figure::listed;
use crate::{Job, PipelineError};
use files::Embedded;
use files::json::nearest;
use std::path::{Path, PathBuf};

/// The files built into the program, which the build script lists.
pub const FILES: Embedded = Embedded(include!(concat!(env!("OUT_DIR"), "/examples.rs")));

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
    use render::Sampling;

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
        assert!(error.starts_with("there is no page \"x\"; `pipeline list` prints"), "{error}");
    }

    #[test]
    fn every_page_has_a_title() {
        for name in names() {
            assert!(!page(name).unwrap().title.is_empty(), "{name}");
        }
    }

    #[test]
    fn every_page_ends_with_the_exact_mode_beside_modes_of_the_thesis() {
        for name in names() {
            let modes = page(name).unwrap().modes;
            let (exact, thesis): (Vec<Mode>, Vec<Mode>) =
                modes.iter().cloned().partition(|mode| *mode == Mode::exact());
            // Pages with meshes by tolerance repeat the scene of another page.
            assert_eq!(exact.len(), usize::from(!name.ends_with("-adaptive")), "{name}");
            assert!(exact.is_empty() || modes.last() == exact.first(), "{name}");
            let by_areas = |mode: &Mode| matches!(mode.sampling, Sampling::Area { .. });
            assert!(!thesis.is_empty() && !thesis.iter().any(by_areas), "{name}");
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
