//! A shell script that submits an array job to Slurm, and the film as a job that depends on it.

use super::{MOST_TASKS, Plan, quoted};

/// Most restarts of a task whose exit code says that a retry can help.
const RETRIES: u32 = 3;

/// Returns the script.
pub(super) fn script(plan: &Plan) -> String {
    let tasks = plan.tasks().len() as u32;
    let Plan { chunk, tiles, .. } = plan;
    let (name, line) = (quoted(&plan.name), plan.line());
    let many = if tasks > MOST_TASKS {
        format!(
            "# Slurm takes {MOST_TASKS} tasks of an array unless the cluster allows more: see MaxArraySize, or choose a larger --chunk.\n"
        )
    } else {
        String::new()
    };
    let last = plan.last().map(|(step, last)| {
        format!(
            "last=$(sbatch --parsable --job-name={name}-{step} --output={name}-{step}.log \\\n  \
             --dependency=afterok:\"$tasks\" --kill-on-invalid-dep=yes \"$@\" <<'LAST'\n\
             #!/bin/sh\nexec {last} --threads \"${{SLURM_CPUS_ON_NODE:-1}}\" -q\nLAST\n)\n\
             echo \"{step}: job $last, after the tasks\"\n"
        )
    });
    // Parts of the same frames follow one another.
    let (index, tile) = match tiles {
        1 => ("SLURM_ARRAY_TASK_ID".to_string(), String::new()),
        _ => (
            format!("SLURM_ARRAY_TASK_ID / {tiles}"),
            format!("tile=$((SLURM_ARRAY_TASK_ID % {tiles} + 1))\n"),
        ),
    };
    let range = match plan.frames {
        None => String::new(),
        Some(frames) => format!(
            "first=$(({index} * {chunk} + 1))\n\
             last=$((first + {chunk} - 1))\n\
             [ \"$last\" -le {frames} ] || last={frames}\n"
        ),
    };
    let flags = plan.flags("\"$first-$last\"", "$tile");
    format!(
        "#!/bin/sh\n{title}.\n\
         # Submit it in the folder of the job: sh THIS [flags of sbatch, such as --partition=short --cpus-per-task=4]\n\
         {many}set -eu\n\
         tasks=$(sbatch --parsable --job-name={name} --output={name}-%a.log --open-mode=append \\\n  \
         --array=0-{last_task} --requeue \"$@\" <<'TASK'\n\
         #!/bin/sh\n\
         {range}{tile}code=0\n\
         {line} {flags} --threads \"${{SLURM_CPUS_PER_TASK:-1}}\" -q || code=$?\n\
         case $code in\n  \
         5|6) # A file, memory or threads: another try may help.\n    \
         if [ \"${{SLURM_RESTART_COUNT:-0}}\" -lt {RETRIES} ]; then\n      \
         scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\" && sleep 60\n    \
         fi;;\n\
         esac\n\
         exit \"$code\"\n\
         TASK\n)\n\
         echo \"tasks: job $tasks, {tasks} tasks\"\n{last}",
        title = plan.title(),
        last_task = tasks - 1,
        last = last.unwrap_or_default(),
    )
}

#[cfg(test)]
mod tests {
    use super::super::tests::plan;
    use super::*;
    use std::process::Command;

    /// The script in a folder with a stand-in for Slurm, which runs each task of the array and then the film.
    #[test]
    fn every_task_gets_its_frames_and_the_film_comes_last() {
        let task = |flags: &str| format!("run my job.json -o out {flags} --threads 1 -q");
        let frames = |frames: &str| task(&format!("--frames {frames}"));
        assert_run(&plan(), &["1-10", "11-20", "21-25"].map(frames), "--film it's.mp4");
        let parts = Plan { tiles: 2, chunk: 20, film: None, ..plan() };
        let expected =
            ["1-20 --tile 1/2", "1-20 --tile 2/2", "21-25 --tile 1/2", "21-25 --tile 2/2"];
        assert_run(&parts, &expected.map(frames), "--join 2");
        let still = Plan { frames: None, ..parts };
        assert_run(&still, &["--tile 1/2", "--tile 2/2"].map(task), "--join 2");
    }

    /// Checks the tasks and the flags of the last step.
    fn assert_run(plan: &Plan, tasks: &[String], last: &str) {
        let folder = tempfile::tempdir().unwrap();
        let tool = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, format!("#!/bin/sh\n{text}")).unwrap();
            let status = Command::new("chmod").arg("+x").arg(&path).status();
            assert!(status.unwrap().success());
        };
        tool("pipeline", "echo \"$@\" >> log\n");
        tool(
            "sbatch",
            "cat > script\nfor flag; do case $flag in --array=*) last=${flag#--array=0-};; \
             --dependency=afterok:*) echo after ${flag#*:} >> log;; esac; done\n\
             for k in $(seq 0 ${last-0}); do SLURM_ARRAY_TASK_ID=$k sh script; done\necho 7\n",
        );
        let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
        let run = Command::new("sh")
            .args(["-c", &script(plan), "sh", "--partition=a"])
            .env("PATH", path)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let log = std::fs::read_to_string(folder.path().join("log")).unwrap();
        let lines: Vec<&str> = log.lines().collect();
        let count = tasks.len();
        assert_eq!(lines[..count], *tasks);
        assert_eq!(lines[count], "after 7");
        assert!(lines[count + 1].starts_with(&format!("run my job.json -o out {last} ")), "{log}");
        assert_eq!(lines.len(), count + 2);
    }

    #[test]
    fn a_large_array_has_a_remark() {
        let plan = Plan { frames: Some(5000), chunk: 1, ..plan() };
        assert!(script(&plan).contains("see MaxArraySize"));
        assert!(!script(&Plan { chunk: 5, ..plan }).contains("see MaxArraySize"));
    }
}
