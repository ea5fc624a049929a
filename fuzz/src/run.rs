//! Runs all children, until the cases or the seconds are used up.

use crate::child::Child;
use crate::error::FuzzError;
use crate::minimize;
use crate::mutate::grid;
use crate::protocol::Answer;
use crate::reader::Reader;
use crate::schedule::{Schedule, Until};
use crate::seeds::png;
use crate::tally::Tally;
use crate::verdict::Verdict;
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Instant;

/// Tries cases with `jobs` children at a time.
///
/// # Errors
/// When a child cannot be started.
pub fn run(readers: &[Reader], seed: u64, until: Until, jobs: usize) -> Result<Tally, FuzzError> {
    let schedule = Mutex::new(Schedule::new(readers, until));
    let tally = Mutex::new(Tally::default());
    let work = || -> Result<(), FuzzError> {
        let mut child = Child::default();
        loop {
            let next = schedule.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some(run) = next else { return Ok(()) };
            child.start()?;
            let started = Instant::now();
            let mut answers: Vec<(u64, Answer)> = Vec::new();
            let tell = &mut |case, answer| answers.push((case, answer));
            child.cases(run.reader, seed, run.from, run.count, tell)?;
            let mut tally = tally.lock().unwrap_or_else(PoisonError::into_inner);
            answers.iter().for_each(|(case, answer)| tally.add(run.reader, *case, answer));
            drop(tally);
            let mut schedule = schedule.lock().unwrap_or_else(PoisonError::into_inner);
            schedule.took(run, started.elapsed());
        }
    };
    thread::scope(|scope| {
        let threads: Vec<_> = (0..jobs).map(|_| scope.spawn(work)).collect();
        let results = threads.into_iter().map(|thread| {
            thread.join().unwrap_or_else(|_| Err(FuzzError::Worker("a thread panicked".into())))
        });
        // All children are awaited, and the first failure is returned.
        results.collect::<Vec<_>>().into_iter().collect::<Result<(), _>>()
    })?;
    Ok(tally.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Returns a small input that shows the same fault as `input`.
///
/// # Errors
/// When no child can be started.
pub fn minimized(reader: Reader, input: &[u8], signature: &str) -> Result<Vec<u8>, FuzzError> {
    let mut child = Child::default();
    let mut failed = None;
    let kept = minimize::minimized(input, &mut |bytes| match child
        .input(reader, &mended(reader, bytes))
    {
        Ok(answer) => matches!(answer.verdict, Verdict::Fault(fault)
            if fault.signature() == signature),
        Err(error) => {
            failed = Some(error);
            false
        }
    });
    failed.map_or_else(|| Ok(mended(reader, &kept)), Err)
}

/// Returns the input with correct checksums, if its format has checksums and the input can be split
/// into its parts.
fn mended(reader: Reader, bytes: &[u8]) -> Vec<u8> {
    let file = match reader {
        Reader::Grid | Reader::GridText => grid::file(&grid::patches(bytes)),
        Reader::Png | Reader::Depth => png::file(&png::chunks(bytes)),
        Reader::Spec
        | Reader::Svg
        | Reader::Areas
        | Reader::Obj
        | Reader::Stl
        | Reader::Ply
        | Reader::Glb
        | Reader::Gltf
        | Reader::Mtl
        | Reader::Scene
        | Reader::Part
        | Reader::Job
        | Reader::Jpeg
        | Reader::Exr
        | Reader::Words
        | Reader::Trap => return bytes.to_vec(),
    };
    // Another length means that the input could not be split into its parts. Such an input stays
    // unchanged.
    if file.len() == bytes.len() { file } else { bytes.to_vec() }
}
