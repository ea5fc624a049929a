//! A reader that fails in every manner: the fuzzer's own test.

use crate::verdict::{Stop, Tried};
use std::time::{Duration, Instant};

/// Fails as the input says, or takes it.
///
/// # Errors
/// As the input says.
///
/// # Panics
/// When the input says so.
pub fn read(bytes: &[u8]) -> Tried {
    let words = String::from_utf8_lossy(bytes);
    match words.split_whitespace().next() {
        Some("panic") => panic!("the input says so"),
        Some("abort") => std::process::abort(),
        Some("overflow") => {
            std::hint::black_box(deep(0));
            Ok(())
        }
        Some("memory") => {
            std::hint::black_box(vec![0_u8; 3 << 30]);
            Ok(())
        }
        Some("slow") => {
            let started = Instant::now();
            while started.elapsed() < Duration::from_secs(100) {
                std::hint::black_box(deep(1 << 60));
            }
            Ok(())
        }
        Some("message") => Err(Stop::Refused("found a map, expected struct Spec".into())),
        Some("refuse") => Err(Stop::Refused("found another word, expected a number".into())),
        Some("broken") => Err(Stop::Broken("point 3 is not finite".into())),
        _ => Ok(()),
    }
}

/// Calls itself until the stack ends; from `1 << 60` on it returns at once.
fn deep(level: u64) -> u64 {
    let here = [level; 64];
    if level >= 1 << 60 { level } else { deep(std::hint::black_box(level + 1)) + here[5] }
}
