//! `pipeline report`: measures the cost of each method of rendering a page, and the error of its
//! picture.

use super::bar::Bar;
use super::calibrate;
use super::named::{self, NamedJob};
use super::{OTHER_FOLDER, make_folder};
use crate::report::flicker;
use crate::report::measure::{self, Memory};
use crate::report::measured::{Method, PageMeasured, Truth};
use crate::report::{self, Measured, Plan};
use crate::run::Options;
use crate::{Job, PipelineError};
use clap::Args;
use files::exit::{say, wrote};
use files::memory::of_process;
use files::{Batch, CommonArguments, Exit, Failure, Ledger, Report};
use render::film::{MOST_SAMPLES, memory as film_memory};
use render::filter::Filter;
use render::{Scene, Settings};
use std::env;
use std::io;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;
use thiserror::Error;

/// The scenes that other renderers were measured on.
const PEERS: [&str; 2] = ["peer-glass", "peer-tube"];

/// The program that counts memory, in the folder of this program.
const COUNTING: &str = "pipeline-report";

/// Arguments of `pipeline report`.
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Pages by name, all of them, or job files, whose names end in .json [default: the figures of the
    /// thesis and the two scenes that other renderers were measured on]
    #[arg(value_name = "NAME|all|FILE.json")]
    pages: Vec<String>,
    /// The folder for the report; created if it is missing
    #[arg(short, long, value_name = "DIR", default_value = "report")]
    output: PathBuf,
    /// Pixels across and down of every picture [default: 128x128, with --quick 64x64]
    #[arg(long, value_name = "WxH", value_parser = render::film::size)]
    size: Option<(u32, u32)>,
    /// Few methods and small pictures: two minutes for all default pages
    #[arg(long)]
    quick: bool,
    /// Most rays along each side of a pixel of a truth, at least 32; a truth with little noise gets
    /// fewer
    /// [default: 256, with --quick 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(32..=MOST_SAMPLES.into()))]
    truth: Option<u32>,
    /// Measure only these texture filters, with commas between them, such as exact,tent,bilinear. Advice is given
    /// relative to bilinear
    #[arg(long, value_name = "LIST", value_delimiter = ',', conflicts_with = "calibrate")]
    methods: Vec<Filter>,
    /// Measure only these numbers of rays or areas along each side of a pixel, with commas between them
    #[arg(long, value_name = "LIST", value_delimiter = ',', conflicts_with = "calibrate",
        value_parser = clap::value_parser!(u32).range(1..=MOST_SAMPLES.into()))]
    samples: Vec<u32>,
    /// Take this picture for the truth of the only page, instead of pictures of many rays. Its size is that
    /// of all pictures
    #[arg(long, value_name = "FILE.exr", conflicts_with_all = ["truth", "calibrate", "size"])]
    reference: Option<PathBuf>,
    /// Instead of the report, compare requested and stated errors with true ones, on the pages [default:
    /// all] and on random scenes, and write calibration.html
    #[arg(long, conflicts_with_all = ["quick", "truth"])]
    pub calibrate: bool,
    /// With --calibrate: number of random scenes [default: 200]
    #[arg(long, value_name = "N", requires = "calibrate")]
    scenes: Option<usize>,
    /// Instead of the report, measure flicker: the part of the errors that changes from frame to frame while the camera
    /// pans slowly over a fine texture, seen directly, in a mirror and through glass; write flicker.csv and plots
    #[arg(long, conflicts_with_all = ["pages", "truth", "calibrate", "methods", "samples", "reference"])]
    pub flicker: bool,
    #[command(flatten)]
    common: CommonArguments,
}

/// Compares requested and stated errors with true ones.
pub fn calibrate(arguments: &ReportArguments) -> Result<(), Report> {
    let ReportArguments { pages, output, size, scenes, common, .. } = arguments;
    common.begin();
    calibrate::calibrate(pages, scenes.unwrap_or(calibrate::SCENES), *size, output, common)
}

/// Measures flicker.
pub fn flicker(arguments: &ReportArguments) -> Result<(), Report> {
    arguments.common.begin();
    let plan = if arguments.quick { flicker::Plan::quick() } else { flicker::Plan::full() };
    let plan = flicker::Plan { size: arguments.size.unwrap_or(plan.size), ..plan };
    super::flicker::flicker(&plan, &arguments.output, &arguments.common)
}

/// The program that counts memory cannot be started.
#[derive(Debug, Error)]
#[error("cannot start {COUNTING}, the program beside pipeline that measures for the report: {0}")]
pub struct CountingError(io::Error);

impl Failure for CountingError {
    fn exit(&self) -> Exit {
        Exit::ReadWrite
    }
}

/// A reference was given for several pages, or for none.
#[derive(Debug, Error)]
#[error("--reference is the truth of one page: found {0} pages, expected one")]
pub struct OnePage(usize);

impl Failure for OnePage {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

/// Continues this process as the program that counts memory, with the same arguments.
///
/// # Errors
/// When the counting program cannot be started.
pub fn hand_over() -> Result<(), CountingError> {
    let program = env::current_exe().map_err(CountingError)?;
    let program = program.with_file_name(COUNTING).with_extension(env::consts::EXE_EXTENSION);
    let mut command = Command::new(program);
    command.args(env::args_os().skip(1));
    #[cfg(unix)]
    return Err(CountingError(std::os::unix::process::CommandExt::exec(&mut command)));
    #[cfg(not(unix))]
    match command.status().map_err(CountingError)?.code() {
        Some(0) => Ok(()),
        code => std::process::exit(code.unwrap_or(1)),
    }
}

/// Measures the pages that the arguments name, and writes the report.
pub fn report(arguments: &ReportArguments, memory: &dyn Memory) -> Result<(), Report> {
    arguments.common.begin();
    let quiet = arguments.common.quiet;
    let ledger = arguments.common.ledger();
    let jobs = jobs(&arguments.pages, &ledger)?;
    let mut plan = if arguments.quick { Plan::quick() } else { Plan::full() };
    plan.size = arguments.size.unwrap_or(plan.size);
    plan.most_truth_samples = arguments.truth.unwrap_or(plan.most_truth_samples);
    plan.keep_filters(&arguments.methods);
    plan.set_samples(&arguments.samples);
    if let Some(path) = &arguments.reference {
        if jobs.len() != 1 {
            return Err(OnePage(jobs.len()).into());
        }
        let picture = compare::read::read(&ledger, path)?;
        plan.size = (picture.width, picture.height);
        plan.reference = Some(picture);
    }
    let options = Options {
        folder: arguments.output.clone(),
        size: plan.size,
        keep: false,
        clobber: arguments.common.clobber(),
    };
    // Every scene is read before the first is measured, so that an error in the last is reported at
    // once.
    let scenes = jobs.iter().map(|named| {
        let scene = crate::run::scene(&named.job, named.source, &options, &|_| {})?;
        for Method { filter, sampling } in plan.methods() {
            let settings = Settings::new(options.size.0, options.size.1, filter);
            let settings = Settings { sampling, ..settings };
            film_memory::reserve(&scene, &settings, None, of_process()).map(drop)?;
        }
        Ok(scene)
    });
    let scenes: Vec<Scene> = scenes.collect::<Result<_, PipelineError>>()?;
    make_folder(&options.folder)?;
    let files = check_files(&jobs, &options, &ledger)?;
    let batch = Batch::new(&options.folder, "report", &files)?;
    if let Some(remark) = batch.remark().filter(|_| !quiet) {
        say(format_args!("pipeline: note: {remark}"));
    }
    let began = Instant::now();
    let pool = arguments.common.pool()?;
    let threads = pool.current_num_threads();
    let mut measured = Measured { pages: Vec::new(), threads, quick: arguments.quick };
    for (NamedJob { job, .. }, scene) in jobs.iter().zip(&scenes) {
        let (bar, started) = (Bar::new(quiet), Instant::now());
        let tell = |doing: &str, done: usize, total: usize| {
            bar.tell(&format!("{}: {doing}", job.name), done, total);
        };
        let page = pool
            .install(|| measure::page(&job.name, &job.title, scene, &plan, memory, &tell))
            .map_err(PipelineError::from)?;
        bar.clear();
        if !quiet {
            say(summary(&page, started.elapsed().as_secs_f64()));
        }
        measured.pages.push(page);
        // The numbers are written after every page, so that an interrupted report keeps them.
        report::write_numbers(&measured, &options.folder, &batch)?;
    }
    let written = report::write(&measured, &options.folder, options.clobber, &batch)?;
    batch.finish()?;
    if !quiet {
        written.iter().for_each(|path| wrote(path, None, began.elapsed()));
    }
    Ok(())
}

/// Claims the files of a report and returns their paths. No two pages write the same file.
fn check_files(
    jobs: &[NamedJob<'_>],
    options: &Options,
    ledger: &Ledger,
) -> Result<Vec<PathBuf>, PipelineError> {
    let pages = || jobs.iter().map(|named| named.job.name.as_str());
    for (k, name) in pages().enumerate() {
        if let Some(first) = jobs[..k].iter().find(|named| named.job.name == name) {
            let (first, second) = (first.argument.clone(), jobs[k].argument.clone());
            return Err(PipelineError::SameFile { first, second, file: format!("{name}.svg") });
        }
    }
    let files: Vec<PathBuf> =
        report::files(pages()).iter().map(|file| options.folder.join(file)).collect();
    for file in &files {
        ledger.claim(file, OTHER_FOLDER)?;
    }
    Ok(files)
}

/// Returns a line about the measurements of a page, which took `seconds`.
fn summary(page: &PageMeasured, seconds: f64) -> String {
    let Truth { samples, most_samples, noise, given, .. } = page.truth;
    let (name, methods) = (&page.name, page.trials.len());
    if given {
        return format!("{name}: {methods} methods, truth given  {seconds:.1} s");
    }
    let truth = format!("truth of {samples} x {samples} to {most_samples} x {most_samples} rays");
    format!("{name}: {methods} methods, {truth} twice, noise {noise:.5}  {seconds:.1} s")
}

/// Returns the jobs that arguments name. Without arguments, these are the pages that show figures of the
/// thesis, and the scenes that other renderers were measured on.
fn jobs<'a>(names: &[String], ledger: &'a Ledger) -> Result<Vec<NamedJob<'a>>, PipelineError> {
    if !names.is_empty() {
        return named::jobs(names, &[], ledger);
    }
    let all = named::jobs(&["all".into()], &[], ledger)?;
    let default = |job: &Job| {
        PEERS.contains(&job.name.as_str()) || job.modes.iter().any(|mode| mode.figure.is_some())
    };
    Ok(all.into_iter().filter(|named| default(&named.job)).collect())
}
