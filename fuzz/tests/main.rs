//! The fuzzer, as a program: what it notices, and how a case is tried again.

mod faults;
