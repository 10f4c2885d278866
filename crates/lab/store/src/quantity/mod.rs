//! Quantities of results, each declared once: columns, labels of axes, glossaries and Python follow from here.
//!
//! A subject is what a row of a table is about. In one subject a name has one meaning; a name that several subjects have has one dimension.

pub mod answer;
pub mod cell;
pub mod coefficient;
mod dimension;
pub mod frame;
pub mod motion;
pub mod special;
pub mod state;
pub mod statistic;
mod unit;

pub use dimension::Dimension;
pub use unit::Unit;

use std::borrow::Cow;

/// A quantity of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Name in tables, JSON and Python, ASCII.
    pub name: &'static str,
    /// Name in texts and figures (markup).
    pub symbol: &'static str,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its meaning in one sentence.
    pub meaning: &'static str,
}

impl Quantity {
    /// The meaning with the unit of a model, unless the sentence has it or refers to the quantity before (`its error`).
    pub fn described(&self) -> Cow<'static, str> {
        let unit = self.dimension.words();
        let known = self.meaning.contains(unit.trim_start_matches("inverse "));
        let refers = self.meaning.starts_with("its ") || self.meaning.contains(" its ");
        if refers || known {
            return self.meaning.into();
        }
        format!("{} ({unit})", self.meaning).into()
    }
}

/// Quantities of one subject: `NAME "name", "symbol" DIMENSION "meaning";`, the symbol only where it is not the name.
macro_rules! quantities {
    ($($id:ident $name:literal $(, $symbol:literal)? $dimension:ident $meaning:literal;)*) => {
        $(
            #[doc = $meaning]
            pub static $id: crate::quantity::Quantity = crate::quantity::Quantity {
                name: $name,
                symbol: {
                    let names = [$name $(, $symbol)?];
                    names[names.len() - 1]
                },
                dimension: crate::quantity::Dimension::$dimension,
                meaning: $meaning,
            };
        )*
        /// All of them.
        pub static ALL: &[&crate::quantity::Quantity] = &[$(&$id),*];
    };
}
use quantities;

/// All subjects by name.
pub fn subjects() -> [(&'static str, &'static [&'static Quantity]); 8] {
    [
        ("state", state::ALL),
        ("motion", motion::ALL),
        ("special", special::ALL),
        ("statistic", statistic::ALL),
        ("frame", frame::ALL),
        ("cell", cell::ALL),
        ("coefficient", coefficient::ALL),
        ("answer", answer::ALL),
    ]
}

#[cfg(test)]
mod tests {
    use super::{Quantity, state, subjects};

    #[test]
    fn a_name_has_one_meaning_in_a_subject_and_one_dimension_in_all() {
        let all: Vec<(&str, &Quantity)> = subjects()
            .into_iter()
            .flat_map(|(subject, all)| all.iter().map(move |one| (subject, *one)))
            .collect();
        for (place, (subject, one)) in all.iter().enumerate() {
            assert!(one.name.chars().all(|c| matches!(c, 'a'..='z' | '0'..='9' | '_')), "{}", one.name);
            assert!(!one.symbol.is_empty() && !one.meaning.is_empty(), "{}", one.name);
            for (other_subject, other) in all[..place].iter().filter(|other| other.1.name == one.name) {
                assert_ne!(subject, other_subject, "{} is declared twice", one.name);
                assert_eq!(one.dimension, other.dimension, "{} in {subject} and {other_subject}", one.name);
            }
        }
    }

    #[test]
    fn the_unit_is_said_once() {
        assert_eq!(state::X.described(), "position of the centre of mass (model length)");
        assert_eq!(state::T.described(), "model time");
        assert_eq!(super::motion::LAMBDA_1.described(), "largest Lyapunov exponent (inverse model time)");
        assert_eq!(super::motion::LAMBDA_1_ERROR.described(), "half width of its 95 % confidence interval");
    }
}
