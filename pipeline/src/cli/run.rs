//! `pipeline run`: the pictures of pages and jobs.

use super::make_folder;
use clap::Args;
use clap::builder::TypedValueParser;
use files::exit::say;
use files::{Disk, Exit, Failure, Output, Report, Source};
use pipeline::run::{Event, Options};
use pipeline::{Job, PipelineError, pages, run as run_job};
use render::progress::Progress;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;
use thiserror::Error;

/// What `pipeline run` is asked.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// Pages by name, all of them, or job files, whose names end in .json
    #[arg(required = true, value_name = "NAME|all|FILE.json")]
    jobs: Vec<String>,
    /// The folder for the pictures; made if it is missing
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: PathBuf,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = render::film::size)]
    size: (u32, u32),
    /// Memory for textures and their tables, in bytes or with k, M or G; beyond it nothing is read
    #[arg(long, value_name = "BYTES", default_value = "2G", value_parser = render::film::memory::bytes)]
    max_texture_mem: u64,
    /// Write the grids and OBJ files too, as the programs would have piped them
    #[arg(long)]
    keep: bool,
    /// Worker threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024).map(usize::from))]
    threads: Option<usize>,
    /// Print counts of rays, hits and texels and the time of each stage on standard error
    #[arg(long)]
    stats: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
    /// Refuse to replace existing files
    #[arg(long)]
    no_clobber: bool,
}

/// The threads asked for cannot be had.
#[derive(Debug, Error)]
#[error("cannot start {threads} threads: {source}")]
struct ThreadsError {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

impl Failure for ThreadsError {
    fn exit(&self) -> Exit {
        Exit::Resource
    }
}

/// Does the jobs that were named.
pub fn run(arguments: &RunArguments) -> Result<(), Report> {
    // Every job is read before the first is done, so that a slip in a name costs no waiting.
    let jobs = jobs(arguments)?;
    make_folder(&arguments.output)?;
    for (job, _) in &jobs {
        for file in job.files(arguments.keep) {
            Output::check(&arguments.output.join(file), !arguments.no_clobber)?;
        }
    }
    let threads = arguments.threads.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|source| ThreadsError { threads, source })?;
    let options = Options {
        folder: arguments.output.clone(),
        size: arguments.size,
        max_texture_bytes: arguments.max_texture_mem,
        keep: arguments.keep,
        clobber: !arguments.no_clobber,
    };
    for (job, source) in &jobs {
        let talk = Talk::new(job, arguments);
        pool.install(|| run_job(job, *source, &options, &|event| talk.hear(&event)))?;
    }
    Ok(())
}

/// The jobs that were named, each with the place where its files are; no two write the same file.
fn jobs(arguments: &RunArguments) -> Result<Vec<(Job, &'static dyn Source)>, PipelineError> {
    let mut asked: Vec<&str> = Vec::new();
    for name in &arguments.jobs {
        let all = if name == "all" { pages::names() } else { vec![name.as_str()] };
        for name in all {
            // A page named twice is made once.
            if !asked.contains(&name) {
                asked.push(name);
            }
        }
    }
    let mut jobs: Vec<(Job, &'static dyn Source)> = Vec::new();
    let mut written: BTreeMap<String, &str> = BTreeMap::new();
    for name in asked {
        let is_file = Path::new(name).extension().is_some_and(|extension| extension == "json");
        let job: (Job, &'static dyn Source) = if is_file {
            (Job::read(Path::new(name), &Disk)?, &Disk)
        } else {
            (pages::page(name)?, &pages::FILES)
        };
        for file in job.0.files(arguments.keep) {
            if let Some(first) = written.get(&file) {
                let (first, second) = (first.to_string(), name.to_string());
                return Err(PipelineError::SameFile { first, second, file });
            }
            written.insert(file, name);
        }
        jobs.push(job);
    }
    Ok(jobs)
}

/// Says on standard error what a job is doing.
struct Talk<'a> {
    job: &'a str,
    arguments: &'a RunArguments,
    started: Instant,
    progress: Mutex<Option<(String, Progress)>>,
}

impl<'a> Talk<'a> {
    fn new(job: &'a Job, arguments: &'a RunArguments) -> Self {
        let progress = Mutex::new(None);
        Self { job: &job.name, arguments, started: Instant::now(), progress }
    }

    fn hear(&self, event: &Event<'_>) {
        match event {
            Event::Progress { mode, done, total } => self.progress(mode, *done, *total),
            Event::Mesh { name, triangles, time, missed } => {
                let seconds = time.as_secs_f64();
                self.say(&format!("{}: {name}, {triangles} triangles, {seconds:.2} s", self.job));
                if let Some(missed) = missed {
                    self.say(&format!("{}: note: {name}: {missed}", self.job));
                }
            }
            Event::Picture { mode, stats } => {
                self.clear();
                if stats.not_finite > 0 {
                    let (job, count) = (self.job, stats.not_finite);
                    let words = "pixels came out not finite and are black";
                    say(format_args!("pipeline: {job} {mode}: {count} {words}"));
                }
                if self.arguments.stats {
                    self.say(&format!("{} {mode}:\n{stats}", self.job));
                }
            }
            Event::Written(path) => {
                self.clear();
                let seconds = self.started.elapsed().as_secs_f64();
                self.say(&format!("{}  {seconds:.2} s", path.display()));
            }
        }
    }

    fn progress(&self, mode: &str, done: usize, total: usize) {
        let Ok(mut progress) = self.progress.lock() else { return };
        if progress.as_ref().is_none_or(|(shown, _)| shown != mode) {
            let label = format!("{} {mode}", self.job);
            *progress = Some((mode.into(), Progress::new(&label, self.arguments.quiet)));
        }
        if let Some((_, progress)) = progress.as_ref() {
            progress.tell(done, total);
        }
    }

    fn clear(&self) {
        if let Ok(mut progress) = self.progress.lock() {
            *progress = None;
        }
    }

    fn say(&self, words: &str) {
        if !self.arguments.quiet {
            say(words.trim_end());
        }
    }
}
