//! The flags for threads, memory, statistics and the progress bar.

use super::UseError;
use clap::builder::TypedValueParser;
use clap::{Args, ValueEnum};
use files::exit::say;
use render::Scene;
use render::accel::Structure;
use render::stats::Stats;

#[derive(Debug, Args)]
pub struct WorkArguments {
    /// Structure that finds the surfaces hit by rays; does not change the picture
    #[arg(long, value_name = "STRUCTURE", default_value = "bvh")]
    pub accel: Structure,
    /// Worker threads, 1 to 1024 [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024).map(usize::from))]
    threads: Option<usize>,
    /// Most memory to use, in bytes or with k, M or G. A larger request is refused before the work
    /// starts [default: 90 % of the free memory]
    #[arg(long, value_name = "BYTES", value_parser = files::memory::bytes)]
    pub max_memory: Option<u64>,
    /// Print counts of rays, hits and texels and the time of each stage on standard error
    #[arg(long, value_name = "AS", num_args = 0..=1, require_equals = true, default_missing_value = "text")]
    stats: Option<StatsForm>,
    /// Progress on standard error
    #[arg(
        long,
        value_enum,
        default_value_t,
        hide_possible_values = true,
        value_name = "bar|plain|json|none"
    )]
    pub progress: files::progress::Mode,
    /// No progress bar, no line about the written file, and no remarks on what the input files hold that is not used
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum StatsForm {
    /// A table
    Text,
    /// One JSON object
    Json,
}

impl WorkArguments {
    /// Starts the worker threads.
    pub fn pool(&self) -> Result<rayon::ThreadPool, UseError> {
        let threads = self.threads.unwrap_or(0);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|error| UseError::Threads(threads, error))
    }

    /// Prints what the readers of the scene's files did not use, unless `--quiet` is given.
    pub fn print_remarks(&self, scene: &Scene) {
        if !self.quiet {
            scene.remarks.iter().for_each(|remark| say(format_args!("render: {remark}")));
        }
    }

    /// Returns whether a line tells of the written picture. The line would not be JSON.
    pub fn tells(&self) -> bool {
        !self.quiet && !matches!(self.stats, Some(StatsForm::Json))
    }

    /// Prints the statistics that `--stats` requests, and warns of pixels that are not finite.
    pub fn print_stats(&self, stats: &Stats) {
        if stats.not_finite > 0 {
            let count = stats.not_finite;
            say(format_args!("render: {count} pixels are not finite and were made black"));
        }
        match self.stats {
            Some(StatsForm::Text) => say(stats.to_string().trim_end()),
            Some(StatsForm::Json) => say(serde_json::to_string(stats).unwrap_or_default()),
            None => {}
        }
    }
}
