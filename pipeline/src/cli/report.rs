//! `pipeline report`: what each way of rendering a page costs, and how wrong it is.

use super::asked::{Asked, asked};
use super::{make_folder, threads};
use clap::Args;
use clap::builder::TypedValueParser;
use cpu_time::ProcessTime;
use files::exit::say;
use files::{Output, Report};
use pipeline::report::measure::{self, Meter};
use pipeline::report::{Measured, Plan, csv};
use pipeline::run::Options;
use pipeline::{Job, PipelineError};
use render::film::memory;
use render::progress::Progress;
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// The scenes that other renderers were measured on.
const PEERS: [&str; 2] = ["peer-glass", "peer-tube"];

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
    /// Memory for textures and their tables, in bytes or with k, M or G; beyond it nothing is read
    #[arg(long, value_name = "BYTES", default_value = "2G", value_parser = memory::bytes)]
    max_texture_mem: u64,
    /// Worker threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024).map(usize::from))]
    threads: Option<usize>,
    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
    /// Refuse to replace existing files
    #[arg(long)]
    no_clobber: bool,
}

/// Measures the pages that were named and writes what came of it.
pub fn report(arguments: &ReportArguments) -> Result<(), Report> {
    let jobs = jobs(&arguments.pages)?;
    make_folder(&arguments.output)?;
    let file = arguments.output.join("report.csv");
    Output::check(&file, !arguments.no_clobber)?;
    let mut plan = if arguments.quick { Plan::quick() } else { Plan::full() };
    plan.size = arguments.size.unwrap_or(plan.size);
    let pool = threads::pool(arguments.threads)?;
    let options = Options {
        folder: arguments.output.clone(),
        size: plan.size,
        max_texture_bytes: arguments.max_texture_mem,
        keep: false,
        clobber: !arguments.no_clobber,
    };
    let mut measured = Measured {
        pages: Vec::new(),
        threads: pool.current_num_threads(),
        quick: arguments.quick,
        tables: Vec::new(),
    };
    for Asked { job, source, .. } in &jobs {
        let started = Instant::now();
        let scene = pipeline::run::scene(job, *source, &options, &|_| {})?;
        for &filter in &plan.filters {
            memory::check(&scene, filter, options.max_texture_bytes)?;
        }
        let talk = Talk { job: &job.name, quiet: arguments.quiet, bar: Mutex::new(None) };
        let tell = |doing: &str, done, total| talk.tell(doing, done, total);
        let page = pool.install(|| {
            measure::page(&job.name, &job.title, &scene, &plan, &Usage::new(), &tell)
        })?;
        drop(talk);
        if !arguments.quiet {
            let seconds = started.elapsed().as_secs_f64();
            let truth = &page.truth;
            let (least, most) = (truth.samples, truth.most_samples);
            say(format_args!(
                "{}: {} methods, truth of {least} x {least} to {most} x {most} rays twice, its noise {:.5}  {seconds:.1} s",
                job.name,
                page.trials.len(),
                truth.noise
            ));
        }
        measured.pages.push(page);
    }
    Output::create(&file, !arguments.no_clobber)?.commit_all(csv::trials(&measured).as_bytes())?;
    if !arguments.quiet {
        say(file.display());
    }
    Ok(())
}

/// Shows what is being measured.
struct Talk<'a> {
    job: &'a str,
    quiet: bool,
    bar: Mutex<Option<(String, Progress)>>,
}

impl Talk<'_> {
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
fn jobs(names: &[String]) -> Result<Vec<Asked>, PipelineError> {
    if !names.is_empty() {
        return asked(names);
    }
    let all = asked(&["all".into()])?;
    let default = |job: &Job| {
        PEERS.contains(&job.name.as_str()) || job.modes.iter().any(|mode| mode.figure.is_some())
    };
    Ok(all.into_iter().filter(|asked| default(&asked.job)).collect())
}
