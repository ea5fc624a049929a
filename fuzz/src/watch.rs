//! Ends the process when a case takes too long.

use crate::protocol::{Answer, Reply};
use crate::verdict::{Fault, Kind, Verdict};
use cpu_time::ProcessTime;
use files::exit::say;
use std::io::{Write, stdout};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Most processor time of a case.
pub const MOST_TIME: Duration = Duration::from_secs(10);

/// Most wall-clock time of a case. A case that exceeds it waits for an event that does not come.
const MOST_WAIT: Duration = Duration::from_secs(120);

/// Time between two checks.
const STEP: Duration = Duration::from_millis(50);

/// The current case, watched by a thread of its own.
#[derive(Debug, Clone, Default)]
pub struct Watch(Arc<Mutex<Option<Since>>>);

#[derive(Debug, Clone, Copy)]
struct Since {
    time: ProcessTime,
    clock: Instant,
}

impl Watch {
    /// Starts a watch.
    #[must_use]
    pub fn start() -> Self {
        let watch = Self::default();
        let seen = watch.clone();
        thread::spawn(move || {
            loop {
                thread::sleep(STEP);
                seen.look();
            }
        });
        watch
    }

    /// Records that a case begins.
    pub fn begin(&self) {
        self.set(Some(Since { time: ProcessTime::now(), clock: Instant::now() }));
    }

    /// Records that the case is done.
    pub fn end(&self) {
        self.set(None);
    }

    fn set(&self, since: Option<Since>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = since;
    }

    /// Ends the process, with an answer for the parent, when the current case takes too long.
    fn look(&self) {
        let since = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(Since { time, clock }) = *since else { return };
        let (time, waited) = (time.elapsed(), clock.elapsed());
        let (kind, text) = match (time > MOST_TIME, waited > MOST_WAIT) {
            (true, _) => (Kind::Slow, format!("{:.1} s of processor time", time.as_secs_f64())),
            (_, true) => (Kind::Stalled, format!("no answer for {:.0} s", waited.as_secs_f64())),
            _ => return,
        };
        let verdict = Verdict::Fault(Fault::new(kind, &text));
        let memory = crate::MEMORY.peak_usage() as u64;
        let answer = Reply::Answer(Answer { verdict, time, memory });
        if writeln!(stdout(), "{answer}").and_then(|()| stdout().flush()).is_err() {
            say("fuzz: the parent has gone");
        }
        std::process::exit(0);
    }
}
