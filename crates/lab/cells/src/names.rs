//! Names of files of cells.

/// A name for the files of each cell: `cell-` and letters, digits, `-`, `_` of the cell's name; a number where it is taken, also in
/// other case: some disks ignore it.
pub fn file_names<'n>(cells: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for cell in cells {
        let plain: String = cell
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' })
            .collect();
        let base = format!("cell-{plain}");
        let mut tries = std::iter::once(base.clone()).chain((2..).map(|number| format!("{base}-{number}")));
        let is_free = |name: &String| !names.iter().any(|taken| taken.eq_ignore_ascii_case(name));
        let free = tries.find(is_free).unwrap_or(base);
        names.push(free);
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_safe_and_differ() {
        let names = file_names(["a/b", "a b", "3", "3"].into_iter());
        assert_eq!(names, ["cell-a-b", "cell-a-b-2", "cell-3", "cell-3-2"]);
        assert_eq!(file_names(["A", "a"].into_iter()), ["cell-A", "cell-a-2"]);
    }
}
