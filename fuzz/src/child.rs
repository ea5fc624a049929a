//! The parent's connection to one child process.

use crate::error::FuzzError;
use crate::protocol::{Answer, Reply, Request};
use crate::reader::Reader;
use crate::verdict::{Fault, Kind, Verdict};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// Address space of a child, in kilobytes. A request for more ends the child. The value is twice
/// what a case may hold, so that the program can refuse the memory with a message first.
const ADDRESS_SPACE: u32 = 4 << 20;

/// Number of characters kept of a child's output on standard error.
const KEPT: usize = 4000;

/// A child process, which starts at the first request.
#[derive(Debug, Default)]
pub struct Child(Option<Running>);

#[derive(Debug)]
struct Running {
    process: std::process::Child,
    stdin: ChildStdin,
    stdout: BufReader<ChildStdout>,
    last_words: Arc<Mutex<String>>,
}

impl Child {
    /// Tries a run of cases, and reports each answer.
    ///
    /// A case that ends the child is answered with a fault. Another child tries the next case.
    ///
    /// # Errors
    /// When no child can be started.
    pub fn cases(
        &mut self,
        reader: Reader,
        seed: u64,
        from: u64,
        count: u64,
        tell: &mut dyn FnMut(u64, Answer),
    ) -> Result<(), FuzzError> {
        let (mut next, end) = (from, from + count);
        while next < end {
            let running = self.running()?;
            let request = Request::Cases { reader, seed, from: next, count: end - next };
            running.ask(&request, &[])?;
            while next < end {
                let (answer, alive) = running.answer()?;
                tell(next, answer);
                next += 1;
                if !alive {
                    self.0 = None;
                    break;
                }
            }
        }
        Ok(())
    }

    /// Tries one input.
    ///
    /// # Errors
    /// When no child can be started.
    pub fn input(&mut self, reader: Reader, bytes: &[u8]) -> Result<Answer, FuzzError> {
        let running = self.running()?;
        running.ask(&Request::Input { reader, length: bytes.len() }, bytes)?;
        let (answer, alive) = running.answer()?;
        if !alive {
            self.0 = None;
        }
        Ok(answer)
    }

    /// Starts the process, if none is running.
    ///
    /// # Errors
    /// When the process cannot be started.
    pub fn start(&mut self) -> Result<(), FuzzError> {
        self.running().map(|_| ())
    }

    fn running(&mut self) -> Result<&mut Running, FuzzError> {
        Ok(match self.0.take() {
            Some(running) => self.0.insert(running),
            None => self.0.insert(Running::start()?),
        })
    }
}

impl Running {
    fn start() -> Result<Self, FuzzError> {
        let program = std::env::current_exe()?;
        let mut command = if cfg!(unix) {
            let mut shell = Command::new("sh");
            let limits = "ulimit -c 0; ulimit -v \"$0\"; exec \"$@\"";
            shell.args(["-c", limits, &ADDRESS_SPACE.to_string()]).arg(program);
            shell
        } else {
            Command::new(program)
        };
        // One thread for each child: there are as many children as cores, and memory stays small.
        let mut process = command
            .arg("--worker")
            .env("RAYON_NUM_THREADS", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        let (Some(stdin), Some(stdout), Some(mut stderr)) =
            (process.stdin.take(), process.stdout.take(), process.stderr.take())
        else {
            return Err(FuzzError::Protocol("a child without pipes".into()));
        };
        let last_words = Arc::new(Mutex::new(String::new()));
        let heard = Arc::clone(&last_words);
        thread::spawn(move || {
            let mut piece = [0; 1024];
            while let Ok(length @ 1..) = stderr.read(&mut piece) {
                let mut words = heard.lock().unwrap_or_else(PoisonError::into_inner);
                if words.len() < KEPT {
                    words.push_str(&String::from_utf8_lossy(&piece[..length]));
                }
            }
        });
        Ok(Self { process, stdin, stdout: BufReader::new(stdout), last_words })
    }

    fn ask(&mut self, request: &Request, bytes: &[u8]) -> Result<(), FuzzError> {
        writeln!(self.stdin, "{request}")?;
        self.stdin.write_all(bytes)?;
        Ok(self.stdin.flush()?)
    }

    /// Returns the answer to the next case, and whether the child continues.
    fn answer(&mut self) -> Result<(Answer, bool), FuzzError> {
        let mut begun = false;
        loop {
            let mut line = String::new();
            if self.stdout.read_line(&mut line)? == 0 {
                let status = self.process.wait()?;
                let words = self.last_words.lock().unwrap_or_else(PoisonError::into_inner).clone();
                if !begun {
                    return Err(FuzzError::Worker(format!("{} {words}", ended(status))));
                }
                return Ok((death(status, &words), false));
            }
            match Reply::read(&line) {
                Some(Reply::At(_)) => begun = true,
                Some(Reply::Answer(answer)) => {
                    let ends = matches!(&answer.verdict, Verdict::Fault(fault)
                        if matches!(fault.kind, Kind::Slow | Kind::Stalled));
                    return Ok((answer, !ends));
                }
                None => return Err(FuzzError::Protocol(line)),
            }
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // The process may have ended already; then there is no process to kill.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn death(status: ExitStatus, words: &str) -> Answer {
    let words = words.trim().lines().filter(|line| !line.is_empty());
    let words = words.collect::<Vec<_>>().join("; ");
    let fault = Fault::new(Kind::Died, &format!("{}: {words}", ended(status)));
    Answer { verdict: Verdict::Fault(fault), time: Duration::ZERO, memory: 0 }
}

fn ended(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return format!("ended by signal {signal}");
    }
    format!("ended with {status}")
}
