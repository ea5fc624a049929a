//! Work that may panic, without a word on standard error.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether panics of this thread are caught and not to be told.
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// What `work` returns; nothing where it panics. The message of such a panic is not printed, while
/// those of other threads are, as before.
///
/// `work` must leave nothing half done behind that is looked at later.
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
