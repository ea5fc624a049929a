//! The pages, figures and job files that a command line names.

use files::{Ledger, Source};
use pipeline::job::figure;
use pipeline::{Job, PipelineError, pages};
use std::path::{Path, PathBuf};

/// A job that was named.
#[derive(Debug)]
pub struct Asked<'a> {
    /// The job, whole.
    pub job: Job,
    /// Its file.
    pub path: PathBuf,
    /// Where it and its files are.
    pub source: &'a dyn Source,
    /// Whether it is a page that is built in.
    pub built_in: bool,
    /// The figures that were asked for by number; none if the job was named itself.
    pub figures: Vec<u8>,
    /// The argument that named it first.
    pub argument: String,
}

impl Asked<'_> {
    /// What `pipeline run` calls the whole job.
    #[must_use]
    pub fn whole(&self) -> String {
        if self.built_in { self.job.name.clone() } else { self.path.display().to_string() }
    }
}

/// The jobs that were named, job files read through the ledger, in the order in which they were; what is named twice is there once, and a figure
/// beside the page that shows it is no more than the page.
///
/// # Errors
/// When there is no such page or figure, or a job file is wrong.
pub fn asked<'a>(
    arguments: &[String],
    ledger: &'a Ledger,
) -> Result<Vec<Asked<'a>>, PipelineError> {
    let mut all: Vec<Asked<'a>> = Vec::new();
    for argument in arguments {
        if argument == "all" {
            for job in pages::in_order()? {
                add(&mut all, page(&job.name, argument, Vec::new())?);
            }
        } else if Path::new(argument).extension().is_some_and(|extension| extension == "json") {
            let path = PathBuf::from(argument);
            let job = Job::read(&path, ledger)?;
            let argument = argument.clone();
            add(
                &mut all,
                Asked { job, path, source: ledger, built_in: false, figures: Vec::new(), argument },
            );
        } else if let Some(number) = figure::number(argument) {
            add(&mut all, page(&pages::of_figure(number)?, argument, vec![number])?);
        } else {
            add(&mut all, page(argument, argument, Vec::new())?);
        }
    }
    Ok(all)
}

fn page<'a>(name: &str, argument: &str, figures: Vec<u8>) -> Result<Asked<'a>, PipelineError> {
    let (job, path) = (pages::page(name)?, pages::path(name));
    Ok(Asked {
        job,
        path,
        source: &pages::FILES,
        built_in: true,
        figures,
        argument: argument.into(),
    })
}

fn add<'a>(all: &mut Vec<Asked<'a>>, new: Asked<'a>) {
    match all.iter_mut().find(|old| old.path == new.path && old.built_in == new.built_in) {
        None => all.push(new),
        Some(old) if old.figures.is_empty() || new.figures.is_empty() => old.figures.clear(),
        Some(old) => old.figures.extend(new.figures),
    }
}
