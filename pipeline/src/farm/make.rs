//! A makefile.

use super::Plan;

/// Returns the makefile. Its tasks are phony: a task decides by the frames themselves what is left to do.
pub(super) fn script(plan: &Plan) -> String {
    let targets: Vec<String> =
        plan.chunks().iter().map(|chunk| format!("frames-{chunk}")).collect();
    let all = targets.join(" ");
    // A dollar sign is special for make.
    let line = plan.line().replace('$', "$$");
    let film = plan.last_line().map(|last| last.replace('$', "$$"));
    let (first, film) = match film {
        Some(last) => ("film", format!("film: $(FRAMES)\n\t{last} -q\n\n")),
        None => ("frames", String::new()),
    };
    format!(
        "{title}.\n\
         # Run it in the folder of the job: make -j 4 -f THIS\n\
         FRAMES = {all}\n\
         .PHONY: all film frames $(FRAMES)\n\
         all: {first}\n\n\
         frames: $(FRAMES)\n\n{film}\
         $(FRAMES): frames-%:\n\
         \t{line} --frames $* --threads 1 -q\n",
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
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        std::fs::write(path.join("tasks.mk"), script(&plan())).unwrap();
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
        assert_eq!(lines.pop(), Some("run my job.json -o out --film it's.mp4 -q"));
        lines.sort_unstable();
        let task =
            |frames: &str| format!("run my job.json -o out --frames {frames} --threads 1 -q");
        assert_eq!(lines, ["1-10", "11-20", "21-25"].map(task));
    }
}
