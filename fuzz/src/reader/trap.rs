//! A reader that fails in every manner, for tests of the fuzzer itself.

use crate::verdict::{Stop, Tried};
use std::time::{Duration, Instant};

/// Fails as the input requests, or accepts the input.
///
/// # Errors
/// When the input requests an error.
///
/// # Panics
/// When the input requests a panic.
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

/// Calls itself until the stack overflows; returns at once from `1 << 60` on.
fn deep(level: u64) -> u64 {
    let here = [level; 64];
    if level >= 1 << 60 { level } else { deep(std::hint::black_box(level + 1)) + here[5] }
}
