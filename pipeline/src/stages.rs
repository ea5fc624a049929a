//! Measures the time that each stage of a job takes.

use render::stats::Stats;
use std::ops::AddAssign;
use std::time::Duration;

/// Wall-clock time of each stage between specs and picture files.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Stages {
    /// Specs to grids.
    pub sweep: Duration,
    /// Grids to triangles with normals and texture coordinates, in the form that `render` takes.
    /// Includes writing the OBJ file if the job keeps it.
    pub triangulate: Duration,
    /// Reading and decoding scene files and textures, and building the scene.
    pub read: Duration,
    /// Prefiltered tables, once for each filter.
    pub tables: Duration,
    /// Acceleration structures for ray hits, once for each structure.
    pub structure: Duration,
    /// Rays and shading.
    pub picture: Duration,
    /// Encoding pictures as PNG and writing the files.
    pub write: Duration,
}

impl Stages {
    /// The names of the stages, in the order in which they run.
    pub const NAMES: [&str; 7] =
        ["sweep", "triangulate", "read", "tables", "structure", "picture", "write"];

    /// Returns the times of one mode, without the stages that all modes share.
    #[must_use]
    pub fn of_mode(stats: &Stats) -> Self {
        Self {
            tables: stats.table_time,
            structure: stats.accel_time,
            picture: stats.picture_time,
            write: stats.write_time,
            ..Self::default()
        }
    }

    /// Returns the times in the order of [`Stages::NAMES`].
    #[must_use]
    pub fn times(&self) -> [Duration; 7] {
        let Self { sweep, triangulate, read, tables, structure, picture, write } = *self;
        [sweep, triangulate, read, tables, structure, picture, write]
    }

    /// Returns the sum of all times.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.times().iter().sum()
    }

    /// Returns the name of the slowest stage (the first of equals) and its fraction of the total, in
    /// [0, 1].
    #[must_use]
    pub fn slowest(&self) -> (&'static str, f64) {
        let mut slowest = (Self::NAMES[0], Duration::ZERO);
        for (name, time) in Self::NAMES.into_iter().zip(self.times()) {
            if time > slowest.1 {
                slowest = (name, time);
            }
        }
        let total = self.total().as_secs_f64();
        (slowest.0, if total > 0.0 { slowest.1.as_secs_f64() / total } else { 0.0 })
    }

    /// Returns a text table of the times in seconds: one line for each row, one column for each stage.
    #[must_use]
    pub fn table(rows: &[(String, Self)]) -> String {
        let wide = rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0).max(7);
        let width = |name: &str| name.len().max(6) + 2;
        let mut text = format!("{:<wide$}", "seconds");
        for name in Self::NAMES.into_iter().chain(["all"]) {
            text.push_str(&format!("{name:>0$}", width(name)));
        }
        text.push_str("  slowest\n");
        for (row, stages) in rows {
            text.push_str(&format!("{row:<wide$}"));
            let all = stages.times().into_iter().chain([stages.total()]);
            for (name, time) in Self::NAMES.into_iter().chain(["all"]).zip(all) {
                // A stage without work is shown as `-`.
                let seconds = match time {
                    Duration::ZERO => "-".into(),
                    time => format!("{:.2}", time.as_secs_f64()),
                };
                text.push_str(&format!("{seconds:>0$}", width(name)));
            }
            let (name, part) = stages.slowest();
            text.push_str(&format!("  {name} {:.0} %\n", 100.0 * part));
        }
        text
    }
}

impl AddAssign for Stages {
    fn add_assign(&mut self, other: Self) {
        self.sweep += other.sweep;
        self.triangulate += other.triangulate;
        self.read += other.read;
        self.tables += other.tables;
        self.structure += other.structure;
        self.picture += other.picture;
        self.write += other.write;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_adds_up_and_names_the_slowest() {
        let seconds = Duration::from_secs;
        let one = Stages { read: seconds(1), picture: seconds(3), ..Stages::default() };
        let mut two = one;
        two += one;
        assert_eq!((one.total(), two.total()), (seconds(4), seconds(8)));
        assert_eq!(two.slowest(), ("picture", 0.75));
        assert_eq!(Stages::default().slowest(), ("sweep", 0.0));
        let table = Stages::table(&[("a".into(), one), ("two".into(), two)]);
        let lines: Vec<Vec<&str>> =
            table.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(lines[0].len(), 10);
        assert_eq!(
            lines[2],
            ["two", "-", "-", "2.00", "-", "-", "6.00", "-", "8.00", "picture", "75", "%"]
        );
        // The numbers end in the same columns as their names.
        let all: Vec<&str> = table.lines().collect();
        assert_eq!(all[0].find("read").unwrap() + 4, all[1].find("1.00").unwrap() + 4);
    }
}
