//! Scripts by which existing schedulers make the frames of an animation, or the parts of pictures.
//!
//! Each task is a plain `pipeline run` command with some of the frames (`--frames 11-20`). A task may run twice, also
//! at the same time, and may be killed: a frame is replaced by a whole file or not at all, and a whole frame of the
//! same inputs is not made again. The last step, which starts when all tasks have ended well, is the same command
//! for all frames with `--film`; it makes no frame.
//!
//! The exit code of a task says whether a retry can help: yes for 5 (a file could not be read or written), 6 (memory
//! or threads) and for signals (above 128); no for 2, 3, 4 and 70.

mod make;
mod parallel;
mod slurm;

use clap::ValueEnum;

/// A scheduler.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// An array job of Slurm: a shell script that calls sbatch
    Slurm,
    /// GNU parallel: a shell script
    Parallel,
    /// GNU make: a makefile
    Make,
}

/// The work that a script divides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plan {
    /// Name of the job, for names of files and of tasks.
    pub name: String,
    /// The command of each task without its frames, as words: `pipeline run ...`.
    pub command: Vec<String>,
    /// Number of frames.
    pub frames: u32,
    /// Frames of a task, at least 1.
    pub chunk: u32,
    /// The film, if one is made in the end.
    pub film: Option<String>,
    /// Hosts for GNU parallel, as its `--sshlogin` takes them.
    pub hosts: Vec<String>,
}

/// Most tasks of an array job unless a cluster allows more (`MaxArraySize` of Slurm).
pub const MOST_TASKS: u32 = 1000;

impl Plan {
    /// Returns the script for a scheduler.
    #[must_use]
    pub fn script(&self, engine: Engine) -> String {
        match engine {
            Engine::Slurm => slurm::script(self),
            Engine::Parallel => parallel::script(self),
            Engine::Make => make::script(self),
        }
    }

    /// Returns the frames of each task, such as `11-20`.
    fn chunks(&self) -> Vec<String> {
        let starts = (1..=self.frames).step_by(self.chunk as usize);
        starts.map(|first| format!("{first}-{}", self.last_of(first))).collect()
    }

    /// Returns the last frame of the task that begins with this one.
    fn last_of(&self, first: u32) -> u32 {
        first.saturating_add(self.chunk - 1).min(self.frames)
    }

    /// Returns the command of the tasks, as a shell reads it.
    fn line(&self) -> String {
        self.command.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
    }

    /// Returns the command of the last step, as a shell reads it.
    fn last_line(&self) -> Option<String> {
        let film = self.film.as_ref()?;
        Some(format!("{} --film {}", self.line(), quoted(film)))
    }

    /// Returns a line about the script, behind a comment sign.
    fn title(&self) -> String {
        let tasks = self.chunks().len();
        format!("# {} frames of {}: {tasks} tasks of up to {}", self.frames, self.name, self.chunk)
    }
}

/// Returns a word as a shell reads it.
#[must_use]
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_=.,/+:@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.into();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;

    pub(super) fn plan() -> Plan {
        let words = ["pipeline", "run", "my job.json", "-o", "out"];
        Plan {
            name: "knot".into(),
            command: words.map(String::from).to_vec(),
            frames: 25,
            chunk: 10,
            film: Some("it's.mp4".into()),
            hosts: vec![],
        }
    }

    #[test]
    fn tasks_have_all_frames_once() {
        assert_eq!(plan().chunks(), ["1-10", "11-20", "21-25"]);
        let one = Plan { chunk: 100, ..plan() };
        assert_eq!(one.chunks(), ["1-25"]);
    }

    #[test]
    fn words_are_quoted_for_a_shell() {
        let line = plan().last_line().unwrap();
        assert_eq!(line, "pipeline run 'my job.json' -o out --film 'it'\\''s.mp4'");
    }

    /// A shell accepts the scripts, which it reads without running them.
    #[test]
    fn shells_read_the_scripts() {
        for engine in [Engine::Slurm, Engine::Parallel] {
            for plan in
                [plan(), Plan { film: None, hosts: vec!["8/a".into(), ":".into()], ..plan() }]
            {
                let script = plan.script(engine);
                let run = Command::new("sh").args(["-n", "-c", &script]).output().unwrap();
                assert!(run.status.success(), "{script}\n{}", String::from_utf8_lossy(&run.stderr));
            }
        }
    }
}
