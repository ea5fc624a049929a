//! Runs work that may panic, without output on standard error.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// True while panics of this thread are caught and not printed.
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Returns the result of `work`, or `None` if `work` panics. The message of such a panic is not
/// printed. The messages of other threads are printed as before.
///
/// `work` must leave no half-changed value that is used later.
pub(super) fn guarded<T>(work: impl FnOnce() -> T) -> Option<T> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !QUIET.get() {
                before(info);
            }
        }));
    });
    let outer = QUIET.replace(true);
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    QUIET.set(outer);
    result.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_nothing_and_the_next_work_is_done() {
        assert_eq!(guarded(|| -> u32 { panic!("this message is not printed") }), None);
        assert_eq!(guarded(|| 7), Some(7));
        assert!(!QUIET.get());
    }

    #[test]
    fn other_threads_are_not_silenced() {
        guarded(|| {
            assert!(QUIET.get());
            std::thread::scope(|scope| {
                scope.spawn(|| assert!(!QUIET.get())).join().unwrap();
            });
        })
        .unwrap();
    }
}
