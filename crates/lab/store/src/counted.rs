//! Numbers of things in words.

/// A number with the word for one or for many: `1 curve`, `3 curves`, `2 branches`, `0 bodies`.
pub fn counted(count: usize, one: &str) -> String {
    match one.strip_suffix('y') {
        _ if count == 1 => format!("1 {one}"),
        Some(stem) => format!("{count} {stem}ies"),
        None if one.ends_with("ch") => format!("{count} {one}es"),
        None => format!("{count} {one}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::counted;

    #[test]
    fn words_have_their_plural() {
        let said = [(1, "branch"), (2, "branch"), (0, "body"), (1, "row"), (3, "row")]
            .map(|(n, one)| counted(n, one));
        assert_eq!(said, ["1 branch", "2 branches", "0 bodies", "1 row", "3 rows"]);
    }
}
