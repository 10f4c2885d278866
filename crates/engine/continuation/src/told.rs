//! Connections in words.

use super::homoclinic::{Connection, ConnectionKind, PeriodLaw};
use super::joins::words;
use motiform_dynamics::digits::value_and_error;

impl std::fmt::Display for Connection {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (place, with) = (stated(self.parameter, self.error), words(self.joins));
        match self.kind() {
            ConnectionKind::Saddle => {
                write!(f, "the orbit approaches a connection of a saddle{with} at {place}")
            }
            ConnectionKind::SaddleFocus => {
                write!(f, "the orbit approaches a connection of a saddle-focus{with} (Shilnikov) at {place}")
            }
            ConnectionKind::Resonant => {
                write!(f, "the orbit approaches a resonant connection of a saddle{with} at {place}")
            }
            ConnectionKind::SaddleNode => {
                write!(
                    f,
                    "the orbit approaches a saddle-node on a circle at {place}: two equilibria appear on it"
                )
            }
            ConnectionKind::Cycle => {
                let quantities: Vec<String> =
                    self.passed.iter().map(|passed| places::<4>(passed.quantity())).collect();
                let (count, quantities) = (self.passed.len(), quantities.join(", "));
                write!(
                    f,
                    "the orbit approaches a heteroclinic cycle of {count} saddles (saddle quantities {quantities}) at {place}"
                )
            }
        }?;
        match self.law {
            PeriodLaw::Logarithmic { rate } => {
                let rate = number(rate, self.law_error);
                write!(f, ": its time grows as -ln|p - p0| / ({rate}) in model time")
            }
            PeriodLaw::Oscillating { rate, frequency } => {
                let [rate, frequency] = [rate, frequency].map(places::<6>);
                write!(f, ": the parameter oscillates as exp(-{rate} T) cos({frequency} T) with its time T")
            }
            PeriodLaw::Resonant { amplitude } => {
                let amplitude = number(amplitude, self.law_error);
                write!(f, ": its time grows as ({amplitude}) / |p - p0| in model time")
            }
            PeriodLaw::SquareRoot { amplitude } => {
                let amplitude = number(amplitude, self.law_error);
                write!(f, ": its time grows as ({amplitude}) / sqrt|p - p0| in model time")
            }
        }?;
        match self.quantity() {
            Some(quantity)
                if matches!(self.law, PeriodLaw::Logarithmic { .. } | PeriodLaw::Oscillating { .. }) =>
            {
                if self.quantity_error().is_none_or(|error| quantity.abs() <= error) {
                    return write!(f, "; saddle quantity 0 within its error: its sign is not known");
                }
                write!(f, "; saddle quantity {}", places::<4>(quantity))
            }
            _ => Ok(()),
        }
    }
}

/// A number with its error; without one to six decimals.
fn number(x: f64, error: f64) -> String {
    if error > 0.0 { stated(x, error) } else { places::<6>(x) }
}

/// A number with so many decimals, or as a power of ten where these would show less than three digits of it.
fn places<const DECIMALS: usize>(x: f64) -> String {
    let least = libm::pow(10.0, 2.0 - DECIMALS as f64);
    if x == 0.0 || x.abs() >= least { format!("{x:.DECIMALS$}") } else { format!("{x:.3e}") }
}

/// A value with its error, to the decimals that the error leaves.
pub fn stated(value: f64, error: f64) -> String {
    value_and_error(value, error, 1).join(" +- ")
}
