//! Numbers of things in words.

/// A number with the word for one or for many: `1 curve`, `3 curves`.
#[must_use]
pub fn counted(count: usize, one: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {one}s") }
}
