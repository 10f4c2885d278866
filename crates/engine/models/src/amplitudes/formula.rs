//! A number that follows from parameters, in the notation of coefficients.

use super::coefficient::{Kind, Place, Tape};
use super::parser::{Names, RESERVED, parse};
use super::tokens::{Token, tokens};
use crate::error::nearest;

/// A real expression of parameters: `d3`, `2*kappa2`, `sqrt(a2) - 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    tape: Tape,
    place: Place,
    uses: Vec<usize>,
}

impl Formula {
    /// Reads an expression of the parameters with these names.
    ///
    /// # Errors
    /// The fault of the text: an unknown name (with the nearest one), a malformed expression, a result that is not real.
    pub fn parse(text: &str, parameters: &[String]) -> Result<Self, String> {
        let words = tokens(text).map_err(|error| error.problem)?;
        let names: Vec<&str> = words
            .iter()
            .filter_map(|(word, _)| if let Token::Name(name) = word { Some(name.as_str()) } else { None })
            .collect();
        let position = |name: &str| parameters.iter().position(|known| known == name);
        if let Some(unknown) = names.iter().find(|name| position(name).is_none() && !RESERVED.contains(name))
        {
            let near = nearest(unknown, parameters.iter().map(String::as_str));
            let near = near.map_or_else(String::new, |name| format!(" (did you mean {name}?)"));
            return Err(format!("{unknown} is no parameter of this model{near}"));
        }
        let uses = names.iter().filter_map(|name| position(name)).collect();
        let mut tape = Tape::default();
        let sum = parse(text, Names { modes: &[], parameters }, &mut tape).map_err(|error| error.problem)?;
        let place = sum.as_constant().unwrap_or_else(|| tape.real(0.0)); // without amplitudes, only 0 has no term
        if tape.kind(place) == Kind::Real {
            Ok(Self { tape, place, uses })
        } else {
            Err("a parameter is a real number: leave out i".to_owned())
        }
    }

    /// Its value; not finite where it has none (a division by 0, the root of a negative number).
    pub fn value(&self, parameters: &[f64]) -> f64 {
        self.tape.evaluate(parameters)[self.place as usize][0]
    }

    /// The parameters in it, by their places in the list of names.
    pub fn uses(&self) -> &[usize] {
        &self.uses
    }
}
