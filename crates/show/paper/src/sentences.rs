//! The paper, sentence by sentence (`sentences.txt`): what can be checked here, and why the rest is not.
//!
//! A claim names the sentences that it checks; tests see to it that every number appears once and that every checked sentence has
//! its claim.

use motiform_figures::report::Sentence;

const TEXT: &str = include_str!("sentences.txt");

/// A sentence, or neighbours that stand together.
struct Entry<'t> {
    /// First and last number.
    numbers: (u16, u16),
    /// Its beginning, or the statement of the group.
    words: &'t str,
    /// Chapters whose claims check it, or the reason why none does.
    fate: Result<Vec<&'t str>, &'t str>,
}

impl<'t> Entry<'t> {
    /// Reads `NUMBERS | WORDS | checked in CHAPTERS` or `... | not checked: REASON`.
    fn parse(line: &'t str) -> Option<Self> {
        let (numbers, rest) = line.split_once(" | ")?;
        let (words, fate) = rest.rsplit_once(" | ")?;
        let (first, last) = numbers.split_once('-').unwrap_or((numbers, numbers));
        let fate = match fate.strip_prefix("checked in ") {
            Some(chapters) => Ok(chapters.split(", ").collect()),
            None => Err(fate.strip_prefix("not checked: ")?),
        };
        Some(Self { numbers: (first.parse().ok()?, last.parse().ok()?), words, fate })
    }
}

/// The entries, each with the part that it stands in.
fn entries() -> impl Iterator<Item = (&'static str, Entry<'static>)> {
    let mut part = "";
    TEXT.lines().filter_map(move |line| match line.strip_prefix("## ") {
        Some(title) => {
            part = title;
            None
        }
        None => Some((part, Entry::parse(line)?)),
    })
}

/// The table for the report.
pub(super) fn sentences() -> Vec<Sentence> {
    let sentence = |(part, entry): (&str, Entry<'_>)| Sentence {
        numbers: entry.numbers,
        part: part.to_owned(),
        words: entry.words.to_owned(),
        unchecked: entry.fate.err().map(str::to_owned),
    };
    entries().map(sentence).collect()
}

/// The entries that claims of a chapter check, by their first number.
pub fn checked_in(chapter: &str) -> Vec<u16> {
    let of = |entry: &Entry<'_>| entry.fate.as_ref().is_ok_and(|chapters| chapters.contains(&chapter));
    entries().filter(|(_, entry)| of(entry)).map(|(_, entry)| entry.numbers.0).collect()
}

/// The first number of the entry that a sentence is in; `None` beyond the last.
pub fn entry_of(sentence: u16) -> Option<u16> {
    let within = |entry: &Entry<'_>| (entry.numbers.0..=entry.numbers.1).contains(&sentence);
    entries().find(|(_, entry)| within(entry)).map(|(_, entry)| entry.numbers.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of sentences of the paper, counted by a program that splits its source.
    const COUNT: u16 = 199;

    #[test]
    fn every_sentence_appears_once_and_in_order() {
        let mut next = 1;
        for (_, entry) in entries() {
            assert_eq!(entry.numbers.0, next, "{}", entry.words);
            assert!(entry.numbers.1 >= entry.numbers.0, "{}", entry.words);
            next = entry.numbers.1 + 1;
        }
        assert_eq!(next, COUNT + 1);
        let lines = TEXT.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).count();
        assert_eq!(lines, entries().count(), "a line cannot be read");
    }

    #[test]
    fn every_entry_has_chapters_that_exist_or_a_reason() {
        for (part, entry) in entries() {
            assert!(!part.is_empty());
            match entry.fate {
                Ok(chapters) => {
                    assert!(chapters.iter().all(|name| super::super::names().contains(name)), "{chapters:?}");
                }
                Err(why) => assert!(why.len() > 15, "{}: {why}", entry.words),
            }
        }
    }
}
