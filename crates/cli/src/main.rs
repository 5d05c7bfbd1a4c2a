//! The asperity command line.
fn main() {}
