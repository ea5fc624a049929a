//! `pipeline report`: what each way of rendering a page costs, and how wrong it is.

use super::asked::{Asked, asked};
use super::work::Work;
use super::{OTHER_FOLDER, make_folder};
use clap::Args;
use cpu_time::ProcessTime;
use files::exit::say;
use files::memory::of_process;
use files::progress::Progress;
use files::{Batch, Ledger, Output, Report};
use pipeline::report::measure::{self, Meter};
use pipeline::report::measured::{PageMeasured, Truth};
use pipeline::report::{self, Measured, Plan, accompanying, csv};
use pipeline::run::Options;
use pipeline::{Job, PipelineError};
use render::film::{MOST_SAMPLES, memory};
use render::{Scene, Settings};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// The scenes that other renderers were measured on.
const PEERS: [&str; 2] = ["peer-glass", "peer-tube"];

/// The numbers of all pages.
const NUMBERS: &str = "report.csv";

/// What `pipeline report` is asked.
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Pages by name, all of them, or job files, whose names end in .json [default: the figures of the
    /// thesis and the two scenes that other renderers were measured on]
    #[arg(value_name = "NAME|all|FILE.json")]
    pages: Vec<String>,
    /// The folder for the report; made if it is missing
    #[arg(short, long, value_name = "DIR", default_value = "report")]
    output: PathBuf,
    /// Pixels across and down, of every picture [default: 128x128, with --quick 64x64]
    #[arg(long, value_name = "WxH", value_parser = render::film::size)]
    size: Option<(u32, u32)>,
    /// Few methods and small pictures: two minutes for all default pages
    #[arg(long)]
    quick: bool,
    /// Rays along each side of a pixel for the truth, where its noise asks for so many; 32 at least
    /// [default: 256, with --quick 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(32..=MOST_SAMPLES.into()))]
    truth: Option<u32>,
    #[command(flatten)]
    work: Work,
}

/// Measures the pages that were named and writes what came of it.
pub fn report(arguments: &ReportArguments) -> Result<(), Report> {
    arguments.work.limit_memory();
    let ledger = arguments.work.ledger();
    let jobs = jobs(&arguments.pages, &ledger)?;
    let mut plan = if arguments.quick { Plan::quick() } else { Plan::full() };
    plan.size = arguments.size.unwrap_or(plan.size);
    plan.most_truth_samples = arguments.truth.unwrap_or(plan.most_truth_samples);
    let options = Options {
        folder: arguments.output.clone(),
        size: plan.size,
        keep: false,
        clobber: arguments.work.clobber(),
    };
    // Every scene is read before the first is measured, so that a slip in the last costs no waiting.
    let scenes = jobs.iter().map(|asked| {
        let scene = pipeline::run::scene(&asked.job, asked.source, &options, &|_| {})?;
        for &filter in &plan.filters {
            let settings = Settings::new(options.size.0, options.size.1, filter);
            memory::reserve(&scene, &settings, None, of_process()).map(drop)?;
        }
        Ok(scene)
    });
    let scenes: Vec<Scene> = scenes.collect::<Result<_, PipelineError>>()?;
    make_folder(&options.folder)?;
    let mut files = check_files(&jobs, &options, &ledger)?;
    let tables = accompanying::measure(arguments.quick)?;
    for table in &tables {
        let file = options.folder.join(format!("{}.csv", table.name));
        ledger.claim(&file, OTHER_FOLDER)?;
        files.push(file);
    }
    let batch = Batch::new(&options.folder, "report", &files)?;
    if let Some(remark) = batch.remark().filter(|_| !arguments.work.quiet) {
        say(format_args!("pipeline: note: {remark}"));
    }
    let write = |path: &Path, text: &str, clobber| -> Result<(), PipelineError> {
        let mut output = Output::create(path, clobber)?;
        output.write_all(text.as_bytes()).map_err(|source| output.failed(source))?;
        Ok(batch.replace(output)?)
    };
    let pool = arguments.work.pool()?;
    let threads = pool.current_num_threads();
    let mut measured = Measured { pages: Vec::new(), threads, quick: arguments.quick, tables };
    let numbers = options.folder.join(NUMBERS);
    for (Asked { job, .. }, scene) in jobs.iter().zip(&scenes) {
        let talk = Talk::new(job, arguments.work.quiet);
        let tell = |doing: &str, done, total| talk.tell(doing, done, total);
        let usage = Usage::new();
        let page = pool
            .install(|| measure::page(&job.name, &job.title, scene, &plan, &usage, &tell))
            .map_err(PipelineError::from)?;
        talk.finish(&page);
        measured.pages.push(page);
        // After every page: if a long report is interrupted, the numbers so far are there.
        write(&numbers, &csv::trials(&measured), true)?;
    }
    let mut written = vec![numbers];
    for table in &measured.tables {
        let path = options.folder.join(format!("{}.csv", table.name));
        write(&path, &csv::table(table), options.clobber)?;
        written.push(path);
    }
    written.extend(report::write(&measured, &options.folder, options.clobber, &batch)?);
    batch.finish()?;
    if !arguments.work.quiet {
        written.iter().for_each(|path| say(path.display()));
    }
    Ok(())
}

/// The files of a report, which may be written; no two pages write the same.
fn check_files(
    jobs: &[Asked<'_>],
    options: &Options,
    ledger: &Ledger,
) -> Result<Vec<PathBuf>, PipelineError> {
    let pages = || jobs.iter().map(|asked| asked.job.name.as_str());
    let mut files = vec![NUMBERS.to_string()];
    files.extend(report::files(pages()));
    for (k, name) in pages().enumerate() {
        if let Some(first) = jobs[..k].iter().find(|asked| asked.job.name == name) {
            let (first, second) = (first.argument.clone(), jobs[k].argument.clone());
            return Err(PipelineError::SameFile { first, second, file: format!("{name}.svg") });
        }
    }
    let files: Vec<PathBuf> = files.iter().map(|file| options.folder.join(file)).collect();
    for file in &files {
        ledger.claim(file, OTHER_FOLDER)?;
    }
    Ok(files)
}

/// Shows what is being measured.
struct Talk<'a> {
    job: &'a str,
    quiet: bool,
    started: Instant,
    bar: Mutex<Option<(String, Progress)>>,
}

impl<'a> Talk<'a> {
    fn new(job: &'a Job, quiet: bool) -> Self {
        Self { job: &job.name, quiet, started: Instant::now(), bar: Mutex::new(None) }
    }

    fn tell(&self, doing: &str, done: usize, total: usize) {
        let Ok(mut bar) = self.bar.lock() else { return };
        if bar.as_ref().is_none_or(|(shown, _)| shown != doing) {
            let label = format!("{}: {doing}", self.job);
            *bar = Some((doing.into(), Progress::new(&label, self.quiet)));
        }
        if let Some((_, progress)) = bar.as_ref() {
            progress.tell(done, total);
        }
    }

    /// Says what was measured.
    fn finish(self, page: &PageMeasured) {
        drop(self.bar);
        if self.quiet {
            return;
        }
        let Truth { samples, most_samples, noise, .. } = page.truth;
        let (methods, seconds) = (page.trials.len(), self.started.elapsed().as_secs_f64());
        let truth =
            format!("truth of {samples} x {samples} to {most_samples} x {most_samples} rays");
        say(format_args!(
            "{}: {methods} methods, {truth} twice, noise {noise:.5}  {seconds:.1} s",
            self.job
        ));
    }
}

/// What this program uses.
struct Usage {
    started: Option<ProcessTime>,
}

impl Usage {
    fn new() -> Self {
        Self { started: ProcessTime::try_now().ok() }
    }
}

impl Meter for Usage {
    fn cpu(&self) -> Duration {
        self.started.and_then(|started| started.try_elapsed().ok()).unwrap_or_default()
    }

    fn mark(&self) -> usize {
        crate::MEMORY.reset_peak_usage();
        crate::MEMORY.current_usage()
    }

    fn peak(&self) -> usize {
        crate::MEMORY.peak_usage()
    }
}

/// The jobs that were named; without names, the pages that show figures of the thesis, and the scenes that
/// other renderers were measured on.
fn jobs<'a>(names: &[String], ledger: &'a Ledger) -> Result<Vec<Asked<'a>>, PipelineError> {
    if !names.is_empty() {
        return asked(names, ledger);
    }
    let all = asked(&["all".into()], ledger)?;
    let default = |job: &Job| {
        PEERS.contains(&job.name.as_str()) || job.modes.iter().any(|mode| mode.figure.is_some())
    };
    Ok(all.into_iter().filter(|asked| default(&asked.job)).collect())
}
