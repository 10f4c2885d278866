//! Why rows of a scan are undetermined.

use std::collections::BTreeMap;

/// Different reasons that are counted one by one; more of them are counted together.
const KEPT: usize = 64;

/// Reasons that are told, the most frequent first.
const TOLD: usize = 3;

/// How many rows are undetermined for which reason, in memory that does not grow with the rows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reasons {
    rows: BTreeMap<String, usize>,
    others: usize,
}

impl Reasons {
    /// Counts rows of one reason; rows that carry none are of no account.
    pub(super) fn add(&mut self, why: &str, rows: usize) {
        if why.is_empty() {
            return;
        }
        let full = self.rows.len() >= KEPT;
        match self.rows.get_mut(why) {
            Some(count) => *count += rows,
            None if full => self.others += rows,
            None => drop(self.rows.insert(why.to_owned(), rows)),
        }
    }

    /// Counts the rows of others.
    pub(crate) fn add_all(&mut self, others: &Self) {
        others.rows.iter().for_each(|(why, rows)| self.add(why, *rows));
        self.others += others.others;
    }

    /// The most frequent reasons, each with its number of rows, and the rest as one.
    #[must_use]
    pub fn told(&self) -> Vec<(&str, usize)> {
        let mut all: Vec<(&str, usize)> = self.rows.iter().map(|(why, rows)| (why.as_str(), *rows)).collect();
        all.sort_by_key(|(_, rows)| std::cmp::Reverse(*rows)); // stable
        let rest = self.others + all.iter().skip(TOLD).map(|(_, rows)| rows).sum::<usize>();
        all.truncate(TOLD);
        all.extend((rest > 0).then_some(("other reasons", rest)));
        all
    }
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
        (0..200).for_each(|k| reasons.add(&k.to_string(), 1));
        assert_eq!(reasons.told()[3].1, 202);
    }
}
