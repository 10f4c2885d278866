//! A share of a scan, for several machines.

use crate::Error;

/// Shard I of N: the parts whose number is I - 1 modulo N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 0.
    index: usize,
    of: usize,
}

impl Shard {
    /// The whole scan.
    pub const WHOLE: Self = Self { index: 0, of: 1 };

    /// Reads `I/N`, with I from 1 to N.
    ///
    /// # Errors
    /// [`Error::Setting`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        let read = || {
            let (index, of) = text.split_once('/')?;
            let (index, of): (usize, usize) = (index.trim().parse().ok()?, of.trim().parse().ok()?);
            (1..=of).contains(&index).then(|| Self { index: index - 1, of })
        };
        read().ok_or_else(|| Error::Setting {
            key: "shard",
            value: text.to_owned(),
            remedy: "write I/N with I from 1 to N, e.g. 1/3",
        })
    }

    /// Returns `true` if a part belongs to it.
    pub fn holds(self, part: usize) -> bool {
        part % self.of == self.index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_belongs_to_one_shard() {
        let shards = ["1/3", "2/3", "3 / 3"].map(|text| Shard::parse(text).unwrap());
        for part in 0..10 {
            assert_eq!(shards.iter().filter(|shard| shard.holds(part)).count(), 1);
            assert!(Shard::WHOLE.holds(part));
        }
        for bad in ["", "1", "0/3", "4/3", "1/0", "a/b", "-1/3", "1/3/5", "1.5/3"] {
            assert!(Shard::parse(bad).is_err(), "{bad}");
        }
    }
}
