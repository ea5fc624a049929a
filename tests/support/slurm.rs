//! A Slurm cluster of two nodes on this machine, for tests of scripts for Slurm.
//!
//! The daemons `munged`, `slurmctld` and two of `slurmd` run in the foreground as children of the test, with their own key, ports
//! and folders. Nodes are `n1` and `n2`, with one processor each. Only root can start them.

use super::path_with_programs;
use std::fs;
use std::io::Read;
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// The programs of the cluster, in the packages `slurm-wlm` and `munge` of Debian.
const PROGRAMS: [&str; 6] = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol"];

/// The nodes.
pub const NODES: [&str; 2] = ["n1", "n2"];

/// Longest wait for an event. An event takes a few seconds at most.
const PATIENCE: Duration = Duration::from_secs(90);

/// A cluster, which ends with this value.
pub struct Cluster {
    folder: tempfile::TempDir,
    /// The daemons by their names.
    daemons: Vec<(String, Child)>,
}

impl Cluster {
    /// Starts a cluster and waits until both nodes are idle.
    ///
    /// # Errors
    /// With the reason why there can be no cluster here.
    pub fn start() -> Result<Self, String> {
        let has = |line: &str| {
            Command::new("sh").args(["-c", line]).output().is_ok_and(|ran| ran.status.success())
        };
        if !has("test $(id -u) = 0") {
            return Err("only root can start a cluster".into());
        }
        for program in PROGRAMS {
            if !has(&format!("command -v {program}")) {
                return Err(format!("{program} is not installed"));
            }
        }
        let folder = tempfile::tempdir().expect("there is a temporary folder");
        let mut cluster = Self { folder, daemons: Vec::new() };
        cluster.configure();
        let own = cluster.folder.path().display().to_string();
        let key = format!("--key-file={own}/key --socket={own}/munge/socket");
        let files = format!(
            "--pid-file={own}/munge/pid --log-file={own}/munge/log --seed-file={own}/munge/seed"
        );
        cluster.spawn("munged", &format!("munged --foreground --force {key} {files}"));
        cluster.until("munge answers", |own| own.path("munge/socket").exists());
        cluster.spawn("slurmctld", "slurmctld -D");
        for node in NODES {
            cluster.start_node(node);
        }
        cluster
            .until("both nodes are idle", |own| NODES.iter().all(|node| own.state(node) == "idle"));
        Ok(cluster)
    }

    /// Writes key and configuration.
    fn configure(&self) {
        let own = self.folder.path().display();
        for name in ["munge", "state", "spool-n1", "spool-n2"] {
            fs::create_dir(self.path(name)).unwrap();
        }
        // Whoever has the key is root on the cluster.
        let mut key = [0; 1024];
        fs::File::open("/dev/urandom").unwrap().read_exact(&mut key).unwrap();
        fs::write(self.path("key"), key).unwrap();
        fs::set_permissions(self.path("key"), fs::Permissions::from_mode(0o600)).unwrap();
        let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap();
        let host = host.trim();
        // Ports that are free now. They are all open at once, so that they differ.
        let open = [(); 3].map(|()| TcpListener::bind(("127.0.0.1", 0)).unwrap());
        let [control, first, second] = open.map(|open| open.local_addr().unwrap().port());
        let text = format!(
            "ClusterName=test\nSlurmctldHost={host}(127.0.0.1)\nSlurmctldPort={control}\n\
             AuthType=auth/munge\nAuthInfo=socket={own}/munge/socket\nSlurmUser=root\nSlurmdUser=root\n\
             SlurmctldPidFile={own}/slurmctld.pid\nSlurmctldLogFile={own}/slurmctld.log\n\
             SlurmdPidFile={own}/%n.pid\nSlurmdLogFile={own}/%n.log\nSlurmdSpoolDir={own}/spool-%n\n\
             StateSaveLocation={own}/state\nProctrackType=proctrack/pgid\n\
             SelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\nSchedulerType=sched/backfill\n\
             SchedulerParameters=sched_interval=1,bf_interval=1,sched_min_interval=0\n\
             ReturnToService=2\nSlurmdTimeout=10\nKillWait=2\n\
             NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={first} CPUs=1\n\
             NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={second} CPUs=1\n\
             PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP\n"
        );
        fs::write(self.path("slurm.conf"), text).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Starts a daemon.
    fn spawn(&mut self, name: &str, line: &str) {
        let log = fs::File::create(self.path(&format!("{name}.out"))).unwrap();
        let child = Command::new("sh")
            .args(["-c", &format!("exec {line}")])
            .env("SLURM_CONF", self.path("slurm.conf"))
            .env("PATH", path_with_programs())
            .stdin(Stdio::null())
            .stdout(log.try_clone().unwrap())
            .stderr(log)
            .spawn()
            .expect("the shell starts");
        self.daemons.push((name.into(), child));
    }

    /// Starts the daemon of a node.
    pub fn start_node(&mut self, node: &str) {
        self.spawn(node, &format!("slurmd -D -N {node}"));
    }

    /// Kills the daemon of a node at once.
    pub fn kill_node(&mut self, node: &str) {
        let (of_node, others) = self.daemons.drain(..).partition(|(name, _)| name == node);
        self.daemons = others;
        for (_, mut child) in of_node as Vec<(String, Child)> {
            child.kill().unwrap();
            child.wait().unwrap();
        }
    }

    /// Runs a line of the shell as a user of the cluster, with `programs` in front of the path.
    pub fn shell(&self, line: &str, folder: &Path, programs: &Path) -> Output {
        let path = format!("{}:{}", programs.display(), path_with_programs().to_string_lossy());
        Command::new("sh")
            .args(["-c", line])
            .env("SLURM_CONF", self.path("slurm.conf"))
            .env("PATH", path)
            .current_dir(folder)
            .output()
            .expect("the shell starts")
    }

    /// Runs a command of the cluster and returns what it prints.
    pub fn ask(&self, line: &str) -> String {
        let ran = self.shell(line, self.folder.path(), self.folder.path());
        String::from_utf8_lossy(&ran.stdout).trim().into()
    }

    /// Returns the state of a node, such as `idle`, `drain` or `down`.
    pub fn state(&self, node: &str) -> String {
        self.ask(&format!("sinfo -h -n {node} -o %t"))
    }

    /// Sets the state of a node.
    pub fn set(&self, node: &str, state: &str) {
        self.ask(&format!("scontrol update nodename={node} state={state} reason=test"));
    }

    /// Lets tasks begin that wait for a time. Slurm begins a task that has lost its node two minutes later.
    pub fn begin_now(&self) {
        let waiting = self.ask("squeue -h -t PD -o '%A %r'");
        for line in waiting.lines().filter(|line| line.contains("BeginTime")) {
            let job = line.split(' ').next().unwrap_or_default();
            self.ask(&format!("scontrol update jobid={job} starttime=now"));
        }
    }

    /// Waits until no job is left.
    pub fn finish(&self) {
        self.until("all jobs have ended", |own| {
            own.begin_now();
            own.ask("squeue -h").is_empty()
        });
    }

    /// Waits for an event.
    ///
    /// # Panics
    /// If it does not happen.
    pub fn until(&self, event: &str, happens: impl Fn(&Self) -> bool) {
        let started = Instant::now();
        while !happens(self) {
            if started.elapsed() > PATIENCE {
                let logs = self.ask("squeue; sinfo -N; tail -n 20 *.log *.out");
                panic!("waited in vain until {event}:\n{logs}");
            }
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        self.ask("scancel --user=root");
        // Tasks that a failed test has left end before their nodes.
        let started = Instant::now();
        while !self.ask("squeue -h").is_empty() && started.elapsed() < Duration::from_secs(10) {
            std::thread::sleep(Duration::from_millis(50));
        }
        // Nodes end before the daemons that they ask.
        for (_, child) in self.daemons.iter_mut().rev() {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}
