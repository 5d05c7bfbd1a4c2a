//! Closed forms with their sources.
