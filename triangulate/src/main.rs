//! triangulate
fn main() {}
