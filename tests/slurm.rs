//! The script for Slurm on a real cluster of two nodes, with faults. Where there can be no cluster, the tests say so.
#![cfg(target_os = "linux")]

use crate::support::animated::{files, folder, make};
use crate::support::slurm::{Cluster, NODES};
use crate::support::{programs, run, said};
use std::fs;
use std::path::Path;

/// A program `pipeline` that notes the node, the task and the count of its restarts in the file `ran`, and its own process
/// and both above it in `held.NODE`. It goes on when there is a file `go`, so that faults meet running tasks.
const HELD: &str = "#!/bin/sh
echo \"$SLURMD_NODENAME ${SLURM_ARRAY_TASK_ID:-film} ${SLURM_RESTART_COUNT:-0}\" >> ran
echo $$ $PPID $(cut -d' ' -f4 /proc/$PPID/stat) > new.$$ && mv new.$$ held.$SLURMD_NODENAME
while [ ! -e go ]; do sleep 0.05; done
exec PROGRAM \"$@\"
";

/// Writes the script of the job, with a task for each frame.
fn script(folder: &Path, output: &str) {
    let flags = ["--engine", "slurm", "--size", "24x18", "--script", "tasks.sh", "-o", output];
    let film = format!("{output}.gif");
    let arguments = [&["farm", "jobs/job.json", "--film", &film], &flags[..]].concat();
    let ran = run("pipeline", &arguments, folder);
    assert!(ran.status.success(), "{}", said(&ran));
}

/// Returns the lines of the file `ran` about array tasks, as words.
fn tasks(folder: &Path) -> Vec<[String; 3]> {
    let text = fs::read_to_string(folder.join("ran")).unwrap();
    let words = text.lines().map(|line| {
        let mut words = line.split(' ').map(String::from);
        [(); 3].map(|()| words.next().unwrap())
    });
    words.filter(|[_, task, _]| task != "film").collect()
}

/// All frames are complete and those of one machine, after each of these faults in turn:
/// a node dies while it runs a task; the other node is drained; a task runs twice at once; the disk is full.
#[test]
fn frames_survive_the_faults_of_a_cluster() {
    let mut cluster = match Cluster::start() {
        Ok(cluster) => cluster,
        Err(reason) => {
            println!("skipped: {reason}");
            return;
        }
    };
    let folder = folder(r#""turntable": { "frames": 6 }"#);
    let path = folder.path();
    let held = path.join("bin");
    fs::create_dir(&held).unwrap();
    let program = programs().join("pipeline");
    fs::write(held.join("pipeline"), HELD.replace("PROGRAM", &program.display().to_string()))
        .unwrap();
    make(path, &["-o", "alone", "--film", "alone.gif", "-q"]);
    assert!(cluster.shell("chmod +x bin/pipeline", path, &held).status.success());
    let submit = |cluster: &Cluster, line: &str| {
        let ran = cluster.shell(line, path, &held);
        assert!(ran.status.success(), "{}", said(&ran));
    };
    let both_hold = |cluster: &Cluster| {
        cluster.until("both nodes run a task", |_| {
            NODES.iter().all(|node| path.join(format!("held.{node}")).exists())
        });
    };

    script(path, "out");
    submit(&cluster, "sh tasks.sh");
    both_hold(&cluster);
    // The first node dies with its task. The second is drained: it ends its task and gets no other.
    cluster.kill_node("n1");
    submit(&cluster, "kill -9 $(cat held.n1)");
    cluster.set("n1", "down");
    cluster.set("n2", "drain");
    fs::write(path.join("go"), "").unwrap();
    cluster.until("n2 is drained", |own| own.state("n2") == "drain");
    cluster.start_node("n1");
    cluster.until("n1 is back", |own| {
        own.set("n1", "resume");
        own.state("n1") != "down"
    });
    cluster.finish();
    let ran = tasks(path);
    let on = |node: &str| ran.iter().filter(|[on, ..]| on == node).count();
    assert_eq!((on("n1"), on("n2")), (6, 1), "one task ran twice: {ran:?}");
    assert_eq!(ran.iter().filter(|[.., restarts]| restarts == "1").count(), 1, "{ran:?}");
    assert!(files(&path.join("out")) == files(&path.join("alone")));
    assert!(fs::read(path.join("out.gif")).unwrap() == fs::read(path.join("alone.gif")).unwrap());

    // Two tasks make the same frames at once, each on its node.
    cluster.set("n2", "resume");
    cluster.until("n2 is back", |own| own.state("n2") == "idle");
    for name in ["go", "held.n1", "held.n2"] {
        fs::remove_file(path.join(name)).unwrap();
    }
    let line = "pipeline run jobs/job.json --size 24x18 -o both -q --threads 1";
    submit(&cluster, &format!("sbatch --array=0-1 --output=twice-%a.log --wrap '{line}'"));
    both_hold(&cluster);
    fs::write(path.join("go"), "").unwrap();
    cluster.finish();
    assert!(files(&path.join("both")) == files(&path.join("alone")));

    if !full_disk(&cluster, path, &held) {
        println!("skipped: no small disk can be mounted");
    }
}

/// A disk that is full stops the tasks, which Slurm tries again; once there is space, they succeed. Returns false where no
/// disk can be made.
fn full_disk(cluster: &Cluster, path: &Path, held: &Path) -> bool {
    let mounted = "mkdir full && mount -t tmpfs -o size=64k tmpfs full && head -c 65536 /dev/zero > full/filler";
    if !cluster.shell(mounted, path, held).status.success() {
        return false;
    }
    let disk = Mounted { cluster, path };
    fs::remove_file(path.join("ran")).unwrap();
    script(path, "full");
    assert!(cluster.shell("sh tasks.sh", path, held).status.success());
    cluster.until("all tasks wait for another try", |own| {
        own.ask("squeue -h -r -t PD -o %r").matches("BeginTime").count() == 6
    });
    let log = fs::read_to_string(path.join("job-0.log")).unwrap();
    assert!(log.contains("cannot write full/job-exact.0001.png: No space left on device"), "{log}");
    assert_eq!(files(&path.join("full")).len(), 1, "no part of a frame is left");
    fs::remove_file(path.join("full/filler")).unwrap();
    cluster.finish();
    assert!(files(&path.join("full")) == files(&path.join("alone")));
    assert!(fs::read(path.join("full.gif")).unwrap() == fs::read(path.join("alone.gif")).unwrap());
    let restarts: Vec<String> = tasks(path).into_iter().map(|[.., restarts]| restarts).collect();
    let count = |number: &str| restarts.iter().filter(|own| *own == number).count();
    assert_eq!((count("0"), count("1"), restarts.len()), (6, 6, 12), "{restarts:?}");
    drop(disk);
    true
}

/// The small disk, which is unmounted with this value.
struct Mounted<'a> {
    cluster: &'a Cluster,
    path: &'a Path,
}

impl Drop for Mounted<'_> {
    fn drop(&mut self) {
        self.cluster.shell("umount -l full", self.path, self.path);
    }
}
