//! Why rows of a scan are undetermined.

use std::collections::BTreeMap;

/// Different reasons that are counted one by one; more of them are counted together.
const KEPT: usize = 64;

/// Reasons that are told, the most frequent first.
const TOLD: usize = 3;

/// Instead of numbers that differ.
const DIFFERENT: &str = "…";

/// The numbers of rows that are undetermined for each reason, in memory that does not grow with the rows. Reasons that differ by their
/// numbers alone are one, with an ellipsis where they differ.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reasons {
    /// By the words without numbers: the text, and the rows.
    rows: BTreeMap<String, (String, usize)>,
    others: usize,
}

impl Reasons {
    /// Counts rows of one reason; rows that carry none are of no account.
    pub(super) fn add(&mut self, why: &str, rows: usize) {
        if why.is_empty() {
            return;
        }
        let full = self.rows.len() >= KEPT;
        let key = without_numbers(why);
        match self.rows.get_mut(&key) {
            Some((text, count)) => {
                *text = common(text, why);
                *count += rows;
            }
            None if full => self.others += rows,
            None => drop(self.rows.insert(key, (why.to_owned(), rows))),
        }
    }

    /// Counts the rows of others.
    pub(crate) fn add_all(&mut self, others: &Self) {
        others.rows.values().for_each(|(why, rows)| self.add(why, *rows));
        self.others += others.others;
    }

    /// The most frequent reasons, each with its number of rows, and the rest as one.
    pub fn told(&self) -> Vec<(&str, usize)> {
        let mut all: Vec<(&str, usize)> =
            self.rows.values().map(|(why, rows)| (why.as_str(), *rows)).collect();
        all.sort_by_key(|(_, rows)| std::cmp::Reverse(*rows)); // stable
        let rest = self.others + all.iter().skip(TOLD).map(|(_, rows)| rows).sum::<usize>();
        all.truncate(TOLD);
        all.extend((rest > 0).then_some(("other reasons", rest)));
        all
    }
}

/// A reason with an ellipsis instead of each word with a number.
fn without_numbers(why: &str) -> String {
    let word =
        |word: &str| if word.contains(|c: char| c.is_ascii_digit()) { DIFFERENT } else { word }.to_owned();
    why.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// Two reasons of the same words, with an ellipsis where they differ.
fn common(one: &str, other: &str) -> String {
    let word = |(one, other): (&str, &str)| if one == other { one.to_owned() } else { DIFFERENT.to_owned() };
    one.split(' ').zip(other.split(' ')).map(word).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequent_reasons_come_first_and_the_rest_is_counted() {
        let mut reasons = Reasons::default();
        assert!(reasons.told().is_empty());
        for (why, rows) in [("c", 1), ("a", 2), ("b", 5), ("d", 1), ("a", 1), ("e", 1)] {
            reasons.add(why, rows);
        }
        assert_eq!(reasons.told(), [("b", 5), ("a", 3), ("c", 1), ("other reasons", 2)]);
        let word = |k: usize| "x".repeat(k + 1);
        (0..200).for_each(|k| reasons.add(&word(k), 1));
        assert_eq!(reasons.told()[3].1, 202);
    }

    #[test]
    fn reasons_that_differ_by_numbers_are_one() {
        let (mut reasons, mut more) = (Reasons::default(), Reasons::default());
        reasons.add("lambda_1 = 2.2e-2 within the budget of 300", 1);
        reasons.add("lambda_1 = 8.4e-2 within the budget of 300", 2);
        more.add("lambda_1 = 1.0e-3 within the budget of 300", 1);
        reasons.add_all(&more);
        assert_eq!(reasons.told(), [("lambda_1 = … within the budget of 300", 4)]);
    }
}
