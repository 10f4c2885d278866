//! Words that the pages define: `words.txt`, a line each, in the order of the pages. A line without a definition is a number of cells.

use motiform_figures::report::Definition;
use motiform_study::quantity::cell;

/// All of them.
pub(crate) fn glossary() -> Vec<Definition> {
    let lines = include_str!("words.txt").lines();
    let declared = |word: &str| cell::ALL.iter().find(|one| one.symbol == word).map_or("", |one| one.meaning);
    let split = |line: &'static str| line.split_once(" | ").unwrap_or((line, declared(line)));
    lines.map(split).map(|(word, text)| Definition::new(word, text)).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_word_has_a_definition_and_one() {
        let all = super::glossary();
        for (place, one) in all.iter().enumerate() {
            assert!(!one.text.is_empty(), "{} has no definition", one.word);
            assert!(all[..place].iter().all(|other| other.word != one.word), "{} is defined twice", one.word);
        }
        for name in motiform_tracks::modes::Flag::NAMES {
            assert!(all.iter().any(|one| one.word == name), "the flag '{name}' is not defined");
        }
    }
}
