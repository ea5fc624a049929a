//! Scripts by which existing schedulers make the frames of an animation, or the parts of pictures.
//!
//! Each task is a plain `pipeline run` command with some of the frames (`--frames 11-20`), with a part of each picture
//! (`--tile 2/4`), or with both. A task may run twice, also at the same time, and may be killed: a file is replaced as a
//! whole or not at all, and a whole file of the same inputs is not made again. The last step, which starts when all
//! tasks have ended well, is the same command for all frames with `--join` and `--film`; it makes no frame.
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
    /// Number of frames; `None` if the pictures are not animated.
    pub frames: Option<u32>,
    /// Frames of a task, at least 1.
    pub chunk: u32,
    /// Parts of each picture, at least 1. Each is a task.
    pub tiles: u32,
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

    /// Returns the frames of tasks, such as `11-20`. Pictures that are not animated count as one frame.
    fn chunks(&self) -> Vec<String> {
        let frames = self.frames.unwrap_or(1);
        let starts = (1..=frames).step_by(self.chunk as usize);
        let last = |first: u32| first.saturating_add(self.chunk - 1).min(frames);
        starts.map(|first| format!("{first}-{}", last(first))).collect()
    }

    /// Returns all tasks, each with its frames and its part. Parts of the same frames follow one another.
    fn tasks(&self) -> Vec<(String, u32)> {
        let of_chunk = |chunk: String| (1..=self.tiles).map(move |tile| (chunk.clone(), tile));
        self.chunks().into_iter().flat_map(of_chunk).collect()
    }

    /// Returns the flags of a task, for these frames and this part.
    fn flags(&self, frames: &str, tile: &str) -> String {
        let frames = self.frames.map(|_| format!("--frames {frames} ")).unwrap_or_default();
        let tile =
            if self.tiles > 1 { format!("--tile {tile}/{} ", self.tiles) } else { String::new() };
        format!("{frames}{tile}").trim_end().into()
    }

    /// Returns the command of the tasks, as a shell reads it.
    fn line(&self) -> String {
        self.command.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
    }

    /// Returns the name and the command of the last step, as a shell reads it, if there is one.
    fn last(&self) -> Option<(&'static str, String)> {
        let join = if self.tiles > 1 { format!(" --join {}", self.tiles) } else { String::new() };
        let film = self.film.as_ref().map(|film| format!(" --film {}", quoted(film)));
        let name = if film.is_some() { "film" } else { "join" };
        let flags = format!("{join}{}", film.unwrap_or_default());
        (!flags.is_empty()).then(|| (name, format!("{}{flags}", self.line())))
    }

    /// Returns a line about the script, behind a comment sign.
    fn title(&self) -> String {
        let Self { name, chunk, tiles, .. } = self;
        let tasks = self.tasks().len();
        let parts = if *tiles > 1 { format!(" in {tiles} parts") } else { String::new() };
        match self.frames {
            Some(frames) => {
                format!("# {frames} frames of {name}{parts}: {tasks} tasks of up to {chunk} frames")
            }
            None => format!("# Pictures of {name}{parts}: {tasks} tasks"),
        }
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
            frames: Some(25),
            chunk: 10,
            tiles: 1,
            film: Some("it's.mp4".into()),
            hosts: vec![],
        }
    }

    #[test]
    fn tasks_have_all_frames_once() {
        assert_eq!(plan().chunks(), ["1-10", "11-20", "21-25"]);
        let one = Plan { chunk: 100, ..plan() };
        assert_eq!(one.chunks(), ["1-25"]);
        let parts = Plan { tiles: 2, chunk: 20, ..plan() };
        let expected = [("1-20", 1), ("1-20", 2), ("21-25", 1), ("21-25", 2)];
        assert_eq!(parts.tasks(), expected.map(|(frames, tile)| (frames.to_string(), tile)));
        assert_eq!(parts.flags("1-20", "2"), "--frames 1-20 --tile 2/2");
        assert_eq!(plan().flags("1-20", "1"), "--frames 1-20");
        let still = Plan { tiles: 3, frames: None, film: None, ..plan() };
        assert_eq!(still.tasks().len(), 3);
        assert_eq!(still.flags("1-1", "3"), "--tile 3/3");
        let last = ("join", "pipeline run 'my job.json' -o out --join 3".to_string());
        assert_eq!(still.last(), Some(last));
        assert_eq!(Plan { film: None, ..plan() }.last(), None);
    }

    #[test]
    fn words_are_quoted_for_a_shell() {
        let (name, line) = plan().last().unwrap();
        assert_eq!(name, "film");
        assert_eq!(line, "pipeline run 'my job.json' -o out --film 'it'\\''s.mp4'");
    }

    /// A shell accepts the scripts, which it reads without running them.
    #[test]
    fn shells_read_the_scripts() {
        for engine in [Engine::Slurm, Engine::Parallel] {
            for plan in [
                plan(),
                Plan { film: None, hosts: vec!["8/a".into(), ":".into()], ..plan() },
                Plan { tiles: 4, ..plan() },
                Plan { tiles: 4, frames: None, film: None, ..plan() },
            ] {
                let script = plan.script(engine);
                let run = Command::new("sh").args(["-n", "-c", &script]).output().unwrap();
                assert!(run.status.success(), "{script}\n{}", String::from_utf8_lossy(&run.stderr));
            }
        }
    }
}
