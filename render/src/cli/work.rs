//! The flags for the work: its structure, its statistics, and those that all programs have.

use clap::{Args, ValueEnum};
use files::CommonArguments;
use files::exit::say;
use render::Scene;
use render::accel::Structure;
use render::stats::Stats;

#[derive(Debug, Args)]
pub struct WorkArguments {
    /// Structure that finds the surfaces hit by rays; does not change the picture
    #[arg(long, value_name = "STRUCTURE", default_value = "bvh")]
    pub accel: Structure,
    /// Print counts of rays, hits and texels and the time of each stage on standard error
    #[arg(long, value_name = "AS", num_args = 0..=1, require_equals = true, default_missing_value = "text")]
    stats: Option<StatsForm>,
    #[command(flatten)]
    pub common: CommonArguments,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum StatsForm {
    /// A table
    Text,
    /// One JSON object
    Json,
}

impl WorkArguments {
    /// Prints what the readers of the scene's files did not use, unless `--quiet` is given.
    pub fn print_remarks(&self, scene: &Scene) {
        if !self.common.quiet {
            scene.remarks.iter().for_each(|remark| say(format_args!("render: {remark}")));
        }
    }

    /// Returns whether a line tells of the written picture. The line would not be JSON.
    pub fn tells(&self) -> bool {
        !self.common.quiet && !matches!(self.stats, Some(StatsForm::Json))
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
