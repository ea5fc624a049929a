//! Reserves memory in a budget before the memory is allocated.
//!
//! A [`Budget`] counts the bytes that a program may hold. Code that will allocate much computes the
//! number of bytes from sizes alone and calls [`Budget::reserve`]. A refused request allocates
//! nothing, and the refusal names its purpose. The bytes count as taken until the [`Reserved`] is
//! dropped.
//!
//! A budget counts reservations, not what the allocator does: small values are not counted. The
//! default leaves a tenth of the free memory for small values.

mod machine;

use crate::{Exit, Failure};
use std::fmt;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use thiserror::Error;

/// The budget of this process. The memory of a process has one limit, so the process has one
/// budget.
static PROCESS: OnceLock<Budget> = OnceLock::new();

/// Returns the budget of this process: that of [`allow`], or 90 % of the memory that was free at
/// the first call.
#[must_use]
pub fn of_process() -> &'static Budget {
    PROCESS.get_or_init(|| Budget::new(machine::free().unwrap_or(UNKNOWN) / 10 * 9))
}

/// Lets this process take at most `limit` bytes, and no more than 90 % of what is left of a limited
/// address space (`ulimit -v`). Without a limit, the budget is 90 % of the free memory. Programs
/// call this function once, before they read a file; only the first call counts.
pub fn allow(limit: Option<u64>) {
    if let Some(limit) = limit {
        let limit = machine::address_space().map_or(limit, |space| limit.min(space / 10 * 9));
        PROCESS.get_or_init(|| Budget::new(limit));
    }
}

/// Free memory in bytes on a system that does not report it: half of a common machine.
const UNKNOWN: u64 = 8 << 30;

/// A number of bytes that may be held, and the number that is held now.
#[derive(Debug)]
pub struct Budget {
    limit: u64,
    taken: AtomicU64,
}

/// Bytes that count as taken until this value is dropped.
#[derive(Debug)]
#[must_use = "the bytes are given back when this is dropped"]
pub struct Reserved<'a> {
    budget: &'a Budget,
    bytes: u64,
}

/// A request for more memory than is allowed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{what} needs {}, {}", Bytes(*needed), Remedy(self))]
pub struct MemoryError {
    /// The purpose of the memory, such as `a picture of 640x480 pixels`.
    pub what: String,
    /// Bytes that the purpose needs.
    pub needed: u64,
    /// Bytes that are taken for other purposes.
    pub taken: u64,
    /// Bytes that are allowed in all.
    pub limit: u64,
    /// True if the bytes are within the limit, but the system does not provide them.
    pub refused_by_system: bool,
}

impl Failure for MemoryError {
    fn exit(&self) -> Exit {
        Exit::Resource
    }
}

impl Budget {
    /// Makes a budget of `limit` bytes, none of them taken.
    #[must_use]
    pub const fn new(limit: u64) -> Self {
        Self { limit, taken: AtomicU64::new(0) }
    }

    /// Returns the number of bytes that are allowed in all.
    #[must_use]
    pub fn limit(&self) -> u64 {
        self.limit
    }

    /// Returns the number of bytes that are not taken.
    #[must_use]
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.taken.load(Ordering::Relaxed))
    }

    /// Takes `bytes` for a purpose. The words of `what` begin the message of a refusal.
    ///
    /// # Errors
    /// When fewer bytes are left.
    pub fn reserve(
        &self,
        bytes: u64,
        what: impl FnOnce() -> String,
    ) -> Result<Reserved<'_>, MemoryError> {
        let more = |taken: u64| taken.checked_add(bytes).filter(|&sum| sum <= self.limit);
        match self.taken.fetch_update(Ordering::Relaxed, Ordering::Relaxed, more) {
            Ok(_) if given(bytes) => Ok(Reserved { budget: self, bytes }),
            Ok(taken) => {
                drop(Reserved { budget: self, bytes });
                Err(self.error(bytes, taken, what(), true))
            }
            Err(taken) => Err(self.error(bytes, taken, what(), false)),
        }
    }

    fn error(&self, needed: u64, taken: u64, what: String, refused_by_system: bool) -> MemoryError {
        MemoryError { what, needed, taken, limit: self.limit, refused_by_system }
    }

    /// Returns bytes of [`Reserved::into_bytes`] to the budget.
    pub fn give_back(&self, bytes: u64) {
        drop(Reserved { budget: self, bytes });
    }

    /// Checks that `bytes` could be reserved now.
    ///
    /// # Errors
    /// See [`Budget::reserve`].
    pub fn check(&self, bytes: u64, what: impl FnOnce() -> String) -> Result<(), MemoryError> {
        self.reserve(bytes, what).map(drop)
    }
}

impl Reserved<'_> {
    /// Returns the number of bytes that are taken.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Returns all but `bytes` to the budget. Takes no more bytes if fewer are taken.
    pub fn shrink(&mut self, bytes: u64) {
        let given = self.bytes.saturating_sub(bytes);
        self.budget.taken.fetch_sub(given, Ordering::Relaxed);
        self.bytes -= given;
    }

    /// Leaves the bytes taken, and returns their number for [`Budget::give_back`].
    #[must_use]
    pub fn into_bytes(mut self) -> u64 {
        std::mem::take(&mut self.bytes)
    }

    /// Takes `more` bytes for a purpose.
    ///
    /// # Errors
    /// See [`Budget::reserve`]; bytes that were taken before stay taken.
    pub fn grow(&mut self, more: u64, what: impl FnOnce() -> String) -> Result<(), MemoryError> {
        self.bytes += self.budget.reserve(more, what)?.into_bytes();
        Ok(())
    }
}

/// Returns whether the system provides this many bytes in one piece. The bytes are released at
/// once. Without this trial, a process whose address space is limited would abort at the
/// allocation.
fn given(bytes: u64) -> bool {
    let Ok(bytes) = usize::try_from(bytes) else { return false };
    let mut trial: Vec<u8> = Vec::new();
    let given = bytes < SMALL || trial.try_reserve_exact(bytes).is_ok();
    // The compiler removes an allocation whose memory is not used.
    std::hint::black_box(&trial);
    given
}

/// Number of bytes below which the system is not tried.
const SMALL: usize = 1 << 20;

impl Drop for Reserved<'_> {
    fn drop(&mut self) {
        self.budget.taken.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

/// A number of bytes in words: exact if it is small, otherwise with one decimal. A GB is 1024 MB,
/// as in the argument of `--max-memory`.
#[derive(Debug, Clone, Copy)]
pub struct Bytes(pub u64);

impl fmt::Display for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (shift, unit) in [(30, "GB"), (20, "MB")] {
            if self.0 >= 1 << shift {
                return write!(f, "{:.1} {unit}", self.0 as f64 / f64::from(1u32 << shift));
            }
        }
        write!(f, "{} bytes", self.0)
    }
}

/// The reason for a refusal, and the remedy.
struct Remedy<'a>(&'a MemoryError);

impl fmt::Display for Remedy<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MemoryError { taken, limit, refused_by_system, .. } = *self.0;
        if refused_by_system {
            return f.write_str(
                "and the system does not provide them: make the input or the result smaller",
            );
        }
        write!(f, "and {} are allowed", Bytes(limit))?;
        // A few bytes taken for other purposes explain nothing.
        if taken > limit / 100 {
            write!(f, ", of which {} are in use", Bytes(taken))?;
        }
        f.write_str(": make the input or the result smaller, or raise --max-memory")
    }
}

/// Reads a number of bytes, such as `500000`, `64k`, `512M` or `2G`; the letters stand for powers
/// of 1024.
///
/// # Errors
/// On any other text, and beyond 64 bits.
pub fn bytes(text: &str) -> Result<u64, String> {
    let (digits, shift) = match text.char_indices().last() {
        Some((at, 'k' | 'K')) => (&text[..at], 10),
        Some((at, 'm' | 'M')) => (&text[..at], 20),
        Some((at, 'g' | 'G')) => (&text[..at], 30),
        _ => (text, 0),
    };
    let plain = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit());
    let number = digits.parse::<u64>().ok().filter(|_| plain);
    number
        .and_then(|number| number.checked_mul(1 << shift))
        .ok_or_else(|| "expected a number of bytes, or one with k, M or G such as 512M".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_memory_have_letters() {
        let sizes = ["0", "17", "3k", "2M", "1G"].map(|text| bytes(text).unwrap());
        assert_eq!(sizes, [0, 17, 3 << 10, 2 << 20, 1 << 30]);
        for bad in ["", "k", "-1", "+1", "1.5G", "1T", "99999999999G", "2 G", "G2"] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn what_is_dropped_can_be_taken_again() {
        let budget = Budget::new(100);
        let first = budget.reserve(60, || "a".into()).unwrap();
        assert!(budget.reserve(41, || "b".into()).is_err());
        let second = budget.reserve(40, || "b".into()).unwrap();
        assert_eq!(budget.left(), 0);
        drop(first);
        assert_eq!(budget.left(), 60);
        drop(second);
        assert_eq!(budget.left(), 100);
    }

    #[test]
    fn a_reservation_grows_and_shrinks() {
        let budget = Budget::new(100);
        let mut reserved = budget.reserve(10, String::new).unwrap();
        reserved.grow(50, String::new).unwrap();
        assert!(reserved.grow(41, String::new).is_err());
        assert_eq!((reserved.bytes(), budget.left()), (60, 40));
        reserved.shrink(30);
        assert_eq!((reserved.bytes(), budget.left()), (30, 70));
        drop(reserved);
        assert_eq!(budget.left(), 100);
    }

    #[test]
    fn a_refusal_says_what_is_needed_for_what_and_what_is_allowed() {
        let budget = Budget::new(20 << 30);
        let _kept = budget.reserve(1 << 30, String::new).unwrap();
        let error = budget.reserve(28 << 30, || "a picture".into()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "a picture needs 28.0 GB, and 20.0 GB are allowed, of which 1.0 GB are in use: make \
             the input or the result smaller, or raise --max-memory"
        );
        assert_eq!(error.exit(), Exit::Resource);
        let endless = Budget::new(u64::MAX).reserve(1 << 60, || "a grid".into()).unwrap_err();
        assert_eq!(
            endless.to_string(),
            "a grid needs 1073741824.0 GB, and the system does not provide them: make the input \
             or the result smaller"
        );
        let error = Budget::new(7).reserve(u64::MAX, || "a mesh".into()).unwrap_err().to_string();
        assert!(error.contains("and 7 bytes are allowed: make"), "{error}");
    }

    #[test]
    fn threads_together_take_no_more_than_there_is() {
        let budget = Budget::new(1000);
        let kept = std::sync::Mutex::new(Vec::new());
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    while let Ok(reserved) = budget.reserve(7, String::new) {
                        kept.lock().unwrap().push(reserved);
                    }
                });
            }
        });
        assert_eq!(kept.lock().unwrap().len(), 1000 / 7);
    }

    #[test]
    fn a_process_may_take_some_of_the_memory_that_is_free() {
        assert!(of_process().limit() > 1 << 20, "{:?}", of_process());
    }
}
