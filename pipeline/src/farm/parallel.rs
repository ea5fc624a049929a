//! A shell script for GNU parallel.

use super::{Plan, quoted};

/// Returns the script.
pub(super) fn script(plan: &Plan) -> String {
    let name = quoted(&format!("{}.joblog", plan.name));
    let hosts: Vec<String> =
        plan.hosts.iter().map(|host| format!("--sshlogin {} ", quoted(host))).collect();
    // Hosts see the same folder by a shared file system.
    let hosts =
        if hosts.is_empty() { String::new() } else { format!("{}--workdir . ", hosts.concat()) };
    let film = plan.last().map(|(_, last)| format!("{last} -q\n")).unwrap_or_default();
    let tasks: Vec<String> =
        plan.tasks().into_iter().map(|(frames, tile)| format!("{frames} {tile}")).collect();
    // parallel reads the command as a shell would, once more.
    let line = plan.line();
    format!(
        "#!/bin/sh\n{title}.\n\
         # Run it in the folder of the job: sh THIS [flags of parallel, such as --jobs 4]\n\
         # Run it again after a stop: tasks that ended well are left out.\n\
         set -eu\n\
         parallel --joblog {name} --resume --resume-failed --retries 3 --colsep ' ' {hosts}\"$@\" \\\n  \
         {command} <<'TASKS'\n{tasks}\nTASKS\n{film}",
        title = plan.title(),
        command = quoted(&format!("{line} {} --threads 1 -q", plan.flags("{1}", "{2}"))),
        tasks = tasks.join("\n"),
    )
}

#[cfg(test)]
mod tests {
    use super::super::tests::plan;
    use super::*;

    #[test]
    fn the_command_and_its_frames_are_there() {
        let text = script(&plan());
        let command = "'pipeline run '\\''my job.json'\\'' -o out --frames {1} --threads 1 -q'";
        assert!(text.contains(command), "{text}");
        assert!(
            text.contains("--joblog knot.joblog --resume ")
                && text.contains("\n11-20 1\n21-25 1\nTASKS\n")
        );
        assert!(!text.contains("--sshlogin"));
        let hosts = Plan { hosts: vec!["4/node1".into(), "a b".into()], ..plan() };
        let parts = script(&Plan { tiles: 2, ..plan() });
        assert!(
            parts.contains("--frames {1} --tile {2}/2 ") && parts.contains("\n11-20 1\n11-20 2\n")
        );
        assert!(script(&hosts).contains("--sshlogin 4/node1 --sshlogin 'a b' --workdir . "));
    }
}
