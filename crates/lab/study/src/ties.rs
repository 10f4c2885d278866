//! Parameters that follow from others.

use crate::Error;
use motiform_models::ModelInfo;
use motiform_models::amplitudes::Formula;
use motiform_models::parameters::{ParameterSpec, index_of};
use motiform_models::spelling::ascii;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Ties: each parameter in them has the value of an expression of the others, as in `b3 = d3` or `kappa3 = 2*kappa2`, in runs, on the axes
/// of a scan and along branches. No expression contains a tied parameter, so their order is of no account.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Ties(BTreeMap<String, String>);

impl Ties {
    /// Returns `true` if there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The expression that a parameter has the value of.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.0.get(name).map(String::as_str)
    }

    /// The tied parameters with their expressions.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(name, formula)| (name.as_str(), formula.as_str()))
    }

    /// Ties a parameter, replacing an earlier expression.
    ///
    /// # Errors
    /// An unknown name; [`Error::Tie`] for what is no expression of other parameters, none of them tied.
    pub(crate) fn tie(&mut self, info: &ModelInfo, name: &str, formula: &str) -> Result<(), Error> {
        let specs = info.parameters();
        let tied = index_of(specs, info.name, name)?;
        let name = specs[tied].name;
        let formula = ascii(formula.trim());
        let wrong = |problem: String| Error::Tie { name: name.to_owned(), formula: formula.clone(), problem };
        let uses = |text: &str| Formula::parse(text, &names(specs)).map(|formula| formula.uses().to_vec());
        let used = uses(&formula).map_err(wrong)?;
        if let Some(&other) = used.iter().find(|&&used| used == tied || self.get(specs[used].name).is_some())
        {
            return Err(wrong(format!(
                "{} is tied itself: write the expression without it",
                specs[other].name
            )));
        }
        if let Some((other, _)) =
            self.iter().find(|(_, text)| uses(text).is_ok_and(|used| used.contains(&tied)))
        {
            return Err(wrong(format!("the tie of {other} contains {name}: write that one without it")));
        }
        self.0.insert(name.to_owned(), formula);
        Ok(())
    }

    /// The expression of a tied parameter in the notation of figures (markup): `2 *κ*_2`.
    pub fn symbols(&self, specs: &[ParameterSpec], name: &str) -> Option<String> {
        let mut rest = self.get(name)?;
        let mut written = String::new();
        while let Some(first) = rest.chars().next() {
            let end = |rest: &str| {
                rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len())
            };
            let length = if first.is_ascii_alphabetic() { end(rest) } else { first.len_utf8() };
            let (word, behind) = rest.split_at(length);
            match word {
                "*" => written.push('\u{a0}'),
                "-" => written.push('\u{2212}'),
                word => {
                    written += specs.iter().find(|spec| spec.name == word).map_or(word, |spec| spec.symbol);
                }
            }
            rest = behind;
        }
        Some(written)
    }

    /// Gives the tied parameters their values, in registry order. An expression without a value gives NaN, which every model rejects.
    pub fn apply(&self, specs: &[ParameterSpec], values: &mut [f64]) {
        if self.is_empty() {
            return;
        }
        let names = names(specs);
        for (name, formula) in &self.0 {
            let Some(place) = names.iter().position(|known| known == name) else { continue };
            values[place] = Formula::parse(formula, &names).map_or(f64::NAN, |formula| formula.value(values));
        }
    }

    /// The ties that say 0 = 0: each with its expression and the first parameter in it, all of which are 0 and none of which is varied.
    pub fn idle(&self, specs: &[ParameterSpec], values: &[f64], varied: &[&str]) -> Vec<[String; 3]> {
        let names = names(specs);
        let first = |text: &str| {
            let formula = Formula::parse(text, &names).ok()?;
            let is_idle = |&place: &usize| values[place] == 0.0 && !varied.contains(&specs[place].name);
            let used = formula.uses();
            let idle = formula.value(values) == 0.0 && used.iter().all(is_idle);
            used.first().filter(|_| idle).map(|&place| specs[place].name.to_owned())
        };
        let all = self
            .iter()
            .filter_map(|(name, formula)| Some([name.to_owned(), formula.to_owned(), first(formula)?]));
        all.collect()
    }

    /// Rejects a tied parameter among those that are varied.
    ///
    /// # Errors
    /// [`Error::Tie`].
    pub(crate) fn check_free<'n>(&self, varied: impl IntoIterator<Item = &'n str>) -> Result<(), Error> {
        for name in varied {
            if let Some(formula) = self.get(name) {
                let problem = format!(
                    "{name} cannot be varied by itself: vary what it is tied to, or leave out the tie"
                );
                return Err(Error::Tie { name: name.to_owned(), formula: formula.to_owned(), problem });
            }
        }
        Ok(())
    }
}

fn names(specs: &[ParameterSpec]) -> Vec<String> {
    specs.iter().map(|spec| spec.name.to_owned()).collect()
}
