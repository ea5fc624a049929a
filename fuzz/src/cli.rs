//! The flags of the program, and their execution.

use crate::child::Child;
use crate::error::FuzzError;
use crate::protocol::Answer;
use crate::reader::{Bench, Reader};
use crate::run;
use crate::schedule::Until;
use crate::tally::Group;
use crate::verdict::Verdict;
use crate::worker;
use clap::Parser;
use files::exit::say;
use std::io::{Write, stdout};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

const EXAMPLES: &str = "\
Examples:
  fuzz --seconds 60
  fuzz --cases 1000000 --seed 7 --keep findings
  fuzz --reader obj,mtl --seconds 10
  fuzz --reader scene --seed 7 --case 1234 --keep findings
  fuzz --reader png --input findings/png-7-1234.min.png

Exit codes: 0 nothing found, 1 something found, 2 bad use, 5 the fuzzer itself could not work.";

/// Tries mutated inputs on every reader.
#[derive(Debug, Parser)]
#[command(version, after_help = EXAMPLES)]
pub struct Arguments {
    /// Total number of cases, shared evenly among the readers
    #[arg(long, value_name = "N", conflicts_with = "seconds")]
    cases: Option<u64>,
    /// Wall-clock time in seconds, shared evenly among the readers [default: 60]
    #[arg(long, value_name = "S")]
    seconds: Option<f64>,
    /// The seed of all cases; always printed [default: taken from the clock]
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// The readers to try, with commas between them [default: all]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    reader: Vec<Reader>,
    /// Number of parallel processes [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// A folder for inputs with a fault, original and minimized
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    /// Try only this case
    #[arg(long, value_name = "K", requires = "seed", requires = "reader")]
    case: Option<u64>,
    /// Try only this file
    #[arg(long, value_name = "FILE", requires = "reader", conflicts_with = "case")]
    input: Option<PathBuf>,
    /// Write the seeds of the readers as files into the folder of --keep, and do nothing else
    #[arg(long, requires = "keep", conflicts_with_all = ["case", "input", "cases", "seconds"])]
    seeds: bool,
    /// Run as a child process, which reads the cases to try from standard input
    #[arg(long, exclusive = true, hide = true)]
    worker: bool,
}

/// Does what the arguments request, and returns the number of different faults.
///
/// # Errors
/// When the fuzzer itself could not work.
pub fn run(arguments: &Arguments) -> Result<usize, FuzzError> {
    if arguments.worker {
        return worker::run().map(|()| 0);
    }
    if let Some(folder) = &arguments.keep {
        std::fs::create_dir_all(folder).map_err(|source| of_file(folder, source))?;
    }
    if arguments.seeds {
        return seeds(arguments).map(|()| 0);
    }
    if let Some(path) = &arguments.input {
        let bytes = std::fs::read(path).map_err(|source| of_file(path, source))?;
        return single(arguments, &bytes, &path.display().to_string());
    }
    let seed = arguments.seed.unwrap_or_else(from_the_clock);
    if let Some(case) = arguments.case {
        let reader = arguments.reader[0];
        let bytes = Bench::load()?.input(reader, seed, case);
        keep(arguments, &name(reader, seed, case, ""), &bytes)?;
        return single(arguments, &bytes, &format!("{reader}, seed {seed}, case {case}"));
    }
    say(format_args!("fuzz: seed {seed}"));
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    let jobs = arguments.jobs.map_or_else(cores, usize::from);
    let until = match (arguments.cases, arguments.seconds) {
        (Some(cases), _) => Until::Cases(cases),
        (None, seconds) => {
            let seconds = seconds.unwrap_or(60.0).clamp(0.0, 1e9);
            Until::Instant(Instant::now() + Duration::from_secs_f64(seconds))
        }
    };
    let started = Instant::now();
    let tally = run::run(&readers(arguments), seed, until, jobs)?;
    let took = started.elapsed().as_secs_f64();
    print(&format!("{tally}seed {seed}, {took:.1} s, {jobs} processes\n"))?;
    let groups = tally.groups();
    if !groups.is_empty() {
        tell(arguments, seed, &groups)?;
    }
    Ok(groups.len())
}

fn readers(arguments: &Arguments) -> Vec<Reader> {
    if arguments.reader.is_empty() { Reader::ALL.to_vec() } else { arguments.reader.clone() }
}

/// Prints each fault, minimizes its input and keeps the input.
fn tell(arguments: &Arguments, seed: u64, groups: &[Group]) -> Result<(), FuzzError> {
    let bench = Bench::load()?;
    for Group { reader, count, case, fault } in groups {
        print(&format!(
            "\n{} x{count}: {}\n  again: fuzz --reader {reader} --seed {seed} --case {case}\n",
            fault.kind, fault.text
        ))?;
        if arguments.keep.is_some() {
            let input = bench.input(*reader, seed, *case);
            keep(arguments, &name(*reader, seed, *case, ""), &input)?;
            let small = run::minimized(*reader, &input, &fault.signature())?;
            let path = keep(arguments, &name(*reader, seed, *case, ".min"), &small)?;
            print(&format!("  {} of {} bytes left in {path}\n", small.len(), input.len()))?;
        }
    }
    Ok(())
}

/// Tries one input, and prints the result.
fn single(arguments: &Arguments, bytes: &[u8], what: &str) -> Result<usize, FuzzError> {
    let Answer { verdict, time, memory } = Child::default().input(arguments.reader[0], bytes)?;
    let cost = format!("{:.3} s, {} MB", time.as_secs_f64(), memory >> 20);
    let (words, faults) = match verdict {
        Verdict::Accepted => ("accepted".into(), 0),
        Verdict::Refused(message) => (format!("refused: {message}"), 0),
        Verdict::Fault(fault) => (format!("{}: {}", fault.kind, fault.text), 1),
    };
    print(&format!("{what}: {words} ({cost})\n"))?;
    Ok(faults)
}

/// Writes all seeds as files.
fn seeds(arguments: &Arguments) -> Result<(), FuzzError> {
    let bench = Bench::load()?;
    for reader in readers(arguments) {
        for (number, bytes) in bench.seeds(reader).iter().enumerate() {
            keep(arguments, &format!("{reader}-seed-{number}.{}", reader.ending()), bytes)?;
        }
    }
    Ok(())
}

/// Writes a file into the folder of `--keep`, if there is one, and returns its path.
fn keep(arguments: &Arguments, name: &str, bytes: &[u8]) -> Result<String, FuzzError> {
    let Some(folder) = &arguments.keep else { return Ok(String::new()) };
    let path = folder.join(name);
    std::fs::write(&path, bytes).map_err(|source| of_file(&path, source))?;
    Ok(path.display().to_string())
}

fn name(reader: Reader, seed: u64, case: u64, kind: &str) -> String {
    format!("{reader}-{seed}-{case}{kind}.{}", reader.ending())
}

fn of_file(path: &Path, source: std::io::Error) -> FuzzError {
    FuzzError::File { path: path.display().to_string(), source }
}

fn print(text: &str) -> Result<(), FuzzError> {
    Ok(stdout().write_all(text.as_bytes())?)
}

/// Returns the milliseconds since 1970 as a seed, so that two runs have different seeds.
fn from_the_clock() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    since.as_millis() as u64
}
