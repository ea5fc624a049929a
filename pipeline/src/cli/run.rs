//! `pipeline run`: makes the pictures of pages and jobs.

use super::bar::Bar;
use super::frames::FrameArguments;
use super::named::{self, NamedJob};
use super::{OTHER_FOLDER, make_folder};
use crate::contact_sheet::ContactSheet;
use crate::run as of_job;
use crate::run::{Event, Options, Shared};
use crate::settings::Changed;
use crate::stages::Stages;
use crate::{Job, PipelineError};
use clap::Args;
use files::exit::{say, wrote};
use files::{
    Batch, CommonArguments, Exit, Failure, Ledger, Output, Report, Setting, Variant, input,
};
use render::Picture;
use render::accuracy;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;
use thiserror::Error;

/// Error of the further picture of a page that is named alone.
const PAGE_ERROR: f64 = 0.005;

/// Arguments of `pipeline run`.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// Pages by name, all of them, figures of the thesis by number, or files of jobs or scenes, whose names
    /// end in .json. A page that is named alone also gets a picture whose error is below 0.005, unless --mode or
    /// --error is given
    #[arg(required = true, value_name = "NAME|all|A.N|FILE.json")]
    jobs: Vec<String>,
    /// The folder for the pictures; created if it is missing
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: PathBuf,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = render::film::size)]
    size: (u32, u32),
    /// Make only the pictures of this mode, which all jobs must have; may be given several times
    #[arg(long = "mode", value_name = "NAME")]
    modes: Vec<String>,
    /// Instead of the modes, make one picture whose error is below this: a number between 0 and 1, root
    /// mean square in linear light, or 8bit for half a code of an 8-bit picture
    #[arg(long, value_name = "E|8bit", value_parser = accuracy::error, conflicts_with = "modes")]
    error: Option<f64>,
    /// Set a value of the job, of its scene or of a spec: -D scene.ambient=0.5, or
    /// -D specs.MESH.contour.circle=2; may be given several times
    #[arg(short = 'D', value_name = "PATH=VALUE")]
    settings: Vec<Setting>,
    /// Run the jobs once for each row of a table: a column is a path as in -D, and a cell its value. The
    /// column name is added to the names of the files; without it a number is. Meshes that variants have in
    /// common are made once
    #[arg(long, value_name = "FILE.csv")]
    jobs_from: Option<PathBuf>,
    /// Also write the grids and OBJ files, as the three programs would pipe them
    #[arg(long)]
    keep: bool,
    /// Also write sheet.png, which shows the last picture of each job, reduced
    #[arg(long)]
    sheet: bool,
    /// Print the names of the files that would be written, and make none. The jobs are read and checked
    #[arg(long)]
    dry_run: bool,
    /// Print counts of rays, hits and texels and the time of each stage on standard error
    #[arg(long)]
    stats: bool,
    #[command(flatten)]
    frames: FrameArguments,
    #[command(flatten)]
    common: CommonArguments,
}

/// The output is no folder.
#[derive(Debug, Error)]
enum UseError {
    #[error(
        "-o names a folder, and - is standard output: `pipeline show` and `render` write a picture there"
    )]
    Stdout,
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

/// Runs the jobs that the arguments name.
pub fn run(arguments: &RunArguments) -> Result<(), Report> {
    arguments.common.begin();
    // Every job is read before the first is run, so that an error in a name is reported at once.
    let ledger = arguments.common.ledger();
    let jobs = jobs(arguments, &ledger)?;
    let shared = arguments.jobs_from.as_ref().map(|_| Shared::default());
    if input::is_stdin(&arguments.output) {
        return Err(UseError::Stdout.into());
    }
    if !arguments.dry_run {
        make_folder(&arguments.output)?;
    }
    let sheet_path = arguments.sheet.then(|| arguments.output.join(ContactSheet::FILE));
    let chosen = jobs.iter().map(|named| arguments.frames.of(&named.job, &ledger));
    let chosen = chosen.collect::<Result<Vec<_>, _>>()?;
    let names = jobs.iter().zip(&chosen).flat_map(|(named, chosen)| match chosen {
        Some(chosen) => chosen.files(&named.job),
        None => named.job.files(arguments.keep),
    });
    let files: Vec<PathBuf> =
        names.map(|name| arguments.output.join(name)).chain(sheet_path.clone()).collect();
    if !arguments.dry_run || arguments.output.is_dir() {
        files.iter().try_for_each(|file| ledger.claim(file, OTHER_FOLDER))?;
    }
    if arguments.dry_run {
        let lines: String = files.iter().map(|file| format!("{}\n", file.display())).collect();
        let lines = files::words::printed(&lines);
        return Ok(Output::create(Path::new("-"), true)?.commit_all(lines.as_bytes())?);
    }
    let pool = arguments.common.pool()?;
    let options = Options {
        folder: arguments.output.clone(),
        size: arguments.size,
        keep: arguments.keep,
        clobber: arguments.common.clobber(),
    };
    let sources =
        jobs.iter().map(|named| Changed::parts(named.source, &named.job, &named.settings));
    let sources = sources.collect::<Result<Vec<_>, _>>()?;
    pool.install(|| read_first(&jobs, &sources, &files, &options))?;
    let together = arguments.sheet.then(|| Batch::new(&options.folder, "sheet", &files));
    let together = together.transpose()?;
    together.iter().for_each(|batch| arguments.remark(batch));
    let mut rows: Vec<(String, Stages)> = Vec::new();
    let mut all = Stages::default();
    let mut sheet = ContactSheet::default();
    let mut missed = 0;
    for ((named, chosen), source) in jobs.iter().zip(&chosen).zip(&sources) {
        let job = &named.job;
        let listener = Listener::new(job, arguments);
        let hear = |event: Event<'_>| listener.hear(&event);
        let stages = if let Some(chosen) = chosen {
            let stages =
                pool.install(|| chosen.run(named, &arguments.settings, &options, &hear))?;
            if let Some(film) = chosen.film(job, &options, &ledger)? {
                hear(Event::Written { path: &film, size: None });
            }
            stages
        } else {
            let batch = of_job::batch(job, &options)?;
            arguments.remark(&batch);
            let batch = match &together {
                Some(together) => batch.within(together),
                None => batch,
            };
            let stages = pool.install(|| {
                of_job::run_sharing(&batch, job, source, &options, shared.as_ref(), &hear)
            })?;
            batch.finish()?;
            stages
        };
        rows.push((job.name.clone(), stages));
        let (modes, last, misses) = listener.finish();
        missed += misses;
        rows.extend(modes);
        if let Some(picture) = &last {
            sheet.add(picture);
        }
        all += stages;
    }
    if let (Some(path), Some(together)) = (&sheet_path, together) {
        let drawn = Instant::now();
        let mut output = ledger.create(path)?;
        output.write_all(&sheet.png()?).map_err(|source| output.failed(source))?;
        together.replace(output)?;
        together.finish()?;
        if !arguments.common.quiet {
            wrote(path, Some(sheet.size()), drawn.elapsed());
        }
    }
    if jobs.len() > 1 {
        rows.push(("all".into(), all));
    }
    if !arguments.common.quiet {
        say(Stages::table(&rows).trim_end());
    }
    match missed {
        0 => Ok(()),
        count => Err(PipelineError::ErrorMissed(count).into()),
    }
}

impl RunArguments {
    /// Prints a note if an earlier run stopped between the files of the batch.
    fn remark(&self, batch: &Batch<'_>) {
        if let Some(remark) = batch.remark().filter(|_| !self.common.quiet) {
            say(format_args!("pipeline: note: {remark}"));
        }
    }
}

/// Reads all files of the jobs before the first job replaces a file that another one reads. A job that
/// keeps its grids replaces files before it has read its textures. An output that does not exist yet
/// cannot be an input.
fn read_first(
    jobs: &[NamedJob<'_>],
    sources: &[Changed<'_>],
    outputs: &[PathBuf],
    options: &Options,
) -> Result<(), PipelineError> {
    if (jobs.len() > 1 || options.keep) && outputs.iter().any(|path| path.exists()) {
        let own = jobs.iter().zip(sources).filter(|(named, _)| !named.built_in);
        for (NamedJob { job, .. }, source) in own {
            of_job::scene(job, source, options, &|_| {})?;
        }
    }
    Ok(())
}

/// Returns the jobs that the arguments name, and checks that no two write the same file.
fn jobs<'a>(
    arguments: &RunArguments,
    ledger: &'a Ledger,
) -> Result<Vec<NamedJob<'a>>, PipelineError> {
    let mut jobs: Vec<NamedJob<'a>> = Vec::new();
    let mut written: BTreeMap<String, String> = BTreeMap::new();
    if arguments.sheet {
        written.insert(ContactSheet::FILE.into(), "--sheet".into());
    }
    let mut named = Vec::new();
    for (variant, settings) in variants(arguments, ledger)? {
        let of_variant = named::jobs(&arguments.jobs, &settings, ledger)?;
        named.extend(of_variant.into_iter().map(|mut named| {
            named.job.name.push_str(&variant);
            named
        }));
    }
    for NamedJob { job, path, source, built_in, figures, argument, settings } in named {
        let job = if figures.is_empty() { job } else { job.only(&figures) };
        let job = job.with_modes(&arguments.modes)?;
        let page_alone = built_in && figures.is_empty() && argument == job.name;
        let set = settings.iter().filter_map(|setting| Some(setting.below("scene")?.text()));
        let job = arguments.frames.in_parts(Job { set: set.collect(), ..job });
        let job = match arguments.error {
            Some(error) => job.with_error(error),
            None if page_alone && arguments.jobs.len() == 1 && arguments.modes.is_empty() => {
                job.and_error(PAGE_ERROR)
            }
            None => job,
        };
        for file in job.files(arguments.keep) {
            if let Some(first) = written.get(&file) {
                return Err(PipelineError::SameFile {
                    first: first.clone(),
                    second: argument.clone(),
                    file,
                });
            }
            written.insert(file, argument.clone());
        }
        jobs.push(NamedJob { job, path, source, built_in, figures, argument, settings });
    }
    Ok(jobs)
}

/// Returns the ends of the names of all variants, and the values that are set in them. Without a table there is one
/// variant, whose name has no end.
fn variants(
    arguments: &RunArguments,
    ledger: &Ledger,
) -> Result<Vec<(String, Vec<Setting>)>, PipelineError> {
    let Some(path) = &arguments.jobs_from else {
        return Ok(vec![(String::new(), arguments.settings.clone())]);
    };
    let bytes = ledger.argument(path, "the variants")?;
    let variants = files::variants::read(&input::name_of(path), &bytes)?;
    let with_given = |variant: Variant| {
        let settings = arguments.settings.iter().cloned().chain(variant.settings).collect();
        (format!("-{}", variant.name), settings)
    };
    Ok(variants.into_iter().map(with_given).collect())
}

/// Prints a job's events on standard error, and keeps the results that the command prints at the
/// end.
struct Listener<'a> {
    job: &'a str,
    /// Name of the mode of the further picture.
    further: Option<String>,
    arguments: &'a RunArguments,
    /// The time at which the file before was written, or the job began.
    before: Mutex<Instant>,
    bar: Bar,
    heard: Mutex<Heard>,
}

/// The times of each mode, if `--stats` is given, the last picture, if a contact sheet shows it, and
/// the number of pictures that miss their requested error.
type Heard = (Vec<(String, Stages)>, Option<Picture>, usize);

impl<'a> Listener<'a> {
    fn new(job: &'a Job, arguments: &'a RunArguments) -> Self {
        let bar = Bar::new(arguments.common.quiet);
        let further = job.further.as_ref().map(|mode| mode.name.clone());
        Self {
            job: &job.name,
            further,
            arguments,
            before: Mutex::new(Instant::now()),
            bar,
            heard: Mutex::default(),
        }
    }

    fn finish(self) -> Heard {
        self.heard.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    fn hear(&self, event: &Event<'_>) {
        match event {
            Event::Progress { mode, done, total } => {
                self.bar.tell(&format!("{} {mode}", self.job), *done, *total);
            }
            Event::Mesh { name, triangles, sweep, triangulate, missed } => {
                let seconds = (*sweep + *triangulate).as_secs_f64();
                self.say(&format!("{}: {name}, {triangles} triangles, {seconds:.2} s", self.job));
                if let Some(missed) = missed {
                    self.say(&format!("{}: note: {name}: {missed}", self.job));
                }
            }
            Event::Picture { mode, picture, stats, accuracy } => {
                self.bar.clear();
                let mut heard = self.heard.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some(accuracy) = accuracy {
                    if let Some(sources) = &accuracy.sources {
                        let pixels = accuracy.pixels.map(|pixels| {
                            format!("; meshes within {pixels:.2} pixels of their surfaces")
                        });
                        let pixels = pixels.unwrap_or_default();
                        self.say(&format!("{} {mode}: {sources}{pixels}", self.job));
                    }
                    let statement = &accuracy.statement;
                    self.say(&format!("{} {mode}: {statement}", self.job));
                    // A picture that the command line did not request cannot fail the run.
                    let requested = self.further.as_deref() != Some(*mode);
                    heard.2 += usize::from(requested && statement.missed.is_some());
                }
                if self.arguments.sheet {
                    heard.1 = Some((*picture).clone());
                }
                if stats.not_finite > 0 {
                    let (job, count) = (self.job, stats.not_finite);
                    let words = "pixels are not finite and were made black";
                    say(format_args!("pipeline: {job} {mode}: {count} {words}"));
                }
                if self.arguments.stats {
                    self.say(&format!("{} {mode}:\n{stats}", self.job));
                    heard.0.push((format!("  {mode}"), Stages::of_mode(stats)));
                }
            }
            Event::Written { path, size } => {
                self.bar.clear();
                let mut before = self.before.lock().unwrap_or_else(PoisonError::into_inner);
                if !self.arguments.common.quiet {
                    wrote(path, *size, before.elapsed());
                }
                *before = Instant::now();
            }
            Event::Kept(path) => {
                self.say(&format!(
                    "{}  kept: it is whole and has these inputs",
                    input::name_of(path)
                ));
            }
        }
    }

    fn say(&self, words: &str) {
        if !self.arguments.common.quiet {
            say(words.trim_end());
        }
    }
}
