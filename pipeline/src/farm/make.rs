//! A makefile.

use super::Plan;

/// Returns the makefile. Its tasks are phony: a task decides by the frames themselves what is left to do.
pub(super) fn script(plan: &Plan) -> String {
    let is_split = plan.tiles > 1;
    // The name of a task, its frames and its part within the name.
    let (stem, frames, tile) = match plan.frames {
        Some(_) if is_split => {
            ("frames", "$(word 1,$(subst -tile-, ,$*))", "$(word 2,$(subst -tile-, ,$*))")
        }
        Some(_) => ("frames", "$*", ""),
        None => ("tile", "", "$*"),
    };
    let target = |(frames, tile): (String, u32)| match plan.frames {
        Some(_) if is_split => format!("frames-{frames}-tile-{tile}"),
        Some(_) => format!("frames-{frames}"),
        None => format!("tile-{tile}"),
    };
    let all = plan.tasks().into_iter().map(target).collect::<Vec<_>>().join(" ");
    // A dollar sign is special for make.
    let line = plan.line().replace('$', "$$");
    let flags = plan.flags(frames, tile);
    let (first, last) = match plan.last() {
        Some((name, last)) => {
            let last = last.replace('$', "$$");
            (name, format!("{name}: $(TASKS)\n\t{last} -q\n\n"))
        }
        None => ("tasks", String::new()),
    };
    format!(
        "{title}.\n\
         # Run it in the folder of the job: make -j 4 -f THIS\n\
         TASKS = {all}\n\
         .PHONY: all film join tasks $(TASKS)\n\
         all: {first}\n\n\
         tasks: $(TASKS)\n\n{last}\
         $(TASKS): {stem}-%:\n\
         \t{line} {flags} --threads 1 -q\n",
        title = plan.title(),
    )
}

#[cfg(test)]
mod tests {
    use super::super::tests::plan;
    use super::*;
    use std::process::Command;

    /// make itself, with a stand-in for the program; where there is no make, the test says so.
    #[test]
    fn every_task_gets_its_frames_and_the_film_comes_last() {
        let task = |flags: &str| format!("run my job.json -o out {flags} --threads 1 -q");
        let chunks = ["1-10", "11-20", "21-25"];
        let film = "run my job.json -o out --film it's.mp4 -q";
        assert_made(&plan(), &chunks.map(|chunk| task(&format!("--frames {chunk}"))), film);
        let parts = Plan { tiles: 2, chunk: 20, film: None, ..plan() };
        let expected =
            ["1-20 --tile 1/2", "1-20 --tile 2/2", "21-25 --tile 1/2", "21-25 --tile 2/2"];
        let expected = expected.map(|flags| task(&format!("--frames {flags}")));
        assert_made(&parts, &expected, "run my job.json -o out --join 2 -q");
        let still = Plan { frames: None, ..parts };
        let expected = ["--tile 1/2", "--tile 2/2"].map(task);
        assert_made(&still, &expected, "run my job.json -o out --join 2 -q");
    }

    /// Checks which tasks make starts, and that the last one is the last.
    fn assert_made(plan: &Plan, tasks: &[String], last: &str) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        std::fs::write(path.join("tasks.mk"), script(plan)).unwrap();
        std::fs::write(path.join("pipeline"), "#!/bin/sh\necho \"$@\" >> log\n").unwrap();
        assert!(
            Command::new("chmod").arg("+x").arg(path.join("pipeline")).status().unwrap().success()
        );
        let paths = format!("{}:{}", path.display(), std::env::var("PATH").unwrap());
        let make = Command::new("make")
            .args(["-j", "2", "-f", "tasks.mk"])
            .env("PATH", paths)
            .current_dir(path)
            .output();
        let Ok(run) = make else {
            println!("not tested: there is no make");
            return;
        };
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let log = std::fs::read_to_string(path.join("log")).unwrap();
        let mut lines: Vec<&str> = log.lines().collect();
        assert_eq!(lines.pop(), Some(last));
        lines.sort_unstable();
        assert_eq!(lines, tasks);
    }
}
