//! The pages, figures and job files that a command line names.

use crate::job::figure;
use crate::settings::Changed;
use crate::{Job, PipelineError, pages};
use files::{Ledger, Setting, Source};
use std::path::{Path, PathBuf};

/// A job that an argument names.
#[derive(Debug)]
pub struct NamedJob<'a> {
    /// The whole job.
    pub job: Job,
    /// The path of the job file.
    pub path: PathBuf,
    /// The source of the job file and of the files that it names.
    pub source: &'a dyn Source,
    /// True if the job is a built-in page.
    pub built_in: bool,
    /// The figures that arguments name by number; empty if an argument names the job itself.
    pub figures: Vec<u8>,
    /// The first argument that names the job.
    pub argument: String,
    /// The values that are set in the job, its scene and its specs.
    pub settings: Vec<Setting>,
}

impl NamedJob<'_> {
    /// Returns the argument by which `pipeline run` makes the whole job.
    #[must_use]
    pub fn whole(&self) -> String {
        if self.built_in { self.job.name.clone() } else { self.path.display().to_string() }
    }
}

/// Returns the jobs that arguments name, in the order of the arguments, with the values that the settings give them.
/// Job files are read through the ledger. A job that is named twice occurs once. A figure beside the page that shows it
/// adds nothing.
///
/// # Errors
/// When there is no such page or figure, or a job file is wrong.
pub fn jobs<'a>(
    arguments: &[String],
    settings: &[Setting],
    ledger: &'a Ledger,
) -> Result<Vec<NamedJob<'a>>, PipelineError> {
    let mut all: Vec<NamedJob<'a>> = Vec::new();
    for argument in arguments {
        if argument == "all" {
            for job in pages::in_order()? {
                add(&mut all, page(&job.name, argument, Vec::new(), settings)?);
            }
        } else if Path::new(argument).extension().is_some_and(|extension| extension == "json") {
            let path = PathBuf::from(argument);
            let job = Job::read(&path, &Changed::job(ledger, &path, settings))?;
            let argument = argument.clone();
            add(
                &mut all,
                NamedJob {
                    job,
                    path,
                    source: ledger,
                    built_in: false,
                    figures: Vec::new(),
                    argument,
                    settings: settings.to_vec(),
                },
            );
        } else if let Some(number) = figure::number(argument) {
            add(&mut all, page(&pages::of_figure(number)?, argument, vec![number], settings)?);
        } else {
            add(&mut all, page(argument, argument, Vec::new(), settings)?);
        }
    }
    Ok(all)
}

fn page<'a>(
    name: &str,
    argument: &str,
    figures: Vec<u8>,
    settings: &[Setting],
) -> Result<NamedJob<'a>, PipelineError> {
    let (mut job, path) = (pages::page(name)?, pages::path(name));
    if !settings.is_empty() {
        job = Job::read(&path, &Changed::job(&pages::FILES, &path, settings))?;
    }
    Ok(NamedJob {
        job,
        path,
        source: &pages::FILES,
        built_in: true,
        figures,
        argument: argument.into(),
        settings: settings.to_vec(),
    })
}

fn add<'a>(all: &mut Vec<NamedJob<'a>>, new: NamedJob<'a>) {
    match all.iter_mut().find(|old| old.path == new.path && old.built_in == new.built_in) {
        None => all.push(new),
        Some(old) if old.figures.is_empty() || new.figures.is_empty() => old.figures.clear(),
        Some(old) => old.figures.extend(new.figures),
    }
}
