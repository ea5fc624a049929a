//! The program behind `pipeline report`. The program is `pipeline` with an allocator that counts
//! the memory held, so that no other command pays for the count.

use peak_alloc::PeakAlloc;
use pipeline::report::measure::Memory;
use std::process::ExitCode;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// The memory that the process holds on its heap.
struct Heap;

impl Memory for Heap {
    fn mark(&self) -> usize {
        HEAP.reset_peak_usage();
        HEAP.current_usage()
    }

    fn peak(&self) -> usize {
        HEAP.peak_usage()
    }
}

fn main() -> ExitCode {
    pipeline::cli::main(Some(&Heap))
}
