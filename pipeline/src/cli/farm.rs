//! `pipeline farm`: writes a script by which a scheduler makes the frames of an animation.

use super::named;
use crate::PipelineError;
use crate::farm::{Engine, MOST_TASKS, Plan};
use clap::Args;
use files::{Ledger, Report, Setting};
use std::path::PathBuf;

/// Arguments of `pipeline farm`.
#[derive(Debug, Args)]
pub struct FarmArguments {
    /// The job: a page by name, or a job file. Without the key `animate` or `turntable` it needs --tiles
    #[arg(value_name = "NAME|FILE.json")]
    job: String,
    /// The scheduler that reads the script
    #[arg(long, value_name = "ENGINE")]
    engine: Engine,
    /// Frames of each task [default: 1, or more if that makes more than 1000 tasks]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    chunk: Option<u32>,
    /// Parts of each picture, each a task; the last step joins them
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=65536))]
    tiles: u32,
    /// Make the pictures of an animated job without its animation
    #[arg(long, requires = "tiles", conflicts_with_all = ["chunk", "film"])]
    still: bool,
    /// The script [default: standard output]
    #[arg(long, value_name = "FILE", default_value = "-")]
    script: PathBuf,
    /// The folder for the frames, as seen by each task
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: String,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", value_parser = render::film::size)]
    size: Option<(u32, u32)>,
    /// Make only the pictures of this mode; may be given several times
    #[arg(long = "mode", value_name = "NAME")]
    modes: Vec<String>,
    /// Set a value of the job, of its scene or of a spec; may be given several times
    #[arg(short = 'D', value_name = "PATH=VALUE")]
    settings: Vec<Setting>,
    /// Make a film in the end, as `pipeline run --film` does
    #[arg(long, value_name = "FILE")]
    film: Option<String>,
    /// For GNU parallel: a host, as its own `--sshlogin` takes it; may be given several times
    #[arg(long, value_name = "HOST")]
    sshlogin: Vec<String>,
}

/// Writes the script.
pub fn farm(arguments: &FarmArguments) -> Result<(), Report> {
    let ledger = Ledger::new(true);
    let jobs = named::jobs(std::slice::from_ref(&arguments.job), &arguments.settings, &ledger)?;
    let Some(named) = jobs.into_iter().next() else { return Ok(()) };
    let job = named.job.with_modes(&arguments.modes)?;
    let animation = job.animation.as_ref().filter(|_| !arguments.still);
    let asks = arguments.film.is_some() || arguments.chunk.is_some() || arguments.tiles == 1;
    if animation.is_none() && asks {
        return Err(PipelineError::NotDivided(job.name).into());
    }
    if arguments.film.is_some() && job.modes.len() != 1 {
        let modes: Vec<&str> = job.modes.iter().map(|mode| mode.name.as_str()).collect();
        let modes = modes.join(", ");
        return Err(PipelineError::FilmOfModes { job: job.name, modes }.into());
    }
    let mut command = vec!["pipeline".into(), "run".into(), arguments.job.clone()];
    command.extend(["-o".into(), arguments.output.clone()]);
    if let Some((width, height)) = arguments.size {
        command.extend(["--size".into(), format!("{width}x{height}")]);
    }
    command.extend(arguments.modes.iter().flat_map(|mode| ["--mode".into(), mode.clone()]));
    let settings = arguments.settings.iter().map(Setting::argument);
    command.extend(settings.flat_map(|setting| ["-D".to_string(), setting.into()]));
    if arguments.still {
        command.push("--still".into());
    }
    let frames = animation.map(|animation| animation.frames);
    let count = u64::from(frames.unwrap_or(1)) * u64::from(arguments.tiles);
    let plan = Plan {
        name: job.name.clone(),
        command,
        frames,
        chunk: arguments.chunk.unwrap_or(count.div_ceil(u64::from(MOST_TASKS)) as u32),
        tiles: arguments.tiles,
        film: arguments.film.clone(),
        hosts: arguments.sshlogin.clone(),
    };
    let script = plan.script(arguments.engine);
    Ok(ledger.create(&arguments.script)?.commit_all(script.as_bytes())?)
}
