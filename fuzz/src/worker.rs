//! The child process: tries inputs and measures them.

use crate::error::FuzzError;
use crate::protocol::{Answer, Reply, Request};
use crate::reader::{Bench, Reader};
use crate::verdict::{Fault, Kind, Stop, Verdict, wording_fault};
use crate::watch::{MOST_TIME, Watch};
use cpu_time::ProcessTime;
use std::io::{BufRead, Read, Write, stdin, stdout};
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::{Arc, Mutex, PoisonError};

/// Memory that a case may hold at once, in bytes.
const MOST_MEMORY: u64 = 2 << 30;

/// The message of the last panic.
type LastPanic = Arc<Mutex<Option<String>>>;

/// Answers the parent's requests until the parent sends no more.
///
/// # Errors
/// When there are no seeds, or the parent has ended.
pub fn run() -> Result<(), FuzzError> {
    // The budget of the program counts large values. The rest of the memory is for small values,
    // which the budget does not count.
    files::memory::allow(Some(MOST_MEMORY / 4 * 3));
    let bench = Bench::load()?;
    let last_panic = LastPanic::default();
    let message = Arc::clone(&last_panic);
    panic::set_hook(Box::new(move |info| {
        *message.lock().unwrap_or_else(PoisonError::into_inner) = Some(panic_message(info));
    }));
    let worker = Worker { bench, watch: Watch::start(), last_panic };
    let mut input = stdin().lock();
    let mut line = String::new();
    while input.read_line(&mut line)? > 0 {
        match Request::read(&line) {
            Some(Request::Cases { reader, seed, from, count }) => {
                for case in from..from.saturating_add(count) {
                    let bytes = worker.bench.input(reader, seed, case);
                    say(&Reply::At(case))?;
                    say(&Reply::Answer(worker.answer(reader, &bytes)))?;
                }
            }
            Some(Request::Input { reader, length }) => {
                let mut bytes = vec![0; length];
                input.read_exact(&mut bytes)?;
                say(&Reply::At(0))?;
                say(&Reply::Answer(worker.answer(reader, &bytes)))?;
            }
            None => return Err(FuzzError::Protocol(line)),
        }
        line.clear();
    }
    Ok(())
}

fn say(reply: &Reply) -> Result<(), FuzzError> {
    let mut out = stdout().lock();
    writeln!(out, "{reply}")?;
    Ok(out.flush()?)
}

struct Worker {
    bench: Bench,
    watch: Watch,
    last_panic: LastPanic,
}

impl Worker {
    /// Tries an input, and returns its verdict and its costs.
    fn answer(&self, reader: Reader, bytes: &[u8]) -> Answer {
        let before = crate::MEMORY.current_usage() as u64;
        crate::MEMORY.reset_peak_usage();
        self.watch.begin();
        let started = ProcessTime::now();
        let tried = panic::catch_unwind(AssertUnwindSafe(|| self.bench.read(reader, bytes)));
        let time = started.elapsed();
        self.watch.end();
        let memory = (crate::MEMORY.peak_usage() as u64).saturating_sub(before);
        let fault = |kind, text: &str| Verdict::Fault(Fault::new(kind, text));
        let verdict = match tried {
            Err(_) => {
                let last = self.last_panic.lock().unwrap_or_else(PoisonError::into_inner).take();
                fault(Kind::Panic, &last.unwrap_or_default())
            }
            Ok(Err(Stop::Broken(what))) => fault(Kind::Broken, &what),
            _ if memory > MOST_MEMORY => fault(Kind::Memory, &format!("{} MB", memory >> 20)),
            _ if time > MOST_TIME => fault(Kind::Slow, &format!("{:.1} s", time.as_secs_f64())),
            Ok(Err(Stop::Refused(message))) => match wording_fault(&message) {
                Some(what) => fault(Kind::Message, &format!("found {what} in: {message}")),
                None => Verdict::Refused(message),
            },
            Ok(Ok(())) => Verdict::Accepted,
        };
        Answer { verdict, time, memory }
    }
}

/// Returns the position and the message of a panic, in one line.
fn panic_message(info: &PanicHookInfo<'_>) -> String {
    let place = info.location().map_or_else(String::new, |place| {
        // Only the last names of a path into another crate.
        let names: Vec<&str> = place.file().rsplit('/').take(3).collect();
        let names: Vec<&str> = names.into_iter().rev().collect();
        format!("{}:{}", names.join("/"), place.line())
    });
    let payload = info.payload();
    let text = payload.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("no message");
    format!("{place}: {text}")
}
