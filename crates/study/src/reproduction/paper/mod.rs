//! The paper, sentence by sentence: what can be checked here, and why the rest is not.
//!
//! Sentences are counted from 1 through the whole paper: abstract, text and captions in the order of the source. A
//! displayed equation belongs to the sentence that it ends. Neighbours that stand together are one entry. A claim names the
//! sentences that it checks; tests see to it that every number appears once and that every checked sentence has its claim.

mod first;
mod second;

use crate::report::Sentence;

/// A sentence, or neighbours that stand together.
pub(super) struct Entry {
    /// First and last number.
    pub(super) numbers: (u16, u16),
    /// How it begins, or what the group says.
    words: &'static str,
    fate: Fate,
}

/// What becomes of a sentence.
enum Fate {
    /// Claims of these chapters check it.
    Checked(&'static [&'static str]),
    /// It is not checked, for this reason.
    Not(&'static str),
}

/// A part of the paper with its sentences.
struct Part {
    title: &'static str,
    entries: &'static [Entry],
}

const fn checked(first: u16, last: u16, words: &'static str, chapters: &'static [&'static str]) -> Entry {
    Entry { numbers: (first, last), words, fate: Fate::Checked(chapters) }
}

const fn not(first: u16, last: u16, words: &'static str, why: &'static str) -> Entry {
    Entry { numbers: (first, last), words, fate: Fate::Not(why) }
}

const PARTS: &[Part] = &[
    Part { title: "Abstract", entries: first::ABSTRACT },
    Part { title: "Introduction", entries: first::INTRODUCTION },
    Part { title: "Deformed domain", entries: first::MODELS },
    Part { title: "Numerical simulations I", entries: second::REDUCED },
    Part { title: "Numerical simulations II", entries: second::FULL },
    Part { title: "Numerical simulations III", entries: second::CELL },
    Part { title: "Coupled set of equations for the Fourier amplitudes", entries: second::FOURIER },
    Part { title: "Discussion", entries: second::DISCUSSION },
];

fn entries() -> impl Iterator<Item = &'static Entry> {
    PARTS.iter().flat_map(|part| part.entries)
}

/// The table for the report.
pub(super) fn sentences() -> Vec<Sentence> {
    let sentence = |part: &Part, entry: &Entry| Sentence {
        numbers: entry.numbers,
        part: part.title.to_owned(),
        words: entry.words.to_owned(),
        unchecked: match entry.fate {
            Fate::Checked(_) => None,
            Fate::Not(why) => Some(why.to_owned()),
        },
    };
    PARTS.iter().flat_map(|part| part.entries.iter().map(|entry| sentence(part, entry))).collect()
}

/// The entries that claims of a chapter check, by their first number.
#[must_use]
pub fn checked_in(chapter: &str) -> Vec<u16> {
    let of = |entry: &&Entry| matches!(entry.fate, Fate::Checked(chapters) if chapters.contains(&chapter));
    entries().filter(of).map(|entry| entry.numbers.0).collect()
}

/// The first number of the entry that a sentence is in; `None` beyond the last.
#[must_use]
pub fn entry_of(sentence: u16) -> Option<u16> {
    let within = |entry: &&Entry| (entry.numbers.0..=entry.numbers.1).contains(&sentence);
    entries().find(within).map(|entry| entry.numbers.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of sentences of the paper, counted by a program that splits its source.
    const COUNT: u16 = 199;

    #[test]
    fn every_sentence_appears_once_and_in_order() {
        let mut next = 1;
        for entry in entries() {
            assert_eq!(entry.numbers.0, next, "{}", entry.words);
            assert!(entry.numbers.1 >= entry.numbers.0, "{}", entry.words);
            next = entry.numbers.1 + 1;
        }
        assert_eq!(next, COUNT + 1);
    }

    #[test]
    fn every_entry_has_chapters_that_exist_or_a_reason() {
        for entry in entries() {
            match entry.fate {
                Fate::Checked(chapters) => {
                    assert!(!chapters.is_empty(), "{}", entry.words);
                    assert!(chapters.iter().all(|name| super::super::names().contains(name)), "{chapters:?}");
                }
                Fate::Not(why) => assert!(why.len() > 15, "{}: {why}", entry.words),
            }
        }
    }
}
