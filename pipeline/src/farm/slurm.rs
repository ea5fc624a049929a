//! A shell script that submits an array job to Slurm, and the film as a job that depends on it.

use super::{MOST_TASKS, Plan, quoted};

/// Most restarts of a task whose exit code says that a retry can help.
const RETRIES: u32 = 3;

/// Returns the script.
pub(super) fn script(plan: &Plan) -> String {
    let tasks = plan.frames.div_ceil(plan.chunk);
    let Plan { frames, chunk, .. } = plan;
    let (name, line) = (quoted(&plan.name), plan.line());
    let many = if tasks > MOST_TASKS {
        format!(
            "# Slurm takes {MOST_TASKS} tasks of an array unless the cluster allows more: see MaxArraySize, or choose a larger --chunk.\n"
        )
    } else {
        String::new()
    };
    let film = plan.last_line().map(|last| {
        format!(
            "film=$(sbatch --parsable --job-name={name}-film --output={name}-film.log \\\n  \
             --dependency=afterok:\"$frames\" --kill-on-invalid-dep=yes \"$@\" <<'FILM'\n\
             #!/bin/sh\nexec {last} --threads \"${{SLURM_CPUS_ON_NODE:-1}}\" -q\nFILM\n)\n\
             echo \"film: job $film, after the frames\"\n"
        )
    });
    format!(
        "#!/bin/sh\n{title}.\n\
         # Submit it in the folder of the job: sh THIS [flags of sbatch, such as --partition=short --cpus-per-task=4]\n\
         {many}set -eu\n\
         frames=$(sbatch --parsable --job-name={name} --output={name}-%a.log --open-mode=append \\\n  \
         --array=0-{last_task} --requeue \"$@\" <<'TASK'\n\
         #!/bin/sh\n\
         first=$((SLURM_ARRAY_TASK_ID * {chunk} + 1))\n\
         last=$((first + {chunk} - 1))\n\
         [ \"$last\" -le {frames} ] || last={frames}\n\
         code=0\n\
         {line} --frames \"$first-$last\" --threads \"${{SLURM_CPUS_PER_TASK:-1}}\" -q || code=$?\n\
         case $code in\n  \
         5|6) # A file, memory or threads: another try may help.\n    \
         if [ \"${{SLURM_RESTART_COUNT:-0}}\" -lt {RETRIES} ]; then\n      \
         scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\" && sleep 60\n    \
         fi;;\n\
         esac\n\
         exit \"$code\"\n\
         TASK\n)\n\
         echo \"frames: job $frames, {tasks} tasks\"\n{film}",
        title = plan.title(),
        last_task = tasks - 1,
        film = film.unwrap_or_default(),
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
            .args(["-c", &script(&plan()), "sh", "--partition=a"])
            .env("PATH", path)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let log = std::fs::read_to_string(folder.path().join("log")).unwrap();
        let lines: Vec<&str> = log.lines().collect();
        let task =
            |frames: &str| format!("run my job.json -o out --frames {frames} --threads 1 -q");
        assert_eq!(lines[..3], ["1-10", "11-20", "21-25"].map(task));
        assert_eq!(lines[3], "after 7");
        assert!(lines[4].starts_with("run my job.json -o out --film it's.mp4"), "{log}");
        assert_eq!(lines.len(), 5);
    }

    #[test]
    fn a_large_array_has_a_remark() {
        let plan = Plan { frames: 5000, chunk: 1, ..plan() };
        assert!(script(&plan).contains("see MaxArraySize"));
        assert!(!script(&Plan { chunk: 5, ..plan }).contains("see MaxArraySize"));
    }
}
